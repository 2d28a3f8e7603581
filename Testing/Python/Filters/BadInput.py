# SPDX-License-Identifier: BSD-3-Clause
# Proves that bad input gives an error with names, values and limits, and leaves the picture as it
# was.
import math

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, look, messages, output, picture,
                                run_tests, show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, DeformationField,  # noqa: E402
                             FreeFormDeformation, Sphere)

MIDDLE = (16.0, 16.0, 16.0)
STROKE = brainshift.soft(MIDDLE, (3, 0, 0), 12)
COLORS = [0, 0, 1, 0, 100, 0, 1, 0]
OPACITIES = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]


def drawn(voxels, strokes=STROKE):
    filter = FreeFormDeformation(Input=volume(voxels), Strokes=list(strokes))
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=16.0)
    show_volume(filter, view, "Deformed Volume", COLORS, OPACITIES)
    return filter, view


def expect_kept(name, value, *words):
    """A wrong value of a property is told, and the picture stays bit for bit."""
    filter, view = drawn(ball())
    before = picture(view)
    good = getattr(filter, name)
    good = list(good) if hasattr(good, "__len__") else good
    setattr(filter, name, value)
    with messages() as said:
        after = picture(view)
    assert_says(said.text, *words)
    assert before.any() and numpy.array_equal(after, before)
    setattr(filter, name, good)
    with messages() as said:
        assert numpy.array_equal(picture(view), before)
    assert "error" not in said.text.lower(), said.text


def test_bad_strokes_keep_the_picture():
    expect_kept("Strokes", STROKE + (1.0,), "Strokes holds 15 numbers", "14 for each")
    expect_kept("Strokes", STROKE[:5] + (math.nan,) + STROKE[6:], "number 5 is nan", "finite")
    expect_kept("Strokes", STROKE[:10] + (-2.0,) + STROKE[11:], "-2", "below 0 mm")


def test_bad_lattices_keep_the_picture():
    expect_kept("LatticeDimensions", [1, 1, 1], "1 x 1 x 1", "4 to 257")
    expect_kept("LatticeDimensions", [2000, 2000, 2000], "2000 x 2000 x 2000", "4 to 257")


def test_a_strength_that_is_no_number_keeps_the_picture():
    expect_kept("Strength", math.nan, "Strength is not a number", "0 to 1")


def test_a_bad_base_lattice_keeps_the_picture():
    filter, view = drawn(ball())
    before = picture(view)
    filter.Lattice = volume(ball())
    with messages() as said:
        after = picture(view)
    assert_says(said.text, "base lattice", "3 components")
    assert numpy.array_equal(after, before)


def test_not_a_number_is_transparent():
    # The nearer half of the ball has no values. The other half is drawn as if it was alone.
    for wrong in (math.nan, math.inf, -math.inf):
        voxels = ball()
        voxels[:, :, 20:] = wrong
        filter, view = drawn(voxels, strokes=())
        image = picture(view)
        column = {x: int((x / 32.0) * image.shape[1]) for x in (12, 24)}
        middle = image.shape[0] // 2
        assert image[middle, column[12]].tolist() == [0, 1, 0], (wrong, image[middle, column[12]])
        assert not image[middle, column[24]].any(), (wrong, image[middle, column[24]])
        filter.Strokes = STROKE
        assert numpy.isfinite(picture(view)).all()


def test_only_not_a_number_draws_nothing():
    for wrong in (math.nan, math.inf):
        _, view = drawn(numpy.full((9, 9, 9), wrong, numpy.float32))
        assert not picture(view).any()


def test_a_volume_longer_than_the_gpu_takes_is_drawn_coarser_along_it():
    # No GPU of today takes 20000 voxels along an axis of a 3D texture.
    with messages() as said:
        _, view = drawn(numpy.full((6, 6, 20000), 100.0, numpy.float32), strokes=())
        look(view, (0, 0, -1), (16.0, 2.5, 2.5), 100.0)
        shown = picture(view)
    assert_says(said.text, "20000 voxels", "at most", "drawn coarser", " x 1 x 1 voxels")
    assert "undeformed" not in said.text, said.text
    assert shown.any()


def test_a_step_without_length_ends():
    filter, view = drawn(ball())
    display = view.Representations[0]
    display.SampleDistance = 33.0 * math.sqrt(3.0) / 8192.0
    shortest = picture(view)
    for step in (1e-9, 1e-300):
        display.SampleDistance = step
        with messages() as said:
            assert numpy.array_equal(picture(view), shortest)
        assert_says(said.text, f"Sample Distance is {step:g} mm", "at most 8192 samples")
    display.SampleDistance = 1e300
    assert picture(view).shape == shortest.shape
    display.SampleDistance = 0.0
    assert picture(view).any()


def test_a_field_too_fine_for_the_memory_is_named():
    filter, view = drawn(ball(), strokes=())
    before = picture(view)
    filter.LatticeDimensions, filter.Samples = [129, 129, 129], 16
    with messages() as said:
        picture(view)
    assert_says(said.text, "The offset field of 2177 x 2177 x 2177 nodes", "GB of memory")
    filter.LatticeDimensions, filter.Samples = [19, 19, 19], 4
    with messages() as said:
        assert numpy.array_equal(picture(view), before)
    assert "error" not in said.text.lower(), said.text


def test_a_field_of_too_many_points_is_named():
    field = DeformationField(Input=FreeFormDeformation(Input=volume(ball())),
                             SampleGrid="Given Dimensions", Dimensions=[4096, 4096, 4096])
    with messages() as said:
        field.UpdatePipeline()
    assert_says(said.text, "A field of 4096 x 4096 x 4096 points needs 1100 GB of memory")
    with messages() as said:
        field.Dimensions = [5, 6, 7]
        field.UpdatePipeline()
    assert said.text == "" and output(field).GetDimensions() == (5, 6, 7), said.text


def test_a_guarded_stroke_of_300_mm_bakes():
    strokes = brainshift.stamp((16, 16, 8), MIDDLE, 300.0, major=12.0, minor=10.0)
    bent = FreeFormDeformation(Input=volume(ball()), Strokes=strokes)
    with messages() as said:
        baked = BakeDeformation(Input=bent)
        baked.UpdatePipeline()
    assert said.text == "", said.text
    bent.UpdatePropertyInformation()
    assert bent.ShortenedStrokes == 1 and bent.MinimumJacobian > 0.0999, bent.MinimumJacobian
    assert output(baked).GetDimensions() == output(bent).GetDimensions()


def test_volumes_without_volume_are_named():
    for shape, words in (((1, 8, 8), "8 x 8 x 1"), ((1, 1, 1), "1 x 1 x 1")):
        filter = FreeFormDeformation(Input=volume(numpy.ones(shape, numpy.float32)))
        with messages() as said:
            filter.UpdatePipeline()
        assert_says(said.text, words + " points", "at least 2")


def test_an_empty_volume_is_named():
    filter = FreeFormDeformation(Input=volume(numpy.ones((0, 0, 0), numpy.float32)))
    with messages() as said:
        filter.UpdatePipeline()
    assert_says(said.text, "0 x 0 x 0 points", "at least 2")


def test_other_data_is_refused():
    try:
        filter = FreeFormDeformation(Input=Sphere())
        with messages() as said:
            filter.UpdatePipeline()
    except Exception as error:  # paraview.simple raises RuntimeError subclasses of its own
        assert "Input" in str(error) or "input" in str(error), str(error)
    else:
        assert_says(said.text, "vtkImageData")


run_tests(globals())
