# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled files: each is read by BrainShift and by a second reader, and compared.

A case is good if both read the same numbers at the same places, or if BrainShift refuses the file.
"""

import glob
import importlib
import os

import numpy
from oracle import Open, Wrong

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


def found_files():
    """What each format gives to be spoiled: FILES of its folder's NAME_spoiled.py."""
    here = os.path.dirname(os.path.abspath(__file__))
    modules = sorted(glob.glob(os.path.join(here, "..", "*", "*_spoiled.py")))
    return [file for path in modules
            for file in importlib.import_module(os.path.basename(path)[:-3]).FILES]


def _compare(random, spoiled, data, image):
    with numpy.errstate(all="ignore"):
        try:
            world, values = spoiled.answer(data)
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
        self.files = found_files()

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        spoiled = random.choice(self.files)
        kind, data = spoiled.spoil(random)
        name = os.path.join(self.folder, kind)
        with open(name, "wb") as file:
            file.write(data)
        with messages() as said:
            image = read(spoiled.reader, name, spoiled.array)
        if image is None:
            return "refused" if "error" in said.text.lower() else "misplaced: no image and no error"
        if "is sheared" in said.text:
            return "sheared"
        return _compare(random, spoiled, data, image)
