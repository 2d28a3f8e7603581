# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Volume is drawn correctly in every view that shows it: two at once, hidden
# and shown, closed and opened, in a screenshot larger than the window, and for both eyes.
# ParaView's smoothing of edges is left out where it would change nothing.
import os

import numpy
from brainshift_testing import (ball, load_plugin, picture, run_tests, scratch, show_volume,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    Delete, FreeFormDeformation, Hide, SaveScreenshot, Show, Sphere)
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 0, 1, 50, 0, 1, 0, 100, 1, 0, 0]
OPAQUE = [0, 0, 0.5, 0, 49, 0, 0.5, 0, 51, 1, 0.5, 0, 100, 1, 0.5, 0]
TRANSLUCENT = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.1, 0.5, 0]

NOT_COUNTED = {"frames": 0, "pixelsCast": 0}


def bent_ball():
    return FreeFormDeformation(
        Input=volume(ball()), Strokes=brainshift.soft((16, 20, 20), (3, 2, 0), 14))


def opaque_view(source, size=150):
    view = view_along((-0.5, 0.3, -1), MIDDLE, 80.0, size=size)
    return view, show_volume(source, view, "Deformed Volume", COLORS, OPAQUE, shade=True)


def translucent_view(source, size=110):
    view = view_along((1, 0.2, 0.1), MIDDLE, 90.0, half_height=14.0, size=size)
    display = show_volume(source, view, "Deformed Volume", COLORS, TRANSLUCENT)
    display.SampleDistance = 0.7
    display.EmptySpaceSkipping = 0
    return view, display


def assert_same(image, expected, what):
    assert image.shape == expected.shape, (what, image.shape, expected.shape)
    differing = int((image != expected).any(axis=2).sum())
    assert differing == 0, (what, differing, float(numpy.abs(image - expected).max()))


def alone(make):
    """What a view shows that was never beside another."""
    view, _ = make(bent_ball())
    image = picture(view)
    assert (image.max(axis=2) > 0.02).mean() > 0.1
    Delete(view)
    return image


def test_two_views_of_one_volume():
    expected = alone(opaque_view), alone(translucent_view)
    source = bent_ball()
    views = opaque_view(source), translucent_view(source)

    def draw_in_turn(what):
        for (view, _), image in zip(views, expected):
            assert_same(picture(view), image, what)
        return [brainshift.counters(display) for _, display in views]

    before = draw_in_turn("first")
    for now, then in zip(draw_in_turn("second"), before):
        assert now["volumeUploads"] == 1, now
        assert {**now, **NOT_COUNTED} == {**then, **NOT_COUNTED}, (now, then)
    source.Strength = 0.0
    for (view, _), image in zip(views, expected):
        assert (picture(view) != image).any(), "a view did not follow"
    source.Strength = 1.0
    draw_in_turn("bent again")


def test_a_closed_view_takes_nothing_along():
    expected = alone(opaque_view), alone(translucent_view)
    source = bent_ball()
    (first, _), (second, _) = opaque_view(source), translucent_view(source)
    picture(first)
    picture(second)
    Delete(first)
    assert_same(picture(second), expected[1], "beside a closed view")
    third, _ = opaque_view(source)
    assert_same(picture(third), expected[0], "in a new view")
    Delete(second)
    assert_same(picture(third), expected[0], "alone again")


def test_hidden_and_shown_again():
    source = bent_ball()
    view, display = opaque_view(source)
    shown = picture(view)
    before = brainshift.counters(display)
    Hide(source, view)
    assert not picture(view).any(), "it is still seen"
    assert brainshift.counters(display) == before, "hidden, it is still drawn"
    Show(source, view)
    assert_same(picture(view), shown, "shown again")
    after = brainshift.counters(display)
    assert {**after, **NOT_COUNTED} == {**before, **NOT_COUNTED}, (after, before)


def test_another_representation_and_back():
    view, display = opaque_view(bent_ball())
    shown = picture(view)
    display.SetRepresentationType("Outline")
    assert (picture(view) != shown).any()
    display.SetRepresentationType("Deformed Volume")
    assert_same(picture(view), shown, "after the outline")


def read_png(name):
    reader = vtkPNGReader()
    reader.SetFileName(name)
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3] / 255.0


