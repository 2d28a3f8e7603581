# SPDX-License-Identifier: BSD-3-Clause
"""Aligns a reference and refines a deformation by the intensities of both volumes."""

import json

from .casesources import result_name
from .fitting import forget_former, is_kind, own
from .lineage import compared_by, keep_fitted, landmarks_fitted_by
from .reports import numbers

_MOST_STARTS = 64

#: Annotation of a Refined Lattice, as RefineEditor.cxx writes it, too: what made it, as JSON.
REFINED = "BrainShift.Refined"


def _new_run(session):
    run = session.NewProxy("misc", "RegistrationRun")
    run.UnRegister(None)  # Python holds it
    run.PrototypeOn()  # so that it is no step to undo
    return run


def similarities():
    """List the similarities that `refine` can use.

    Returns a dictionary: for each name, its use and its method.
    """
    from paraview import servermanager

    run = _new_run(servermanager.ProxyManager().SMProxyManager)
    run.UpdateVTKObjects()
    run.UpdatePropertyInformation()
    names, tooltips = (run.GetProperty(name).GetElement(0).split("\n")
                       for name in ("SimilarityNames", "SimilarityTooltips"))
    return dict(zip(names, tooltips))


class _Run:
    """A registration that runs beside the data, and its figures."""

    def __init__(self, source, begin, **properties):
        source.UpdatePipeline()
        self.proxy = _new_run(source.SMProxy.GetSessionProxyManager())
        self.proxy.GetProperty("Source").AddProxy(source.SMProxy)
        for name, value in properties.items():
            for i, element in enumerate(value if hasattr(value, "__len__") else [value]):
                self.proxy.GetProperty(name).SetElement(i, element)
        self.proxy.UpdateVTKObjects()
        self.proxy.InvokeCommand(begin)
        self.proxy.UpdatePropertyInformation()
        if self.figure("Problem"):
            raise ValueError(self.figure("Problem"))

    def figure(self, name):
        """A property with one element, as of the last step."""
        return self.proxy.GetProperty(name).GetElement(0)

    def numbers(self, name):
        """All elements of a property, as of the last step."""
        import numpy

        return numpy.array(numbers(self.proxy, name))

    def read(self, result):
        """Gives a result its figures, as of the last step."""
        for name, figure in result.FIGURES.items():
            setattr(result, name, self.figure(figure))
        result.finished = bool(self.figure("Finished"))

    def steps(self, result, callback):
        """Steps until it is finished or the callback returns False. Gives the result its figures.

        Raises `RegistrationFailed` if it failed its checks, and `ValueError` if nothing overlaps.
        """
        taken = 0
        stop = False
        # All of them, with the control points, would take as long as a step.
        read = [self.proxy.GetProperty(name)
                for name in ("Problem", "Finished", *result.FIGURES.values())]
        while not stop and not result.finished:
            self.proxy.InvokeCommand("Step")
            for figure in read:
                self.proxy.UpdatePropertyInformation(figure)
            if self.figure("Problem"):
                raise RuntimeError(self.figure("Problem"))
            self.read(result)
            # A call may have tried a length of a step only, or prepared a level.
            stop = (callback is not None and result.steps != taken and callback(result) is False)
            taken = result.steps
        if stop:
            self.proxy.InvokeCommand("Stop")
        self.proxy.UpdatePropertyInformation()
        self.read(result)
        result.trust = self.figure("Trust")
        result.warnings = [line for line in self.figure("Warning").split("\n") if line]
        if self.figure("Refusal"):
            raise _refused(self.figure("Refusal"), result)


class RegistrationFailed(ValueError):
    """The result of `align` or `refine` failed its checks, and nothing was changed.

    - `found`: the result, an `Alignment` or a `Refinement`, with its figures
    """

    def __init__(self, reason, found):
        super().__init__(reason)
        self.found = found


def _refused(reason, result):
    """The error for a result that is discarded."""
    if result.trust == "failed":
        return RegistrationFailed(
            reason + ". Nothing was changed; keep_failed=True keeps the result", result)
    return ValueError(reason + ". Nothing was changed")


def _warn(result):
    """Shows the warnings of a result to the caller of the function that made it."""
    import warnings

    if result.warnings:
        warnings.warn(" ".join(result.warnings), stacklevel=3)


def refined_by(lattice):
    """What made a Refined Lattice, also once a state brought it back: a dict of `steps`,
    `finished`, `cost`, `before`, `trust`, `warning` and `of`, what `lineage.compared_by` returned.
    Empty for any other source."""
    told = lattice.SMProxy.GetAnnotation(REFINED) if is_kind(lattice, "RefinedLattice") else None
    return json.loads(told) if told else {}


def _check_text(result):
    return ("finished" if result.finished else "stopped") + f", {result.trust}"


