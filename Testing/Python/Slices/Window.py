# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.percentile_window finds the percentiles of the tissue, without the
# background and whatever a few bright voxels are, that a server counts the same, and that four
# views are first seen in this window and keep it when a filter is applied.
import numpy
from brainshift_testing import (assert_says, load_plugin, on_server, run_tests,
                                server_finds_plugin, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    Calculator, Delete, FreeFormDeformation, GetDisplayProperties, SetActiveView, Wavelet)

SIDE = 40


def head(dtype=numpy.float32, scale=1.0, shift=0.0, spike=None):
    """A noisy dark background, and a third of tissue of which the values are known."""
    numbers = numpy.random.default_rng(7)
    voxels = numpy.abs(numbers.normal(0.0, 3.0, (SIDE,) * 3))
    tissue = numpy.zeros(voxels.shape, bool)
    tissue[:, :, :SIDE // 3] = True
    voxels[tissue] = numbers.uniform(100.0, 300.0, tissue.sum())
    voxels = voxels * scale + shift
    expected = numpy.percentile(voxels[tissue], [1, 99])
    if spike is not None:
        voxels[0, 0, 0] = spike
    return voxels.astype(dtype), expected


def assert_near(found, expected, share=0.02):
    assert found is not None
    assert numpy.allclose(found, expected, atol=share * (expected[1] - expected[0])), (
        found, expected)


def window_of_wavelet():
    values = Calculator(Input=Wavelet(WholeExtent=[-12, 12, -12, 12, -12, 12]),
                        ResultArrayName="Squared", Function="RTData*RTData")
    values.UpdatePipeline()
    return brainshift.percentile_window(values, "POINTS", "Squared")


EXPECTED = window_of_wavelet()  # while there is a session


def test_the_tissue_counts_and_the_background_does_not():
    for kind in (dict(), dict(dtype=numpy.int16), dict(dtype=numpy.float64, scale=0.001),
                 dict(shift=-1024.0), dict(spike=5000.0), dict(spike=numpy.nan)):
        voxels, expected = head(**kind)
        source = volume(voxels)
        assert_near(brainshift.percentile_window(source, "POINTS", "Intensity"), expected)


def test_cells_and_other_percentiles():
    voxels, _ = head()
    expected = numpy.percentile(voxels[voxels > 50], [10, 60])
    source = volume(voxels, cells=True)
    assert_near(brainshift.percentile_window(source, "CELLS", "Intensity", (10, 60)), expected)


def test_a_volume_without_background_counts_whole():
    numbers = numpy.random.default_rng(3)
    voxels = numbers.normal(500.0, 20.0, (SIDE,) * 3).astype(numpy.float32)
    voxels[:4] = numbers.uniform(0.0, 400.0, voxels[:4].shape)  # the commonest value is bright
    found = brainshift.percentile_window(volume(voxels), "POINTS", "Intensity")
    assert_near(found, numpy.percentile(voxels, [1, 99]))


def test_what_has_no_window():
    for voxels in (numpy.zeros((4, 4, 4), numpy.float32),
                   numpy.zeros((4, 4, 4, 3), numpy.float32)):
        assert brainshift.percentile_window(volume(voxels), "POINTS", "Intensity") is None
    source = volume(head()[0])
    assert brainshift.percentile_window(source, "POINTS", "Nothing") is None
    for percentiles in ((99, 1), (-1, 50), (0, 101), (5,)):
        try:
            brainshift.percentile_window(source, "POINTS", "Intensity", percentiles)
            raise AssertionError("wrong percentiles passed")
        except ValueError as error:
            assert_says(str(error), "percentiles", str(percentiles), "0 to 100")


def test_four_views_are_first_seen_in_it():
    voxels, expected = head(spike=5000.0)
    source = FreeFormDeformation(Input=volume(voxels))
    SetActiveView(None)
    views = brainshift.four_views(source)
    grey = GetDisplayProperties(source, views["axial"]).LookupTable
    ends = [grey.RGBPoints[0], grey.RGBPoints[-4]]
    assert_near(ends, expected)
    assert grey.AutomaticRescaleRangeMode == "Never", "what is applied later does not change it"
    for view in views.values():
        Delete(view)


def test_a_server_counts_the_same():
    assert EXPECTED is not None and EXPECTED[0] < EXPECTED[1]
    assert on_server(window_of_wavelet, **server_finds_plugin()) == EXPECTED


run_tests(globals())
