# SPDX-License-Identifier: BSD-3-Clause
"""Proves that all that BrainShift adds to the panel of a Free-Form Deformation, and the tutorial,
can be reached by the Tab key from top to bottom and tells screen readers its name.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import test_hand as hand
import window_testing as window
from paraview import simple

STROKES = brainshift.stamp((8.0, 0.0, 0.0), (0.0, 0.0, 0.0), -3.0, major=8.0, minor=5.0)


def begin():
    simple.Wavelet()
    window.bend()
    window.deformation().Strokes = STROKES
    hand.wait(300)


def is_ours(control):
    kind, name = control[:2]
    return name.startswith(("BrainShift", "Tutorial")) or kind.startswith("brainshift::") or \
        name in ("Centre", "Line")


def check(root, least):
    """All that can be operated in a widget has a name and its place in the order of Tab."""
    controls = [control for control in hand.controls(root) if is_ours(control)]
    print(root, *controls, sep="\n  ", flush=True)
    assert len(controls) >= least, controls
    nameless = [control[:2] for control in controls if not control[2]]
    assert not nameless, nameless
    unreachable = [control[:2] for control in controls if not control[3]]
    assert not unreachable, unreachable
    heights = [control[4] for control in controls]
    rows = zip(heights, heights[1:], controls[1:])
    assert all(after >= before - 12 for before, after, _ in rows), controls


def the_panel():
    for tool, least in ((hand.NONE, 13), (hand.SOFT, 17), (hand.STAMP, 21)):
        hand.take(tool)
        hand.wait(300)
        check("propertiesPanel", least)
    hand.take(hand.NONE)


def the_tutorial():
    assert hand.action("actionBrainShiftTutorial")
    hand.wait(300)
    check("BrainShiftTutorial", 2)
    assert hand.click("TutorialLeave")


def play():
    yield (begin,)
    yield (the_panel,)
    yield (the_tutorial,)


if __name__ == "__main__":
    window.main("Keyboard", play())
