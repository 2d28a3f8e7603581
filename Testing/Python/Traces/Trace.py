# SPDX-License-Identifier: BSD-3-Clause
# Proves that the Python trace of a session has its strokes, and that running the trace gives the
# same picture.
from paraview import simple, smtrace

import brainshift
from brainshift_testing import (
    data, load_plugin, object_pixels, picture, run_tests, structural_similarity)

load_plugin()

INTEREST = [-309, 22, 477]


def bend_a_head():
    """What a user does in the window. A script's steps are traced where they create something."""
    head = simple.OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    deformation = simple.FreeFormDeformation(
        Input=head, Strength=0.75, PointOfInterest=INTEREST,
        Strokes=(brainshift.stamp((-366, 40, 520), (-309, 22, 477), -10.0)
                 + brainshift.move((-309, 22, 540), (0.0, 0.0, 4.0))))
    view = simple.CreateView(
        "RenderView", ViewSize=[300, 300], UseColorPaletteForBackground=0,
        Background=[0.0, 0.0, 0.0], OrientationAxesVisibility=0)
    display = simple.Show(deformation, view)
    simple.ColorBy(display, ("POINTS", "Intensity"))
    display.RescaleTransferFunctionToDataRange(True, False)
    display.SetScalarBarVisibility(view, False)
    simple.ResetCamera(view)
    simple.Render(view)
    return deformation, picture(view)


def test_trace_replays_to_the_same_picture():
    smtrace.start_trace()
    deformation, drawn = bend_a_head()
    strokes = list(deformation.Strokes)
    trace = smtrace.stop_trace()

    assert "FreeFormDeformation(" in trace, trace
    assert "Strokes=[2.0,-366.0,40.0,520.0" in trace.replace(" ", ""), trace
    assert "Deformed Volume" in trace, trace
    assert object_pixels(drawn).mean() > 0.1, "nothing was drawn"

    simple.ResetSession()
    load_plugin()
    replayed = {}
    exec(compile(trace, "trace", "exec"), replayed)
    again = simple.FindSource("FreeFormDeformation1")
    assert list(again.Strokes) == strokes, list(again.Strokes)
    assert again.Strength == 0.75, again.Strength
    assert list(again.PointOfInterest) == INTEREST, list(again.PointOfInterest)
    similarity = structural_similarity(drawn, picture(simple.GetActiveView()))
    assert similarity > 0.999, similarity


run_tests(globals())
