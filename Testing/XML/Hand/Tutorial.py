# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the guided start leads a user through its seven steps in ParaView's window: it waits
for what each asks, goes on when it is done, stays above the window, and can be skipped and left;
and that the panel shows the point of interest that the stamp uses.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import os

import brainshift
import test_hand as hand
import window_testing as window
from paraview import simple

os.environ["BRAINSHIFT_DATA"] = os.environ["BRAINSHIFT_TEST_DATA"]
PATIENCE = 600  # ms; the tutorial looks five times a second
MOST_WAITS = 60  # of 0.6 s; on a busy machine a picture takes long


def title():
    """Of the step; its text is not cut off."""
    hand.wait(PATIENCE)
    assert hand.shows_all("TutorialText"), hand.label("TutorialText")
    return hand.label("TutorialTitle")


def reaches(words):
    """Whether the tutorial comes to a step."""
    return any(words in title() for _ in range(MOST_WAITS))


def bent():
    return simple.FindSource("Bent head")


def add(stroke):
    bent().Strokes = list(bent().Strokes) + list(stroke)
    bent().UpdatePipeline()


def it_opens_at_the_first_step():
    assert hand.action("actionBrainShiftTutorial")
    assert reaches("Step 1 of 7: Open"), title()


def it_stays_above_the_window():
    """Also when ParaView has made its window again, for its first view."""
    def belongs():
        above, window_itself = hand.owner_of("BrainShiftTutorial")
        return above == window_itself != 0

    window.until(belongs, "the tutorial is a tool of the main window")
    before = hand.owner_of("BrainShiftTutorial")[1]
    hand.remake_window()
    assert hand.owner_of("BrainShiftTutorial")[1] != before, "X knows it by another number"
    window.until(belongs, "and remains one")
    assert hand.is_visible("TutorialTitle")


def it_opens_the_sample():
    brainshift.open_sample()  # what the button runs; Python cannot press it while it runs itself
    assert bent() is not None
    with window.unrecorded():
        bent().PointOfInterest = [0, 0, 0]  # outside the volume: it means the centre
    bounds = bent().GetDataInformation().GetBounds()
    for i, axis in enumerate("XYZ"):
        middle = sum(bounds[2 * i:2 * i + 2]) / 2
        window.until(lambda: hand.field("PointOfInterest", axis) == f"{middle:.1f}",
                     "the panel shows where the stamp aims, the centre")
    assert "Step 2 of 7" in title(), title()


def it_waits_for_the_look():
    assert "Step 2 of 7" in title()
    assert hand.click("Brain")
    assert "Step 3 of 7" in title(), title()


def it_waits_for_strokes_of_each_tool():
    anchor = (-340.0, 30.0, 515.0)
    for step, stroke in (
            (3, brainshift.stamp(anchor, (-309.0, 22.0, 477.0), -4.0, major=40.0, minor=30.0)),
            (4, brainshift.soft(anchor, (0.0, 0.0, 3.0), 25.0)),
            (5, brainshift.move(anchor, (0.0, 2.0, 0.0)))):
        assert f"Step {step} of 7" in title(), (step, title())
        assert hand.click("TutorialHelp")  # takes the tool
        assert hand.is_checked("actionBrainShift" + ("Stamp", "Soft", "Move")[step - 3])
        add(stroke)
        assert reaches(f"Step {step + 1} of 7"), (step, title())


def it_waits_for_before_and_after():
    view = simple.GetActiveView()
    hand.hover([view.ViewSize[0] // 2, view.ViewSize[1] // 2])
    hand.key_down(ord("O"))
    assert "Step 6 of 7" in title(), "until the key is let go"
    hand.key_up(ord("O"))
    assert reaches("Step 7 of 7"), title()


def it_waits_for_the_state_file():
    file = os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "tutorial.pvsm")
    simple.SaveState(file)
    os.remove(file)
    if "Step 7" in title():  # Python's SaveState does not pass the window's menu
        assert hand.click("TutorialSkip")
    assert "Done" in title(), title()


def it_can_be_left_and_skipped():
    assert hand.click("TutorialLeave")
    hand.wait(PATIENCE)
    assert hand.action("actionBrainShiftTutorial")
    assert "Step" in title()
    before = title()
    assert hand.click("TutorialSkip")
    assert title() != before
    assert hand.click("TutorialLeave")


def play():
    yield (it_opens_at_the_first_step,)
    yield (it_stays_above_the_window,)
    yield (it_opens_the_sample,)
    yield (it_waits_for_the_look,)
    yield (it_waits_for_strokes_of_each_tool,)
    yield (it_waits_for_before_and_after,)
    yield (it_waits_for_the_state_file,)
    yield (it_can_be_left_and_skipped,)


if __name__ == "__main__":
    window.main("Tutorial", play())
