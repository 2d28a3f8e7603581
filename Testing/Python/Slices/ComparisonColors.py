# SPDX-License-Identifier: BSD-3-Clause
# Proves that comparisons are drawn in blue and orange instead of red and green, in slices and in
# 3D, as the baked volume and the voxels of the reference say. Agreement is grey. The colour-blind
# can tell the colours apart. A setting of the application chooses for all displays that were given
# no colours; a state file keeps what a display was given.
import itertools

import numpy
from brainshift_testing import (ball, load_plugin, object_pixels, picture, run_tests, scratch,
                                show_volume, use_headlight, view_along, volume)
from paraview import servermanager, simple
from slices_testing import color_grey, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from compare_testing import Pair, compared_picture  # noqa: E402
from paraview.simple import CompareVolumes, Delete, FreeFormDeformation  # noqa: E402

BLUE, ORANGE = numpy.array((0.0, 0.5, 1.0)), numpy.array((1.0, 0.5, 0.0))
LEVEL = 1.0 / 255.0
BAKED = 0.01  # mean difference from a baked volume, of full scale; ten times that at most
WHITE = [0, 1, 1, 1, 100, 1, 1, 1]
OPAQUE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]

#: What the colour-blind see of linear red, green and blue: Vienot, Brettel and Mollon, 1999.
EYES = {"protanope": ((0.11238, 0.88762, 0), (0.11238, 0.88762, 0), (0.00401, -0.00401, 1)),
        "deuteranope": ((0.29275, 0.70725, 0), (0.29275, 0.70725, 0), (-0.02234, 0.02234, 1))}


# In the window, ParaView does this when it loads a plugin.
servermanager.ParaViewPipelineController().UpdateSettingsProxies(
    servermanager.ActiveConnection.Session)


def setting():
    return servermanager.ProxyManager().GetProxy("settings", "BrainShiftSettings")


def choose_for_all(colors):
    setting().GetProperty("ComparisonColors").SetElement(0, colors)
    setting().UpdateVTKObjects()


def assert_like(image, expected, where):
    apart = numpy.abs(image - expected)[where]
    assert apart.mean() < BAKED and apart.max() < 10 * BAKED, (apart.mean(), apart.max())


def test_slices_are_blue_and_orange():
    pair = Pair()
    own, (share, inside) = pair.baked_share(), pair.expected()
    both = compared_picture(pair.compare, "Two colours", ComparisonColors="Blue and orange")
    assert_like(both, own[:, :, None] * BLUE + share[:, :, None] * ORANGE, inside)
    green = compared_picture(pair.compare, "Gradient")
    orange = compared_picture(pair.compare, "Gradient", ComparisonColors="Blue and orange")
    full = (green[:, :, 1] - green[:, :, 0])[:, :, None]  # share of the gradient's colour
    assert 0.02 < full.mean() < 0.95, full.mean()
    assert numpy.abs(orange - (green[:, :, :1] + full * ORANGE)).max() <= 3 * LEVEL
    difference = compared_picture(pair.compare, "Difference", ComparisonColors="Blue and orange")
    assert (difference == compared_picture(pair.compare, "Difference")).all(), "it has no colours"


def new_view():
    view = view_along((0.3, 0.2, -1), (16, 16, 16), 90.0, half_height=20.0, size=150)
    use_headlight(view)
    return view


def two_balls():
    """A bent ball, and another one beside it that it overlaps."""
    bent = FreeFormDeformation(Input=volume(ball(center=(13, 16, 16), radius=8.0)),
                               Strokes=brainshift.soft((13, 16, 22), (0, 2, 3), 12))
    return CompareVolumes(Input=bent, Reference=volume(ball(center=(19, 16, 16), radius=8.0)))


def test_the_volume_is_blue_and_orange():
    """In 3D, too: what was red is blue, what was green is orange."""
    view = new_view()
    display = show_volume(two_balls(), view, "Deformed Volume", WHITE, OPAQUE, shade=True)
    red_green = picture(view)
    display.ComparisonColors = "Blue and orange"
    image = picture(view)
    expected = red_green[:, :, :1] * BLUE + red_green[:, :, 1:2] * ORANGE
    assert numpy.abs(image - expected).max() <= 2 * LEVEL, numpy.abs(image - expected).max()
    for one in (0, 1):
        only = red_green[:, :, one] > red_green[:, :, 1 - one] + 0.3
        assert only.sum() > 50, "both stand out somewhere"
    display.ComparisonColors = "Red and green"
    assert (picture(view) == red_green).all()
    Delete(view)


def test_a_kept_picture_is_drawn_anew():
    view = new_view()
    display = show_volume(two_balls(), view, "Deformed Volume", WHITE, OPAQUE, shade=True)
    display.KeepPicture = 1
    former = picture(view)
    display.ComparisonColors = "Blue and orange"
    assert (picture(view) != former).any()
    Delete(view)


