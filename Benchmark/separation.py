# SPDX-License-Identifier: BSD-3-Clause
"""How clearly the right position of a sweep stands out, by which `sweep.py` is calibrated.

A separation is the number of standard deviations by which a cost at the best rigid position is
below its mean over 30 positions up to 9 mm and 9 degrees away. It needs no ParaView: the
similarities are written here once more, without what makes them fast.
"""

import numpy
from sweep import Sweep, smooth, trilinear, unit

POSITIONS = 30
FARTHEST = 9.0  # mm and degrees
RIDGE = 1e-5  # variance below which a volume is flat
NEIGHBOURS = [numpy.roll([side, 0, 0], axis) for axis in range(3) for side in (2, -2)]
PAIRS = [(a, b) for a in range(6) for b in range(a + 1, 6) if a // 2 != b // 2]


def box(values, radius):
    """Means over boxes."""
    for axis in range(3):
        padded = numpy.pad(values, [(radius, radius) if a == axis else (0, 0) for a in range(3)],
                           "edge")
        lines, count = numpy.moveaxis(padded, axis, 0), values.shape[axis]
        values = numpy.moveaxis(sum(lines[i : i + count] for i in range(2 * radius + 1)), 0, axis)
    return values / (2 * radius + 1) ** 3


def self_similarity(values):
    """The 12 numbers of each point (SSC), at a distance of two points."""
    at = [numpy.roll(values, by, (0, 1, 2)) for by in NEIGHBOURS]
    numbers = numpy.stack([box((at[a] - at[b]) ** 2, 1) for a, b in PAIRS], -1)
    noise = numbers.mean(-1, keepdims=True)
    noise = numpy.clip(noise, 0.01 * noise.mean(), 1000 * noise.mean())
    return numpy.exp((numbers.min(-1, keepdims=True) - numbers) / noise)


def steepness(values):
    return numpy.linalg.norm(numpy.gradient(values), axis=0)


def ssc_cost(volume, reference, inside):
    apart = (self_similarity(volume) - reference) ** 2
    return apart.mean(-1)[inside].mean()


def lc2_cost(volume, reference, inside, radius):
    """What a line of the volume's values and their steepness leaves of the reference's variance."""
    edges = steepness(volume)
    means = [box(values, radius) for values in (volume, edges, reference)]

    def covariance(a, b):
        values = (volume, edges, reference)
        return box(values[a] * values[b], radius) - means[a] * means[b]
    pp, gg, pg = covariance(0, 0) + RIDGE, covariance(1, 1) + RIDGE, covariance(0, 1)
    vp, vg, vv = covariance(0, 2), covariance(1, 2), covariance(2, 2)
    explained = (vp * (vp * gg - vg * pg) + vg * (vg * pp - vp * pg)) / (pp * gg - pg * pg)
    return 1 - (explained / (vv + 0.02 * vv[inside].mean()))[inside].mean()


class Compared:
    """A sweep and its MR on a grid of the sweep's axes, one spacing."""

    def __init__(self, made, contrast, spacing_mm):
        self.made, self.every = made, round(spacing_mm / 0.5)
        self.values, self.affine = made.mr(contrast)
        self.values = smooth(self.values, 0.4 * spacing_mm / numpy.diag(self.affine)[2::-1])
        self.local = made.local[(slice(None, None, self.every),) * 3]
        weight = smooth(made.fan.astype(numpy.float32), 0.8 * self.every)
        filled = smooth(made.ultrasound * made.fan.astype(numpy.float32), 0.8 * self.every)
        known = smooth(filled, 8), smooth(weight, 8)
        filled = numpy.where(weight > 0.25, filled / (weight + 1e-6),
                             known[0] / (known[1] + 1e-3))
        picked = (slice(None, None, self.every),) * 3
        self.reference = filled[picked].astype(numpy.float32) / 255
        inside = made.fan[picked]
        self.inside = box(inside.astype(numpy.float32), 1) > 0.99

    def volume(self, motion):
        """The MR at the sweep's points, moved rigidly about its middle: matrix and shift."""
        rotation, shift = motion
        at = (self.local - self.made.centre) @ rotation.T + self.made.centre + shift
        world = self.made.world(at)
        points = (world - self.affine[:3, 3]) @ numpy.linalg.inv(self.affine[:3, :3]).T
        return trilinear(self.values, points)


def rotation_about(turn):
    angle = numpy.linalg.norm(turn)
    x, y, z = unit(turn) if angle else turn
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1 - numpy.cos(angle)) * cross @ cross


def positions(made, random):
    """The best rigid position of the MR, and others: rotation and shift in the sweep's axes."""
    rest = (made.rest - made.affine[:3, 3]) @ made.axes - made.centre
    measured = (made.measured - made.affine[:3, 3]) @ made.axes - made.centre
    a, b = measured - measured.mean(0), rest - rest.mean(0)
    u, _, v = numpy.linalg.svd(a.T @ b)
    rotation = (u @ v).T
    shift = rest.mean(0) - rotation @ measured.mean(0)
    result = [(rotation, shift)]
    for _ in range(POSITIONS):
        turn = numpy.radians(FARTHEST) * random.uniform(-1, 1, 3) / numpy.sqrt(3)
        away = unit(random.normal(size=3)) * random.uniform(3, FARTHEST)
        result.append((rotation_about(turn) @ rotation, shift + away))
    return result


def separations(made, contrast):
    """For each cost, how clearly the right position stands out."""
    fine, coarse = (Compared(made, contrast, spacing) for spacing in (1.0, 2.0))
    numbers = self_similarity(fine.reference)
    coarse_numbers = self_similarity(coarse.reference)
    edges = self_similarity(steepness(fine.reference))
    costs = {name: [] for name in ("LC2, 2 mm", "LC2, 1 mm, 7 points", "LC2, 1 mm, 5 points",
                                   "SSC, 1 mm", "SSC, 2 mm", "SSC of gradients, 1 mm")}
    for motion in positions(made, numpy.random.default_rng((made.seed, 99))):
        volume, large = fine.volume(motion), coarse.volume(motion)
        for name, cost in zip(costs, (
                lc2_cost(large, coarse.reference, coarse.inside, 3),
                lc2_cost(volume, fine.reference, fine.inside, 3),
                lc2_cost(volume, fine.reference, fine.inside, 2),
                ssc_cost(volume, numbers, fine.inside),
                ssc_cost(large, coarse_numbers, coarse.inside),
                ssc_cost(steepness(volume), edges, fine.inside))):
            costs[name].append(cost)
    return {name: (numpy.mean(cost[1:]) - cost[0]) / numpy.std(cost[1:])
            for name, cost in costs.items()}


def print_separations(heads, seeds):
    found = {}
    for seed in seeds:
        made = Sweep(heads[seed % len(heads)], seed)
        for contrast in ("t1", "flair"):
            for name, value in separations(made, contrast).items():
                found.setdefault((contrast, name), []).append(value)
    for (contrast, name), values in found.items():
        print(f"separation, {contrast}, {name}: {numpy.median(values):.1f} "
              f"({min(values):.1f} to {max(values):.1f})")
