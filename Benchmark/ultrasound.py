# SPDX-License-Identifier: BSD-3-Clause
"""How near `brainshift.refine(similarity="ultrasound")` comes on simulated sweeps that are hard.

    ./brainshift python Benchmark/ultrasound.py [--sweeps 12] [--first 1] [--starts 8] [--rows]
                                                [--head VOLUME MASK]... [--separations]

`sweep.py` makes the sweeps, in turn over the heads: that of the tests, and each `--head` (NIfTI: T1
and brain). Each sweep is registered to a T1 and to a volume like FLAIR, each from two positions up
to 6 mm and 6 degrees off. `off` is the mean distance, at landmarks in the sweep, of the rigid part
of the result from the best rigid motion; `TRE` counts the deformation, too. A result is right up
to 1 mm off, and wrong if it is more than 1.5 mm off.

`--rows` adds what the method is not made for: sliding, a cavity with air, a probe that presses.
`--separations` prints how clearly the right position stands out instead (separation.py).
"""

import argparse
import pathlib
import tempfile
import time
import warnings

import numpy
import sweep
from paraview import simple
from separation import print_separations

simple.LoadDistributedPlugin("BrainShift", ns=globals())
import brainshift  # noqa: E402 (after the plugin)

DATA = pathlib.Path(__file__).resolve().parent.parent / "Testing" / "Data" / "seg3d-utah"
HEAD = DATA / "seg3d_mr_t1.nii.gz", DATA / "seg3d_brainmask.nii.gz"
CONTRASTS = ("t1", "flair")
FARTHEST = 6.0  # mm and degrees
PLACES = 2  # from which each volume is registered
RIGHT_MM = 1.0
WRONG_MM = 1.5  # between the two, checks tell nothing
ROWS = {"the sides of a plane slide by 4 mm": {"slide": 4.0},
        "a cavity of 10 mm with air": {"cavity": 10.0},
        "the probe presses by 4 mm": {"press": 4.0}}


def in_ball(random):
    """A vector evenly within a ball of radius 1."""
    while True:
        vector = random.uniform(-1, 1, 3)
        if vector @ vector <= 1:
            return vector


def offset(random, centre):
    """A rigid motion (4 x 4) about a position."""
    shift, turn = FARTHEST * in_ball(random), numpy.radians(FARTHEST) * in_ball(random)
    angle = numpy.linalg.norm(turn)
    x, y, z = turn / angle
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    motion = numpy.eye(4)
    motion[:3, :3] += numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross
    motion[:3, 3] = centre + shift - motion[:3, :3] @ centre
    return motion


def moved(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def best_rigid(points, to):
    """The points, moved rigidly as near to the others as possible (Kabsch)."""
    a, b = points - points.mean(0), to - to.mean(0)
    u, _, v = numpy.linalg.svd(a.T @ b)
    signs = numpy.diag([1, 1, numpy.sign(numpy.linalg.det(u @ v))])
    return a @ (u @ signs @ v) + to.mean(0)


def mean_distance(a, b):
    return numpy.linalg.norm(a - b, axis=1).mean()


class Result:
    """One registration: how far off, and how it was graded."""

    def __init__(self, found, rest, measured):
        best = best_rigid(rest, measured)
        self.off = mean_distance(best_rigid(rest, found), best)
        self.tre = mean_distance(found, measured)
        self.best_tre = mean_distance(best, measured)


class Judge:
    """Registers sweeps and prints how far off they are."""

    def __init__(self, heads, options):
        self.heads, self.options = heads, options
        self.folder = tempfile.TemporaryDirectory()

    def _open(self, name, values, affine):
        path = f"{self.folder.name}/{name}.nii"
        sweep.write_nifti(path, values, affine)
        source = simple.NIFTIVolumeReader(FileName=path)
        source.UpdatePipeline()
        return source

    def _register(self, made, mr, motion):
        """A result from one position."""
        reference = self._open("reference", made.ultrasound, motion @ made.affine)
        bent = simple.FreeFormDeformation(Input=mr)
        begun = time.process_time()
        warnings.simplefilter("ignore")  # the grade is printed
        found = brainshift.refine(bent, reference, similarity="ultrasound",
                                  starts=self.options.starts, keep_failed=True)
        seconds = time.process_time() - begun
        at = brainshift.deformed_from_rest(bent, made.rest)
        result = Result(at, made.rest, moved(motion, made.measured))
        result.seconds, result.trust = seconds, found.trust
        for source in (bent, reference):
            simple.Delete(source)
        return result

    def _results(self, seed, knobs):
        made = sweep.Sweep(self.heads[seed % len(self.heads)], seed, **knobs)
        random = numpy.random.default_rng((seed, len(sweep.PARTS)))
        motions = [offset(random, made.world(made.centre)) for _ in range(PLACES)]
        for contrast in CONTRASTS:
            mr = self._open("volume", *made.mr(contrast))
            for motion in motions:
                result = self._register(made, mr, motion)
                result.contrast = contrast
                print(f"  sweep {seed} {contrast}: off {result.off:.2f} mm, TRE "
                      f"{result.tre:.2f} mm (best rigid {result.best_tre:.2f}), {result.trust}, "
                      f"CPU {result.seconds:.1f} s", flush=True)
                yield result
            simple.Delete(mr)

    def judge(self, title, knobs):
        seeds = range(self.options.first, self.options.first + self.options.sweeps)
        results = [result for seed in seeds for result in self._results(seed, knobs)]
        for contrast in (*CONTRASTS, "all"):
            print(f"{title}, {contrast}: " + summary(
                [r for r in results if contrast in (r.contrast, "all")]))
        groups = {"right": (0, RIGHT_MM), "a little off": (RIGHT_MM, WRONG_MM),
                  "wrong": (WRONG_MM, numpy.inf)}
        for name, (above, most) in groups.items():
            trusts = [r.trust for r in results if above < r.off <= most]
            print(f"{title}, {len(trusts)} {name}: {trusts.count('failed')} graded as failed, "
                  f"{trusts.count('doubtful')} as doubtful")


def summary(results):
    off = numpy.array([r.off for r in results])
    return (f"{(off <= RIGHT_MM).sum()} of {len(off)} within {RIGHT_MM:g} mm of the best rigid "
            f"motion, off {off.mean():.2f} mm on average, largest {off.max():.2f} mm, TRE "
            f"{numpy.mean([r.tre for r in results]):.2f} mm "
            f"(best rigid {numpy.mean([r.best_tre for r in results]):.2f} mm), "
            f"CPU {numpy.mean([r.seconds for r in results]):.1f} s")


def measure_ultrasound(arguments=()):
    parser = argparse.ArgumentParser()
    parser.add_argument("--sweeps", type=int, default=12)
    parser.add_argument("--first", type=int, default=1, help="seed of the first sweep")
    parser.add_argument("--starts", type=int, default=8)
    parser.add_argument("--head", nargs=2, action="append", default=[])
    parser.add_argument("--rows", action="store_true")
    parser.add_argument("--separations", action="store_true")
    options = parser.parse_args(arguments)
    heads = [sweep.Head(*files) for files in [HEAD, *options.head]]
    if options.separations:
        print_separations(heads, range(options.first, options.first + options.sweeps))
        return
    judge = Judge(heads, options)
    judge.judge("sweeps", {})
    for title, knobs in ROWS.items() if options.rows else ():
        judge.judge(title, knobs)


if __name__ == "__main__":
    import sys
    measure_ultrasound(sys.argv[1:])
