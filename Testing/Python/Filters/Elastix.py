# SPDX-License-Identifier: BSD-3-Clause
# Proves with a program of others that displacement fields mean what they say. transformix of
# elastix warps with fields that BrainShift saved as BrainShift warps, and BrainShift draws
# through fields that transformix wrote as transformix warps.
import os
import subprocess

import numpy
from brainshift_testing import data, load_plugin, output, run_tests, scratch, volume, voxels

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, ExtractSubset, FreeFormDeformation, OpenDataFile)

TRANSFORMIX = os.environ["BRAINSHIFT_TRANSFORMIX"]
#: Every second voxel of a real head, RAS, far from the origin, spacing 2 x 1.8 x 1.8 mm.
HEAD = ExtractSubset(Input=OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz")),
                     VOI=[0, 159, 0, 231, 0, 159], SampleRateI=2, SampleRateJ=2, SampleRateK=2)
#: The same voxels about axes that are none of the world's; rows of a rotation.
ROTATION = ((0.48, -0.8, 0.36), (0.64, 0.6, 0.48), (-0.6, 0.0, 0.8))
TURNED = volume(voxels(HEAD).astype(numpy.float32), origin=(10.0, -70.0, 40.0),
                spacing=(2.0, 1.8, 1.7), direction=numpy.ravel(ROTATION))
LARGEST_DIFFERENCE = 0.01  # of the range, mean
FROM_RAS = numpy.array((-1.0, -1.0, 1.0))  # to LPS


def strokes_in(head):
    """A pull and a shift about the middle of a head."""
    middle = numpy.array(output(head).GetCenter())
    return (brainshift.stamp(middle + (20, 10, 15), middle, -12.0, major=60, minor=40)
            + brainshift.soft(middle - (10, 20, 0), (9, -6, 5), 50.0))


def words(numbers):
    return " ".join(repr(float(number)) for number in numpy.ravel(numbers))


def lps_origin(head):
    return FROM_RAS * output(head).GetPoint(0)


def lps_axes(head):
    """A row for each axis of the voxels."""
    matrix = output(head).GetDirectionMatrix()
    columns = [[matrix.GetElement(row, axis) for row in range(3)] for axis in range(3)]
    return FROM_RAS * columns


def write_head(head, name):
    """The head as a MetaImage for ITK: LPS, its axes where they are."""
    image = output(head)
    with open(name, "wb") as file:
        file.write("\n".join((
            "ObjectType = Image", "NDims = 3", "BinaryData = True",
            "BinaryDataByteOrderMSB = False", "CompressedData = False",
            "TransformMatrix = " + words(lps_axes(head)), "Offset = " + words(lps_origin(head)),
            "ElementSpacing = " + words(image.GetSpacing()),
            "DimSize = " + " ".join(str(side) for side in image.GetDimensions()),
            "ElementType = MET_FLOAT", "ElementDataFile = LOCAL", "")).encode())
        file.write(voxels(head).astype("<f4").tobytes())


