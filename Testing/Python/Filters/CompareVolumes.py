# SPDX-License-Identifier: BSD-3-Clause
# Proves that Compare Volumes and "Deformed Slices" show a volume with a reference on any grid: in
# two colours, in a checkerboard, and subtracted. A stroke uploads only the lattice.
import numpy
from brainshift_testing import (assert_says, ball, field, load_plugin, messages, output, picture,
                                run_tests, show_volume, volume)
from slices_testing import flat_view, pixel_positions, show_slices
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from compare_testing import HALF, MIDDLE, STROKE, Pair, compared_picture, smooth  # noqa: E402
from paraview.simple import CompareVolumes, Delete, FreeFormDeformation  # noqa: E402

LATTICE_BYTES = 19 ** 3 * 3 * 4
ENOUGH = 1.5 / 255.0


def test_a_volume_agrees_with_itself():
    source = volume(smooth(1))
    bent = FreeFormDeformation(Input=source, Strokes=STROKE)
    compare = CompareVolumes(Input=bent, Reference=source)
    for strength in (0.0, 1.0):
        bent.Strength = strength
        both = compared_picture(compare, "Two colours")
        apart = numpy.abs(both[:, :, 0] - both[:, :, 1])
        difference = compared_picture(compare, "Difference")
        off_grey = numpy.abs(difference - 0.5).max(axis=2)
        assert not both[:, :, 2].any()
        if strength == 0.0:
            assert apart.max() <= ENOUGH and off_grey.max() <= ENOUGH, (apart.max(), off_grey.max())
        else:
            assert apart.max() > 0.2 and off_grey.max() > 0.1, (apart.max(), off_grey.max())


def test_a_turned_reference_of_another_grid():
    pair = Pair()
    share, inside = pair.expected()
    assert 0.5 < inside.mean() < 0.98, inside.mean()
    both = compared_picture(pair.compare, "Two colours")
    plain = compared_picture(pair.bent, "None")
    assert numpy.abs(both[:, :, 0] - plain[:, :, 0]).max() <= ENOUGH, "red is the volume"
    assert numpy.abs(both[:, :, 1] - share)[inside].max() < 2.5 / 255, "green is the reference"
    outside = ~inside & ~numpy.roll(inside, (2, 2), (0, 1)) & ~numpy.roll(inside, (-2, -2), (0, 1))
    assert not both[:, :, 1][outside].any(), "no reference, no green"
    difference = compared_picture(pair.compare, "Difference")[:, :, 0]
    expected = 0.5 + 0.5 * (plain[:, :, 0] - share)
    assert numpy.abs(difference - expected)[inside].max() < 2.5 / 255
    shown = compared_picture(pair.compare, "Two colours", ReferenceRange=[500.0, 1000.0])
    wanted = numpy.clip(share * (pair.voxels.max() - pair.voxels.min())
                        + pair.voxels.min() - 500.0, 0, 500) / 500
    assert numpy.abs(shown[:, :, 1] - wanted)[inside].max() < 2.5 / 255, "a range of its own"


def test_ranges_are_those_of_3d():
    # Both rise from left to right. The number is the grey in the middle of the reference.
    share = numpy.broadcast_to(numpy.linspace(0.0, 1.0, 33), (33, 33, 33)).astype(numpy.float32)
    cases = (("alike: equal numbers", 80 * share, (0, 0), (0, 100), 0.4),
             ("alike, another window", 80 * share, (0, 0), (20, 70), 0.4),
             ("not alike: range to range", 3000 * share + 500, (0, 0), (0, 100), 0.5),
             ("not alike, another window", 3000 * share + 500, (0, 0), (25, 75), 0.5),
             ("given", 3000 * share + 500, (500, 2500), (20, 70), 0.75))
    for what, voxels, given, window, grey in cases:
        compare = CompareVolumes(Input=volume(100 * share), Reference=volume(voxels))
        compare.Show = "Reference"
        cut = compared_picture(compare, "None", window, ReferenceRange=given)[:, :, 0]
        view = flat_view(2, MIDDLE, HALF)
        colors = [window[0], 0, 0, 0, window[1], 1, 1, 1]
        opaque = [window[0], 1, 0.5, 0, window[1], 1, 0.5, 0]
        display = show_volume(compare, view, "Deformed Volume", colors, opaque)
        display.VolumeReferenceRange = given
        apart = numpy.abs(picture(view)[:, :, 0] - cut).max()
        middle = cut.shape[0] // 2
        assert abs(cut[middle, middle] - grey) < 0.02, (what, cut[middle, middle])
        assert apart < 3.0 / 255, (what, apart)
        Delete(view)


