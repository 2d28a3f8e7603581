# SPDX-License-Identifier: BSD-3-Clause
# Proves that a case makes one pipeline from its roles in any order, that steps say what they lack
# and what they found, that a folder is sorted with reasons and never silently, and that a state
# keeps all of it.
import json
import os
import shutil

from unittest import mock

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, data, load_plugin, messages, run_tests, scratch,
                                volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import casesources, dock  # noqa: E402
from brainshift.points import read_from  # noqa: E402
from brainshift.roles import proposed  # noqa: E402
from brainshift.worker import figures_of_case  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from patient_testing import (MIDDLE, RADIUS, TOP, cap, make_patient, sunk,  # noqa: E402
                             table)

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
    shutil.rmtree(scratch("plain"), ignore_errors=True)
    os.makedirs(scratch("plain"))
    for old, new in (("sub-1_T1w", "a"), ("sub-1_postop", "b"), ("sub-1_brainmask", "c"),
                     ("sub-1_Tumor", "d"), ("cavity", "e")):
        shutil.copy(path(f"{old}.nii.gz"), scratch(f"plain/{new}.nii.gz"))
    proposal = brainshift.Case.from_folder(scratch("plain")).proposal
    assert [each.role for each in proposal] == ["volume", "reference", "brain", "tumour", None]
    assert_says(proposal[4].reason, "d.nii.gz", "tumour already")
    assert_says(proposal[2].reason, "ml")
    shutil.copy(path("sub-1_Tumor.nii.gz"), scratch("plain/0_postop_tumor.nii.gz"))
    proposal = brainshift.Case.from_folder(scratch("plain")).proposal
    assert [each.role for each in proposal[:2]] == [None, "volume"], proposal
    assert_says(proposal[0].reason, "tumor", "postop")
    shutil.copy(path("sub-1_T1w.nii.gz"), scratch("plain/x_T1w.nii.gz"))
    found = {os.path.basename(each.file): each for each in
             brainshift.Case.from_folder(scratch("plain")).proposal}
    assert found["x_T1w.nii.gz"].role == "volume", "a name says more than values"
    assert_says(found["x_T1w.nii.gz"].reason, "its name has the word t1w")
    assert found["a.nii.gz"].role == "reference", found


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
        case.cavity_labels = [1]
        assert list(case.trace_distance.CavityLabels) == [1] == list(case.comparison.CavityLabels)
        assert case.comparison.Reference == case.reference
    assert seen[0] == seen[1], seen
    assert "moved" not in case.steps[1].found
    case.comparison.ReferenceTranslation = [2.0, 0.0, 0.0]
    assert_says(case.steps[1].found, "The reference was moved, and its cavity with it")
    case.reference = None
    assert case.comparison is None and "sub-1_postop" not in names()
    assert "moved" not in case.steps[1].found
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
    assert "sub-1_T1w fit" in names(), names()
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


def test_what_may_be_wrong_is_marked_and_said():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"))
    assert case.doubts() == [] and case.doubtful() == set()
    case.run("Fit")
    case.reference = path("sub-1_postop.nii.gz")
    assert case.doubtful() == set(), case.doubts()

    def said(step, *words):
        assert step in case.doubtful(), case.doubts()
        found = next(one for one in case.steps if one.name == step)
        assert_says(found.found, *words)
        assert found.found.count(words[0]) == 1, found.found
        return found.state
    table(path("far.csv"), "xyz", (sunk(cap(150)) + (0, 0, 25)).tolist())
    case.traces = path("far.csv")
    assert said("Fit", "The fold guard applied") == "done" and case.fit_source().Share < 1.0
    case.traces = path("pointer.csv")
    assert case.doubtful() == set(), case.doubts()
    case.bent.GuardFolding = 0
    case.bent.Strokes = brainshift.soft(TOP, (0, 0, -60), 15)
    assert said("By hand", "folds", "Jacobian determinant is -") == "done"
    case.bent.Strokes = []
    assert case.doubtful() == set(), case.doubts()
    with mock.patch.object(type(case), "comparison", new_callable=mock.PropertyMock) as compared:
        compared.return_value.GetPropertyValue.return_value = "The reference has other axes"
        assert said("Refine", "The reference has other axes") == "ready"


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


