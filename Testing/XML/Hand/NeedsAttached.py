# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel greys the properties of a comparison while the volume carries no reference,
and lets one edit them where it does. MaskByHand.xml proves the same of segments.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import volume
from paraview import simple

ALWAYS = {"Deformed Volume": "AmbientOcclusion", "Deformed Slices": "ShowCrosshair"}

scene = {}


def show(source, kind):
    """Shows a source alone, and its properties in the panel."""
    view = scene["view"]
    simple.HideAll(view)
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType(kind)
    simple.Render(view)
    simple.SetActiveSource(source)
    hand.wait(300)


def set_up():
    scene["view"] = simple.GetActiveViewOrCreate("RenderView")
    scene["image"] = volume(numpy.full((9, 9, 9), 50.0, numpy.float32))
    scene["bent"] = simple.FreeFormDeformation(registrationName="bent", Input=scene["image"])
    scene["compared"] = simple.CompareVolumes(Input=scene["bent"], Reference=scene["image"])


def comparison(kind, name):
    show(scene["bent"], kind)
    assert hand.is_enabled(name) is False, "the volume has no reference"
    assert hand.is_enabled(ALWAYS[kind]) is True, "what needs nothing is not greyed"
    show(scene["compared"], kind)
    assert hand.is_enabled(name) is True, "Compare Volumes attached one"
    show(scene["bent"], kind)
    assert hand.is_enabled(name) is False


window.main("NeedsAttached", [
    (set_up,), (comparison, "Deformed Volume", "VolumeComparison"),
    (comparison, "Deformed Slices", "SliceComparison")])
