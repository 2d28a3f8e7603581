# SPDX-License-Identifier: BSD-3-Clause
# Proves that the active view shows of a scene of 3D Slicer what Slicer shows: the volume of the
# slices in its window of grey values, landmarks and surfaces in their colours; and that files of a
# bundle that were changed or have names that no system takes are left alone, with a note.
import os
import shutil
import warnings
import zipfile

import numpy
import slicer_testing as slicer
from brainshift_testing import load_plugin, messages, output, run_tests, scratch
from slicer_testing import Written

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import mrb, openscene  # noqa: E402
from brainshift.carried import display_of  # noqa: E402
from brainshift.mrb import MARK  # noqa: E402
from paraview import servermanager, simple  # noqa: E402


def shown_scene(scene):
    simple.ResetSession()
    load_plugin()
    view = simple.CreateRenderView(ViewSize=[60, 40])
    simple.SetActiveView(view)
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        return brainshift.open_scene(scene.written()), view


def test_what_cannot_be_read_is_one_note():
    """The file of one volume fails; the others open."""
    scene = Written("unreadable")
    for name in ("one", "two", "three"):
        add_volume(scene, name)
    right = openscene._reader_of

    def failing(path):
        if path.endswith("two.nrrd"):
            raise PermissionError(13, "Permission denied", path)
        return right(path)
    openscene._reader_of = failing
    try:
        found, _ = shown_scene(scene)
    finally:
        openscene._reader_of = right
    assert list(found.volumes) == ["one", "three"], found
    assert len(found.notes) == 1 and "'two' is not opened: its file cannot" in found.notes[0], found


def opened_of(path, **options):
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        return brainshift.open_scene(path, **options)


def test_what_was_changed_in_an_opened_bundle_stays():
    scene = Written("to edit")
    scene.linear("T", slicer.TURN)
    scene.landmarks("F", numpy.eye(3) * 20)
    path = scene.bundle("edited.mrb", "s")
    assert not opened_of(path).notes
    inside = scratch("edited-opened/s/F.mrk.json")
    with open(inside, encoding="utf-8") as file:
        text = file.read().replace("20.0", "21.0")  # as long as before
    with open(inside, "w", encoding="utf-8") as file:
        file.write(text)
    found = opened_of(path)
    assert len(found.notes) == 1 and "was changed since" in found.notes[0], found.notes
    with open(inside, encoding="utf-8") as file:
        assert file.read() == text
    places = output(found.points["F"]).GetBounds()
    assert places[1] == 21.0 or places[0] == -21.0, places


def test_names_in_bundles():
    path = scratch("names.mrb")
    shutil.rmtree(scratch("names-opened"), ignore_errors=True)
    with zipfile.ZipFile(path, "w") as file:
        for name in ("s/s.mrml", "s/a.txt", "s/A.TXT", "s/b:c", "s/d ", "s/e./f", MARK,
                     "s/" + MARK):
            file.writestr(name, "<MRML></MRML>")
    notes = opened_of(path).notes
    assert len(notes) == 6, notes
    for word, count in (("twice", 1), ("a colon", 3), ("makes itself", 2)):
        assert sum(word in note for note in notes) == count, (word, notes)
    assert opened_of(path).notes == notes
    assert not os.path.exists(scratch("names-opened 2")), "the mark is the bundle's no more"


def test_a_bundle_without_room_leaves_the_callers_folder():
    scene = Written("roomless")
    path, folder = scene.bundle("roomless.mrb"), scratch("a folder of mine")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    spare, mrb.SPARE = mrb.SPARE, 2**60
    try:
        for chosen in (folder, None):
            try:
                opened_of(path, folder=chosen)
            except ValueError as problem:
                assert "0 are free" in str(problem), problem
            else:
                raise AssertionError("there is room")
    finally:
        mrb.SPARE = spare
    assert os.listdir(folder) == [] and not os.path.exists(scratch("roomless-opened"))


