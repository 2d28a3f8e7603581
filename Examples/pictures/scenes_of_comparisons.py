# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the documentation that show a brain beside a reference and a trace: the patient of
case_study.py, before and after the stamps."""

import numpy
from paraview import simple

import case_study
import stage

HALF_MM = 55.0
FOCUS = (8.0, 0.0, -18.0)  # mm from the cavity
WAYS = ("Two colours", "Checkerboard", "Difference", "Gradient")


def patient(stamped=False):
    """The case, without strokes or with the ten stamps that the trace asks for."""
    case = stage.once("case", case_study.Case)
    case.bent.Strokes = stage.once("stamps", lambda: _stamps(case)) if stamped else ()
    case.compare.Show = "Both"
    return case


def _stamps(case):
    case.bent.Strokes = ()
    case_study.stamp_to_trace(case.bent, case.measure)
    return tuple(case.bent.Strokes)


def _coronal(compare, side):
    made = case_study.show_red_green(compare, "Coronal", (0, 1, 0), side)
    simple.Render(made)  # the first picture of a view finds a camera of its own
    focus = case_study.CAVITY_CENTRE + FOCUS
    made.CameraFocalPoint, made.CameraPosition = focus, focus + (0.0, 400.0, 0.0)
    made.CameraParallelScale = HALF_MM
    display = simple.GetDisplayProperties(compare, made)
    display.OrientationMarks, display.CheckerSize, display.FullGradient = 0, 15.0, 0.5
    display.WipePosition = case_study.CAVITY_CENTRE
    return made, display


def compare_volumes(width):
    """One slice in four ways to compare."""
    side = width // 2
    case = patient()
    views = []
    for way in WAYS:
        made, display = _coronal(case.compare, side)
        display.SliceComparison = way
        views.append(stage.pixels(made))
    return numpy.vstack([numpy.hstack(views[:2]), numpy.hstack(views[2:])])


def local_similarity(width):
    """Where volume and reference disagree, before and after ten stamps."""
    side = width // 2
    pictures = []
    for stamped in (False, True):
        made, display = _coronal(patient(stamped).compare, side)
        display.SliceComparison = "Local similarity"
        pictures.append(stage.pixels(made))
    return numpy.hstack(pictures)


def flicker(width):
    """What flicker shows in turn: the volume as bent, and the reference."""
    side = width // 2
    case = patient()
    pictures = []
    for shown in ("Deformed", "Reference"):
        case.compare.Show = shown
        pictures.append(stage.pixels(_coronal(case.compare, side)[0]))
    return numpy.hstack(pictures)


def trace_distance(width):
    """The trace by its distance from the cortex, before and after ten stamps."""
    side = width // 2
    pictures = []
    for stamped in (False, True):
        case = patient(stamped)
        pictures.append(stage.pixels(case_study.show_trace(case.bent, case.measure, side)))
    return numpy.hstack(pictures)


def trace_points(width):
    """Points behind the tissue: faded, hidden, shown."""
    side = width // 3
    case = patient()
    pictures = []
    for hidden in ("Fade", "Hide", "Show"):
        made = case_study.show_trace(case.bent, case.measure, side)
        points = simple.GetDisplayProperties(case.measure, made)
        points.HiddenPoints = hidden
        points.SetScalarBarVisibility(made, False)
        made.CameraParallelScale = 55.0
        pictures.append(stage.pixels(made))
    return numpy.hstack(pictures)


def _case(case, width):
    side = width // 2
    views = [case_study.show_red_green(case.compare, "Coronal", (0, 1, 0), side),
             case_study.show_red_green(case.compare, "Sagittal", (-1, 0, 0), side),
             case_study.show_cortex(case.compare, side),
             case_study.show_trace(case.bent, case.measure, side)]
    pictures = [stage.pixels(made) for made in views]
    return numpy.vstack([numpy.hstack(pictures[:2]), numpy.hstack(pictures[2:])])


def case_before(width):
    """Slices, cortex and trace before the stamps."""
    return _case(patient(), width)


def case_after(width):
    """Slices, cortex and trace after ten stamps."""
    return _case(patient(stamped=True), width)


def case_fit(width):
    """Slices, cortex and trace after a fit to the same trace."""
    case = patient()
    case_study.fit_to_trace(case)
    made = _case(case, width)
    case.straighten()
    return made


def evidence(width):
    """How far a fit of the trace can be believed, in a slice and on the cortex."""
    side = width // 2
    case = patient()
    case_study.fit_to_trace(case).filter.Evidence = 1
    flat = stage.flat_view(side, case_study.CAVITY_CENTRE + FOCUS, 75.0)
    stage.show_slices(case.bent, flat, array="Brain", position=case_study.CAVITY_CENTRE,
                      white=case_study.WHITE).ShowEvidence = 1
    cortex = case_study.show_trace(case.bent, case.measure, side)
    simple.GetDisplayProperties(case.measure, cortex).SetScalarBarVisibility(cortex, False)
    simple.Hide(case.measure, cortex)
    simple.GetDisplayProperties(case.bent, cortex).ShowEvidence = 1
    made = stage.side_by_side([flat, cortex])
    case.straighten()
    return made


COMPARISON_SCENES = {
    "filter-compare-volumes": compare_volumes, "filter-local-similarity": local_similarity,
    "tool-flicker": flicker,
    "filter-trace-distance": trace_distance, "representation-trace-points": trace_points,
    "case-study-before": case_before, "case-study-after": case_after,
    "case-study-fit": case_fit, "filter-fit-deformation-evidence": evidence}
