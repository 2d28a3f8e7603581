# SPDX-License-Identifier: BSD-3-Clause
# Proves that a case makes one pipeline from its roles in any order, that steps say what they lack
# and what they found, that a folder is sorted with reasons and never silently, and that a state
# keeps all of it.
import os
import shutil

from brainshift_testing import assert_says, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402
from patient_testing import TOP, cap, make_patient, table  # noqa: E402

FOLDER = scratch("patient")


def path(name):
    return os.path.join(FOLDER, name)


def clear():
    simple.ResetSession()
    load_plugin()


def names():
    return sorted(name for name, _ in simple.GetSources())


def test_a_folder_is_sorted_with_reasons_and_nothing_is_opened():
    make_patient(FOLDER)
    clear()
    case = brainshift.Case.from_folder(FOLDER)
    found = {os.path.basename(each.file): each.role for each in case.proposal}
    assert found == {
        "sub-1_T1w.nii.gz": "volume", "sub-1_postop.nii.gz": "reference",
        "sub-1_brainmask.nii.gz": "brain", "sub-1_Tumor.nii.gz": "tumour",
        "cavity.nii.gz": "cavity", "pointer.csv": "traces", "targets.csv": "landmarks",
        "ecog_contacts.tsv": "electrodes"}, found
    assert all(each.reason for each in case.proposal)
    assert names() == [] and case.volume is None
    case.accept(electrodes=None, reference=None)
    assert case.electrodes is None and case.reference is None and case.volume is not None
    assert {"sub-1_T1w", "sub-1_T1w bent", "traced points", "landmarks at rest"} <= set(names())


def test_a_name_that_says_nothing_is_sorted_by_content():
    os.makedirs(scratch("plain"), exist_ok=True)
    for old, new in (("sub-1_T1w", "a"), ("sub-1_postop", "b"), ("sub-1_brainmask", "c"),
                     ("sub-1_Tumor", "d"), ("cavity", "e")):
        shutil.copy(path(f"{old}.nii.gz"), scratch(f"plain/{new}.nii.gz"))
    proposal = brainshift.Case.from_folder(scratch("plain")).proposal
    assert [each.role for each in proposal] == ["volume", "reference", "brain", "tumour", None]
    assert_says(proposal[4].reason, "d.nii.gz", "tumour already")
    assert_says(proposal[2].reason, "ml")


def test_roles_in_any_order_make_one_pipeline():
    roles = {"volume": "sub-1_T1w.nii.gz", "brain": "sub-1_brainmask.nii.gz",
             "traces": "pointer.csv", "reference": "sub-1_postop.nii.gz", "cavity": "cavity.nii.gz"}
    seen = []
    for order in (list(roles), list(roles)[::-1]):
        clear()
        case = brainshift.Case()
        for role in order:
            setattr(case, role, path(roles[role]))
        seen.append(names())
        assert case.bent.Input == case.volume and case.bent.Segmentation == case.brain
        assert case.bent.Mask == case.brain and case.bent.MaskGrowth == -1
        assert case.trace_distance.Input == case.traces
        assert case.trace_distance.Segmentation == case.brain
        assert case.trace_distance.Cavity == case.cavity == case.comparison.Cavity
        assert case.comparison.Reference == case.reference
    assert seen[0] == seen[1], seen
    case.reference = None
    assert case.comparison is None and "sub-1_postop" not in names()
    case.holds_outside = False
    assert case.bent.Mask is None and case.bent.Segmentation == case.brain


def test_steps_say_what_they_lack_and_found():
    clear()
    case = brainshift.Case()
    steps = {step.name: step for step in case.steps}
    assert list(steps) == ["Look", "Measure", "Fit", "By hand", "Refine", "Judge", "Export"]
    assert all(step.state == "lacks" and step.lacks for step in case.steps), case.steps
    case.volume, case.traces = path("sub-1_T1w.nii.gz"), path("pointer.csv")
    assert_says(case.steps[2].lacks, "brain", "surface_level")
    case.brain = path("sub-1_brainmask.nii.gz")
    assert [step.state for step in case.steps] == [
        "done", "done", "ready", "ready", "lacks", "lacks", "ready"], case.steps
    assert_says(case.steps[0].found, "41 x 41 x 41 voxels", "mm")
    assert_says(case.steps[1].found, "150 of 150 traced points", "mm from the cortex (RMS)")
    before = case.trace_distance.RMS
    step = case.run("Fit")
    assert step.state == "done" and case.bent.Lattice.Traces == case.traces
    assert_says(step.found, "150 traced points", "mm (RMS)")
    assert_says(case.run("Measure").found, "150 of 150")
    assert case.trace_distance.RMS < 0.3 * before, (case.trace_distance.RMS, before)
    case.landmarks_judge = True
    case.landmarks = path("targets.csv")
    assert case.bent.Lattice.RestLandmarks is None
    assert_says(case.run("Judge").found, "of 8 landmarks", "mm on average")
    case.landmarks_judge = False
    assert case.bent.Lattice.RestLandmarks == case.landmarks[0]
    assert_says(case.run("Judge").found, "leave-one-out", "of 8 landmarks")
    assert_says(repr(case), "Case with volume, brain", "Fit: done")


