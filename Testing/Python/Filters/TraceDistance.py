# SPDX-License-Identifier: BSD-3-Clause
# Proves that a trace in a CSV file is measured against the bent cortex, with and without a
# segmentation and a cavity, and that the numbers reach Python and follow strokes.
import math

import numpy
from brainshift_testing import (assert_says, ball, data, load_plugin, messages, output, run_tests,
                                scratch, volume)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    Contour, CSVReader, DeformGeometry, FreeFormDeformation, OpenDataFile, TableToPoints,
    TraceDistance)

MIDDLE = numpy.array((16.0, 16.0, 16.0))
RADIUS = 9.0
SINK = brainshift.soft(MIDDLE, (0, 0, -3.0), 1000.0, sigma=5.0)  # all of it, by 3 mm


def trace_of(points):
    """A CSV file of points with times, opened."""
    name = scratch("trace.csv")
    with open(name, "w") as file:
        file.write("time,x,y,z\n")
        for time, point in enumerate(points):
            file.write(f"{time}," + ",".join(repr(float(value)) for value in point) + "\n")
    table = CSVReader(FileName=[name])
    return TableToPoints(Input=table, XColumn="x", YColumn="y", ZColumn="z")


def outside(distance):
    """Points all around the ball, that far out of it (mm)."""
    aside = numpy.random.default_rng(3).normal(size=(50, 3))
    aside /= numpy.linalg.norm(aside, axis=1)[:, None]
    return MIDDLE + (RADIUS + distance) * aside


def traced(points, strokes=(), **properties):
    filter = FreeFormDeformation(Input=volume(ball(radius=RADIUS)), Strokes=strokes)
    return TraceDistance(Input=trace_of(points), Deformation=filter,
                         **{"SurfaceArray": "Intensity", "Threshold": 50.0, **properties})


def distances(proxy):
    return vtk_to_numpy(output(proxy).GetPointData().GetArray("DistanceToCortex"))


def numbers(proxy):
    output(proxy)
    proxy.SMProxy.UpdatePropertyInformation()
    return proxy.Count, proxy.Mean, proxy.RMS, proxy.Percentile95


def test_a_csv_file_is_measured():
    for distance in (2.0, -2.0):
        measured = traced(outside(distance))
        assert numpy.allclose(distances(measured), distance, atol=0.1)
        assert output(measured).GetPointData().GetArray("time") is not None
        count, mean, rms, percentile = numbers(measured)
        assert count == 50
        assert math.isclose(mean, distance, abs_tol=0.06), mean
        assert math.isclose(rms, 2.0, abs_tol=0.06), rms
        assert math.isclose(percentile, 2.0, abs_tol=0.1), percentile


def test_the_histogram_is_that_of_the_array():
    measured = traced(numpy.concatenate((outside(2.0), outside(-1.0), outside(0.4))))
    shares = distances(measured)
    measured.SMProxy.UpdatePropertyInformation()
    width, *counts = measured.Histogram
    edges = width * numpy.arange(-16, 17)
    assert len(counts) == 32 and width == 2 ** round(math.log2(width)), (width, counts)
    assert edges[8] > -numpy.abs(shares).max() >= edges[0], "no bins are wasted"
    assert counts == numpy.histogram(shares, edges)[0].tolist(), counts


def test_numbers_follow_strokes():
    measured = traced(outside(0.0) + (0, 0, -3.0))
    before = numbers(measured)
    measured.Deformation.Strokes = SINK
    after = numbers(measured)
    assert before[2] > 1.0, before
    assert after[2] < 0.1, after
    assert vtk_to_numpy(output(measured).GetFieldData().GetArray("RMS"))[0] == after[2]


def test_a_segmentation_on_another_grid():
    small = volume((ball(side=17, radius=3.5) > 50).astype(numpy.uint8), spacing=(2.0, 2.0, 2.0))
    measured = traced(outside(0.0), Segmentation=small, Threshold=0.5)
    assert numpy.allclose(distances(measured), RADIUS - 7.0, atol=1.2)
    labels = volume((ball(side=17, radius=3.5) > 50).astype(numpy.uint8) * 5,
                    spacing=(2.0, 2.0, 2.0))
    by_label = traced(outside(0.0), Segmentation=labels, SurfaceBy="Label", Label=5)
    assert numpy.allclose(distances(by_label), distances(measured))


def test_a_cavity_is_left_out():
    z = numpy.mgrid[0:33, 0:33, 0:33][0]
    cavity = volume((z > 20).astype(numpy.uint8))
    points = outside(1.0)
    measured = traced(points, Cavity=cavity)
    gone = points[:, 2] >= 20.5
    assert 0 < gone.sum() < 50
    assert numpy.array_equal(numpy.isnan(distances(measured)), gone)
    assert numbers(measured)[0] == 50 - gone.sum()
    # Of a segmentation after surgery, one label is the cavity and others are tissue.
    labelled = volume(numpy.where(z > 20, 7, 1).astype(numpy.uint8))
    by_label = traced(points, Cavity=labelled, CavityLabels=[7])
    assert numpy.array_equal(numpy.isnan(distances(by_label)), gone)


def test_a_real_brain():
    """Points on the brain's surface, sunk with it, lie on it: whatever the stroke."""
    mask = OpenDataFile(data("seg3d-utah", "seg3d_brainmask.nii.gz"))
    filter = FreeFormDeformation(Input=mask)
    top = (-342.0, 36.0, 534.0)
    filter.Strokes = brainshift.stamp(top, (-309, 22, 477), -10.0)
    surface = Contour(Input=mask, ContourBy=["POINTS", "Intensity"], Isosurfaces=[0.5])
    sunk = DeformGeometry(Input=surface, Deformation=filter)
    measured = TraceDistance(Input=sunk, Deformation=filter)
    count, mean, rms, percentile = numbers(measured)
    assert count > 50000
    assert rms < 0.01 and percentile < 0.01 and abs(mean) < 0.01, (mean, rms, percentile)
    unsunk = TraceDistance(Input=surface, Deformation=filter)
    assert numbers(unsunk)[3] < numpy.nanmax(distances(unsunk))
    assert 5.0 < numpy.nanmax(distances(unsunk)) < 10.0


def test_a_wrong_threshold_is_named():
    measured = traced(outside(0.0), Threshold=700.0)
    with messages() as said:
        measured.UpdatePipeline()
    assert_says(said.text, "Threshold is 700", "no surface", "0 to 100")


run_tests(globals())
