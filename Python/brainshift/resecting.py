# SPDX-License-Identifier: BSD-3-Clause
"""How much of a tumour is left after a resection that moved the brain."""

from .casesources import kept, stem
from .fitting import Fit, away_from_fit, is_kind, rigid_of
from .images import Labels, fetched, interpolated, source_of
from .maps import deformed_from_rest, rest_from_deformed
from .views import warn_of_axes, world_axes

#: Distances (mm) at which the deformation and its draws are evaluated; linear in between. The
#: covariance of a fit falls over 60 mm, a cell of a usual lattice has 10 mm.
_MAP_MM, _DRAW_MM = 2.0, 10.0

#: Most positions on which the draws are computed together.
_MOST_DRAWN = 600

#: Samples of the tumour for its volumes, and for each draw.
_SAMPLES, _DRAW_SAMPLES = 400_000, 40_000

#: Draws that are taken before too many folds are an error, for each field that is wanted.
_MOST_TRIES = 4

#: Labels of the tissue that is left and of that which was removed.
LEFT, REMOVED = 1, 2

#: Fraction of the bias of the draws by which volumes are corrected. The draws of a fit to traces
#: are wider than its errors, for little is known of sliding: on 24 synthetic cases that no test
#: uses, half had the least mean error, 0.66 ml; without any it was 0.81 ml, with all 0.69 ml.
_CORRECTED = 0.5

_ML = 1000.0  # mm^3


class Resection:
    """The result of `resect`. Volumes are ml of tumour at rest, so `before` is the sum of `removed`
    and `left`.

    - `before`: volume of the tumour's labels
    - `removed`, `left`: volume that came to lie in the cavity, and the rest of it. With a fit they
      are corrected for its bias by half of what the draws say: a deformation that is a little off
      takes less tumour into a cavity that was made for it.
    - `left_by_fit`: volume that is left by the deformation as it is, which the maps show
    - `left_interval`, `removed_interval`: lowest and highest volume that the measurements allow at
      the `level`, or `None` without a fit
    - `level`: probability that the interval holds the volume, 0 to 1
    - `fields`: number of drawn deformations; `folded`: number of those left out because they fold
    - `left_after`: `left_by_fit` in the deformed frame, where tissue may be squeezed or stretched
    - `reason`: why there is no interval, or an empty text
    - `map`, `map_after`: labels of the tumour, each a vtkImageData: 1 is left, 2 was removed. The
      first is at rest, on the grid of the tumour. The other is in the deformed frame, on the grid
      of the cavity: removed tissue is where it would be.

    Printed, it is a line of figures.
    """

    def __init__(self):
        self.before = self.removed = self.left = self.left_by_fit = self.left_after = 0.0
        self.left_interval = self.removed_interval = None
        self.level, self.fields, self.folded, self.reason = 0.9, 0, 0, ""
        self.map = self.map_after = None

    def __repr__(self):
        bounds = (f", {100 * self.level:.0f} % interval {self.left_interval[0]:.2f} to "
                  f"{self.left_interval[1]:.2f} ml of {self.fields} fields"
                  if self.left_interval else f" ({self.reason})")
        return (f"Resection: {self.before:.2f} ml before, {self.removed:.2f} ml removed, "
                f"{self.left:.2f} ml left{bounds}")

    def save(self, name, frame="rest", world=None):
        """Save the labels of the tumour, 1 left and 2 removed.

        - `frame`: `"rest"`, the default, or `"deformed"`
        - `name`, `world`: as in `save_volume`

        Raises `ValueError` for another frame, and `OSError` with the reason if the file is not
        written, also while a server is connected.
        """
        from paraview import simple

        from .files import save_volume

        maps = {"rest": self.map, "deformed": self.map_after}
        if frame not in maps:
            raise ValueError(f'frame is {frame!r}; it must be "rest" or "deformed"')
        active = simple.GetActiveSource()
        source = source_of(maps[frame], OSError(
            f"{name} was not written: the server writes files, and gets no map from here. "
            "Disconnect from the server, and save then"))
        try:
            save_volume(source, name, world=world)
        finally:
            simple.Delete(source)
            simple.SetActiveSource(active)