def test_a_scene_on_a_server_is_refused():
    class Remote:
        @staticmethod
        def IsRemote():
            return True
    connection = servermanager.ActiveConnection
    servermanager.ActiveConnection = Remote
    try:
        with messages() as told:
            openscene.open_in_window("/elsewhere/scene.mrml")
    finally:
        servermanager.ActiveConnection = connection
    assert "/elsewhere/scene.mrml is on the server" in told.text, told.text


def add_volume(scene, name, kind="Volume", **attributes):
    slicer.write_nrrd(scene.path(f"{name}.nrrd"), numpy.arange(1000, dtype="i2").reshape(
        10, 10, 10), (0, 0, 0), numpy.eye(3) * 5)
    scene.node("VolumeDisplay", f"{name}Display", window="200", level="300", autoWindowLevel="0")
    attributes["references"] = f"storage:{name}Storage;display:{name}Display;"
    scene.stored(kind, name, f"{name}.nrrd", **attributes)


def test_colours_and_windows():
    scene = Written("coloured")
    add_volume(scene, "head")
    simple.SaveData(scene.path("ball.vtp"), simple.Sphere(Radius=30))
    for kind in ("Model", "Markups"):
        scene.node(f"{kind}Display", f"{kind}Look", opacity="0.75",
                   **{"color" if kind == "Model" else "selectedColor": "0.5 0.25 0"},
                   visibility="true", scalarVisibility="false")
    scene.stored("Model", "ball", "ball.vtp", storage={"coordinateSystem": "LPS"},
                 references="storage:ballStorage;display:ModelLook;")
    scene.landmarks("F", numpy.eye(3) * 20, references="storage:FStorage;display:MarkupsLook;")
    found, view = shown_scene(scene)
    assert not found.notes, found.notes
    for source in (found.models["ball"], found.points["F"]):
        display = simple.GetDisplayProperties(source, view)
        assert not display.ColorArrayName[1] and display.Opacity == 0.75, display.ColorArrayName
        assert numpy.allclose(display.DiffuseColor, (0.5, 0.25, 0.0))
    display = simple.GetDisplayProperties(found.volumes["head"], view)
    assert display.Representation == "Deformed Volume" and display.ColorArrayName[1]
    colors, opacities = display.LookupTable, display.ScalarOpacityFunction
    assert numpy.allclose((colors.RGBPoints[0], colors.RGBPoints[-4]), (200, 400)), (
        colors.RGBPoints)
    assert numpy.allclose((opacities.Points[0], opacities.Points[-4]), (200, 400))


def volume_in_view(*nodes, last="Volume"):
    """The name of the volume that the view shows of three."""
    scene = Written("several")
    add_volume(scene, "labels", labelMap="1")
    for name in ("first", "second", "third"):
        add_volume(scene, name, last if name == "third" else "Volume")
    for number, (kind, attributes) in enumerate(nodes):
        scene.node(kind, f"{kind}{number}", **attributes)
    found, view = shown_scene(scene)
    everything = {**found.volumes, **found.segmentations}
    assert len(everything) == 4, found
    return [name for name, source in everything.items()
            if (display := display_of(source, view)) and display.Visibility]


def test_the_volume_of_the_slices_is_shown():
    selection = ("Selection", {"references": "ActiveVolume:second;"})
    slices = ("SliceComposite", {"references": "backgroundVolume:third;"})
    old = ("SliceComposite", {"backgroundVolumeID": "third"})
    labels = ("SliceComposite", {"references": "backgroundVolume:labels;"})
    assert volume_in_view() == ["first"]
    assert volume_in_view(selection) == ["second"]
    assert volume_in_view(selection, slices) == ["third"]
    assert volume_in_view(old, selection) == ["third"]
    assert volume_in_view(labels) == ["first"]
    assert volume_in_view(slices, last="LabelMapVolume") == ["first"]


run_tests(globals())
