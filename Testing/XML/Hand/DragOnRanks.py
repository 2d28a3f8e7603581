# SPDX-License-Identifier: BSD-3-Clause
"""Proves that two MPI ranks of a server that is 50 ms away draw what a hand drags within two round
trips, as one process does; that the outline of the stroke follows before the server answers; that
these pictures are packed, and those of ParaView's own update, in 3D, in slices, and beside a second
bent volume.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import brainshift
import far_network
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import on_screen, server, server_finds_plugin
from paraview import simple
from ranks_testing import MPI

SIDE = 40  # of a block, mm
RANKS = "2"
AWAY = 0.05  # s, each way


def connect(port):
    simple.Connect("localhost", port)
    hand.wait(200)
    assert simple.servermanager.ActiveConnection.GetNumberOfDataPartitions() == int(RANKS)


def block(view, name, low):
    """A bent block that begins at a height (mm) in the view, and its display."""
    middle = 0.5 * SIDE
    source = simple.Wavelet(WholeExtent=[0, SIDE, 0, SIDE, low, low + SIDE],
                            Center=[middle, middle, low + middle])
    bent = simple.FreeFormDeformation(
        registrationName=name, Input=source, LatticeDimensions=[11, 11, 11])
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    display.AmbientOcclusion = 0  # ranks that draw parts have none
    display.AdaptiveQuality = 0  # or pictures depend on the time they take
    simple.ColorBy(display, ("POINTS", "RTData"))
    return bent, display


def show():
    """The block drawn by the ranks, each a half of it, in a view of the window."""
    view = simple.GetActiveViewOrCreate("RenderView")
    bent, display = block(view, "bent", 0)
    simple.GetOpacityTransferFunction("RTData").Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]
    simple.SetActiveSource(bent)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(200)
    return bent, view, display


def drag(far):
    bent, view, display = show()
    for kind in ("Deformed Volume", "Deformed Slices"):
        display.SetRepresentationType(kind)
        display.ShowSagittal = display.ShowCoronal = 0
        simple.Render(view)
        hand.wait(100)
        drag_one(far, bent, view, display, kind)
    display.SetRepresentationType("Deformed Volume")
    other, _ = block(view, "other", SIDE + 5)
    # It keeps the clipping planes: else only ParaView's update moves them, and rays are rounded.
    around = simple.Box(XLength=70, YLength=70, ZLength=130, Center=[20, 20, 45])
    simple.Show(around, view).SetRepresentationType("Outline")
    other.Strokes = brainshift.soft((20.0, 20.0, 60.0), (0.0, 6.0, 0.0), 15.0)
    simple.SetActiveSource(bent)
    simple.Render(view)
    hand.wait(100)
    drag_one(far, bent, view, display, "a second block")


def outlined(pixels):
    """How many pixels have the colour of outlines, and where the mark under the hand is."""
    red, green, blue = numpy.moveaxis(pixels, -1, 0)
    yellow = (red > 180) & (green > 150) & (blue < 110)
    orange = (red > 220) & (abs(green - 118) < 25) & (blue < 60)
    return yellow.sum(), numpy.argwhere(orange).mean(axis=0)


class Step:
    """What happens while the hand moves: at each picture of the window the round trips and the
    bytes that came; what the first one shows; and all bytes."""

    def __init__(self, far, view):
        self.far, self.view, self.first = far, view, None

    def __enter__(self):
        self.pictures, self.before = [], self.far.counts()
        self.window = self.view.SMProxy.GetRenderWindow()
        self.observer = self.window.AddObserver("EndEvent", self.note)
        return self

    def note(self, *_):
        now = self.far.counts()
        came = now["toClient"] - self.before["toClient"]
        self.pictures.append((now["roundTrips"] - self.before["roundTrips"], came))
        self.first = on_screen(self.view) if self.first is None else self.first

    def __exit__(self, *_):
        self.window.RemoveObserver(self.observer)
        self.bytes = self.far.counts()["toClient"] - self.before["toClient"]


def drag_one(far, bent, view, display, kind):
    hand.take(hand.SOFT)
    start = [side // 2 + 25 for side in view.ViewSize]
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 2, start[1] + 2])
    hand.wait(50)
    drawn = brainshift.counters(display)["latticeUploads"]
    pictures = [on_screen(view)]
    for step in (8, 14, 20, 26):
        with Step(far, view) as moved:
            hand.drag_to([start[0] + step, start[1] + step])
            hand.wait(50)
        print(kind, "pictures after round trips and bytes", moved.pictures, moved.bytes, flush=True)
        (_, came), (trips, much) = moved.pictures[:2]
        assert came < much / 50, (kind, "before the server answers", moved.pictures)
        assert trips <= 2, (kind, "tissue follows", moved.pictures)
        assert moved.bytes < on_screen(view).size / 2, (kind, "pictures are packed", moved.bytes)
        pictures.append(on_screen(view))
        before, at_once, after = map(outlined, (pictures[-2], moved.first, pictures[-1]))
        print("outlines", before, at_once, after, flush=True)
        assert at_once[0] > 0.7 * before[0] > 100, (kind, "the outline is drawn", before, at_once)
        assert numpy.abs(at_once[1] - after[1]).max() < 1.5 < numpy.abs(
            before[1] - after[1]).max(), (kind, "the mark follows", before, at_once, after)
    assert brainshift.counters(display)["latticeUploads"] >= drawn + 4, kind
    moved = [numpy.abs(one - other).max() for one, other in zip(pictures, pictures[1:])]
    assert min(moved) > 20, (kind, "the picture follows each step", moved)
    view.SMProxy.InteractiveRender()
    own = numpy.abs(on_screen(view) - pictures[-1]).max()
    assert own == 0, (kind, "ParaView's own update draws the same", own)
    hand.release([start[0] + 26, start[1] + 26])
    window.until(lambda: bent.MaximumDisplacement > 0, f"the drag bends {kind}")
    window.edit("Undo")
    window.until(lambda: bent.MaximumDisplacement == 0, f"undo in {kind}")


def lose_the_server():
    simple.Disconnect()
    hand.wait(300)
    hand.take(hand.NONE)
    hand.wait(100)


def play():
    ranks = server(server_finds_plugin(), [*MPI, RANKS])
    with ranks as (port, _), far_network.between(port, AWAY) as far:
        yield connect, far.port
        yield drag, far
        yield lose_the_server,


if __name__ == "__main__":
    window.main("DragOnRanks", play())
