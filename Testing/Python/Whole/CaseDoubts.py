# SPDX-License-Identifier: BSD-3-Clause
# Proves that a case does not claim more than it knows: landmarks that a fit used before a
# refinement judge nothing, a refinement is of the reference that it was made with, contacts have
# the error of their sheet, and a doubt is said also where a step lacks something.
import os
import shutil

import numpy
from brainshift_testing import assert_says, load_plugin, run_tests, scratch, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import reporting, scenes  # noqa: E402
from brainshift.worker import figures_of_case  # noqa: E402
from paraview import simple  # noqa: E402
from patient_testing import MIDDLE, RADIUS, TOP, make_patient, sunk, table  # noqa: E402

FOLDER = scratch("doubts")
STROKE_SWITCH = 13  # the last of its 14 numbers
make_patient(FOLDER)


def path(name):
    return os.path.join(FOLDER, name)


def begun(**roles):
    """A new session with a case of these files, beside volume and brain."""
    simple.ResetSession()
    load_plugin()
    files = {"volume": "sub-1_T1w.nii.gz", "brain": "sub-1_brainmask.nii.gz", **roles}
    return brainshift.Case(**{role: path(file) for role, file in files.items()})


def found(case, name):
    return next(step for step in case.steps if step.name == name)


def refined(case):
    case.refine(callback=lambda _: False)
    assert case.fit_source() is None
    return case


def write_pairs(name, rest, measured):
    """Writes a table of landmarks with both positions."""
    columns = [f"{axis}_{when}" for when in ("rest", "measured") for axis in "xyz"]
    table(path(name), ["name", *columns],
          [[f"N{i}", *pair] for i, pair in enumerate(numpy.column_stack((rest, measured)))])


def grid(name, prefix, count=(4, 5), extra=None):
    """Writes a table of contacts of a grid on the cortex under the opening."""
    extra = extra or {}
    rows, columns = count
    steps = 10.0 * numpy.mgrid[:rows, :columns].reshape(2, -1).T
    steps -= steps.mean(axis=0) - 0.1
    angles = numpy.linalg.norm(steps, axis=1) / RADIUS
    flat = steps / numpy.linalg.norm(steps, axis=1)[:, None]
    rest = MIDDLE + RADIUS * numpy.column_stack(
        (flat * numpy.sin(angles)[:, None], numpy.cos(angles)))
    with open(path(name), "w", encoding="utf-8") as file:
        file.write("\t".join(["name", "x", "y", "z", *extra]) + "\n")
        for i, at in enumerate(sunk(rest).tolist()):
            file.write("\t".join([f"{prefix}{i + 1}", *map(str, at), *extra.values()]) + "\n")


def test_landmarks_that_a_fit_used_judge_no_refinement():
    case = begun(traces="pointer.csv", landmarks="targets.csv", reference="sub-1_postop.nii.gz")
    shutil.copy(path("targets.csv"), path("others.csv"))
    case.run("Fit")
    refined(case)
    said = "A fit before the refinement used the landmarks"
    assert_says(found(case, "Judge").found, said)
    assert_says(case.run("Judge").found, said, "no accuracy", "of 8 landmarks")
    assert "Judge" in case.doubtful()
    assert case.run("Judge").found.count(said) == 1
    assert not any("landmarks" in name for name in figures_of_case(case))
    rows = {row[0]: row[-1] for row in reporting._distances(case)}
    assert_says(rows["Landmarks, in the mean"], "no accuracy follows")
    assert "Landmarks" not in reporting._tiles(case, None, reporting._distances(case))
    simple.SaveState(scratch("refined.pvsm"))
    simple.ResetSession()
    load_plugin()
    simple.LoadState(scratch("refined.pvsm"))
    case, = brainshift.Case.all()
    assert case.landmarks_fitted_before(), "a state keeps it"
    case.landmarks = path("targets.csv")
    assert case.landmarks_fitted_before(), "the same file opened again"
    refined(case)
    assert case.landmarks_fitted_before(), "a second refinement"
    assert "leave-one-out" not in case.run("Fit").found, "its base was fitted to them"
    assert not any("landmarks" in name for name in figures_of_case(case))
    case.landmarks = path("others.csv")
    assert not case.landmarks_fitted_before()
    assert_says(found(case, "Fit").found, "leave-one-out")
    assert "landmarks left out, mean (mm)" in figures_of_case(case)


def test_landmarks_that_no_fit_used_judge_a_refinement():
    case = begun(traces="pointer.csv", reference="sub-1_postop.nii.gz")
    case.landmarks_judge = True
    case.landmarks = path("targets.csv")
    case.run("Fit")
    refined(case)
    assert_says(case.run("Judge").found, "of 8 landmarks", "mm on average")
    # A refinement that is stopped at once may well be worse than none, which is another doubt.
    assert not any("used the landmarks" in text for _, text in case.doubts()), case.doubts()
    assert "landmarks mean (mm)" in figures_of_case(case)


