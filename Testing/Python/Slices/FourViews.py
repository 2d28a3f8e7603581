# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.four_views lays out axial, 3D, coronal and sagittal views of a volume
# with one slice position, and that each view looks from the side that its convention asks for.
import os

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, object_pixels, picture, run_tests,
                                scratch, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    AssignViewToLayout, ColorBy, CompareVolumes, CreateLayout, CreateRenderView, Delete,
    FreeFormDeformation, GetDisplayProperties, GetLayout, GetRenderViews, GetSources,
    GetViewsInLayout, LoadState, SaveState, SetActiveView, Show, Wavelet)

MIDDLE = (16.0, 16.0, 16.0)
SLICES = ("axial", "coronal", "sagittal")


def marked(direction=None):
    """A faint cube with bright spots towards right (+x), anterior (+y) and superior (+z)."""
    voxels = numpy.full((33, 33, 33), 20.0, numpy.float32)
    for axis in range(3):
        spot = [slice(13, 20)] * 3
        spot[2 - axis] = slice(26, 31)
        voxels[tuple(spot)] = 60.0 + 20.0 * axis
    return volume(voxels, direction=direction)


def placed(source):
    """The active view, alone in a layout of its own, as ParaView's window has it at first."""
    view = view_along((0, 0, -1), MIDDLE, 100.0, size=200)
    AssignViewToLayout(view, CreateLayout("Window"))
    Show(source, view)
    SetActiveView(view)
    return view


def displays_of(source, views):
    return {name: GetDisplayProperties(source, view) for name, view in views.items()}


def test_four_views_go_on_with_what_the_active_view_compares():
    compare = CompareVolumes(Input=FreeFormDeformation(Input=marked()), Reference=marked())
    for kind, own, wanted in (("Deformed Volume", {}, "Two colours"),
                              ("Deformed Volume", {"VolumeComparison": "Off"}, "None"),
                              ("Deformed Slices", {"SliceComparison": "Wipe"}, "Wipe"),
                              ("Deformed Slices", {"ShowEvidence": 1}, "None")):
        view = placed(compare)
        display = GetDisplayProperties(compare, view)
        display.SetRepresentationType(kind)
        for name, value in own.items():
            setattr(display, name, value)
        views = brainshift.four_views(compare)
        shown = displays_of(compare, views)
        for name in SLICES:
            assert shown[name].SliceComparison == wanted, (
                kind, own, name, str(shown[name].SliceComparison))
        for name in (*SLICES, "volume"):
            assert shown[name].ShowEvidence == own.get("ShowEvidence", 0), (own, name)
        close(views)


def test_the_camera_of_another_volume():
    """It is seen whole in 3D, too, where four views are used again."""
    views = brainshift.four_views(FreeFormDeformation(Input=marked()))
    small = volume(ball(9, 3.0), origin=(300.0, 200.0, 100.0))
    brainshift.four_views(small)
    camera = views["volume"].GetActiveCamera()
    middle = numpy.array((304.0, 204.0, 104.0))
    assert numpy.allclose(camera.GetFocalPoint(), middle, atol=1.0), camera.GetFocalPoint()
    distance = numpy.linalg.norm(numpy.subtract(camera.GetPosition(), middle))
    assert 10.0 < distance < 80.0, distance
    close(views)


def close(views):
    for view in views.values():
        Delete(view)


def test_the_active_view_becomes_one_of_four():
    source = FreeFormDeformation(Input=marked())
    before = placed(source)
    layout = GetLayout(before)
    views = brainshift.four_views(source)
    assert list(views) == [*SLICES, "volume"]
    assert views["volume"] == before and len(GetViewsInLayout(layout)) == 4
    for name, display in displays_of(source, views).items():
        if name == "volume":
            assert display.Representation != "Deformed Slices", display.Representation
            continue
        assert display.Representation == "Deformed Slices", (name, display.Representation)
        shown = {plane: getattr(display, f"Show{plane.capitalize()}") for plane in SLICES}
        assert shown == {plane: int(plane == name) for plane in SLICES}, (name, shown)
        assert views[name].InteractionMode == "2D" and views[name].CameraParallelProjection == 1
        assert display.OrientationMarks == 1 and display.ShowCrosshair == 1
        assert list(display.SlicePosition) == list(MIDDLE), display.SlicePosition
    close(views)


