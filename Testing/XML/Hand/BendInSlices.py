# SPDX-License-Identifier: BSD-3-Clause
"""Proves that Move, Soft and Stamp bend a volume in its slices, in 2D views and in 3D: what they
act on lies in the slice under the cursor and moves within it, whichever view is active; the other
views follow at once; the wheel is the stamp's over the slice only. And that they do in a parallel
3D view.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import picture, volume
from paraview import simple
from window_testing import deformation, strokes, undo_labels

SLICES = {"sagittal": 0, "coronal": 1, "axial": 2}  # and the axis they lie across
MIDDLE = numpy.array((20.0, 30.0, 24.0))
SPACING = 4.0  # mm, between control points


def block():
    """A block of 41 x 61 x 49 mm with a pattern in it, so that each slice has something to show."""
    source = simple.Wavelet(WholeExtent=[0, 40, 0, 60, 0, 48], Center=list(MIDDLE))
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=source, LatticeDimensions=[11, 16, 13])
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    opacity = simple.GetOpacityTransferFunction("RTData")
    opacity.Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]  # rays end at once
    simple.SetActiveSource(bent)
    simple.Render(view)
    hand.wait(100)
    return bent


class Scene:
    """The four views of the block, with the slices at a place that no control point lies in."""

    def __init__(self):
        self.bent = block()
        self.views = brainshift.four_views(self.bent)
        self.display("axial").SlicePosition = [15.0, 29.0, 21.0]
        simple.RenderAllViews()
        hand.wait(100)

    def display(self, name):
        return simple.GetDisplayProperties(self.bent, self.views[name])

    def position(self):
        return numpy.array(self.display("axial").SlicePosition)

    def pixel(self, name, position):
        return window.pixel_of(self.views[name], position)

    def pixel_in(self, name, right, up):
        """A pixel from the view's middle, in shares of its height."""
        width, height = self.views[name].ViewSize
        return [width // 2 + round(right * height), height // 2 + round(up * height)]

    def tissue(self, name, pixel):
        return brainshift.pick(self.display(name), self.views[name], *pixel)

    def over(self, name):
        hand.over(self.views[name])


def last():
    """The last stroke's numbers by name."""
    numbers = numpy.array(strokes()[-1])
    return {"tool": int(numbers[0]), "anchor": numbers[1:4], "vector": numbers[4:7],
            "axis": numbers[7:10], "major": numbers[10]}


def assert_in_slice(scene, name, vector):
    """Something of length, and none of it across the slice."""
    axis = SLICES[name]
    assert numpy.linalg.norm(vector) > 0.5, vector
    assert abs(vector[axis]) < 1e-6, (name, vector)


def soft_in_each(scene):
    # Without a click before: the tool is where the cursor is.
    hand.take(hand.SOFT)
    for count, (name, axis) in enumerate(SLICES.items(), 1):
        scene.over(name)
        start, end = scene.pixel_in(name, 0.05, 0.05), scene.pixel_in(name, 0.15, 0.1)
        tissue = scene.tissue(name, start)
        assert abs(tissue[axis] - scene.position()[axis]) < 1e-5, (name, tissue)
        hand.drag(start, end)
        assert len(strokes()) == count, (name, strokes())
        stroke = last()
        assert stroke["tool"] == brainshift.SOFT
        assert numpy.allclose(stroke["anchor"], tissue, atol=1e-4), (stroke, tissue)
        assert_in_slice(scene, name, stroke["vector"])
        # What was taken hold of is where the hand let it go.
        there = scene.pixel(name, stroke["anchor"] + stroke["vector"])
        moved = numpy.subtract(there, scene.pixel(name, stroke["anchor"]))
        assert numpy.allclose(moved, numpy.subtract(end, start), atol=1.5), (name, moved)
    window.edit("Undo", 1, 1)
    window.edit("Undo", 1)
    window.edit("Undo")


def others_follow(scene):
    # While the hand still holds it; also in the view that another slice is drawn in, and of volumes
    # that ParaView has stand-ins drawn for meanwhile.
    for view in scene.views.values():
        view.LODThreshold = 0.0
    hand.take(hand.NONE)  # what a tool shows is no part of the pictures
    before = {name: picture(scene.views[name]) for name in SLICES}
    hand.take(hand.SOFT)
    hand.setting("radius", 20.0)
    scene.over("axial")
    start = scene.pixel("axial", scene.position())
    counts = {name: brainshift.counters(scene.display(name))["frames"] for name in scene.views}
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 25, start[1] + 15])
    hand.wait(100)
    for name in scene.views:
        assert brainshift.counters(scene.display(name))["frames"] > counts[name], name
    for name in SLICES:
        differing = (picture(scene.views[name]) != before[name]).any(axis=2).mean()
        assert differing > 0.02, (name, differing)
    hand.tap(hand.ESCAPE)
    hand.release([start[0] + 25, start[1] + 15])
    hand.wait(100)
    assert strokes() == [], strokes()
    hand.take(hand.NONE)
    for name in SLICES:
        assert (picture(scene.views[name]) == before[name]).all(), name


