# SPDX-License-Identifier: BSD-3-Clause
# Proves that "Deformed Slices" works in a scene: among surfaces and volumes, moved, translucent,
# in several views, in selections and in screenshots. It follows the colour map, and does only
# what a change needs.
import os

import numpy
from brainshift_testing import (ball, load_plugin, look, object_pixels, output, picture, run_tests,
                                scratch, show_volume, view_along, volume)
from slices_testing import flat_view, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from counters_testing import Counted  # noqa: E402
from paraview.simple import (  # noqa: E402
    Delete, FreeFormDeformation, GetColorTransferFunction,
    GetOpacityTransferFunction, Hide, SaveScreenshot, Show, Sphere)
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkCollection  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
STROKE = brainshift.soft(MIDDLE, (2, 1, 0), 12)
LATTICE_BYTES = 19 ** 3 * 3 * 4
LEVEL = 1.0 / 255.0
ALL = ("Sagittal", "Coronal", "Axial")


def plain(value=50.0):
    """A volume of one value: a slice of it has one colour."""
    return volume(numpy.full((33, 33, 33), value, numpy.float32))


def bent_ball():
    return FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)


def red_sphere(view, center, radius=3.0):
    sphere = Sphere(Center=center, Radius=radius, ThetaResolution=48, PhiResolution=48)
    display = Show(sphere, view)
    display.AmbientColor = display.DiffuseColor = [1.0, 0.0, 0.0]
    display.SetPropertyWithName("DisableLighting", 1)
    return display


def red_pixels(image):
    return (image[:, :, 0] > 0.9) & (image[:, :, 1] < 0.1)


def test_depth_among_surfaces():
    # A sphere in front of the axial plane is seen, one behind it is not, and half of one that it
    # cuts is seen.
    for half_height in (None, 20.0):
        seen = {}
        for name, height in (("before", 22.0), ("cut", 16.0), ("behind", 10.0), ("alone", 22.0)):
            view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, half_height=half_height, size=200)
            red_sphere(view, (16.0, 16.0, height))
            if name != "alone":
                show_slices(plain(), view, ("Axial",), MIDDLE)
            seen[name] = red_pixels(picture(view)).sum()
            Delete(view)
        print(f"  {seen}", flush=True)
        assert seen["alone"] > 200
        assert seen["before"] == seen["alone"], seen
        assert 0.3 * seen["alone"] < seen["cut"] < 0.99 * seen["alone"], seen
        assert seen["behind"] == 0, seen


def test_deformed_volume_ends_at_slices():
    # The volume's rays stop at an opaque slice, whichever of the two was shown first.
    opaque = [0, 1, 0.5, 0, 100, 1, 0.5, 0]
    for slices_first in (True, False):
        view = view_along((0, 0, -1), MIDDLE, 90.0, half_height=20.0, size=100)
        shows = [lambda: show_slices(plain(), view, ("Axial",), MIDDLE),
                 lambda: show_volume(volume(ball(center=(16, 16, 8), radius=5.0)), view,
                                     "Deformed Volume", [0, 1, 0, 0, 100, 1, 0, 0],
                                     [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0])]
        for show in shows if slices_first else shows[::-1]:
            show()
        assert not red_pixels(picture(view)).any(), (slices_first, opaque)
        look(view, (0, 0, 1), MIDDLE, 90.0)
        assert red_pixels(picture(view)).sum() > 100, slices_first
        Delete(view)


def test_it_moves_with_its_actor():
    source = bent_ball()
    view = view_along((0.4, 0.3, -1), MIDDLE, 110.0, size=150)
    display = show_slices(source, view, ALL, MIDDLE)
    here = picture(view)
    shift = (9.0, -4.0, 6.0)
    display.Translation = shift
    assert (picture(view) != here).any()
    look(view, (0.4, 0.3, -1), numpy.add(MIDDLE, shift), 110.0)
    assert numpy.abs(picture(view) - here).max() <= 2 * LEVEL
    display.Translation = (0.0, 0.0, 0.0)
    display.Scale = (1.0, 2.0, 1.0)
    display.Origin = MIDDLE
    display.ShowSagittal = display.ShowCoronal = 0
    look(view, (0, 0, -1), MIDDLE, 110.0)
    stretched = object_pixels(picture(view))
    height, width = (numpy.ptp(numpy.flatnonzero(stretched.any(axis=axis))) for axis in (1, 0))
    assert 1.8 < height / width < 2.2, (height, width)
    Delete(view)