def test_electrodes_are_fitted_by_their_sheet():
    clear()
    steps = 10.0 * numpy.mgrid[-1.5:2, -2:2.5].reshape(2, -1).T
    angles = numpy.linalg.norm(steps, axis=1) / RADIUS
    flat = steps / numpy.linalg.norm(steps, axis=1)[:, None]
    rest = MIDDLE + RADIUS * numpy.column_stack(
        (flat * numpy.sin(angles)[:, None], numpy.cos(angles)))
    measured = sunk(rest)
    measured[6] += (0.0, 0.0, 6.0)  # it floats
    labels = [f"G{i + 1}" for i in range(len(rest))]
    shaft = [[MIDDLE + x, MIDDLE, MIDDLE] for x in (55.0, 50.0, 45.0, 40.0)]
    table(path("grid.csv"), "label x y z".split(), [
        [name, *at] for name, at in zip(labels + ["D1", "D2", "D3", "D4"],
                                        measured.tolist() + shaft)])
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           electrodes=path("grid.csv"))
    case.run("Fit")
    fit = case.bent.Lattice
    assert fit.RestLandmarks == case.part("at_rest") and fit.MeasuredLandmarks == case.electrodes
    used = brainshift.Fit(fit)
    assert len(used.trace_residuals) == 19, "neither what floats nor the shaft"
    left = numpy.delete(numpy.arange(20), 6)
    back = brainshift.rest_from_deformed(case.bent, measured[left])
    off = numpy.linalg.norm(back - rest[left], axis=1)
    print(f"tissue under the contacts {off.mean():.2f} mm off")
    assert off.mean() < 1.5, off
    assert len(used.left_out_of_used) == 19, used.left_out_of_used
    found = case.steps[2].found
    assert_says(found, "19 contacts of grids", "G7", "above")
    measured = case.steps[1].found
    assert_says(measured, "19 of 24 contacts count")  # neither what floats nor the shaft
    assert case.contact_distance.RMS < 1.0, measured
    assert {name for name in figures_of_case(case) if "RMS" in name} == {"contacts RMS (mm)"}
    simple.SaveState(scratch("grid.pvsm"))
    clear()
    simple.LoadState(scratch("grid.pvsm"))
    case, = brainshift.Case.all()
    fit = case.bent.Lattice
    assert "Fit" in case.doubtful() and case.steps[2].found == found, case.steps[2]
    refused(ValueError, ["electrodes must not be made of"],
            lambda: setattr(case, "electrodes", case.part("at_rest")))
    case.judged = "a line"
    case.part("at_rest").ContactDeviation = 0.7
    assert case.judged is None, "another fit"
    case.landmarks_judge = True
    case.landmarks = path("targets.csv")
    assert_says(case.run("Judge").found, "of 8 landmarks", "mm on average")
    case.landmarks_judge = False
    assert fit.RestLandmarks == case.landmarks[0], "landmarks of the user come first"
    assert_says(case.run("Judge").found, "leave-one-out", "of 8 landmarks")
    case.landmarks = case.electrodes = None
    assert case.part("at_rest") is None and "contacts at rest" not in names()
    os.remove(path("grid.csv"))


def test_landmarks_in_two_files_are_a_pair():
    clear()
    folder = scratch("two")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    shutil.copy(path("sub-1_T1w.nii.gz"), folder)
    for name, x in (("landmarks_preop", 1.0), ("landmarks_intraop", 2.0)):
        table(os.path.join(folder, f"{name}.csv"), "label x y z".split(),
              [[f"L{i}", x + 10 * i, 5.0 * i ** 2, 3.0] for i in range(4)])
    case = brainshift.Case.from_folder(folder)
    assert {os.path.basename(each.file): each.role for each in case.proposal} == {
        "landmarks_preop.csv": "landmarks", "landmarks_intraop.csv": "measured",
        "sub-1_T1w.nii.gz": "volume"}, case.proposal
    case.accept()
    rest, measured = (read_from(source).positions[:, 0].tolist() for source in case.landmarks)
    assert (rest[0], measured[0]) == (1.0, 2.0)
    at_rest = case.landmarks[0]
    case.proposal = []
    case.accept(measured=os.path.join(folder, "landmarks_preop.csv"))
    assert case.landmarks[0] == at_rest, "they are kept"
    refused(ValueError, ["targets.csv", "both positions", "landmarks_intraop.csv"],
            lambda: case.accept(landmarks=path("targets.csv"),
                                measured=os.path.join(folder, "landmarks_intraop.csv")))


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


