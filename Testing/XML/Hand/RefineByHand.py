# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel's section Refine bends a volume step by step with a picture after each;
that Pause holds it, Stop keeps what is reached as one step to undo, and Escape puts base and
strokes back without one; that a failed result changes nothing unless the user wants it; that
landmarks judge it; that a state has the result; that a hand comes first; that a pull follows; that
it ends Align first; and that it ends with a sentence when something is missing, moves or goes away.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import json
import os
import re

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import scratch, volume
from paraview import simple
from window_testing import deformation, undo_labels

SIDE = 60  # voxels and mm
POINTS = numpy.random.default_rng(5).uniform(18, SIDE - 18, (40, 3))
HAND = tuple(brainshift.soft((30, 30, 30), (0.3, 0.2, -0.2), 40.0))
REST, FILE, NOISE = (scratch(f"{name}.vti") for name in ("rest", "after", "noise"))
kept = {}


def field():
    with window.unrecorded():
        deformation().UpdatePipeline()
        return numpy.array(brainshift.deformed_from_rest(deformation(), POINTS))


def lattices():
    return [name for name, _ in simple.GetSources() if name.endswith("refined")]


def what_is():
    """All that Escape must bring back."""
    lattice = deformation().Lattice
    return (tuple(deformation().Strokes), lattice and lattice.SMProxy.GetGlobalID(),
            lattice and tuple(lattice.ControlPoints), sorted(simple.GetSources()), undo_labels())


def said():
    return hand.label("BrainShiftRefineSaid")


def step():
    """How many steps the run has taken, as the panel says."""
    found = re.match(r"Step (\d+)", said())
    return int(found.group(1)) if found else 0


def uploads():
    display = simple.GetRepresentation(deformation(), simple.GetActiveView())
    return brainshift.counters(display)["latticeUploads"]


def begin():
    """Starts it and waits for two steps."""
    assert hand.click("BrainShiftRefine"), "Refine is disabled"
    window.until(lambda: step() >= 2, "two steps")


def write(values, file):
    source = volume(values.astype(numpy.float32))
    simple.SaveData(file, proxy=source)
    simple.Delete(source)


def write_rest():
    """Folds, longer than the deformation, in a ball."""
    z, y, x = numpy.indices((SIDE + 1,) * 3) - SIDE / 2.0
    folds = (numpy.sin(0.31 * x + 0.1 * y) + numpy.sin(0.27 * y - 0.12 * z)
             + numpy.sin(0.29 * z + 0.08 * x) + numpy.sin(0.11 * (x + y + z)))
    away = numpy.sqrt((x / 26.0) ** 2 + (y / 28.0) ** 2 + (z / 27.0) ** 2)
    write((120 + 25 * folds) * numpy.clip(6 * (1 - away), 0, 1), REST)


def write_references():
    """The volume as known strokes bend it, and noise. Files: a filter here would have a panel."""
    strokes = brainshift.soft((30, 30, 30), (1.5, -1.2, 1.5), 40.0)
    bent = simple.FreeFormDeformation(Input=simple.FindSource("rest"), Strokes=strokes)
    baked = simple.BakeDeformation(Input=bent)
    baked.UpdatePipeline()
    kept["truth"] = numpy.array(brainshift.deformed_from_rest(bent, POINTS))
    simple.SaveData(FILE, proxy=baked)
    write(numpy.random.default_rng(1).normal(0, 1, (SIDE + 1,) * 3), NOISE)
    simple.Delete(baked)
    simple.Delete(bent)


def open_reference():
    simple.OpenDataFile(FILE, registrationName="after").UpdatePipeline()


def set_up():
    write_rest()
    rest = simple.OpenDataFile(REST, registrationName="rest")
    view = simple.GetActiveViewOrCreate("RenderView")
    write_references()
    open_reference()
    bent = simple.FreeFormDeformation(registrationName="bent", Input=rest, Strokes=HAND)
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "Intensity"))
    simple.GetOpacityTransferFunction("Intensity").Points = [30, 0, 0.5, 0, 60, 1, 0.5, 0]
    simple.SetActiveSource(bent)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(300)
    kept["rest"] = field()


