# SPDX-License-Identifier: BSD-3-Clause
"""Uses BrainShift for long and proves that its memory stays flat.

    pvpython soak.py [--strokes N] [--volumes N] [--views N]

It makes N strokes and takes them back, opens and deletes N volumes, and opens and closes N views.
Before each it does a tenth of that to warm up, because ParaView and the driver keep what they
loaded once. It prints how much the memory of the process grew, and ends with 1 if that is more than
the limit.
"""
import argparse
import ctypes
import gc
import os
import sys
import time

from brainshift_testing import ball, load_plugin, picture, show_volume, view_along, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete, FreeFormDeformation, GetDisplayProperties  # noqa: E402

LIMIT_MB = 5.0
MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
OPACITIES = [0, 0, 0.5, 0, 100, 0.5, 0.5, 0]
SIZE = 100  # pixels
MOST_STROKES = 50  # then they are all taken back

libc = ctypes.CDLL(None)


def memory_mb():
    """Resident memory of this process, without what it could give back."""
    gc.collect()
    libc.malloc_trim(0)
    with open("/proc/self/statm", encoding="ascii") as pages:
        return int(pages.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2 ** 20


def bent_ball(amount):
    source = volume(ball())
    return source, FreeFormDeformation(
        Input=source, Strokes=brainshift.soft(MIDDLE, (amount, 1.0, 0.0), 12.0))


def drawn(bent):
    view = view_along((-0.5, 0.3, -1), MIDDLE, 90.0, size=SIZE)
    show_volume(bent, view, "Deformed Volume", COLORS, OPACITIES, shade=True)
    assert picture(view).any()
    return view


class Strokes:
    """Strokes at changing places. Some are taken back at once, and all of them after a while."""

    def __init__(self):
        self.source, self.bent = bent_ball(1.0)
        self.view = drawn(self.bent)
        self.strokes = []

    def step(self, number):
        anchor = [16.0 + (number * factor % 11 - 5) for factor in (3, 5, 7)]
        self.strokes.append(brainshift.soft(anchor, (0.5, -0.3, 0.2), 8.0))
        self.set()
        if number % 3 == 0:
            self.strokes.pop()  # one undo
            self.set()
        if len(self.strokes) == MOST_STROKES:
            self.strokes.clear()
            self.set()
        if number % 10 == 0:
            assert picture(self.view).any()

    def set(self):
        self.bent.Strokes = [number for stroke in self.strokes for number in stroke]
        self.bent.UpdatePipeline()

    def end(self):
        for proxy in (self.view, self.bent, self.source):
            Delete(proxy)


class Volumes:
    """A volume is opened, bent, drawn and deleted."""

    def step(self, number):
        source, bent = bent_ball(1.0 + number % 5)
        view = drawn(bent)
        for proxy in (GetDisplayProperties(bent, view), view, bent, source):
            Delete(proxy)

    def end(self):
        pass


class Views:
    """A view of one volume is opened and closed."""

    def __init__(self):
        self.source, self.bent = bent_ball(1.0)

    def step(self, _):
        view = drawn(self.bent)
        Delete(GetDisplayProperties(self.bent, view))
        Delete(view)

    def end(self):
        Delete(self.bent)
        Delete(self.source)


def soak(name, what, count):
    """Prints one line and returns whether memory stayed flat."""
    for number in range(max(3, count // 10)):
        what.step(number)
    before, start = memory_mb(), time.monotonic()
    for number in range(count):
        what.step(number)
    growth, seconds = memory_mb() - before, time.monotonic() - start
    what.end()
    print(f"{count:6d} {name:8s} {before:7.1f} MB at first, {growth:+6.2f} MB after "
          f"{seconds:.0f} s; the limit is {LIMIT_MB:+.0f} MB", flush=True)
    return growth <= LIMIT_MB


def main():
    parser = argparse.ArgumentParser(
        prog="brainshift soak", description="Proves that memory stays flat in long use.")
    parser.add_argument("--strokes", type=int, default=10000, help="default: 10000")
    parser.add_argument("--volumes", type=int, default=200, help="default: 200")
    parser.add_argument("--views", type=int, default=50, help="default: 50")
    counts = parser.parse_args()
    flat = [soak(name, make(), count) for name, make, count in (
        ("strokes", Strokes, counts.strokes), ("volumes", Volumes, counts.volumes),
        ("views", Views, counts.views))]
    sys.exit(0 if all(flat) else 1)


main()
