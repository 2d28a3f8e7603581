# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel's button Align moves the reference of a Compare Volumes to its place with
pictures on the way; that Stop keeps what is reached as one step to undo, and Escape moves it back
without one; that a failed result moves nothing unless the user wants it; that a state has the
result; that a hand comes first; and that it ends with a sentence when something is missing, is
changed or goes away.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import os

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import scratch
from paraview import simple
from window_testing import deformation, undo_labels

SIDE = 60  # voxels and mm
ROTATION = [2.0, -3.0, 5.0]  # degrees
TRANSLATION = [4.0, -3.0, 2.0]  # mm
NEAR = 0.3  # mm and, at the corners, about as many degrees
FLICKER = "actionBrainShiftFlicker"
kept = {}


def compare():
    return simple.FindSource("compared")


def motion():
    """Rotation (degrees) and translation (mm) of the reference."""
    return tuple(compare().ReferenceRotation) + tuple(compare().ReferenceTranslation)


def apart():
    """How far the reference lies from its place: degrees and mm, the largest."""
    return numpy.abs(motion()).max()


def said():
    return hand.label("BrainShiftAlignSaid")


def warned():
    return hand.label("BrainShiftAlignWarning")


def is_running():
    return hand.is_enabled("BrainShiftAlignStop")


def pictures():
    display = simple.GetRepresentation(compare(), simple.GetActiveView())
    return brainshift.counters(display)["frames"]


def begin():
    """Starts it and waits until the reference has moved."""
    before = motion()
    assert hand.click("BrainShiftAlign"), "Align is disabled"
    window.until(lambda: motion() != before, "a step")


def move_away():
    """As a user does who types numbers: nothing of it is to be undone here."""
    with window.unrecorded():
        compare().ReferenceRotation = ROTATION
        compare().ReferenceTranslation = TRANSLATION
        simple.Render()
    hand.wait(100)


