# SPDX-License-Identifier: BSD-3-Clause
"""Draws a strip of pictures of one slice, compared with a reference in each way of Deformed Slices.

    ./brainshift python Examples/compare_strip.py FILE.png

It shows the brain of case_study.py before any stamp, and after its synthetic surgery.
"""

import os
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

sys.path.append(os.path.dirname(os.path.abspath(__file__)))
import case_study  # noqa: E402

SIDE = 300  # pixels of one picture
HALF_MM = 55.0
FOCUS = (8.0, 0.0, -18.0)  # mm from the cavity
WAYS = ("Two colours", "Difference", "Gradient", "Checkerboard", "Wipe", "Local similarity")


def pixels_of(view):
    image = view.SMProxy.CaptureWindow(1)
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1).copy()
    image.UnRegister(None)
    return pixels[:, :, :3]


def write(pictures, file):
    """Side by side."""
    strip = numpy.hstack(pictures)
    image = vtkImageData()
    image.SetDimensions(strip.shape[1], strip.shape[0], 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(numpy.ascontiguousarray(strip).reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputData(image)
    writer.Write()


def draw(file):
    brain = case_study.preoperative_brain()
    sunken = simple.BakeDeformation(Input=case_study.known_sag(brain), Interpolation="Cubic")
    compare = simple.CompareVolumes(
        Input=simple.FreeFormDeformation(Input=brain),
        Reference=case_study.postoperative(sunken, "Brain"),
        Cavity=case_study.postoperative(sunken, "Cavity"))
    view = case_study.show_red_green(compare, "Coronal", (0, 1, 0), SIDE)
    simple.Render(view)  # the first picture of a view finds a camera of its own
    display = simple.GetDisplayProperties(compare, view)
    display.OrientationMarks = 0
    display.CheckerSize = 15.0
    display.FullGradient = 0.5
    display.WipePosition = case_study.CAVITY_CENTRE
    view.CameraFocalPoint = case_study.CAVITY_CENTRE + FOCUS
    view.CameraPosition = case_study.CAVITY_CENTRE + FOCUS + (0.0, 400.0, 0.0)
    view.CameraParallelScale = HALF_MM
    pictures = []
    for way in WAYS:
        display.SliceComparison = way
        simple.Render(view)
        pictures.append(pixels_of(view))
    write(pictures, file)


if __name__ == "__main__":
    case_study.load_plugin()
    draw(sys.argv[1] if len(sys.argv) > 1 else "comparisons.png")
