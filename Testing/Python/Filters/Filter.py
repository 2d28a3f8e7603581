# SPDX-License-Identifier: BSD-3-Clause
# Proves that Python can drive Free-Form Deformation: strokes go in, the lattice is attached, the
# voxels stay as they were, and bad values lose nothing.
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from brainshift_testing import (assert_says, ball, field, load_plugin, messages, output, run_tests,
                                volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import FreeFormDeformation  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
STAMP = brainshift.stamp(MIDDLE, (16.0, 16.0, 0.0), 3.0, major=14.0, minor=10.0)
FIELD_ARRAYS = ("FFDDisplacements", "FFDDimensions", "FFDBox", "FFDKernel", "FFDSamples",
                "FFDInverse", "FFDStrength")


def bent():
    return FreeFormDeformation(Input=volume(ball()), Strokes=STAMP)


def information(filter, name):
    filter.SMProxy.UpdatePropertyInformation()
    return filter.SMProxy.GetProperty(name).GetElement(0)


def expect_kept(filter, displacements, *words):
    """The filter says the words once updated, and its lattice stays."""
    with messages() as said:
        filter.UpdatePipeline()
    assert_says(said.text, "stays as it was", *words)
    assert numpy.array_equal(field(filter, "FFDDisplacements"), displacements)


def test_passes_voxels_by_reference():
    filter = bent()
    source = output(filter.Input)
    passed = vtk_to_numpy(output(filter).GetPointData().GetScalars())
    assert numpy.shares_memory(passed, vtk_to_numpy(source.GetPointData().GetScalars()))
    assert source.GetFieldData().GetNumberOfArrays() == 0


def test_attaches_the_lattice():
    filter = bent()
    for name in FIELD_ARRAYS:
        assert field(filter, name) is not None, name
    assert field(filter, "FFDDisplacements").shape == (19 ** 3, 3)
    assert field(filter, "FFDDimensions").tolist() == [[19, 19, 19]]
    assert numpy.allclose(field(filter, "FFDBox")[0, :6], [0, 0, 0] + [32 / 18] * 3)


def test_strokes_move_what_they_say():
    filter = bent()
    displacements = field(filter, "FFDDisplacements")
    point = displacements[(9 * 19 + 9) * 19 + 9]  # the control point in the middle
    assert numpy.allclose(point, (0, 0, 3)), point
    assert math.isclose(information(filter, "MaximumDisplacement"), 3.0, rel_tol=1e-6)
    assert 0.1 < information(filter, "MinimumJacobian") < 1.0
    filter.Strokes = brainshift.move((0, 0, 0), (0.25, 0.5, 0.75))
    displacements = field(filter, "FFDDisplacements")
    assert displacements[0].tolist() == [0.25, 0.5, 0.75]
    assert not displacements[1:].any()


def test_strokes_come_back():
    filter = bent()
    assert tuple(filter.Strokes) == STAMP
    filter.Strokes = STAMP + brainshift.soft(MIDDLE, (1, 0, 0), 8.0)
    assert len(filter.Strokes) == 28
    filter.Strokes = []
    assert not field(filter, "FFDDisplacements").any()


def test_adding_a_stroke_applies_one():
    filter = bent()
    output(filter)
    filter.Strokes = STAMP + STAMP
    output(filter)
    assert information(filter, "AppliedStrokes") == 1


def test_guard_shortens_strokes_and_tells_it():
    filter = bent()
    far = brainshift.stamp(MIDDLE, (16.0, 16.0, 0.0), 40.0, major=14.0, minor=10.0)
    filter.Strokes = STAMP + far
    output(filter)
    assert information(filter, "MinimumJacobian") >= 0.1
    assert information(filter, "ShortenedStrokes") == 1
    assert filter.StrokeShares[0] == 1.0 and 0.0 < filter.StrokeShares[1] < 0.9
    assert tuple(filter.Strokes) == STAMP + far, "the numbers are the user's"
    filter.GuardFolding = 0
    output(filter)
    assert information(filter, "MinimumJacobian") < 0.0
    assert information(filter, "ShortenedStrokes") == 0


def test_strength_scales():
    filter = bent()
    whole = field(filter, "FFDDisplacements")
    filter.Strength = 0.5
    assert field(filter, "FFDStrength").ravel().tolist() == [0.5]
    assert numpy.array_equal(field(filter, "FFDDisplacements"), whole)
    assert math.isclose(information(filter, "MaximumDisplacement"), 1.5, rel_tol=1e-6)


def test_point_of_interest_starts_in_the_middle():
    filter = bent()
    assert tuple(filter.PointOfInterest) == MIDDLE
    good = field(filter, "FFDDisplacements")
    filter.PointOfInterest = [math.nan, 0, 0]
    expect_kept(filter, good, "Point Of Interest is nan 0 0 mm", "finite")
    given = FreeFormDeformation(Input=volume(ball()), PointOfInterest=[1, 2, 3])
    assert tuple(given.PointOfInterest) == (1, 2, 3)


def test_a_base_lattice_comes_and_goes():
    shift = numpy.zeros((2, 2, 2, 3), numpy.float32)
    shift[..., 0] = 2.5
    filter = FreeFormDeformation(Input=volume(ball()), Lattice=volume(shift, spacing=(32,) * 3))
    assert numpy.allclose(field(filter, "FFDDisplacements"), (2.5, 0, 0))
    filter.Lattice = None
    assert not field(filter, "FFDDisplacements").any()


def test_lattice_density_replays():
    filter = bent()
    filter.LatticeDimensions = [9, 10, 11]
    assert field(filter, "FFDDimensions").tolist() == [[9, 10, 11]]
    assert field(filter, "FFDDisplacements").shape == (990, 3)
    assert tuple(filter.Strokes) == STAMP
    assert information(filter, "MaximumDisplacement") > 2.0


def test_wrong_strokes_keep_the_deformation():
    filter = bent()
    good = field(filter, "FFDDisplacements")
    filter.Strokes = STAMP + (1.0,)
    expect_kept(filter, good, "Strokes holds 15 numbers", "14")
    filter.Strokes = STAMP[:4] + (math.nan,) + STAMP[5:]
    expect_kept(filter, good, "Stroke 1", "number 4 is nan")
    filter.Strokes = STAMP[:10] + (-1.0,) + STAMP[11:]
    expect_kept(filter, good, "Stroke 1", "-1", "below 0 mm")
    filter.Strokes = (7,) + STAMP[1:]
    expect_kept(filter, good, "tool is 7", "0 (Move), 1 (Soft)")
    filter.Strokes = STAMP
    assert numpy.array_equal(field(filter, "FFDDisplacements"), good)


def test_wrong_lattices_keep_the_deformation():
    filter = bent()
    good = field(filter, "FFDDisplacements")
    filter.LatticeDimensions = [1, 19, 19]
    expect_kept(filter, good, "Lattice Dimensions is 1 x 19 x 19", "4 to 257")
    filter.LatticeDimensions = [19, 19, 2000]
    expect_kept(filter, good, "Lattice Dimensions is 19 x 19 x 2000", "4 to 257")
    filter.LatticeDimensions = [19, 19, 19]
    filter.Samples = 99
    expect_kept(filter, good, "Samples is 99", "0 to 16")


run_tests(globals())
