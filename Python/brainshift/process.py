# SPDX-License-Identifier: BSD-3-Clause
"""Draws fields from the Gaussian process of a fit, as `Filters/Fit/Process.h` defines it.

A row measures one component of the displacement: a position (mm, rest frame), a unit axis and a
variance (mm^2). `rows` is an array of such rows, 7 numbers each.
"""


def _matern(left, right, length, deviation):
    """Matern covariances (mm^2), smoothness 5/2, of N and M positions (mm): an N x M array."""
    import numpy

    squares = ((left ** 2).sum(axis=1)[:, None] + (right ** 2).sum(axis=1)[None]
               - 2.0 * left @ right.T)
    scaled = numpy.sqrt(5.0 * numpy.maximum(squares, 0.0)) / length
    return deviation ** 2 * (1.0 + scaled + scaled ** 2 / 3.0) * numpy.exp(-scaled)


def posterior(rows, covariance, points):
    """The covariance (mm^2) of the displacements that the rows leave open.

    - `covariance`: length and standard deviation (mm) of the process before any row
    - `points`: N x 3 positions in mm, rest frame

    Returns a 3N x 3N matrix: x, y and z of the first point, then those of the second.
    """
    import numpy

    middle = points.mean(axis=0)  # keeps the squares small where coordinates are large
    places = points - middle
    prior = numpy.kron(_matern(places, places, *covariance), numpy.eye(3))
    if len(rows) == 0:
        return prior
    at, axes, variances = rows[:, :3] - middle, rows[:, 3:6], rows[:, 6]
    measured = _matern(at, at, *covariance) * (axes @ axes.T) + numpy.diag(variances)
    shared = (_matern(at, places, *covariance)[:, :, None] * axes[:, None, :]).reshape(
        len(rows), -1)
    return prior - shared.T @ numpy.linalg.solve(measured, shared)


def drawn(covariance, count, random):
    """Draws from a normal distribution with mean 0 and this 3N x 3N covariance: count x N x 3."""
    import numpy

    variances, directions = numpy.linalg.eigh(covariance)
    spread = directions * numpy.sqrt(numpy.maximum(variances, 0.0))  # rounding makes some negative
    return (random.standard_normal((count, len(spread))) @ spread.T).reshape(count, -1, 3)
