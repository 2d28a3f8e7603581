# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Volume cuts away the tissue that a deformation takes into a cavity, as
# ParaView's "Volume" draws a baked volume without those voxels, in each blend mode and to the bit
# with and without skipping; that what is left of the tumour has its colour, in 3D and in slices,
# where numpy finds it through the map of the deformation; and that strokes move it at once.
import numpy
from brainshift_testing import (load_plugin, mean_difference, object_pixels, picture, run_tests,
                                show_volume, use_headlight, view_along, volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.maps import rest_from_deformed  # noqa: E402
from paraview.simple import (BakeDeformation, CompareVolumes, Delete,  # noqa: E402
                             FreeFormDeformation, GetDisplayProperties, Resection)
from segment_testing import (COLORS, MIDDLE, OPACITIES, SIDE, STROKES, places,  # noqa: E402
                             tissue)
from skipping_testing import assert_same  # noqa: E402

DIRECTION = (-0.6, 0.5, -1.0)
GREY = [0, 0.5, 0.5, 0.5, 100, 0.5, 0.5, 0.5]
BY_SCALAR = [0, 0, 0, 0, 60, 0, 0, 0, 100, 1, 1, 1]
MAXIMUM, ADDITIVE = 1, 4  # blend modes as VTK numbers them
ASIDE = (-4.0, 6.0, 0.0), 8.0  # middle and radius (mm) of a tumour that is half removed
FAR = 1.5  # mm from an edge: smoothed edges are nearer


def head(world):
    return numpy.linalg.norm((world - MIDDLE) / (1.1, 0.9, 1.0), axis=-1) < 19.0


def from_axis(world):
    """mm beyond the wall of a cavity that is open towards the eye; below 0: in it."""
    axis = -numpy.array(DIRECTION) / numpy.linalg.norm(DIRECTION)
    along = (world - MIDDLE) @ axis
    aside = numpy.linalg.norm(world - MIDDLE - along[..., None] * axis, axis=-1)
    deep = numpy.maximum(4.0 - along, 0.0)
    return numpy.hypot(aside, deep) - 8.0


def from_tumour(world, middle=(2.0, 0.0, 3.0), radius=12.0):
    """mm beyond the edge of the tumour, at rest."""
    return numpy.linalg.norm(world - numpy.add(MIDDLE, middle), axis=-1) - radius


def labels(inside):
    return volume(inside.astype(numpy.uint8))


def bent():
    return FreeFormDeformation(Input=volume(numpy.where(head(places()), tissue(), 0)),
                               Strokes=STROKES)


def resected(filter=None, **named):
    return Resection(Input=filter or bent(), Cavity=labels(from_axis(places()) < 0.0), **named)


def without_cavity(filter):
    """The bent volume as baked, without the voxels of the cavity."""
    baked = voxels(BakeDeformation(Input=filter, Interpolation="Cubic"))
    return volume(numpy.where(from_axis(places()) < 0.0, 0, baked).astype(numpy.float32))


def drawn(source, kind="Deformed Volume", opacities=OPACITIES, colors=COLORS, direction=DIRECTION,
          blend=0, **named):
    view = view_along(direction, MIDDLE, 110.0, half_height=24.0, size=140)
    use_headlight(view)
    show_volume(source, view, kind, colors, opacities, **named).BlendMode = blend
    image = picture(view)
    Delete(view)
    return image


def test_removed_tissue_is_not_drawn():
    thin = [0, 0, 0.5, 0, 25, 0, 0.5, 0, 40, 0.02, 0.5, 0, 100, 0.04, 0.5, 0]
    filter = bent()
    for what, limit, named in (
            ("translucent", 0.02, {"opacities": thin}),
            ("greatest", 0.02, {"blend": MAXIMUM, "colors": BY_SCALAR}),
            ("sum", 0.02, {"blend": ADDITIVE, "opacities": thin})):
        expected = drawn(without_cavity(filter), "Volume", **named)
        cut, whole = drawn(resected(filter), **named), drawn(filter, **named)
        difference, other = mean_difference(cut, expected), mean_difference(whole, expected)
        print(f"  {what}: differs by {100 * difference:.2f} %, uncut by {100 * other:.2f} %",
              flush=True)
        assert difference < limit, (what, difference)
        assert other > 3.0 * difference, (what, other)


def test_light_falls_on_the_wall():
    # The bottom of the cavity is a half ball of 8 mm. Its brightness is the cosine of its slope.
    image = drawn(resected(), shade=True)[..., 0]
    across = (numpy.arange(len(image)) + 0.5) * 48.0 / len(image) - 24.0
    aside = numpy.hypot(*numpy.meshgrid(across, across))
    bottom = aside < 6.0
    expected = numpy.sqrt(1.0 - (aside[bottom] / 8.0) ** 2)
    off = numpy.abs(image[bottom] / image[aside < 1.0].mean() - expected)
    print(f"  off by {off.mean():.3f} in the mean, {off.max():.3f} at most", flush=True)
    assert off.mean() < 0.06 and off.max() < 0.2


def test_skipping_changes_nothing():
    view = view_along(DIRECTION, MIDDLE, 110.0, size=140)
    display = show_volume(resected(Tumour=labels(from_tumour(places()) < 0.0)), view,
                          "Deformed Volume", COLORS, OPACITIES)
    assert_same(view, display, "with a cavity", least_share=0.1)


def first_tissue(filter, side):
    """For each pixel of a parallel view along z from above: the position (mm, deformed frame) of
    the first tissue that is not removed; not a number where there is none."""
    step = 2.0 * 24.0 / side
    across = (numpy.arange(side) + 0.5) * step - 24.0
    y, x = numpy.meshgrid(across + MIDDLE[1], across + MIDDLE[0], indexing="ij")
    first = numpy.full((side, side, 3), numpy.nan)
    for z in numpy.arange(46.0, 2.0, -0.5):
        place = numpy.stack([x, y, numpy.full_like(x, z)], -1)
        rest = rest_from_deformed(filter, place.reshape(-1, 3)).reshape(place.shape)
        meets = head(rest) & (from_axis(place) > 0.3) & numpy.isnan(first[..., 0])
        first[meets] = place[meets]
    return first


def near_a_rim(first):
    """Pixels at most two from one where the first tissue is elsewhere than at its neighbour."""
    depth = numpy.nan_to_num(first[..., 2], nan=-99.0)
    rim = numpy.zeros(depth.shape, bool)
    for axis in (0, 1):
        for by in (-1, 1):
            rim |= numpy.abs(depth - numpy.roll(depth, by, axis)) > 3.0
    return numpy.any([numpy.roll(rim, (down, right), (0, 1)) for down in range(-2, 3)
                      for right in range(-2, 3)], axis=0)


def test_the_tumour_that_is_left_has_its_colour():
    filter = bent()
    source = resected(filter, Tumour=labels(from_tumour(places()) < 0.0))
    opaque = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 21, 1, 0.5, 0, 100, 1, 0.5, 0]
    image = drawn(source, opacities=opaque, colors=GREY, direction=(0, 0, -1))
    first = first_tissue(filter, len(image))
    seen = ~numpy.isnan(first[..., 0])
    rest = rest_from_deformed(filter, numpy.where(seen[..., None], first, MIDDLE).reshape(-1, 3))
    beyond = from_tumour(rest).reshape(seen.shape)
    clear = seen & (numpy.abs(beyond) > FAR) & ~near_a_rim(first)
    red, blue = image[..., 0], image[..., 2]
    orange, grey = red > blue + 0.15, numpy.abs(red - blue) < 0.05
    left, other = clear & (beyond < 0.0), clear & (beyond > 0.0)
    print(f"  {left.sum()} pixels of tumour, {100 * orange[left].mean():.1f} % in its colour; "
          f"{other.sum()} of others, {100 * grey[other].mean():.1f} % grey", flush=True)
    assert left.sum() > 80 and other.sum() > 80
    assert orange[left].mean() > 0.97 and grey[other].mean() > 0.97