def move_in_slice(scene):
    # A control point 1 mm before the slice; its way lies in the slice.
    hand.take(hand.MOVE)
    for name, axis in SLICES.items():
        scene.over(name)
        point = numpy.round(scene.position() / SPACING) * SPACING
        start = scene.pixel(name, point)
        hand.drag(start, [start[0] + 9, start[1] + 6])
        assert len(strokes()) == 1, (name, strokes())
        stroke = last()
        assert stroke["tool"] == brainshift.MOVE
        assert numpy.allclose(stroke["anchor"], point, atol=1e-4), (name, stroke, point)
        assert_in_slice(scene, name, stroke["vector"])
        window.edit("Undo")


def far_points_stay_out_of_reach(scene):
    # Two cells beside the slice there are control points too, but nothing of them is in it.
    hand.take(hand.MOVE)
    scene.over("axial")
    hidden = [16.0, 28.0, 28.0]
    nearest = [16.0, 28.0, 20.0]
    assert numpy.allclose(scene.pixel("axial", hidden), scene.pixel("axial", nearest))
    hand.hover(scene.pixel("axial", hidden))
    hand.wait()
    cells = 2.6  # that are shown about the cursor
    layer = math.pi * cells ** 2
    points = window.shown(scene.views["axial"], "ControlPoints")
    assert 0.7 * layer < points < 1.3 * layer, points
    hand.drag(scene.pixel("axial", hidden), scene.pixel_in("axial", 0.2, 0.1))
    assert numpy.allclose(last()["anchor"], nearest), last()
    window.edit("Undo")


def stamp_in_slice(scene):
    hand.take(hand.STAMP)
    interest = MIDDLE
    scene.bent.PointOfInterest = list(interest)
    for name, axis in SLICES.items():
        scene.over(name)
        pixel = scene.pixel_in(name, 0.12, 0.2)
        hand.hover(pixel)
        tissue = numpy.array(scene.tissue(name, pixel))
        place = scene.position()
        hand.wheel(pixel, 3)
        window.settle("Stamp: pull")
        stroke = last()
        assert numpy.allclose(scene.position(), place), "the wheel is the stamp's"
        assert numpy.allclose(stroke["anchor"], tissue, atol=1e-4), (stroke, tissue)
        towards = interest - tissue
        towards[axis] = 0.0
        assert numpy.allclose(stroke["axis"], towards / numpy.linalg.norm(towards)), (name, stroke)
        assert_in_slice(scene, name, stroke["vector"])
        assert math.isclose(-stroke["vector"] @ stroke["axis"], 3.0, rel_tol=1e-6), stroke
        window.edit("Undo")


def next_slice_next_stroke(scene):
    # Clicks at one place are one stroke; in the next slice it is another place.
    hand.take(hand.STAMP)
    scene.over("axial")
    pixel = scene.pixel_in("axial", 0.12, 0.2)
    hand.hover(pixel)
    hand.wheel(pixel, 2)
    hand.wheel(pixel, 1)
    window.settle("Stamp: pull")
    assert len(strokes()) == 1, strokes()
    hand.wheel(pixel, 1)
    before = scene.tissue("axial", pixel)[2]
    hand.tap(hand.PAGE_UP)  # before that has settled
    for _ in range(100):  # until the next slice is seen
        hand.wait(10)
        if abs(scene.tissue("axial", pixel)[2] - before) > 0.5:
            break
    hand.wheel(pixel, 1)
    window.settle("Stamp: pull")
    first, second = strokes()
    assert math.isclose(second[3] - first[3], 1.0, abs_tol=1e-4), (first, second)
    undo = undo_labels()
    hand.tap(hand.PAGE_DOWN)
    hand.wait(50)
    assert undo_labels() == undo, (undo_labels(), undo)
    window.edit("Undo", brainshift.STAMP)
    window.edit("Undo", brainshift.STAMP)
    window.edit("Undo")


