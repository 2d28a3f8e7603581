# SPDX-License-Identifier: BSD-3-Clause
"""Proves that each choice in the panel of a display is one step of undo and redo: how a comparison
is drawn, and in which colours, in slices, in 3D and in four views, which follow each other.
ParaView's Python shell empties the undo stack at each command, so a test that is played from it
cannot see this. What follows Apply is undone and done again step by step: no step that ParaView's
window makes of itself meanwhile takes the others off the stack.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import gc

import brainshift
import test_hand as hand
import walk_files
import window_testing as window
from brainshift_testing import ball, picture, scratch, volume
from paraview import servermanager, simple

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


def undo_what_apply_showed(create, own_step):
    """Applies a filter, undoes it and redoes it, whole: the same steps and the same picture."""
    window.forget_undo()
    create()
    hand.wait(100)
    assert hand.click("Accept")
    hand.wait(500)
    settle()
    steps = window.undo_labels()
    assert steps.count(own_step) == 1 and len(steps) <= 4, steps
    pictures = seen()
    for _ in steps:
        window.action("Undo")
        hand.wait(100)
    assert not window.undo_labels()
    for step in reversed(steps):
        window.action("Redo")
        hand.wait(100)
        assert window.undo_labels()[0] == step, (window.undo_labels(), steps)
    settle()
    assert window.undo_labels() == steps
    assert seen() == pictures


def begin_anew():
    """A bent ball in slices, which Deformed Volume is not at first, and a sphere outside it."""
    hand.reset_session()
    view = simple.GetActiveViewOrCreate("RenderView")
    scene["ball"] = volume(ball(inside=1.0, edge=2.0, radius=9.0))
    scene["bent"] = simple.FreeFormDeformation(registrationName="bent", Input=scene["ball"],
                                               Strokes=brainshift.soft((16, 16, 16), (2, 0, 0), 8))
    scene["trace"] = simple.Sphere(Center=(16, 16, 16), Radius=11.0)
    simple.Show(scene["bent"], view).SetRepresentationType("Deformed Slices")
    simple.Show(scene["trace"], view)
    hand.wait(300)


def colors_that_are_gone():
    """A display changes after a table of colours is gone that is linked to it, as ParaView's
    editor of colours links each table that a display has shown."""
    begin_anew()
    display = simple.GetDisplayProperties(scene["bent"], simple.GetActiveView())
    display.SetRepresentationType("Deformed Volume")
    hand.wait(300)
    shown, table = display.LookupTable, simple.GetColorTransferFunction("gone")
    link = servermanager.vtkSMPropertyLink()
    link.AddLinkedProperty(display.SMProxy, "UseTransfer2D", link.INPUT)
    link.AddLinkedProperty(table.SMProxy, "Using2DTransferFunction", link.OUTPUT)
    display.LookupTable = table
    hand.wait(100)
    display.LookupTable = shown
    simple.Delete(table)
    del table
    gc.collect()
    window.forget_undo()
    hand.wait(300)
    display.Shade = 1 - display.Shade
    simple.Render()


def kept_picture():
    """A tool keeps the picture of a display while the hand hovers. No step of undo or redo that is
    recorded meanwhile brings it back."""
    begin_anew()
    display = simple.GetDisplayProperties(scene["bent"], simple.GetActiveView())
    display.SetRepresentationType("Deformed Volume")
    hand.wait(300)
    window.forget_undo()
    builder = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder()
    builder.Begin("Both")
    display.Opacity = 0.5
    display.KeepPicture = 1
    builder.End()
    builder.PushToStack()
    assert window.undo_labels() == ["Both"], window.undo_labels()
    with window.unrecorded():
        display.KeepPicture = 0
    for action, opacity in (("Undo", 1.0), ("Redo", 0.5)):
        window.action(action)
        display.UpdateSelfAndAllInputs()
        assert (display.Opacity, display.KeepPicture) == (opacity, 0), (action, display.KeepPicture)


def compare():
    hand.create_filter_of_two("CompareVolumes", scene["bent"], "Reference", scene["ball"])


def trace():
    hand.create_filter_of_two("TraceDistance", scene["trace"], "Deformation", scene["bent"])


def opened(file):
    hand.open_file(file)
    hand.wait(300)
    assert hand.click("Accept")
    hand.wait(800)
    return simple.GetActiveSource()


def close_views():
    for view in simple.GetRenderViews():
        hand.close_view(view)
    hand.wait(300)
    hand.new_layout()
    hand.wait(500)


def opacities_are_done_again():
    """A filter gives a map that no view shows any more the look of another volume. Redo brings a
    layout back with it, in the middle of which ParaView's editor of opacities wants to write."""
    hand.reset_session()
    heads = walk_files.write(scratch("heads"))[0]
    hand.send_dialogs_away()  # but for the choice of a reader
    opened(next(file for file in heads if file.endswith(".mha")))
    head = opened(next(file for file in heads if file.endswith(".mgz")))
    close_views()
    hand.select(head)
    hand.wait(200)
    hand.create_filter("FreeFormDeformation")
    hand.wait(100)
    assert hand.click("Accept")
    hand.wait(800)
    shown = simple.GetRepresentation(simple.GetActiveSource(), simple.GetActiveView())
    colors, opacities = shown.LookupTable, shown.ScalarOpacityFunction
    before = list(colors.RGBPoints), list(opacities.Points)
    for action in ("Undo", "Undo"):
        window.action(action)
        hand.wait(50)
    undone = list(colors.RGBPoints), list(opacities.Points)
    assert undone[0] != before[0] and undone[1] != before[1], "the map was another volume's"
    for action in ("Redo", "Redo"):
        window.action(action)
        hand.wait(50)
    hand.wait(300)
    assert (list(colors.RGBPoints), list(opacities.Points)) == before


window.main("UndoOfDisplays", [
    (set_up,), (two_choices, "Deformed Slices", "SliceComparison", "None", "Two colours"),
    (two_choices, "Deformed Volume", "VolumeComparison", "Off", "Two colours"),
    (in_four_views,), (begin_anew,), (undo_what_apply_showed, compare, "Show comparison"),
    (begin_anew,), (undo_what_apply_showed, trace, "Show distances"), (colors_that_are_gone,),
    (kept_picture,), (opacities_are_done_again,)])