def test_a_refinement_is_of_its_reference():
    case = refined(begun(reference="sub-1_postop.nii.gz"))
    shutil.copy(path("sub-1_postop.nii.gz"), path("second.nii.gz"))
    good = found(case, "Refine").found
    assert_says(good, "cost", "before")

    def said(words):
        step = found(case, "Refine")
        assert_says(step.found, f"made with {words}", "Refine again")
        assert "cost" not in step.found and "Refine" in case.doubtful(), step
        return step.state
    case.comparison.ReferenceTranslation = [2.0, 0.0, 0.0]
    assert said("another position of the reference") == "done"
    case.comparison.ReferenceTranslation = [0.0, 0.0, 0.0]
    assert found(case, "Refine").found == good
    case.cavity = path("cavity.nii.gz")
    said("another cavity")
    case.cavity = None
    case.reference = path("sub-1_postop.nii.gz")
    assert found(case, "Refine").found == good, "the same file"
    simple.SaveState(scratch("reference.pvsm"))
    simple.ResetSession()
    load_plugin()
    simple.LoadState(scratch("reference.pvsm"))
    case, = brainshift.Case.all()
    assert found(case, "Refine").found == good, "a state keeps it"
    case.reference = path("second.nii.gz")
    said("another reference")
    case.reference = None
    assert said("a reference that was taken away") == "lacks"


def test_other_electrodes_have_shapes_of_their_own():
    grid("a_electrodes.tsv", "A", extra={"group": "A", "type": "grid", "dimension": "[4x5]"})
    grid("b_electrodes.tsv", "B")
    case = begun(electrodes="a_electrodes.tsv")
    case.run("Fit")
    grids = case.part("at_rest")
    assert list(grids.Shapes) == ["A=grid 4x5"] and list(grids.ContactGroups) == ["A"] * 20
    grids.Shapes = ["A=4x5 10mm"]
    case.holds_outside = False
    assert list(grids.Shapes) == ["A=4x5 10mm"], "a user's own stay"
    case.electrodes = path("b_electrodes.tsv")
    assert case.part("at_rest") == grids
    assert list(grids.Shapes) == [] and list(grids.ContactGroups) == []
    assert_says(found(case, "Fit").found, "20 contacts of grids")


def test_contacts_have_the_error_of_their_sheet():
    grid("b_electrodes.tsv", "B")
    case = begun(electrodes="b_electrodes.tsv")
    assert_says(found(case, "Measure").found, "20 of 20 contacts of grids and shafts alike count")
    assert_says(reporting._distances(case)[0][0], "Contacts of grids and shafts alike")
    case.run("Fit")
    assert_says(found(case, "Measure").found, "20 of 20 contacts count")
    sheet = brainshift.electrodes(path("b_electrodes.tsv"), case.brain).leave_one_out.mean()
    assert_says(found(case, "Fit").found, f"leave-one-out error of the sheet {sheet:.2f} mm")
    rows, _ = reporting._fit_rows(case)
    errors = [row for row in rows if "eave-one-out error" in row[0]]
    assert [row[0] for row in errors] == ["Leave-one-out error of the sheet, mean"], errors
    assert abs(errors[0][1] - sheet) < 0.01, (errors, sheet)