def pose_of(compare):
    """The motion of the reference of a Compare Volumes, a 4 x 4 matrix (mm, world axes)."""
    import numpy

    low_x, high_x, low_y, high_y, low_z, high_z = (
        compare.Reference.GetDataInformation().GetBounds())
    middle = numpy.array((low_x + high_x, low_y + high_y, low_z + high_z)) / 2.0
    turn = numpy.eye(3)
    for axis, degrees in enumerate(compare.ReferenceRotation):  # about x, then y, then z
        c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
        about, (i, j) = numpy.eye(3), ((1, 2), (2, 0), (0, 1))[axis]
        about[i, i] = about[j, j] = c
        about[i, j], about[j, i] = -s, s
        turn = about @ turn
    motion = numpy.eye(4)
    motion[:3, :3] = turn
    motion[:3, 3] = middle - turn @ middle + numpy.array(compare.ReferenceTranslation)
    return motion


class _Field:
    """Positions in the deformed frame, on a grid over the tumour, linear in between.

    `low`, `high`: indices of the tumour's voxels that the grid covers; `step_mm`: about the
    distance of its points.
    """

    def __init__(self, tumour, low, high, step_mm):
        import numpy

        self.tumour, self.low = tumour, low.astype(float)
        cells = numpy.maximum(1, numpy.ceil((high - low) * tumour.sides / step_mm)).astype(int)
        self.step = numpy.maximum((high - low) / cells, 1e-9)
        z, y, x = numpy.indices(cells[::-1] + 1).reshape(3, -1)
        self.shape = tuple(cells[::-1] + 1)
        self.rest = tumour.positions(self.low + self.step * numpy.stack((x, y, z), axis=1))

    def at(self, values, indices):
        """`values` of the grid's points at N x 3 indices of the tumour."""
        return interpolated(values.reshape(*self.shape, -1), (indices - self.low) / self.step)

    def determinants(self, deformed):
        """Jacobian determinants of the deformation at the grid's points."""
        import numpy

        grid = deformed.reshape(*self.shape, 3)
        steps = [numpy.gradient(grid, axis=axis) for axis in (2, 1, 0)]  # x, y, z
        cell = numpy.linalg.det(self.tumour.world[:3, :3]) * self.step.prod()
        return numpy.linalg.det(numpy.stack(steps, axis=-1)).ravel() / cell


def _samples(tumour, most):
    """Places in the tumour for sums over it: N x 3 indices, and the volume (mm^3) of tumour that
    each stands for. Voxels are divided as finely as `most` allows, and thinned beyond it."""
    import numpy

    low, high = tumour.box(margin=1)
    z, y, x = numpy.indices((high - low + 1)[::-1]).reshape(3, -1)
    voxels = low + numpy.stack((x, y, z), axis=1)
    near = tumour.fractions(tumour.positions(voxels.astype(float))) > 0.0
    count = max(1, int(near.sum()))
    parts = int(max(1, min(4, (most / (1.4 * count)) ** (1 / 3))))
    offsets = (numpy.arange(parts) + 0.5) / parts - 0.5
    z, y, x = numpy.meshgrid(offsets, offsets, offsets, indexing="ij")
    offsets = numpy.stack((x, y, z), axis=-1).reshape(-1, 3)
    places = (voxels[:, None] + offsets[None]).reshape(-1, 3)
    fraction = tumour.fractions(tumour.positions(places))
    places, fraction = places[fraction > 0.0], fraction[fraction > 0.0]
    if len(places) > most:
        chosen = numpy.random.default_rng(0).choice(len(places), most, replace=False)
        places, fraction = places[chosen], fraction[chosen]
    total = float(tumour.inside.sum()) * tumour.voxel
    return places, fraction * (total / fraction.sum())


def _spread(bent, fit, field):
    """Factors that widen the draws of a fit where strokes took the tissue elsewhere."""
    import numpy

    deviation = fit.deviation(field.rest)
    away = away_from_fit(bent, fit, field.rest)
    return numpy.sqrt(1.0 + away ** 2 / 3.0 / numpy.maximum(deviation, 1e-6) ** 2)


def _draws(bent, fit, tumour, count, seed):
    """Yields changes of the deformation that the measurements allow: a _Field and its values."""
    low, high = tumour.box(margin=2)
    step = _DRAW_MM
    field = _Field(tumour, low, high, step)
    while len(field.rest) > _MOST_DRAWN:
        step *= 1.25
        field = _Field(tumour, low, high, step)
    factors = _spread(bent, fit, field)[:, None]
    mean = fit.measured_from_rest(field.rest)
    for batch in range(_MOST_TRIES):
        for drawn in fit.draws(field.rest, count, seed + batch):
            yield field, factors * (drawn - mean)


def _evidence(bent):
    """The fit of a deformation, and why there is none."""
    if not is_kind(bent.Lattice, "FitDeformation"):
        return None, ("no interval: the deformation has no fit, so nothing says how uncertain it "
                      "is")
    return Fit(bent.Lattice), ""