def closed_until_it_is_wanted():
    assert hand.is_visible("BrainShiftRefineOpen")
    assert not hand.is_visible("BrainShiftRefine")
    assert hand.click("BrainShiftRefineOpen")
    hand.wait()
    assert hand.is_visible("BrainShiftRefine") and not hand.is_visible("BrainShiftRefineProgress")
    assert hand.choose("BrainShiftRefineReference", "after")
    assert hand.entries("BrainShiftRefineCavity")[0] == "None"
    assert not hand.choose("BrainShiftRefineReference", "bent"), "compared with itself"
    assert not hand.click("BrainShiftRefinePause") and not hand.click("BrainShiftRefineStop")


def the_picture_follows():
    undo, before = undo_labels(), uploads()
    begin()
    assert hand.is_visible("BrainShiftRefineProgress") and hand.is_visible("BrainShiftRefineCurve")
    assert hand.click("BrainShiftRefinePause")
    hand.wait()
    assert hand.in_sight("BrainShiftRefineSaid"), "the user must scroll to see what it does"
    taken, sent = step(), uploads() - before
    assert sent >= taken >= 2, (sent, taken)
    assert undo_labels() == undo, undo_labels()
    assert numpy.abs(field() - kept["rest"]).max() > 0.1, "nothing bends"
    kept["undo"] = undo


def pause_holds_it():
    taken = step()
    for _ in range(50):
        hand.wait()
    assert step() == taken, (step(), taken)
    assert hand.click("BrainShiftRefinePause")
    window.until(lambda: step() > taken or not step(), "a step after Resume")
    assert step() > taken, said()


def a_state_has_the_start():
    """One that is saved meanwhile: what the user made, not a step that no check saw."""
    assert float(hand.label("BrainShiftDisplacement").strip("</b> m")) > 0.5, "of the last step"
    assert hand.click("BrainShiftRefinePause")
    now, taken, file = field(), step(), scratch("midway.pvsm")
    for save in (hand.save_state, simple.SaveState):
        for _ in range(2):  # the second before the run has come back
            save(file)
        with open(file, encoding="utf-8") as saved:
            state = saved.read()
        os.remove(file)
        assert "refined" not in state, (save, "the lattice of a step")
        assert state.count("<ServerManagerState") == 1, save
        numbers = re.search(r'<Property name="Strokes"[^>]*number_of_elements="(\d+)"', state)
        assert numbers and int(numbers.group(1)) == len(HAND), (save, numbers)
        hand.wait(100)
        assert numpy.allclose(field(), now) and step() == taken and len(lattices()) == 1, said()
    kept["undo"] = undo_labels()  # ParaView makes a step of what it writes
    assert hand.click("BrainShiftRefinePause")


def panel_stays():
    """When the pipeline browser has moved what got another input."""
    for _ in range(20):
        hand.wait(20)
    assert hand.is_visible("BrainShiftRefineOpen"), "the panel of the deformation is gone"


def stop_keeps_it():
    assert hand.click("BrainShiftRefineStop")
    assert said().startswith("Stopped after "), said()
    for _ in range(20):
        hand.wait(20)
    assert hand.in_sight("BrainShiftRefineSaid"), "the user must scroll to see what came out"
    for words in ("Cost: ", " mm at most", "Jacobian", "guard", "was not checked"):
        assert words in said(), (words, said())
    assert not hand.label("BrainShiftRefineWarning"), hand.label("BrainShiftRefineWarning")
    assert undo_labels() == (["Refine"] + kept["undo"])[:10], undo_labels()
    assert len(lattices()) == 1 and not list(deformation().Strokes), what_is()[3]
    panel_stays()
    assert simple.GetActiveSource() == deformation(), "another source is active"
    assert not hand.click("Accept"), "there is something to apply"
    kept["refined"] = field()
    assert numpy.abs(kept["refined"] - kept["rest"]).max() > 0.1


