# SPDX-License-Identifier: BSD-3-Clause
# Proves that the moments of a surgery share what is known before it, have measurements and a fit of
# their own, are time steps that play, and come back with a state.
import json
import os
import shutil

import numpy
from brainshift_testing import assert_says, field, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
from brainshift import dock  # noqa: E402
from brainshift.casesources import paths_of  # noqa: E402
from brainshift.points import read_from  # noqa: E402
from patient_testing import TOP, cap, make_patient, refused, table  # noqa: E402

FOLDER = scratch("moments")


def path(name):
    return os.path.join(FOLDER, name)


def begun():
    """A fitted case, and another moment of its surgery."""
    simple.ResetSession()
    load_plugin()
    first = brainshift.Case(volume=path("sub-1_T1w.nii.gz"), brain=path("sub-1_brainmask.nii.gz"),
                            tumour=path("sub-1_Tumor.nii.gz"), traces=path("pointer.csv"),
                            landmarks=path("targets.csv"), opening=(TOP, 27.0))
    first.holds_outside = False
    first.bent.LatticeDimensions = [13, 13, 13]
    first.run("Fit")
    return first, first.begin_moment("after resection", 95)


def names():
    return sorted(name for name, _ in simple.GetSources())


def bend(source, time=None):
    source.UpdatePipeline() if time is None else source.UpdatePipeline(time)
    return field(source, "FFDDisplacements") * float(field(source, "FFDStrength")[0])


def test_a_moment_shares_what_is_known_before_surgery():
    make_patient(FOLDER)
    first, second = begun()
    for role in ("volume", "brain", "tumour", "opening"):
        assert getattr(second, role) == getattr(first, role), role
    assert second.landmarks == (first.landmarks[0], None)
    assert second.traces is None and second.bent.Lattice is None
    assert second.holds_outside is False and second.bent.Mask is None
    assert list(second.bent.LatticeDimensions) == [13, 13, 13]
    assert {"sub-1_T1w bent", "sub-1_T1w bent, after resection",
            "sub-1_T1w moments"} <= set(names())
    assert (second.moment, second.minutes) == ("after resection", 95.0)
    assert first.moments == [first, second] == second.moments
    assert_says(repr(second), "after resection at 95 min")
    third = second.begin_moment("closing")
    assert third.minutes == 125.0 and first.moments == [first, second, third]


def test_moments_have_fits_of_their_own_and_are_time_steps():
    first, second = begun()
    table(path("second.csv"), "xyz", cap(100).tolist())
    second.traces = path("second.csv")
    second.run("Fit")
    assert second.bent.Lattice != first.bent.Lattice
    group = first.part("moments")
    early, late = bend(first.bent), bend(second.bent)
    assert numpy.abs(early - late).max() > 1.0, "the fits differ"
    assert numpy.array_equal(bend(group, 0.0), early)
    assert numpy.array_equal(bend(group, 95.0), late)
    assert numpy.allclose(bend(group, 47.5), 0.5 * (early + late), atol=1e-4)
    second.bent.Strokes = brainshift.soft(TOP, (0, 0, -3), 25)
    assert numpy.allclose(bend(group, 47.5), 0.5 * (early + bend(second.bent)), atol=1e-4)


def test_time_is_that_of_the_moment():
    first, second = begun()
    refused(["95", "after resection", "its own time"], lambda: setattr(first, "minutes", 95))
    refused(["finite"], lambda: setattr(first, "minutes", float("nan")))
    refused(["95", "no other moment"], lambda: first.begin_moment("again", 95))
    second.minutes = -10
    assert first.moments == [second, first]
    group = first.part("moments")
    assert list(group.Times) == [-10.0, 0.0]
    assert list(group.Input) == [second.bent, first.bent]
    view = simple.CreateView("RenderView")
    shown = first.show_moments(view)
    assert shown.Representation == "Deformed Volume" and shown.Visibility == 1
    assert view.ViewTime == 0.0
    simple.GetAnimationScene().GoToFirst()
    assert view.ViewTime == -10.0
    first.show(view)
    assert simple.GetRepresentation(group, view).Visibility == 0, "one moment is shown at a time"


def test_the_brain_is_that_of_all_moments():
    first, second = begun()
    first.holds_outside = second.holds_outside = True
    first.brain = path("cavity.nii.gz")
    assert second.brain == first.brain == second.bent.Mask
    assert "sub-1_brainmask" not in names(), "nothing uses it any more"
    second.brain = None
    assert first.brain is None and first.bent.Segmentation is None


def test_settings_of_shared_roles_are_those_of_all_moments():
    first, second = begun()
    first.brain_labels, second.tumour_labels = [1], [1]
    assert second.brain_labels == [1] and first.tumour_labels == [1]
    second.holds_outside = True
    assert first.holds_outside is True and first.bent.Mask == first.brain
    baked = simple.BakeDeformation(Input=second.bent)
    refused(["brain must not be made of"], lambda: setattr(first, "brain", baked))
    group = first.part("moments")
    refused(["traces must be points"], lambda: setattr(first, "traces", group))
    assert group.Input[0] == first.bent, "no loop"


