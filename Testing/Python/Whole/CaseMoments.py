# SPDX-License-Identifier: BSD-3-Clause
# Proves that the moments of a surgery share what is known before it, have measurements and a fit of
# their own, are time steps that play, and come back with a state.
import os

import numpy
from brainshift_testing import assert_says, field, load_plugin, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
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


run_tests(globals())
