# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the tools bend a volume that a pvserver holds and draws: ParaView's window, connected
to it, drags with each tool in 3D and in a slice, live, and takes back what it did. Tissue follows
the hand within two round trips to the server. The panel offers the series of a DICOM folder of the
server.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import brainshift
import far_network
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import data, server, server_finds_plugin
from paraview import simple
from window_testing import strokes

MIDDLE = (20.0, 20.0, 20.0)


def connect(port):
    simple.Connect("localhost", port)
    hand.wait(200)
    assert simple.servermanager.ActiveConnection.IsRemote()


def choose_a_series():
    reader = simple.OpenDataFile(data("dcm-qa-enh"))
    simple.SetActiveSource(reader)
    hand.wait(300)
    assert hand.is_visible("Series"), "the panel shows no choice of series"
    kinds = [kind for kind, *_ in hand.controls("Series")]
    assert "QComboBox" in kinds, kinds
    magnitude, field = reader.GetProperty("Series").Available
    assert magnitude.endswith("MAGNITUDE") and field.endswith("REAL"), (magnitude, field)
    assert reader.PointData["Intensity"].GetRange()[0] >= 0.0
    reader.Series = field
    reader.UpdatePipeline()
    assert reader.PointData["Intensity"].GetRange()[0] < -400.0
    simple.Delete(reader)
    hand.wait(100)


def show():
    """The block drawn by the server, in a view of the window."""
    source = simple.Wavelet(WholeExtent=[0, 40, 0, 40, 0, 40], Center=MIDDLE)
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=source, LatticeDimensions=[11, 11, 11])
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    simple.GetOpacityTransferFunction("RTData").Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]
    simple.SetActiveSource(bent)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(200)
    return bent, view, display


def drag_with_each_tool(far):
    bent, view, display = show()
    for kind in ("Deformed Volume", "Deformed Slices"):
        display.SetRepresentationType(kind)
        display.ShowSagittal = display.ShowCoronal = 0
        # Above it, moving pictures have stand-ins, as of every larger volume.
        view.LODThreshold = 0.0 if kind == "Deformed Slices" else 20.0
        simple.Render(view)
        hand.wait(100)
        for tool in (hand.SOFT, hand.STAMP, hand.MOVE):
            drag(far, bent, view, display, tool, kind)


def drag(far, bent, view, display, tool, kind):
    hand.take(tool)
    number = {hand.MOVE: brainshift.MOVE, hand.SOFT: brainshift.SOFT,
              hand.STAMP: brainshift.STAMP}[tool]
    tissue = (24.0, 24.0, 20.0)
    if kind == "Deformed Volume":
        tissue = brainshift.pick(display, view, *[side // 2 + 25 for side in view.ViewSize])
        assert tissue is not None
    start = window.pixel_of(view, numpy.round(numpy.divide(tissue, 4)) * 4)
    drawn = brainshift.counters(display)["latticeUploads"]
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 2, start[1] + 2])
    hand.wait(50)
    trips = []
    for step in (4, 6, 8, 10, 12, 15):
        last = far.counts()["roundTrips"]
        hand.drag_to([start[0] + step, start[1] + step])
        hand.wait(50)
        trips.append(far.counts()["roundTrips"] - last)
    # Two for the picture. Beside slow steps the panel asks for its figures, in one more.
    print("round trips of each step with", tool, kind, trips, flush=True)
    assert min(trips) <= 3, (tool, kind, trips)
    assert len(strokes()) == 1 and strokes()[0][0] == number, (tool, kind, strokes())
    window.until(lambda: brainshift.counters(display)["latticeUploads"] > drawn,
                 f"the server draws {kind} while tool {tool} drags")
    hand.release([start[0] + 15, start[1] + 15])
    if kind == "Deformed Slices":
        assert abs(strokes()[0][6]) < 1e-5, strokes()
    window.until(lambda: bent.MaximumDisplacement > 0, f"tool {tool} bends {kind}: {strokes()}")
    window.edit("Undo")
    window.until(lambda: bent.MaximumDisplacement == 0, f"undo of tool {tool} in {kind}")


def pull_and_pin():
    # The server solves the fit, live.
    window.deformation().Strokes = []
    bent, view = window.deformation(), simple.GetActiveView()
    display = simple.GetDisplayProperties(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.Render(view)
    hand.wait(100)
    hand.take(hand.PULL)
    start = [side // 2 + 25 for side in view.ViewSize]
    drawn = brainshift.counters(display)["latticeUploads"]
    hand.hover(start)
    hand.press(start)
    for step in (5, 10, 15):
        hand.drag_to([start[0] + step, start[1] + step])
        hand.wait(50)
    window.until(lambda: brainshift.counters(display)["latticeUploads"] > drawn,
                 "the server draws the pull meanwhile")
    hand.release([start[0] + 15, start[1] + 15])
    pull = numpy.array(bent.Lattice.Pulls)
    assert len(pull) == 7, pull
    asked = numpy.linalg.norm(pull[3:6] - pull[:3])

    def missed():
        return brainshift.deformed_from_rest(bent, [pull[:3].tolist()])[0] - pull[3:6]
    window.until(lambda: numpy.linalg.norm(missed()) < 0.2 * asked, f"tissue follows {pull}")
    window.until(lambda: hand.is_visible("BrainShiftPulls"), "the panel lists the pull")
    other = [side // 2 - 25 for side in view.ViewSize]
    hand.hover(other, hand.SHIFT)
    hand.press(other, hand.SHIFT)
    hand.release(other, hand.SHIFT)
    window.until(lambda: len(bent.Lattice.Pins) == 4, "Shift+click pins")
    bent.Lattice = None
    simple.Render(view)
    hand.wait(100)


def what_lies_under_the_cursor():
    hand.take(hand.NONE)
    view = simple.GetActiveView()
    display = simple.GetDisplayProperties(window.deformation(), view)
    pixel = [side // 2 + 9 for side in view.ViewSize]
    for offset in (1, 0):
        hand.hover([pixel[0] + offset, pixel[1]])
        hand.wait(250)
    tissue = brainshift.pick(display, view, *pixel)
    said = hand.label("BrainShiftCursor")
    place = "x {:.1f} y {:.1f} z {:.1f} mm".format(*tissue)
    assert said.startswith(place) and "intensity" in said and "moved" in said, (said, place)


def turn_the_wheel():
    hand.take(hand.STAMP)
    view = simple.GetActiveView()
    simple.GetDisplayProperties(window.deformation(), view).SetRepresentationType("Deformed Volume")
    simple.Render(view)
    middle = [side // 2 for side in view.ViewSize]
    hand.hover(middle)
    hand.wheel(middle, 2)
    window.settle("Stamp: pull")
    assert len(strokes()) == 1, strokes()


def lose_the_server():
    # With a tool in hand that shows something.
    view = simple.GetActiveView()
    hand.hover([side // 2 + 20 for side in view.ViewSize])
    hand.wait(50)
    del view  # or Python asks the server to let it go when there is none any more
    simple.Disconnect()
    hand.wait(300)
    hand.take(hand.NONE)
    hand.wait(100)


def play():
    with server(server_finds_plugin()) as (port, _), far_network.between(port, 0.0) as far:
        yield connect, far.port
        yield choose_a_series,
        yield drag_with_each_tool, far
        yield what_lies_under_the_cursor,
        yield turn_the_wheel,
        yield pull_and_pin,
        yield lose_the_server,


if __name__ == "__main__":
    window.main("BendOnServer", play())