def slice_classes(source, filter):
    """A slice's picture, and where its pixels lie: mm beyond tumour, cavity and head."""
    view = view_along((0, 0, -1), MIDDLE, 110.0, half_height=24.0, size=140)
    display = show_volume(source, view, "Deformed Slices", GREY, OPACITIES)
    display.ShowSagittal = display.ShowCoronal = display.OrientationMarks = 0
    display.ShowCrosshair, display.SlicePosition = 0, [MIDDLE[0], MIDDLE[1], 26.0]
    image = picture(view)
    Delete(view)
    across = (numpy.arange(140) + 0.5) * 48.0 / 140 - 24.0
    y, x = numpy.meshgrid(across + MIDDLE[1], across + MIDDLE[0], indexing="ij")
    place = numpy.stack([x, y, numpy.full_like(x, 26.0)], -1)
    rest = rest_from_deformed(filter, place.reshape(-1, 3)).reshape(place.shape)
    inside = ((rest > 1.0) & (rest < SIDE - 2.0)).all(axis=-1)
    return image, from_tumour(rest, *ASIDE), from_axis(place), inside


def test_slices_show_what_is_left_and_what_was_removed():
    filter = bent()
    source = resected(filter, Tumour=labels(from_tumour(places(), *ASIDE) < 0.0))
    image, tumour, cavity, inside = slice_classes(source, filter)
    red, blue = image[..., 0], image[..., 2]
    clear = inside & (numpy.abs(tumour) > FAR) & (numpy.abs(cavity) > FAR)
    for what, where, is_so in (
            ("left", (tumour < 0) & (cavity > 0), red > blue + 0.15),
            ("removed tumour", (tumour < 0) & (cavity < 0), blue > red + 0.05),
            ("removed", (tumour > 0) & (cavity < 0), numpy.abs(red - 0.125) < 0.03),
            ("tissue", (tumour > 0) & (cavity > 0), numpy.abs(red - 0.5) < 0.03)):
        pixels = clear & where
        print(f"  {what}: {pixels.sum()} pixels, {100 * is_so[pixels].mean():.1f} % so", flush=True)
        assert pixels.sum() > 25, what
        assert is_so[pixels].mean() > 0.98, what