def test_the_3d_view_shows_a_volume_that_had_no_colours():
    source = FreeFormDeformation(Input=marked())
    SetActiveView(None)
    views = brainshift.four_views(source)
    display = GetDisplayProperties(source, views["volume"])
    assert display.Representation == "Deformed Volume", display.Representation
    view = views["volume"]
    view.ViewSize = [200, 200]
    view.OrientationAxesVisibility = view.CenterAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [0.0, 0.0, 0.0]
    assert object_pixels(picture(view)).mean() > 0.05, "an empty 3D view"
    close(views)


def test_a_view_with_neighbours_keeps_its_place():
    source = FreeFormDeformation(Input=marked())
    first = placed(source)
    layout = GetLayout(first)
    second = CreateRenderView()
    layout.AssignView(layout.SplitHorizontal(0, 0.5) + 1, second)
    SetActiveView(first)
    views = brainshift.four_views(source)
    assert first not in views.values() and GetLayout(first) == layout
    assert len(GetViewsInLayout(layout)) == 2
    assert len(GetViewsInLayout(GetLayout(views["axial"]))) == 4
    close({**views, "first": first, "second": second})


#: Axis (x, y, z) whose spot each view shows at the right, left, upper and lower edge.
EDGES = {"radiological": {"axial": (None, 0, 1, None), "coronal": (None, 0, 2, None),
                          "sagittal": (None, 1, 2, None)},
         "neurological": {"axial": (0, None, 1, None), "coronal": (0, None, 2, None),
                          "sagittal": (None, 1, 2, None)}}


