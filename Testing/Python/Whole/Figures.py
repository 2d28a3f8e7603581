# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.figure writes what the view shows before and after, where the two differ,
# a histogram and the filters' own numbers, that scale bars agree with the camera, that files tell
# the settings, that brainshift.animate writes what it is asked for, and that Strength stays what it
# was, also when a file cannot be written.
import csv
import os
import shutil
import xml.etree.ElementTree as xml

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, on_server, picture, run_tests,
                                scratch, server_finds_plugin, show_volume, view_along, volume)
from slices_testing import flat_view, show_slices
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    Delete, FreeFormDeformation, NIFTIVolumeReader, PolyPointSource, SetActiveView, Sphere,
    TraceDistance, Wavelet)

MIDDLE = numpy.array((16.0, 16.0, 16.0))
GREY = [0, 0.5, 0.5, 0.5, 100, 0.5, 0.5, 0.5]
OPAQUE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
SIZE = (400, 300)
STAMP = brainshift.stamp((16, 16, 25), (16, 16, 16), -4.0, 8.0, 8.0)
SVG = "{http://www.w3.org/2000/svg}"
PICTURES = ("before.png", "after.png", "difference.png")


class Scene:
    """A ball with a stroke and a trace, looked at from aside."""

    def __init__(self, half_height=None, trace=True):
        self.bent = FreeFormDeformation(Input=volume(ball()), Strokes=STAMP, Strength=0.75)
        self.view = view_along((0, -1, -1), MIDDLE, 100.0, half_height=half_height, size=200)
        show_volume(self.bent, self.view, "Deformed Volume", GREY, OPAQUE, shade=True)
        self.folder = scratch("figures")
        shutil.rmtree(self.folder, ignore_errors=True)
        self.traces = None
        if trace:
            aside = numpy.random.default_rng(3).normal(size=(60, 3))
            points = MIDDLE + 9.5 * aside / numpy.linalg.norm(aside, axis=1)[:, None]
            self.traces = TraceDistance(
                Input=PolyPointSource(Points=points.ravel().tolist()), Deformation=self.bent,
                SurfaceArray="Intensity", Threshold=50.0)

    def close(self):
        for proxy in (self.view, self.traces, self.bent):
            if proxy is not None:
                Delete(proxy)
        shutil.rmtree(self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def rows(self):
        with open(self.path("numbers.csv"), encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
        assert len({row["name"] for row in table}) == len(table), "a name stands twice"
        return {row["name"]: row["value"] for row in table}


def read(path):
    """Pixels of a PNG file, indexed [row from below, column, rgb], and its texts."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    texts = {reader.GetTextKey(i): reader.GetTextValue(i)
             for i in range(reader.GetNumberOfTextChunks())}
    return pixels.reshape(height, width, -1).astype(int), texts


def bar_pixels(pixels, color):
    """Pixels of a colour in the row of the lower edge that has most of them."""
    return (pixels[:pixels.shape[0] // 20] == color).all(axis=2).sum(axis=1).max()


def raised(action, kind):
    try:
        action()
    except kind as error:
        return str(error)
    raise AssertionError(f"no {kind.__name__} was raised")


def test_pictures_and_numbers_are_those_of_view_and_filters():
    scene = Scene(half_height=20.0)
    paths = brainshift.figure(scene.bent, scene.folder, size=SIZE)
    names = [*PICTURES, "histogram.svg", "numbers.csv"]
    assert [os.path.basename(path) for path in paths] == names, paths
    assert sorted(os.listdir(scene.folder)) == sorted(names)
    before, after, difference = (read(scene.path(name))[0] for name in PICTURES)
    assert before.shape == (SIZE[1], SIZE[0], 3) == after.shape == difference.shape
    above = slice(SIZE[1] // 5, None)  # the scale bar
    changed = (before != after).any(axis=2)[above]
    assert 200 < changed.sum() < 0.5 * changed.size, changed.sum()
    marked = (difference != 255).any(axis=2)[above]
    assert (marked <= changed).all() and marked.sum() > 0.8 * changed.sum(), marked.sum()
    darker = (after.sum(axis=2) < before.sum(axis=2) - 60)[above] & marked
    assert (difference[above][darker][:, 2] > difference[above][darker][:, 0]).all(), "blue"
    assert scene.bent.Strength == 0.75
    assert_numbers(scene)
    scene.close()


def assert_numbers(scene):
    rows = scene.rows()
    scene.bent.UpdatePipeline()
    scene.traces.UpdatePipeline()
    for proxy in (scene.bent, scene.traces):
        proxy.SMProxy.UpdatePropertyInformation()
    assert float(rows["Maximum displacement"]) == scene.bent.MaximumDisplacement > 0
    assert float(rows["Minimum Jacobian"]) == scene.bent.MinimumJacobian < 1
    assert (rows["Strokes"], rows["Enabled strokes"], rows["Strength"]) == ("1", "1", "0.75")
    for label, name in (("mean", "Mean"), ("RMS", "RMS"), ("95th percentile", "Percentile95")):
        assert float(rows[f"Trace {label} after"]) == getattr(scene.traces, name), label
    assert rows["Trace points after"] == "60" == rows["Trace points before"]
    scene.bent.Strength = 0.0
    scene.traces.UpdatePipeline()
    scene.traces.SMProxy.UpdatePropertyInformation()
    assert float(rows["Trace RMS before"]) == scene.traces.RMS < float(rows["Trace RMS after"])


def test_the_scale_bar_agrees_with_the_camera():
    for half_height in (20.0, 7.0, None):
        scene = Scene(half_height, trace=False)
        scene.view.CameraViewAngle = 30.0
        brainshift.figure(scene.bent, scene.folder, size=SIZE)
        half = half_height or 100.0 * numpy.tan(numpy.radians(15.0))  # at the focal point
        mm = float(scene.rows()["Scale bar"])
        assert mm in (1, 2, 5, 10), mm
        assert 0.08 * SIZE[0] < SIZE[1] * mm / (2 * half) <= 0.2 * SIZE[0]
        for name in PICTURES:
            pixels, texts = read(scene.path(name))
            color = 0 if name == "difference.png" else 255  # it stands out from its ground
            expected = SIZE[1] * mm / (2 * half)
            assert abs(bar_pixels(pixels, color) - expected) <= 1, (name, half_height)
            assert texts["Projection"] == ("parallel" if half_height else "perspective")
            assert ("Pixel at the focal point" in texts) == (half_height is None)
        scene.close()


def letters_height(pixels):
    """Rows of the letter at the right edge, a fraction of the picture's height."""
    white = (pixels[:, -pixels.shape[1] // 8:] > 200).all(axis=2).any(axis=1)
    return white.sum() / pixels.shape[0]


def test_a_crosshair_makes_no_difference_and_letters_keep_their_size():
    bent = FreeFormDeformation(Input=volume(ball()), Strokes=STAMP)
    view = flat_view(1, MIDDLE, 25.0, size=200)
    display = show_slices(bent, view, ("Coronal",), MIDDLE)
    display.OrientationMarks, display.WorldAxes = 1, "RAS"
    folder = scratch("figures")
    differences = []
    for crosshair in (0, 1):
        display.ShowCrosshair = crosshair
        shown = picture(view) * 255
        brainshift.figure(bent, folder, view=view, size=(800, 800))
        differences.append(read(os.path.join(folder, "difference.png"))[0])
        after = read(os.path.join(folder, "after.png"))[0]
        assert display.ShowCrosshair == crosshair
        sizes = letters_height(shown), letters_height(after)
        print(f"  height of the letter {sizes[0]:.3f} in the view, {sizes[1]:.3f} in the figure")
        assert 0.85 < sizes[1] / sizes[0] < 1.15, sizes
    assert numpy.array_equal(*differences)
    Delete(view)
    shutil.rmtree(folder, ignore_errors=True)


def test_files_tell_the_settings():
    scene = Scene()
    brainshift.figure(scene.bent, scene.folder, size=SIZE)
    rows = scene.rows()
    for name in PICTURES:
        _, texts = read(scene.path(name))
        for key in ("Volume", "Strokes", "Kernel", "Inverse", "BrainShift", "ParaView", "VTK"):
            assert texts[key] == rows[key], (name, key, texts)
        assert texts["Lattice"] == "19 x 19 x 19 control points", texts
        assert texts["Strength"] == ("0.0" if name == "before.png" else "0.75"), (name, texts)
        assert texts["Scale bar"] == rows["Scale bar"] + " mm", texts
    assert rows["BrainShift"][0].isdigit() and rows["ParaView"][0].isdigit(), rows
    plot = xml.parse(scene.path("histogram.svg")).getroot()
    assert_says(plot.find(SVG + "desc").text, "Kernel: Catmull-Rom", "Strength: 0.75")
    for group in ("before", "after"):
        bars = plot.findall(f"{SVG}g[@id='{group}']/{SVG}rect/{SVG}title")
        assert sum(int(bar.text.split()[0]) for bar in bars) == 60, group
    scene.close()


def test_the_volume_is_named_without_its_folder():
    reader = NIFTIVolumeReader(FileName="/secret/place/patient.nii.gz")
    assert brainshift.figures._volume_name(FreeFormDeformation(Input=reader)) == "patient.nii.gz"
    Delete(reader)


def test_a_failure_leaves_strength():
    scene = Scene(trace=False)
    blocked = scratch("no-folder")
    with open(blocked, "w", encoding="utf-8"):
        pass
    assert_says(raised(lambda: brainshift.figure(scene.bent, blocked), OSError), blocked)
    inside = os.path.join(blocked, "bend.ogv")
    assert_says(raised(lambda: brainshift.animate(scene.bent, inside), OSError), inside)
    os.makedirs(scene.path("after.png"))  # what is in the way is found after the pictures are drawn
    problem = raised(lambda: brainshift.figure(scene.bent, scene.folder, size=SIZE), OSError)
    assert_says(problem, scene.path("after.png"))
    assert scene.bent.Strength == 0.75
    os.remove(blocked)
    scene.close()


def test_strength_is_restored_when_drawing_fails():
    scene = Scene(trace=False)
    drawn = brainshift.figures._pixels
    seen = []

    def failing(*_):
        seen.append(scene.bent.Strength)
        raise RuntimeError("no memory")

    brainshift.figures._pixels = failing
    try:
        raised(lambda: brainshift.figure(scene.bent, scene.folder, size=SIZE), RuntimeError)
        raised(lambda: brainshift.animate(scene.bent, scratch("bend.png")), RuntimeError)
    finally:
        brainshift.figures._pixels = drawn
    assert seen == [0.0, 0.0] and scene.bent.Strength == 0.75, seen
    scene.close()


def test_arguments_are_checked():
    scene = Scene(trace=False)
    calls = (
        (lambda: brainshift.figure(scene.bent, scene.folder, size=(10, 300)), "10 x 300"),
        (lambda: brainshift.figure(Sphere(), scene.folder), "Free-Form Deformation"),
        (lambda: brainshift.figure(FreeFormDeformation(Input=Wavelet()), scene.folder), "view"),
        (lambda: brainshift.animate(scene.bent, "bend.mpg"), ".ogv"),
        (lambda: brainshift.animate(scene.bent, "bend.ogv", size=(401, 300)), "401 x 300"),
        (lambda: brainshift.animate(scene.bent, "bend.png", frames=1), "frames is 1"))
    for call, said in calls:
        assert_says(raised(call, ValueError), said)
    scene.bent.Strength = 0.0
    assert_says(raised(lambda: brainshift.figure(scene.bent, scene.folder), ValueError), "Strength")
    assert not os.path.exists(scene.folder)
    scene.close()


def test_an_animation_goes_from_unbent_to_bent():
    scene = Scene(half_height=20.0, trace=False)
    os.makedirs(scene.folder)
    paths = brainshift.animate(scene.bent, scene.path("bend.png"), size=SIZE, frames=3)
    assert [os.path.basename(path) for path in paths] == [f"bend.000{i}.png" for i in range(3)]
    (first, texts), (middle, _), (last, _) = map(read, paths)
    assert (first != middle).any() and (middle != last).any()
    assert texts["Strength"] == "0.0" and read(paths[2])[1]["Strength"] == "1.0"
    assert scene.bent.Strength == 0.75
    scene.bent.Strength = 1.0
    brainshift.figure(scene.bent, scene.folder, size=SIZE)
    assert (read(scene.path("before.png"))[0] == first).all(), "the same picture"
    assert (read(scene.path("after.png"))[0] == last).all()
    for name, begins in (("bend.ogv", b"OggS"), ("bend.avi", b"RIFF")):
        assert brainshift.animate(
            scene.bent, scene.path(name), size=SIZE, frames=4) == [scene.path(name)]
        with open(scene.path(name), "rb") as file:
            movie = file.read()
        assert movie.startswith(begins) and len(movie) > 2000, (name, len(movie))
    scene.close()


def test_with_a_server():
    def written():
        bent = FreeFormDeformation(Input=Wavelet(), Strokes=brainshift.soft(
            (0, 0, 0), (3, 0, 0), 8.0))
        view = view_along((0, 0, -1), (0, 0, 0), 60.0, size=200)
        show_volume(bent, view, "Deformed Volume", [0, 1, 0, 0, 300, 1, 1, 0],
                    [0, 0, 0.5, 0, 300, 1, 0.5, 0], array="RTData")
        traces = TraceDistance(Input=PolyPointSource(Points=[0, 0, 0, 5, 5, 5]), Deformation=bent,
                               SurfaceArray="RTData", Threshold=150.0)
        SetActiveView(view)
        folder = scratch("figures-server")
        paths = brainshift.figure(bent, folder, size=SIZE)
        before, after = (read(path)[0] for path in paths[:2])
        with open(paths[-1], encoding="utf-8") as file:
            numbers = file.read()
        shutil.rmtree(folder)
        return len(paths), int((before != after).any(axis=2).sum()), numbers, traces.RMS

    count, changed, numbers, rms = on_server(written, **server_finds_plugin())
    assert count == 5 and changed > 100, (count, changed)
    assert_says(numbers, f"Trace RMS after,{rms!r},mm")


run_tests(globals())