def test_other_traces_are_fitted_at_once():
    clear()
    table(path("second.csv"), "xyz", cap(100).tolist())
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"), opening=(TOP, 27.0))
    case.run("Fit")
    assert list(case.bent.Lattice.OpeningCentre) == list(TOP)
    assert case.bent.Lattice.OpeningRadius == 27.0
    case.traces = path("second.csv")
    assert_says(case.run("Measure").found, "100 of 100")
    assert case.trace_distance.RMS < 0.6, case.trace_distance.RMS
    assert names().count("traced points") == 1
    case.electrodes = path("ecog_contacts.tsv")
    assert "traced points and contacts" in names()
    fit = brainshift.Fit(case.fit().filter)
    assert len(fit.trace_residuals) == 112, len(fit.trace_residuals)


def test_a_state_keeps_the_case():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"), landmarks=path("targets.csv"),
                           opening=(TOP, 27.0), tumour=path("sub-1_Tumor.nii.gz"),
                           cavity=path("cavity.nii.gz"))
    case.landmarks_judge = True
    case.run("Fit")
    found = [(step.name, step.state, step.found) for step in case.steps]
    simple.SaveState(scratch("case.pvsm"))
    clear()
    simple.LoadState(scratch("case.pvsm"))
    again, = brainshift.Case.all()
    assert brainshift.Case.of(again.tumour).bent == again.bent
    assert again.landmarks_judge is True and again.opening == (tuple(TOP), 27.0)
    assert [(step.name, step.state, step.found) for step in again.steps] == found
    assert again.resect(fields=50).fields == 50
    again.traces = path("second.csv")
    assert again.bent.Lattice.Traces == again.traces


def test_the_resection_of_a_case_is_written():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"), tumour=path("sub-1_Tumor.nii.gz"),
                           cavity=path("cavity.nii.gz"))
    case.run("Fit")
    found = case.resect(fields=50)
    assert 0.0 < found.left < found.before and found.left_interval is not None
    assert found.left_interval[0] <= found.left_interval[1] <= found.before
    case.run("Export", folder=scratch("exported"))
    assert sorted(os.listdir(scratch("exported"))) == [
        "sub-1_T1w_bent.nii.gz", "sub-1_T1w_field.nii.gz", "sub-1_T1w_tumour_deformed.nii.gz",
        "sub-1_T1w_tumour_rest.nii.gz"]
    labels = simple.NIFTIVolumeReader(FileName=scratch("exported/sub-1_T1w_tumour_rest.nii.gz"))
    labels.UpdatePipeline()
    image = servermanager.Fetch(labels)
    assert image.GetScalarRange() == (0.0, 2.0)


def refused(kind, words, function):
    try:
        function()
    except kind as error:
        assert_says(str(error), *words)
    else:
        raise AssertionError(f"nothing was refused that should say {words}")


def test_errors_name_what_is_wrong():
    clear()
    refused(TypeError, ["colour", "volume"], lambda: brainshift.Case(colour="red"))
    refused(FileNotFoundError, ["missing.nii.gz"], lambda: brainshift.Case(volume="missing.nii.gz"))
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"))
    refused(ValueError, ["Fit lacks"], lambda: case.run("Fit"))
    refused(ValueError, ["Paint", "Export"], lambda: case.run("Paint"))
    refused(ValueError, ["lacks a tumour"], case.resect)
    refused(ValueError, ["belongs to no case"],
            lambda: brainshift.Case.of(simple.Sphere()))


run_tests(globals())