def test_a_state_keeps_how_the_resection_was_measured():
    """A report from a loaded state has the interval that was asked for, to the digit."""
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"), tumour=path("sub-1_Tumor.nii.gz"),
                           cavity=path("cavity.nii.gz"))
    case.run("Fit")
    found = repr(case.resect(fields=numpy.int64(60), level=0.95, seed=3))
    assert_says(found, "95 % interval", "of 60 fields")
    simple.SaveState(scratch("measured.pvsm"))
    clear()
    simple.LoadState(scratch("measured.pvsm"))
    again, = brainshift.Case.all()
    assert again.resection is None and repr(again.known_resection()) == found
    again.resect(fields=50)
    assert again._left_by == {"fields": 50}


def test_pictures_of_the_resection_follow_the_roles():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           tumour=path("sub-1_Tumor.nii.gz"))
    assert_says(said_by(case.show_resection), "lacks a cavity")
    case.cavity = path("cavity.nii.gz")
    view = simple.CreateView("RenderView")
    case.show(view)
    case.show_resection(view)
    source = case.part("resected")
    assert (source.Input, source.Tumour, source.Cavity) == (case.bent, case.tumour, case.cavity)
    assert [shown.Input for shown in view.Representations if shown.Visibility] == [source]
    assert servermanager.Fetch(source).GetFieldData().HasArray("RemovedVoxels")
    case.show(view)
    assert [shown.Input for shown in view.Representations if shown.Visibility] == [case.bent]
    case.cavity_labels, case.tumour_labels = [1], [1]
    assert list(source.CavityLabels) == [1] and list(source.TumourLabels) == [1]
    case.reference = path("sub-1_postop.nii.gz")
    assert source.Input == case.comparison and source.Cavity is None
    case.reference = None
    assert (source.Input, source.Cavity, case.comparison) == (case.bent, case.cavity, None)
    simple.SaveState(scratch("resected.pvsm"))
    case.cavity = None
    assert source.Cavity is None and case.part("resected") == source
    case.tumour = None
    assert case.part("resected") is None and "sub-1_T1w resection" not in names()
    clear()
    simple.LoadState(scratch("resected.pvsm"))
    again, = brainshift.Case.all()
    again.cavity_labels = []
    assert list(again.part("resected").CavityLabels) == []


def said_by(function):
    """What a function says that refuses."""
    try:
        function()
    except ValueError as error:
        return str(error)
    raise AssertionError("nothing was refused")


def test_results_are_forgotten_when_the_case_changes():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           tumour=path("sub-1_Tumor.nii.gz"), cavity=path("cavity.nii.gz"))

    def found():
        return case.resection is not None, case.judged is not None, bool(case.exported)

    def filled():
        case.resection, case.judged, case.exported = object(), "a line", ["a.nii.gz"]
        assert found() == (True, True, True)
    filled()
    case.bent.UpdatePipeline()
    assert found() == (True, True, True), "nothing changed"
    stroke = brainshift.soft((80, 80, 80), (0, 5, 0), 20)
    for number, change in enumerate((
            lambda: setattr(case.bent, "Strokes", stroke),
            lambda: setattr(case.bent, "Strength", 0.5),
            lambda: setattr(case, "tumour_labels", [1]),
            lambda: setattr(case, "cavity", path("cavity.nii.gz")),
            lambda: setattr(case, "traces", path("pointer.csv")), case.fit)):
        filled()
        change()
        assert found() == (False, False, False), number


