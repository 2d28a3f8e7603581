# SPDX-License-Identifier: BSD-3-Clause
"""Proves that on a screen at 200 % the stamp acts under the cursor, its outline is as wide to the
eye as elsewhere, and neither the panel, the tutorial nor the dock Case is cut off.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math

import brainshift
import test_hand as hand
import window_testing as window
from paraview import simple
from vtkmodules.vtkRenderingCore import vtkPropCollection

CENTRE = (0.0, 0.0, 0.0)
NEAR = 0.5  # mm: a pick finds a surface to half a step along the ray, the tool to a hair
STRONG = 4.0  # pixels, of the stamp's outline; 2 at 100 %


def begin():
    bent, view = window.show_bent_wavelet()
    bent.PointOfInterest = CENTRE
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(300)


def it_is_such_a_screen():
    assert hand.scale() == 2.0, hand.scale()
    assert simple.GetActiveView().GetRenderWindow().GetDPI() == 144


def near(share_x, share_y):
    size = simple.GetActiveView().ViewSize
    return [round(size[0] * share_x), round(size[1] * share_y)]


def the_stamp_acts_under_the_cursor():
    hand.take(hand.STAMP)
    view = simple.GetActiveView()
    for pixel in (near(0.5, 0.5), near(0.42, 0.6), near(0.57, 0.44)):
        display = simple.GetDisplayProperties(window.deformation(), view)
        simple.Render(view)  # without the stroke before
        under = brainshift.pick(display, view, *pixel)
        assert under is not None, pixel
        had = len(window.strokes())
        hand.hover(pixel)
        hand.wait(200)
        assert STRONG in widths(), widths()
        hand.wheel(pixel, 1)
        window.settle("Stamp: pull")
        strokes = window.strokes()
        assert len(strokes) == had + 1, strokes
        assert math.dist(strokes[-1][1:4], list(under)[:3]) < NEAR, (strokes[-1], under)
        window.action("Undo")
    hand.take(hand.NONE)


def widths():
    """Of what the tool in hand draws, pixels."""
    found = []
    hidden = simple.GetActiveView().SMProxy.GetProperty("HiddenRepresentations")
    for i in range(hidden.GetNumberOfProxies()):
        props = vtkPropCollection()
        hidden.GetProxy(i).GetClientSideObject().GetRepresentation().GetActors(props)
        for j in range(props.GetNumberOfItems()):
            actor = props.GetItemAsObject(j)
            if actor.GetVisibility():
                found.append(actor.GetProperty().GetLineWidth())
    return found


def nothing_is_cut_off():
    hand.resize_window(1280, 800)
    for tool in (hand.NONE, hand.MOVE, hand.SOFT, hand.STAMP):
        hand.take(tool)
        hand.wait(300)
        assert hand.cut_off() == 0, (tool, hand.cut_off())
    hand.take(hand.NONE)
    assert hand.action("actionBrainShiftTutorial")
    hand.wait(300)
    assert hand.shows_all("TutorialText")
    hand.click("TutorialSkip")
    hand.wait(300)
    assert hand.shows_all("TutorialText")
    assert hand.click("TutorialLeave")


def the_dock_of_a_case_is_as_wide_as_its_rows():
    hand.resize_window(900, 700)
    hand.shortcut("0", hand.ALT)
    hand.wait(500)
    assert hand.choose_by_keys("BrainShiftCaseOpening", "Sphere")
    window.until(lambda: hand.in_sight("BrainShiftCaseSphereRadius"), "the whole row")


def play():
    yield (begin,)
    yield (it_is_such_a_screen,)
    yield (the_stamp_acts_under_the_cursor,)
    yield (nothing_is_cut_off,)
    yield (the_dock_of_a_case_is_as_wide_as_its_rows,)


if __name__ == "__main__":
    window.main("LargePixels", play())