def it_is_one_step():
    window.action("Undo")
    assert not deformation().Lattice and not lattices(), lattices()
    assert tuple(deformation().Strokes) == HAND
    assert numpy.allclose(field(), kept["rest"], atol=1e-5)
    window.action("Redo")
    assert deformation().Lattice and not list(deformation().Strokes)
    assert numpy.allclose(field(), kept["refined"], atol=1e-5)


def escape_puts_all_back():
    before = what_is()
    begin()
    hand.tap(hand.ESCAPE)
    panel_stays()
    assert what_is() == before, "something is left"
    assert numpy.allclose(field(), kept["refined"], atol=1e-5)
    assert hand.click("BrainShiftRefine"), "it runs on"
    assert hand.click("BrainShiftRefineStop")  # before the first step
    assert what_is() == before and "before the first step" in said(), said()
    # And with strokes, without a base.
    window.action("Undo")
    before = what_is()
    begin()
    hand.tap(hand.ESCAPE)
    hand.wait()
    assert what_is() == before and tuple(deformation().Strokes) == HAND
    window.action("Redo")


def it_ends_by_itself():
    was, undo = tuple(deformation().Lattice.ControlPoints), undo_labels()
    with window.unrecorded():
        simple.CompareVolumes(registrationName="compared", Input=deformation(),
                              Reference=simple.FindSource("after"))
        simple.SetActiveSource(deformation())
    hand.wait(100)
    for cavity in ("after", "None"):  # what the user chose counts again for another reference
        assert hand.choose("BrainShiftRefineReference", "after")
        assert hand.choose("BrainShiftRefineCavity", cavity)
        assert hand.choose("BrainShiftRefineReference", "compared")
        assert hand.entries("BrainShiftRefineCavity")[0] == "None (of compared)"
        assert hand.choose("BrainShiftRefineReference", "after")
        assert hand.entries("BrainShiftRefineCavity")[0] == cavity
    assert hand.choose("BrainShiftRefineReference", "compared")
    begin()
    window.until(lambda: said().startswith("Finished"), "an end", 120.0)
    assert "Its checks found no fault" in said(), (said(), hand.label("BrainShiftRefineWarning"))
    panel_stays()
    assert undo_labels() == (["Refine"] + undo)[:10], undo_labels()
    assert len(lattices()) == 1, lattices()
    apart = [numpy.linalg.norm(place - kept["truth"], axis=1).mean()
             for place in (kept["rest"], field())]
    assert apart[1] < 0.8 * apart[0], apart
    window.action("Undo")
    assert tuple(deformation().Lattice.ControlPoints) == was, "not the earlier result"
    hand.wait()
    assert "no fault" not in said() and "has changed since" in said(), said()
    window.action("Redo")
    assert tuple(deformation().Lattice.ControlPoints) != was


