# SPDX-License-Identifier: BSD-3-Clause
# Proves, by a program that is not ours, that displacement fields mean what they say: elastix'
# transformix warps with the fields that BrainShift saves as BrainShift does, and BrainShift draws
# through the fields that transformix writes as transformix does.
import os
import subprocess

import numpy
from brainshift_testing import data, load_plugin, output, run_tests, scratch, voxels

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, ExtractSubset, FreeFormDeformation, OpenDataFile)

TRANSFORMIX = os.environ["BRAINSHIFT_TRANSFORMIX"]
#: Every second voxel of a real head, RAS, far from the origin, spacing 2 x 1.8 x 1.8 mm.
HEAD = ExtractSubset(Input=OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz")),
                     VOI=[0, 159, 0, 231, 0, 159], SampleRateI=2, SampleRateJ=2, SampleRateK=2)
LARGEST_DIFFERENCE = 0.01  # of the range, mean
FROM_RAS = numpy.array((-1.0, -1.0, 1.0))  # to LPS

STROKES = (brainshift.stamp((-342, 36, 534), (-309, 22, 477), -10.0)
           + brainshift.soft((-300, 60, 500), (4, -6, 5), 40.0))


def words(numbers):
    return " ".join(repr(float(number)) for number in numpy.ravel(numbers))


def lps_origin():
    return FROM_RAS * output(HEAD).GetPoint(0)


def write_head(name):
    """The head as a MetaImage for ITK: LPS, its axes where they are."""
    image = output(HEAD)
    with open(name, "wb") as file:
        file.write("\n".join((
            "ObjectType = Image", "NDims = 3", "BinaryData = True",
            "BinaryDataByteOrderMSB = False", "CompressedData = False",
            "TransformMatrix = -1 0 0 0 -1 0 0 0 1", "Offset = " + words(lps_origin()),
            "ElementSpacing = " + words(image.GetSpacing()),
            "DimSize = " + " ".join(str(side) for side in image.GetDimensions()),
            "ElementType = MET_FLOAT", "ElementDataFile = LOCAL", "")).encode())
        file.write(voxels(HEAD).astype("<f4").tobytes())


def transformix(folder, transform, *arguments):
    """Warps the head with a transform (lines of a parameter file); returns its voxels."""
    os.makedirs(folder, exist_ok=True)
    head = os.path.join(folder, "head.mha")
    write_head(head)
    image = output(HEAD)
    lines = transform + [
        '(InitialTransformParameterFileName "NoInitialTransform")',
        '(HowToCombineTransforms "Compose")', "(FixedImageDimension 3)", "(MovingImageDimension 3)",
        '(FixedInternalImagePixelType "float")', '(MovingInternalImagePixelType "float")',
        "(Size " + " ".join(str(side) for side in image.GetDimensions()) + ")", "(Index 0 0 0)",
        "(Spacing " + words(image.GetSpacing()) + ")", "(Origin " + words(lps_origin()) + ")",
        "(Direction -1 0 0 0 -1 0 0 0 1)", '(UseDirectionCosines "true")',
        '(ResampleInterpolator "FinalLinearInterpolator")', '(Resampler "DefaultResampler")',
        "(DefaultPixelValue 0)", '(ResultImageFormat "mhd")', '(ResultImagePixelType "float")',
        '(CompressResultImage "false")']
    parameters = os.path.join(folder, "transform.txt")
    with open(parameters, "w") as file:
        file.write("\n".join(lines) + "\n")
    run = subprocess.run(
        [TRANSFORMIX, "-in", head, "-tp", parameters, "-out", folder, *arguments],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout[-2000:]
    warped = numpy.fromfile(os.path.join(folder, "result.raw"), "<f4")
    return warped.reshape(tuple(reversed(image.GetDimensions())))


def difference(warped, filter):
    """Mean difference from the baked volume, as a share of the range."""
    baked = voxels(BakeDeformation(Input=filter)).astype(float)
    return numpy.abs(warped - baked).mean() / numpy.ptp(voxels(HEAD))


def test_transformix_warps_with_our_fields_as_we_do():
    filter = FreeFormDeformation(Input=HEAD, Strokes=STROKES)
    unbent = difference(voxels(HEAD), filter)
    for ending in (".nii", ".mha", ".nrrd"):
        name = scratch(f"for_elastix{ending}")
        brainshift.save_field(filter, name)
        warped = transformix(scratch(f"elastix{ending}"), [
            '(Transform "DeformationFieldTransform")', "(NumberOfParameters 0)",
            f'(DeformationFieldFileName "{name}")', "(DeformationFieldInterpolationOrder 1)"])
        found = difference(warped, filter)
        print(f"{ending}: {100 * found:.4f} % of the range; unbent {100 * unbent:.2f} %")
        assert found < LARGEST_DIFFERENCE and found < unbent / 5, (ending, found)


def test_we_draw_through_fields_of_transformix_as_it_does():
    """A B-spline transform that pulls one side of the head, written as a dense field."""
    image = output(HEAD)
    size = numpy.array(image.GetDimensions()) * image.GetSpacing()
    spacing = size / 6.0
    coefficients = numpy.zeros((3, 10, 10, 10))  # component, z, y, x
    coefficients[0, 4:6, 4:7, 5:8] = 9.0
    coefficients[1, 4:7, 5:7, 4:6] = -12.0
    coefficients[2, 5:8, 3:6, 4:7] = 7.0
    # One cell of coefficients around the head; its axes run against x and y of LPS.
    grid_origin = lps_origin() - FROM_RAS * spacing
    folder = scratch("elastix_def")
    warped = transformix(folder, [
        '(Transform "BSplineTransform")', f"(NumberOfParameters {coefficients.size})",
        "(TransformParameters " + words(coefficients) + ")", "(GridSize 10 10 10)",
        "(GridIndex 0 0 0)", "(GridSpacing " + words(spacing) + ")",
        "(GridOrigin " + words(grid_origin) + ")", "(GridDirection -1 0 0 0 -1 0 0 0 1)",
        "(BSplineTransformSplineOrder 3)", '(UseCyclicTransform "false")'], "-def", "all")
    filter = FreeFormDeformation(Input=HEAD)
    unbent = difference(warped, filter)
    filter.Lattice = brainshift.load_field(os.path.join(folder, "deformationField.mhd"))
    found = difference(warped, filter)
    print(f"-def all: {100 * found:.4f} % of the range; unbent {100 * unbent:.2f} %")
    assert found < LARGEST_DIFFERENCE and found < unbent / 5, found


run_tests(globals())
