# SPDX-License-Identifier: BSD-3-Clause
"""Proves that a server of two MPI ranks that dies while a hand drags takes no stroke with it: the
window says so once, saves the state that ParaView then offers, and no rank is left.

ParaView's window runs this file as a script, and ends by itself. Then pvpython runs it and looks at
what is left."""

import json
import os
import signal
import subprocess
import time
from xml.etree import ElementTree

import brainshift
import test_hand as hand
import window_testing as window
from brainshift_testing import scratch, server, server_finds_plugin
from DragOnRanks import connect, show
from paraview import simple
from ranks_testing import MPI
from window_testing import strokes

BEFORE = brainshift.soft((20.0, 20.0, 20.0), (0.0, 2.0, 0.0), 10.0)
STATE, TOLD = scratch("lost.pvsm"), scratch("told.json")


def started_by(process):
    """The programs that a process started, and theirs."""
    listed = subprocess.run(["ps", "-eo", "pid=,ppid="], capture_output=True, text=True, check=True)
    parents = dict(map(int, line.split()) for line in listed.stdout.splitlines())
    found = [process]
    for one in found:
        found += [child for child, parent in parents.items() if parent == one]
    return found[1:]


def lose_the_server(process):
    """One rank dies while a stroke is under the hand, which goes on."""
    bent, view, _ = show()
    bent.Strokes = BEFORE
    simple.Render(view)
    hand.wait(100)
    hand.forget_messages()
    start = [side // 2 + 25 for side in view.ViewSize]
    hand.take(hand.SOFT)
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 5, start[1] + 5])
    assert len(strokes()) == 2, strokes()
    ranks = started_by(process.pid)
    with open(TOLD, "w", encoding="utf-8") as told:
        json.dump({"ranks": ranks, "strokes": list(bent.Strokes)}, told)
    hand.answer("qt_msgbox_buttonbox", "")  # the first one, Save state and exit
    hand.answer_path("FileSaveServerStateDialog", STATE)
    os.kill(ranks[-1], signal.SIGKILL)
    process.wait()
    for step in (10, 15):
        hand.drag_to([start[0] + step, start[1] + step])
        hand.wait(100)
    raise AssertionError("ParaView goes on without its server")


def main():
    with open(TOLD, encoding="utf-8") as file:
        told = json.load(file)
    found, = (proxy for proxy in ElementTree.parse(STATE).iter("Proxy")
              if proxy.get("type") == "FreeFormDeformation")
    saved, = (one for one in found.iter("Property") if one.get("name") == "Strokes")
    numbers = [float(element.get("value")) for element in saved.iter("Element")]
    assert len(numbers) == len(told["strokes"]) == 2 * len(BEFORE), numbers
    assert numbers[:len(BEFORE)] == list(BEFORE), numbers
    end = time.monotonic() + 20.0
    while any(os.path.exists(f"/proc/{rank}") for rank in told["ranks"]):
        assert time.monotonic() < end, "a rank is left"
        time.sleep(0.1)


if __name__ == "__main__":
    if hand.is_there():
        with server(server_finds_plugin(), [*MPI, "2"]) as (PORT, PROCESS):
            window.main("LostServer", [(connect, PORT), (lose_the_server, PROCESS)])
    else:
        main()
