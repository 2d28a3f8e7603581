# SPDX-License-Identifier: BSD-3-Clause
"""Images as arrays of numbers, at positions in mm."""


def fetched(source):
    """The image that a source makes, in this process. Raises `ValueError` if it makes none."""
    from paraview import servermanager

    source.UpdatePipeline()
    image = servermanager.Fetch(source)
    if image is None or not image.IsA("vtkImageData"):
        raise ValueError(f"{source.SMProxy.GetXMLName()} makes no image")
    return image


def source_of(data, refusal, **names):
    """A ParaView source of a VTK data set of this process. `names`: as of `simple.TrivialProducer`.
    Raises `refusal`, an exception, while a server is connected: ParaView sends it no data."""
    from paraview import servermanager, simple

    if servermanager.ActiveConnection.IsRemote():
        raise refusal
    source = simple.TrivialProducer(**names)
    source.GetClientSideObject().SetOutput(data)
    return source


def interpolated(values, places):
    """Trilinear values of an array at fractional indices.

    - `values`: indexed [z, y, x] or [z, y, x, component]
    - `places`: N x 3 indices: x, y, z. Those outside are moved to the nearest edge.
    """
    import numpy

    sides = numpy.array(values.shape[2::-1])
    places = numpy.clip(places, 0.0, sides - 1)
    low = numpy.minimum(places.astype(int), numpy.maximum(sides - 2, 0))
    part = places - low
    step = numpy.minimum(sides - 1, 1)
    flat = values.reshape(sides.prod(), -1)
    result = 0.0
    for corner in numpy.ndindex(2, 2, 2):
        x, y, z = (low + step * corner).T
        weight = numpy.where(corner, part, 1.0 - part).prod(axis=1)
        result = result + weight[:, None] * flat[(z * sides[1] + y) * sides[0] + x]
    return result.reshape(len(places), *values.shape[3:])


class Labels:
    """The voxels of an image that have some labels.

    - `inside`: the mask as numbers, 0 or 1, indexed [z, y, x]
    - `world`: 4 x 4 matrix, mm from index x, y, z of a voxel's middle
    """

    def __init__(self, image, labels=()):
        """`labels`: the values that count. Empty, the default: all above 0."""
        import numpy
        from vtkmodules.util.numpy_support import vtk_to_numpy

        sides = numpy.array(image.GetDimensions())
        scalars = image.GetPointData().GetScalars() or image.GetPointData().GetArray(0)
        in_cells = scalars is None
        if in_cells:
            scalars = image.GetCellData().GetScalars() or image.GetCellData().GetArray(0)
            sides = numpy.maximum(sides - 1, 1)
        if scalars is None or scalars.GetNumberOfComponents() != 1:
            raise ValueError("the image has no array of one component")
        values = vtk_to_numpy(scalars).reshape(sides[::-1])
        inside = numpy.isin(values, list(labels)) if len(labels) else values > 0
        self._padded = numpy.pad(inside.astype(numpy.float32), 1)  # for each of many `fractions`
        self.inside = self._padded[1:-1, 1:-1, 1:-1]
        matrix = image.GetIndexToPhysicalMatrix()
        self.world = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
        first = numpy.array(image.GetExtent()[::2]) + (0.5 if in_cells else 0.0)
        self.world[:3, 3] += self.world[:3, :3] @ first

    @property
    def voxel(self):
        """Volume of a voxel, mm^3."""
        import numpy

        return float(abs(numpy.linalg.det(self.world[:3, :3])))

    @property
    def sides(self):
        """Lengths of the edges of a voxel, mm."""
        import numpy

        return numpy.linalg.norm(self.world[:3, :3], axis=0)

    def moved(self, motion):
        """The same voxels, moved by a 4 x 4 matrix (mm)."""
        import copy

        result = copy.copy(self)
        result.world = motion @ self.world
        return result

    def positions(self, indices):
        """Positions (mm) of N x 3 indices."""
        return indices @ self.world[:3, :3].T + self.world[:3, 3]

    def indices(self, positions):
        """Fractional indices of N x 3 positions (mm)."""
        import numpy

        inverse = numpy.linalg.inv(self.world)
        return positions @ inverse[:3, :3].T + inverse[:3, 3]

    def box(self, margin=0):
        """First and last index, x, y, z, of the voxels inside, and so many more on each side."""
        import numpy

        found = [numpy.flatnonzero(self.inside.any(axis=axes)) for axes in ((0, 1), (0, 2), (1, 2))]
        if not len(found[0]):
            raise ValueError("no voxel has these labels")
        low, high = (numpy.array([each[end] for each in found]) for end in (0, -1))
        return low - margin, high + margin

    def fractions(self, positions):
        """The fraction of tissue with these labels, 0 to 1, at N x 3 positions (mm): between the
        middles of voxels trilinear, 0 outside of the image."""
        import numpy

        places = self.indices(positions)
        last = numpy.array(self.inside.shape[::-1]) - 1
        within = ((places > -1.0) & (places < last + 1.0)).all(axis=1)
        result = numpy.zeros(len(places))
        result[within] = interpolated(self._padded, places[within] + 1.0)
        return result

    def image(self, values, low=(0, 0, 0)):
        """A vtkImageData of labels, uint8, indexed [z, y, x], whose first voxel has the index
        `low` here."""
        import numpy
        from vtkmodules.util.numpy_support import numpy_to_vtk
        from vtkmodules.vtkCommonDataModel import vtkImageData

        image, sides = vtkImageData(), self.sides
        image.SetDimensions(*values.shape[::-1])
        image.SetSpacing(*sides)
        image.SetOrigin(*self.positions(numpy.asarray(low, float)[None])[0])
        image.SetDirectionMatrix(*(self.world[:3, :3] / sides).ravel())
        array = numpy_to_vtk(numpy.ascontiguousarray(values, numpy.uint8).ravel(), deep=True)
        array.SetName("Labels")
        image.GetPointData().SetScalars(array)
        return image
