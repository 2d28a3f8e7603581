# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled transform files: each is read, or refused with a sentence."""

import os

import numpy
from outside_testing import itk_text, parameter_file, write_hdf5, write_matlab

AFFINE = ("AffineTransform", (1.1, 0.1, 0, 0, 0.9, 0.2, 0, 0.1, 1, 4, -5, 6), (7, 8, 9))
SPLINE = ("BSplineTransform", numpy.linspace(-3, 3, 360),
          (4, 5, 6, -10, 20, 30, 9, 8, 7, 1, 0, 0, 0, 1, 0, 0, 0, 1))
PLATES = ("ThinPlateSplineKernelTransform",
          (0, 0, 0, 50, 0, 0, 0, 50, 0, 0, 0, 50, 30, 30, 30),
          (1, 0, 0, 50, 2, 0, 0, 50, 3, 4, 0, 50, 32, 31, 30))
OLD = ("BSplineDeformableTransform", *SPLINE[1:])
GEOMETRY = """valid = 1  # volume info valid
filename = some.mgz
volume = 30 40 50
voxelsize = 2.0 1.5 1.25
xras = -1 0 0
yras = 0 0 -1
zras = 0 1 0
cras = 3 -4 5
"""
LTA = ("type      = 0 # LINEAR_VOX_TO_VOX\nnxforms   = 1\nmean = 0 0 0\nsigma = 1\n1 4 4\n"
       "1.1 0.1 0 4\n0 0.9 0.2 -5\n0 0.1 1 6\n0 0 0 1\n"
       f"src volume info\n{GEOMETRY}dst volume info\n{GEOMETRY}fscale 0.1\n")
XFM = ("MNI Transform File\n% a comment\nTransform_Type = Linear;\nInvert_Flag = True;\n"
       "Linear_Transform =\n1.1 0.1 0 4\n0 0.9 0.2 -5\n0 0.1 1 6;\nTransform_Type = Linear;\n"
       "Linear_Transform =\n1.1 0.1 0 4\n0 0.9 0.2 -5\n0 0.1 1 6;\n")
#: A spoiled file is spoiled near its beginning in most cases: there are sizes and names.
BEGIN, BEGIN_SHARE = 3000, 0.7


def _spoiled(random, data):
    """A file with up to three things spoiled."""
    for _ in range(random.randint(1, 3)):
        reach = len(data) if random.random() > BEGIN_SHARE else min(len(data), BEGIN)
        if reach == 0:
            break
        at, choice = random.randrange(reach), random.random()
        if choice < 0.3:
            data[at] = random.choice((0, 127, 128, 255))
        elif choice < 0.6:
            data[at] = random.choice(b"0123456789.-e ")
        elif choice < 0.8:
            del data[at:]
        else:
            data[at:at + 8] = random.randbytes(8)
    return data


class Cases:
    """Reads spoiled files, one for each case."""

    def __init__(self, folder):
        self.folder = folder
        self.good = {ending: os.path.join(folder, "good" + ending)
                     for ending in (".tfm", ".txt", ".mat", ".h5")}
        members = (("CompositeTransform", None, None), AFFINE, SPLINE)
        with open(self.good[".tfm"], "w") as file:
            file.write(itk_text(*members))
        with open(parameter_file("for_fuzz.txt", SPLINE)) as made:
            with open(self.good[".txt"], "w") as file:
                file.write(made.read())
        for ending, text in ((".lta", LTA), (".xfm", XFM), ("_old.tfm", itk_text(OLD, AFFINE)),
                             ("_plates.tfm", itk_text(PLATES))):
            self.good[ending] = os.path.join(folder, "good" + ending)
            with open(self.good[ending], "w") as file:
                file.write(text)
        write_matlab(self.good[".mat"], AFFINE)
        write_hdf5(self.good[".h5"], *members)

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        import brainshift
        ending = random.choice(sorted(self.good))
        with open(self.good[ending], "rb") as file:
            data = _spoiled(random, bytearray(file.read()))
        name = os.path.join(self.folder, "case" + ending)
        with open(name, "wb") as file:
            file.write(data)
        try:
            transform = brainshift.read_transform(name)
        except OSError as problem:
            return "refused" if name in str(problem) else f"misplaced: {problem}"
        found = transform.map([(1.0, 2.0, 3.0), (5.0, -38.0, 48.0)])
        return "taken" if numpy.isfinite(found).all() else f"misplaced: points at {found}"
