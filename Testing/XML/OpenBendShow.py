# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by OpenBendShow.xml, draws what a script draws, and that
the stroke is seen in it. The window imports this file for the stroke and the point of view."""
import os

import brainshift
from brainshift_testing import structural_similarity
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def picture_file(name):
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "OpenBendShow-" + name + ".png")


def push(deformation):
    """Pushes the forehead in by 10 mm. The anchor is a control point, so it moves by all of it."""
    bounds = deformation.GetDataInformation().GetBounds()
    center = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    spacing = [(bounds[2 * axis + 1] - bounds[2 * axis]) / 18 for axis in range(3)]
    anchor = (center[0], center[1] + 8 * spacing[1], center[2] + 3 * spacing[2])
    deformation.Strokes = brainshift.stamp(anchor, center, -10.0)


def save_picture(view, name):
    view.UseColorPaletteForBackground = 0
    view.Background = (0, 0, 0)
    view.OrientationAxesVisibility = 0
    simple.GetDisplayProperties(simple.GetActiveSource(), view).SetScalarBarVisibility(view, False)
    view.CameraFocalPoint = (-309, 22, 477)
    view.CameraPosition = (-500, 500, 580)
    view.CameraViewUp = (0, 0, 1)
    view.CameraViewAngle = 25
    simple.SaveScreenshot(picture_file(name), view, ImageResolution=(300, 300))


def draw_with_script():
    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))
    head = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")
    deformation = simple.FreeFormDeformation(Input=simple.NIFTIVolumeReader(FileName=head))
    view = simple.CreateView("RenderView")
    display = simple.Show(deformation, view)
    assert display.Representation == "Deformed Volume", display.Representation
    simple.ColorBy(display, ("POINTS", "Intensity"))
    brainshift.look(display)
    simple.Render(view)
    save_picture(view, "unbent")
    push(deformation)
    save_picture(view, "script")


def read_picture(name):
    """Indexed [row from below, column, colour], 0 to 1."""
    reader = vtkPNGReader()
    reader.SetFileName(picture_file(name))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3] / 255.0


def main():

    draw_with_script()
    window, script, unbent = (
        read_picture(name) for name in ("window", "script", "unbent"))
    same = structural_similarity(window, script)
    bent = structural_similarity(unbent, script)
    print("window and script", same, "unbent and script", bent)
    assert same > 0.999, same
    assert bent < 0.995, bent


if __name__ == "__main__":
    main()
