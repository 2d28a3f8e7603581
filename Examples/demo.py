# SPDX-License-Identifier: BSD-3-Clause
"""Bends a real head and its brain by one stamp stroke of 10 mm.

    pvpython demo.py FOLDER        draws before, after and the strengths between into FOLDER
    paraview --script=demo.py      builds the same scene in the window and plays it

If the plugin is not loaded yet, BRAINSHIFT_PLUGIN gives its path. ParaView's window does not tell a
script where it lies, so BRAINSHIFT_DATA gives the folder of the volumes there. Both variables are
in environment.sh in the build folder. Research software, not a medical device.
"""

import os
import sys

import numpy
from paraview import simple
from paraview.simple import servermanager
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

if "__file__" in globals():
    DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Testing", "Data")
else:
    DATA = os.environ["BRAINSHIFT_DATA"]
BACKGROUND = (0.11, 0.12, 0.13)
STRENGTHS = (0.0, 0.25, 0.5, 0.75, 1.0)

# A point on the surface, left of the midline, RAS mm.
SCALP_ANCHOR = (-366.0, 40.0, 520.0)
CORTEX_ANCHOR = (-340.0, 30.0, 515.0)
PUSH_MM = -10.0  # towards the centre, as a brain sinks after the skull is opened

# Scalar, red, green, blue; and scalar, opacity.
SKIN_COLORS = (0, 0.35, 0.20, 0.15, 60, 0.75, 0.50, 0.40, 250, 0.95, 0.78, 0.65, 512, 1.0, 0.9, 0.8)
SKIN_OPACITIES = (0, 0, 30, 0, 130, 1, 512, 1)
CORTEX_COLORS = (0, 0.30, 0.10, 0.10, 110, 0.60, 0.35, 0.30, 170, 0.85, 0.62, 0.55,
                 260, 0.98, 0.90, 0.82, 512, 1.0, 1.0, 1.0)
CORTEX_OPACITIES = (0, 0, 90, 0, 140, 1, 512, 1)


def load_plugin():
    definitions = servermanager.ActiveConnection.Session.GetSessionProxyManager()
    if not definitions.GetProxyDefinitionManager().HasDefinition("filters", "FreeFormDeformation"):
        simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))


def open_volume(name, file):
    reader = simple.NIFTIVolumeReader(
        registrationName=name, FileName=os.path.join(DATA, "seg3d-utah", file))
    reader.UpdatePipeline()
    return reader


def brain_alone(head, mask):
    """The head without what lies outside the brain mask, as a source of its own.

    The edge of the mask is softened, because its voxels would show as steps on the cortex. A
    Programmable Filter would do this too, but its panel ends ParaView 5.13 where pygments is
    installed.
    """
    image = vtkImageData()
    image.ShallowCopy(simple.FetchData(head)[0])
    arrays = image.GetPointData()
    intensity = vtk_to_numpy(arrays.GetArray("Intensity"))
    share = vtk_to_numpy(simple.FetchData(mask)[0].GetPointData().GetArray("Intensity"))
    share = share.astype(numpy.float32).reshape(image.GetDimensions()[::-1])
    for _ in range(12):
        for axis in range(3):
            share = (numpy.roll(share, 1, axis) + 2 * share + numpy.roll(share, -1, axis)) / 4
    share = numpy.clip((share - 0.6) / 0.4, 0, 1)
    brain = numpy_to_vtk((intensity * share.ravel()).astype(numpy.float32), deep=True)
    brain.SetName("Brain")
    arrays.Initialize()
    arrays.SetScalars(brain)
    source = simple.TrivialProducer(registrationName="Brain")
    source.GetClientSideObject().SetOutput(image)
    source.UpdatePipeline()
    return source


