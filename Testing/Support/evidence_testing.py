# SPDX-License-Identifier: BSD-3-Clause
"""A white box bent by a fit, and the classes that its pictures show."""

import brainshift
import numpy
from brainshift_testing import volume
from paraview import simple

LIMITS = (1.0, 2.0, 4.0)  # mm
SIDE, SPACING = 41, 4.0
MIDDLE = (SIDE - 1) / 2 * SPACING
NEAR = 0.03  # share of a limit: the graphics card reads weights of 8 bits


def white(components=1, labels=False):
    """A volume that is white everywhere."""
    shape = (SIDE,) * 3 + ((components,) if components > 1 else ())
    kind = numpy.int16 if labels else numpy.float32
    return volume(numpy.full(shape, 100, kind), spacing=(SPACING,) * 3)


def pulled(source=None, low=-40.0, high=10.0, **properties):
    """A volume that 6 pulls bend, and the fit, with its evidence. `low`, `high`: where they are
    along each axis, mm from the middle."""
    bent = simple.FreeFormDeformation(Input=source or white(), **properties)
    start = MIDDLE + numpy.random.default_rng(4).uniform(low, high, (6, 3))
    fit = brainshift.fit(bent, pulls=[(point, point + (3.0, 2.0, -4.0)) for point in start])
    fit.filter.Evidence = 1
    bent.UpdatePipeline()
    return bent, fit


def class_of(deviation):
    """The class of a deviation; None near the limit of two."""
    if any(abs(deviation - limit) < NEAR * limit for limit in LIMITS):
        return None
    return sum(deviation >= limit for limit in LIMITS)


def class_of_color(red, green, blue):
    """The class that a colour of white tissue shows."""
    if min(red, green, blue) > 0.98:
        return 0
    if max(red, green, blue) - min(red, green, blue) < 0.02 or green < min(red, blue):
        return 3  # dark, or a stripe
    return 1 if red < blue else 2


def deviation_by_hand(bent, fit, rest):
    """Deviations at rest positions, trilinear between those of the fit at the control points."""
    sides = numpy.array(bent.LatticeDimensions)
    place = numpy.clip(numpy.asarray(rest) / (2 * MIDDLE), 0, 1) * (sides - 1)
    low = numpy.minimum(place.astype(int), sides - 2)
    total = numpy.zeros(len(place))
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.where(corner, place - low, 1 - (place - low)).prod(axis=1)
        total += weight * fit.deviation((low + corner) / (sides - 1) * 2 * MIDDLE)
    return total


def check_classes(bent, fit, display, view, shown, least, step=7):
    """Picks pixels; each has the class of its tissue at rest. All four are there, or `least`."""
    places, colors = [], []
    for row in range(3, shown.shape[0], step):
        for column in range(3, shown.shape[1], step):
            place = brainshift.pick(display, view, column, row)
            if place is not None:
                places.append(place)
                colors.append(shown[row, column])
    rest = brainshift.rest_from_deformed(bent, places)
    found = []
    for deviation, color in zip(deviation_by_hand(bent, fit, rest), colors):
        asked = class_of(deviation)
        if asked is not None:
            assert class_of_color(*color) == asked, (deviation, color)
            found.append(asked)
    assert len(found) > 100 and len(set(found)) >= least, (len(found), set(found))
