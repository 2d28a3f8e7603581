# SPDX-License-Identifier: BSD-3-Clause
"""Aligns a reference and refines a deformation by the intensities of both volumes."""

from .fitting import forget_former, is_kind, own
from .reports import numbers


def _new_run(session):
    run = session.NewProxy("misc", "RegistrationRun")
    run.UnRegister(None)  # Python holds it
    run.PrototypeOn()  # a question is no step to undo
    return run


def similarities():
    """List what `refine` can compare by.

    Returns a dictionary: for each name, when to choose it and what it compares.
    """
    from paraview import servermanager

    run = _new_run(servermanager.ProxyManager().SMProxyManager)
    run.UpdateVTKObjects()
    run.UpdatePropertyInformation()
    names, tooltips = (run.GetProperty(name).GetElement(0).split("\n")
                       for name in ("SimilarityNames", "SimilarityTooltips"))
    return dict(zip(names, tooltips))


class _Run:
    """A registration beside the data, and its figures."""

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

    def steps(self, result, callback):
        """Steps until it is finished or the callback returns False. Returns what to warn of."""
        taken = 0
        stop = False
        while not stop and not result.finished:
            self.proxy.InvokeCommand("Step")
            self.proxy.UpdatePropertyInformation()
            if self.figure("Problem"):
                raise RuntimeError(self.figure("Problem"))
            for name, figure in result.FIGURES.items():
                setattr(result, name, self.figure(figure))
            result.finished = bool(self.figure("Finished"))
            # A call may only have tried a length of a step, or prepared a level.
            stop = (callback is not None and result.steps > taken and callback(result) is False)
            taken = result.steps
        if self.figure("Refusal"):
            raise ValueError(self.figure("Refusal") + ". Nothing was changed")
        return self.figure("Warning")


class Alignment:
    """What `align` found.

    - `rotation`, `translation`: where the reference lies now, as Compare Volumes has them: degrees
      about x, then y, then z, and mm
    - `matrix`: how the reference was moved from where it was, a 4 x 4 matrix, mm, world axes
    - `information`, `information_before`: mutual information in nats, more is better, on the same
      level
    - `compared`: the fraction of the volume that has a partner in the reference, 0 to 1
    - `shift`, `turn`: how far it was moved, mm and degrees. `align` is tested from up to 20 mm and
      15 degrees away.
    - `steps`, `level`: lines that were searched, and the level of the pyramid, from 0 on
    - `finished`: False if the callback stopped it
    """

    #: Attributes, and the properties of the run that they are read from.
    FIGURES = {"compared": "Overlap", "information": "Information",
               "information_before": "InformationBefore", "level": "Level", "shift": "Shift",
               "steps": "Steps", "turn": "Rotation"}

    finished = False


class Refinement:
    """What `refine` found. Lengths are mm.

    - `filter`: the Refined Lattice, a ParaView source. The deformation has it as its lattice.
    - `strokes`: the strokes that were there before. The result holds what they did.
    - `disagreement`, `disagreement_before`: the cost now and before, on the same level; 0 means
      that the volumes agree
    - `largest_change`, `mean_change`: how far control points moved
    - `smallest_determinant`: the smallest Jacobian determinant of the result
    - `share`: the smallest fraction of a step that the fold guard allowed, 0 to 1
    - `compared`: the fraction of the volume that has a partner in the reference, 0 to 1; by
      ultrasound, of the tissue inside the ultrasound fan
    - `moved`: the longest move of a control point in the last step
    - `steps`, `level`: steps that were taken, and the level of the pyramid, from 0 on
    - `finished`: False if the callback stopped it
    """

    #: Attributes, and the properties of the run that they are read from.
    FIGURES = {"compared": "Overlap", "disagreement": "Cost", "disagreement_before": "CostBefore",
               "largest_change": "LargestChange", "level": "Level", "mean_change": "MeanChange",
               "moved": "LongestMove", "share": "StepFraction", "steps": "Steps"}

    finished = False


