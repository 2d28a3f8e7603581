# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled files: each is read by BrainShift and by a second reader, and compared.

A case is good if both read the same numbers at the same places, or if BrainShift refuses the file.
"""

import os

import nifti_oracle
import numpy
import text_oracle
import volume_oracle
from mutation import spoiled_file
from nifti_oracle import Open, Wrong

#: A voxel may lie this share of its size, and this share of its distance, from where it belongs.
PLACE, ROUNDING = 0.1, 1e-5


def image_of(proxy, name):
    """Where the points of an image lie and the numbers there; None if there is no image."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    image = proxy.GetClientSideObject().GetOutputDataObject(0)
    if image is None or image.GetNumberOfPoints() == 0:
        return None
    array = image.GetPointData().GetArray(name)
    sides = image.GetDimensions()
    values = vtk_to_numpy(array).reshape(*reversed(sides), -1).transpose(2, 1, 0, 3).astype(float)
    direction = image.GetDirectionMatrix()
    axes = numpy.array([[direction.GetElement(row, column) for column in range(3)]
                        for row in range(3)])
    return numpy.array(image.GetOrigin()), axes * image.GetSpacing(), values


def read(proxy_name, file, array):
    from paraview import simple
    proxy = getattr(simple, proxy_name)(FileName=file)
    try:
        proxy.UpdatePipeline()
        return image_of(proxy, array)
    finally:
        simple.Delete(proxy)


def misplaced(random, image, world, values):
    """What is wrong with an image beside the other reader's answers; None if nothing is."""
    origin, steps, found = image
    sides = values.shape[:3]
    if sorted(found.shape[:3]) != sorted(sides) or found.shape[3] != values.shape[3]:
        return f"{found.shape} in place of {values.shape}"
    indices = [[random.choice([0, side - 1, random.randrange(side)]) for side in sides]
               for _ in range(20)]
    for index in indices:
        place = world(index)
        grid = numpy.linalg.solve(steps, place - origin)
        nearest = numpy.round(grid).astype(int)
        rounding = ROUNDING * (1.0 + numpy.abs(numpy.linalg.inv(steps)) @ (
            numpy.abs(place) + numpy.abs(origin)))
        if (numpy.abs(grid - nearest) > PLACE + rounding).any():
            return f"voxel {index} lies at {grid}"
        if (nearest < 0).any() or (nearest >= found.shape[:3]).any():
            return f"voxel {index} lies outside, at {grid}"
        shown, stored = found[tuple(nearest)], values[tuple(index)]
        with numpy.errstate(over="ignore"):
            rounded = stored.astype(numpy.float32).astype(float)
        if not (numpy.isclose(shown, stored, rtol=1e-5, atol=1e-30, equal_nan=True) |
                numpy.isclose(shown, rounded, rtol=1e-5, atol=1e-30, equal_nan=True)).all():
            return f"voxel {index} holds {shown} in place of {stored}"
    return None


#: The reader of BrainShift, by its label, and the second reader for a name.
READERS = {"volume.mha": ("MetaImageVolumeReader", volume_oracle.meta_image),
           "volume.nrrd": ("NRRDVolumeReader", volume_oracle.nrrd),
           "volume.mgh": ("FreeSurferVolumeReader", volume_oracle.mgh)}


def _answer(name, data, as_field):
    """Where voxels lie and what they hold, by the second reader."""
    if name.startswith("case.nii"):
        volume = nifti_oracle.Volume(data)
        if as_field:
            return volume.world, volume.as_field()
        return volume.world, volume.values[:, :, :, 0, :]
    if not as_field:
        volume = READERS[name.removesuffix(".gz")][1](data)
        return volume.world, volume.values
    field = text_oracle.meta_image(data) if name == "field.mha" else text_oracle.nrrd(data)
    return field.world, field.values


def _compare(random, name, data, image, as_field):
    with numpy.errstate(all="ignore"):
        try:
            world, values = _answer(name, data, as_field)
        except Open:
            return "open"
        except Wrong as error:
            return f"accepted: the other reader says: {error}"
        if len(values.ravel()) == 0:
            return "open"
        problem = misplaced(random, image, world, values)
    return f"misplaced: {problem}" if problem else "same"


class Cases:
    """Reads spoiled files, one for each case."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        kind, data = spoiled_file(random)
        name = os.path.join(self.folder, kind)
        with open(name, "wb") as file:
            file.write(data)
        as_field = kind.startswith("field") or (
            kind.startswith("case") and random.random() < 0.5)
        reader = ("DisplacementFieldReader", "Displacement")
        if not as_field:
            named = READERS.get(kind.removesuffix(".gz"))
            reader = (named[0] if named else "NIFTIVolumeReader", "Intensity")
        with messages() as said:
            image = read(reader[0], name, reader[1])
        if image is None:
            return "refused" if "error" in said.text.lower() else "misplaced: no image and no error"
        if "is sheared" in said.text:
            return "sheared"
        return _compare(random, kind, data, image, as_field)