def test_a_screenshot_larger_than_the_window():
    # ParaView draws it tile by tile. A sphere stands half inside the tissue.
    source = bent_ball()
    for make in (opaque_view, translucent_view):
        view, display = make(source, size=150)
        Show(Sphere(Center=(22, 20, 22), Radius=5.0), view)
        picture(view)
        places = [(x, y) for x in range(5, 150, 20) for y in range(5, 150, 20)]
        picked = [brainshift.pick(display, view, *place) for place in places]
        SaveScreenshot(scratch("tiles.png"), view, ImageResolution=[450, 450])
        tiled = read_png(scratch("tiles.png"))
        again = [brainshift.pick(display, view, *place) for place in places]
        assert again == picked, "the screenshot's tiles are picked in"
        os.remove(scratch("tiles.png"))
        view.ViewSize = [450, 450]
        large = picture(view)
        differing = int((tiled != large).any(axis=2).sum())
        largest = numpy.abs(tiled - large).max()
        print(f"  {differing} pixels differ, by at most {255 * largest:.0f} levels", flush=True)
        assert tiled.shape == large.shape
        # The matrices of tiles are rounded, so a silhouette may fall on the next pixel.
        assert numpy.abs(tiled - large).mean() < 1e-4, numpy.abs(tiled - large).mean()
        assert differing < 0.002 * 450 * 450, differing
        Delete(view)


def middles(image):
    """Mean column of the red and of the blue picture."""
    columns = numpy.arange(image.shape[1])
    return [float((image[:, :, color] * columns).sum() / image[:, :, color].sum())
            for color in (0, 2)]


def test_both_eyes():
    # A white ball in front of the plane of the screen, and a white sphere of that size
    # that ParaView draws. VTK's own volumes are three times too far apart for the two eyes.
    found = {}
    for stereo in (False, True):
        for kind in ("Deformed Volume", "sphere"):
            view = view_along((-0.5, 0.3, -1), (16, 16, 0), 90.0, size=200)
            if kind == "sphere":
                display = Show(
                    Sphere(Center=MIDDLE, Radius=9.0, ThetaResolution=64, PhiResolution=64), view)
                display.AmbientColor = display.DiffuseColor = [1.0, 1.0, 1.0]
                display.Ambient, display.Diffuse, display.Specular = 1.0, 0.0, 0.0
            else:
                show_volume(volume(ball()), view, kind, [0, 1, 1, 1, 100, 1, 1, 1], OPAQUE)
            if stereo:
                view.StereoRender = 1
                view.StereoType = "Red-Blue"
            found[stereo, kind] = middles(picture(view))
            Delete(view)
    print(f"  {found}", flush=True)
    left, right = found[True, "Deformed Volume"]
    middle, _ = found[False, "Deformed Volume"]
    assert left - middle > 1.0 and middle - right > 1.0, (left, middle, right)
    for stereo in (False, True):
        for ours, sphere in zip(found[stereo, "Deformed Volume"], found[stereo, "sphere"]):
            assert abs(ours - sphere) < 0.05, found


def smooths(view):
    """Whether edges are smoothed in a picture of the view; asked while it is drawn."""
    renderer, asked = view.GetRenderer(), []
    watch = renderer.AddObserver("StartEvent", lambda *_: asked.append(renderer.GetUseFXAA()), -1.0)
    picture(view)
    renderer.RemoveObserver(watch)
    assert renderer.GetUseFXAA(), "it was not put back"
    assert len(set(asked)) == 1, asked
    return bool(asked[0])


def test_edges_are_smoothed_where_there_are_any():
    # VTK smooths before it draws volumes.
    source = bent_ball()
    view, display = opaque_view(source)
    view.UseFXAA = 1  # as in ParaView's window
    assert not smooths(view), "for a volume alone"
    alone = picture(view)
    sphere = Sphere(Center=(30, 20, 22), Radius=9.0)
    Show(sphere, view)
    assert smooths(view), "not for a sphere"
    smooth = picture(view)
    view.UseFXAA = 0
    assert (picture(view) != smooth).any(), "nothing was smoothed"
    view.UseFXAA = 1
    Hide(sphere, view)
    Show(Sphere(Center=MIDDLE, Radius=0.1), view)  # hidden by tissue
    assert smooths(view)
    assert_same(picture(view), alone, "smoothed without need")
    Hide(source, view)
    assert smooths(view), "hidden, the volume still has a say"


run_tests(globals())
