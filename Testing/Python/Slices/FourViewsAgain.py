# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.four_views and show_comparison use the four views again that are there:
# no second layout, the same place and zoom; that all slices have one zoom; and that a comparison
# takes over colours, opacity and segment of the volume that it compares, in slices and in 3D.
import numpy
from brainshift_testing import ball, load_plugin, picture, run_tests, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    AssignViewToLayout, CompareVolumes, CreateLayout, CreateRenderView, CreateView, Delete,
    FreeFormDeformation, GetDisplayProperties, GetLayout, GetLayouts, GetViews, GetViewsInLayout,
    GetOpacityTransferFunction, SetActiveView, Show)

SLICES = ("axial", "coronal", "sagittal")
POSITION = [12.0, 18.0, 14.0]


def bent(side=33):
    return FreeFormDeformation(Input=volume(ball(side)))


def laid_out(source):
    SetActiveView(None)
    return brainshift.four_views(source)


def close(views):
    layout = GetLayout(views["axial"])
    for view in views.values():
        Delete(view)
    Delete(layout)


def shown_in(view):
    return [display.Input for display in view.Representations
            if getattr(display, "Visibility", 0) and hasattr(display, "Input")]


def assert_same_views(again, views):
    assert list(again) == list(views)
    assert all(again[name] == view for name, view in views.items()), "the same four views"


def test_slices_have_one_zoom():
    views = laid_out(bent())
    for number, name in enumerate(SLICES):
        views[name].CameraParallelScale = 10.0 + number
        for other in SLICES:
            assert views[other].CameraParallelScale == 10.0 + number, (name, other)
            camera = views[other].GetActiveCamera()
            assert camera.GetParallelScale() == 10.0 + number, (name, other)
    assert views["volume"].CameraParallelScale != 12.0
    Delete(views.pop("axial"))
    views["coronal"].CameraParallelScale = 7.0
    assert views["sagittal"].CameraParallelScale == 7.0, "after a view was closed"
    for view in views.values():
        Delete(view)


def test_the_same_volume_again_changes_nothing():
    source = bent()
    views = laid_out(source)
    layouts, count = len(GetLayouts()), len(GetViews())
    display = GetDisplayProperties(source, views["axial"])
    display.SlicePosition = POSITION
    grey = display.LookupTable
    grey.RescaleTransferFunction(10.0, 60.0)
    views["axial"].CameraParallelScale = 8.0
    before = {name: picture(view) for name, view in views.items()}
    for active in views.values():
        SetActiveView(active)
        assert_same_views(brainshift.four_views(source), views)
    elsewhere = CreateView("SpreadSheetView")  # no view to lay out
    AssignViewToLayout(elsewhere, CreateLayout("Elsewhere"))
    SetActiveView(elsewhere)
    assert_same_views(brainshift.four_views(source), views)
    assert len(GetLayouts()) == layouts + 1 and len(GetViews()) == count + 1, "no new tab or view"
    for name, view in views.items():
        assert (picture(view) == before[name]).all(), name
    layout = GetLayout(elsewhere)
    Delete(elsewhere)
    Delete(layout)
    close(views)


def test_another_convention_turns_the_views_that_are_there():
    source = bent()
    views = laid_out(source)
    towards = views["axial"].CameraPosition[2]
    assert_same_views(brainshift.four_views(source, "neurological"), views)
    assert (views["axial"].CameraPosition[2] - 16) * (towards - 16) < 0, "from the other side"
    close(views)


def test_another_volume_takes_the_place_of_the_first():
    first, second = bent(), bent(41)
    views = laid_out(first)
    views["axial"].CameraParallelScale = 8.0
    layouts = len(GetLayouts())
    assert_same_views(brainshift.four_views(second), views)
    assert len(GetLayouts()) == layouts
    for name, view in views.items():
        assert shown_in(view) == [second], name
    assert views["axial"].CameraParallelScale > 20.0, "all of a volume of another size is seen"
    assert list(GetDisplayProperties(second, views["axial"]).SlicePosition) == [20.0] * 3
    assert_same_views(brainshift.four_views(first), views)
    for name, view in views.items():
        assert shown_in(view) == [first], name
    close(views)


def test_a_comparison_is_seen_in_all_four_views():
    source = bent()
    views = laid_out(source)
    displays = {name: GetDisplayProperties(source, view) for name, view in views.items()}
    displays["axial"].SlicePosition = POSITION
    views["axial"].CameraParallelScale = 14.0
    displays["axial"].LookupTable.RescaleTransferFunction(10.0, 60.0)
    volume_display = displays["volume"]
    volume_display.DrawSegment = 0
    volume_display.Ambient = 0.4
    opacity = GetOpacityTransferFunction("Intensity", volume_display)
    opacity.Points = [0, 0, 0.5, 0, 50, 0, 0.5, 0, 51, 1, 0.5, 0, 100, 1, 0.5, 0]
    plain = {name: picture(view) for name, view in views.items()}
    # As the window does it: Apply shows the filter in the active view, in place of its input.
    compare = CompareVolumes(Input=source, Reference=volume(ball(33, center=(19, 16, 16))))
    for active in ("volume", "axial"):
        SetActiveView(views[active])
        Show(compare, views[active])
        displays[active].Visibility = 0
        brainshift.show_comparison(compare)
        assert all(shown_in(view) == [compare] for view in views.values()), active
        compared = {name: GetDisplayProperties(compare, view) for name, view in views.items()}
        for name in SLICES:
            assert compared[name].Representation == "Deformed Slices", name
            assert compared[name].SliceComparison == "Two colours", name
            assert list(compared[name].SlicePosition) == POSITION, name
            assert compared[name].LookupTable == displays[name].LookupTable, name
            assert compared[name].ShowCrosshair == 1
            shown = [plane for plane in SLICES
                     if getattr(compared[name], f"Show{plane.capitalize()}")]
            assert shown == [name], shown
        assert compared["volume"].Representation == "Deformed Volume"
        assert compared["volume"].DrawSegment == 0 and compared["volume"].Ambient == 0.4
        assert compared["volume"].ScalarOpacityFunction == volume_display.ScalarOpacityFunction
        assert compared["volume"].LookupTable == volume_display.LookupTable
        for name, view in views.items():
            image = picture(view)
            assert (image != plain[name]).any(axis=2).mean() > 0.005, name
            assert ((image[:, :, 0] > 0.2) & (image[:, :, 1] < 0.1)).any(), (name, "red")
        assert views["coronal"].CameraParallelScale == 14.0, "the zoom stays"
        compared["coronal"].SlicePosition = [1.0, 2.0, 3.0]
        assert list(compared["sagittal"].SlicePosition) == [1.0, 2.0, 3.0], "they are linked"
        compared["coronal"].SlicePosition = POSITION
        brainshift.four_views(source)  # and back
        assert all(shown_in(view) == [source] for view in views.values()), active
    Delete(compare)
    close(views)


def test_a_comparison_in_one_view_looks_like_its_volume():
    source = bent()
    view = CreateRenderView()
    SetActiveView(view)
    display = Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Volume")
    display.ColorArrayName = ["POINTS", "Intensity"]
    display.Ambient = 0.3
    display.DrawSegment = 0
    compare = CompareVolumes(Input=source, Reference=volume(ball()))
    shown = Show(compare, view)
    brainshift.show_comparison(compare)
    assert (shown.Representation, shown.Ambient, shown.DrawSegment) == ("Deformed Volume", 0.3, 0)
    assert shown.ColorArrayName[1] == "Intensity"
    assert numpy.isclose(shown.Ambient, 0.3)
    Delete(view)


run_tests(globals())