def a_failed_result_changes_nothing():
    """Noise has nothing in common with the volume."""
    with window.unrecorded():
        simple.OpenDataFile(NOISE, registrationName="other").UpdatePipeline()
        simple.SetActiveSource(deformation())
    hand.wait(100)
    was = what_is()
    assert hand.choose("BrainShiftRefineReference", "other")
    assert hand.click("BrainShiftRefine")
    window.until(lambda: hand.label("BrainShiftRefineWarning"), "a sentence", 120.0)
    told = hand.label("BrainShiftRefineWarning")
    assert "failed its checks" in told and "Nothing was changed." in told, told
    assert what_is() == was, "something has changed"
    window.until(lambda: hand.is_visible("BrainShiftRefineKeep"), "a way to keep it")
    assert hand.click("BrainShiftRefineKeep")
    hand.wait(100)
    assert said().startswith("Finished") and "failed its checks" in said(), said()
    assert hand.label("BrainShiftRefineWarning") and not hand.is_visible("BrainShiftRefineKeep")
    assert undo_labels() == (["Refine"] + was[-1])[:10] and lattices(), undo_labels()
    window.action("Undo")
    assert what_is()[:3] == was[:3], "undo left something"
    # Once the reference has moved, the result would no longer follow from it.
    compared = simple.FindSource("compared")
    with window.unrecorded():
        compared.Reference = simple.FindSource("other")
        simple.SetActiveSource(deformation())
    hand.wait(100)
    assert hand.choose("BrainShiftRefineReference", "compared")
    assert hand.click("BrainShiftRefine")
    window.until(lambda: hand.is_visible("BrainShiftRefineKeep"), "a way to keep it", 120.0)
    with window.unrecorded():
        compared.ReferenceTranslation = [1.0, 0.0, 0.0]
        hand.wait(100)
        assert not hand.is_visible("BrainShiftRefineKeep"), "kept for another position"
        compared.ReferenceTranslation = [0.0, 0.0, 0.0]
        compared.Reference = simple.FindSource("after")
        simple.Delete(simple.FindSource("other"))
        simple.SetActiveSource(deformation())
    hand.wait(100)
    assert hand.choose("BrainShiftRefineReference", "compared")


def pose():
    """Of the reference of the Compare Volumes: mm, then degrees."""
    compared = simple.FindSource("compared")
    return [*compared.ReferenceTranslation, *compared.ReferenceRotation]


def align_ends_first():
    """Refine compares with the position that is kept, not with one of a search that goes on."""
    with window.unrecorded():
        simple.FindSource("compared").ReferenceTranslation = [10.0, 0.0, 0.0]
        simple.SetActiveSource(simple.FindSource("compared"))
    hand.wait(200)
    before = pose()
    assert hand.click("BrainShiftAlign")
    window.until(lambda: pose() != before, "a step of Align")
    simple.SetActiveSource(deformation())
    hand.wait()
    if not hand.is_visible("BrainShiftRefine"):
        assert hand.click("BrainShiftRefineOpen")
    assert hand.choose("BrainShiftRefineReference", "compared")
    moving = pose()
    begin()
    assert hand.click("BrainShiftRefineStop") and said().startswith("Stopped"), said()
    told = json.loads(deformation().Lattice.SMProxy.GetAnnotation("BrainShift.Refined"))
    for _ in range(20):
        hand.wait(20)
    assert told["of"]["pose"] == pose() != before, (told["of"]["pose"], pose(), moving)
    assert undo_labels()[:2] == ["Refine", "Align"], undo_labels()
    window.action("Undo")
    window.action("Undo")
    with window.unrecorded():
        simple.FindSource("compared").ReferenceTranslation = [0.0, 0.0, 0.0]
    hand.wait(100)


def a_reference_may_move():
    """What is reached is kept: it was compared with another position."""
    begin()
    with window.unrecorded():
        simple.FindSource("compared").ReferenceTranslation = [1.0, 0.0, 0.0]
    window.until(lambda: "was changed" in hand.label("BrainShiftRefineWarning"), "a sentence")
    told = hand.label("BrainShiftRefineWarning")
    assert "Reference Translation of compared was changed" in told and "is kept" in told, told
    assert said().startswith("Stopped after"), said()
    window.action("Undo")
    with window.unrecorded():
        simple.FindSource("compared").ReferenceTranslation = [0.0, 0.0, 0.0]
    hand.wait(100)