def test_checkerboard():
    pair = Pair()
    share, inside = pair.expected()
    plain = compared_picture(pair.bent, "None")[:, :, 0]
    image = compared_picture(pair.compare, "Checkerboard", CheckerSize=6.0)[:, :, 0]
    from_volume = numpy.abs(image - plain) < 2.5 / 255
    from_reference = numpy.abs(image - share) < 3.5 / 255
    assert (from_volume | from_reference)[inside].mean() > 0.99, "each field is one of the two"
    x, y, z = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF).transpose(2, 0, 1)
    edges = numpy.minimum.reduce([numpy.abs((c + 0.5) % 6.0 - 3.0) for c in (x, y)])
    even = sum(numpy.floor((c + 0.5) / 6.0) for c in (x, y, z)) % 2 == 0
    deep = inside & (edges < 2.8)
    assert from_volume[even & deep].all() and from_reference[~even & deep].all()
    assert (~from_reference[even & deep]).mean() > 0.5, "they must be told apart"


def test_a_stroke_uploads_the_lattice_only():
    pair = Pair()
    view = flat_view(2, MIDDLE, HALF)
    display = show_slices(pair.compare, view, ("Axial",), MIDDLE)
    display.SliceComparison = "Two colours"
    first = picture(view)
    before = brainshift.counters(display)
    assert before["volumeUploads"] == 2, before
    pair.bent.Strokes = brainshift.soft((16, 16, 16), (0, 5, 0), 12)
    second = picture(view)
    after = brainshift.counters(display)
    assert after["bytesUploaded"] - before["bytesUploaded"] == LATTICE_BYTES, (before, after)
    changed = [numpy.abs(second - first)[60:240, 60:240, color].max() for color in (0, 1)]
    assert changed[0] > 0.1 and changed[1] <= ENOUGH, changed
    pair.compare.ReferenceTranslation = (0.0, 4.0, 0.0)
    third = picture(view)
    sent = brainshift.counters(display)["bytesUploaded"] - after["bytesUploaded"]
    assert sent == 0, "a reference that moves is sent again"
    changed = [numpy.abs(third - second)[60:240, 60:240, color].max() for color in (0, 1)]
    assert changed[1] > 0.1 and changed[0] <= ENOUGH, changed
    Delete(view)


def test_the_volume_passes_through():
    pair = Pair()
    passed, bent = output(pair.compare), output(pair.bent)
    assert passed.GetDimensions() == bent.GetDimensions()
    first, second = (vtk_to_numpy(image.GetPointData().GetArray("Intensity"))
                     for image in (passed, bent))
    assert numpy.shares_memory(first, second), "voxels are copied"
    assert (field(pair.compare, "FFDDisplacements") == field(pair.bent, "FFDDisplacements")).all()
    assert field(pair.bent, "ReferenceGrid") is None, "the input must stay as it is"


def test_errors_name_the_thing():
    vectors = volume(numpy.zeros((5, 5, 5, 3), numpy.float32))
    compare = CompareVolumes(Input=volume(ball(side=9, radius=3)), Reference=vectors)
    with messages() as said:
        compare.UpdatePipeline()
    assert_says(said.text, "reference", "3 components", "must have 1")


run_tests(globals())