def test_see_through():
    # A plane of grey g at opacity a shows a g over black. Two of them show a g (1 + (1 - a)).
    view = flat_view(2, MIDDLE, 14.0, size=100)
    display = show_slices(plain(), view, ("Axial",), MIDDLE)
    grey = picture(view)[30, 30, 0]
    display.Opacity = 0.25
    once = picture(view)[30, 30, 0]
    assert abs(once - 0.25 * grey) <= LEVEL, (once, grey)
    display.ShowSagittal = 1
    look(view, (-1, 0, -1), MIDDLE, 100.0)
    twice = picture(view)[50, 40, 0]
    assert abs(twice - 0.25 * grey * 1.75) <= 2 * LEVEL, (twice, grey)
    red_sphere(view, (16.0, 16.0, 9.0), radius=2.0)
    behind = picture(view)
    assert ((behind[:, :, 0] > behind[:, :, 1] + 0.2) & ~red_pixels(behind)).any(), "seen through"
    Delete(view)


def test_the_nearer_plane_is_over_the_farther():
    # The order of drawing changes nothing. The volume is its own mirror image, so translucent
    # planes look alike from both sides.
    source = volume(ball(radius=12.0, edge=12.0))
    images = []
    for direction in ((1, 1, 1), (-1, 1, 1), (1, -1, 1), (1, 1, -1)):
        view = view_along(direction, MIDDLE, 90.0, up=(0, 0, 1), size=120)
        display = show_slices(source, view, ALL, MIDDLE)
        display.Opacity = 0.6
        images.append(picture(view))
        Delete(view)
    for image, mirrored in ((images[1], False), (images[2], False), (images[3], True)):
        other = image[::-1] if mirrored else image
        differing = numpy.abs(other - images[0]).mean()
        assert differing < 0.01, differing
    assert object_pixels(images[0]).mean() > 0.05


def test_opacity_map():
    ramp = numpy.broadcast_to(numpy.linspace(0, 100, 33, dtype=numpy.float32), (33, 33, 33)).copy()
    view = flat_view(2, MIDDLE, 14.0, size=100)
    display = show_slices(volume(ramp), view, ("Axial",), MIDDLE)
    given = picture(view)
    display.MapSliceOpacity = 1
    mapped = picture(view)
    assert numpy.abs(mapped - given ** 2).max() < 3 * LEVEL, "grey times opacity, of one ramp"
    opacity = GetOpacityTransferFunction("Intensity", display, separate=True)
    opacity.Points = [0, 0.5, 0.5, 0, 100, 0.5, 0.5, 0]
    assert numpy.abs(picture(view) - 0.5 * given).max() < 3 * LEVEL
    Delete(view)


class Drawn(Counted):
    """Slices of a bent ball on the screen."""

    def __init__(self):
        self.filter = bent_ball()
        view = view_along((0.3, 0.2, -1), MIDDLE, 100, size=150)
        super().__init__(view, show_slices(self.filter, view, ALL, MIDDLE))

    def did(self):
        """What a new picture, which must be another one, took."""
        last = self.image
        done = super().did()
        assert (self.image != last).any(), "nothing changed"
        return done


def test_only_what_changed_is_done_again():
    drawn = Drawn()
    assert drawn.before["volumeUploads"] == drawn.before["latticeUploads"] == 1, drawn.before
    drawn.display.SlicePosition = [15.0, 18.0, 13.0]
    assert drawn.did() == {}, "a moved slice"
    drawn.display.ShowCoronal = 0
    assert drawn.did() == {}, "a hidden plane"
    look(drawn.view, (1, -0.3, -1), MIDDLE, 90)
    assert drawn.did() == {}, "a moved camera"
    drawn.display.SliceInterpolation = "Cubic"
    assert drawn.did() == {}, "a filter"
    drawn.display.Opacity = 0.5
    assert drawn.did() == {}, "an opacity"
    drawn.filter.Strokes = brainshift.soft(MIDDLE, (3, 0, 0), 12)
    done = drawn.did()
    assert done.pop("latticeUploads") == 1 and done.pop("texelsRefined") > 0, done
    assert done.pop("bytesUploaded") == LATTICE_BYTES, done
    assert done == {}, "a stroke"
    color = GetColorTransferFunction("Intensity", drawn.display, separate=True)
    color.RGBPoints = [0, 1, 0, 0, 100, 0, 0, 1]
    done = drawn.did()
    assert done.pop("transferUploads") == 1 and set(done) == {"bytesUploaded"}, done
    assert not drawn.image[:, :, 1].any(), "red and blue only"
    gpu = brainshift.gpu(drawn.display)
    assert gpu["gpuScalarBytes"] == 33 ** 3 * 4 and gpu["gpuOtherBytes"] > LATTICE_BYTES, gpu