class Alignment:
    """The result of `align`.

    - `rotation`, `translation`: the position of the reference, as Compare Volumes has it: degrees
      about x, then y, then z, and mm
    - `matrix`: the motion of the reference from its former position, a 4 x 4 matrix, mm, world axes
    - `information`, `information_before`: mutual information in nats, more is better, on the same
      level
    - `compared`: the fraction of the volume that has a partner in the reference, 0 to 1
    - `shift`, `turn`: distance and angle of this motion, mm and degrees. `align` is tested for
      starts up to 20 mm and 15 degrees away.
    - `steps`, `level`: number of searched lines, and the level of the pyramid, from 0 on
    - `done`: the progress, 0 to 1
    - `finished`: False if the callback stopped it
    - `trust`: how far the result may be trusted, by checks of itself: "good", "doubtful" or
      "failed", or "unchecked" if the callback stopped it or too little was compared
    - `warnings`: what you must check, a list of sentences

    Printed, it is a line of figures.
    """

    #: Attributes, and the properties of the run with their values.
    FIGURES = {"compared": "Overlap", "done": "Done", "information": "Information",
               "information_before": "InformationBefore", "level": "Level", "shift": "Shift",
               "steps": "Steps", "turn": "Rotation"}

    finished = False
    trust = "unchecked"
    warnings = ()

    def __repr__(self):
        return (f"Alignment: moved by {self.shift:.2f} mm and {self.turn:.2f} degrees, information "
                f"{self.information_before:.3f} to {self.information:.3f} nats, compared "
                f"{self.compared:.2f} of the volume, {self.steps} steps, " + _check_text(self))


class Refinement:
    """The result of `refine`. Lengths are mm.

    - `filter`: the Refined Lattice, a ParaView source. It is the lattice of the deformation.
    - `strokes`: the former strokes. The result contains their effect.
    - `disagreement`, `disagreement_before`: the cost now and at the start, on the same level; 0
      means that the volumes match
    - `largest_change`, `mean_change`: distance that control points moved
    - `smallest_determinant`: the smallest Jacobian determinant of the result
    - `share`: the smallest fraction of a step that the fold guard allowed, 0 to 1
    - `compared`: the fraction of the volume that has a partner in the reference, 0 to 1; by
      ultrasound, of the tissue inside the ultrasound fan
    - `moved`: the longest displacement of a control point in the last step
    - `steps`, `level`: number of steps, and the level of the pyramid, from 0 on
    - `done`: the progress, 0 to 1
    - `finished`: False if the callback stopped it
    - `trust`: how far the result may be trusted, by checks of itself: "good", "doubtful" or
      "failed", or "unchecked" if the callback stopped it or too little was compared
    - `warnings`: what you must check, a list of sentences

    Printed, it is a line of figures.
    """

    #: Attributes, and the properties of the run with their values.
    FIGURES = {"compared": "Overlap", "disagreement": "Cost", "disagreement_before": "CostBefore",
               "done": "Done", "largest_change": "LargestChange", "level": "Level",
               "mean_change": "MeanChange", "moved": "LongestMove", "share": "StepFraction",
               "steps": "Steps"}

    finished = False
    trust = "unchecked"
    warnings = ()
    smallest_determinant = float("nan")  # until the run has ended

    def __repr__(self):
        return (f"Refinement: cost {self.disagreement_before:.4f} to {self.disagreement:.4f}, "
                f"largest change {self.largest_change:.2f} mm, mean {self.mean_change:.2f} mm, "
                f"smallest determinant {self.smallest_determinant:.3f}, compared "
                f"{self.compared:.2f} of the volume, {self.steps} steps, " + _check_text(self))


def _starts(starts):
    """A number of starts, or an error that names the limits."""
    if isinstance(starts, bool) or int(starts) != starts or not 1 <= starts <= _MOST_STARTS:
        raise ValueError(f"starts is {starts!r}; it must be a whole number from 1 to "
                         f"{_MOST_STARTS}")
    return int(starts)


def align(compare, callback=None, keep_failed=False, starts=1):
    """Register the reference rigidly: maximise its mutual information with the volume.

    The two volumes need no common contrast. The deformed volume is compared; under a mask only the
    tissue inside. The cavity does not count.

    - `compare`: a Compare Volumes. The search starts from the present position of its reference and
      sets `ReferenceRotation` and `ReferenceTranslation`.
    - `callback`: is called after each step with the `Alignment` so far. If it returns `False`, the
      search stops, and the result is not checked. The default is `None`.
    - `keep_failed`: True keeps a result that fails its checks, with warnings. The default is
      `False`: it is an error, and the reference stays where it was.
    - `starts`: number of positions from which the search begins, 1 to 64. Beyond the present one
      they are up to 30 mm and 30 degrees from it, always the same. The result with the most
      information is kept. The default is 1.

    Returns an `Alignment`.

    Raises `RegistrationFailed` if the result fails its checks, and `ValueError` with the reason if
    the volumes cannot be compared. The reference then stays where it was.
    """
    start = {"Starts": _starts(starts), "KeepFailed": int(keep_failed)}
    if is_kind(compare, "CompareVolumes"):  # else the run reports that there is no reference
        start.update(StartRotation=compare.ReferenceRotation,
                     StartTranslation=compare.ReferenceTranslation)
    run = _Run(compare, "BeginAlignment", **start)
    result = Alignment()
    run.steps(result, callback)
    result.matrix = run.numbers("Motion").reshape(4, 4)
    result.rotation, result.translation = run.numbers("Placement").reshape(2, 3)
    compare.ReferenceRotation = result.rotation.tolist()
    compare.ReferenceTranslation = result.translation.tolist()
    _warn(result)
    return result