def test_results_are_forgotten_when_a_file_of_the_volume_changes():
    folder = scratch("rewritten")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    scan = os.path.join(folder, "scan.dcm")
    shutil.copy(data("pydicom-data", "emri_small_jpeg_ls_lossless.dcm"), scan)
    parts = [os.path.join(folder, f"part_{number}.vti") for number in range(3)]
    for part in parts:
        simple.SaveData(part, proxy=volume(ball(21)))
    for open_volume, changed in (
            (lambda: simple.DICOMVolumeReader(FileName=folder), scan),
            (lambda: simple.DICOMVolumeReader(FileName=scan), parts[0]),  # its folder is read
            (lambda: simple.XMLImageDataReader(FileName=parts), parts[2])):
        clear()
        case = brainshift.Case(volume=open_volume())
        case.judged = "a line"
        simple.SaveState(scratch("rewritten.pvsm"))
        assert case.judged == "a line"
        os.utime(changed, ns=(1, 1))
        casesources._seen.clear()  # as a moment later
        assert case.judged is None, changed
        clear()
        simple.LoadState(scratch("rewritten.pvsm"))
        again, = brainshift.Case.all()
        assert again.judged is None, changed
        again.judged = "another"
        simple.SaveState(scratch("rewritten.pvsm"))
        clear()
        simple.LoadState(scratch("rewritten.pvsm"))
        assert brainshift.Case.all()[0].judged == "another", "nothing was written since"


def test_what_is_above_a_role_counts():
    file = scratch("above.nii.gz")
    shutil.copy(path("sub-1_Tumor.nii.gz"), file)
    clear()
    reader = simple.OpenDataFile(file)  # as File > Open
    moved = simple.Calculator(Input=reader, ResultArrayName="labels", Function="2*scalars")
    twice = simple.Calculator(Input=moved, ResultArrayName="labels 2", Function="2*scalars")
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), tumour=twice)
    assert list(casesources.paths_of(case.tumour)) == [file]
    case.judged = "a line"
    simple.SaveState(scratch("above.pvsm"))
    assert case.judged == "a line"
    moved.Function = "3*scalars"
    assert case.judged is None, "a filter above it"
    os.utime(file, ns=(1, 1))
    casesources._seen.clear()  # as a moment later
    assert_says(case.steps[0].found, "Tumour: its file was written after it was read")
    clear()
    shutil.copy(path("sub-1_Tumor.nii.gz"), file)
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), tumour=simple.Calculator(
        Input=simple.OpenDataFile(file), ResultArrayName="labels", Function="2*scalars"))
    case.judged = "kept"
    simple.SaveState(scratch("above.pvsm"))
    clear()
    simple.LoadState(scratch("above.pvsm"))
    assert brainshift.Case.all()[0].judged == "kept", "a state keeps it"


def test_a_file_that_was_written_after_it_was_read_is_said():
    points, brain = scratch("later.csv"), scratch("later.nii.gz")
    shutil.copy(path("pointer.csv"), points)
    shutil.copy(path("sub-1_brainmask.nii.gz"), brain)
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=brain, traces=points)
    assert not case.doubts() and "file" not in case.steps[0].found, case.doubts()
    table(points, ["x", "y", "z"], cap(90).tolist())
    casesources._seen.clear()  # as a moment later
    assert case.doubtful() == {"Look"}, case.doubts()
    assert_says(case.steps[0].found, "Traces: its file was written after it was read")
    assert "150 of 150" in case.steps[1].found, "those that were read"
    simple.ReloadFiles(case.traces)
    assert not case.doubts(), case.doubts()
    assert "90 of 90" in case.steps[1].found, case.steps[1].found
    os.remove(brain)
    casesources._seen.clear()
    assert_says(case.steps[0].found, "Brain: its file is gone")
    assert "later" not in case.steps[0].found, "reports show no names"


