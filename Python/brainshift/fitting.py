# SPDX-License-Identifier: BSD-3-Clause
"""Bends a volume by what was measured, with the uncertainty."""

from .reports import numbers

#: The annotation of sources that `fit` made.
_MADE = "BrainShiftFit"

#: The inputs that are made of arrays, and what the pipeline calls them.
_INPUTS = {"RestLandmarks": "Landmarks At Rest", "MeasuredLandmarks": "Measured Landmarks",
           "Traces": "Traced Points"}


def _points(name, values):
    """`values` as an N x 3 array of finite numbers."""
    import numpy

    array = numpy.empty((0, 3)) if values is None else numpy.asarray(values, float)
    if array.size == 0:
        return numpy.empty((0, 3))
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} has the shape {array.shape}; it must be N x 3")
    if not numpy.isfinite(array).all():
        raise ValueError(f"{name} holds a number that is not finite")
    return array


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
    """What `fit` found. All numbers are mm, world axes.

    - `filter`: the Fit Deformation, a ParaView source. The deformation has it as its lattice.
    - `rigid`: the rigid part, a 4 x 4 matrix, measured from rest. It is not in the lattice.
    - `residuals`: how far the measured points come to lie from where they were measured: first the
      landmarks, then the pulls, then the signed distances of the traced points from the cortex,
      positive outside. NaN for a point that does not count.
    - `landmark_residuals`, `pull_residuals`, `trace_residuals`: each part of it
    - `leave_one_out`: for each landmark, how far a fit without it misses it, before the fold guard
      and the mask change the bend. NaN for a landmark that the others say nothing about. For one
      that is switched off, how far this fit misses it.
    - `share`: the share of the bend beyond the base that was applied, 0 to 1. The fold guard may
      leave less than 1.
    - `relaxation`: 1, or 1.5 if the guard had to trust what was measured less
    - `calibration`: the factor on deviations that leaving out landmarks showed
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

    def _answers(self, points, name):
        import numpy

        points = _points("points", points)
        if len(points) == 0:
            return numpy.empty(0)
        report = self.filter.SMProxy.GetSessionProxyManager().NewProxy("misc", "FitReport")
        report.UnRegister(None)  # Python holds it
        report.PrototypeOn()  # a question is no step to undo
        report.GetProperty("Filter").AddProxy(self.filter.SMProxy)
        asked = report.GetProperty("Points")
        asked.SetNumberOfElements(points.size)
        for i, number in enumerate(points.ravel()):
            asked.SetElement(i, float(number))
        report.UpdateVTKObjects()
        report.UpdatePropertyInformation(report.GetProperty(name))
        answers = numpy.array(numbers(report, name), float)
        if len(answers) != len(points) * (3 if name == "Measured" else 1):
            raise RuntimeError("The fit gives no answers: it failed or was changed since; see the "
                               "messages, and call fit again")
        return answers

    def measured_from_rest(self, points):
        """Find where tissue was measured or would be: bend and rigid part together.

        - `points`: an N x 3 array of positions in the rest frame.

        Returns an N x 3 array of positions in the measured frame. Strokes have no part in it.
        """
        return self._answers(points, "Measured").reshape(-1, 3)

    def deviation(self, points):
        """Find how far `measured_from_rest` can be believed.

        - `points`: an N x 3 array of positions in the rest frame.

        Returns N standard deviations along each axis: infinity if nothing was measured. What the
        fold guard, the mask and the control points changed counts too. A ball with 2.8 times the
        deviation as its radius holds the tissue with 95 %. Where a landmark is measured also has
        the error of a measurement: there the radius is 2.8 times the root of deviation² plus
        (0.7 mm × `calibration`)².
        """
        return self._answers(points, "Deviations")


def _lattice_settings(source):
    """The names of the settings of a lattice: Filters/Proxies/LatticeSettings.xml marks them."""
    hints = {name: source.SMProxy.GetProperty(name).GetHints() for name in source.ListProperties()}
    return [name for name, hint in hints.items()
            if hint and hint.FindNestedElementByName("LatticeSetting")]


def _shared(deformation):
    """The settings of a deformation that its fit must share."""
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
    """The properties that say where the cortex is."""
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
    """The properties that say where the skull is open."""
    if opening is None:
        return {}
    if hasattr(opening, "SMProxy"):
        return {"Opening": opening}
    centre, radius = opening
    return {"OpeningCentre": [float(x) for x in centre], "OpeningRadius": float(radius)}


def is_kind(source, kind):
    """Whether it is a source, and of that proxy."""
    return bool(source) and source.SMProxy.GetXMLName() == kind


def own(source):
    """Marks a source as one that `fit` made. State files keep the mark."""
    source.SMProxy.SetAnnotation(_MADE, "1")
    return source


def _is_free(source, former):
    """Whether `fit` made a source, and nothing but the former fit takes it."""
    proxy = source.SMProxy
    consumers = [proxy.GetConsumerProxy(i) for i in range(proxy.GetNumberOfConsumers())]
    takers = [consumer.GetTrueParentProxy() for consumer in consumers if consumer]  # or is gone
    return proxy.HasAnnotation(_MADE) and not any(
        taker is not former.SMProxy and taker.IsA("vtkSMSourceProxy")
        and not taker.IsA("vtkSMRepresentationProxy")
        for taker in takers)


def forget_former(former):
    """Deletes a former fit with its points, or a former refinement, as far as `fit` or `refine`
    made them and nothing takes them."""
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
    """A Fit Deformation that has run; an error with the reason if it could not."""
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
        Input=deformation.Input, Pulls=[float(n) for pull in pulls for n in (*pull.ravel(), 1.0)],
        Pins=[float(n) for pin in pins for n in (*pin, 1.0)], **values))
    source.UpdatePipeline()
    source.SMProxy.UpdatePropertyInformation()
    problem = source.GetPropertyValue("Problem")
    if problem:
        for proxy in (source, *made):
            simple.Delete(proxy)
        raise ValueError(problem)
    return source


def fit(filter, rest=None, measured=None, traces=None, pulls=None, pins=None, threshold=None,
        label=None, array=None, segmentation=None, opening=None, cavity=None):
    """Bend a volume by what was measured, and give the deformation that lattice.

    All measurements are solved together. With landmarks alone the fit takes a rigid motion out
    and bends little. With traces, pulls or pins the volume is taken to lie right already.
    A later call for the same deformation takes the place of the former one. If it fails, the
    former one stays. A fit that a refinement replaced is not deleted. Any other `Lattice`, such as
    a refinement, becomes the `Base` of the fit: the bend from which it begins. The volume is then
    taken to lie right, too.

    - `filter`: a Free-Form Deformation. Its `Lattice` becomes the fit; its strokes stay on top.
    - `rest`, `measured`: N x 3 arrays in mm, landmarks in the rest frame and where they were
      measured, in the same order.
    - `traces`: an N x 3 array in mm, points that were traced on the cortex.
    - `pulls`: an N x 2 x 3 array in mm: where tissue was, and where it was put.
    - `pins`: an N x 3 array in mm, tissue that stays: where the base puts it, or at rest.
    - `threshold` or `label`: how scalars show the cortex. The default is a threshold of 0.5.
    - `array`: name of the scalars; the volume must have them. The default, `None`, takes the
      active ones.
    - `segmentation`: a ParaView source whose scalars show the cortex. The default, `None`, takes
      those of the volume.
    - `opening`: where the skull is open: a ParaView source of a mask, or centre and radius in mm.
      The default, `None`, is a ball around what was traced and pulled. The cortex is held beyond
      15 mm of it.
    - `cavity`: a ParaView source of a mask. Traced points in it do not count.

    Returns a `Fit`.

    Raises `ValueError` with the reason if an array has a wrong shape or the fit fails.
    """
    from paraview import simple

    rest, measured = _points("rest", rest), _points("measured", measured)
    if len(rest) != len(measured):
        raise ValueError(f"rest has {len(rest)} points and measured {len(measured)}; "
                         "they must have the same number")
    traces, pulls, pins = _points("traces", traces), _pulls(pulls), _points("pins", pins)
    values = {**_shared(filter), **_opening(opening),
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
    simple.SetActiveSource(active)
    return Fit(source)
