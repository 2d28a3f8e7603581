# SPDX-License-Identifier: BSD-3-Clause
# Proves that Bake Deformation moves voxels to where the strokes move tissue, on real data too.
import numpy
from brainshift_testing import (assert_says, ball, data, load_plugin, messages, output, run_tests,
                                volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import BakeDeformation, FreeFormDeformation, OpenDataFile  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)


def center_of_mass(intensity):
    z, y, x = numpy.mgrid[tuple(slice(0, side) for side in intensity.shape)]
    return numpy.array([(axis * intensity).sum() for axis in (x, y, z)]) / intensity.sum()


def test_no_stroke_changes_nothing():
    head = OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    filter = FreeFormDeformation(Input=head)
    for interpolation in ("Nearest", "Linear", "Cubic"):
        baked = BakeDeformation(Input=filter, Interpolation=interpolation)
        assert numpy.array_equal(voxels(baked), voxels(head)), interpolation
        assert output(baked).GetBounds() == output(head).GetBounds()


def test_tissue_goes_where_the_stroke_says():
    ball_source = volume(ball(radius=3.0))
    shift = numpy.array([3.0, -2.0, 1.5])
    filter = FreeFormDeformation(
        Input=ball_source, Strokes=brainshift.soft(MIDDLE, shift, 60.0, sigma=5.0))
    moved = center_of_mass(voxels(BakeDeformation(Input=filter)))
    assert numpy.allclose(moved, MIDDLE + shift, atol=0.1), moved
    filter.Strength = 0.5
    moved = center_of_mass(voxels(BakeDeformation(Input=filter)))
    assert numpy.allclose(moved, MIDDLE + 0.5 * shift, atol=0.1), moved


def test_negated_differs_from_exact():
    strokes = brainshift.stamp(MIDDLE, (16, 16, 0), 5.0, major=12.0, minor=10.0)
    filter = FreeFormDeformation(Input=volume(ball(radius=6.0)), Strokes=strokes)
    exact = voxels(BakeDeformation(Input=filter)).copy()
    filter.Inverse = "Negated"
    negated = voxels(BakeDeformation(Input=filter))
    assert numpy.abs(exact - negated).max() > 20.0


def test_labels_stay_labels():
    labels = (ball(radius=9.0) > 50).astype(numpy.uint8) * 7
    labels[ball(radius=4.0) > 50] = 40
    strokes = brainshift.soft(MIDDLE, (2.3, 1.1, -0.7), 14.0)
    filter = FreeFormDeformation(Input=volume(labels), Strokes=strokes)
    baked = voxels(BakeDeformation(Input=filter, Interpolation="Nearest"))
    assert baked.dtype == numpy.uint8
    assert set(numpy.unique(baked)) == {0, 7, 40}
    assert (baked != labels).sum() > 100


def test_voxels_without_a_number_stay_without_one():
    """NaN outside the brain, and one voxel of each infinity."""
    head = ball(radius=12.0, edge=20.0)
    head[head < 20.0] = numpy.nan
    head[16, 16, 16], head[16, 16, 12] = numpy.inf, -numpy.inf
    filter = FreeFormDeformation(Input=volume(head))
    for interpolation in ("Nearest", "Linear", "Cubic"):
        bake = BakeDeformation(Input=filter, Interpolation=interpolation)
        filter.Strokes = []
        assert numpy.array_equal(voxels(bake), head, equal_nan=True), interpolation
        filter.Strokes = brainshift.stamp(MIDDLE, (16, 16, 0), 4.0, major=12.0, minor=10.0)
        known = voxels(bake)[numpy.isfinite(voxels(bake))]
        assert 1000 < known.size < 1.3 * numpy.isfinite(head).sum(), known.size
        assert 0.0 < known.min() and known.max() < 120.0, (known.min(), known.max())


def test_a_plain_volume_is_refused():
    bake = BakeDeformation(Input=volume(ball()))
    with messages() as said:
        bake.UpdatePipeline()
    assert_says(said.text, "carries no deformation", "Free-Form Deformation")


run_tests(globals())
