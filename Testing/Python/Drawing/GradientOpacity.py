# SPDX-License-Identifier: BSD-3-Clause
# Proves that gradient opacity acts on a bent volume as it acts on the baked volume in VTK's mapper:
# with the same gradient, number by number, in voxels of any shape. Empty-space skipping stays
# exact.
import numpy
from brainshift_testing import (assert_says, load_plugin, mean_difference, messages, picture,
                                run_tests, show_volume, view_along, volume)

load_plugin()
from paraview.simple import CompareVolumes, Delete, FreeFormDeformation  # noqa: E402 after plugin
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from steepness_testing import EDGES, faded, ramp, steepness_of_ramp  # noqa: E402
from stock_testing import (Bent, assert_alike, assert_like_stock,  # noqa: E402
                           shown_picture, smooth)

FLAT = (0.6, 1.0, 1.5)  # mm, voxels of three different sides


def test_like_stock():
    for shade in (False, True):
        assert_like_stock(f"edges, {'lit' if shade else 'unlit'}", Bent(smooth()), faded(EDGES),
                          shade=shade, limit=0.012 if shade else 0.006)
    assert_like_stock("edges, flat voxels", Bent(smooth(), spacing=(0.9, 1.0, 1.15)), faded(EDGES),
                      limit=0.006)


def test_the_factor_is_seen():
    source = volume(smooth(), spacing=FLAT)
    with_factor = shown_picture(source, "Deformed Volume", faded(EDGES))
    assert_alike("unbent, flat voxels", with_factor, shown_picture(source, "Volume", faded(EDGES)),
                 shown_picture(source, "Volume", faded([0.0, 1.0])), limit=0.006, control=8.0)
    without = shown_picture(source, "Deformed Volume", faded([]))
    assert numpy.array_equal(without, shown_picture(
        source, "Deformed Volume", lambda display, view: None)), "an empty list does nothing"
    assert mean_difference(with_factor, without) > 0.05


def jump_at(gradient):
    """Factors that rise from 0 to 1 within 1 % of a gradient."""
    return [0, 0, 0.995 * gradient, 0, 1.005 * gradient, 1]


def brightness(source, kind, factors, focus, direction=(0, 0, -1)):
    """Of the middle of a picture of one opaque white slab of the scalars 45 to 55 %."""
    values = source.GetPointDataInformation().GetArray(0).GetRange()
    at = [values[0] + share * (values[1] - values[0]) for share in (0, 0.40, 0.45, 0.55, 0.60, 1)]
    opacities = [number for value, opacity in zip(at, (0, 0, 0.2, 0.2, 0, 0))
                 for number in (value, opacity, 0.5, 0)]
    view = view_along(direction, focus, 150.0, size=41)
    display = show_volume(source, view, kind, [at[0], 1, 1, 1, at[-1], 1, 1, 1], opacities)
    faded(factors)(display, view)
    seen = picture(view)[20, 20, 0]
    Delete(view)
    return seen


def test_the_gradient_is_that_of_vtk():
    # A factor that jumps at a gradient tells on which side of it the gradient of a ramp lies.
    shape, slopes = (21, 27, 33), (1.0, 0.4, -0.6)
    source = volume(ramp(slopes, shape, FLAT), spacing=FLAT)
    focus = [0.5 * (n - 1) * side for n, side in zip(shape, FLAT)]
    low, high = source.GetPointDataInformation().GetArray(0).GetRange()
    gradient = 0.25 * (high - low) * steepness_of_ramp(slopes, shape, FLAT)
    for kind in ("Deformed Volume", "Volume"):
        plain = brightness(source, kind, [0.0, 1.0], focus)
        assert plain > 0.3, plain
        for share in (0.99, 1.01):
            seen = brightness(source, kind, jump_at(share * gradient), focus)
            print(f"  {kind}: jump at {share:.3f} of the gradient: {seen:.3f} of {plain:.3f}")
            assert abs(seen - (plain if share < 1.0 else 0.0)) < 0.02, (kind, share, seen)


def test_the_gradient_is_that_of_bent_tissue():
    # A volume that is stretched along x to 1.4 times its width has a smaller slope along x.
    shape, slopes, spacing = (33, 33, 33), (1.0, 0.0, 0.2), (1.0, 1.0, 1.0)
    middle = [16.0] * 3
    source = volume(ramp(slopes, shape, spacing))
    x = numpy.mgrid[0:9, 0:9, 0:9][2] * 4.0
    displacements = numpy.stack((0.4 * (x - 16.0), 0 * x, 0 * x), axis=-1).astype(numpy.float32)
    stretched = FreeFormDeformation(
        Input=source, Lattice=volume(displacements, spacing=(4.0,) * 3),
        LatticeDimensions=[9, 9, 9])
    gradient = 33.0 / 32.0 * numpy.linalg.norm((1.0 / 1.4, 0.0, 0.2))
    for share, expected in ((0.985, 1.0), (1.015, 0.0)):
        seen = brightness(stretched, "Deformed Volume", jump_at(share * gradient), middle)
        plain = brightness(stretched, "Deformed Volume", [], middle)
        print(f"  jump at {share:.3f} of the gradient: {seen:.3f} of {plain:.3f}")
        assert plain > 0.3 and abs(seen - expected * plain) < 0.02, (share, seen, plain)


def test_skipping_changes_nothing():
    for amplitude in (0.0, 40.0):
        filter = bent(volume(scattered()), amplitude)
        for name in ("opaque", "translucent", "band"):
            view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
            display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
            display.GradientOpacity = [0.0, 0.0, 0.1, 0.0, 0.25, 1.0]
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}", least_share=0.005)
            Delete(view)
        Delete(filter)


def test_what_is_not_drawn_is_told():
    source = volume(smooth())
    with messages() as said:
        maximum = shown_picture(source, "Deformed Volume", faded(EDGES, BlendMode=1))
    assert_says(said.text, "Gradient opacity", "Composite")
    plain = shown_picture(source, "Deformed Volume",
                          lambda display, view: setattr(display, "BlendMode", 1))
    assert maximum.any() and numpy.array_equal(maximum, plain)
    compared = CompareVolumes(Input=source, Reference=volume(smooth()[:, :, ::-1].copy()))
    with messages() as said:
        image = shown_picture(compared, "Deformed Volume", faded(EDGES))
    assert_says(said.text, "A comparison", "gradient opacity")
    assert image.any() and numpy.array_equal(
        image, shown_picture(compared, "Deformed Volume", lambda display, view: None))


run_tests(globals())
