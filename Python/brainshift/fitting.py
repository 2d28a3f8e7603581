# SPDX-License-Identifier: BSD-3-Clause
"""Fits a deformation to measurements, with its uncertainty."""

from .casesources import result_name
from .files import reason_of
from .reports import numbers

#: The annotation of sources that BrainShift made; the window uses the same one.
_MADE = "BrainShiftFit"

#: Most positions of one draw: their covariance takes 72 MB.
_MOST_DRAWN = 1000

#: The inputs that are made from arrays, and their names in the pipeline.
_INPUTS = {"RestLandmarks": "Landmarks At Rest", "MeasuredLandmarks": "Measured Landmarks",
           "Traces": "Traced Points"}


def _points(name, values):
    """`values`, an array or a result of `read_points`, as an N x 3 array of finite numbers."""
    import numpy

    values = getattr(values, "positions", values)
    array = numpy.empty((0, 3)) if values is None else numpy.asarray(values, float)
    if array.size == 0:
        return numpy.empty((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has the shape {array.shape}; it must be N x 3")
    if not numpy.isfinite(array).all():
        raise ValueError(f"{name} holds a number that is not finite")
    return array


def _names(values):
    """The names of landmarks in a result of `read_points`; none of an array."""
    labels = list(getattr(values, "labels", ()))
    return labels if any(labels) else []


def _point_axes(*lists):
    """The properties that say where the axes of points lead, which a list of numbers does not."""
    is_read = any(hasattr(values, "labels") for values in lists)  # results of read_points are RAS
    return {"PointAxes": "RAS"} if is_read else {}


def rigid_of(lattice):
    """The rigid motion of a fit that is not in its lattice, a 4 x 4 matrix, or None without."""
    import numpy

    if not is_kind(lattice, "FitDeformation"):
        return None
    lattice.SMProxy.UpdatePropertyInformation()
    rigid = numpy.array(numbers(lattice.SMProxy, "Rigid"), float)
    if rigid.size != 16 or numpy.allclose(rigid.reshape(4, 4), numpy.eye(4), rtol=0, atol=1e-3):
        return None
    return rigid.reshape(4, 4)


def _pulls(values):
    """`values` as an N x 2 x 3 array: from, to."""
    import numpy

    array = numpy.empty((0, 2, 3)) if values is None else numpy.asarray(values, float)
    if array.size == 0:
        return numpy.empty((0, 2, 3))
    if array.shape[1:] not in ((2, 3), (6,)):
        raise ValueError(f"pulls has the shape {array.shape}; it must be N x 2 x 3: from, to")
    return array.reshape(-1, 2, 3)


class Fit:
    """The result of `fit`. All numbers are mm, world axes.

    - `filter`: the Fit Deformation, a ParaView source. It is the lattice of the deformation.
    - `rigid`: the rigid part, a 4 x 4 matrix, measured from rest. It is not in the lattice.
    - `residuals`: the distances of the fitted points from their measured positions: first the
      landmarks, then the pulls, then the signed distances of the traced points from the cortex,
      positive outside. NaN for a point that does not count.
    - `landmark_residuals`, `pull_residuals`, `trace_residuals`: each part of it
    - `leave_one_out`: the leave-one-out error of each landmark: the distance between the measured
      landmark and its prediction by a fit without it, before the fold guard and the mask change the
      deformation. NaN for a landmark that the others do not constrain. For one that is switched
      off, the distance to the prediction by this fit.
    - `share`: the fraction of the fitted deformation that the fold guard allowed, 0 to 1. The base
      is not included.
    - `relaxation`: 1, or 1.5 if the guard had to raise the deviations of the measurements
    - `calibration`: the factor on deviations, estimated from the leave-one-out errors
    - `warning`: what to know about the result, such as landmarks without a partner, or landmarks on
      a line, which do not determine a rotation. Empty if there is nothing.

    Printed, it is a line of figures.
    """

    def __init__(self, source):
        import numpy

        self.filter = source
        source.SMProxy.UpdatePropertyInformation()

        def figures(name):
            return numpy.array(numbers(source.SMProxy, name), float)
        self.rigid = figures("Rigid").reshape(4, 4)
        self.landmark_residuals = figures("LandmarkResiduals")
        self.pull_residuals = figures("PullResiduals")
        self.trace_residuals = figures("TraceResiduals")
        self.residuals = numpy.concatenate(
            [self.landmark_residuals, self.pull_residuals, self.trace_residuals])
        self.leave_one_out = figures("LeaveOneOut")
        self.share = source.GetPropertyValue("Share")
        self.relaxation = source.GetPropertyValue("Relaxation")
        self.calibration = source.GetPropertyValue("Calibration")
        self.warning = source.GetPropertyValue("Warning") or ""

    def __repr__(self):
        return "Fit: " + self.line("landmarks", self.left_out())

    def left_out(self):
        """The mean of the leave-one-out errors in words; None if there are none."""
        left_out = self.left_out_of_used
        return f"leave-one-out error {left_out.mean():.2f} mm (mean)" if len(left_out) else None

    def line(self, pairs, left_out):
        """The line of figures.

        - `pairs`: what the landmarks are
        - `left_out`: a leave-one-out error in words, or None
        """
        import numpy

        words = []
        for residuals, name in ((self.landmark_residuals, pairs),
                                (self.pull_residuals, "pulls"),
                                (self.trace_residuals, "traced points")):
            counted = residuals[numpy.isfinite(residuals)]
            if len(counted):
                rms = numpy.sqrt((counted ** 2).mean())
                words.append(f"{len(counted)} {name} with residuals of {rms:.2f} mm (RMS)")
        if left_out:
            words.append(left_out)
        words.append(f"rotation {self.degrees:.1f} degrees")
        words.append(f"applied {100.0 * self.share:.3g} %")
        words.append(f"deviations x {self.calibration:.2f}")
        return ", ".join(words) + (f". {self.warning}" if self.warning else "")

    @property
    def degrees(self):
        """The angle by which the rigid part turns."""
        import numpy

        cosine = (numpy.trace(self.rigid[:3, :3]) - 1.0) / 2.0
        return float(numpy.degrees(numpy.arccos(numpy.clip(cosine, -1.0, 1.0))))

    @property
    def left_out_of_used(self):
        """The leave-one-out errors of the landmarks that the fit uses."""
        import numpy

        is_used = numpy.isfinite(self.landmark_residuals)
        return self.leave_one_out[is_used & numpy.isfinite(self.leave_one_out)]

    def _report(self):
        """A report on the fit, in the process that has it."""
        report = self.filter.SMProxy.GetSessionProxyManager().NewProxy("misc", "FitReport")
        report.UnRegister(None)  # Python holds it
        report.PrototypeOn()  # so that it is no step to undo
        report.GetProperty("Filter").AddProxy(self.filter.SMProxy)
        return report

    def _refused(self):
        problem = reason_of(self.filter)
        return RuntimeError("The fit has no result" + (f": {problem}" if problem else
                            "; it was changed since. Call fit again"))

    def _reported(self, points, name):
        import numpy

        points = _points("points", points)
        if len(points) == 0:
            return numpy.empty(0)
        report = self._report()
        positions = report.GetProperty("Points")
        positions.SetNumberOfElements(points.size)
        for i, number in enumerate(points.ravel()):
            positions.SetElement(i, float(number))
        report.UpdateVTKObjects()
        report.UpdatePropertyInformation(report.GetProperty(name))
        result = numpy.array(numbers(report, name), float)
        if len(result) != len(points) * (3 if name == "Measured" else 1):
            raise self._refused()
        return result

    def measured_from_rest(self, points):
        """Predict measured positions of tissue: deformation and rigid part together.

        - `points`: an N x 3 array of positions in the rest frame.

        Returns an N x 3 array of positions in the measured frame. Strokes are not included.
        """
        return self._reported(points, "Measured").reshape(-1, 3)

    def deviation(self, points):
        """Find the uncertainty of `measured_from_rest`.

        - `points`: an N x 3 array of positions in the rest frame.

        Returns N standard deviations along each axis: infinity if nothing was measured. Changes by
        the fold guard, the mask and the control points are included. A ball with a radius of 2.8
        times the deviation contains the tissue with 95 %. A measured landmark has a measurement
        error as well: its radius is 2.8 times the root of deviation² plus
        (0.7 mm × `calibration`)².
        """
        return self._reported(points, "Deviations")

    def draws(self, points, count=50, seed=0):
        """Draw deformations that the measurements allow, from the process of the fit.

        Neighbours move together, as the fit expects. The draws of one point have
        `measured_from_rest` as their mean and `deviation` as their standard deviation along each
        axis, on average over the axes.

        - `points`: an N x 3 array of positions in the rest frame, at most 1000.
        - `count`: number of draws, at least 1. Default 50.
        - `seed`: a number. The same seed draws the same. Default 0.

        Returns a count x N x 3 array of positions in the measured frame.

        Raises `ValueError` if there are too many points, or nothing was measured.
        """
        import numpy

        from .process import drawn, posterior

        points = _points("points", points)
        if not 0 < len(points) <= _MOST_DRAWN:
            raise ValueError(f"points has {len(points)} positions; draws takes 1 to {_MOST_DRAWN}")
        report = self._report()
        report.UpdateVTKObjects()
        report.UpdatePropertyInformation()
        rows = numpy.array(numbers(report, "Rows"), float).reshape(-1, 7)
        covariance = numbers(report, "Covariance")
        if not covariance:
            raise self._refused()
        if len(rows) == 0:
            raise ValueError("nothing was measured; any deformation is possible")
        left = posterior(rows, covariance, points)
        own = numpy.sqrt(numpy.maximum(numpy.diag(left).reshape(-1, 3).mean(axis=1), 1e-12))
        factor = self.deviation(points) / own  # calibration, guard, mask and control points
        random = numpy.random.default_rng(seed)
        return self.measured_from_rest(points) + factor[:, None] * drawn(left, count, random)


def away_from_fit(bent, fit, rest):
    """How far (mm) strokes and Strength take tissue from where the fit that bends it has it.

    - `bent`: the Free-Form Deformation
    - `fit`: its `Fit`
    - `rest`: an N x 3 array of positions in the rest frame
    """
    import numpy

    from .maps import deformed_from_rest

    rotation, shift = fit.rigid[:3, :3], fit.rigid[:3, 3]
    fitted = (fit.measured_from_rest(rest) - shift) @ rotation  # rotation is orthogonal
    return numpy.linalg.norm(deformed_from_rest(bent, rest) - fitted, axis=1)


def _lattice_settings(source):
    """The names of the settings of a lattice: Filters/Proxies/LatticeSettings.xml marks them."""
    hints = {name: source.SMProxy.GetProperty(name).GetHints() for name in source.ListProperties()}
    return [name for name, hint in hints.items()
            if hint and hint.FindNestedElementByName("LatticeSetting")]


def _shared(deformation):
    """The settings of a deformation that must be equal in its fit."""
    values = {}
    for name in _lattice_settings(deformation):
        value = getattr(deformation, name)
        if not deformation.SMProxy.GetProperty(name).IsA("vtkSMProxyProperty"):
            value = deformation.GetPropertyValue(name)
            values[name] = value if isinstance(value, (int, float, str)) else list(value)
        elif value:
            values[name] = value
    return values


def _cortex(threshold, label, array, segmentation):
    """The properties that define the cortex."""
    values = {} if array is None else {"SurfaceArray": array}
    if threshold is not None and label is not None:
        raise ValueError("threshold and label are both given; give one of them")
    if threshold is not None:
        values.update(SurfaceBy="Threshold", Threshold=float(threshold))
    if label is not None:
        values.update(SurfaceBy="Label", Label=int(label))
    if segmentation is not None:
        values["Segmentation"] = segmentation
    return values


def _opening(opening):
    """The properties that define the opening of the skull."""
    if opening is None:
        return {}
    if hasattr(opening, "SMProxy"):
        return {"Opening": opening}
    centre, radius = opening
    return {"OpeningCentre": [float(x) for x in centre], "OpeningRadius": float(radius)}


def is_kind(source, kind):
    """Whether it is a source with that proxy."""
    return bool(source) and source.SMProxy.GetXMLName() == kind


def own(source):
    """Marks a source as one that BrainShift made. State files keep the mark."""
    source.SMProxy.SetAnnotation(_MADE, "1")
    return source


def is_unused(source, former=None):
    """Whether no source of the pipeline, other than a former fit, uses a source."""
    proxy = source.SMProxy
    consumers = [proxy.GetConsumerProxy(i) for i in range(proxy.GetNumberOfConsumers())]
    users = [consumer.GetTrueParentProxy() for consumer in consumers if consumer]  # else deleted
    return not any(
        (former is None or user is not former.SMProxy) and user.IsA("vtkSMSourceProxy")
        and not user.IsA("vtkSMRepresentationProxy")
        for user in users)


def _is_free(source, former):
    """Whether BrainShift made a source, and no other source than the former fit uses it."""
    return source.SMProxy.HasAnnotation(_MADE) and is_unused(source, former)


def forget_former(former):
    """Deletes a former fit with its points, or a former refinement, if BrainShift made them and no
    other source uses them."""
    from paraview import simple

    is_fit = is_kind(former, "FitDeformation")
    if not (is_fit or is_kind(former, "RefinedLattice")) or not _is_free(former, former):
        return
    points = [getattr(former, name) for name in _INPUTS] if is_fit else []
    simple.Delete(former)
    for source in points:
        if source and _is_free(source, former):
            simple.Delete(source)


def _solved(deformation, arrays, pulls, pins, values):
    """A Fit Deformation after its update. Raises `ValueError` with the reason if it failed."""
    from paraview import simple

    made = []
    for name, points in zip(_INPUTS, arrays):
        if len(points):
            made.append(own(simple.PolyPointSource(registrationName=_INPUTS[name],
                                                    Points=points.ravel().tolist())))
            values[name] = made[-1]
    former = deformation.Lattice
    base = former.Base if is_kind(former, "FitDeformation") else former
    if base:
        values["Base"] = base
    source = own(simple.FitDeformation(
        Input=deformation.Input,
        Pulls=[float(n) for pull in pulls for n in (*pull.ravel(), 1.0)],
        Pins=[float(n) for pin in pins for n in (*pin, 1.0)], **values))
    source.UpdatePipeline()
    problem = reason_of(source)
    if problem:
        for proxy in (source, *made):
            simple.Delete(proxy)
        raise ValueError(problem)
    return source


def _landmarks(rest, measured, by_order):
    """Two arrays of landmarks, and the properties that pair them."""
    names = {"RestNames": _names(rest), "MeasuredNames": _names(measured)}
    rest, measured = _points("rest", rest), _points("measured", measured)
    has_names = not by_order and any(names.values())
    if len(rest) != len(measured) and not (has_names and len(rest) and len(measured)):
        raise ValueError(f"rest has {len(rest)} points and measured {len(measured)}; "
                         "they must have the same number")
    return rest, measured, {"PairByOrder": int(by_order),
                            **{key: found for key, found in names.items() if found}}


def fit(filter, rest=None, measured=None, traces=None, pulls=None, pins=None, threshold=None,
        label=None, array=None, segmentation=None, opening=None, cavity=None, by_order=False):
    """Fit a deformation to measurements, and make it the lattice of a Free-Form Deformation.

    All measurements are solved together. With landmarks alone the fit removes a rigid motion and
    deforms little. With traces, pulls or pins the volume is assumed to be aligned already.
    A later call for the same deformation replaces the former fit. If it fails, the former fit
    stays. A fit that a refinement replaced is not deleted. Any other `Lattice`, such as a
    refinement, becomes the `Base` of the fit: the deformation from which it starts. The volume is
    then assumed to be aligned, too.

    - `filter`: a Free-Form Deformation. Its `Lattice` becomes the fit; its strokes stay on top.
    - `rest`, `measured`: landmarks in the rest frame and their measured positions: N x 3 arrays in
      mm, in the same order, or results of `read_points`. The latter pair by name, and by order
      where neither has names. It is an error if no name is on both lists.
    - `traces`: points that were traced on the cortex, an N x 3 array in mm or a result of
      `read_points`.
    - `pulls`: an N x 2 x 3 array in mm: start and target of tissue.
    - `pins`: an N x 3 array in mm, tissue that stays at its position after the base, or at rest.
    - `threshold` or `label`: the scalars of the cortex. The default is a threshold of 0.5.
    - `array`: name of the scalars; the volume must have them. The default, `None`, takes the
      active ones.
    - `segmentation`: a ParaView source with these scalars. The default, `None`, is the volume.
    - `opening`: the opening of the skull: a ParaView source of a mask, or centre and radius in mm.
      The default, `None`, is a ball around traced and pulled points. The cortex is held beyond
      15 mm of it.
    - `cavity`: a ParaView source of a mask. Traced points in it do not count.
    - `by_order`: True pairs landmarks by their order, whatever their names. Default False.

    Returns a `Fit`.

    Raises `ValueError` with the reason if an array has a wrong shape or the fit fails.
    """
    from paraview import simple

    axes = _point_axes(rest, measured, traces)
    rest, measured, pairing = _landmarks(rest, measured, by_order)
    traces, pulls, pins = _points("traces", traces), _pulls(pulls), _points("pins", pins)
    values = {**_shared(filter), **_opening(opening), **pairing, **axes,
              **_cortex(threshold, label, array, segmentation)}
    if cavity is not None:
        values["Cavity"] = cavity
    active = simple.GetActiveSource()
    try:
        source = _solved(filter, (rest, measured, traces), pulls, pins, values)
    finally:
        simple.SetActiveSource(active)
    former = filter.Lattice
    filter.Lattice = source
    forget_former(former)
    simple.RenameSource(result_name(filter.Input, "fit"), source)  # that of the former is free now
    simple.SetActiveSource(active)
    return Fit(source)
