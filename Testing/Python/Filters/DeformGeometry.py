# SPDX-License-Identifier: BSD-3-Clause
# Proves that meshes and blocks of meshes follow a deformed volume, and that the two maps of the
# module brainshift are exact, undo each other, and give the same numbers with a server.
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, on_server, output,
                                run_tests, server_finds_plugin, volume)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    DeformGeometry, FreeFormDeformation, GetActiveSource, GetSources, GroupDatasets,
    SetActiveSource, Sphere, Wavelet)

MIDDLE = (16.0, 16.0, 16.0)
SHIFT = numpy.array([3.0, -2.0, 1.5])
#: So wide that all of the volume moves by the same vector.
EVERYWHERE = brainshift.soft(MIDDLE, SHIFT, 1000.0, sigma=5.0)
STAMP = brainshift.stamp(MIDDLE, (16.0, 16.0, 0.0), 3.0, major=14.0, minor=10.0)


def bent(strokes):
    return FreeFormDeformation(Input=volume(ball()), Strokes=strokes)


def points_of(proxy):
    return vtk_to_numpy(output(proxy).GetPoints().GetData()).astype(float)


def random_points(count=400):
    return numpy.random.default_rng(5).uniform(-4.0, 36.0, (count, 3))


def test_a_mesh_follows_the_tissue():
    sphere = Sphere(Center=MIDDLE, Radius=6.0)
    moved = DeformGeometry(Input=sphere, Deformation=bent(EVERYWHERE))
    assert numpy.allclose(points_of(moved) - points_of(sphere), SHIFT, atol=0.05)
    moved.Direction = "Backward"
    assert numpy.allclose(points_of(moved) - points_of(sphere), -SHIFT, atol=0.05)


def test_a_mesh_follows_new_strokes():
    filter = bent(STAMP)
    moved = DeformGeometry(Input=Sphere(Center=MIDDLE, Radius=6.0), Deformation=filter)
    before = points_of(moved)
    filter.Strokes = STAMP + STAMP
    assert numpy.abs(points_of(moved) - before).max() > 1.0


def test_blocks_stay_blocks():
    near, far = Sphere(Center=MIDDLE, Radius=6.0), Sphere(Center=(10, 20, 10), Radius=3.0)
    moved = DeformGeometry(Input=GroupDatasets(Input=[near, far]), Deformation=bent(EVERYWHERE))
    blocks = output(moved)
    assert blocks.IsA("vtkDataObjectTree"), blocks.GetClassName()
    for index, sphere in enumerate((near, far)):
        block = blocks.GetBlock(index) if blocks.IsA("vtkMultiBlockDataSet") else (
            blocks.GetPartition(index, 0))
        points = vtk_to_numpy(block.GetPoints().GetData())
        assert numpy.allclose(points - points_of(sphere), SHIFT, atol=0.1), index


def test_maps_are_the_lattice_own():
    """Catmull-Rom passes through the control points' displacements, so there the map is known."""
    filter = bent(STAMP)
    moved = output(filter).GetFieldData()
    displacements = vtk_to_numpy(moved.GetArray("FFDDisplacements")).astype(float)
    z, y, x = numpy.mgrid[0:19, 0:19, 0:19].reshape(3, -1) * (32.0 / 18.0)
    control_points = numpy.stack((x, y, z), axis=1)
    found = brainshift.deformed_from_rest(filter, control_points)
    assert found.dtype == numpy.float64 and found.shape == control_points.shape
    assert numpy.abs(found - control_points - displacements).max() < 1e-5
    assert numpy.abs(displacements).max() > 2.5


def test_maps_undo_each_other():
    filter = bent(STAMP)
    points = random_points()
    moved = brainshift.deformed_from_rest(filter, points)
    assert numpy.abs(moved - points).max() > 2.0
    assert numpy.abs(brainshift.rest_from_deformed(filter, moved) - points).max() < 1e-3


def test_maps_leave_nothing_behind():
    filter = bent(STAMP)
    SetActiveSource(filter)
    sources = len(GetSources())
    brainshift.deformed_from_rest(filter, [MIDDLE])
    assert len(GetSources()) == sources and GetActiveSource() == filter
    assert brainshift.deformed_from_rest(filter, numpy.zeros((0, 3))).shape == (0, 3)


def test_wrong_input_is_named():
    try:
        brainshift.deformed_from_rest(bent(STAMP), [1.0, 2.0, 3.0])
    except ValueError as error:
        assert_says(str(error), "points", "(3,)", "N x 3")
    else:
        raise AssertionError("one position is no list of positions")
    with messages() as said:
        try:
            brainshift.rest_from_deformed(volume(ball()), [MIDDLE])
        except ValueError as error:
            assert_says(str(error), "Free-Form Deformation")
        else:
            raise AssertionError("a plain volume has no map")
    assert_says(said.text, "carries no deformation")


def test_a_server_maps_the_same():
    # This test is last, because the session ends with the connection.
    def answer():
        wavelet = Wavelet(WholeExtent=[0, 32, 0, 32, 0, 32])
        filter = FreeFormDeformation(Input=wavelet, Strokes=STAMP)
        points = random_points()
        return (brainshift.deformed_from_rest(filter, points),
                brainshift.rest_from_deformed(filter, points))
    here = answer()
    there = on_server(answer, **server_finds_plugin())
    assert numpy.array_equal(here, there)
    assert numpy.abs(here[0] - here[1]).max() > 2.0


run_tests(globals())