def test_files_are_read_when_their_header_is():
    """A time step of a file that was written since is no new file; a new file beside DICOM is."""
    file, folder = scratch("times.nii.gz"), scratch("slices")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    scan = os.path.join(folder, "scan.dcm")
    shutil.copy(data("pydicom-data", "emri_small_jpeg_ls_lossless.dcm"), scan)
    image = nibabel.Nifti1Image(numpy.zeros((4, 5, 6, 3), numpy.int16), numpy.eye(4))
    image.header.set_zooms((1, 1, 1, 2))
    nibabel.save(image, file)
    times, slices = simple.NIFTIVolumeReader(FileName=file), simple.OpenDataFile(scan)
    for reader in (times, slices):
        reader.UpdatePipeline()
        assert not casesources.doubt_about_files(reader)
    shutil.copy(scan, os.path.join(folder, "another.dcm"))
    casesources._seen.clear()  # as a moment later
    assert not casesources.doubt_about_files(slices)
    for changed, reader in ((file, times), (scan, slices)):
        os.utime(changed, ns=(1, 1))
        casesources._seen.clear()
        assert "was written after" in casesources.doubt_about_files(reader)
    times.UpdatePipeline(4.0)
    assert "was written after" in casesources.doubt_about_files(times), "only a time step was read"
    for reader in (times, slices):
        simple.ReloadFiles(reader)
        reader.UpdatePipeline()
        assert not casesources.doubt_about_files(reader)


def test_names_come_back_to_their_sources():
    clear()
    files = []
    for folder in ("before", "after"):
        os.makedirs(scratch(folder), exist_ok=True)
        files.append(os.path.join(scratch(folder), "T1.nii.gz"))
        shutil.copy(path("sub-1_T1w.nii.gz"), files[-1])
    case = brainshift.Case(volume=files[0], reference=files[1], traces=path("pointer.csv"))
    wanted = ["T1", "T1 2", "traced points"]
    for names_of_dialog in (("b T1.nii.gz", "a T1.nii.gz"), ("a T1.nii.gz", "b T1.nii.gz")):
        for role, name in zip(("volume", "reference"), names_of_dialog):  # as ParaView's dialog
            simple.RenameSource(name, case.part(role))
        simple.RenameSource("pointer.csv", case.traces)
        dock.answer(json.dumps({"order": "tell"}))
        assert [dock._name(case.part(role)) for role in ("volume", "reference", "traces")] == wanted


def test_files_that_count_are_those_that_are_read():
    folder = scratch("written")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(os.path.join(folder, "below"))
    files = [os.path.join(folder, name) for name in ("a.dcm", "below/b.dcm", "c.nhdr", "c.raw")]
    for file in files:
        with open(file, "wb") as kept:
            kept.write(b"NRRD0004\ndata file: c.raw\n" if file == files[2] else b"x")

    def count(path):
        return len(casesources._written(path, False))
    assert count(folder) == 4 and count(files[0]) == 1, "of a folder those below it, too"
    assert count(files[2]) == 2 and count(folder + "/none") == 0, "data beside a header"


def test_columns_of_landmarks_are_taken_by_their_names():
    clear()
    rest, measured = [[1.0, 2.0, 3.0]], [[4.0, 5.0, 6.0]]
    for header, is_turned in (
            ("x_measured y_measured z_measured x_rest y_rest z_rest", True),
            ("post_x post_y post_z pre_x pre_y pre_z", True),
            ("x2 y2 z2 x1 y1 z1", True), ("r a s x_rest y_rest z_rest", True),
            ("r a s x_meas y_meas z_meas", False), ("x y z us_x us_y us_z", False),
            ("source_x source_y source_z target_x target_y target_z", False),
            ("moving_x moving_y moving_z fixed_x fixed_y fixed_z", True)):
        first, second = (measured, rest) if is_turned else (rest, measured)
        table(path("pairs.csv"), header.split(), [first[0] + second[0]])
        with messages() as said:
            case = brainshift.Case(landmarks=path("pairs.csv"))
        is_unknown = any(word in header for word in ("x2", "us_x", "source"))  # to the reader
        assert ("it is not known" in said.text) == is_unknown, (header, said.text)
        places = [read_from(source).positions.tolist() for source in case.landmarks]
        assert places == [rest, measured], (header, places)
        simple.ResetSession()
        load_plugin()
    for header in ("r a s x y z", "x y z r a s", "x_pre y_pre z_pre x_rest y_rest z_rest",
                   "x_a y_a z_a x_b y_b z_b", "x y z mni_x mni_y mni_z",
                   "ct_x ct_y ct_z mri_x mri_y mri_z"):
        table(path("pairs.csv"), header.split(), [rest[0] + measured[0]])
        refused(ValueError, ["pairs.csv", "at rest", "x_measured", "leave one set out"],
                lambda: brainshift.Case(landmarks=path("pairs.csv")))
        for name, role in (("pairs", None), ("contacts", "electrodes"), ("traces", "traces")):
            shutil.copy(path("pairs.csv"), scratch(f"{name}.csv"))
            proposal, = proposed([scratch(f"{name}.csv")])
            assert proposal.role == role, (header, proposal)
            assert role or "leave one set out" in proposal.reason, proposal
    os.remove(path("pairs.csv"))
    shutil.copy(path("targets.csv"), scratch("contacts.csv"))
    assert proposed([scratch("contacts.csv")])[0].role == "landmarks", "its columns say which"