def landmarks_judge_it():
    """The fit goes, and with it the table of landmarks; the result shows their errors."""
    truth, rest = kept["truth"][:5], POINTS[:5]
    measured = truth + (0.0, 10.0, 0.0)  # of another position of the reference
    pairs = numpy.hstack([rest, measured, [[1], [1], [1], [1], [0]]])
    former = deformation().Lattice
    with window.unrecorded():
        fit = simple.FitDeformation(registrationName="fit", Input=simple.FindSource("rest"),
                                    LandmarkPairs=pairs.ravel().tolist())
        deformation().Lattice = fit
        deformation().Strokes = HAND
        simple.SetActiveSource(deformation())
        before = numpy.linalg.norm(field()[:5] - measured, axis=1)
    window.until(lambda: hand.cell("BrainShiftLandmarks", 4, 0), "the list of landmarks")
    assert hand.choose("BrainShiftRefineReference", "after")
    begin()
    assert hand.click("BrainShiftRefineStop") and said().startswith("Stopped"), said()
    table = hand.label("BrainShiftRefineLandmarks")
    found = numpy.array(re.findall(r">(\d+\.\d\d)", table), float).reshape(-1, 2)
    now = numpy.linalg.norm(field()[:5] - measured, axis=1)
    errors = numpy.stack([before, now], axis=1)
    expected = numpy.vstack([errors.mean(axis=0), errors.max(axis=0), errors])
    assert numpy.abs(found - expected).max() < 0.0051, (found, expected)
    assert table.count("*") == 5, table
    noted = re.search(r"left out a rigid motion of (\d+\.\d) mm", table)
    assert noted and 8.0 < float(noted.group(1)) < 12.0 and "another position" in table, table
    with window.unrecorded():
        deformation().Lattice = former
        deformation().Strokes = []
        simple.Delete(fit)
        for name, number in simple.GetSources():
            source = simple.FindSource(name)
            if "refined" in name and source.SMProxy is not former.SMProxy:
                simple.Delete(source)
        simple.SetActiveSource(deformation())
    hand.wait(200)
    assert hand.choose("BrainShiftRefineReference", "compared")


def a_state_keeps_it():
    now = field()
    file = scratch("state.pvsm")
    simple.SaveState(file)
    hand.take(hand.NONE)
    simple.ResetSession()
    hand.wait(200)
    simple.LoadState(file)
    os.remove(file)
    hand.wait(500)
    assert numpy.allclose(field(), now, atol=1e-5), "another field"
    assert len(lattices()) == 1, lattices()


def open_again():
    """As it was before all refinements, with the section open."""
    with window.unrecorded():
        deformation().Lattice = None
        deformation().Strokes = HAND
        for name in lattices():
            simple.Delete(simple.FindSource(name))
    simple.SetActiveSource(deformation())
    hand.wait(200)
    if not hand.is_visible("BrainShiftRefine"):
        assert hand.click("BrainShiftRefineOpen")
    hand.wait(100)


