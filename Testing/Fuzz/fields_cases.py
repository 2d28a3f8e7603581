# SPDX-License-Identifier: BSD-3-Clause
"""Cases of fields in .vti files: the arrays that Free-Form Deformation attaches are spoiled, saved,
loaded, baked, drawn and given to other filters. Then a good file is loaded, which must look and
bake as it did before."""

import math
import os

from scene import array_of, difference, picture, shown

REALS = [math.nan, math.inf, -math.inf, 1e308, 1e38, -1e38, 1e30, 1e12, 1e5, -1e5, 300.0, -1.0, 0.0,
         1e-300, 1e-20, 0.5, 2.0, 1e3]
INTEGERS = [-2**31, -1, 0, 1, 2, 3, 4, 7, 8, 16, 17, 257, 258, 5000, 2**31 - 1]
KINDS = ["vtkFloatArray", "vtkDoubleArray", "vtkIntArray", "vtkUnsignedCharArray", "vtkLongArray"]


def _is_whole(array):
    return array.GetDataType() not in (10, 11)  # VTK_FLOAT, VTK_DOUBLE


def _number(random, array):
    value = random.choice(INTEGERS if _is_whole(array) else REALS)
    if array.GetDataType() == 10 and math.isfinite(value) and abs(value) > 3e38:
        return math.inf
    return value


def _spoil_numbers(random, fields, array):
    count = array.GetNumberOfValues()
    for _ in range(random.choice([1, 1, 3, count])):
        if count:
            array.SetComponent(*divmod(random.randrange(count), array.GetNumberOfComponents()),
                               _number(random, array))


def _spoil_length(random, fields, array):
    array.SetNumberOfTuples(random.choice([0, 1, 2, max(0, array.GetNumberOfTuples() - 1),
                                           array.GetNumberOfTuples() + 1]))
    for value in range(array.GetNumberOfValues()):
        array.SetComponent(*divmod(value, array.GetNumberOfComponents()), 1)


def _spoil_kind(random, fields, array):
    import vtkmodules.vtkCommonCore as core
    other = getattr(core, random.choice(KINDS))()
    other.DeepCopy(array)
    other.SetName(array.GetName())
    fields.AddArray(other)


def _spoil_away(random, fields, array):
    fields.RemoveArray(array.GetName())


SPOILED = [_spoil_numbers, _spoil_numbers, _spoil_numbers, _spoil_length, _spoil_kind, _spoil_away]


class Cases:
    """Saves and loads files, one for each case."""

    def __init__(self, folder):
        import brainshift
        import numpy
        from brainshift_testing import ball, output, volume
        from paraview import simple
        self.folder = folder
        voxels = ball(side=17, radius=5.0)
        strokes = brainshift.stamp((8, 8, 8), (8, 8, 0), 2.0, major=7.0, minor=5.0)
        bent = simple.FreeFormDeformation(
            Input=volume(voxels), Mask=volume(numpy.ones_like(voxels)), Strokes=list(strokes),
            LatticeDimensions=[5, 5, 5], Samples=2)
        self.image = output(bent)
        self.good = self._save("good.vti", self.image)
        self.reader = simple.XMLImageDataReader(FileName=[self.good])
        self.bake = simple.BakeDeformation(Input=self.reader)
        self.mesh = simple.DeformGeometry(
            Input=simple.Sphere(Center=[8, 8, 8], Radius=6.0), Deformation=self.reader)
        self.field = simple.DeformationField(
            Input=self.reader, SampleGrid="Given Dimensions", Dimensions=[4, 4, 4])
        self.again = simple.FreeFormDeformation(Input=self.reader, LatticeDimensions=[4, 4, 4])
        self.views = [
            shown(self.reader, kind)[0] for kind in ("Deformed Volume", "Deformed Slices")]
        self.before = self._state()

    def _save(self, name, image):
        from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
        writer = vtkXMLImageDataWriter()
        writer.SetFileName(os.path.join(self.folder, name))
        writer.SetInputData(image)
        writer.Write()
        return os.path.join(self.folder, name)

    def _state(self):
        found = {name: array_of(proxy) for name, proxy in (
            ("bake", self.bake), ("mesh", self.mesh), ("field", self.field))}
        self.again.UpdatePipeline()
        found.update({f"picture {i}": picture(view) for i, view in enumerate(self.views)})
        return found

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        image = self.image.NewInstance()
        image.DeepCopy(self.image)
        fields = image.GetFieldData()
        names = [fields.GetArrayName(i) for i in range(fields.GetNumberOfArrays())]
        done = []
        for _ in range(random.choice([1, 1, 2, 3])):
            name, spoil = random.choice(names), random.choice(SPOILED)
            if fields.GetArray(name):
                spoil(random, fields, fields.GetArray(name))
                done.append(f"{spoil.__name__[7:]} of {name}")
        with messages() as said:
            self.reader.FileName = [self._save(f"case{random.randrange(2)}.vti", image)]
            self._state()
            self.reader.FileName = [self.good]
            wrong = difference(self.before, self._state())
        if wrong:
            return f"stuck: {wrong} after {', '.join(done)}"
        return "refused" if "error" in said.text.lower() else "taken"