def test_strokes_move_the_tumour_at_once():
    filter = bent()
    source = resected(filter, Tumour=labels(from_tumour(places()) < 0.0))
    view = view_along(DIRECTION, MIDDLE, 110.0, half_height=24.0, size=140)
    show_volume(source, view, "Deformed Volume", COLORS, OPACITIES)
    picture(view)
    filter.Strokes = list(STROKES) + list(brainshift.soft((20, 20, 28), (-4, 3, 0), 12.0))
    moved = picture(view)
    fresh = drawn_alone(source, view)
    assert (moved == fresh).all(), numpy.abs(moved - fresh).max()


def drawn_alone(source, view):
    """The picture of a view, all of it cast anew."""
    display = GetDisplayProperties(source, view)
    display.KeepPicture = 0
    return picture(view)


def test_a_comparison_after_it_cuts_the_bent_volume_alone():
    filter = bent()
    source = resected(filter)
    reference = volume(numpy.where(head(places()), tissue(), 0))
    opaque = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 21, 1, 0.5, 0, 100, 1, 0.5, 0]
    cut = drawn(CompareVolumes(Input=source, Reference=reference), opacities=opaque)
    whole = drawn(CompareVolumes(Input=filter, Reference=reference), opacities=opaque)
    changed = numpy.abs(cut - whole).max(axis=2) > 0.1
    assert changed.any() and object_pixels(cut).sum() == object_pixels(whole).sum()
    greener = (cut[..., 1] > cut[..., 0] + 0.2) & changed
    print(f"  {changed.sum()} pixels changed, {greener.sum()} show the reference alone", flush=True)
    assert greener.sum() > 0.5 * changed.sum()


run_tests(globals())
