# SPDX-License-Identifier: BSD-3-Clause
"""Judges a deformation by landmarks that were not used to find it."""

from .fitting import _names, _point_axes, _points
from .maps import deformed_from_rest
from .views import warn_of_axes


class TargetErrors:
    """The result of `tre`. Lengths are mm.

    - `errors`: the target registration error of each pair: the distance of the deformed landmark
      from its measured position
    - `before`: the same without the deformation
    - `names`: the names of the pairs; empty if they were paired by order
    - `mean`, `median`, `rms`, `largest`: of `errors`
    - `unpaired`: names on one list only, and points without a name where others have one, such as
      "point 2 of rest"

    Printed, it is a line of figures.
    """

    def __init__(self, errors, before, names, unpaired):
        import numpy

        self.errors, self.before = errors, before
        self.names, self.unpaired = names, unpaired
        self.mean, self.median = float(errors.mean()), float(numpy.median(errors))
        self.rms, self.largest = float(numpy.sqrt((errors ** 2).mean())), float(errors.max())

    def __repr__(self):
        return (f"TargetErrors: {self.mean:.2f} mm on average, {self.median:.2f} mm median, "
                f"{self.largest:.2f} mm at most, of {len(self.errors)} landmarks; without the "
                f"deformation {self.before.mean():.2f} mm on average, {self.before.max():.2f} mm "
                "at most" + (f"; {len(self.unpaired)} without a partner" if self.unpaired else ""))


def _unique(name, names):
    twice = sorted({one for one in names if one and names.count(one) > 1})
    if twice:
        raise ValueError(f"{name} has the name {twice[0]!r} twice; a name must be unique")
    return {one: index for index, one in enumerate(names) if one}


def _nameless(name, names):
    return [f"point {index + 1} of {name}" for index, one in enumerate(names) if not one]


def _paired(rest, measured, by_order):
    """The two arrays in the order of pairs, the names of these, and the names without a partner."""
    places, targets = _points("rest", rest), _points("measured", measured)
    names = {} if by_order else _unique("rest", _names(rest))
    others = {} if by_order else _unique("measured", _names(measured))
    if names and others:
        common = [name for name in names if name in others]
        if not common:
            raise ValueError("no name is both in rest and in measured; by_order=True pairs "
                             "landmarks by their order")
        alone = [name for name in (*names, *others) if name not in names or name not in others]
        alone += _nameless("rest", _names(rest)) + _nameless("measured", _names(measured))
        return (places[[names[name] for name in common]],
                targets[[others[name] for name in common]], common, alone)
    if len(places) != len(targets):
        raise ValueError(f"rest has {len(places)} points and measured {len(targets)}; they must "
                         "have the same number")
    if len(places) == 0:
        raise ValueError("rest and measured are empty; there is no landmark")
    return places, targets, [], []


def tre(filter, rest, measured, by_order=False):
    """Measure the target registration error: how far landmarks are from where they were measured.

    Take landmarks that had no part in the registration: errors of landmarks that a fit used are
    smaller than those of other tissue. A landmark is found again to within about 0.5 to 1 mm, so
    smaller errors say nothing.

    - `filter`: a Free-Form Deformation, for example after `refine`.
    - `rest`: landmarks in the volume, as it was loaded: an N x 3 array in mm, or a result of
      `read_points`.
    - `measured`: the same landmarks in the reference, at its present position: an N x 3 array in
      mm in the same order, or a result of `read_points`. After `align`, move them by the `matrix`
      of its result first.
    - `by_order`: True pairs landmarks by their order, whatever their names. The default, False,
      pairs results of `read_points` by name if both have names; points without a name are then
      unpaired.

    Returns a `TargetErrors`. Warns if results of `read_points`, which are RAS, and the volume have
    other world axes, or those of the volume are unknown.

    Raises `ValueError` if an array has another shape, the numbers of points differ, or no name is
    on both lists.
    """
    import numpy

    if _point_axes(rest, measured):
        warn_of_axes(filter, "the landmarks", "RAS")
    places, targets, names, unpaired = _paired(rest, measured, by_order)
    found = deformed_from_rest(filter, places)
    return TargetErrors(numpy.linalg.norm(found - targets, axis=1),
                        numpy.linalg.norm(places - targets, axis=1), names, unpaired)
