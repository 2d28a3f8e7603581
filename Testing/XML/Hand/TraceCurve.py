# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel of Trace Distance shows the RMS over the strokes: the curve grows by one
point with each stamp, also while another panel is shown, goes back with undo and forth with redo,
and a button measures after strokes that came at once, as from a state file, without a step to undo.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math

import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import ball, show_volume, volume
from paraview import simple

MIDDLE, RADIUS = numpy.array((16.0, 16.0, 16.0)), 9.0
GREY = [0, 0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5]
OPAQUE = [0, 0, 0.5, 0, 0.4, 0, 0.5, 0, 0.6, 1, 0.5, 0, 1, 1, 0.5, 0]


def begin():
    source = volume(ball(inside=1.0, edge=2.0, radius=RADIUS))
    simple.SetActiveSource(source)
    bent, view = window.bend(), simple.GetActiveView()
    show_volume(bent, view, "Deformed Volume", GREY, OPAQUE)
    trace = simple.Sphere(Center=MIDDLE, Radius=RADIUS + 2.0, ThetaResolution=16, PhiResolution=16)
    measure = simple.TraceDistance(
        registrationName="measure", Input=trace, Deformation=bent)
    simple.Show(measure, view)
    view.CameraFocalPoint = MIDDLE
    view.CameraPosition = MIDDLE + (0, 0, 80)
    simple.Render(view)
    show_panel()


def show_panel():
    simple.SetActiveSource(simple.FindSource("measure"))
    hand.wait(300)


def rms():
    measure = simple.FindSource("measure")
    measure.SMProxy.UpdatePropertyInformation()
    return measure.RMS


def curve():
    measure = simple.FindSource("measure")
    measure.SMProxy.UpdatePropertyInformation()
    return list(numpy.atleast_1d(measure.RMSAfterStrokes))


def tells(strokes):
    """The panel tells the first and the last point."""
    show_panel()
    values = curve()
    assert len(values) == strokes + 1, values
    words = [f"RMS {value:.2f} mm" if math.isfinite(value) else "not measured" for value in values]
    said = f"before the first stroke: {words[0]}"
    if strokes:
        said += f"; after stroke {strokes}: {words[-1]}"
    assert hand.label("BrainShiftCurve") == said, (hand.label("BrainShiftCurve"), said)
    assert values[-1] == rms()
    return values


def stamp():
    simple.SetActiveSource(window.deformation())
    hand.wait(100)
    hand.take(hand.STAMP)
    width, height = simple.GetActiveView().ViewSize
    hand.wheel([width // 2, height // 2], -1)
    window.settle("Stamp: push")
    hand.take(hand.NONE)


def grows_and_follows_undo():
    seen = [tells(0)]
    for strokes in (1, 2, 3):
        stamp()
        seen.append(tells(strokes))
        assert seen[-1][:-1] == seen[-2], "the points before stay"
    assert len(set(seen[-1])) == 4, seen[-1]
    for strokes in (2, 1):
        window.action("Undo")
        assert tells(strokes) == seen[strokes]
    for strokes in (2, 3):
        window.action("Redo")
        assert tells(strokes) == seen[strokes]


def measures_what_came_at_once():
    bent, view = window.deformation(), simple.GetActiveView()
    numbers = list(bent.Strokes)
    for i in range(len(numbers) // window.NUMBERS):
        numbers[i * window.NUMBERS + 10] += 3.0  # other strokes: a larger radius
    bent.Strokes = numbers
    simple.Render(view)
    assert [math.isfinite(value) for value in tells(3)] == [True, False, False, True]
    steps, before = window.undo_labels(), rms()
    assert hand.click("BrainShiftMeasureStrokes")
    hand.wait(300)
    values = tells(3)
    assert all(map(math.isfinite, values)) and values[-1] == before, values
    assert len(set(values)) == 4, values
    assert list(bent.Strokes) == numbers and window.undo_labels() == steps


def play():
    yield (begin,)
    yield (grows_and_follows_undo,)
    yield (measures_what_came_at_once,)


if __name__ == "__main__":
    window.main("TraceCurve", play())
