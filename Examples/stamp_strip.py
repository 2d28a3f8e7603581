# SPDX-License-Identifier: BSD-3-Clause
"""Draws a strip of pictures of the stamp at work, as a user sees it in ParaView's window.

The first picture shows the ellipse on the cortex before anything is changed. The next ones show the
cortex pulled out click by click. Run it in `./brainshift shell`. BRAINSHIFT_STRIP names the picture
to write:

    . build/paraview-5.13/environment.sh
    BRAINSHIFT_STRIP=stamp.png xvfb-run -s "-screen 0 1600x1200x24 -noreset" paraview --dr \\
      --plugin-search-paths=$BRAINSHIFT_PLUGIN_DIR --plugins=BrainShift \\
      --script=Examples/stamp_strip.py
"""

import os
import sys

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

CHECKOUT = os.path.join(os.environ["BRAINSHIFT_DATA"], "..", "..")
sys.path += [os.path.join(CHECKOUT, "Examples"), os.path.join(CHECKOUT, "Testing", "Support")]
import demo  # noqa: E402
import test_hand as hand  # noqa: E402

SIDE = 400                # pixels of one picture
PLACE = (0.50, 0.70)      # where the hand is, share of the picture
CLICKS = 6                # of the wheel, between two pictures
MILLIMETRES_PER_CLICK = 1.0


def open_brain(view):
    head = demo.open_volume("Head", "seg3d_mr_t1.nii.gz")
    mask = demo.open_volume("Brain mask", "seg3d_brainmask.nii.gz")
    brain = demo.brain_alone(head, mask)
    bent = simple.FreeFormDeformation(registrationName="Bent brain", Input=brain)
    demo.look_like_tissue("Brain", demo.CORTEX_COLORS, demo.CORTEX_OPACITIES)
    demo.show(bent, "Brain", view)
    simple.Render(view)  # the first picture of a view finds a camera of its own
    demo.frame(view, (-310, 24, 478), (-320, 380, 160), 22)
    simple.SetActiveSource(bent)
    simple.Render(view)


def on_screen(view):
    """The view's pixels, tools included."""
    hand.wait(300)
    pixels = vtkWindowToImageFilter()
    pixels.SetInput(view.GetRenderWindow())
    pixels.ReadFrontBufferOff()
    pixels.ShouldRerenderOff()
    pixels.Update()
    image = pixels.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3).copy()


def write(pictures, file):
    """Side by side."""
    strip = numpy.hstack(pictures)
    image = vtkImageData()
    image.SetDimensions(strip.shape[1], strip.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(strip.reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputData(image)
    writer.Write()


def draw(file):
    view = simple.GetActiveViewOrCreate("RenderView")
    hand.resize(SIDE, SIDE)
    open_brain(view)
    place = [share * SIDE for share in PLACE]
    hand.setting("majorRadius", 45.0)
    hand.setting("minorRadius", 30.0)
    hand.setting("sigma", 0.6)
    hand.setting("millimetresPerClick", MILLIMETRES_PER_CLICK)
    hand.take(hand.STAMP)
    hand.hover(place)
    pictures = [on_screen(view)]
    for _ in range(2):
        hand.wheel(place, CLICKS)
        hand.wait(1200)  # the burst is over, and the picture whole again
        pictures.append(on_screen(view))
    hand.take(hand.NONE)
    pictures.append(on_screen(view))
    write(pictures, file)


try:
    draw(os.environ["BRAINSHIFT_STRIP"])
finally:
    hand.quit()
