# SPDX-License-Identifier: BSD-3-Clause
"""Measures the times of several sides. One round runs every side once, so noise affects all."""

import dataclasses
import os
import statistics
import time
from typing import Callable, Optional


@dataclasses.dataclass
class Side:
    """One of the things compared. `prepare` is not timed, `run` is."""
    name: str
    run: Callable[[], None]
    prepare: Optional[Callable[[], None]] = None
    #: Run once untimed to fill caches and compile shaders. Runs that take seconds do without.
    warm: bool = True


@dataclasses.dataclass
class Times:
    """Milliseconds, one number for each round: elapsed, and of all threads of this process. The
    second list is empty where only the GPU measured."""
    wall: list
    processor: list

    def median(self):
        return statistics.median(self.wall)

    def cpu(self):
        return statistics.median(self.processor) if self.processor else None

    def quiet(self):
        return self.cpu() / rendering_threads() if self.processor else None

    def summary(self):
        return {"median": self.median(), "min": min(self.wall), "max": max(self.wall),
                "rounds": len(self.wall), "cpu": self.cpu(), "quiet": self.quiet(),
                "wall": self.wall, "processor": self.processor}


def rendering_threads():
    """How many threads llvmpipe draws with, and VTK resamples with."""
    return int(os.environ.get("LP_NUM_THREADS") or len(os.sched_getaffinity(0)))


def timed(run):
    """Milliseconds of a run: elapsed, and of all threads of this process."""
    wall, processor = time.perf_counter(), time.process_time()
    run()
    return 1000.0 * (time.perf_counter() - wall), 1000.0 * (time.process_time() - processor)


def _run(side, times=None):
    if side.prepare:
        side.prepare()
    wall, processor = timed(side.run)
    if times:
        times.wall.append(wall)
        times.processor.append(processor)


def interleaved(sides, rounds, seconds):
    """{name: Times} of sides run in turn, at most `rounds` times. Where that would take longer than
    `seconds`, slow sides run twice, or once if one round takes longer by itself."""
    times = {side.name: Times([], []) for side in sides}
    for side in sides:
        if side.warm:
            _run(side)
    begin = time.perf_counter()
    for number in range(1, rounds + 1):
        for side in sides:
            _run(side, times[side.name])
        spent = time.perf_counter() - begin
        if spent > seconds or (number >= 2 and spent * (number + 1) / number > seconds):
            sides = [side for side in sides if times[side.name].median() < 50.0 * seconds]
    return times