def test_two_views():
    source = bent_ball()
    alone = []
    for planes, direction in ((ALL, (0.3, 0.2, -1)), (("Coronal",), (0.2, -1, 0.1))):
        view = view_along(direction, MIDDLE, 90.0, up=(0, 0.5, 1), size=120)
        show_slices(source, view, planes, MIDDLE)
        alone.append(picture(view))
        Delete(view)
    views = [view_along(direction, MIDDLE, 90.0, up=(0, 0.5, 1), size=120)
             for direction in ((0.3, 0.2, -1), (0.2, -1, 0.1))]
    views[0].UseFXAA = 0  # a new view has turned it on, for all
    displays = [show_slices(source, view, planes, MIDDLE)
                for view, planes in zip(views, (ALL, ("Coronal",)))]
    for turn in range(2):
        for view, expected in zip(views, alone):
            assert (picture(view) == expected).all(), turn
    for display in displays:
        assert brainshift.counters(display)["volumeUploads"] == 1
    Delete(views[0])
    assert (picture(views[1]) == alone[1]).all(), "beside a closed view"
    Hide(source, views[1])
    assert not picture(views[1]).any(), "hidden"
    Show(source, views[1])
    assert (picture(views[1]) == alone[1]).all(), "shown again"
    Delete(views[1])


def test_another_representation_and_back():
    view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=120)
    display = show_slices(bent_ball(), view, ALL, MIDDLE)
    display.OrientationMarks = 1
    slices = picture(view)
    for other in ("Deformed Volume", "Outline", "Slice"):
        display.SetRepresentationType(other)
        assert (picture(view) != slices).any(), other
        display.SetRepresentationType("Deformed Slices")
        assert (picture(view) == slices).all(), other
    Delete(view)


def test_selections_end_at_slices():
    # The plane cuts a sphere. Cells in front of it are selected, and none if all are behind it.
    for opacity in (1.0, 0.5):
        selected = []
        for height in (30.0, 16.0, 8.0):
            view = flat_view(2, MIDDLE, 20.0, size=150)
            display = show_slices(plain(), view, ("Axial",), MIDDLE)
            display.Opacity = opacity
            sphere = Sphere(Center=(16.0, 16.0, height), Radius=5.0)
            Show(sphere, view)
            picture(view)
            representations, sources = vtkCollection(), vtkCollection()
            view.SMProxy.SelectSurfaceCells([0, 0, 149, 149], representations, sources, 0)
            selected.append(sources.GetNumberOfItems())
            Delete(view)
        assert selected == [1, 1, 0], (opacity, selected)


def test_a_slice_is_no_number_to_a_selection():
    # Selections draw numbers as colours. A dark red slice must not be taken for a number.
    view = flat_view(2, MIDDLE, 20.0, size=60)
    display = show_slices(plain(), view, ("Axial",), MIDDLE)
    Show(Sphere(Center=(16.0, 16.0, 8.0), Radius=5.0), view)
    for number in range(1, 6):
        color = GetColorTransferFunction("Intensity", display, separate=True)
        color.RGBPoints = [0, number / 255, 0, 0, 100, number / 255, 0, 0]
        picture(view)
        representations, sources = vtkCollection(), vtkCollection()
        view.SMProxy.SelectSurfaceCells([0, 0, 59, 59], representations, sources, 0)
        assert sources.GetNumberOfItems() == 0, number
    Delete(view)


def read_png(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3] / 255.0


def test_a_screenshot_larger_than_the_window():
    view = view_along((0.3, 0.2, -1), MIDDLE, 90.0, size=150)
    display = show_slices(bent_ball(), view, ALL, MIDDLE)
    for opacity in (1.0, 0.6):
        display.Opacity = opacity
        view.ViewSize = [150, 150]
        picture(view)
        SaveScreenshot(scratch("slices-tiles.png"), view, ImageResolution=[450, 450])
        tiled = read_png(scratch("slices-tiles.png"))
        os.remove(scratch("slices-tiles.png"))
        view.ViewSize = [450, 450]
        differing = (numpy.abs(tiled - picture(view)).max(axis=2) > 2 * LEVEL).mean()
        assert differing < 0.002, (opacity, differing)
    Delete(view)


def test_letters_at_the_edges():
    # No letter is in an oblique view, and those of an axial view are at the right place.
    source = plain(0.0)
    view = flat_view(2, MIDDLE, 30.0, size=200)
    display = show_slices(source, view, ("Axial",), MIDDLE)
    assert not picture(view).any()
    display.OrientationMarks, display.WorldAxes = 1, "RAS"
    rows, columns = numpy.nonzero(picture(view).max(axis=2) > 0.5)
    for near in (columns < 25, columns > 175, rows < 25, rows > 175):
        assert near.any(), "a letter at each edge"
    assert ((columns < 25) | (columns > 175) | (rows < 25) | (rows > 175)).all()
    look(view, (-1, -1, -1), MIDDLE, 200.0)
    assert not picture(view).any(), "an oblique view has no letters"
    look(view, (0, 0, -1), MIDDLE, 200.0)
    Hide(source, view)
    assert not picture(view).any(), "letters go with the slices"
    Delete(view)


