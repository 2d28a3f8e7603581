# SPDX-License-Identifier: BSD-3-Clause
# Proves that a flat surface shows no rings under an opacity map that rises within less than a
# step: the depth of the first sample on a ray cannot be seen. The face of a volume has no holes.
import numpy
from brainshift_testing import (load_plugin, picture, run_tests, show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete, FreeFormDeformation  # noqa: E402

SIDE = 33
COLORS = [0, 0.2, 0.1, 0.0, 40, 0.2, 0.1, 0.0, 70, 1.0, 0.9, 0.8, 100, 1.0, 1.0, 1.0]


def slope():
    """Rises from 0 to 100 over four voxels about an oblique plane."""
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE].astype(float)
    depth = (16 - z) + 0.23 * (x - 16) + 0.11 * (y - 16)
    return (25.0 * numpy.clip(depth + 2, 0, 4)).astype(numpy.float32)


def patch(opacities, shade, strokes=()):
    """The middle of the surface."""
    source = FreeFormDeformation(Input=volume(slope()), Strokes=list(strokes))
    view = view_along((-0.3, 0.2, -1), (16, 16, 16), 80.0, half_height=8.0, size=160)
    show_volume(source, view, "Deformed Volume", COLORS, opacities, shade=shade)
    image = picture(view)[20:-20, 20:-20]
    Delete(view)
    return image


def ripples(image):
    """How much neighbourhoods of 9x9 pixels vary: standard deviation, of 255 levels."""
    grey = image.mean(axis=2)
    blocks = grey[:117, :117].reshape(13, 9, 13, 9).transpose(0, 2, 1, 3).reshape(169, 81)
    return float(255 * blocks.std(axis=1).mean())


def steep(width):
    return [0, 0, 0.5, 0, 50, 0, 0.5, 0, 50 + width, 1, 0.5, 0, 100, 1, 0.5, 0]


def test_no_rings():
    # If each sample took the opacity map alone, the ripples would be 17, 11 and 6 levels.
    for strokes in ((), brainshift.soft((16, 16, 16), (0, 0, 2), 14)):
        for shade, width in ((False, 0.5), (False, 8.0), (True, 0.5), (True, 4.0)):
            found = ripples(patch(steep(width), shade, strokes))
            print(f"  rise over {width} of 100: {found:.2f} levels", flush=True)
            assert found < 3.0, found


def test_a_gentle_map_has_none_anyway():
    # Averages cost time, so they are taken only where rings would show.
    gentle = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 70, 1, 0.5, 0, 100, 1, 0.5, 0]
    assert ripples(patch(gentle, True)) < 2.0, ripples(patch(gentle, True))


def test_the_face_of_a_volume_has_no_holes():
    """Else rounding would say which rays have their first sample inside. It depends on the box."""
    fog = [0, 0, 0.5, 0, 100, 0.3, 0.5, 0]
    numbers = numpy.random.default_rng(1)
    for _ in range(8):
        spacing, origin = numbers.uniform(0.5, 2, 3), numbers.uniform(-50, 50, 3)
        slab = volume(numpy.full((4, 40, 40), 70.0, numpy.float32), origin, spacing)
        middle = origin + spacing * (19.5, 19.5, 1.5)
        for towards in (-1, 1):
            view = view_along((0, 0, towards), middle, 150.0, size=160)
            view.CameraViewAngle = 8.0 * spacing[:2].min()
            display = show_volume(slab, view, "Deformed Volume", COLORS, fog)
            # Each ray has 2.5 steps.
            display.SampleDistance, display.AmbientOcclusion = 3 * spacing[2] / 2.5, 0
            image = 255 * picture(view)
            assert image.min() > 20, "the slab fills the picture"
            levels = (image.max(axis=(0, 1)) - image.min(axis=(0, 1))).max()
            print(f"  {levels:.1f} levels", flush=True)
            assert levels < 3.0, levels
            Delete(view)


run_tests(globals())