def spot_at_edges(image):
    """Which spot is between the middle and each edge: right, left, upper, lower."""
    grey = image[:, :, 1]
    side = grey.shape[0]
    middle = slice(2 * side // 5, 3 * side // 5)
    lower, upper = slice(0, 3 * side // 8), slice(5 * side // 8, side)
    found = []
    for part in (grey[middle, upper], grey[middle, lower], grey[upper, middle],
                 grey[lower, middle]):
        brightest = part.max()
        found.append(int(numpy.rint((brightest * 100 - 60) / 20)) if brightest > 0.5 else None)
    return tuple(found)


def test_conventions():
    # Voxels may run along other axes. The axes of the world count, not those of the voxels.
    for direction in (None, (0, 1, 0, 0, 0, 1, 1, 0, 0), (-1, 0, 0, 0, -1, 0, 0, 0, 1)):
        for convention, edges in EDGES.items():
            source = FreeFormDeformation(Input=marked(direction))
            placed(source)
            views = brainshift.four_views(source, convention)
            for name, expected in edges.items():
                view = views[name]
                view.ViewSize = [200, 200]
                display = GetDisplayProperties(source, view)
                display.OrientationMarks = display.ShowCrosshair = 0
                display.LookupTable.RGBPoints = [0, 0, 0, 0, 100, 1, 1, 1]
                if direction is None:
                    found = spot_at_edges(picture(view))
                    assert found == expected, (convention, name, found, expected)
                else:
                    assert object_pixels(picture(view)).mean() > 0.2, (convention, name)
            close(views)


#: The spots towards +x, +y and +z in an LPS world: left, posterior and superior.
LPS_EDGES = {"axial": (0, None, None, 1), "coronal": (0, None, 2, None),
             "sagittal": (1, None, 2, None)}


def test_an_lps_world_is_turned():
    source = FreeFormDeformation(Input=marked())
    placed(source)
    views = brainshift.four_views(source, world="LPS")
    for name, expected in LPS_EDGES.items():
        view = views[name]
        view.ViewSize = [200, 200]
        display = GetDisplayProperties(source, view)
        assert display.WorldAxes == "LPS", display.WorldAxes
        display.OrientationMarks = display.ShowCrosshair = 0
        display.LookupTable.RGBPoints = [0, 0, 0, 0, 100, 1, 1, 1]
        found = spot_at_edges(picture(view))
        assert found == expected, (name, found, expected)
    close(views)


def test_slices_are_linked():
    source = FreeFormDeformation(Input=marked())
    placed(source)
    views = brainshift.four_views(source)
    displays = displays_of(source, views)
    for number, name in enumerate(views):
        position = [10.0 + number, 12.0, 20.0 - number]
        displays[name].SlicePosition = position
        for other, display in displays.items():
            assert list(display.SlicePosition) == position, (name, other, display.SlicePosition)
    displays["sagittal"].SliceComparison = "Wipe"
    displays["axial"].WipePosition = [3.0, 4.0, 5.0]
    for name, display in displays.items():
        assert display.SliceComparison == "Wipe", name
        assert list(display.WipePosition) == [3.0, 4.0, 5.0], name
    display = None
    del displays["axial"]  # what Python holds, ParaView keeps
    close({"axial": views.pop("axial")})
    displays["coronal"].SlicePosition = [1.0, 2.0, 3.0]
    assert list(displays["sagittal"].SlicePosition) == [1.0, 2.0, 3.0], "after a view was closed"
    SaveState(scratch("closed-view.pvsm"))
    os.remove(scratch("closed-view.pvsm"))
    close(views)


def test_slices_share_a_grey_map():
    source = FreeFormDeformation(Input=marked())
    view = placed(source)
    ColorBy(GetDisplayProperties(source, view), ("POINTS", "Intensity"))
    views = brainshift.four_views(source, world="RAS")  # no amber warning
    displays = displays_of(source, views)
    grey = displays["axial"].LookupTable
    assert displays["coronal"].LookupTable == displays["sagittal"].LookupTable == grey
    assert displays["volume"].LookupTable != grey
    for name in SLICES:
        displays[name].ShowCrosshair = 0
    image = picture(views["coronal"])
    assert (image[:, :, 0] == image[:, :, 2]).all() and image.any(), "grey"
    grey.RGBPoints = [0, 1, 0, 0, 100, 1, 0, 0]
    for name in SLICES:
        displays[name].OrientationMarks = 0
        red = picture(views[name])
        assert red[:, :, 0].any() and not red[:, :, 1].any(), name
    close(views)


def test_a_state_file_keeps_the_link():
    for source in GetSources().values():
        Delete(source)
    source = FreeFormDeformation(Input=Wavelet(WholeExtent=[-8, 8, -8, 8, -8, 8]))
    views = brainshift.four_views(source)
    state = scratch("four-views.pvsm")
    SaveState(state)
    close(views)
    LoadState(state)
    os.remove(state)
    displays = [display for view in GetRenderViews() for display in view.Representations
                if getattr(display, "Representation", None) == "Deformed Slices"]
    assert len(displays) == 3, displays
    displays[0].SlicePosition = [1.0, 2.0, 3.0]
    for display in displays:
        assert list(display.SlicePosition) == [1.0, 2.0, 3.0], display.SlicePosition


def test_errors_name_the_thing():
    source = FreeFormDeformation(Input=volume(ball()))
    try:
        brainshift.four_views(source, "surgical")
        raise AssertionError("an unknown convention passed")
    except ValueError as error:
        assert_says(str(error), "convention", "surgical", "radiological", "neurological")
    try:
        brainshift.four_views(source, world="XYZ")
        raise AssertionError("an unknown world passed")
    except ValueError as error:
        assert_says(str(error), "world is XYZ", "RAS or LPS")


run_tests(globals())
