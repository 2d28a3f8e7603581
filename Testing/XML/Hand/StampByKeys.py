# SPDX-License-Identifier: BSD-3-Clause
"""Proves that tools work without a mouse: the arrow keys move the cursor over the view. With the
stamp, + and - pull and push what lies under it, I sets the point of interest, and each place is one
stroke. Space takes hold of tissue or of control points and lets go of them, as a mouse button does;
Escape drops what is held.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math

import brainshift
import test_hand as hand
import window_testing as window
from paraview import simple

LEFT, UP, RIGHT, DOWN = 0x01000012, 0x01000013, 0x01000014, 0x01000015  # Qt::Key
STEP = 8  # pixels
NEAR = 0.5  # mm: a pick finds a surface to half a step along the ray, the tool to a hair


def begin():
    _, view = window.show_bent_wavelet()
    view.CameraPosition, view.CameraFocalPoint = (20.0, 30.0, 70.0), (0.0, 0.0, 0.0)
    simple.Render(view)
    hand.wait(300)


def picked(right=0, up=0):
    """What lies so many pixels from the middle of the view."""
    view = simple.GetActiveView()
    display = simple.GetDisplayProperties(window.deformation(), view)
    simple.Render(view)  # without the stroke before
    x, y = (side // 2 for side in view.ViewSize)
    return list(brainshift.pick(display, view, x + right, y + up))[:3]


def amount(stroke):
    """mm, pull positive: a stamp's vector against its axis."""
    return -sum(a * b for a, b in zip(stroke[4:7], stroke[7:10]))


def type_key(key):
    hand.tap(key if isinstance(key, int) else ord(key))
    hand.wait(50)


def plus_does_nothing_elsewhere():
    assert hand.action("actionBrainShiftStamp")
    hand.wait(200)
    type_key("+")
    assert not window.strokes(), "the cursor is not over the view"


def the_first_arrow_brings_the_cursor():
    under = picked()
    type_key(RIGHT)
    for clicks in (1, 2, 3):
        type_key("+")
        assert len(window.strokes()) == 1, window.strokes()
    window.settle("Stamp: pull")
    stroke, = window.strokes()
    per_click = hand.setting("millimetresPerClick")
    assert math.dist(stroke[1:4], under) < NEAR, (stroke[1:4], under)
    assert math.isclose(amount(stroke), 3 * per_click, rel_tol=1e-6), (amount(stroke), per_click)


def arrows_move_it():
    window.edit("Undo")
    right = up = 0
    for key, x, y in ((RIGHT, 1, 0), (UP, 0, 1), (UP, 0, 1), (LEFT, -1, 0), (DOWN, 0, -1)):
        right, up = right + x * STEP, up + y * STEP
        under = picked(right, up)
        type_key(key)
        type_key("-")
        window.settle("Stamp: push")
        stroke, = window.strokes()
        assert math.dist(stroke[1:4], under) < NEAR, (key, stroke[1:4], under)
        assert amount(stroke) < 0.0, amount(stroke)
        window.edit("Undo")


def i_sets_the_point():
    under = picked(0, STEP)
    type_key("I")
    hand.wait(100)
    point = list(window.deformation().PointOfInterest)
    assert math.dist(point, under) < NEAR, (point, under)


def radii_stay_within_their_range():
    """At least half the largest spacing of the control points, at most half the box's diagonal."""
    bent = window.deformation()
    bounds = bent.GetDataInformation().GetBounds()
    sides = [bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3)]
    spacing = max(side / (count - 1) for side, count in zip(sides, bent.LatticeDimensions))
    for name in ("radius", "majorRadius", "minorRadius"):
        before = hand.setting(name)
        least, most = hand.setting(name, 0.001), hand.setting(name, 1e6)
        hand.setting(name, before)
        assert math.isclose(least, spacing / 2, rel_tol=1e-6), (name, least, spacing)
        assert math.isclose(most, math.hypot(*sides) / 2, rel_tol=1e-6), (name, most, sides)


def dragged_by(keys, pixels, tool):
    """The strokes of a drag by keys, and of the same drag by the mouse, each one undone."""
    made = []
    middle = [side // 2 for side in simple.GetActiveView().ViewSize]
    for by_keys in (True, False):
        hand.take(hand.NONE)
        hand.take(tool)
        hand.wait(200)
        if by_keys:
            for key in (RIGHT, " ", *keys, " "):
                type_key(key)
        else:
            end = [at + moved for at, moved in zip(middle, pixels)]
            hand.drag(middle, end)
        hand.wait(300)
        made.append(window.strokes())
        window.edit("Undo")
        hand.wait(200)
        assert not window.strokes(), "the drag is one undo step"
    return made


def space_takes_hold():
    for tool in (hand.SOFT, hand.MOVE, hand.STAMP):
        by_keys, by_mouse = dragged_by((UP, UP, RIGHT, UP), (STEP, 3 * STEP), tool)
        assert len(by_keys) == len(by_mouse) == 1, (tool, by_keys, by_mouse)
        for got, wanted in zip(by_keys[0], by_mouse[0]):
            assert math.isclose(got, wanted, abs_tol=1e-3), (tool, by_keys, by_mouse)


def escape_drops_what_is_held():
    hand.take(hand.NONE)
    hand.take(hand.SOFT)
    hand.wait(200)
    for key in (RIGHT, " ", UP, hand.ESCAPE, UP, UP):
        type_key(key)
    hand.wait(300)
    assert not window.strokes(), "Escape dropped it, and the arrows move the cursor again"


def shift_selects_several():
    """Two control points, and a drag of both."""
    hand.take(hand.NONE)
    hand.take(hand.MOVE)
    hand.wait(200)
    type_key(RIGHT)
    hand.tap(" ", hand.SHIFT)
    for _ in range(12):
        type_key(RIGHT)
    hand.tap(" ", hand.SHIFT)
    assert not window.strokes(), "selecting moves nothing"
    for key in (" ", UP, " "):
        type_key(key)
    hand.wait(300)
    assert len(window.strokes()) == 2, window.strokes()
    window.edit("Undo")


def play():
    yield (begin,)
    yield (plus_does_nothing_elsewhere,)
    yield (the_first_arrow_brings_the_cursor,)
    yield (arrows_move_it,)
    yield (i_sets_the_point,)
    yield (radii_stay_within_their_range,)
    yield (space_takes_hold,)
    yield (escape_drops_what_is_held,)
    yield (shift_selects_several,)


if __name__ == "__main__":
    window.main("StampByKeys", play())
