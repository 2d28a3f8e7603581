# SPDX-License-Identifier: BSD-3-Clause
# Proves that each blend mode shows a bent volume as ParaView's "Volume" shows the baked volume in
# that mode. Empty-space skipping changes no bit of the picture.
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete  # noqa: E402
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from stock_testing import (COLORS, MIDDLE, OPACITIES, Bent, assert_like_stock,  # noqa: E402
                           prop_of, shown_picture, smooth)

COMPOSITE, MAXIMUM, MINIMUM, AVERAGE, ADDITIVE, ISOSURFACE, SLICE = range(7)
NAMES = ("composite", "maximum", "minimum", "average", "additive", "isosurface", "slice")
OPAQUE = [0, 1, 0.5, 0, 100, 1, 0.5, 0]
FAINT = [0, 0, 0.5, 0, 100, 0.05, 0.5, 0]
LOW_ONES = [0, 0.9, 0.5, 0, 80, 0.2, 0.5, 0, 90, 0, 0.5, 0, 100, 0, 0.5, 0]
# VTK reads the scalars of a slice up to half a voxel off. Here it forgets that values lie in
# the middle of texels (in_inverseTextureDatasetMatrix).
LARGEST_SLICE_DIFFERENCE = 0.012


def blend(mode, **properties):
    def configure(display, view):
        display.BlendMode = mode
        display.IsosurfaceValues = [35.0, 60.0]
        display.SliceFunction.Origin = list(MIDDLE)
        display.SliceFunction.Normal = [0.3, 0.2, 1.0]
        for name, value in properties.items():
            setattr(display, name, value)
    return configure


def test_every_mode_looks_like_the_baked_volume():
    blobs = Bent(smooth())
    shadows = Bent(100 - smooth())
    assert_like_stock("maximum", blobs, blend(MAXIMUM))
    assert_like_stock("minimum", shadows, blend(MINIMUM), opacities=LOW_ONES)
    assert_like_stock("average", blobs, blend(AVERAGE), opacities=OPAQUE)
    assert_like_stock("additive", blobs, blend(ADDITIVE), opacities=FAINT)
    for shade in (False, True):
        lit = ", lit" if shade else ""
        assert_like_stock("isosurface" + lit, blobs, blend(ISOSURFACE), shade=shade)
        assert_like_stock("slice" + lit, blobs, blend(SLICE), LARGEST_SLICE_DIFFERENCE,
                          control=2.0, shade=shade)


def test_additive_counts_each_unit_distance():
    # 20 mm of tissue at half the range, with opacity 0.1 for 2 mm: 20 / 2 * 0.1 * 0.5.
    voxels = numpy.full((21, 21, 21), 50.0, numpy.float32)
    voxels[:, 0, 0], voxels[:, 0, 1] = 0.0, 100.0
    for step in (0.3, 0.7):
        view = view_along((0, 0, -1), (10, 10, 10), 100.0, half_height=8.0, size=40)
        display = show_volume(volume(voxels), view, "Deformed Volume", COLORS,
                              [0, 0.1, 0.5, 0, 100, 0.1, 0.5, 0], unit=2.0)
        display.BlendMode, display.SampleDistance = ADDITIVE, step
        assert numpy.allclose(picture(view)[20, 20], 0.5, atol=0.02), (step, picture(view)[20, 20])
        Delete(view)


def test_average_takes_a_range_of_scalars():
    voxels = numpy.full((21, 21, 21), 40.0, numpy.float32)
    voxels[10:] = 80.0
    voxels[:, 0, 0], voxels[:, 0, 1] = 0.0, 100.0
    view = view_along((0, 0, -1), (10, 10, 10), 100.0, half_height=8.0, size=40)
    display = show_volume(volume(voxels), view, "Deformed Volume", COLORS, OPAQUE)
    display.BlendMode, display.SampleDistance = AVERAGE, 0.1
    picture(view)
    for low, high, expected in ((-1e30, 1e30, 0.61), (79.0, 200.0, 0.8), (0.0, 41.0, 0.4)):
        prop_of(view).GetMapper().SetAverageIPScalarRange(low, high)
        seen = picture(view)[20, 20]
        assert numpy.allclose(seen, expected, atol=0.02), (low, high, seen)
    Delete(view)


def test_an_isosurface_is_where_its_value_is():
    # The scalar is the distance from the middle of a ball: the surface of 8.25 is 8.25 mm away.
    z, y, x = numpy.mgrid[0:33, 0:33, 0:33] - 16.0
    source = volume(numpy.sqrt(x * x + y * y + z * z).astype(numpy.float32))
    for step in (0.0, 2.0):
        view = view_along((0, 0, -1), (16, 16, 16), 100.0, half_height=16.0, size=100)
        display = show_volume(source, view, "Deformed Volume", [0, 1, 1, 1, 30, 1, 1, 1],
                              [0, 1, 0.5, 0, 30, 1, 0.5, 0])
        display.BlendMode, display.IsosurfaceValues = ISOSURFACE, [8.25]
        display.SampleDistance = step
        picture(view)
        for column, row in ((50, 50), (60, 45), (38, 62)):
            position = numpy.array(brainshift.pick(display, view, column, row))
            away = numpy.linalg.norm(position - 16.0)
            assert abs(away - 8.25) < 0.06, (step, column, row, away)  # the voxels' own roundness
        Delete(view)


