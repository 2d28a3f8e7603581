# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of transforms share: elastix' transformix as the judge, and files for it.

transformix maps with ITK's own classes. Debian 13's ANTs, and transformix with ITK's transform
files, end with a segmentation fault: they were built for another ITK 5.4 than Debian has. So a
transform goes to transformix as a parameter file with the same numbers.
"""

import os
import struct
import subprocess

import numpy
from brainshift_testing import scratch

#: From RAS to LPS and back.
FLIP = numpy.array((-1.0, -1.0, 1.0))

NAMES = {"AffineTransform": "AffineTransform", "MatrixOffsetTransformBase": "AffineTransform",
         "Euler3DTransform": "EulerTransform", "Similarity3DTransform": "SimilarityTransform",
         "TranslationTransform": "TranslationTransform", "BSplineTransform": "BSplineTransform"}


def numbers(values):
    return " ".join(repr(float(value)) for value in numpy.ravel(values))


def run(*command):
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    assert done.returncode == 0, done.stdout[-2000:]


def write(name, text):
    name = scratch(name)
    with open(name, "w") as file:
        file.write(text)
    return name


def itk_text(*transforms):
    """The text of an ITK file of (type, parameters, fixed parameters)."""
    text = "#Insight Transform File V1.0\n"
    for i, (kind, parameters, fixed) in enumerate(transforms):
        text += f"#Transform {i}\nTransform: {kind}_double_3_3\n"
        if parameters is not None:
            text += f"Parameters: {numbers(parameters)}\nFixedParameters: {numbers(fixed)}\n"
    return text


def write_matlab(name, transform):
    """A transform as ITK lays it out in MATLAB's level 4."""
    kind, parameters, fixed = transform
    with open(name, "wb") as file:
        for word, values in ((kind + "_double_3_3", parameters), ("fixed", fixed)):
            file.write(struct.pack("<5i", 0, len(values), 1, 0, len(word) + 1) + word.encode() +
                       b"\0" + numpy.asarray(values, "<f8").tobytes())


def write_hdf5(name, *transforms, spelling="Transform"):
    """(Type, parameters, fixed parameters) as ITK lays them out; it once wrote Tranform."""
    import h5py
    with h5py.File(name, "w") as file:
        for i, (kind, parameters, fixed) in enumerate(transforms):
            group = file.create_group(f"TransformGroup/{i}")
            group["TransformType"] = [kind + "_double_3_3"]
            if parameters is not None:
                group[spelling + "Parameters"] = numpy.asarray(parameters, float)
                group[spelling + "FixedParameters"] = numpy.asarray(fixed, float)


def of_itk_text(name):
    """Type, parameters and fixed parameters of the only transform in an ITK file."""
    with open(name) as file:
        found = dict(line.strip().split(":") for line in file if not line.startswith("#"))
    kind = found["Transform"].strip().removesuffix("_double_3_3")
    return kind, *([float(number) for number in found[key].split()]
                   for key in ("Parameters", "FixedParameters"))


def _lines(member):
    """A transform as lines of a parameter file: (type, parameters, fixed), or a field's file."""
    if isinstance(member, str):
        return ['(Transform "DeformationFieldTransform")', "(NumberOfParameters 0)",
                f'(DeformationFieldFileName "{member}")', "(DeformationFieldInterpolationOrder 1)"]
    kind, parameters, fixed = member
    lines = [f'(Transform "{NAMES[kind]}")', f"(NumberOfParameters {numpy.size(parameters)})",
             f"(TransformParameters {numbers(parameters)})"]
    if kind == "TranslationTransform":
        return lines
    if kind != "BSplineTransform":
        order = "true" if len(fixed) > 3 else "false"
        return lines + [f"(CenterOfRotationPoint {numbers(fixed[:3])})", f'(ComputeZYX "{order}")']
    columns = numpy.reshape(fixed[9:], (3, 3)).T
    return lines + [
        "(GridSize " + " ".join(str(int(side)) for side in fixed[:3]) + ")", "(GridIndex 0 0 0)",
        f"(GridOrigin {numbers(fixed[3:6])})", f"(GridSpacing {numbers(fixed[6:9])})",
        f"(GridDirection {numbers(columns)})", "(BSplineTransformSplineOrder 3)",
        '(UseCyclicTransform "false")']


def parameter_file(name, *members):
    """An elastix parameter file, with one before it for each further member."""
    initial = "NoInitialTransform"
    for i, member in enumerate(members):
        last = i == len(members) - 1
        initial = write(name if last else f"{i}_{name}", "\n".join(_lines(member) + [
            f'(InitialTransformParameterFileName "{initial}")',
            '(HowToCombineTransforms "Compose")', "(FixedImageDimension 3)",
            "(MovingImageDimension 3)", '(FixedInternalImagePixelType "float")',
            '(MovingInternalImagePixelType "float")', "(Size 8 8 8)", "(Index 0 0 0)",
            "(Spacing 9 9 9)", "(Origin 0 0 0)", "(Direction 1 0 0 0 1 0 0 0 1)",
            '(UseDirectionCosines "true")', ""]))
    return initial


def mapped_by_parameters(points, parameters):
    """RAS points, mapped by transformix with a parameter file."""
    folder = scratch("transformix_points")
    os.makedirs(folder, exist_ok=True)
    before = os.path.join(folder, "before.txt")
    with open(before, "w") as file:
        file.write(f"point\n{len(points)}\n")
        for point in points * FLIP:
            file.write(numbers(point) + "\n")
    run(os.environ["BRAINSHIFT_TRANSFORMIX"], "-def", before, "-tp", parameters, "-out", folder)
    with open(os.path.join(folder, "outputpoints.txt")) as file:
        found = [line.split("OutputPoint = [")[1].split("]")[0].split() for line in file]
    return numpy.array(found, float) * FLIP


def mapped_outside(points, *members):
    """RAS points, mapped by transformix through transforms in this order."""
    return mapped_by_parameters(points, parameter_file("outside.txt", *members))


def write_image(name, voxels, origin, spacing):
    """An array indexed [z, y, x] or [z, y, x, component] as a MetaImage. Its world is LPS, mm."""
    name = scratch(name)
    header = ("ObjectType = Image", "NDims = 3", "BinaryData = True",
              "BinaryDataByteOrderMSB = False", "CompressedData = False",
              "TransformMatrix = 1 0 0 0 1 0 0 0 1", "Offset = " + numbers(origin),
              "ElementSpacing = " + numbers(spacing),
              "DimSize = " + " ".join(str(side) for side in reversed(voxels.shape[:3])),
              f"ElementNumberOfChannels = {numpy.prod(voxels.shape[3:], dtype=int)}",
              "ElementType = MET_FLOAT", "ElementDataFile = LOCAL", "")
    with open(name, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(voxels.astype("<f4").tobytes())
    return name
