# SPDX-License-Identifier: BSD-3-Clause
"""Proves that what a tool draws stays under the cursor, where the cursor is now, after I, Escape,
undo and redo, a next slice and another tool; and that the key I and the panel's button for the
centre both act at once, without Apply, as one step of undo.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import numpy
import test_hand as hand
import window_testing as window
from paraview import simple
from window_testing import deformation, strokes, undo_labels

CENTRE = (20.0, 30.0, 24.0)
TOOLS = (hand.SOFT, hand.STAMP, hand.MOVE)


def begin():
    """A block of 41 x 61 x 49 mm that rays do not enter, applied as in the window."""
    simple.UpdatePipeline(
        proxy=simple.Wavelet(WholeExtent=[0, 40, 0, 60, 0, 48], Center=CENTRE))
    display = simple.GetDisplayProperties(window.bend())
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.GetOpacityTransferFunction("RTData").Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]
    simple.Render()
    hand.wait(300)


def view():
    return simple.GetActiveView()


def pixel(right, up):
    """From the view's middle, in shares of its height."""
    width, height = view().ViewSize
    return [width // 2 + round(right * height), height // 2 + round(up * height)]


def away():
    return [5, view().ViewSize[1] - 5]


def tissue(at):
    return brainshift.pick(simple.GetDisplayProperties(deformation()), view(), *at)


def outlined(seen=None):
    """The box round what the tool draws (mm); None: it draws nothing."""
    box = window.drawn_by_tool(seen or view()).GetBounds()
    return None if box is None else numpy.array(box)


def rest():
    """Long enough for a picture, what follows from it, and a picture of that."""
    for _ in range(4):
        hand.wait(100)


def assert_outlined(at, seen=None):
    """It draws what it draws when the cursor comes to that pixel anew."""
    rest()
    now = outlined(seen)
    assert now is not None, "nothing is drawn"
    hand.hover(away())
    hand.wait(100)
    hand.hover(at)
    hand.wait(100)
    anew = outlined(seen)
    assert anew is not None and numpy.allclose(now, anew, atol=1e-3), (now, anew)


def interest():
    return list(deformation().PointOfInterest)


def after_interest():
    hand.take(hand.STAMP)
    at = pixel(0.1, 0.1)
    hand.hover(at)
    hand.wait(100)
    before = outlined()
    hand.tap("i")
    assert_outlined(at)
    box = outlined().reshape(3, 2)
    assert numpy.allclose(box.mean(axis=1), tissue(at), atol=1e-2), "ellipse and cross are there"
    assert not numpy.allclose(before, outlined(), atol=1.0)
    # There is no way to push along, so the wheel does nothing there.
    hand.wheel(at, 1)
    hand.wait(700)
    assert strokes() == [], strokes()
    # Undo of another point is seen at once, too.
    other = pixel(-0.1, 0.0)
    hand.hover(other)
    window.action("Undo")
    assert numpy.allclose(interest(), CENTRE), interest()
    assert_outlined(other)


def after_interest_a_new_stroke():
    """Clicks at one place are one stroke, but not if the stamp aims elsewhere since."""
    hand.take(hand.STAMP)
    at = pixel(0.1, 0.0)
    hand.hover(at)
    hand.wheel(at, 1)  # not settled
    hand.tap("i")
    assert_outlined(at)
    hand.wheel(at, 1)
    window.settle("Stamp: pull")
    first, second = strokes()
    assert first[4:10] != second[4:10], "the second one aims at the point"
    assert undo_labels()[:3] == ["Stamp: pull", "Point of interest", "Stamp: pull"], undo_labels()
    window.edit("Undo", brainshift.STAMP)
    window.edit("Undo", brainshift.STAMP)
    window.edit("Undo")


def after_escape(tool):
    """While the button is down, and then until it is let go."""
    hand.take(tool)
    start, end, last = pixel(0.0, 0.0), pixel(0.05, 0.1), pixel(0.1, 0.05)
    hand.hover(start)
    hand.press(start)
    hand.drag_to(end)
    hand.wait(100)
    assert strokes(), "a stroke is under the hand"
    hand.tap(hand.ESCAPE)
    assert_outlined(end)
    hand.drag_to(last)
    hand.release(last)
    assert_outlined(last)
    assert strokes() == [], strokes()


def after_escape_of_wheel():
    hand.take(hand.STAMP)
    at = pixel(0.05, 0.0)
    hand.hover(at)
    hand.wheel(at, 2)
    hand.tap(hand.ESCAPE)
    assert_outlined(at)
    assert strokes() == [], strokes()


def after_undo():
    hand.take(hand.STAMP)
    at = pixel(-0.05, 0.1)
    hand.hover(at)
    hand.wheel(at, 5)
    window.settle("Stamp: pull")
    for name in ("Undo", "Redo", "Undo"):
        window.action(name)
        assert_outlined(at)
    hand.take(hand.SOFT)
    hand.drag(pixel(0.0, 0.0), at)
    assert_outlined(at)
    window.action("Undo")
    assert_outlined(at)


def after_another_tool():
    at = pixel(0.0, 0.1)
    hand.hover(at)
    for tool in TOOLS:
        hand.take(tool)
        assert_outlined(at)


def centre_and_key_act_alike():
    """Both at once, each one step of undo of the same name, and nothing is left to apply."""
    hand.take(hand.STAMP)
    at = pixel(0.1, 0.15)
    hand.hover(at)
    hand.wait(100)
    start, expected = interest(), list(tissue(at))
    steps = []
    for act, comes in ((lambda: hand.tap("i"), expected),
                       (lambda: hand.click("Centre"), CENTRE)):
        before, was = undo_labels(), interest()
        act()
        assert numpy.allclose(interest(), comes, atol=1e-3), (interest(), comes)
        hand.wait(300)
        assert not hand.click("Accept"), "nothing waits for Apply"
        steps.append(undo_labels()[:-len(before)] if len(before) < 10 else undo_labels()[:1])
        window.action("Undo")
        assert numpy.allclose(interest(), was), (interest(), was)
        window.action("Redo")
        assert numpy.allclose(interest(), comes, atol=1e-3), (interest(), comes)
        assert_outlined(at)
    assert steps == [["Point of interest"]] * 2, steps
    assert numpy.allclose(start, CENTRE), start


def same_again_is_no_step():
    """Neither makes a step of undo that changes nothing."""
    hand.take(hand.STAMP)
    at = pixel(0.1, 0.15)
    hand.hover(at)
    for act in (lambda: hand.tap("i"), lambda: hand.click("Centre")):
        act()
        hand.wait(100)
        steps = undo_labels()
        act()
        hand.wait(100)
        assert undo_labels() == steps, (undo_labels(), steps)


def after_next_slice():
    views = brainshift.four_views(deformation())
    axial = views["axial"]
    simple.SetActiveView(axial)
    simple.RenderAllViews()
    hand.wait(300)
    hand.take(hand.STAMP)
    at = pixel(0.1, 0.15)
    hand.hover(at)
    hand.wait(100)
    for key in (hand.PAGE_UP, hand.PAGE_UP, hand.PAGE_DOWN):
        hand.tap(key)
        assert_outlined(at, axial)


def play():
    yield (begin,)
    yield (after_interest,)
    yield (after_interest_a_new_stroke,)
    for tool in TOOLS:
        yield (after_escape, tool)
    yield (after_escape_of_wheel,)
    yield (after_undo,)
    yield (after_another_tool,)
    yield (centre_and_key_act_alike,)
    yield (same_again_is_no_step,)
    yield (after_next_slice,)


if __name__ == "__main__":
    window.main("OutlineByHand", play())