def test_files_of_moments_are_told_apart():
    first, second = begun()
    folder = scratch("moments_out")
    for case in (first, second):
        case.run("Export", folder=folder)
    assert {"sub-1_T1w_0min_bent.nii.gz", "sub-1_T1w_after-resection_bent.nii.gz"} <= set(
        os.listdir(folder)), os.listdir(folder)
    third = first.begin_moment("after_resection", 120)
    assert second.moment_ending() == "_after-resection_95min"
    assert third.moment_ending() == "_after-resection_120min", "both are files"
    refused(["'after resection'", "its own name"], lambda: setattr(third, "moment",
                                                                  "after resection"))
    refused(["its own name"], lambda: first.begin_moment("after resection", 150))
    third.moment = "moment 4"
    dock._in_hand.update(case=first, former=None)
    dock._begin_moment(first)
    assert [case.moment for case in first.moments][1:] == [
        "after resection", "moment 4", "moment 5"], "a name that is free"


def test_files_of_another_case_stay():
    begun()
    folder = scratch("beside_out")
    shutil.rmtree(folder, ignore_errors=True)
    cases = [brainshift.Case(volume=path("sub-1_T1w.nii.gz")) for _ in range(2)]
    for case in (*cases, cases[0]):  # its own files are written again
        case.run("Export", folder=folder)
    assert sorted(os.listdir(folder)) == [
        f"sub-1_T1w{number}_{what}.nii.gz" for number in ("_2", "") for what in ("bent", "field")]


def test_a_moment_leaves_with_its_volume():
    first, second = begun()
    second.volume = path("sub-1_postop.nii.gz")
    assert first.moments == [first] and first.part("moments") is None
    assert "sub-1_T1w moments" not in names()
    third = first.begin_moment("closing", 120)
    third.volume = None
    assert first.part("moments") is None and first.bent is not None
    refused(["one moment only"], first.show_moments)
    refused(["lacks a volume"], lambda: brainshift.Case().begin_moment("none"))


def test_a_state_keeps_the_moments():
    first, second = begun()
    second.bent.Strokes = brainshift.soft(TOP, (0, 0, -3), 25)
    half = bend(first.part("moments"), 47.5)
    simple.SaveState(scratch("moments.pvsm"))
    simple.ResetSession()
    load_plugin()
    simple.LoadState(scratch("moments.pvsm"))
    again = brainshift.Case.all()[0].moments
    assert [(case.moment, case.minutes) for case in again] == [("", 0.0), ("after resection", 95.0)]
    assert numpy.array_equal(bend(again[0].part("moments"), 47.5), half)


def stamped(name, stamps, points):
    """A table of traced points with time stamps in ms."""
    rows = [[*point, stamp] for point, stamp in zip(points.tolist(), stamps)]
    table(path(name), ["x", "y", "z", "time_ms"], rows)
    return path(name)


def positions(source):
    return set(map(tuple, numpy.round(read_from(source).positions, 6).tolist()))


def test_traces_of_all_moments_are_told_apart_by_time_stamps():
    first, second = begun()
    points, minute = cap(200), 60000.0
    zero = 1.7e12  # ms since 1970
    stamps = zero + minute * numpy.linspace(-1.0, 180.0, 200)
    stamps[90] = zero + 95 * minute  # the moment itself
    first.traces = stamped("all.csv", stamps, points)
    first.traces_by_time = "ms"
    assert second.traces == first.traces and second.traces_by_time == "ms"
    assert first.traced is None
    first.landmarks_judge = True
    steps = {step.name: step for step in first.steps}
    for text in (steps["Fit"].lacks, steps["Measure"].found):
        assert_says(text, "traced points of this moment", "from 0 ms", "1.69999994e+12",
                    "trace_start")
    second.trace_start = zero
    early, late = stamps < zero + 95 * minute, stamps >= zero + 95 * minute
    early &= stamps >= zero
    wanted = [set(map(tuple, numpy.round(points[mask], 6).tolist())) for mask in (early, late)]
    assert [positions(first.traced), positions(second.traced)] == wanted
    assert late[90] and not early[90], "a point of the very moment is of the moment"
    second.run("Fit")
    assert second.fit_source().Traces == second.traced
    measured = dict((step.name, step.found) for step in first.steps)["Measure"]
    before = int((stamps < zero).sum())
    assert before == 2
    assert_says(measured, f"of {early.sum()} traced points", "2 traced points belong to no moment")

    second.minutes = 30
    assert positions(first.traced) == set(map(tuple, numpy.round(
        points[(stamps >= zero) & (stamps < zero + 30 * minute)], 6).tolist()))
    third = second.begin_moment("closing", 120)
    assert third.traces == first.traces
    assert positions(third.traced) == set(map(tuple, numpy.round(
        points[stamps >= zero + 120 * minute], 6).tolist()))
    second.volume = None
    assert positions(first.traced) == set(map(tuple, numpy.round(
        points[(stamps >= zero) & (stamps < zero + 120 * minute)], 6).tolist())), "it has them now"
    kept = [positions(case.traced) for case in first.moments]
    simple.SaveState(scratch("timed.pvsm"))
    simple.ResetSession()
    load_plugin()
    simple.LoadState(scratch("timed.pvsm"))
    again = brainshift.Case.all()[0].moments
    again[0].holds_outside = True  # the pipeline is wired anew before anything is updated
    assert [positions(case.traced) for case in again] == kept
    whole = again[0].traces
    again[1].traces_by_time = ""
    again = again[0].moments
    assert [positions(case.traces) for case in again] == kept, "each keeps its points"
    assert not any(case.part(part) for case in again for part in ("timed", "cloud"))
    assert [case.traces_by_time for case in again] == ["", ""]
    again[1].traces_by_time = "ms"
    assert [case.traces for case in again] == [whole, whole], "and has them of one source again"
    assert [positions(case.traced) for case in again] == kept