def a_hand_comes_first():
    open_again()
    begin()
    assert hand.click("BrainShiftRefinePause")
    middle = [length // 2 for length in simple.GetActiveView().ViewSize]
    hand.take(hand.SOFT)
    hand.drag(middle, [middle[0] + 20, middle[1]])
    hand.take(hand.NONE)
    # The stroke follows what was reached.
    assert undo_labels()[:2] == ["Soft stroke", "Refine"], undo_labels()
    assert said().startswith("Stopped") and "changed since" in said(), said()
    assert len(window.strokes()) == 1 and len(lattices()) == 1, window.strokes()


def a_pull_comes_first():
    """It follows what was reached, and nothing of the start is lost."""
    open_again()
    begin()
    middle = [length // 2 for length in simple.GetActiveView().ViewSize]
    hand.take(hand.PULL)
    hand.drag(middle, [middle[0] + 25, middle[1]])
    hand.take(hand.NONE)
    assert undo_labels()[:2] == ["Pull tissue", "Refine"], undo_labels()
    assert said().startswith("Stopped") and "changed since" in said(), said()
    fit = deformation().Lattice
    assert fit.Base and len(lattices()) == 1 and not list(deformation().Strokes), lattices()
    window.action("Undo")
    assert deformation().Lattice == fit.Base, "the pull stays"
    window.action("Undo")
    assert tuple(deformation().Strokes) == HAND and not deformation().Lattice
    assert numpy.allclose(field(), kept["rest"], atol=1e-5)


def a_change_of_strength_comes_first():
    open_again()
    begin()
    assert hand.type_into("BrainShiftStrengthSpinBox", 0.8)
    assert undo_labels()[:2] == ["Change Strength", "Refine"], undo_labels()
    assert deformation().Strength == 0.8 and len(lattices()) == 1, deformation().Strength
    window.action("Undo")
    assert deformation().Strength == 1.0 and lattices(), deformation().Strength
    window.action("Undo")
    assert tuple(deformation().Strokes) == HAND and not deformation().Lattice


def a_look_at_before_disturbs_nothing():
    open_again()
    begin()
    hand.hover([length // 2 for length in simple.GetActiveView().ViewSize])
    hand.key_down("o")
    window.until(lambda: deformation().Strength == 0.0, "the volume as loaded")
    taken = step()
    window.until(lambda: step() > taken, "a step meanwhile")
    hand.key_up("o")
    hand.wait()
    assert deformation().Strength == 1.0 and step(), said()
    assert not hand.label("BrainShiftRefineWarning"), hand.label("BrainShiftRefineWarning")
    hand.key_down("o")
    hand.wait()
    assert hand.click("BrainShiftRefineStop")
    hand.key_up("o")
    assert said().startswith("Stopped") and undo_labels()[0] == "Refine", undo_labels()
    assert deformation().Strength == 1.0, deformation().Strength
    window.action("Undo")
    assert tuple(deformation().Strokes) == HAND and not deformation().Lattice
    assert deformation().Strength == 1.0, deformation().Strength
    window.action("Redo")
    assert deformation().Lattice and deformation().Strength == 1.0, deformation().Strength


def a_pull_follows_it():
    """The first pull makes a fit whose base is the refinement."""
    open_again()
    begin()
    assert hand.click("BrainShiftRefineStop")
    refined, before = field(), deformation().Lattice
    middle = [length // 2 for length in simple.GetActiveView().ViewSize]
    hand.take(hand.PULL)
    hand.drag(middle, [middle[0] + 25, middle[1]])
    hand.take(hand.NONE)
    fit = deformation().Lattice
    assert undo_labels()[0] == "Pull tissue" and fit.Base == before, (undo_labels(), fit)
    pulled = field()
    way = numpy.linalg.norm(pulled - refined, axis=1)
    assert 1.0 < way.max() < 15.0, way  # from where the refinement put it, not from rest
    pull = numpy.array(list(fit.Pulls)[:7])
    with window.unrecorded():
        alone = simple.FreeFormDeformation(Input=deformation().Input, Lattice=before)
        was = brainshift.deformed_from_rest(alone, [pull[:3]])[0]
        simple.Delete(alone)
        simple.SetActiveSource(deformation())
    assert 1.0 < numpy.linalg.norm(pull[3:6] - was) < 15.0, (pull, was)
    window.action("Undo")
    assert deformation().Lattice == before and numpy.allclose(field(), refined, atol=1e-5)
    window.action("Redo")
    assert numpy.allclose(field(), pulled, atol=1e-5)
    # Another refinement begins with both.
    begin()
    hand.tap(hand.ESCAPE)
    hand.wait()
    assert deformation().Lattice == fit and numpy.allclose(field(), pulled, atol=1e-5)
    begin()
    assert hand.click("BrainShiftRefineStop")
    assert deformation().Lattice not in (fit, before), deformation().Lattice
    window.action("Undo")
    assert deformation().Lattice == fit and numpy.allclose(field(), pulled, atol=1e-5)
    with window.unrecorded():
        deformation().Lattice = None
        simple.Delete(fit)


def others_have_their_way():
    # As Apply in the panel does.
    open_again()
    begin()
    deformation().LatticeDimensions = [15, 15, 15]
    hand.wait(100)
    told = hand.label("BrainShiftRefineWarning")
    assert "Lattice Dimensions of bent was changed" in told, told
    assert tuple(deformation().Strokes) == HAND and not deformation().Lattice, "strokes are lost"
    assert not lattices(), lattices()
    window.action("Undo")
    assert list(deformation().LatticeDimensions) == [19, 19, 19], "no step to undo"
    assert tuple(deformation().Strokes) == HAND and not deformation().Lattice
    window.action("Redo")
    assert hand.click("BrainShiftRefine"), "it runs on"
    hand.tap(hand.ESCAPE)
    deformation().LatticeDimensions = [19, 19, 19]
    hand.wait(100)


def what_is_wrong_is_said():
    before = deformation().Strength
    deformation().Strength = 0.5
    was = what_is()
    assert hand.click("BrainShiftRefine")
    told = hand.label("BrainShiftRefineWarning")
    assert "Strength is 0.5" in told and told.endswith("."), told
    assert what_is() == was, "something has changed"
    deformation().Strength = before


def a_reference_may_go():
    open_again()
    begin()
    assert hand.select(simple.FindSource("compared"))
    hand.delete_selected()
    window.until(lambda: "was deleted" in hand.label("BrainShiftRefineWarning"), "a sentence")
    assert said().startswith("Stopped after"), said()
    it_may_come_back()
    for name in ("after", "after.vti"):  # a state calls a reader as its file
        if simple.FindSource(name):
            simple.Delete(simple.FindSource(name))
    hand.wait(100)
    assert hand.click("BrainShiftRefine")
    told = hand.label("BrainShiftRefineWarning")
    assert told.startswith("There is no reference"), told


def it_may_come_back():
    """All is as before then: no lattice of a step is left, and no sentence."""
    undo = undo_labels()
    assert undo[:2] == ["Refine", "Delete compared"], undo
    for _ in range(2):
        for number in range(2):
            window.action("Undo")
            hand.wait(200)
            assert not lattices(), (number, lattices())
        assert simple.FindSource("compared") and tuple(deformation().Strokes) == HAND
        assert not hand.label("BrainShiftRefineWarning"), hand.label("BrainShiftRefineWarning")
        for number in range(2):
            window.action("Redo")
            hand.wait(200)
            assert len(lattices()) == number, (number, lattices())
    assert undo_labels() == undo, undo_labels()


def the_deformation_may_go():
    with window.unrecorded():
        open_reference()
    open_again()
    begin()
    view = simple.GetActiveView()
    bent = deformation()
    simple.Delete(bent)
    for _ in range(20):
        hand.wait()
    assert not deformation() and view, "it is still there"


def the_session_may_go():
    simple.ResetSession()
    hand.wait(200)
    simple.GetActiveViewOrCreate("RenderView")
    set_up()
    open_again()
    begin()
    simple.ResetSession()
    for _ in range(20):
        hand.wait()
    assert not simple.GetSources(), simple.GetSources()
    os.remove(FILE)


window.main("RefineByHand", [
    (set_up,), (closed_until_it_is_wanted,), (the_picture_follows,), (pause_holds_it,),
    (a_state_has_the_start,),
    (stop_keeps_it,), (it_is_one_step,), (escape_puts_all_back,), (it_ends_by_itself,),
    (a_failed_result_changes_nothing,), (align_ends_first,), (a_reference_may_move,),
    (landmarks_judge_it,), (a_state_keeps_it,),
    (a_hand_comes_first,), (a_pull_comes_first,), (a_change_of_strength_comes_first,),
    (a_look_at_before_disturbs_nothing,), (a_pull_follows_it,), (others_have_their_way,),
    (what_is_wrong_is_said,),
    (a_reference_may_go,), (the_deformation_may_go,), (the_session_may_go,)])
