# SPDX-License-Identifier: BSD-3-Clause
"""Measures the time from the mouse to the picture in ParaView's window.

The stamp works on the reference case: 100 moves of a drag and 50 clicks of the wheel, each of them
a Qt event. benchmark.py starts the window with drag_window.py as its script. A time runs from the
event to the end of the picture that shows it. That picture has reduced quality, as it has under a
hand.
"""

import json
import os
import subprocess

FOLDER = os.path.dirname(os.path.abspath(__file__))


def measured(dimensions, windows, folder):
    """Starts ParaView's window, measures there and returns what it found; None where the window
    cannot be had."""
    if not os.environ.get("BRAINSHIFT_TEST_HAND") or not os.environ.get("BRAINSHIFT_PLUGIN_DIR"):
        return None
    os.makedirs(folder, exist_ok=True)
    file = os.path.abspath(os.path.join(folder, "drag.json"))
    if os.path.exists(file):
        os.remove(file)
    environment = dict(os.environ, BRAINSHIFT_DRAG=json.dumps(
        {"dimensions": list(dimensions), "windows": list(windows), "file": file,
         "path": [FOLDER, os.path.join(FOLDER, "..", "Testing", "Support")]}))
    run = subprocess.run(
        ["paraview", "--dr", "--plugin-search-paths=" + os.environ["BRAINSHIFT_PLUGIN_DIR"],
         "--plugins=BrainShift", "--script=" + os.path.join(FOLDER, "drag_window.py")],
        env=environment, check=False, capture_output=True, text=True)
    if not os.path.exists(file):
        raise RuntimeError(f"ParaView's window wrote no {file}:\n{run.stdout[-2000:]}")
    with open(file, encoding="utf-8") as results:
        found = json.load(results)
    if isinstance(found, str):
        raise RuntimeError(found)
    return found


def told(report, dimensions, windows, folder):
    """Adds what was measured to a report."""
    found = measured(dimensions, windows, folder)
    if found is None:
        report.fact("drag and wheel: not measured: ParaView's window or its test hand is missing")
        return
    for row in found:
        report.fact("{kind}, {window}x{window}: {median:.0f} ms from event to picture, worst "
                    "{worst:.0f} ms of {count}, quiet {quiet:.0f} ms".format(**row), **row)