def bend(name, volume, anchor, reach):
    """Free-Form Deformation of `volume` with one stamp stroke `reach` mm wide at `anchor`."""
    import brainshift
    volume.UpdatePipeline()
    low_x, high_x, low_y, high_y, low_z, high_z = volume.GetDataInformation().GetBounds()
    centre = ((low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2)
    return simple.FreeFormDeformation(
        registrationName=name, Input=volume,
        Strokes=brainshift.stamp(anchor, centre, PUSH_MM, major=80.0, minor=reach))


def look_like_tissue(array, colors, opacities):
    color = simple.GetColorTransferFunction(array)
    color.ColorSpace = "Lab"
    color.RGBPoints = colors
    points = []
    for scalar, opacity in zip(opacities[0::2], opacities[1::2]):
        points += [scalar, opacity, 0.5, 0.0]  # the last two: straight between the points
    simple.GetOpacityTransferFunction(array).Points = points


def show(deformed, array, view):
    display = simple.Show(deformed, view)
    simple.ColorBy(display, ("POINTS", array))
    display.SetRepresentationType("Deformed Volume")
    display.SetScalarBarVisibility(view, False)
    display.Shade = 1
    display.ScalarOpacityUnitDistance = 1.0
    display.Ambient, display.Diffuse = 0.1, 0.9
    display.Specular, display.SpecularPower = 0.25, 25.0


def frame(view, focus, towards_eye, angle):
    """Looks at `focus` (mm) from focus + `towards_eye` (mm), superior up, `angle` degrees wide."""
    view.UseColorPaletteForBackground = 0
    view.Background = BACKGROUND
    view.OrientationAxesVisibility = 0
    view.CameraFocalPoint = focus
    view.CameraPosition = [f + t for f, t in zip(focus, towards_eye)]
    view.CameraViewUp = (0, 0, 1)
    view.CameraViewAngle = angle
    view.CenterOfRotation = focus


def build(head_view, brain_view):
    """Both pipelines; returns the two Free-Form Deformation filters."""
    head = open_volume("Head", "seg3d_mr_t1.nii.gz")
    mask = open_volume("Brain mask", "seg3d_brainmask.nii.gz")
    brain = brain_alone(head, mask)
    look_like_tissue("Intensity", SKIN_COLORS, SKIN_OPACITIES)
    look_like_tissue("Brain", CORTEX_COLORS, CORTEX_OPACITIES)
    bent_head = bend("Bent head", head, SCALP_ANCHOR, 40.0)
    bent_brain = bend("Bent brain", brain, CORTEX_ANCHOR, 40.0)
    show(bent_head, "Intensity", head_view)
    show(bent_brain, "Brain", brain_view)
    frame(head_view, (-309, 28, 476), (-550, 350, 250), 19)
    frame(brain_view, (-310, 24, 474), (-120, 500, 100), 16)
    return bent_head, bent_brain


def draw(folder):
    """Writes the pictures and says where."""
    head_view = simple.CreateView("RenderView", ViewSize=(900, 900))
    brain_view = simple.CreateView("RenderView", ViewSize=(900, 900))
    os.makedirs(folder, exist_ok=True)
    for name, view, bent in zip(("head", "brain"), (head_view, brain_view),
                                build(head_view, brain_view)):
        for strength in STRENGTHS:
            bent.Strength = strength
            file = os.path.join(folder, f"{name}-strength-{strength:.2f}.png")
            simple.SaveScreenshot(file, view, ImageResolution=(900, 900))
            print(file)


def play():
    """Two views side by side in ParaView's window; Strength moves from 0 to 1."""
    head_view = simple.GetActiveViewOrCreate("RenderView")
    brain_view = simple.CreateView("RenderView")
    layout = simple.GetLayout(head_view)
    layout.AssignView(layout.SplitViewHorizontal(head_view) + 1, brain_view)
    scene = simple.GetAnimationScene()
    scene.NumberOfFrames = 21
    for bent in build(head_view, brain_view):
        track = simple.GetAnimationTrack("Strength", proxy=bent)
        for key_frame, strength in zip(track.KeyFrames, (0.0, 1.0)):
            key_frame.KeyValues = [strength]
    for view in (head_view, brain_view):
        width, height = view.ViewSize
        if height > width:  # half a window often is
            view.CameraViewAngle *= height / width
    scene.Play()


if __name__ == "__main__":
    load_plugin()
    if len(sys.argv) > 1:
        draw(sys.argv[1])
    else:
        play()
