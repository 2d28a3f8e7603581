# SPDX-License-Identifier: BSD-3-Clause
"""Times sides against each other: one round runs every side once, so that noise hits all."""

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


@dataclasses.dataclass
class Times:
    """Milliseconds, one number a round: of the clock, and of all this process's threads."""
    wall: list
    processor: list

    def median(self):
        return statistics.median(self.wall)

    def cpu(self):
        return statistics.median(self.processor)

    def quiet(self):
        return self.cpu() / rendering_threads()

    def summary(self):
        return {"median": self.median(), "min": min(self.wall), "max": max(self.wall),
                "cpu": self.cpu(), "quiet": self.quiet(), "wall": self.wall,
                "processor": self.processor}


def rendering_threads():
    """How many threads llvmpipe draws with, and VTK resamples with."""
    return int(os.environ.get("LP_NUM_THREADS") or len(os.sched_getaffinity(0)))


def _run(side, times=None):
    if side.prepare:
        side.prepare()
    wall, processor = time.perf_counter(), time.process_time()
    side.run()
    if times:
        times.processor.append(1000.0 * (time.process_time() - processor))
        times.wall.append(1000.0 * (time.perf_counter() - wall))


def interleaved(sides, repetitions):
    """{name: Times} of sides run in turn: once untimed, so that caches and shaders are made, then
    `repetitions` times."""
    times = {side.name: Times([], []) for side in sides}
    for side in sides:
        _run(side)
    for _ in range(repetitions):
        for side in sides:
            _run(side, times[side.name])
    return times
