# SPDX-License-Identifier: BSD-3-Clause
"""Compares where BrainShift's readers and readers of others put the voxels of a file."""

import numpy
from brainshift_testing import output, voxels
from paraview import simple

#: Farthest that a voxel may lie from where another reader puts it, mm.
LARGEST_MM = 1e-3


def opened(name, proxy_name):
    """The source that File > Open makes of a file. It must be ours."""
    source = simple.OpenDataFile(name)
    assert source is not None, f"no reader for {name}"
    assert source.GetXMLName() == proxy_name, (name, source.GetXMLName())
    return source


def matrix(image):
    """The affine from grid indices to the world."""
    direction = image.GetDirectionMatrix()
    affine = numpy.eye(4)
    for row in range(3):
        for column in range(3):
            affine[row, column] = direction.GetElement(row, column) * image.GetSpacing()[column]
    affine[:3, 3] = image.GetOrigin()
    return affine


def places(values, affine):
    """World positions of voxels by their values, which are 1, 2, 3, ..."""
    indices = numpy.indices(values.shape).reshape(3, -1).T
    order = numpy.argsort(values.ravel())
    assert (values.ravel()[order] == numpy.arange(1, values.size + 1)).all(), values
    return (indices @ affine[:3, :3].T + affine[:3, 3])[order]


def assert_has_ras_axes(source, name):
    """The grid runs along the nearest RAS axes, and the volume says so."""
    world = output(source).GetFieldData().GetAbstractArray("WorldAxes")
    assert world is not None and world.GetValue(0) == "RAS", name
    steps = matrix(output(source))[:3, :3]
    assert (numpy.argmax(numpy.abs(steps), axis=0) == (0, 1, 2)).all(), (name, steps)
    assert (numpy.diag(steps) > 0).all(), (name, steps)


def assert_same_places(name, proxy_name, judged):
    """Our reader and the judge put all voxels, the eight corners among them, at the same places."""
    source = opened(name, proxy_name)
    found = places(voxels(source).transpose(2, 1, 0), matrix(output(source)))
    expected = places(numpy.asarray(judged.dataobj), judged.affine)
    distance = numpy.linalg.norm(found - expected, axis=1).max()
    assert distance < LARGEST_MM, (name, distance)
    assert_has_ras_axes(source, name)
    simple.Delete(source)
    return distance


def assert_same_head(source, first):
    """Voxels to the bit, grid and axes: what pictures and letters are made of."""
    image, known = output(source), output(first)
    assert image.GetDimensions() == known.GetDimensions()
    for mine, other in ((image.GetOrigin(), known.GetOrigin()),
                        (image.GetSpacing(), known.GetSpacing())):
        assert numpy.abs(numpy.subtract(mine, other)).max() < 1e-4, (mine, other)
    assert numpy.abs(matrix(image) - matrix(known)).max() < 1e-4
    assert image.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
    assert (voxels(source) == voxels(first).astype(numpy.float32)).all()
