# SPDX-License-Identifier: BSD-3-Clause
"""Uses BrainShift for long and proves that its memory stays flat and its window keeps its word.

    pvpython soak.py [--strokes N] [--volumes N] [--views N] [--actions N] [--seed S]

At the end it plays N actions at random in ParaView's window (RandomWalk.py). Before, it makes N
strokes and takes them back, opens and deletes N volumes in one view, and opens and
closes N views. Before each it does some to warm up, because ParaView and the driver keep what they
loaded once. It prints how much the memory of the process grew, and ends with 1 if that is more than
the limit. ParaView itself keeps about 0.2 MB for each volume that was shown and 1 MB for each view
that was closed, an empty one too. So as many volumes and views with its own Volume are measured
first and subtracted.

Two things of the driver are not ours. Mesa keeps compiled shaders in a file that it maps into
memory, 28 MB after 40 views: it is off here. And llvmpipe keeps up to 32 MB of what a picture was
made from, more or less by what the last pictures show and by how far its threads came: it draws in
our own thread here, and memory is measured after a picture without strokes.
"""
import argparse
import ctypes
import gc
import glob
import os
import subprocess
import sys
import tempfile
import time

FOLDER = os.path.dirname(os.path.abspath(__file__))
ENVIRONMENT = dict(os.environ)  # of the window, which keeps its shaders and threads

os.environ["MESA_SHADER_CACHE_DISABLE"] = "true"  # before the driver is loaded
os.environ["LP_NUM_THREADS"] = "0"

from brainshift_testing import ball, load_plugin, picture, show_volume, view_along, volume

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete, FreeFormDeformation  # noqa: E402

LIMIT_MB = 5.0
MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
OPACITIES = [0, 0, 0.5, 0, 100, 0.5, 0.5, 0]
SIZE = 100  # pixels
WARM_UP = 8  # volumes and views
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


def new_view():
    return view_along((-0.5, 0.3, -1), MIDDLE, 90.0, size=SIZE)


def drawn(bent, view, kind="Deformed Volume"):
    """The display of a volume that was drawn in a view."""
    display = show_volume(bent, view, kind, COLORS, OPACITIES, shade=True)
    assert picture(view).any()
    return display


class Strokes:
    """Strokes at changing places. Some are taken back at once, and all of them after a while."""

    def __init__(self):
        self.source, self.bent = bent_ball(1.0)
        self.view = new_view()
        drawn(self.bent, self.view)
        self.strokes = []

    def step(self, number):
        anchor = [16.0 + (number * factor % 11 - 5) for factor in (3, 5, 7)]
        self.strokes.append(brainshift.soft(anchor, (0.5, -0.3, 0.2), 8.0))
        self.set()
        if number % 3 == 0:
            self.strokes.pop()  # one undo
            self.set()
        if len(self.strokes) == MOST_STROKES:
            self.rest()
        if number % 10 == 0:
            assert picture(self.view).any()

    def rest(self):
        self.strokes.clear()
        self.set()
        picture(self.view)

    def set(self):
        self.bent.Strokes = [number for stroke in self.strokes for number in stroke]
        self.bent.UpdatePipeline()

    def end(self):
        for proxy in (self.view, self.bent, self.source):
            Delete(proxy)


class Volumes:
    """A volume is opened, bent, drawn and deleted."""

    def __init__(self, kind):
        self.kind = kind
        self.view = new_view()

    def step(self, number):
        source, bent = bent_ball(1.0 + number % 5)
        for proxy in (drawn(bent, self.view, self.kind), bent, source):
            Delete(proxy)

    def rest(self):
        pass  # the view is empty after each step

    def end(self):
        Delete(self.view)


class Views:
    """A view of one volume is opened and closed."""

    def __init__(self, kind):
        self.kind = kind
        self.source, self.bent = bent_ball(1.0)

    def step(self, _):
        view = new_view()
        Delete(drawn(self.bent, view, self.kind))
        Delete(view)

    def rest(self):
        pass  # no view is open after a step

    def end(self):
        Delete(self.bent)
        Delete(self.source)


