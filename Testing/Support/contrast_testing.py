# SPDX-License-Identifier: BSD-3-Clause
"""Scans of another contrast, made from a T1 as a scanner differs: tissue by tissue.

An inverted T1 flatters methods that expect the reference to be a line of the volume. Here each
tissue gets a value of its own that varies from place to place, with texture, lesions, bias and
noise that the T1 lacks. Slices may be thick.
"""

import numpy

#: Values of fluid, grey and white matter, and lesions relative to what is around.
CONTRASTS = {"FLAIR": (0.12, 0.75, 0.55), "T2": (1.0, 0.6, 0.4)}
LESION = 0.35
LESIONS = 3
VARIES = 0.1  # standard deviation of a tissue's value between regions
REGION = 40  # voxels
TEXTURE = 0.05  # standard deviation
GRAIN = 4  # voxels
BIAS = 0.2  # standard deviation
NOISE = 0.02  # standard deviation
AIR = 0.06  # fraction of the brightest; darker is air


def smooth_noise(random, shape, period):
    """Noise of mean 0 and deviation 1 that is smooth over `period` voxels."""
    noise = random.normal(size=[side // period + 5 for side in shape])
    for axis, side in enumerate(shape):
        at = numpy.arange(side) / period + 1
        low = at.astype(int)
        t = at - low
        weights = ((1 - t) ** 2 / 2, 0.5 + t - t * t, t * t / 2)  # a B-spline of second degree
        sides = [1, 1, 1]
        sides[axis] = side
        noise = sum(weight.reshape(sides) * numpy.take(noise, low + step, axis)
                    for step, weight in enumerate(weights))
    return ((noise - noise.mean()) / noise.std()).astype(numpy.float32)


def tissue_fractions(values, top):
    """For each voxel its fractions of fluid, grey and white matter, by k-means of the values."""
    some = values[values > AIR * top][::10]
    middles = numpy.percentile(some, [2, 35, 85])
    for _ in range(15):
        nearest = numpy.abs(some[:, None] - middles).argmin(axis=1)
        middles = numpy.array([some[nearest == i].mean() for i in range(3)])
    width = 0.45 * numpy.diff(middles).mean()
    fractions = [numpy.exp(-((values - middle) / width) ** 2) + 1e-6 for middle in middles]
    fractions[0][values < middles[0]] = 1.0
    return numpy.array(fractions, numpy.float32) / sum(fractions)


def add_lesions(values, tissue, random):
    places = numpy.argwhere(tissue)
    indices = numpy.indices(values.shape, numpy.float32)
    for _ in range(LESIONS):
        middle = places[random.integers(len(places))]
        distance = numpy.sqrt(sum((index - at) ** 2 for index, at in zip(indices, middle)))
        beyond = numpy.minimum(distance - random.uniform(3, 8), 50)  # so that exp stays finite
        values += LESION / (1 + numpy.exp(beyond))


def another_scan(values, contrast, seed):
    """A T1, indexed [z, y, x], in one of `CONTRASTS`."""
    random = numpy.random.default_rng(seed)
    top = numpy.percentile(values, 99.5)
    fractions = tissue_fractions(values, top)
    scan = sum(value * (1 + VARIES * smooth_noise(random, values.shape, REGION)) * fraction
               for value, fraction in zip(CONTRASTS[contrast], fractions))
    scan *= 1 + TEXTURE * smooth_noise(random, values.shape, GRAIN)
    tissue = values > AIR * top
    add_lesions(scan, tissue, random)
    scan *= 1 + BIAS * smooth_noise(random, values.shape, 3 * REGION)
    scan *= numpy.clip(values / (AIR * top), 0, 1)
    return (scan + random.normal(0, NOISE, scan.shape)).astype(numpy.float32)


def thick_slices(values, origin, spacing, voxels):
    """Means of so many slices along z, with their origin and spacing."""
    count = len(values) // voxels
    means = values[:count * voxels].reshape(count, voxels, *values.shape[1:]).mean(axis=1)
    middle = origin + numpy.array((0, 0, 0.5 * (voxels - 1) * spacing[2]))
    return means.astype(numpy.float32), middle, (*spacing[:2], voxels * spacing[2])