def _interval(result, bent, tumour, cavity, count, seed):
    """Gives a result its intervals, from volumes under drawn deformations."""
    import numpy

    fit, result.reason = _evidence(bent)
    if fit is None:
        return
    low, high = tumour.box(margin=2)
    field = _Field(tumour, low, high, _MAP_MM)
    mean = deformed_from_rest(bent, field.rest)
    places, weights = _samples(tumour, _DRAW_SAMPLES)
    start = field.at(mean, places)
    central = float(weights @ cavity.fractions(start))
    removed = []
    for coarse, change in _draws(bent, fit, tumour, count, seed):
        if len(removed) == count:
            break
        own = coarse.at(change, field.tumour.indices(field.rest))
        if field.determinants(mean + own).min() <= 0.0:
            result.folded += 1
            continue
        removed.append(float(weights @ cavity.fractions(start + coarse.at(change, places))))
    if len(removed) < count:
        result.reason = f"no interval: {result.folded} drawn deformations fold"
        return
    result.fields = count
    # Basic bootstrap: a draw is to the fit as the fit is to the truth. A fit that is off takes less
    # tumour into a cavity that was made for it, and draws show how much less.
    tail = (1.0 - result.level) / 2.0
    missed = (central - numpy.quantile(removed, (tail, 0.5, 1.0 - tail))) / _ML
    best = result.removed + _CORRECTED * missed[1]
    ends = min(best, result.removed + missed[2]), max(best, result.removed + missed[0])
    low, best, high = (float(end) for end in numpy.clip((ends[0], best, ends[1]), 0.0,
                                                        result.before))
    result.removed, result.removed_interval = best, (low, high)
    result.left = result.before - best
    result.left_interval = result.before - high, result.before - low


def _marked(tumour, cavity, field, deformed):
    """The label map at rest: 1 left, 2 removed, on the tumour's own grid."""
    import numpy

    labels = numpy.zeros(tumour.inside.shape, numpy.uint8)
    z, y, x = numpy.nonzero(tumour.inside)
    places = numpy.stack((x, y, z), axis=1).astype(float)
    is_removed = cavity.fractions(field.at(deformed, places)) >= 0.5
    labels[z, y, x] = numpy.where(is_removed, REMOVED, LEFT)
    return tumour.image(labels)


def _marked_after(filter, tumour, cavity, deformed):
    """The label map in the deformed frame: 1 left, 2 removed, on the cavity's grid."""
    import numpy

    places = cavity.indices(deformed)
    low, high = numpy.floor(places.min(axis=0)), numpy.ceil(places.max(axis=0))
    back = _Field(cavity, low, high, _MAP_MM)
    rest = rest_from_deformed(filter, back.rest)
    z, y, x = numpy.indices((high - low + 1).astype(int)[::-1]).reshape(3, -1)
    voxels = low + numpy.stack((x, y, z), axis=1)
    is_tumour = tumour.fractions(back.at(rest, voxels)) >= 0.5
    is_removed = cavity.fractions(cavity.positions(voxels)) >= 0.5
    labels = numpy.where(is_tumour, numpy.where(is_removed, REMOVED, LEFT), 0)
    return cavity.image(labels.reshape((high - low + 1).astype(int)[::-1]), low)


