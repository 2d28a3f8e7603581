# SPDX-License-Identifier: BSD-3-Clause
# Proves that the active view shows of a scene of 3D Slicer what Slicer shows: the volume of the
# slices in its window of grey values, landmarks and surfaces in their colours.
import warnings

import numpy
import slicer_testing as slicer
from brainshift_testing import load_plugin, run_tests
from slicer_testing import Written

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.carried import display_of  # noqa: E402
from paraview import simple  # noqa: E402


def shown_scene(scene):
    simple.ResetSession()
    load_plugin()
    view = simple.CreateRenderView(ViewSize=[60, 40])
    simple.SetActiveView(view)
    with warnings.catch_warnings(record=True):
        warnings.simplefilter("always")
        return brainshift.open_scene(scene.written()), view


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
