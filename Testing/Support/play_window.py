# SPDX-License-Identifier: BSD-3-Clause
"""Plays a test in ParaView's window and judges it:

    python3 play_window.py NAME [--seconds N] [--status N] [--judge PROGRAM SCRIPT] -- WINDOW…

WINDOW is the command that plays, and BRAINSHIFT_TEST_TEMP the test's own folder, which is emptied
first. The test fails if the window ends with another status than 0, or that one, if NAME.json says
that a step did not hold or is missing, or if the judge, a script that looks at what the window
left, fails. If the window wrote NAME.log, its last lines are shown then.
"""

import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

MOST_SECONDS = 840  # a window that waits for an answer waits for ever
LAST_LINES = 40  # of a log


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("--seconds", type=int, default=MOST_SECONDS)
    parser.add_argument("--status", type=int, default=0)
    parser.add_argument("--judge", nargs=2, metavar=("PROGRAM", "SCRIPT"))
    parser.add_argument("window", nargs="+")
    return parser.parse_args()


def play(wanted, log):
    try:
        status = subprocess.run(wanted.window, check=False, timeout=wanted.seconds).returncode
    except subprocess.TimeoutExpired:
        sys.exit(f"The window did not end within {wanted.seconds} s{end_of(log)}")
    if status != wanted.status:
        sys.exit(f"The window ended with status {status}{end_of(log)}")


def end_of(log):
    """The last lines of a log, if the window wrote one."""
    if not log.exists():
        return ""
    lines = log.read_text(encoding="utf-8", errors="replace").splitlines()[-LAST_LINES:]
    return "\n".join([f". The end of {log}:", *lines])


def assert_all_held(file, log):
    """What the steps of a script wrote down with window_testing."""
    if not file.exists():
        sys.exit(f"The window wrote no {file.name}: its steps did not run to the end")
    told = json.loads(file.read_text(encoding="utf-8"))
    if told["failures"]:
        sys.exit("\n".join(told["failures"]) + end_of(log))
    if told["played"] == 0:
        sys.exit("The window played no step")


def main():
    wanted = arguments()
    folder = pathlib.Path(os.environ["BRAINSHIFT_TEST_TEMP"])
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    log = folder / f"{wanted.name}.log"
    play(wanted, log)
    if wanted.judge:
        sys.exit(subprocess.run(wanted.judge, check=False).returncode)
    assert_all_held(folder / f"{wanted.name}.json", log)


if __name__ == "__main__":
    main()