def test_two_cases_may_share_sources():
    clear()
    first = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"))
    first.bent.Strength = 0.5
    second = brainshift.Case(volume=first.volume, brain=first.brain)
    assert first.bent is not None and first.bent != second.bent
    second.volume = None
    first.mask_growth = 2.0
    assert first.bent.Strength == 0.5 and first.bent.MaskGrowth == 2.0
    again = brainshift.Case.of(first.bent)
    again.mask_growth = 3.0
    first.holds_outside = False
    assert first.mask_growth == again.mask_growth == 3.0 == first.bent.MaskGrowth
    simple.SaveState(scratch("beside.pvsm"))
    simple.LoadState(scratch("beside.pvsm"))
    refused(ValueError, ["twice"], lambda: first.bent)


def test_a_case_takes_the_image_that_is_drawn_instead_of_its_volume():
    """Or its next order would set the volume again."""
    clear()
    source = volume(ball())
    case = brainshift.Case(volume=source)
    store = scratch("ball.ome.zarr")
    shutil.rmtree(store, ignore_errors=True)
    with messages():  # unknown sides
        reader = brainshift.draw_from_pyramid(case.bent, store)
    case.reference = source
    assert case.volume == reader and case.bent.Input == reader
    assert case.reference == source and not casesources.marks(source)[1:]


def test_an_export_keeps_the_axes_of_the_volume():
    clear()
    case = brainshift.Case(volume=volume(ball(9, 3.0)))
    told = []
    with mock.patch("brainshift.views.world_axes", lambda _: "LPS"), mock.patch(
            "brainshift.files.save_field", lambda *_, **named: told.append(named)):
        case.export(scratch("lps"))
    assert told == [{"world": "LPS"}], told


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
    refused(ValueError, ["brain_labels", "one label"],
            lambda: setattr(case, "brain_labels", [1, 2]))
    assert case.brain_labels == []
    refused(ValueError, ["belongs to no case"],
            lambda: brainshift.Case.of(simple.Sphere()))
    refused(ValueError, ["tumour must be a volume", "pointer"],
            lambda: setattr(case, "tumour", path("pointer.csv")))
    refused(ValueError, ["traces must be points", "cavity"],
            lambda: setattr(case, "traces", path("cavity.nii.gz")))
    assert "pointer" not in names() and "cavity" not in names(), names()


def test_a_role_is_not_made_of_what_it_makes():
    """A loop in the pipeline would end ParaView."""
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                           traces=path("pointer.csv"), electrodes=path("ecog_contacts.tsv"))
    case.fit()
    assert {name for name in figures_of_case(case) if "RMS" in name} == {
        "traced points RMS (mm)", "contacts RMS (mm)"}
    baked = simple.BakeDeformation(Input=case.bent)
    for role, source in (("volume", baked), ("brain", baked), ("cavity", baked),
                         ("traces", case.part("joined"))):
        refused(ValueError, [f"{role} must not be made of"],
                lambda: setattr(case, role, source))  # noqa: B023
    case.reference = baked  # which nothing of the deformation depends on
    assert case.comparison.Reference == baked


def test_a_bent_volume_that_was_deleted_comes_back_with_its_volume():
    clear()
    case = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), reference=path("sub-1_postop.nii.gz"))
    simple.Delete(case.comparison)
    simple.Delete(case.bent)
    for step in case.steps:
        assert step.state == "lacks" and "choose the volume again" in step.lacks, step
    case.volume = case.volume
    assert case.bent is not None and case.comparison is not None
    assert case.steps[0].state == "done"


run_tests(globals())
