# SPDX-License-Identifier: BSD-3-Clause
"""Plays a test in ParaView's window and judges it:

    python3 play_window.py NAME [--judge PROGRAM SCRIPT] -- WINDOW…

WINDOW is the command that plays, and BRAINSHIFT_TEST_TEMP the test's own folder, which is emptied
first. The test fails if the window ends with an error, if NAME.json says that a step did not hold
or is missing, or if the judge, a script that looks at what the window left, fails.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

MOST_SECONDS = 540  # a window that waits for an answer waits for ever


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("--judge", nargs=2, metavar=("PROGRAM", "SCRIPT"))
    parser.add_argument("window", nargs="+")
    return parser.parse_args()


def play(window):
    try:
        status = subprocess.run(window, check=False, timeout=MOST_SECONDS).returncode
    except subprocess.TimeoutExpired:
        sys.exit(f"The window did not end within {MOST_SECONDS} s")
    if status != 0:
        sys.exit(f"The window ended with status {status}")


def assert_all_held(file):
    """What the steps of a script wrote down with window_testing."""
    if not file.exists():
        sys.exit(f"The window wrote no {file.name}: its steps did not run to the end")
    told = json.loads(file.read_text(encoding="utf-8"))
    if told["failures"]:
        sys.exit("\n".join(told["failures"]))
    if told["played"] == 0:
        sys.exit("The window played no step")


def main():
    wanted = arguments()
    folder = pathlib.Path(os.environ["BRAINSHIFT_TEST_TEMP"])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    play(wanted.window)
    if wanted.judge:
        sys.exit(subprocess.run(wanted.judge, check=False).returncode)
    assert_all_held(folder / f"{wanted.name}.json")


if __name__ == "__main__":
    main()
