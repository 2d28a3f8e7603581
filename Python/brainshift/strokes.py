# SPDX-License-Identifier: BSD-3-Clause
"""Makes the strokes that deform a volume. See Filters/Deformation/Stroke.h for their numbers."""

import math

from .arguments import at_least, positive
from .arguments import vector as _vector

#: The first number of a stroke: which tool made it.
MOVE, SOFT, STAMP = 0, 1, 2

#: Least `sigma` of Soft and Stamp.
SMALLEST_SIGMA = 0.001

#: How many numbers one stroke has.
NUMBERS_PER_STROKE = 14


def _stroke(tool, anchor, displacement, axis, shape):
    """The 14 numbers of a stroke. `shape`: its major and minor radius and its sigma."""
    enabled = 1
    return (tool, *anchor, *displacement, *axis, *shape, enabled)


# A move has no ellipsoid. So its axis holds the spacing, and its major radius the largest spacing.
def move(anchor, vector, spacing=(0.0, 0.0, 0.0)):
    """Make a stroke that moves one control point.

    - `anchor`: three numbers in mm, rest frame. The control point nearest to it moves.
    - `vector`: three numbers in mm, the displacement of that control point.
    - `spacing`: three numbers in mm, the distances between control points along the axes of the
      lattice that the stroke was made for. A denser lattice then moves tissue as that lattice
      did. The default, 0 0 0, takes the spacing of the lattice that replays the stroke.

    Returns a tuple of 14 numbers.

    Raises `ValueError` if an argument does not have three finite numbers.
    """
    spacing = _vector("spacing", spacing)
    return _stroke(MOVE, _vector("anchor", anchor), _vector("vector", vector), spacing,
                   (max(spacing), 0.0, 0.5))


def soft(anchor, vector, radius, sigma=0.5):
    """Make a stroke that moves all control points near a position.

    - `anchor`: three numbers in mm, deformed frame. The centre of the sphere that moves.
    - `vector`: three numbers in mm, the displacement at the centre. Control points farther out
      move less, by a Gaussian of their distance that falls smoothly to 0 at `radius`.
    - `radius`: above 0 mm.
    - `sigma`: at least 0.001, the width of the Gaussian as a fraction of `radius`. The default is
      0.5.

    Returns a tuple of 14 numbers.

    Raises `ValueError` if an argument is not finite or not within its limit.
    """
    return _stroke(SOFT, _vector("anchor", anchor), _vector("vector", vector), (0.0, 0.0, 0.0),
                   (positive("radius", radius), 0.0, at_least(SMALLEST_SIGMA, "sigma", sigma)))


def stamp(anchor, toward, amount, major=40.0, minor=25.0, sigma=0.5):
    """Make a stroke that pulls tissue away from a point of interest, or pushes tissue towards it.

    The stroke acts inside an ellipsoid around `anchor`. The long axis of the ellipsoid points at
    `toward`.

    - `anchor`: three numbers in mm, deformed frame. The centre of the ellipsoid.
    - `toward`: three numbers in mm, deformed frame. The point of interest. It must differ from
      `anchor`.
    - `amount`: displacement at the centre in mm. Above 0 pulls tissue away from the point of
      interest. Below 0 pushes tissue towards it.
    - `major`: above 0 mm, the radius along the long axis. The default is 40 mm.
    - `minor`: above 0 mm, the radius across the long axis. The default is 25 mm.
    - `sigma`: at least 0.001, the width of the Gaussian as a fraction of the radii. The default is
      0.5.

    Returns a tuple of 14 numbers.

    Raises `ValueError` if an argument is not finite or not within its limit, or if `anchor` and
    `toward` are the same position.
    """
    anchor = _vector("anchor", anchor)
    toward = _vector("toward", toward)
    away = tuple(a - t for a, t in zip(anchor, toward))
    length = math.sqrt(sum(value * value for value in away))
    if length == 0.0:
        raise ValueError(f"anchor and toward are both {anchor}; they must differ")
    amount = float(amount)
    displacement = _vector(
        "amount times direction", (amount * value / length for value in away))
    axis = tuple(-value / length for value in away)
    return _stroke(STAMP, anchor, displacement, axis,
                   (positive("major", major), positive("minor", minor),
                    at_least(SMALLEST_SIGMA, "sigma", sigma)))
