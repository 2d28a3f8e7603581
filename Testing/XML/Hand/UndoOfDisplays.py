# SPDX-License-Identifier: BSD-3-Clause
"""Proves that each choice in the panel of a display is one step of undo and redo: how a comparison
is drawn, and in which colours, in slices, in 3D and in four views, which follow each other.
ParaView's Python shell empties the undo stack at each command, so a test that is played from it
cannot see this.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import test_hand as hand
import window_testing as window
from brainshift_testing import picture
from paraview import simple

COLORS = "ComparisonColors"
PLAIN, BLUE = "Red and green", "Blue and orange"

scene = {}


def set_up():
    view = simple.GetActiveViewOrCreate("RenderView")
    wavelet = simple.Wavelet()
    bent = simple.FreeFormDeformation(registrationName="bent", Input=wavelet,
                                      Strokes=brainshift.soft((0, 0, 0), (2, 0, 0), 8))
    scene["compared"] = simple.CompareVolumes(Input=bent, Reference=wavelet)
    scene["display"] = simple.Show(scene["compared"], view, "UniformGridRepresentation")
    scene["display"].VolumeComparison = "Off"
    simple.SetActiveSource(scene["compared"])


def told(name):
    """The values of a property in all displays of the comparison."""
    displays = [simple.GetDisplayProperties(scene["compared"], view)
                for view in simple.GetRenderViews()]
    return [str(display.GetProperty(name).GetData()) for display in displays]


def two_choices(kind, name, none, way):
    """Chooses how, and in which colours, and takes both back, one by one."""
    scene["display"].SetRepresentationType(kind)
    simple.Render()
    hand.wait(300)
    settle()
    choose_and_undo(name, none, way)


def settle():
    """Waits until the dock, which grows with its panel, leaves the views their size."""
    sizes = []
    while len(sizes) < 10 or sizes[-10:] != sizes[-1:] * 10:
        hand.wait(50)
        sizes.append([tuple(view.ViewSize) for view in simple.GetRenderViews()])


def choose_and_undo(name, none, way):
    assert (told(name), told(COLORS)) == (shown_by(none), shown_by(PLAIN))
    pictures = [seen()]
    for chosen in ((name, way), (COLORS, BLUE)):
        assert hand.choose(*chosen), chosen
        pictures.append(seen())
    assert pictures[0] != pictures[1] != pictures[2]
    for back, action, expected in (
            (1, "Undo", (way, PLAIN)), (0, "Undo", (none, PLAIN)),
            (1, "Redo", (way, PLAIN)), (2, "Redo", (way, BLUE)),
            (1, "Undo", (way, PLAIN)), (0, "Undo", (none, PLAIN))):
        window.action(action)
        assert (told(name), told(COLORS)) == tuple(map(shown_by, expected)), (action, expected)
        assert seen() == pictures[back], (action, expected)


def shown_by(value):
    return [value] * len(simple.GetRenderViews())


def seen():
    return [picture(view).tobytes() for view in simple.GetRenderViews()]


def in_four_views():
    """The other displays follow the one that was chosen for, and go back with it."""
    views = brainshift.four_views(scene["compared"])
    simple.SetActiveSource(scene["compared"])
    simple.SetActiveView(views["axial"])
    hand.wait(300)
    settle()
    choose_and_undo("SliceComparison", "None", "Two colours")


window.main("UndoOfDisplays", [
    (set_up,), (two_choices, "Deformed Slices", "SliceComparison", "None", "Two colours"),
    (two_choices, "Deformed Volume", "VolumeComparison", "Off", "Two colours"),
    (in_four_views,)])