def resect(filter, tumour, cavity, tumour_labels=(), cavity_labels=(), compare=None, fields=100,
           level=0.9, seed=0):
    """Find how much of a tumour was removed, and how much is left.

    The deformation takes the labels of the tumour to where its tissue is after the resection. What
    comes to lie in the cavity was removed. Voxels count by the fraction of them that does. The
    interval is a basic bootstrap of deformations that are drawn from the process of the fit
    (`Fit.draws`); those that fold are left out. It holds the uncertainty of the deformation, not
    that of the two outlines.

    - `filter`: a Free-Form Deformation, from before to after the resection.
    - `tumour`: a ParaView source of labels in the rest frame, on any grid.
    - `cavity`: a ParaView source of labels in the deformed frame, on any grid: the cavity, or the
      labels of a post-operative segmentation with it.
    - `tumour_labels`, `cavity_labels`: the labels that count. Empty, the default: all above 0.
    - `compare`: a Compare Volumes whose reference the cavity was drawn in. The cavity moves with
      the reference. The default, `None`, leaves it where it is.
    - `fields`: number of drawn deformations, at least 50. Default 100.
    - `level`: probability of the interval, above 0 and below 1. Default 0.9.
    - `seed`: a number. The same seed draws the same. Default 0.

    Returns a `Resection`. Without a fit it has no interval and says why.

    Raises `ValueError` if an argument is out of its range, an input is no image of labels, no voxel
    has the labels, or the fit has a rigid motion: one to landmarks alone keeps it apart from the
    deformation, so the tumour and the cavity would not lie in one frame.
    """
    if int(fields) < 50:
        raise ValueError(f"fields is {fields}; it must be at least 50")
    if not 0.0 < level < 1.0:
        raise ValueError(f"level is {level}; it must be above 0 and below 1")
    filter.UpdatePipeline()
    if rigid_of(filter.Lattice) is not None:
        raise ValueError("the fit to landmarks has a rigid motion that is not in the deformation, "
                         "so the tumour would not be compared with the cavity where it is: align "
                         "the reference, its cavity and the measured landmarks with the volume")
    for source, noun in ((tumour, "the tumour"), (cavity, "the cavity")):
        warn_of_axes(filter, noun, world_axes(source))
    before = Labels(fetched(tumour), tumour_labels)
    removed = Labels(fetched(cavity), cavity_labels)
    if compare is not None:
        removed = removed.moved(pose_of(compare))
    result = Resection()
    result.level = float(level)
    field = _Field(before, *before.box(margin=2), _MAP_MM)
    deformed = deformed_from_rest(filter, field.rest)
    places, weights = _samples(before, _SAMPLES)
    fraction = removed.fractions(field.at(deformed, places))
    size = field.at(field.determinants(deformed), places)[:, 0]
    result.before = float(weights.sum()) / _ML
    result.removed = float(weights @ fraction) / _ML
    result.left = result.left_by_fit = result.before - result.removed
    result.left_after = float((weights * size) @ (1.0 - fraction)) / _ML
    _interval(result, filter, before, removed, int(fields), int(seed))
    result.map = _marked(before, removed, field, deformed)
    result.map_after = _marked_after(filter, before, removed, deformed)
    return result


class Resections:
    """The resection of a `Case`, which derives from this."""

    @kept
    def resect(self, **settings):
        """Find how much tumour is left: see `brainshift.resect` for the settings.

        Returns a `Resection`, also kept as `resection`. Raises `ValueError` without a volume, a
        tumour and a cavity.
        """
        self._require("volume", "tumour", "cavity")
        self.resection = resect(
            self.bent, self.tumour, self.cavity, tumour_labels=self.tumour_labels,
            cavity_labels=self.cavity_labels, compare=self.comparison, **settings)
        self._left = repr(self.resection).removeprefix("Resection: ")
        self._left_by = {name: (float if name == "level" else int)(value)
                         for name, value in settings.items()}  # also of numpy
        return self.resection

    @kept
    def known_resection(self):
        """`resection`, measured again with its settings if a state has kept no more than these and
        its line; None if there is none."""
        if self.resection is None and self._left:
            self.resect(**self._left_by)
        return self.resection

    def show_resection(self, view=None, look=None):
        """Show the bent volume after its resection in a render view, in place of the whole one.

        Removed tissue is cut away through the bend, and tumour that is left is coloured. The source
        "T1 resection", a Resection filter, follows strokes, fits and roles from then on.

        - `view`, `look`: see `show`

        Returns the representation. Raises `ValueError` without a volume, a tumour and a cavity.
        """
        from paraview import simple

        self._require("volume", "tumour", "cavity")
        view = view or simple.GetActiveViewOrCreate("RenderView")
        source = self.part("resected")
        if source is None:
            source = self._made("resected", "Resection", f"{stem(self.volume)} resection",
                                Input=self.bent)
            self._wire_resection()
        self.hide_other_moments(view)
        simple.Hide(self.bent, view)
        if self.comparison is not None:
            simple.Hide(self.comparison, view)
        return self._shown(source, view, look)

    def _require(self, *roles):
        missing = [role for role in roles if getattr(self, role) is None]
        if missing:
            raise ValueError(f"the resection lacks a {missing[0]}")

    def _wire_resection(self):
        """Makes the source of the pictures follow the roles. Without tumour and cavity it goes."""
        source = self.part("resected")
        if source is None:
            return
        if self.tumour is None and self.cavity is None:
            self._made("resected", "", "", Input=None)
            return
        compared = None not in (self.reference, self.comparison, self.cavity)
        self._set(source, {
            "Input": self.comparison if compared else self.bent, "Tumour": self.tumour,
            "TumourLabels": self.tumour_labels, "Cavity": None if compared else self.cavity,
            "CavityLabels": self.cavity_labels})