def test_agreement_is_grey():
    own = volume(ball(radius=9.0))
    compare = CompareVolumes(Input=own, Reference=volume(ball(radius=9.0)))
    sliced = compared_picture(compare, "Two colours", ComparisonColors="Blue and orange")
    view = new_view()
    display = show_volume(compare, view, "Deformed Volume", WHITE, OPAQUE, shade=True)
    display.ComparisonColors = "Blue and orange"
    for image in (sliced, picture(view)):
        assert object_pixels(image).sum() > 500
        assert numpy.ptp(image, axis=2).max() <= 2 * LEVEL, numpy.ptp(image, axis=2).max()
    display.VolumeComparison, display.AmbientOcclusion = "Off", 0.0
    alone = picture(view)
    display.VolumeComparison = "Two colours"
    apart = numpy.abs(picture(view) - alone).max()
    assert apart <= 4 * LEVEL, apart  # as bright as alone: 2 levels of each colour
    Delete(view)


def test_the_colour_blind_tell_them_apart():
    colors = {"red and green": numpy.array(((1.0, 0, 0), (0, 1.0, 0))),
              "blue and orange": numpy.array((BLUE, ORANGE))}
    for kind, eye in EYES.items():
        hues = {}
        for name, pair in colors.items():
            seen = pair ** 2.2 @ numpy.array(eye).T
            hues[name] = seen / seen.sum(axis=1, keepdims=True)  # without brightness
        apart = {name: numpy.abs(hue[0] - hue[1]).max() for name, hue in hues.items()}
        print(f"  {kind}: {apart}", flush=True)
        assert apart["red and green"] < 0.1 and apart["blue and orange"] > 0.5, (kind, apart)


def display_in_new_view(compare):
    view = new_view()
    return show_volume(compare, view, "Deformed Volume", WHITE, OPAQUE, shade=True), view


def test_one_setting_chooses_for_all():
    compare = two_balls()
    displays = [display_in_new_view(compare)[0] for _ in range(3)]
    displays[0].ComparisonColors = "Red and green"  # as it is: nobody chose
    displays[1].Representation = "Deformed Slices"
    displays[2].ComparisonColors = "Blue and orange"
    displays[2].ComparisonColors = "Red and green"  # chosen
    try:
        choose_for_all(1)
        assert [display.ComparisonColors for display in displays] == [
            "Blue and orange", "Blue and orange", "Red and green"]
        later, view = display_in_new_view(compare)
        assert later.ComparisonColors == "Blue and orange", "displays that are made later"
        image = picture(view)
        assert image[:, :, 2].any(), "it reaches the mapper"
    finally:
        choose_for_all(0)
    assert later.ComparisonColors == "Red and green"
    assert not picture(view)[:, :, 2].any()
    simple.ResetSession()
    load_plugin()


def test_four_views_have_one_choice():
    compare = two_balls()
    simple.Show(compare, simple.GetActiveViewOrCreate("RenderView"))
    views = brainshift.four_views(compare)
    displays = [simple.GetDisplayProperties(compare, view) for view in views.values()]
    choose_for_all(1)
    assert {display.ComparisonColors.GetData() for display in displays} == {"Blue and orange"}
    choose_for_all(0)
    assert {display.ComparisonColors.GetData() for display in displays} == {"Red and green"}
    for chosen, other in itertools.permutations((0, 3), 2):
        for colors in ("Blue and orange", "Red and green"):
            displays[chosen].ComparisonColors = colors
            assert displays[other].ComparisonColors == colors, (chosen, other)
    simple.ResetSession()
    load_plugin()


def test_a_state_file_keeps_what_was_chosen():
    wavelet = simple.Wavelet()
    bent = FreeFormDeformation(Input=wavelet, Strokes=brainshift.soft((0, 0, 0), (3, 0, 0), 9))
    compare = CompareVolumes(registrationName="compared", Input=bent, Reference=wavelet)
    views = [view_along((0, 0, -1), (0, 0, 0), 60, half_height=9) for _ in range(2)]
    chosen, followed = (show_slices(compare, view, ("Axial",), (0, 0, 0.5)) for view in views)
    for display, view in zip((chosen, followed), views):
        color_grey(display, view, 40, 280, "RTData")
        display.SliceComparison = "Two colours"
    chosen.ComparisonColors = "Blue and orange"
    before = [picture(view) for view in views]
    assert before[0][:, :, 2].any() and not before[1][:, :, 2].any()
    name = scratch("ComparisonColors.pvsm")
    simple.SaveState(name)
    simple.ResetSession()
    load_plugin()
    simple.LoadState(name)
    source = simple.FindSource("compared")
    after = {}
    for view in simple.GetRenderViews():
        view.UseFXAA = 0
        after[simple.GetDisplayProperties(source, view).ComparisonColors.GetData()] = picture(view)
    assert sorted(after) == ["Blue and orange", "Red and green"], sorted(after)
    assert (after["Blue and orange"] == before[0]).all()
    assert (after["Red and green"] == before[1]).all()


run_tests(globals())
