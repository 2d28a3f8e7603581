# SPDX-License-Identifier: BSD-3-Clause
# Proves that interpolation, material, unit distance, place and spacing of a bent volume do what they
# do to the baked one in ParaView's "Volume".
import numpy
from brainshift_testing import (load_plugin, mean_difference, picture, run_tests, show_volume,
                                use_headlight, view_along, volume)

load_plugin()
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation  # noqa: E402
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from stock_testing import (COLORS, MIDDLE, OPACITIES, Bent, assert_alike,  # noqa: E402
                           assert_like_stock, shown_picture, smooth)
import brainshift  # noqa: E402

PLACES = {
    "moved": {"Translation": [6.0, -4.0, 5.0]},
    "turned about a point": {"Orientation": [20.0, -35.0, 15.0], "Origin": [20.0, 30.0, 10.0]},
    "scaled": {"Scale": [0.7, 1.3, 1.0], "Origin": [24.0, 24.0, 24.0]},
    "larger": {"Scale": [1.5, 1.5, 1.5], "Origin": [24.0, 24.0, 24.0]},
    "mirrored": {"Scale": [-1.0, 1.0, 1.0], "Origin": [24.0, 24.0, 24.0]},
}


def properties(**named):
    def configure(display, view):
        for name, value in named.items():
            setattr(display, name, value)
    return configure


def test_nearest_shows_voxels_as_stock_does():
    random = numpy.random.default_rng(4)
    source = volume(random.uniform(0, 100, (8, 8, 8)).astype(numpy.float32))
    opaque = [0, 0, 0.5, 0, 49, 0, 0.5, 0, 51, 1, 0.5, 0, 100, 1, 0.5, 0]
    images = {}
    for kind in ("Volume", "Deformed Volume"):
        for interpolation in ("Nearest", "Linear"):
            view = view_along((-0.4, 0.2, -1), (3.5, 3.5, 3.5), 30.0, half_height=6.0, size=150)
            use_headlight(view)
            display = show_volume(source, view, kind, COLORS, opaque)
            display.InterpolationType = interpolation
            images[kind, interpolation] = picture(view)
            Delete(view)
    assert_alike("nearest", images["Deformed Volume", "Nearest"], images["Volume", "Nearest"],
                 images["Volume", "Linear"], limit=0.03)  # edges of voxels, to half a step
    assert mean_difference(images["Deformed Volume", "Nearest"],
                           images["Deformed Volume", "Linear"]) > 0.1


def test_nearest_gradients_are_those_of_the_voxels():
    # A ramp of large voxels, which light from the eye shows as bright as the same ramp, blended.
    ramp = numpy.zeros((9, 9, 9), numpy.float32)
    ramp[:] = 10 * numpy.arange(9)[:, None, None]
    ramp += 3 * numpy.arange(9)
    for normals in ("Half resolution", "Full resolution", "On the fly"):
        seen = {}
        for interpolation in ("Nearest", "Linear"):
            view = view_along((0, 0, -1), (4, 4, 4), 30.0, half_height=4.0, size=60)
            use_headlight(view)
            display = show_volume(volume(ramp), view, "Deformed Volume",
                                  [0, 1, 1, 1, 110, 1, 1, 1], [0, 1, 0.5, 0, 110, 1, 0.5, 0],
                                  shade=True)
            display.VolumeNormalTexture = normals
            display.InterpolationType = interpolation
            seen[interpolation] = picture(view)[30, 20:40, 0]
            Delete(view)
        expected = 10 / numpy.hypot(10, 3)
        assert numpy.allclose(seen["Linear"], expected, atol=0.06), (normals, seen)
        assert numpy.allclose(seen["Nearest"], expected, atol=0.06), (normals, seen)


def test_skipping_changes_nothing_with_nearest():
    for amplitude in (0.0, 40.0):
        filter = bent(volume(scattered()), amplitude)
        for name in ("opaque", "translucent"):
            view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
            display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
            display.InterpolationType = "Nearest"
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}")
            display.BlendMode, display.IsosurfaceValues = 5, [0.5]
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}, isosurface")
            Delete(view)
        Delete(filter)


def test_each_part_of_the_material():
    blobs = Bent(smooth())
    for name, parts in (("ambient", (0.6, 0.0, 0.0)), ("diffuse", (0.0, 0.7, 0.0)),
                        ("specular", (0.0, 0.0, 0.8)), ("all", (0.2, 0.5, 0.4))):
        assert_like_stock(name, blobs, properties(
            Ambient=parts[0], Diffuse=parts[1], Specular=parts[2], SpecularPower=6.0), shade=True,
            limit=0.008)


def test_without_shade_material_and_light_do_nothing():
    blobs = Bent(smooth())
    plain = shown_picture(blobs.filter, "Deformed Volume", properties())
    dark = shown_picture(blobs.filter, "Deformed Volume",
                         properties(Ambient=0.1, Diffuse=0.1, Specular=0.1))
    assert numpy.array_equal(plain, dark)


def test_light_kit():
    # In a box that is a cube, where VTK's normals are right for any light.
    def kit(display, view):
        view.UseLight = 1
        view.AdditionalLights = []
    assert_like_stock("light kit", Bent(smooth()), kit, shade=True, limit=0.008)


def test_unit_distances():
    blobs = Bent(smooth())
    for unit in (0.3, 2.0, 10.0):
        assert_like_stock(f"{unit} mm", blobs, properties(), unit=unit, limit=0.008)


def test_places():
    blobs = Bent(smooth())
    for name, place in PLACES.items():
        for shade in (False, True):
            assert_like_stock(name + (", lit" if shade else ""), blobs, properties(**place),
                              shade=shade, limit=0.008)


def test_spacing_that_differs_along_the_axes():
    # The blobs again in half as many voxels along x and twice the spacing.
    source = volume(smooth()[:, :, ::2].copy(), spacing=(2.0, 1.0, 1.0))
    filter = FreeFormDeformation(Input=source, Strokes=brainshift.soft(
        (22, 26, 26), (-5, 4, -4), 20.0))
    fine = FreeFormDeformation(Input=volume(smooth()), Strokes=brainshift.soft(
        (22, 26, 26), (-5, 4, -4), 20.0))
    baked = BakeDeformation(Input=filter, Interpolation="Cubic")
    images = [shown_picture(shown, kind, properties()) for shown, kind in (
        (filter, "Deformed Volume"), (baked, "Volume"), (source, "Volume"))]
    assert_alike("spacing 2 1 1", *images, limit=0.008)
    assert mean_difference(images[0], shown_picture(fine, "Deformed Volume", properties())) < 0.01


run_tests(globals())