def set_up():
    rest = simple.Wavelet(registrationName="rest", WholeExtent=[0, SIDE] * 3,
                          XFreq=20, YFreq=17, ZFreq=23)  # waves longer than the way
    view = simple.GetActiveViewOrCreate("RenderView")
    bent = simple.FreeFormDeformation(registrationName="bent", Input=rest)
    compared = simple.CompareVolumes(registrationName="compared", Input=bent, Reference=rest,
                                     ReferenceRotation=ROTATION, ReferenceTranslation=TRANSLATION)
    display = simple.Show(compared, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.GetOpacityTransferFunction("RTData").Points = [37, 1, 0.5, 0, 277, 1, 0.5, 0]
    simple.SetActiveSource(compared)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(300)


def the_picture_follows():
    assert hand.is_visible("BrainShiftAlign") and not is_running()
    assert not hand.is_visible("BrainShiftAlignProgress")
    undo, before = undo_labels(), pictures()
    begin()
    window.until(lambda: said().startswith(("Step ", "Finished")), "words")
    assert pictures() > before, "no picture"
    window.until(lambda: said().startswith("Finished"), "an end", 120.0)
    assert apart() < NEAR, motion()
    for words in ("Mutual information: ", " nats before", " mm and ", " degrees", " % of the vol",
                  "Its checks found no fault"):
        assert words in said(), (words, said())
    assert not warned(), warned()
    assert undo_labels() == (["Align"] + undo)[:10], undo_labels()
    assert not hand.click("Accept"), "there is something to apply"
    kept["found"] = motion()


def it_is_one_step():
    window.action("Undo")
    assert motion() == tuple(ROTATION + TRANSLATION), motion()
    assert "no fault" not in said() and "has changed since" in said(), said()
    window.action("Redo")
    assert motion() == kept["found"], motion()


def it_ends_the_flicker():
    """Or undo and redo would show what the flicker showed when it began."""
    move_away()
    assert hand.action(FLICKER) and hand.is_checked(FLICKER)
    shown = str(compare().Show.GetData())
    begin()
    assert not hand.is_checked(FLICKER) and str(compare().Show.GetData()) == "Both", shown
    window.until(lambda: said().startswith("Finished"), "an end", 120.0)
    window.action("Undo")
    window.action("Redo")
    assert str(compare().Show.GetData()) == "Both", compare().Show


def escape_moves_it_back():
    move_away()
    undo, before = undo_labels(), motion()
    begin()
    hand.tap(hand.ESCAPE)
    hand.wait()
    assert motion() == before and not is_running(), motion()
    assert undo_labels() == undo, undo_labels()


def stop_keeps_it():
    undo, before = undo_labels(), motion()
    begin()
    reached = motion()
    assert hand.click("BrainShiftAlignStop") and not is_running()
    assert said().startswith("Stopped after "), said()
    assert motion() == reached != before, (motion(), reached)
    assert undo_labels() == (["Align"] + undo)[:10], undo_labels()
    window.action("Undo")
    assert motion() == before, motion()
    # While the result is checked, too: then it has no grade.
    begin()
    window.until(lambda: "Checking the result" in said(), "the checks", 60.0)
    reached = motion()
    assert hand.click("BrainShiftAlignStop") and not is_running()
    assert said().startswith("Stopped after ") and "was not checked" in said(), said()
    assert motion() == reached != before and not warned(), (motion(), warned())
    window.action("Undo")
    assert motion() == before, motion()
    # And before the first step.
    undo = undo_labels()
    assert hand.click("BrainShiftAlign") and hand.click("BrainShiftAlignStop")
    assert motion() == before and undo_labels() == undo, (motion(), undo_labels())
    assert "before the first step" in said(), said()


def a_hand_comes_first():
    move_away()
    begin()
    middle = [length // 2 for length in simple.GetActiveView().ViewSize]
    hand.take(hand.SOFT)
    hand.drag(middle, [middle[0] + 20, middle[1]])
    hand.take(hand.NONE)
    assert undo_labels()[:2] == ["Soft stroke", "Align"], undo_labels()
    assert not is_running() and len(window.strokes()) == 1, window.strokes()
    simple.SetActiveSource(compare())
    hand.wait(100)


def others_have_their_way():
    move_away()
    begin()
    compare().ReferenceTranslation = [7.0, 0.0, 0.0]
    hand.wait(100)
    assert motion() == tuple(ROTATION) + (7.0, 0.0, 0.0), motion()
    assert "Reference Translation was changed" in warned(), warned()
    assert not is_running()
    move_away()
    before = motion()
    begin()
    deformation().Strength = 0.5
    hand.wait(100)
    assert motion() == before and "Strength was changed" in warned(), (motion(), warned())
    deformation().Strength = 1.0
    # The volume as loaded comes and goes.
    move_away()
    begin()
    hand.hover([length // 2 for length in simple.GetActiveView().ViewSize])
    hand.key_down("o")
    hand.wait()
    assert deformation().Strength == 0.0 and is_running(), warned()
    hand.key_up("o")
    hand.wait()
    assert deformation().Strength == 1.0 and is_running() and not warned(), warned()
    hand.tap(hand.ESCAPE)


def too_far_is_said():
    with window.unrecorded():
        compare().ReferenceTranslation = [45.0, 0.0, 0.0]
    undo, before = undo_labels(), motion()
    assert hand.click("BrainShiftAlign")
    window.until(lambda: not is_running(), "an end")
    assert "at least 25 % must" in warned(), (warned(), said())
    assert motion() == before and undo_labels() == undo, motion()


def a_failed_result_changes_nothing():
    """A mirrored reference fails; the user may keep the result all the same."""
    rest = compare().Reference
    with window.unrecorded():
        mirrored = simple.Wavelet(registrationName="mirrored", WholeExtent=[0, SIDE] * 3,
                                  Center=[SIDE, 0, 0], XFreq=-20, YFreq=17, ZFreq=23)
        compare().Reference = mirrored
        compare().ReferenceRotation = compare().ReferenceTranslation = [0.0, 0.0, 0.0]
        simple.SetActiveSource(compare())
        simple.Render()
    hand.wait(200)
    undo, before = undo_labels(), motion()
    assert not hand.is_visible("BrainShiftAlignKeep")
    assert hand.click("BrainShiftAlign")
    window.until(lambda: hand.is_visible("BrainShiftAlignKeep"), "a failed result", 120.0)
    for words in ("failed its checks", "if it is mirrored from left to right", "previous position"):
        assert words in warned(), (words, warned())
    assert motion() == before and undo_labels() == undo, motion()
    assert hand.click("BrainShiftAlignKeep")
    hand.wait(100)
    assert motion() != before and not hand.is_visible("BrainShiftAlignKeep"), motion()
    assert said().startswith("Finished") and "failed its checks" in said(), said()
    assert "if it is mirrored" in warned(), warned()
    assert undo_labels() == (["Align"] + undo)[:10], undo_labels()
    window.action("Undo")
    assert motion() == before, motion()
    # Once the start has changed, the result would no longer follow from it.
    assert hand.click("BrainShiftAlign")
    window.until(lambda: hand.is_visible("BrainShiftAlignKeep"), "a failed result", 120.0)
    with window.unrecorded():
        compare().ReferenceTranslation = [1.0, 0.0, 0.0]
        hand.wait(100)
        assert not hand.is_visible("BrainShiftAlignKeep"), "kept from another start"
        compare().ReferenceTranslation = [0.0, 0.0, 0.0]
    assert hand.click("BrainShiftAlign")
    window.until(lambda: hand.is_visible("BrainShiftAlignKeep"), "a failed result", 120.0)
    with window.unrecorded():
        strokes = list(deformation().Strokes)
        deformation().Strokes = strokes + list(brainshift.soft((30, 30, 30), (1, 0, 0), 20.0))
        hand.wait(100)
        assert not hand.is_visible("BrainShiftAlignKeep"), "kept for another deformation"
        deformation().Strokes = strokes
        compare().Reference = rest
        simple.Delete(mirrored)
        simple.SetActiveSource(compare())
    hand.wait(200)


def what_is_typed_counts_first():
    """It would begin where the reference is, and what was typed would be lost."""
    before = motion()
    assert hand.type_into("ReferenceTranslation", "5")
    assert hand.click("BrainShiftAlign")
    assert "compared has changes that are not applied" in warned(), warned()
    assert motion() == before and not is_running(), motion()
    assert hand.click("Accept"), "what was typed is gone"
    hand.wait(100)
    assert motion() != before, "what was typed is gone"


def a_state_keeps_it():
    move_away()
    begin()
    window.until(lambda: not is_running(), "an end")
    now, file = motion(), scratch("state.pvsm")
    simple.SaveState(file)
    simple.ResetSession()
    hand.wait(200)
    simple.LoadState(file)
    os.remove(file)
    hand.wait(500)
    assert motion() == now, motion()


def all_may_go():
    simple.SetActiveSource(compare())
    hand.wait(200)
    move_away()
    begin()
    simple.Delete(compare())
    for _ in range(20):
        hand.wait()
    assert not compare() and deformation(), "the wrong one went"
    simple.ResetSession()
    hand.wait(200)
    set_up()
    begin()
    simple.ResetSession()
    for _ in range(20):
        hand.wait()
    assert not simple.GetSources(), simple.GetSources()


window.main("AlignByHand", [
    (set_up,), (the_picture_follows,), (it_is_one_step,), (it_ends_the_flicker,),
    (escape_moves_it_back,),
    (stop_keeps_it,), (a_hand_comes_first,), (others_have_their_way,), (too_far_is_said,),
    (a_failed_result_changes_nothing,), (what_is_typed_counts_first,), (a_state_keeps_it,),
    (all_may_go,)])
