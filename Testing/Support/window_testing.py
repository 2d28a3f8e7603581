# SPDX-License-Identifier: BSD-3-Clause
"""What scripts share that ParaView's window plays with test_hand: a Free-Form Deformation called
"bent", its strokes, steps of undo, and a file for what did not hold."""

import contextlib
import json
import os
import time
import traceback

import brainshift
import test_hand as hand
from paraview import servermanager, simple

NUMBERS = brainshift.NUMBERS_PER_STROKE


def main(name, steps):
    """Plays the steps, functions with their arguments, in the window, and writes down what did not
    hold for play_window.py."""
    told = {"failures": [], "played": 0}
    for step, *arguments in steps:
        print(step.__name__, flush=True)
        try:
            step(*arguments)
        except BaseException:
            told["failures"].append(traceback.format_exc())
            start_anew()
        told["played"] += 1
    file = os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], f"{name}.json")
    with open(file, "w", encoding="utf-8") as out:
        json.dump(told, out)
    hand.quit()


def start_anew():
    """So that one step's failure is not the next one's."""
    hand.take(hand.NONE)
    if deformation():
        deformation().Strokes = []


def bend():
    """Makes a Free-Form Deformation of the active source, as the menu Filters and Apply do, and
    calls it "bent"."""
    hand.create_filter("FreeFormDeformation")
    hand.wait(100)
    assert hand.click("Accept")
    hand.wait(500)
    bent = simple.GetActiveSource()
    simple.RenameSource("bent", bent)
    return bent


def show_bent_wavelet():
    """A wavelet, bent in the window, as a Deformed Volume that rays hardly enter. Returns filter
    and view."""
    simple.Wavelet()
    bent, view = bend(), simple.GetActiveView()
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    opacity = simple.GetOpacityTransferFunction("RTData")
    opacity.Points = [37.0, 1.0, 0.5, 0.0, 277.0, 1.0, 0.5, 0.0]
    return bent, view


def deformation():
    return simple.FindSource("bent")


def strokes():
    numbers = list(deformation().Strokes)
    assert len(numbers) % NUMBERS == 0, len(numbers)
    return [numbers[i:i + NUMBERS] for i in range(0, len(numbers), NUMBERS)]


def _undo_stack():
    return servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder().GetUndoStack()


def undo_labels():
    """Newest first; ParaView keeps ten."""
    stack = _undo_stack()
    return [stack.GetUndoSetLabel(i) for i in range(stack.GetNumberOfUndoSets())]


def redo_labels():
    """In the order of redo."""
    stack = _undo_stack()
    return [stack.GetRedoSetLabel(i) for i in range(stack.GetNumberOfRedoSets())]


def forget_undo():
    _undo_stack().Clear()


@contextlib.contextmanager
def unrecorded():
    """What a script does here is nothing to undo."""
    builder = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder()
    before = builder.GetIgnoreAllChanges()
    builder.SetIgnoreAllChanges(True)
    try:
        yield
    finally:
        builder.SetIgnoreAllChanges(before)


def action(name):
    """Undo or Redo."""
    assert hand.action("actionEdit" + name)
    hand.wait()


def edit(name, *tools):
    """Undo or Redo; then there are strokes of these tools."""
    action(name)
    assert [stroke[0] for stroke in strokes()] == list(tools), strokes()


def until(holds, what, seconds=30.0):
    """Lets the window work until something holds, for that long at most."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end, f"never: {what}"
        hand.wait(20)


def settle(label):
    """Waits until a burst of wheel clicks is over: a step more to undo."""
    before = undo_labels()
    for _ in range(200):
        if undo_labels() != before:
            break
        hand.wait(50)
    hand.wait(200)
    assert undo_labels()[0] == label, undo_labels()


def drawn_by_tool(view):
    """The representation of the tool in hand."""
    hidden = view.SMProxy.GetProperty("HiddenRepresentations")
    for i in range(hidden.GetNumberOfProxies()):
        tool = hidden.GetProxy(i).GetClientSideObject().GetRepresentation()
        if tool.GetClassName() == "vtkLatticeRepresentation":
            return tool
    raise AssertionError("no tool is in hand")


def shown(view, what):
    """How many ControlPoints, Faint or Highlights the tool in a view shows."""
    hidden = view.SMProxy.GetProperty("HiddenRepresentations")
    for i in range(hidden.GetNumberOfProxies()):
        tool = hidden.GetProxy(i).GetClientSideObject().GetRepresentation()
        for line in str(tool).splitlines():
            name, _, number = line.strip().partition(": ")
            if name == what:
                return int(number)
    raise ValueError(f"nothing tells {what}")


def pixel_of(view, position):
    renderer = view.GetRenderer()
    renderer.SetWorldPoint(*position, 1.0)
    renderer.WorldToDisplay()
    return [round(number) for number in renderer.GetDisplayPoint()[:2]]
