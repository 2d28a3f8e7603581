# SPDX-License-Identifier: BSD-3-Clause
# Proves that volumes with several numbers in a voxel are shown as ParaView's "Volume" shows them
# baked: with colours of their own, with a second number for the opacity, or with a separate array
# for it. What cannot be drawn gives a message and is drawn with the colour map.
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
from paraview.simple import Delete  # noqa: E402 after the plugin
from skipping_testing import (MIDDLE as LITTLE_MIDDLE, OBLIQUE, assert_same, bent,  # noqa: E402
                              scattered)
from stock_testing import (COLORS, MIDDLE, OPACITIES, SIDE, Bent, assert_like_stock,  # noqa: E402
                           bend, shown_picture, smooth)
from vtkmodules.util.numpy_support import numpy_to_vtk  # noqa: E402

OPACITY_OF_BYTES = [0, 0, 0.5, 0, 60, 0, 0.5, 0, 255, 0.4, 0.5, 0]


def ramps():
    """Red, green and blue that grow along x, y and z from 0 to 1."""
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE] / (SIDE - 1.0)
    return x, y, z


def colored_bytes():
    """Blobs of opacity 0 to 255 in a box of colours; each number takes all of its range, which VTK
    would spread otherwise."""
    opacity = smooth() / smooth().max()
    return numpy.round(255 * numpy.stack((*ramps(), opacity), axis=-1)).astype(numpy.uint8)


def unmapped(display, view):
    display.MapScalars = 0


def test_colours_of_its_own():
    # Baking writes zeros where tissue came from outside the box. Here no tissue does.
    blobs = Bent(colored_bytes())
    assert_like_stock("four bytes", blobs, unmapped, opacities=OPACITY_OF_BYTES, limit=0.01)


def test_colours_as_numbers_up_to_one():
    voxels = colored_bytes()
    as_bytes = shown_picture(bend(volume(voxels)), "Deformed Volume", unmapped,
                             opacities=OPACITY_OF_BYTES)
    scaled = [value / 255.0 if i % 4 == 0 else value for i, value in enumerate(OPACITY_OF_BYTES)]
    as_floats = shown_picture(bend(volume((voxels / 255.0).astype(numpy.float32))),
                              "Deformed Volume", unmapped, opacities=scaled)
    assert as_bytes.any() and numpy.abs(as_bytes - as_floats).max() < 0.02


def colour_and_opacity():
    x, _, _ = ramps()
    return numpy.stack((100 * x, smooth()), axis=-1).astype(numpy.float32)


def test_colour_and_opacity_of_two_numbers():
    def dependent(display, view):
        display.MultiComponentsMapping = 1
    assert_like_stock("two numbers", Bent(colour_and_opacity()), dependent)


def with_second_array(voxels, other):
    source = volume(voxels)
    image = source.GetClientSideObject().GetOutputDataObject(0)
    array = numpy_to_vtk(numpy.ascontiguousarray(other).reshape(-1), deep=True)
    array.SetName("Certainty")
    image.GetPointData().AddArray(array)
    source.GetClientSideObject().SetOutput(image)
    source.UpdatePipeline()
    return source


def test_separate_opacity_array():
    x, _, _ = ramps()
    source = with_second_array((100 * x).astype(numpy.float32), smooth())

    def separate(display, view):
        display.UseSeparateOpacityArray = 1
        display.OpacityArrayName = ["POINTS", "Certainty"]
    ours = shown_picture(bend(source), "Deformed Volume", separate)

    def dependent(display, view):
        display.MultiComponentsMapping = 1
    two = shown_picture(bend(volume(colour_and_opacity())), "Deformed Volume", dependent)
    assert two.any() and numpy.array_equal(ours, two)


def test_three_numbers_are_told():
    voxels = numpy.stack((smooth(),) * 3, axis=-1)
    mapped = shown_picture(volume(voxels), "Deformed Volume", lambda display, view: None)
    with messages() as said:
        image = shown_picture(volume(voxels), "Deformed Volume", unmapped)
    assert_says(said.text, "Map Scalars", "2 or 4 components", "has 3", "colour map")
    assert image.any() and numpy.array_equal(image, mapped)


def test_other_choices_are_told_once_and_only_when_shown():
    view = view_along((0, 0, -1), MIDDLE, 140.0, size=60)
    display = show_volume(volume(smooth()), view, "Volume", COLORS, OPACITIES)
    with messages() as said:
        display.GlobalIlluminationReach = 0.5
        display.VolumetricScatteringBlending = 1.0
        picture(view)
    assert "Deformed Volume" not in said.text, said.text
    display.SetRepresentationType("Deformed Volume")
    with messages() as said:
        picture(view)
    assert_says(said.text, "GlobalIlluminationReach", "VolumetricScatteringBlending")
    display.VolumeRenderingMode = "Ray Cast Only"
    with messages() as said:
        picture(view)
    assert_says(said.text, "VolumeRenderingMode")
    assert "GlobalIlluminationReach" not in said.text, said.text
    Delete(view)


def test_skipping_changes_nothing():
    shape = scattered()
    random = numpy.random.default_rng(3)
    for numbers in (2, 4):
        voxels = random.uniform(0, 255, shape.shape + (numbers,))
        voxels[..., -1] = 255 * shape
        for amplitude in (0.0, 40.0):
            filter = bent(volume(voxels.astype(numpy.uint8)), amplitude)
            view = view_along(OBLIQUE, LITTLE_MIDDLE, 70.0, size=100)
            display = show_volume(filter, view, "Deformed Volume", [0, 1, 0, 0, 255, 0, 1, 1],
                                  OPACITY_OF_BYTES, shade=True)
            display.MapScalars = 0
            for mode in (0, 1, 5):
                display.BlendMode, display.IsosurfaceValues = mode, [127.0]
                assert_same(view, display, f"{amplitude:.0f} voxels, {numbers} numbers, blend mode "
                            f"{mode}")
            Delete(view)
            Delete(filter)


run_tests(globals())
