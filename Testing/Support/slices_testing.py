# SPDX-License-Identifier: BSD-3-Clause
"""What tests of Deformed Slices share: flat views, grey colour maps, and slices sampled here."""

import numpy
from brainshift_testing import SIZE, view_along
from paraview import simple

#: The property that shows each plane, and the axis (x, y, z) it lies across.
PLANES = {"Sagittal": 0, "Coronal": 1, "Axial": 2}


def show_slices(source, view, planes=("Axial",), position=None, low=0.0, high=100.0,
                array="Intensity", association="POINTS"):
    """Deformed Slices of some planes, grey from `low` (black) to `high` (white)."""
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    color_grey(display, view, low, high, array, association)
    for plane in PLANES:
        setattr(display, f"Show{plane}", int(plane in planes))
    if position is not None:
        display.SlicePosition = list(position)
    return display


def color_grey(display, view, low, high, array="Intensity", association="POINTS"):
    simple.ColorBy(display, (association, array), separate=True)
    display.SetScalarBarVisibility(view, False)
    color = simple.GetColorTransferFunction(array, display, separate=True)
    color.ColorSpace = "RGB"
    color.Discretize = 0
    color.RGBPoints = [low, 0, 0, 0, high, 1, 1, 1]
    opacity = simple.GetOpacityTransferFunction(array, display, separate=True)
    opacity.Points = [low, 0, 0.5, 0, high, 1, 0.5, 0]


def show_sliced(source, view, axis, position, low, high):
    """ParaView's own road: the filter Slice of an ordinary volume, without light."""
    cut = simple.Slice(Input=source)
    cut.SliceType = "Plane"
    cut.SliceType.Origin = list(position)
    cut.SliceType.Normal = [float(i == axis) for i in range(3)]
    display = simple.Show(cut, view, "GeometryRepresentation")
    color_grey(display, view, low, high)
    display.SetPropertyWithName("DisableLighting", 1)
    display.InterpolateScalarsBeforeMapping = 1
    return display


def flat_view(axis, middle, half_height, size=SIZE):
    """A parallel view that looks along an axis towards smaller coordinates."""
    direction = [-float(i == axis) for i in range(3)]
    up = (0, 1, 0) if axis == 2 else (0, 0, 1)
    return view_along(direction, middle, 300.0, up, half_height, size)


def pixel_positions(right, up, middle, half_height, size=SIZE):
    """Where the pixels of a parallel view lie in the plane through `middle`: mm, indexed [row from
    below, column, xyz]. `right`, `up`: directions in the view."""
    steps = ((numpy.arange(size) + 0.5) / size * 2 - 1) * half_height
    return (numpy.asarray(middle, float) + steps[None, :, None] * numpy.asarray(right, float)
            + steps[:, None, None] * numpy.asarray(up, float))


def trilinear(voxels, grid):
    """Voxels [z, y, x] at grid coordinates (..., xyz), and where those lie inside."""
    sides = numpy.array(voxels.shape[::-1])
    inside = ((grid >= 0) & (grid <= sides - 1)).all(axis=-1)
    below = numpy.clip(numpy.floor(grid).astype(int), 0, sides - 2)
    share = numpy.clip(grid - below, 0.0, 1.0)
    value = numpy.zeros(grid.shape[:-1])
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.where(corner, share, 1 - share).prod(axis=-1)
        x, y, z = (below[..., axis] + corner[axis] for axis in range(3))
        value += weight * voxels[z, y, x]
    return value, inside


def cubic_spline(voxels, grid):
    """The uniform cubic B-spline with the voxels [z, y, x] as coefficients, at grid coordinates."""
    below = numpy.floor(grid).astype(int)
    t = grid - below
    weights = numpy.stack([(1 - t) ** 3, 3 * t ** 3 - 6 * t ** 2 + 4,
                           -3 * t ** 3 + 3 * t ** 2 + 3 * t + 1, t ** 3]) / 6
    sides = voxels.shape[::-1]
    value = numpy.zeros(grid.shape[:-1])
    for corner in numpy.ndindex(4, 4, 4):
        index = [numpy.clip(below[..., axis] + corner[axis] - 1, 0, sides[axis] - 1)
                 for axis in range(3)]
        weight = numpy.prod([weights[corner[axis]][..., axis] for axis in range(3)], axis=0)
        value += weight * voxels[index[2], index[1], index[0]]
    return value