def test_many_isosurfaces_are_told():
    def values(count):
        return blend(ISOSURFACE, IsosurfaceValues=list(numpy.linspace(30, 60, count)))
    source = volume(smooth())
    with messages() as said:
        assert shown_picture(source, "Deformed Volume", values(32)).any()
    assert "isosurface" not in said.text, said.text
    with messages() as said:
        assert shown_picture(source, "Deformed Volume", values(33)).any()
    assert_says(said.text, "33 isosurface values", "first 32")


def test_a_slice_without_a_plane_is_told():
    source = volume(smooth())
    view = view_along((0, 0, -1), MIDDLE, 140.0, size=100)
    display = show_volume(source, view, "Deformed Volume", COLORS, OPACITIES)
    composited = picture(view)
    display.BlendMode = SLICE
    assert not numpy.array_equal(picture(view), composited), "the plane is shown"
    display.SliceFunction = None
    with messages() as said:
        without = picture(view)
    assert_says(said.text, "Slice Type", "plane", "none")
    assert numpy.array_equal(without, composited)
    Delete(view)


def low_ones(colors, opacities):
    """A colour map and an opacity curve that show what another pair hides, turned about 0.5."""
    return colors, [value for at in range(len(opacities) - 4, -1, -4)
                    for value in (1.0 - opacities[at], opacities[at + 1], 0.5, 0)]


def assert_skipping_changes_nothing(filter, cases, what):
    """In one view, where the field that bends is made once. Cases: curve, mode, colours and
    opacities."""
    view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
    for name, mode, maps in cases:
        display = show_volume(filter, view, "Deformed Volume", *maps, shade=True)
        display.SliceFunction.Origin = list(LITTLE_MIDDLE)
        display.SliceFunction.Normal = [0.1, 0.9, 0.3]
        display.IsosurfaceValues = [0.52, 0.47] if name == "band" else [0.25, 0.5, 0.99]
        display.BlendMode = mode
        assert_same(view, display, f"{what}, {name}, {NAMES[mode]}",
                    0.001 if name == "band" else 0.01)
    Delete(view)


def test_skipping_changes_no_mode():
    for amplitude in (0.0, 20.0, 40.0):
        # Bright voxels show in the maximum, and holes in the minimum.
        bright = bent(volume(scattered()), amplitude)
        dark = bent(volume(1 - scattered()), amplitude)
        assert_skipping_changes_nothing(
            bright, [(name, mode, curves(name)) for name, mode in (
                ("translucent", MAXIMUM), ("band", MAXIMUM), ("translucent", AVERAGE),
                ("translucent", ADDITIVE), ("translucent", ISOSURFACE), ("band", ISOSURFACE),
                ("translucent", SLICE))], f"{amplitude:.0f} voxels, bright")
        assert_skipping_changes_nothing(
            dark, [("translucent", MINIMUM, low_ones(*curves("translucent"))),
                   ("band", MINIMUM, curves("band"))], f"{amplitude:.0f} voxels, dark")
        Delete(bright)
        Delete(dark)


def test_what_cannot_be_seen_hides_what_can():
    # Two slabs with no numbers around them. The far one is invisible. Where it holds the maximum,
    # nothing is seen, and its bricks are those that skipping would leave out.
    for mode, near, far in ((MAXIMUM, 0.5, 1.0), (MINIMUM, 0.5, 0.0)):
        voxels = numpy.full((21, 21, 21), numpy.nan, numpy.float32)
        voxels[14:] = near
        voxels[:7, :, :10] = far
        view = view_along((0, 0, -1), LITTLE_MIDDLE, 70.0, half_height=8.0, size=60)
        display = show_volume(volume(voxels), view, "Deformed Volume", *curves("band"))
        display.BlendMode = mode
        assert_same(view, display, f"{NAMES[mode]} of two slabs")
        image = picture(view)[30]
        assert not image[5:20].any() and image[40:55].any(axis=1).all()
        Delete(view)


def test_new_isosurfaces_are_not_skipped():
    # The surface of the new value does not meet the bricks of the old value.
    view = view_along(OBLIQUE, MIDDLE, 140.0, size=100)
    display = show_volume(volume(smooth()), view, "Deformed Volume", COLORS, OPAQUE)
    display.BlendMode = ISOSURFACE
    for value in (60.0, 20.0, 40.0):
        display.EmptySpaceSkipping = 1
        display.IsosurfaceValues = [value]
        picture(view)
        assert_same(view, display, f"isosurface {value:.0f}")
    Delete(view)


run_tests(globals())