def test_doubts_of_grids_and_cavity_stay_beside_landmarks():
    grid("b_electrodes.tsv", "B", count=(4, 4))
    with open(path("b_electrodes.tsv"), encoding="utf-8") as file:
        lines = file.read().splitlines()
    name, x, y, z = lines[6].split("\t")
    lines[6] = "\t".join([name, x, y, str(float(z) + 6.0)])  # it floats
    with open(path("b_electrodes.tsv"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    case = begun(electrodes="b_electrodes.tsv", traces="pointer.csv", cavity="cavity.nii.gz",
                 reference="sub-1_postop.nii.gz")
    case.run("Fit")
    case.comparison.ReferenceTranslation = [2.0, 0.0, 0.0]
    for landmarks in (None, path("targets.csv")):
        case.landmarks = landmarks
        assert case.fits_landmarks() == bool(landmarks)
        assert_says(found(case, "Fit").found, name, "above", "The reference was moved")


def test_no_figure_of_a_measurement_that_failed():
    """Otherwise the step, the report and the batch name the distance of another cortex."""
    case = begun(traces="pointer.csv")
    good = found(case, "Measure")
    assert good.state == "done", good
    assert_says(good.found, "count")
    assert any(name.startswith("Traced points") for name, *_ in reporting._distances(case))
    case.brain_labels = [77]
    step = found(case, "Measure")
    assert step.state == "ready" and "(RMS)" not in step.found, step
    assert_says(step.found, "Traced points are not measured: Label is 77 and gives no surface")
    assert case.doubtful() == {"Measure"}
    assert reporting._distances(case) == []
    assert any("Label is 77" in text for text in reporting._warnings(case))
    assert not any("RMS" in name for name in figures_of_case(case))
    assert scenes.traces(case, (100, 100)) is None
    case.brain_labels = []
    assert found(case, "Measure") == good, (found(case, "Measure"), good)
    away = volume(numpy.ones((3, 3, 3), numpy.uint8), origin=(900.0, 900.0, 900.0))
    brainshift.save_volume(away, path("elsewhere.mha"), world="RAS")
    case.cavity = path("elsewhere.mha")
    assert found(case, "Measure").state == "ready"
    assert_says(found(case, "Measure").found, "not measured")
    case.cavity = None
    assert found(case, "Measure") == good, (found(case, "Measure"), good)


def test_strokes_that_are_off_are_no_edits():
    case = begun()
    one = list(brainshift.soft(TOP, (0, 0, -5), 30))
    off = list(one)
    off[STROKE_SWITCH] = 0.0
    case.bent.Strokes = one + off
    assert_says(found(case, "By hand").found, "1 strokes, and 1 that are switched off")
    rows = {row[0]: row[1] for row in reporting._deformation_rows(case)}
    assert rows["Strokes by hand"] == 1 and rows["Strokes that are switched off"] == 1
    case.bent.Strokes = off
    assert found(case, "By hand").found == "no stroke counts, 1 are switched off"
    case.bent.Strokes = []
    assert found(case, "By hand").state == "ready"


def test_a_fit_without_its_brain_is_doubted():
    case = begun(traces="pointer.csv")
    case.run("Fit")
    assert "Fit" not in case.doubtful()
    case.brain = None
    step = found(case, "Fit")
    assert step.state == "lacks", step
    assert_says(step.found, "The cortex of the fit was taken away")
    assert_says(repr(case), "Fit: lacks, a brain", "taken away")
    assert "Fit" in case.doubtful()
    assert any("taken away" in text for text in reporting._warnings(case))
    case.brain = path("sub-1_brainmask.nii.gz")
    assert "Fit" not in case.doubtful(), case.doubts()


def test_landmarks_that_are_no_nearer_are_a_doubt():
    """Neighbours that moved in opposite directions: each predicts the other wrongly. And a stroke
    away from where landmarks were measured is worse than none."""
    random = numpy.random.default_rng(3)
    rest = numpy.repeat(MIDDLE + random.uniform(-25, 25, (6, 3)), 2, axis=0)
    rest[1::2, 0] += 4.0
    for name, shifts in (("apart.csv", [(0.0, 0.0, 3.0), (0.0, 0.0, -3.0)] * 6),
                         ("together.csv", [(0.0, 0.0, -3.0)] * 12)):
        write_pairs(name, rest, rest + shifts)
    case = begun(landmarks="apart.csv")
    assert case.doubts() == []
    case.run("Fit")
    assert_says(found(case, "Fit").found, "no nearer than without the fit")
    assert case.doubtful() == {"Fit"}
    case = begun(landmarks="together.csv")
    case.run("Fit")
    assert all("a rigid motion" in doubt for _, doubt in case.doubts()), case.doubts()
    case = begun()
    case.landmarks_judge = True
    case.landmarks = path("targets.csv")
    case.bent.Strokes = brainshift.soft([MIDDLE] * 3, (0, 0, 8), 60)  # they sank
    assert_says(case.run("Judge").found, "farther off than without the deformation")
    assert case.doubtful() == {"Judge"}
    case.bent.Strokes = []
    assert case.doubtful() == set(), case.doubts()


def test_a_rigid_motion_is_not_in_the_pictures():
    """A fit to landmarks alone keeps it apart, which the doubts and the report say."""
    rest = numpy.random.default_rng(4).uniform(40, 120, (12, 3))
    write_pairs("moved.csv", rest, rest + (0.0, 5.0, 3.0))
    write_pairs("sunk.csv", rest, sunk(rest))
    case = begun(landmarks="moved.csv")
    assert_says(case.run("Fit").found, "a rigid motion: 5.8 mm at the middle", "0.0 degrees",
                "exported files lack it")
    assert "Fit" in case.doubtful() and case.landmark_errors().mean < 0.1
    rows = {row[0]: row[-1] for row in reporting._distances(case)}
    assert_says(rows["Landmarks, in the mean"], "rigid motion", "lack")
    case = begun(landmarks="sunk.csv", traces="pointer.csv")
    assert "rigid motion" not in case.run("Fit").found


def test_landmarks_do_not_follow_a_reference():
    case = begun(landmarks="targets.csv", reference="sub-1_postop.nii.gz")
    said = "the measured landmarks were not"
    assert said not in found(case, "Judge").found
    case.comparison.ReferenceTranslation = (0.0, 0.0, 4.0)
    assert_says(found(case, "Judge").found, said, "matrix of the alignment")


def test_what_is_above_the_lattice_counts():
    case = begun(landmarks="targets.csv")
    field = simple.DeformationField(Input=simple.FreeFormDeformation(Input=case.volume),
                                    Direction="Forward")
    case.bent.Lattice = simple.InvertDisplacementField(Input=field)
    case.run("Judge")
    assert case.judged is not None
    field.Input.Strokes = brainshift.soft(TOP, (0, 0, -5), 30.0)
    assert case.judged is None, "it was found with another deformation"


def test_the_first_tile_has_figures_of_now():
    case = begun()
    case.bent.UpdatePipeline()
    case.bent.Strokes = brainshift.soft(TOP, (0, 0, -5), 30)
    assert "<b>0.0 mm</b>" not in reporting._tiles(case, None, [])


run_tests(globals())
