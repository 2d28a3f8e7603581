# SPDX-License-Identifier: BSD-3-Clause
"""What tests of gradient opacity and 2D transfer functions share: both, for ParaView's "Volume" and
for Deformed Volume, and the steepness that VTK looks them up with."""

import numpy
from brainshift_testing import picture
from stock_testing import prop_of
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPiecewiseFunction

EDGES = [0.0, 0.0, 3.0, 0.0, 8.0, 1.0]  # gradient and factor: what is even is hidden
ENTRIES = 1024  # a side: VTK uses a table of this size as it is, and enlarges others


def faded(factors, **properties):
    """A configure(display, view) that sets gradient opacity: ParaView's "Volume" has no property
    for it, so VTK's own is set."""
    def configure(display, view):
        for name, value in properties.items():
            setattr(display, name, value)
        if display.Representation == "Deformed Volume":
            display.GradientOpacity = factors
            return
        picture(view)
        function = vtkPiecewiseFunction()
        for gradient, factor in zip(factors[::2], factors[1::2]):
            function.AddPoint(gradient, factor)
        prop_of(view).GetProperty().SetGradientOpacity(function)
    return configure


def grid_of_table(columns=ENTRIES, rows=ENTRIES):
    """Shares of the scalar's range and of steepness of each entry [row, column]."""
    return numpy.meshgrid(numpy.linspace(0, 1, columns), numpy.linspace(0, 1, rows))


def table_of(red, green, blue, opacity):
    """A 2D transfer function from arrays [steepness, scalar]."""
    texels = numpy.stack(numpy.broadcast_arrays(red, green, blue, opacity), axis=-1)
    rows, columns = texels.shape[:2]
    array = numpy_to_vtk(texels.reshape(-1, 4).astype(numpy.float32), deep=True)
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.GetPointData().SetScalars(array)
    return image


def shell_table(**size):
    """Steep tissue of middle scalars in colours of both, and nothing else."""
    scalar, steep = grid_of_table(**size)
    opacity = 0.5 * numpy.exp(-((scalar - 0.45) / 0.15) ** 2 - ((steep - 0.3) / 0.1) ** 2)
    opacity[opacity < 0.01] = 0.0
    return table_of(scalar, 1.0 - scalar, numpy.clip(2.0 * steep, 0, 1), opacity)


def tabled(table, **properties):
    """A configure(display, view) that sets a 2D transfer function."""
    def configure(display, view):
        for name, value in properties.items():
            setattr(display, name, value)
        display.UseTransfer2D = 1
        picture(view)
        prop_of(view).GetProperty().SetTransferFunction2D(table)
    return configure


def steepness_of_ramp(slopes, shape, spacing):
    """VTK's steepness of a ramp: `slopes` (for 1 mm), values and mm a side along x, y, z. VTK takes
    differences over N / (N - 1) voxels as if these were one."""
    slopes, shape, spacing = (numpy.asarray(a, float) for a in (slopes, shape, spacing))
    extent = numpy.abs(slopes * (shape - 1) * spacing).sum()  # of the scalars
    gradient = numpy.linalg.norm(slopes * shape / (shape - 1))
    return gradient * spacing.mean() / (0.25 * extent)


def ramp(slopes, shape, spacing):
    """Scalars [z, y, x] that rise by `slopes` for 1 mm."""
    z, y, x = numpy.mgrid[0:shape[2], 0:shape[1], 0:shape[0]].astype(float)
    values = x * slopes[0] * spacing[0] + y * slopes[1] * spacing[1] + z * slopes[2] * spacing[2]
    return values.astype(numpy.float32)
