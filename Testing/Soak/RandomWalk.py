# SPDX-License-Identifier: BSD-3-Clause
"""Plays ParaView's window at random under a fixed seed and proves that nothing crashes, no error is
reported, no stroke is lost and no picture is wrong.

BRAINSHIFT_WALK_ACTIONS and BRAINSHIFT_WALK_SEED say how long and which way; RandomWalk.log lists
the actions, each before it is carried out. ParaView's window runs this file as a script;
play_window.py reports what did not hold."""
import faulthandler
import os
import random
import time

import test_hand as hand
import walk_actions as actions
import walk_files
import walk_oracles as oracles
import window_testing as window

ACTIONS = int(os.environ.get("BRAINSHIFT_WALK_ACTIONS", "60"))
SEED = int(os.environ.get("BRAINSHIFT_WALK_SEED", "1"))
GO_ON = int(os.environ.get("BRAINSHIFT_WALK_FAILURES", "1"))  # ends after so many
STUCK = 180  # seconds for one action: the window hangs
#: After how many actions each check is made, and the check.
NOW_AND_THEN = ((20, lambda chance: oracles.undo_and_redo_lead_back(chance.randint(1, 5))),
                (50, lambda _: oracles.views_are_drawn_right()),
                (50, lambda _: oracles.linked_views_zoom_together()),
                (100, lambda _: oracles.baked_is_alike()),
                (200, lambda _: oracles.state_comes_back()))


class Log:
    """Lines that a crash leaves."""

    def __init__(self, path):
        self.file = open(path, "w", encoding="utf-8", buffering=1)  # noqa: SIM115 until the end
        faulthandler.enable(self.file)
        self.start = time.monotonic()

    def tell(self, words):
        print(f"{time.monotonic() - self.start:7.1f} s  {words}", file=self.file, flush=True)
        faulthandler.dump_traceback_later(STUCK, exit=True, file=self.file)


def act(number, log):
    """One action, and what must hold after each."""
    chance = random.Random(f"{SEED} {number}")
    words, steps, changes = actions.choose(chance)
    log.tell(f"{number}: {words}")
    before, undo = oracles.strokes(), window.undo_labels()
    for _ in steps:
        pass
    actions.idle(30)
    new = [label for label in window.undo_labels() if label not in undo]
    if new:
        log.tell(f"   now to undo: {new}")
    oracles.no_dialog()
    oracles.no_message()
    oracles.no_empty_cell()
    if not changes:
        after = oracles.strokes()
        lost = [source for source, list_ in before.items() if after.get(source, list_) != list_]
        oracles.hold(not lost, f"strokes of {lost} changed")


def check(number, log):
    """What is looked at now and then."""
    chance = random.Random(f"{SEED} {number} check")
    due = [what for every, what in NOW_AND_THEN if number % every == 0 or number == ACTIONS]
    if not due:
        return
    log.tell("check")
    for what in due:
        oracles.rest()  # undo and redo of the check before may have left a picture of a movement
        what(chance)
        oracles.no_dialog()
        oracles.no_message()


def walk():
    folder = os.environ["BRAINSHIFT_TEST_TEMP"]
    actions.Files.folder = os.path.join(folder, "files")
    files = walk_files.write(actions.Files.folder)
    actions.Files.volumes, actions.Files.labels, actions.Files.points = files
    log = Log(os.path.join(folder, "RandomWalk.log"))
    hand.send_dialogs_away()
    with window.unrecorded():
        hand.resize_window(760, 560)
        actions.begin()
    hand.forget_messages()
    failures = []
    for number in range(1, ACTIONS + 1):
        for part in (act, check):
            try:
                part(number, log)
            except AssertionError as failure:
                failures.append(f"seed {SEED}, action {number}: {failure}")
                log.tell(f"   FAILED: {failure}")
                hand.forget_messages()
        if len(failures) >= GO_ON:
            break
    log.tell("end")
    faulthandler.cancel_dump_traceback_later()
    oracles.rest()
    hand.forget_messages()
    assert not failures, "\n".join(failures)


window.main("RandomWalk", [(walk,)])
