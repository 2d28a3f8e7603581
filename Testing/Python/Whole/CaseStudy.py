# SPDX-License-Identifier: BSD-3-Clause
# Proves that the case study in Examples brings a brain to what a pointer traced. Ten stamps, four
# and nine pulls, and a fit, found from the trace alone, reduce the trace distance and the target
# registration error, and the pictures agree better.
import os
import sys

import numpy
from brainshift_testing import load_plugin, picture, run_tests
from paraview.simple import Delete

load_plugin()
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../Examples"))
import brainshift  # noqa: E402 after the plugin
import case_study  # noqa: E402

SIZE = 150  # pixels


def disagreement(case):
    """How far red and green are apart on the coronal slice, mean, of full scale."""
    view = case_study.show_red_green(case.compare, "Coronal", (0, 1, 0), SIZE)
    image = picture(view)
    Delete(view)
    return numpy.abs(image[:, :, 0] - image[:, :, 1]).mean()


def agreement(case):
    """Share of the cortex in 3D, without the cavity, that is nearer to yellow than to red or
    green."""
    view = case_study.show_cortex(case.compare, SIZE)
    image = picture(view)
    Delete(view)
    red, green, blue = image.transpose(2, 0, 1)
    cortex = (numpy.maximum(red, green) > 0.3) & (blue < 0.1)
    return (numpy.minimum(red, green) > 0.5 * numpy.maximum(red, green))[cortex].mean()


def test_a_stamp_goes_to_the_worst_region_by_its_mean():
    # One region is 4 mm below, one 1 mm above. The first is pushed by 4 mm from where it is now.
    below = numpy.array((0.0, 0.0, 50.0)) + [(x, 0.0, 0.0) for x in (-1.0, 0.0, 1.0)]
    above = numpy.array((50.0, 0.0, 0.0)) + [(0.0, y, 0.0) for y in (-1.0, 0.0, 1.0)]
    distances = numpy.array((-4.0, -4.0, -4.0, 1.0, 1.0, 1.0))
    for sign, push in ((1.0, -4.0), (-1.0, 4.0)):
        stamp = case_study.next_stamp(numpy.vstack((below, above)), sign * distances,
                                      numpy.zeros(3), 15.0)
        expected = brainshift.stamp((0.0, 0.0, 50.0 - push), (0, 0, 0), push, 30.0, 30.0)
        assert numpy.allclose(stamp, expected), (stamp, expected)


def test_ten_stamps_reduce_every_error():
    case = case_study.Case()
    case.sag.UpdatePipeline()
    case.sag.UpdatePropertyInformation()
    assert 7.0 < case.sag.MaximumDisplacement < 8.5, case.sag.MaximumDisplacement
    assert len(case.landmarks) == 50
    before, apart_before, agreed_before = case.figures(), disagreement(case), agreement(case)
    case_study.stamp_to_trace(case.bent, case.measure)
    after, apart_after, agreed_after = case.figures(), disagreement(case), agreement(case)
    print(f"  {before}\n  {after}\n  red and green apart: {apart_before:.4f}, {apart_after:.4f}")
    print(f"  yellow: {agreed_before:.3f}, {agreed_after:.3f}")
    assert len(case.bent.Strokes) == 10 * brainshift.NUMBERS_PER_STROKE
    assert 100 < before["count"] == after["count"] < 300, "points in the cavity do not count"
    assert before["trace mean"] < -3.0 and abs(after["trace mean"]) < 0.5
    assert after["RMS"] < before["RMS"] / 5
    assert after["95th percentile"] < before["95th percentile"] / 4
    assert after["TRE mean"] < before["TRE mean"] / 1.6
    assert apart_after < apart_before / 1.3
    assert 1.0 - agreed_after < (1.0 - agreed_before) / 3


def test_regions_are_compact_and_whole():
    spots = numpy.array([(x, y, 0.0) for x in (0.0, 50.0) for y in (0.0, 50.0)])
    points = numpy.vstack([spot + numpy.random.default_rng(1).normal(0, 2.0, (20, 3))
                           for spot in spots])
    region = case_study.regions_of(points, 4)
    assert len({tuple(region[20 * i:20 * i + 20]) for i in range(4)}) == 4
    assert all(len(set(region[20 * i:20 * i + 20])) == 1 for i in range(4)), region


def test_pulls_and_a_fit_reduce_every_error():
    case = case_study.Case()
    before, found = case.figures(), {}
    for count in case_study.PULLS:
        case_study.pull_to_trace(case, count)
        assert len(case.bent.Lattice.Pulls) == 7 * count
        found[count] = case.figures()
        case.straighten()
        assert case.figures() == before
    fit = case_study.fit_to_trace(case)
    found["fit"] = case.figures()
    print(f"  {before}\n  {found}")
    for figures in found.values():
        assert figures["count"] == before["count"]
        assert figures["RMS"] < before["RMS"] / 3
        assert figures["TRE mean"] < before["TRE mean"]
        assert figures["TRE largest"] < before["TRE largest"]
        assert figures["smallest determinant"] > 0.5
    assert found[9]["RMS"] < found[4]["RMS"]
    assert found["fit"]["RMS"] < before["RMS"] / 8
    assert found["fit"]["TRE mean"] < before["TRE mean"] / 1.8
    assert found["fit"]["TRE largest"] < before["TRE largest"] / 2.5
    counts = numpy.isfinite(fit.trace_residuals)
    assert counts.sum() == before["count"], "points in the cavity do not count"


run_tests(globals())