def transformix(head, folder, transform, *arguments, result="mhd"):
    """Warps a head with a transform (lines of a parameter file) into files of a format."""
    os.makedirs(folder, exist_ok=True)
    moving = os.path.join(folder, "head.mha")
    write_head(head, moving)
    image = output(head)
    lines = transform + [
        '(InitialTransformParameterFileName "NoInitialTransform")',
        '(HowToCombineTransforms "Compose")', "(FixedImageDimension 3)", "(MovingImageDimension 3)",
        '(FixedInternalImagePixelType "float")', '(MovingInternalImagePixelType "float")',
        "(Size " + " ".join(str(side) for side in image.GetDimensions()) + ")", "(Index 0 0 0)",
        "(Spacing " + words(image.GetSpacing()) + ")",
        "(Origin " + words(lps_origin(head)) + ")",
        "(Direction " + words(lps_axes(head)) + ")", '(UseDirectionCosines "true")',
        '(ResampleInterpolator "FinalLinearInterpolator")', '(Resampler "DefaultResampler")',
        "(DefaultPixelValue 0)", f'(ResultImageFormat "{result}")',
        '(ResultImagePixelType "float")',
        '(CompressResultImage "false")']
    parameters = os.path.join(folder, "transform.txt")
    with open(parameters, "w") as file:
        file.write("\n".join(lines) + "\n")
    run = subprocess.run(
        [TRANSFORMIX, "-in", moving, "-tp", parameters, "-out", folder, *arguments],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert run.returncode == 0, run.stdout[-2000:]


def warped_in(folder):
    """The voxels that transformix made, in its format mhd."""
    return numpy.fromfile(os.path.join(folder, "result.raw"), "<f4").reshape(voxels(HEAD).shape)


def difference(warped, filter):
    """Mean difference from the baked volume, as a share of the range."""
    baked = voxels(BakeDeformation(Input=filter)).astype(float)
    return numpy.abs(warped - baked).mean() / numpy.ptp(voxels(HEAD))


def test_transformix_warps_with_our_fields_as_we_do():
    for head, kind in ((HEAD, "straight"), (TURNED, "turned")):
        filter = FreeFormDeformation(Input=head, Strokes=strokes_in(head))
        unbent = difference(voxels(head), filter)
        for ending in (".nii", ".mha", ".nrrd"):
            name = scratch(f"for_elastix{ending}")
            brainshift.save_field(filter, name)
            folder = scratch(f"elastix{ending}")
            transformix(head, folder, [
                '(Transform "DeformationFieldTransform")', "(NumberOfParameters 0)",
                f'(DeformationFieldFileName "{name}")', "(DeformationFieldInterpolationOrder 1)"])
            found = difference(warped_in(folder), filter)
            print(f"{kind} {ending}: {100 * found:.4f} % of the range; unbent {100 * unbent:.2f} %")
            assert found < LARGEST_DIFFERENCE and found < unbent / 10, (kind, ending, found)


def test_we_draw_through_fields_of_transformix_as_it_does():
    """A B-spline transform that pulls one side of the head, written as a dense field."""
    image = output(HEAD)
    size = numpy.array(image.GetDimensions()) * image.GetSpacing()
    spacing = size / 6.0
    coefficients = numpy.zeros((3, 10, 10, 10))  # component, z, y, x
    coefficients[0, 4:6, 4:7, 5:8] = 9.0
    coefficients[1, 4:7, 5:7, 4:6] = -12.0
    coefficients[2, 5:8, 3:6, 4:7] = 7.0
    # One cell of coefficients covers the head. Its axes run against x and y of LPS.
    grid_origin = lps_origin(HEAD) - FROM_RAS * spacing
    transform = [
        '(Transform "BSplineTransform")', f"(NumberOfParameters {coefficients.size})",
        "(TransformParameters " + words(coefficients) + ")", "(GridSize 10 10 10)",
        "(GridIndex 0 0 0)", "(GridSpacing " + words(spacing) + ")",
        "(GridOrigin " + words(grid_origin) + ")", "(GridDirection -1 0 0 0 -1 0 0 0 1)",
        "(BSplineTransformSplineOrder 3)", '(UseCyclicTransform "false")']
    filter = FreeFormDeformation(Input=HEAD)
    for format in ("mhd", "nii.gz", "nrrd"):
        folder = scratch(f"elastix_def_{format}")
        transformix(HEAD, folder, transform, "-def", "all", result=format)
        if format == "mhd":
            warped = warped_in(folder)
            unbent = difference(warped, filter)
        filter.Lattice = brainshift.load_field(os.path.join(folder, f"deformationField.{format}"))
        found = difference(warped, filter)
        print(f"-def all, {format}: {100 * found:.4f} % of the range; unbent {100 * unbent:.2f} %")
        assert found < LARGEST_DIFFERENCE and found < unbent / 10, (format, found)


run_tests(globals())