def test_points_that_a_moment_kept_go_with_their_role():
    first, second = begun()
    first.traces = stamped("both.csv", numpy.linspace(0.0, 180.0, 40) * 60000.0, cap(40))
    first.traces_by_time = "ms"
    second.run("Fit")
    shown = bend(second.bent)
    first.traces_by_time = ""
    assert numpy.array_equal(bend(second.bent), shown) and second.fit_source().Traces == (
        second.traces), "the fit is as it was"
    assert [os.path.basename(path) for path in paths_of(second.traces)] == ["both.csv"]
    before = names()
    second.traces = path("pointer.csv")
    assert len(names()) == len(before) - 1, (before, names(), "threshold and cloud went")
    first.traces = None
    assert len(names()) == len(before) - 5, (names(), "with the file, and the trace distance")


def test_a_wrong_start_leaves_the_displays():
    first, second = begun()
    first.traces = stamped("start.csv", numpy.linspace(0.0, 180.0, 40) * 60000.0, cap(40))
    first.traces_by_time = "ms"
    view = simple.CreateView("RenderView")
    measure = first.part("trace_distance")
    assert measure is not None and first.trace_distance == measure
    display = simple.Show(measure, view)
    first.trace_start = 1e12
    assert first.trace_distance is None and first.traced is None
    assert_says(first.steps[1].lacks + first.steps[1].found, "traced points of this moment")
    assert first.part("trace_distance") == measure and display.Visibility == 1
    assert first.fit_source().Traces is None
    first.trace_start = 0.0
    assert first.trace_distance == measure and first.fit_source().Traces == first.traced
    assert display in list(view.Representations) and display.Visibility == 1
    first.traces = None
    assert first.part("trace_distance") is None, "without traces it goes"


def test_traces_without_time_stamps_are_refused_as_those_of_all_moments():
    first, second = begun()
    refused(["no time stamps", "Time"], lambda: setattr(first, "traces_by_time", "s"))
    refused(["'h'", "s, ms, min"], lambda: setattr(first, "traces_by_time", "h"))
    refused(["finite"], lambda: setattr(first, "trace_start", float("inf")))
    second.traces = stamped("late.csv", numpy.arange(50.0), cap(50))
    refused(["traces of its own", "late"], lambda: setattr(second, "traces_by_time", "ms"))
    first.traces = None
    first.traces_by_time = "ms"  # also from a moment that has none
    assert first.traces == second.traces
    refused(["no time stamps"], lambda: setattr(second, "traces", path("pointer.csv")))
    assert second.traces is not None and second.traces == first.traces
    timed = first.part("timed")
    refused(["traces must not be made of"], lambda: setattr(second, "traces", timed))


def test_the_dock_takes_up_the_moment_that_is_seen():
    first, second = begun()
    view = simple.GetActiveViewOrCreate("RenderView")
    for show, at, wanted in ((second.show_moments, 95.0, second), (first.show_moments, 0.0, first),
                             (second.show_moments, 40.0, first), (second.show, 0.0, second)):
        show(view)
        view.ViewTime = at
        if show == second.show:
            simple.Hide(first.part("moments"), view)
        dock._in_hand.update(case=None, former=None)
        told = json.loads(dock.answer(json.dumps({"order": "tell"})))
        assert told["told"]["case"] == wanted.name, (at, view.ViewTime, told["problem"])


def test_points_in_one_cell_are_told_apart_as_well():
    first, second = begun()
    stamps = numpy.linspace(0.0, 180.0, 40)
    rows = simple.Calculator(Input=simple.TableToPoints(
        Input=simple.CSVReader(FileName=[stamped("cells.csv", stamps, cap(40))]), XColumn="x",
        YColumn="y", ZColumn="z"), ResultArrayName="Time", Function="time_ms")
    first.traces = rows
    first.traces_by_time = "min"
    counts = [case.traced.GetDataInformation().GetNumberOfPoints() for case in (first, second)]
    assert counts == [int((stamps < 95).sum()), int((stamps >= 95).sum())], counts


run_tests(globals())