def _shows(compare, bent):
    """Whether a source is downstream of another one, through any number of filters."""
    source = compare
    while source is not None and source.SMProxy is not bent.SMProxy:
        source = getattr(source, "Input", None)
    return source is not None


def _compared(bent, reference, cavity):
    """A Compare Volumes of the two, and whether it was made for this."""
    from paraview import simple

    if is_kind(reference, "CompareVolumes"):
        if cavity is not None:
            raise ValueError("cavity is given, but the Compare Volumes has its own; set it there")
        if not _shows(reference, bent):
            raise ValueError("the Compare Volumes does not show this deformation")
        return reference, False
    values = {} if cavity is None else {"Cavity": cavity}
    return simple.CompareVolumes(Input=bent, Reference=reference, **values), True


def _hold(bent, control_points):
    """Replaces lattice and strokes of the deformation by the control points of the result."""
    from paraview import simple

    former = bent.Lattice
    landmarks = landmarks_fitted_by(former)
    held = own(simple.RefinedLattice(
        Input=bent.Input, LatticeDimensions=list(bent.LatticeDimensions),
        ControlPoints=control_points.tolist()))
    keep_fitted(held, landmarks)
    bent.Lattice = held
    bent.Strokes = []
    if is_kind(former, "RefinedLattice"):
        forget_former(former)  # a fit stays: its figures are still to be read
    simple.RenameSource(result_name(bent.Input, "refined"), held)
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    return held


def refine(filter, reference, similarity=None, stiffness=1.0, cavity=None, callback=None,
           keep_failed=False, starts=1):
    """Refine a deformation automatically so that the volume matches a reference.

    It starts from the present deformation, a fit and strokes, and changes it as little as the
    volumes require. The result replaces both; later strokes follow it. The result is wrong where
    tissue slides, as along the falx, or was removed without a cavity. If checks find a part of the
    volume that belongs elsewhere, or by ultrasound a better place nearby, it goes on from there.

    - `filter`: a Free-Form Deformation. Its `Lattice` becomes the result, and its `Strokes` become
      empty.
    - `reference`: a Compare Volumes of the deformation, with its cavity and with the reference
      in its present position; or a ParaView source of the reference.
    - `similarity`: one of the names that `similarities` lists. The default is the first of them,
      which accepts any contrast.
    - `stiffness`: a factor on the stiffness of the volume, above 0. The default is 1.
    - `cavity`: a ParaView source of a mask, if `reference` is no Compare Volumes. Tissue inside
      it does not count.
    - `callback`: is called after each step with the `Refinement` so far. If it returns `False`,
      that is the result, not checked, or a checked one from which it went on. Default: `None`.
    - `keep_failed`: True keeps a result that fails its checks, with warnings. The default is
      `False`: it is an error, and the deformation stays as it was.
    - `starts`: number of positions from which the volume moves rigidly before it bends, 1 to 64.
      Only the similarity for ultrasound moves it rigidly. All are up to 6 mm and 6 degrees from the
      present one, always the same. The result with the least cost is kept. The default is 1. Take 8
      if the position may be more than 3 mm off.

    Returns a `Refinement`.

    Raises `RegistrationFailed` if the result fails its checks, and `ValueError` with the reason if
    the volumes cannot be compared. The deformation then stays as it was.
    """
    from paraview import simple

    names = list(similarities())
    if similarity not in (None, *names):
        raise ValueError(f"similarity is {similarity!r}; it must be one of {names}")
    starts = _starts(starts)
    active = simple.GetActiveSource()
    compare, made = _compared(filter, reference, cavity)
    result, of = Refinement(), compared_by(filter, compare)
    try:
        run = _Run(compare, "BeginRefinement", Stiffness=float(stiffness),
                   Similarity=0 if similarity is None else names.index(similarity),
                   KeepFailed=int(keep_failed), Starts=starts)
        run.steps(result, callback)
    finally:
        if made:
            simple.Delete(compare)
        simple.SetActiveSource(active)
    result.strokes = tuple(filter.Strokes)
    result.filter = _hold(filter, run.numbers("ControlPoints"))
    result.filter.SMProxy.SetAnnotation(REFINED, json.dumps({
        "steps": result.steps, "finished": result.finished, "cost": result.disagreement,
        "before": result.disagreement_before, "trust": result.trust,
        "warning": " ".join(result.warnings), "of": of}))
    result.smallest_determinant = filter.GetPropertyValue("MinimumJacobian")
    simple.SetActiveSource(active)
    _warn(result)
    return result