def growth_mb(name, what, count, warm_up):
    """How much memory some steps took and did not give back, MB. Prints one line."""
    for number in range(warm_up):
        what.step(number)
    what.rest()
    before, start = memory_mb(), time.monotonic()
    for number in range(count):
        what.step(number)
    what.rest()
    growth, seconds = memory_mb() - before, time.monotonic() - start
    what.end()
    print(f"{count:6d} {name:22s} {before:7.1f} MB at first, {growth:+6.2f} MB after "
          f"{seconds:.0f} s", flush=True)
    return growth


def is_flat(counts):
    """Whether memory stays flat; prints what grew."""
    growths = [0.0]
    if counts.strokes:
        growths = [growth_mb("strokes", Strokes(), counts.strokes, 3 * MOST_STROKES)]
    for name, make, count in (("volumes", Volumes, counts.volumes), ("views", Views, counts.views)):
        if count == 0:
            continue
        stock = growth_mb(f"{name} of Volume", make("Volume"), count, WARM_UP)
        growths.append(growth_mb(name, make("Deformed Volume"), count, WARM_UP) - stock)
    flat = max(growths) <= LIMIT_MB
    print(f"{'Flat' if flat else 'Not flat'}: {', '.join(f'{g:+.2f}' for g in growths)} MB of our "
          f"own; the limit is {LIMIT_MB:+.0f} MB", flush=True)
    return flat


def walks(actions, seed):
    """Whether all held in a random walk through ParaView's window; prints what did not."""
    testing = os.path.dirname(FOLDER)
    support = os.path.join(testing, "Support")
    folder = os.environ.get("BRAINSHIFT_TEST_TEMP") or os.path.join(
        tempfile.gettempdir(), "brainshift-walk")
    modules = [FOLDER, support, *glob.glob(os.path.join(testing, "Formats", "*"))]
    environment = dict(
        ENVIRONMENT, BRAINSHIFT_TEST_TEMP=folder, BRAINSHIFT_WALK_ACTIONS=str(actions),
        BRAINSHIFT_WALK_SEED=str(seed), BRAINSHIFT_TEST_DATA=os.path.join(testing, "Data"),
        BRAINSHIFT_TEST_SCRIPT=os.path.join(FOLDER, "RandomWalk.py"),
        PYTHONPATH=os.pathsep.join([*modules, ENVIRONMENT.get("PYTHONPATH", "")]))
    print(f"A random walk of {actions} actions, seed {seed}; {folder}/RandomWalk.log lists them",
          flush=True)
    seconds = 120 + 10 * actions  # much more than it takes
    return subprocess.run(
        ["python3", "-B", os.path.join(support, "play_window.py"), "RandomWalk",
         "--seconds", str(seconds), "--", "paraview", "--dr",
         "--plugin-search-paths=" + os.path.dirname(os.environ["BRAINSHIFT_PLUGIN"]),
         "--plugins=BrainShift", "--script=" + os.path.join(support, "play_script.py")],
        env=environment, check=False).returncode == 0


def main():
    parser = argparse.ArgumentParser(
        prog="brainshift soak",
        description="Proves that memory stays flat in long use, and that ParaView's window "
                    "survives what is done in it at random. 0 leaves a part out.")
    parser.add_argument("--strokes", type=int, default=10000, help="default: 10000")
    parser.add_argument("--volumes", type=int, default=200, help="default: 200")
    parser.add_argument("--views", type=int, default=50, help="default: 50")
    parser.add_argument("--actions", type=int, default=2000, help="in the window; default: 2000")
    parser.add_argument("--seed", type=int, default=1, help="of the actions; default: 1")
    counts = parser.parse_args()
    held = is_flat(counts) if counts.strokes or counts.volumes or counts.views else True
    if counts.actions:
        walked = walks(counts.actions, counts.seed)
        print("The window kept its word" if walked else "The window did not keep its word")
        held = held and walked
    sys.exit(0 if held else 1)


main()
