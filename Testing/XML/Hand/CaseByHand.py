# SPDX-License-Identifier: BSD-3-Clause
"""Proves the dock Case by a hand's events: its key shows and hides it; a role that is chosen,
dropped or opened as a file wires the pipeline in one step to undo, and undo and redo lead there and
back; a folder's files are shown for correction before anything is opened; steps say what they lack
and found; the fit is one press; a wrong file is refused with its reason; refining, judging,
exporting, the report and the tumour that is left work by their buttons; another moment of the
surgery is begun, shown and undone; and a state brings the dock back.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import os

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift import lineage, scenes
from brainshift.points import read_from
from brainshift.registering import refined_by
from brainshift_testing import scratch
from paraview import simple
from patient_testing import MIDDLE, cap, make_patient, sunk, table

FOLDER = scratch("patient")
DOCK = "BrainShiftCaseDock"
STEPS = ("Look", "Measure", "Fit", "Byhand", "Refine", "Judge", "Export", "Tumourleft", "Report",
         "Moments")


def path(name):
    return os.path.join(FOLDER, name)


def case():
    found, = brainshift.Case.all()
    return found


def names():
    return sorted(name for name, _ in simple.GetSources())


def text_of(step):
    return hand.label(f"BrainShiftCase{step}Text")


def settled():
    hand.wait(500)


def chosen(role):
    return hand.entries(f"BrainShiftCase{role}")[0]


def undo(label):
    assert window.undo_labels()[0] == label, window.undo_labels()
    window.action("Undo")
    settled()


def set_up():
    make_patient(FOLDER)
    points = [[*point, 60.0 * minute] for minute, point in enumerate(sunk(cap(150)).tolist())]
    table(path("pointer.csv"), ["x", "y", "z", "time_s"], points)
    for source in list(simple.GetSources().values()):
        simple.Delete(source)
    hand.resize_window(1280, 900)
    assert not hand.is_visible(DOCK), "a script began this window"
    simple.GetActiveViewOrCreate("RenderView")
    hand.shortcut("0", hand.ALT)
    settled()
    assert hand.is_visible(DOCK)
    hand.shortcut("0", hand.ALT)
    settled()
    assert not hand.is_visible(DOCK)
    hand.shortcut("0", hand.ALT)
    settled()
    hand.focus()
    hand.shortcut("0", hand.ALT)
    settled()
    assert hand.is_visible(DOCK), "the key went from the view to the dock"
    window.forget_undo()


def steps_say_what_they_lack():
    assert text_of("Look") == "Needs a volume", text_of("Look")
    assert not hand.click("BrainShiftCaseFit"), "which is disabled"
    assert chosen("Volume") == "\u2013"


def roles_are_chosen_and_undone():
    assert hand.drop("BrainShiftCaseVolume", path("sub-1_T1w.nii.gz"))
    settled()
    assert names() == ["sub-1_T1w", "sub-1_T1w bent"], names()
    assert chosen("Volume") == "sub-1_T1w"
    assert "41 x 41 x 41 voxels" in text_of("Look"), text_of("Look")
    shown = simple.GetRepresentation(case().bent, simple.GetActiveView())
    assert shown.Visibility == 1 and shown.Representation == "Deformed Volume"
    undo("Choose Volume")
    assert names() == [] and chosen("Volume") == "\u2013", (names(), chosen("Volume"))
    assert text_of("Look") == "Needs a volume"
    window.action("Redo")
    settled()
    assert names() == ["sub-1_T1w", "sub-1_T1w bent"] and chosen("Volume") == "sub-1_T1w"
    mask = simple.OpenDataFile(path("sub-1_brainmask.nii.gz"))
    simple.RenameSource("a mask", mask)
    mask.UpdatePipeline()
    settled()
    assert hand.choose_by_keys("BrainShiftCaseBrain", "a mask")
    settled()
    assert case().bent.Segmentation == mask and case().bent.Mask == mask
    undo("Choose Brain")
    assert case().bent.Mask is None and case().brain is None and chosen("Brain") == "\u2013"
    window.action("Redo")
    settled()
    assert case().bent.Mask == mask and chosen("Brain") == "a mask"


def settings_are_undone():
    assert hand.is_visible("BrainShiftCase_mask_growth")
    assert not hand.is_visible("BrainShiftCase_surface_level"), "the brain is the cortex"
    assert hand.type_into("BrainShiftCase_mask_growth", "3")
    settled()
    assert case().mask_growth == 3.0 == case().bent.MaskGrowth
    undo("Set Brain grows by")
    assert case().mask_growth == -1.0 == case().bent.MaskGrowth
    assert hand.type_into("BrainShiftCase_brain_labels", "all")  # no letter is a key of a view
    settled()
    assert "\"all\"" in hand.label("BrainShiftCaseProblem"), hand.label("BrainShiftCaseProblem")
    assert case().brain_labels == []


def a_wrong_file_is_refused():
    before, steps = names(), window.undo_labels()
    assert hand.drop("BrainShiftCaseTumour", path("pointer.csv"))
    settled()
    problem = hand.label("BrainShiftCaseProblem")
    assert "volume" in problem and "pointer" in problem, problem
    assert names() == before and case().tumour is None and chosen("Tumour") == "\u2013"
    assert window.undo_labels() == steps, "nothing happened"
    hand.close_messages()


def traces_are_opened_measured_and_fitted():
    assert "traces" in text_of("Fit"), text_of("Fit")
    hand.answer_path("BrainShiftCaseFile", path("pointer.csv"))
    assert hand.choose_by_keys("BrainShiftCaseTraces", "Open File...")
    window.until(lambda: chosen("Traces") == "traced points", "the traces")
    settled()
    assert "150 of 150 traced points" in text_of("Measure"), text_of("Measure")
    before = case().trace_distance.RMS
    assert hand.choose_by_keys("BrainShiftCaseOpening", "Sphere")
    settled()
    centre, radius = case().opening
    assert 20.0 < radius < 40.0 and hand.is_visible("BrainShiftCaseSphere"), (centre, radius)
    assert hand.click("BrainShiftCaseFit")
    window.until(lambda: "residuals" in text_of("Fit"), "the fit")
    settled()
    assert case().trace_distance.RMS < 0.3 * before, (before, case().trace_distance.RMS)
    assert list(case().bent.Lattice.OpeningCentre) == list(centre)
    undo("Fit")
    assert case().bent.Lattice is None and text_of("Fit") == ""
    window.action("Redo")
    settled()
    assert "residuals" in text_of("Fit"), text_of("Fit")
    hand.forget_messages()
    assert hand.click("BrainShiftCaseMeasure")
    settled()
    assert hand.messages() == ([], False), hand.messages()  # as of a format of the scale's labels
    shown = simple.GetRepresentation(case().trace_distance, simple.GetActiveView())
    assert shown.Visibility == 1


def by_hand_takes_the_stamp():
    assert hand.click("BrainShiftCaseByhand")
    hand.wait(200)
    assert hand.setting("tool") == hand.STAMP and simple.GetActiveSource() == case().bent
    assert hand.has_focus(), "the keys are the tool's"
    hand.take(hand.NONE)
    hand.shortcut("0", hand.ALT)
    settled()
    assert hand.is_visible(DOCK)


def visible(source):
    return simple.GetRepresentation(source, simple.GetActiveView()).Visibility


def another_moment_is_begun_and_shown():
    assert "New Moment" in text_of("Moments"), text_of("Moments")
    first = case()
    assert hand.click("BrainShiftCaseNewMoment")
    settled()
    first, later = first.moments
    assert names()[-3:] == ["sub-1_T1w moments", "trace distance", "traced points"], names()
    assert chosen("Brain") == "a mask" and chosen("Traces") == "\u2013"
    assert hand.type_into("BrainShiftCase_moment", "2")
    settled()
    assert hand.type_into("BrainShiftCase_minutes", "45")
    settled()
    assert (later.moment, later.minutes) == ("2", 45.0), (later.moment, later.minutes)
    assert hand.entries("BrainShiftCases")[1] == ["sub-1_T1w, first moment", "sub-1_T1w, 2"]
    assert visible(later.bent) == 1 and visible(first.bent) == 0
    shown, former = (simple.GetRepresentation(each.bent, simple.GetActiveView())
                     for each in (later, first))
    assert shown.LookupTable == former.LookupTable and not shown.UseSeparateColorMap
    assert shown.DrawSegment == 1, "the brain is drawn, not the skin"
    assert hand.choose_by_keys("BrainShiftCases", "sub-1_T1w, first moment")
    settled()
    assert visible(later.bent) == 0 and visible(first.bent) == 1
    assert chosen("Traces") == "traced points"
    assert hand.click("BrainShiftCaseMoments")
    settled()
    assert visible(first.part("moments")) == 1 and visible(first.bent) == 0
    assert "2 45 min" in text_of("Moments"), text_of("Moments")
    undo("Moments")
    assert visible(first.bent) == 1, "it is shown again"
    traces_go_by_time(first, later)
    undo("Set Time")
    undo("Set Moment")
    undo("New Moment")
    assert case().moments == [case()] and case() == first, names()


def traces_go_by_time(first, later):
    """The traces have a time stamp each minute, and the later moment begins at 45 minutes."""
    unit = "by time stamps in s"
    assert hand.choose_by_keys("BrainShiftCase_traces_by_time", unit)
    settled()
    assert hand.entries("BrainShiftCase_traces_by_time")[0] == unit
    counts = [each.traced.GetDataInformation().GetNumberOfPoints() for each in (first, later)]
    assert counts == [45, 105] and later.traces == first.traces, counts
    assert "45 of 45 traced points" in text_of("Measure"), text_of("Measure")
    assert hand.type_into("BrainShiftCase_trace_start", "600")
    settled()
    assert first.trace_start == later.trace_start == 600.0
    assert "10 traced points belong to no moment" in text_of("Measure"), text_of("Measure")
    undo("Set Stamp at minute 0")
    undo("Set Traces of all moments")
    assert later.traces is None and first.traced == first.traces


def a_folder_is_sorted_and_corrected():
    assert hand.click("BrainShiftCaseNew")
    settled()
    assert chosen("Volume") == "\u2013" and hand.entries("BrainShiftCases")[0] == "New case"
    assert hand.choose_by_keys("BrainShiftCases", "sub-1_T1w")  # which the files must not change
    settled()
    first = chosen("Traces")
    hand.answer("BrainShiftProposal", "BrainShiftProposalOk", ("BrainShiftProposal2", "None"))
    assert hand.drop(DOCK, FOLDER)
    window.until(lambda: chosen("Volume") == "sub-1_T1w 2", "the case of the folder")
    settled()
    rows = {row[0]: row[1] for row in hand.answered()}
    assert rows["pointer.csv"] == "Traces" and rows["targets.csv"] == "Landmarks", rows
    assert rows["sub-1_Tumor.nii.gz"] == "Tumour", rows
    assert list(rows)[2] == "pointer.csv", "the one that was corrected"
    assert chosen("Traces") == "\u2013" and chosen("Tumour") == "sub-1_Tumor"
    assert chosen("Landmarks") == "landmarks at rest" and chosen("Measured") == "measured landmarks"
    assert chosen("Reference") == "sub-1_postop", chosen("Reference")
    assert len(hand.entries("BrainShiftCases")[1]) == 2
    present, other = brainshift.Case.all()[::-1]
    assert visible(present.bent) == 1 and visible(other.bent) == 0, "one patient at a time"
    assert hand.choose_by_keys("BrainShiftCases", "sub-1_T1w")
    settled()
    assert visible(present.bent) == 0 and visible(other.bent) == 1
    assert hand.choose_by_keys("BrainShiftCases", "sub-1_T1w 2")
    settled()
    assert brainshift.Case.all()[0].traces is not None and first == "traced points"
    assert hand.click("BrainShiftCaseJudge")
    settled()
    assert "of 8 landmarks" in text_of("Judge"), text_of("Judge")


def second():
    return brainshift.Case.all()[1]


def shown():
    """The sources that the active view shows."""
    return [display.Input for display in simple.GetActiveView().Representations
            if display.Visibility and hasattr(display, "Input")]


def the_tumour_that_is_left_is_shown():
    assert hand.click("BrainShiftCaseTumourleft")
    window.until(lambda: "ml left" in text_of("Tumourleft"), "the resection", 60.0)
    settled()
    resected = simple.FindSource("sub-1_T1w resection")
    assert resected in shown() and second().bent not in shown(), shown()
    view = simple.GetActiveView()
    towards = numpy.subtract(view.CameraPosition, view.CameraFocalPoint)
    with window.unrecorded():
        contacts = read_from(second().electrodes).positions
    outwards = contacts.mean(axis=0) - MIDDLE
    assert towards @ outwards > 0.99 * numpy.linalg.norm(towards) * numpy.linalg.norm(outwards)
    undo("Tumour left")
    assert simple.FindSource("sub-1_T1w resection") is None and second().bent in shown(), shown()
    assert text_of("Tumourleft") == "", text_of("Tumourleft")
    window.action("Redo")
    settled()
    assert "ml left" in text_of("Tumourleft"), text_of("Tumourleft")


def a_reference_is_refined():
    assert hand.click("BrainShiftCaseFit")
    window.until(lambda: "8 landmarks" in text_of("Fit"), "the fit")
    settled()
    with window.unrecorded():
        used = lineage.landmarks_fitted_by(second().bent.Lattice)
        of = lineage.compared_by(second().bent, second().comparison)
    assert used, "the fit used landmarks"
    assert hand.click("BrainShiftCaseRefine")
    window.until(lambda: "finished after" in text_of("Refine"), "the end of the refinement", 120.0)
    settled()
    assert f"{chosen('Volume')} refined" in names(), names()
    with window.unrecorded():
        assert lineage.landmarks_fitted_by(second().bent.Lattice) == used, used
        assert refined_by(second().bent.Lattice)["of"] == of, of
    assert "A fit before the refinement used the landmarks" in text_of("Judge"), text_of("Judge")


def files_are_written():
    os.makedirs(scratch("exported"), exist_ok=True)
    hand.answer_path("BrainShiftCaseExportDialog", scratch("exported"))
    assert hand.click("BrainShiftCaseExport")
    window.until(lambda: "files" in text_of("Export"), "the export")
    assert sorted(os.listdir(scratch("exported"))) == [
        "sub-1_T1w_bent.nii.gz", "sub-1_T1w_field.nii.gz"], os.listdir(scratch("exported"))
    hand.answer_path("BrainShiftCaseReportDialog", scratch("report.html"))
    assert hand.click("BrainShiftCaseReport")
    window.until(lambda: "report.html" in text_of("Report"), "the report", 120.0)
    with open(scratch("report.html"), encoding="utf-8") as page:
        assert "sub-1" not in page.read(), "names stay out"
    drawn = scenes.slices(second(), scenes.focus_of(second()), (64, 64))["axial"]
    assert drawn[:4, :4].max() == 0 and drawn[32, 32].min() > 100, "no memory of a window"


def all_texts():
    """What the steps found, of each case. The first one is in hand afterwards."""
    labels = hand.entries("BrainShiftCases")[1]
    found = []
    for label in reversed(labels):
        assert hand.choose_by_keys("BrainShiftCases", label)
        settled()
        found.insert(0, {step: text_of(step) for step in STEPS})
    return found


def a_state_brings_the_dock_back():
    assert hand.click("BrainShiftCaseJudge")  # again: the deformation is another
    settled()
    assert hand.choose_by_keys("BrainShiftCases", hand.entries("BrainShiftCases")[1][0])
    settled()
    fit = text_of("Fit")
    assert "residuals" in fit, fit
    told = all_texts()
    assert "of 8 landmarks" in told[1]["Judge"] and "ml left" in told[1]["Tumourleft"], told
    assert "files" in told[1]["Export"] and "report.html" in told[1]["Report"], told
    hand.save_state(scratch("case.pvsm"))
    hand.reset_session()
    settled()
    assert text_of("Look") == "Needs a volume", text_of("Look")
    hand.load_state(scratch("case.pvsm"))
    window.until(lambda: text_of("Fit") == fit, "the fit of the state")
    assert chosen("Brain") == "a mask" and hand.is_visible("BrainShiftCaseSphere")
    again = all_texts()
    assert again == told, [pair for pair in zip(again, told) if pair[0] != pair[1]]
    simple.RenameSource("sub-1_T..w.nii.gz", brainshift.Case.all()[0].volume)  # as the dialog does
    window.until(lambda: chosen("Volume") == "sub-1_T1w", "the name that it had")


window.main("CaseByHand", [
    (set_up,), (steps_say_what_they_lack,), (roles_are_chosen_and_undone,), (settings_are_undone,),
    (a_wrong_file_is_refused,), (traces_are_opened_measured_and_fitted,),
    (by_hand_takes_the_stamp,), (another_moment_is_begun_and_shown,),
    (a_folder_is_sorted_and_corrected,), (a_reference_is_refined,), (files_are_written,),
    (the_tumour_that_is_left_is_shown,), (a_state_brings_the_dock_back,)])