def interest_in_slice(scene):
    hand.take(hand.STAMP)
    scene.over("coronal")
    pixel = scene.pixel_in("coronal", -0.1, -0.15)
    hand.hover(pixel)
    hand.tap("i")
    hand.wait(50)
    expected = scene.tissue("coronal", pixel)
    assert numpy.allclose(scene.bent.PointOfInterest, expected), scene.bent.PointOfInterest
    window.action("Undo")
    assert numpy.allclose(scene.bent.PointOfInterest, MIDDLE), scene.bent.PointOfInterest


def slices_scroll_elsewhere(scene):
    # Beside the slice, with keys, with another tool in hand, and with none.
    beside = [5, scene.views["axial"].ViewSize[1] // 2]
    over_it = scene.pixel_in("axial", 0.0, 0.0)
    assert scene.tissue("axial", beside) is None
    scene.over("axial")
    place = scene.position()

    def goes(clicks):
        place[2] += clicks
        hand.wait(50)
        assert numpy.allclose(scene.position(), place), (scene.position(), place)

    hand.take(hand.STAMP)
    hand.hover(beside)
    hand.wheel(beside, 2)
    goes(2)
    hand.wait(700)  # the burst is over
    hand.hover(over_it)
    hand.tap(hand.PAGE_UP)
    goes(1)
    hand.tap(hand.PAGE_DOWN)
    hand.tap(hand.PAGE_DOWN)
    goes(-2)
    for tool in (hand.SOFT, hand.MOVE, hand.NONE):
        hand.take(tool)
        hand.hover(over_it)
        hand.wheel(over_it, -1)
        goes(-1)
    assert strokes() == [], strokes()
    scene.display("axial").SlicePosition = [15.0, 29.0, 21.0]
    simple.RenderAllViews()


def shift_drags_slices(scene):
    for tool in (hand.SOFT, hand.STAMP):
        hand.take(tool)
        scene.over("axial")
        end = scene.pixel_in("axial", 0.1, 0.1)
        hand.drag(scene.pixel_in("axial", 0.0, 0.0), end, modifiers=hand.SHIFT)
        assert strokes() == [], strokes()
        expected = scene.tissue("axial", end)
        assert numpy.allclose(scene.position(), expected, atol=0.5), (scene.position(), expected)
        scene.display("axial").SlicePosition = [15.0, 29.0, 21.0]
        simple.RenderAllViews()


def what_the_mouse_does_is_told(scene):
    # The status line tells who has the wheel.
    scene.over("axial")
    hand.hover(scene.pixel_in("axial", 0.0, 0.0))
    for tool, word in ((hand.STAMP, "Page Up"), (hand.SOFT, "Wheel: next slice"),
                       (hand.MOVE, "within the slice"), (hand.NONE, "Ctrl+Wheel: zoom")):
        hand.take(tool)
        hand.hover(scene.pixel_in("axial", 0.01, 0.0))
        hand.wait()
        assert word in hand.label("BrainShiftStatus"), (word, hand.label("BrainShiftStatus"))
    scene.over("volume")
    hand.hover(scene.pixel_in("volume", 0.0, 0.0))
    hand.wait()
    assert hand.label("BrainShiftStatus") == "", hand.label("BrainShiftStatus")


def slices_in_3d(scene):
    # Seen obliquely, a drag still lies in the slice that was taken hold of.
    view = scene.views["volume"]
    display = scene.display("volume")
    display.SetRepresentationType("Deformed Slices")
    simple.SetActiveView(view)
    for parallel in (0, 1):
        view.CameraParallelProjection = parallel
        simple.Render(view)
        scene.over("volume")
        for tool in (hand.SOFT, hand.STAMP, hand.MOVE):
            in_each_plane_in_3d(scene, view, display, tool)
    view.CameraParallelProjection = 0
    display.SetRepresentationType("Deformed Volume")


def in_each_plane_in_3d(scene, view, display, tool):
    hand.take(tool)
    place = scene.position()
    for name, axis in SLICES.items():
        view.CameraFocalPoint = list(MIDDLE)
        view.CameraPosition = list(MIDDLE + numpy.array((0.5, -0.6, 0.7)) * 180)
        view.CameraViewUp = [0, 0, 1]
        view.CameraParallelScale = 40
        for plane in SLICES:
            setattr(display, f"Show{plane.capitalize()}", int(plane == name))
        simple.Render(view)
        hand.wait(50)
        start = numpy.array(place)
        start[(axis + 1) % 3] += 6.0
        start = numpy.round(start / SPACING) * SPACING if tool == hand.MOVE else start
        pixel = window.pixel_of(view, start)
        end = [pixel[0] + 12, pixel[1] + 17]
        hand.drag(pixel, end)
        assert len(strokes()) == 1, (tool, name, strokes())
        stroke = last()
        assert_in_slice(scene, name, stroke["vector"])
        pixel_mm = 1.0  # seen obliquely
        assert numpy.allclose(stroke["anchor"], start, atol=pixel_mm), (tool, name, stroke, start)
        if tool != hand.STAMP:
            there = window.pixel_of(view, stroke["anchor"] + stroke["vector"])
            assert numpy.allclose(there, end, atol=3.0), (tool, name, there, end)
        window.edit("Undo")
    for plane in SLICES:
        setattr(display, f"Show{plane.capitalize()}", 1)


def parallel_volume(scene):
    # Deformed Volume in a parallel view: soft follows the hand, millimetre by millimetre.
    view = scene.views["volume"]
    view.CameraParallelProjection = 1
    simple.Render(view)
    hand.wait(100)
    scene.over("volume")
    hand.take(hand.SOFT)
    start = scene.pixel_in("volume", 0.0, 0.0)
    tissue = scene.tissue("volume", start)
    assert tissue is not None
    hand.drag(start, [start[0] + 30, start[1] + 10])
    stroke = last()
    assert numpy.allclose(stroke["anchor"], tissue, atol=1e-4), (stroke, tissue)
    pixels = math.hypot(30, 10)
    millimetres = pixels * 2 * view.CameraParallelScale / view.ViewSize[1]
    length = numpy.linalg.norm(stroke["vector"])
    assert math.isclose(length, millimetres, rel_tol=1e-3), (length, millimetres)
    window.edit("Undo")


def radius_is_measured_along_the_lattice(scene):
    # In a volume turned by 45 degrees: its control points are 4 mm apart, not 5.7.
    share = math.sqrt(0.5)
    source = volume(numpy.ones((41, 41, 41), numpy.float32),
                    direction=(share, -share, 0, share, share, 0, 0, 0, 1))
    turned = simple.FreeFormDeformation(Input=source, LatticeDimensions=[11, 11, 11])
    simple.Show(turned, scene.views["volume"])
    simple.SetActiveSource(turned)
    simple.Render(scene.views["volume"])
    hand.take(hand.SOFT)
    for radius, warned in ((4.5, False), (3.5, True)):
        hand.setting("radius", radius)
        window.until(lambda warned=warned: bool(hand.label("BrainShiftWarning")) == warned,
                     f"a radius of {radius} mm is warned of: {warned}")
        text = hand.label("BrainShiftWarning")
        assert not warned or "4.0 mm" in text, text
    hand.take(hand.NONE)
    simple.Delete(turned)
    simple.SetActiveSource(scene.bent)
    hand.setting("radius", 20.0)


def what_compares_is_bent_too(scene):
    # Slices of what Compare Volumes makes of it: the tools bend what it is made of.
    compared = simple.CompareVolumes(Input=scene.bent, Reference=simple.Wavelet(
        WholeExtent=[0, 40, 0, 60, 0, 48], Center=[18, 30, 24]))
    view = scene.views["axial"]
    simple.Hide(scene.bent, view)
    display = simple.Show(compared, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    display.SlicePosition = list(scene.position())
    display.ShowSagittal = display.ShowCoronal = 0
    simple.Render(view)
    simple.SetActiveSource(compared)
    scene.over("axial")
    hand.take(hand.SOFT)
    start = scene.pixel_in("axial", 0.05, 0.05)
    hand.drag(start, [start[0] + 10, start[1] + 5])
    assert len(strokes()) == 1, strokes()
    assert_in_slice(scene, "axial", last()["vector"])
    window.edit("Undo")
    simple.Delete(compared)
    simple.Show(scene.bent, view)
    simple.SetActiveSource(scene.bent)


def play():
    scene = Scene()
    for step in (soft_in_each, others_follow, move_in_slice, far_points_stay_out_of_reach,
                 stamp_in_slice, next_slice_next_stroke, interest_in_slice,
                 slices_scroll_elsewhere, shift_drags_slices,
                 what_the_mouse_does_is_told, slices_in_3d, parallel_volume,
                 radius_is_measured_along_the_lattice, what_compares_is_bent_too):
        yield step, scene


if __name__ == "__main__":
    window.main("BendInSlices", play())
