# SPDX-License-Identifier: BSD-3-Clause
"""Proves the live pointer in the window: its dock is closed until it is asked for; it hears a
server on loopback, draws the tip over a picture that is not cast anew, and tells the distance that
Trace Distance tells. Held down, the key T records a trace that bends the brain, as one undo step;
the button records until it is pressed again. A server that dies gives one sentence. A replay leaves
the live tracker its registration.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math
import socket
import struct
import threading
import time

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import ball, on_screen, scratch, show_volume, volume
from paraview import simple

MIDDLE, RADIUS = numpy.array((16.0, 16.0, 16.0)), 9.0
GREY = [0, 0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5]
OPAQUE = [0, 0, 0.5, 0, 0.4, 0, 0.5, 0, 0.6, 1, 0.5, 0, 1, 1, 0.5, 0]
KEY_T = 0x54
RECORD = "Record Trace"


def checksum(data):
    """CRC-64 of ECMA-182, which ends each header."""
    total = 0
    for byte in data:
        total ^= byte << 56
        for _ in range(8):
            total = (total << 1 ^ (0x42F0E1EBA9EA3693 if total >> 63 else 0)) & (1 << 64) - 1
    return total


def transform(tip):
    """A message of OpenIGTLink with the pose of the stylus. None: a tool that is not seen."""
    unseen = (1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0)
    body = struct.pack(">12f", *(unseen if tip is None else (0, 1, 0, -1, 0, 0, 0, 0, 1, *tip)))
    return struct.pack(">H12s20sQQQ", 1, b"TRANSFORM", b"StylusToReference", 0, len(body),
                       checksum(body)) + body


class Server(threading.Thread):
    """Sends where its tip is, 60 times a second, to one client after the other."""

    def __init__(self):
        super().__init__(daemon=True)
        self.listening = socket.create_server(("127.0.0.1", 0))
        self.port = self.listening.getsockname()[1]
        self.tip, self.sent, self.alive = MIDDLE + (0, 0, 12), 0, True
        self.shaken = 0.0  # mm, up and down
        self.start()

    def run(self):
        client, _ = self.listening.accept()
        with client:
            while self.alive:
                up = self.shaken * (self.sent // 3 % 2)
                client.sendall(transform(None if self.tip is None else self.tip + (0, 0, up)))
                self.sent += 1
                time.sleep(1 / 60)
        self.listening.close()

    def go(self, tip):
        """The tip is elsewhere, and the window has had time to see it."""
        self.tip = numpy.asarray(tip, float)
        words = "Tip at {:.1f} {:.1f} {:.1f} mm".format(*self.tip)
        until(lambda: hand.label("BrainShiftPointerPlace") == words, words)


def until(holds, what):
    for _ in range(600):
        if holds():
            return
        hand.wait(20)
    raise AssertionError((what, [hand.label(f"BrainShiftPointer{name}") for name in (
        "Status", "Place", "Distance", "Recorded", "Problem")]))


def begin():
    source = volume(ball(inside=1.0, edge=2.0, radius=RADIUS))
    simple.SetActiveSource(source)
    bent, view = window.bend(), simple.GetActiveView()
    display = show_volume(bent, view, "Deformed Volume", GREY, OPAQUE)
    display.ScalarOpacityUnitDistance = 1.0
    view.OrientationAxesVisibility = 0
    view.CameraFocalPoint = MIDDLE
    view.CameraPosition = MIDDLE + (0, 0, 80)
    simple.Render(view)
    hand.wait(100)
    window.server = Server()


def dock_is_closed_at_first():
    assert not hand.is_visible("BrainShiftPointerDock")
    hand.action("actionBrainShiftPointer")
    hand.wait(200)
    assert hand.is_visible("BrainShiftPointerDock")
    assert hand.label("BrainShiftPointerStatus") == "Not connected"
    assert "Not registered" in hand.label("BrainShiftPointerRegistration")


def connects():
    assert hand.type_into("BrainShiftPointerHost", "127.0.0.1")
    assert hand.type_into("BrainShiftPointerPort", window.server.port)
    assert hand.click("BrainShiftPointerConnect")
    until(lambda: "Hz" in hand.label("BrainShiftPointerStatus"), "poses")
    assert hand.label("BrainShiftPointerStatus").startswith("StylusToReference: ")


def yellow():
    """Where the ball at the tip is seen: how many pixels, and their mean, from the lower left."""
    colors = on_screen(simple.GetActiveView())
    ys, xs = numpy.nonzero((colors[..., 0] > 120) & (colors[..., 0] > colors[..., 2] + 80))
    return len(xs), (xs.mean(), ys.mean()) if len(xs) else None


def draws_the_tip_where_it_is():
    for tip in (MIDDLE + (0, 0, 12), MIDDLE + (6, 3, 10)):
        window.server.go(tip)
        hand.wait(200)
        count, place = yellow()
        assert count > 20, count
        assert math.dist(place, window.pixel_of(simple.GetActiveView(), tip)) < 6, (tip, place)


def is_not_drawn_while_it_is_not_seen():
    window.server.tip = None
    until(lambda: "not visible" in hand.label("BrainShiftPointerStatus"), "an unseen tool")
    hand.wait(200)
    assert yellow()[0] < 20, yellow()
    assert hand.label("BrainShiftPointerDistance") == "\u2013 mm"


def casts_no_rays_for_the_tip():
    display = simple.GetDisplayProperties(window.deformation(), simple.GetActiveView())
    hand.wait(300)
    before = brainshift.counters(display)
    for step in range(10):
        window.server.go(MIDDLE + (step, 0, 12))
    after = brainshift.counters(display)
    assert after["pixelsCast"] == before["pixelsCast"], (before, after)


def tells_the_distance():
    bent = window.deformation()
    for tip in (MIDDLE + (0, 0, 12), MIDDLE + (0, 6, 0)):
        window.server.go(tip)
        hand.wait(300)
        point = simple.PolyPointSource(Points=list(tip))
        simple.SetActiveSource(bent)
        measure = simple.TraceDistance(Input=point, Deformation=bent)
        measure.UpdatePipeline()
        measure.SMProxy.UpdatePropertyInformation()
        side = "inside" if measure.Mean < 0 else "outside"
        said = f"{abs(measure.Mean):.1f} mm {side}"
        simple.Delete(measure)
        simple.Delete(point)
        simple.SetActiveSource(bent)
        assert hand.label("BrainShiftPointerDistance") == said, said
        assert abs(abs(measure_of(tip)) - float(said.split()[0])) < 0.5


def measure_of(tip):
    return numpy.linalg.norm(numpy.asarray(tip) - MIDDLE) - RADIUS


def another_volume_has_a_cortex_of_its_own():
    bent = window.deformation()

    def threshold():
        return float(hand.label("BrainShiftPointerThreshold"))

    assert hand.type_into("BrainShiftPointerThreshold", 0.25)
    until(lambda: threshold() == 0.25, "what was typed")
    with window.unrecorded():
        brighter = volume(1000.0 * ball(inside=1.0, edge=2.0, radius=RADIUS))
        other = simple.FreeFormDeformation(registrationName="other", Input=brighter)
        other.UpdatePipeline()
        simple.SetActiveSource(other)
    until(lambda: threshold() == 500.0, "the middle of its range")
    simple.SetActiveSource(bent)
    until(lambda: threshold() == 0.25, "what was typed")
    with window.unrecorded():
        simple.Delete(other)
        simple.Delete(brighter)
    assert hand.type_into("BrainShiftPointerThreshold", 0.5)


def touches_only_what_is_held_still():
    window.server.go(MIDDLE + (1, 2, 14))
    hand.wait(700)  # the tip rests for more than half a second
    until(lambda: hand.click("BrainShiftPointerTouch"), "a tip in sight")
    assert not hand.label("BrainShiftPointerProblem"), hand.label("BrainShiftPointerProblem")
    assert hand.cell("BrainShiftPointerPairs", 0, 0)[3], "what was touched"
    window.server.shaken = 10.0  # also while a busy machine takes its time for the click
    hand.wait(700)
    assert hand.click("BrainShiftPointerTouch")
    window.server.shaken = 0.0
    assert "moved more than 2 mm" in hand.label("BrainShiftPointerProblem")
    assert hand.click("BrainShiftPointerRemove")
    window.server.go(MIDDLE + (1, 2, 14))


def rms(points):
    """Root mean square distance (mm) of points to the bent cortex."""
    bent = window.deformation()
    source = simple.PolyPointSource(Points=[float(x) for x in numpy.ravel(points)])
    measure = simple.TraceDistance(Input=source, Deformation=bent)
    measure.UpdatePipeline()
    measure.SMProxy.UpdatePropertyInformation()
    value = measure.RMS
    simple.Delete(measure)
    simple.Delete(source)
    simple.SetActiveSource(bent)
    return value


def spiral(count=40):
    """A cap of the ball that sank by 2 mm, in small steps."""
    angles = numpy.linspace(0.0, 4 * math.pi, count)
    away = numpy.linspace(0.05, 0.7, count)
    directions = numpy.stack([numpy.sin(away) * numpy.cos(angles),
                              numpy.sin(away) * numpy.sin(angles), numpy.cos(away)], axis=1)
    return MIDDLE - (0, 0, 2) + RADIUS * directions


def casts_and_bends():
    counters = brainshift.counters(
        simple.GetDisplayProperties(window.deformation(), simple.GetActiveView()))
    return numpy.array((counters["frames"], counters["latticeUploads"]))


def records_while_the_key_is_down():
    bent, points = window.deformation(), spiral()
    window.server.go(points[0])
    window.before = rms(points)
    assert window.before > 1.0, window.before
    steps, before = window.undo_labels(), casts_and_bends()
    hand.hover([50, 50])
    hand.key_down(KEY_T)
    until(lambda: "Recording" in hand.label("BrainShiftPointerRecorded"), "recording")
    for point in points:
        window.server.tip = point
        hand.wait(40)
    until(lambda: bent.Lattice is not None, "a fit while the key is down")
    until(lambda: displacement() > 0.5, "a bend while the key is down")
    assert window.undo_labels() == steps, "no step to undo while the key is down"
    casts, bends = casts_and_bends() - before
    assert casts <= bends + 2, ("rays were cast for the tip, too", casts, bends)
    hand.key_up(KEY_T)
    hand.wait(300)
    assert "Last trace" in hand.label("BrainShiftPointerRecorded")
    labels = window.undo_labels()
    assert labels[0] == RECORD and labels[1:] == steps[:len(labels) - 1], labels
    trace = simple.FindSource("Traced Points")
    found = numpy.reshape(list(trace.Points), (-1, 3))
    assert len(found) >= 20, len(found)
    assert (numpy.linalg.norm(numpy.diff(found, axis=0), axis=1) >= 0.499).all()


def displacement():
    bent = window.deformation()
    bent.SMProxy.UpdatePropertyInformation()
    return bent.MaximumDisplacement


def is_one_step_to_undo():
    bent, after = window.deformation(), displacement()
    window.action("Undo")
    hand.wait(200)
    assert bent.Lattice is None and simple.FindSource("Traced Points") is None
    assert displacement() == 0.0
    window.action("Redo")
    hand.wait(200)
    assert displacement() == after, (displacement(), after)
    assert simple.FindSource("Traced Points") is not None
    points = spiral()
    assert rms(points) < 0.5 * window.before, (window.before, rms(points))


def undo_of_a_second_trace_leaves_the_first():
    trace = simple.FindSource("Traced Points")
    first, bend = list(trace.Points), displacement()
    points = spiral() * (-1, 1, 1) + (2 * MIDDLE[0], 0, -1)
    window.server.go(points[0])
    hand.hover([50, 50])
    hand.key_down(KEY_T)
    until(lambda: "Recording" in hand.label("BrainShiftPointerRecorded"), "recording")
    for point in points:
        window.server.tip = point
        hand.wait(40)
    until(lambda: len(trace.Points) > len(first), "a longer trace while the key is down")
    hand.key_up(KEY_T)
    hand.wait(300)
    both, further = list(trace.Points), displacement()
    assert both[:len(first)] == first and len(both) >= len(first) + 3 * 20, (len(first), len(both))
    assert further != bend and window.undo_labels()[0] == RECORD, (bend, window.undo_labels())
    for name, held, moved in (("Undo", first, bend), ("Redo", both, further)):
        window.action(name)
        hand.wait(200)
        assert list(trace.Points) == held, (name, len(trace.Points), len(held))
        assert displacement() == moved, (name, displacement(), moved)


def button_records_until_it_is_pressed_again():
    """Neither another window nor a letter that is typed ends it."""
    def is_recording():
        return "Recording" in hand.label("BrainShiftPointerRecorded")

    assert hand.click("BrainShiftPointerRecord")
    until(is_recording, "recording")
    hand.deactivate()
    hand.wait(200)
    assert is_recording(), "another window ended it"
    assert hand.focus_on("BrainShiftStrengthSpinBox")
    assert hand.type_into("BrainShiftStrengthSpinBox", "t1")
    hand.wait(200)
    assert is_recording(), "a letter ended it"
    assert hand.click("BrainShiftPointerRecord")
    until(lambda: not is_recording(), "an end")
    # The key is let go over there.
    hand.hover([50, 50])
    hand.focus()
    hand.key_down(KEY_T)
    until(is_recording, "recording")
    hand.deactivate()
    until(lambda: not is_recording(), "an end")
    hand.key_up(KEY_T)


def server_that_dies_gives_one_sentence():
    window.server.alive = False
    until(lambda: hand.label("BrainShiftPointerStatus") == "The server closed the connection.",
          "one sentence")
    assert not hand.label("BrainShiftPointerPlace")
    window.server = Server()
    assert hand.type_into("BrainShiftPointerPort", window.server.port)
    # Poses are dropped on request only.
    hand.answer("BrainShiftPointerUnsaved", "BrainShiftPointerCancel")
    assert hand.click("BrainShiftPointerConnect")
    assert hand.label("BrainShiftPointerStatus") == "The server closed the connection."
    hand.answer_path("BrainShiftPointerSession", scratch("pointer-kept.txt"))
    assert hand.click("BrainShiftPointerSave")
    with open(scratch("pointer-kept.txt"), encoding="utf-8") as file:
        assert len(file.readlines()) > 300
    assert hand.click("BrainShiftPointerConnect")
    until(lambda: "Hz" in hand.label("BrainShiftPointerStatus"), "poses again")
    assert hand.click("BrainShiftPointerConnect")
    assert hand.label("BrainShiftPointerStatus") == "Not connected"


def session_of(shift):
    """A file of a pointer that rests for a minute. Its registration is a shift (mm)."""
    path = scratch("pointer-session.txt")
    pose = (1, 0, 0, MIDDLE[0], 0, 1, 0, MIDDLE[1], 0, 0, 1, MIDDLE[2])
    placed = (1, 0, 0, shift[0], 0, 1, 0, shift[1], 0, 0, 1, shift[2])
    with open(path, "w", encoding="utf-8") as file:
        file.write("# BrainShift pointer session 1\n")
        file.write("\t".join(["# image from tracker", *map(str, placed)]) + "\n")
        for i in range(600):
            file.write("\t".join([str(i / 10), "StylusToReference", *map(str, pose)]) + "\n")
    return path


def replay(shift):
    hand.answer_path("BrainShiftPointerSession", session_of(shift))
    assert hand.click("BrainShiftPointerReplay")
    words = "Tip at {:.1f} {:.1f} {:.1f} mm".format(*(MIDDLE + shift))
    until(lambda: hand.label("BrainShiftPointerPlace") == words, words)
    assert "as in the saved session" in hand.label("BrainShiftPointerRegistration")


def live_tracker_keeps_its_registration():
    """Whatever was replayed in between: here it has none."""
    hand.answer("BrainShiftPointerUnsaved", "BrainShiftPointerDiscard")
    for shift in ((5.0, 0.0, 3.0), (0.0, 4.0, 2.0)):
        replay(shift)
    window.server = Server()
    assert hand.click("BrainShiftPointerConnect")  # ends the replay
    assert hand.type_into("BrainShiftPointerPort", window.server.port)
    assert hand.click("BrainShiftPointerConnect")
    until(lambda: "Hz" in hand.label("BrainShiftPointerStatus"), "poses after a replay")
    window.server.go(MIDDLE + (1, 2, 14))
    assert "Not registered" in hand.label("BrainShiftPointerRegistration")
    assert hand.click("BrainShiftPointerConnect")


def play():
    yield (begin,)
    yield (dock_is_closed_at_first,)
    yield (connects,)
    yield (draws_the_tip_where_it_is,)
    yield (is_not_drawn_while_it_is_not_seen,)
    yield (casts_no_rays_for_the_tip,)
    yield (tells_the_distance,)
    yield (another_volume_has_a_cortex_of_its_own,)
    yield (touches_only_what_is_held_still,)
    yield (records_while_the_key_is_down,)
    yield (is_one_step_to_undo,)
    yield (undo_of_a_second_trace_leaves_the_first,)
    yield (button_records_until_it_is_pressed_again,)
    yield (server_that_dies_gives_one_sentence,)
    yield (live_tracker_keeps_its_registration,)


if __name__ == "__main__":
    window.main("PointerByHand", play())