def align(compare, callback=None):
    """Register the reference rigidly: maximise its mutual information with the volume.

    The two volumes need no common contrast. The volume is
    compared as it is bent; under a mask only the tissue inside. The cavity does not count.

    - `compare`: a Compare Volumes. Its `ReferenceRotation` and `ReferenceTranslation` are set, from
      where the reference lies.
    - `callback`: is called after each step with the `Alignment` so far. If it returns `False`, the
      search stops there. The default is `None`.

    Returns an `Alignment`.

    Raises `ValueError` with the reason if the volumes cannot be compared.
    """
    import warnings

    start = {}  # another source has no reference, and the run says so
    if is_kind(compare, "CompareVolumes"):
        start = {"StartRotation": compare.ReferenceRotation,
                 "StartTranslation": compare.ReferenceTranslation}
    run = _Run(compare, "BeginAlignment", **start)
    result = Alignment()
    warning = run.steps(result, callback)
    result.matrix = run.numbers("Motion").reshape(4, 4)
    result.rotation, result.translation = run.numbers("Placement").reshape(2, 3)
    compare.ReferenceRotation = result.rotation.tolist()
    compare.ReferenceTranslation = result.translation.tolist()
    if warning:
        warnings.warn(warning, stacklevel=2)
    return result


def _shows(compare, bent):
    """Whether a source is made from another one, through any number of filters."""
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
    """Gives the deformation the control points that were found, in place of all that it had."""
    from paraview import simple

    former = bent.Lattice
    held = own(simple.RefinedLattice(
        Input=bent.Input, LatticeDimensions=list(bent.LatticeDimensions),
        ControlPoints=control_points.tolist()))
    bent.Lattice = held
    bent.Strokes = []
    if is_kind(former, "RefinedLattice"):
        forget_former(former)  # a fit stays: its figures are still to be read
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    return held


def refine(filter, reference, similarity=None, stiffness=1.0, cavity=None, callback=None):
    """Refine a deformation automatically so that the volume matches a reference.

    It begins with what is there, a fit and strokes, and changes it as little as the volumes ask.
    The result takes the place of both; strokes that are made later follow it. Where tissue slides,
    as along the falx, or was removed without a cavity, the result is wrong.

    - `filter`: a Free-Form Deformation. Its `Lattice` becomes the result, and its `Strokes` become
      empty.
    - `reference`: a Compare Volumes of the deformation, with its cavity and with the reference
      where it lies; or a ParaView source of the reference.
    - `similarity`: one of the names that `similarities` lists. The default is the first of them,
      which is for any contrast.
    - `stiffness`: a factor on what bending costs, above 0. The default is 1.
    - `cavity`: a ParaView source of a mask, if `reference` is no Compare Volumes. What it holds
      does not count.
    - `callback`: is called after each step with the `Refinement` so far. If it returns `False`, the
      result is that of this step. The default is `None`.

    Returns a `Refinement`.

    Raises `ValueError` with the reason if the volumes cannot be compared. The deformation then
    stays as it was.
    """
    import warnings

    from paraview import simple

    names = list(similarities())
    if similarity not in (None, *names):
        raise ValueError(f"similarity is {similarity!r}; it must be one of {names}")
    active = simple.GetActiveSource()
    compare, made = _compared(filter, reference, cavity)
    result = Refinement()
    try:
        run = _Run(compare, "BeginRefinement", Stiffness=float(stiffness),
                   Similarity=0 if similarity is None else names.index(similarity))
        warning = run.steps(result, callback)
    finally:
        if made:
            simple.Delete(compare)
        simple.SetActiveSource(active)
    result.strokes = tuple(filter.Strokes)
    result.filter = _hold(filter, run.numbers("ControlPoints"))
    result.smallest_determinant = filter.GetPropertyValue("MinimumJacobian")
    simple.SetActiveSource(active)
    if warning:
        warnings.warn(warning, stacklevel=2)
    return result
