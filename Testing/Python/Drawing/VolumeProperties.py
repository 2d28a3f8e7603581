# SPDX-License-Identifier: BSD-3-Clause
# Proves that interpolation, material, unit distance, position and spacing act on a bent volume as
# they act on the baked volume in ParaView's "Volume".
import numpy
from brainshift_testing import (load_plugin, mean_difference, run_tests, show_volume, view_along,
                                volume)

load_plugin()
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation  # noqa: E402
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              curves, scattered)
from stock_testing import (Bent, assert_alike, assert_like_stock,  # noqa: E402
                           shown_picture, smooth)
import brainshift  # noqa: E402

PLACES = {
    "moved": {"Translation": [6.0, -4.0, 5.0]},
    "turned about a point": {"Orientation": [20.0, -35.0, 15.0], "Origin": [20.0, 30.0, 10.0]},
    "stretched": {"Scale": [0.7, 1.3, 1.0], "Origin": [24.0, 24.0, 24.0]},
    "larger": {"Scale": [1.5, 1.5, 1.5], "Origin": [24.0, 24.0, 24.0]},
    "mirrored": {"Scale": [-1.0, 1.0, 1.0], "Origin": [24.0, 24.0, 24.0]},
}


def properties(**named):
    def configure(display, view):
        for name, value in named.items():
            setattr(display, name, value)
    return configure


def test_nearest_shows_voxels_as_stock_does():
    source = volume(smooth()[::6, ::6, ::6].copy(), spacing=(6.0, 6.0, 6.0))
    opaque = [0, 0, 0.5, 0, 29, 0, 0.5, 0, 31, 1, 0.5, 0, 100, 1, 0.5, 0]

    def shown(kind, interpolation, shade, normals="Full resolution"):
        return shown_picture(source, kind, properties(
            InterpolationType=interpolation, SampleDistance=0.5, VolumeNormalTexture=normals),
            opacities=opaque, shade=shade)
    assert_alike("nearest", *(shown(kind, interpolation, False) for kind, interpolation in (
        ("Deformed Volume", "Nearest"), ("Volume", "Nearest"), ("Volume", "Linear"))),
                 limit=0.01)
    # VTK looks for gradients N / (N - 1) voxels away and so finds two in some voxels. Here each
    # voxel has one gradient.
    lit = shown("Deformed Volume", "Nearest", True)
    assert_alike("nearest, lit", lit, shown("Volume", "Nearest", True),
                 shown("Volume", "Linear", True), limit=0.06, control=1.5)
    on_the_fly = shown("Deformed Volume", "Nearest", True, "On the fly")
    assert mean_difference(lit, on_the_fly) < 0.001


def test_skipping_changes_nothing_with_nearest():
    for amplitude in (0.0, 40.0):
        filter = bent(volume(scattered()), amplitude)
        view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
        for name in ("opaque", "translucent"):
            display = show_volume(filter, view, "Deformed Volume", *curves(name), shade=True)
            display.InterpolationType, display.BlendMode = "Nearest", 0
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}")
            display.BlendMode, display.IsosurfaceValues = 5, [0.5]
            assert_same(view, display, f"{amplitude:.0f} voxels, {name}, isosurface")
        Delete(view)
        Delete(filter)


def test_each_part_of_the_material():
    blobs = Bent(smooth())
    for name, parts in (("ambient", (0.6, 0.0, 0.0)), ("diffuse", (0.0, 0.7, 0.0)),
                        ("specular", (0.1, 0.0, 0.8)), ("all", (0.2, 0.5, 0.4))):
        assert_like_stock(name, blobs, properties(
            Ambient=parts[0], Diffuse=parts[1], Specular=parts[2], SpecularPower=2.0), shade=True,
            limit=0.008)


def test_without_shade_material_and_light_do_nothing():
    blobs = Bent(smooth())
    plain = shown_picture(blobs.filter, "Deformed Volume", properties())
    dark = shown_picture(blobs.filter, "Deformed Volume",
                         properties(Ambient=0.1, Diffuse=0.1, Specular=0.1))
    assert numpy.array_equal(plain, dark)


def test_light_kit():
    # The box is a cube, because VTK's normals are right for any light only there.
    def kit(display, view):
        view.UseLight = 1
        view.AdditionalLights = []
    assert_like_stock("light kit", Bent(smooth()), kit, shade=True, limit=0.012)


def test_unit_distances():
    blobs = Bent(smooth())
    for unit in (0.3, 2.0, 10.0):
        assert_like_stock(f"{unit} mm", blobs, properties(), unit=unit, limit=0.008)


def test_places():
    blobs = Bent(smooth())
    for name, place in PLACES.items():
        assert_like_stock(name, blobs, properties(**place), limit=0.008)
        if name != "stretched":
            assert_like_stock(name + ", lit", blobs, properties(**place), shade=True, limit=0.008)


def test_light_on_a_stretched_volume():
    # VTK lights a surface that an actor stretches as if it was not stretched. It lights a surface
    # that spacing stretches correctly. We must light both correctly.
    sides = (0.7, 1.3, 1.0)

    def isosurface(**named):
        return properties(BlendMode=5, IsosurfaceValues=[40.0], **named)
    scaled, spaced = volume(smooth()), volume(smooth(), spacing=sides)
    named = {"shade": True, "opacities": [0, 1, 0.5, 0, 100, 1, 0.5, 0]}
    assert_alike("stretched, lit",
                 shown_picture(scaled, "Deformed Volume", isosurface(Scale=sides), **named),
                 shown_picture(spaced, "Volume", isosurface(), **named),
                 shown_picture(scaled, "Volume", isosurface(Scale=sides), **named), limit=0.008)


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