def letters_at(image):
    """Whether something bright is at the left, right, lower and upper edge."""
    rows, columns = numpy.nonzero(image.max(axis=2) > 0.5)
    last = image.shape[0] - 1
    return [bool(near.any()) for near in (columns < 50, columns > last - 50,
                                          rows < 25, rows > last - 25)]


def test_an_oblique_grid_has_letters():
    # The nearest side is named, with the angle: on a view that is turned, and on a grid that is
    # tilted by more than what is called straight. The plane has its name, too.
    cosine, sine = numpy.cos(numpy.radians(40.0)), numpy.sin(numpy.radians(40.0))
    view = flat_view(2, MIDDLE, 30.0, size=300)
    upright = plain(0.0)
    display = show_slices(upright, view, ("Axial",), MIDDLE)
    display.OrientationMarks, display.WorldAxes = 1, "RAS"
    straight = picture(view)
    look(view, (0, 0, -1), MIDDLE, 200.0, up=(-sine, cosine, 0))
    turned = picture(view)
    assert letters_at(turned) == [True] * 4
    assert (turned > 0.5).sum() > 1.5 * (straight > 0.5).sum(), "the angle is written"
    view.CameraViewUp = [-0.02, 1.0, 0.0]
    assert (picture(view) == straight).all(), "1 degree is not worth a word"
    across = (0.0, sine, -cosine)  # the grid's last axis, towards the slice
    look(view, across, MIDDLE, 200.0, up=(0, cosine, sine))
    assert not picture(view).any(), "an oblique view of an upright grid has no letters"
    Hide(upright, view)
    tilted = volume(numpy.zeros((33, 33, 33), numpy.float32),
                    direction=(1, 0, 0, 0, cosine, -sine, 0, sine, cosine))
    bounds = output(tilted).GetBounds()
    middle = [sum(bounds[i:i + 2]) / 2 for i in (0, 2, 4)]
    display = show_slices(tilted, view, ("Axial",), middle)
    look(view, across, middle, 200.0, up=(0, cosine, sine))
    assert not picture(view).any()
    display.OrientationMarks, display.WorldAxes = 1, "RAS"
    found = picture(view)
    assert letters_at(found) == [True] * 4
    display.ShowCrosshair = 1
    found = picture(view)
    assert (found[-40:, :60, 0] > found[-40:, :60, 2] + 0.5).sum() > 50, "Axial, in orange"
    Delete(view)


def amber(image):
    """Pixels of the warning."""
    return ((image[:, :, 0] > 0.7) & (image[:, :, 2] < 0.4)).sum()


def test_sides_that_are_not_known_are_not_named():
    source = plain(0.0)
    view = flat_view(2, MIDDLE, 30.0, size=300)
    display = show_slices(source, view, ("Axial",), MIDDLE)
    display.OrientationMarks = 1
    unknown = picture(view)
    assert amber(unknown) > 100, "a warning"
    drawn = {}
    for axes in ("RAS", "LPS"):
        display.WorldAxes = axes
        drawn[axes] = picture(view)
        assert amber(drawn[axes]) == 0 and (drawn[axes] != unknown).any(), axes
    assert (drawn["RAS"] != drawn["LPS"]).any(), "left is right"
    display.Orientation = [0.0, 0.0, 180.0]
    assert (picture(view) == drawn["RAS"]).all(), "half a turn of the volume takes LPS to RAS"
    Delete(view)


def test_without_an_array_nothing_is_drawn():
    view = flat_view(2, MIDDLE, 20.0, size=100)
    display = show_slices(bent_ball(), view)
    assert picture(view).any()
    display.ColorArrayName = ["POINTS", ""]
    assert not picture(view).any()
    Delete(view)


def test_legends_leave_the_letters_free():
    """Also in the small views of a small window, one legend or two."""
    text = "red: before surgery (bent)\ngreen: US.nii (reference)\nyellow: both"
    view = flat_view(2, MIDDLE, 20.0)
    display = show_slices(plain(0.0), view, ("Axial",), MIDDLE)
    display.WorldAxes = "RAS"
    for evidence, size in ((0, (480, 360)), (0, (260, 160)), (1, (480, 360)), (1, (480, 190))):
        view.ViewSize = size
        shown = []
        for legend, marks in (("", 1), (text, 0)):
            display.SliceLegend, display.OrientationMarks = legend, marks
            display.ShowEvidence = evidence if legend else 0
            shown.append((picture(view) > 0.0).any(axis=2))
        letters, legends = shown
        assert letters.sum() > 100 and legends.sum() > 500, (size, letters.sum(), legends.sum())
        assert not (letters & legends).any(), (size, evidence)
        middle = size[0] // 2
        assert not evidence or not legends[:, middle - 4:middle + 4].any(), "two legends, apart"
    display.SliceLegend, display.ShowEvidence = "", 0
    Delete(view)


run_tests(globals())
