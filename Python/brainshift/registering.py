# SPDX-License-Identifier: BSD-3-Clause
"""Aligns a reference and refines a bend by what both volumes show."""

from .fitting import forget_former, is_kind, own
from .reports import numbers

#: The names of similarities, in the order of the property.
_SIMILARITIES = ("auto", "same contrast", "ultrasound")

#: Beyond these it warns: tests start up to 20 mm and 15 degrees from the right place, and the
#: middle of what is compared then moves a little farther than that of the reference.
_FARTHEST_SHIFT = 24.0  # mm
_FARTHEST_TURN = 17.0  # degrees
_LEAST_OVERLAP = 0.25  # of the volume within the reference, as in Filters/Register/Alignment.cxx


class _Run:
    """A registration beside the data, and its figures."""

    def __init__(self, source, begin, **properties):
        source.UpdatePipeline()
        self.proxy = source.SMProxy.GetSessionProxyManager().NewProxy("misc", "RegistrationRun")
        self.proxy.UnRegister(None)  # Python holds it
        self.proxy.PrototypeOn()  # a question is no step to undo
        self.proxy.GetProperty("Source").AddProxy(source.SMProxy)
        for name, value in properties.items():
            self.proxy.GetProperty(name).SetElement(0, value)
        self.proxy.UpdateVTKObjects()
        self.proxy.InvokeCommand(begin)
        problem = self.proxy.GetProperty("Problem")
        self.proxy.UpdatePropertyInformation(problem)
        if problem.GetElement(0):
            raise ValueError(problem.GetElement(0))

    def answer(self, name):
        self.proxy.UpdatePropertyInformation(self.proxy.GetProperty(name))
        return numbers(self.proxy, name)

    def steps(self, result, callback):
        """Steps until it is finished or the callback returns False."""
        taken = 0
        while True:
            self.proxy.InvokeCommand("Step")
            figures = self.answer("Figures")
            if not figures:
                raise RuntimeError("The registration stopped; see the messages")
            result.take(figures)
            # A call may only have tried a length of a step, or prepared a level.
            stop = (callback is not None and result.steps > taken and callback(result) is False)
            taken = result.steps
            if stop or figures[0]:
                result.finished = bool(figures[0])
                return


class Alignment:
    """What `align` found.

    - `rotation`, `translation`: where the reference lies now, as Compare Volumes has them: degrees
      about x, then y, then z, and mm
    - `matrix`: how the reference was moved from where it was, a 4 x 4 matrix, mm, world axes
    - `information`, `information_before`: mutual information in nats, more is better, on the same
      level
    - `compared`: the share of the volume that has a partner in the reference, 0 to 1
    - `shift`, `turn`: how far it was moved, mm and degrees. From more than 20 mm or 15 degrees
      nobody has tested that the right place is found.
    - `steps`, `level`: lines that were searched, and the level of the pyramid, from 0 on
    - `finished`: False if the callback stopped it
    """

    finished = False

    def take(self, figures):
        (_, steps, level, self.compared, self.information, self.information_before, self.shift,
         self.turn, _) = figures
        self.steps, self.level = int(steps), int(level)


class Refinement:
    """What `refine` found. Lengths are mm.

    - `filter`: the Refined Lattice, a ParaView source. The deformation has it as its lattice.
    - `strokes`: the strokes that were there before. The result holds what they did.
    - `disagreement`, `disagreement_before`: how far the volumes disagree, on the same level; 0
      means that they agree
    - `largest_change`, `mean_change`: how far control points moved
    - `smallest_determinant`: the smallest Jacobian determinant of the result
    - `share`: the smallest share of a step that the fold guard left, 0 to 1
    - `compared`: the share of the volume that has a partner in the reference, 0 to 1; by
      ultrasound, the share of what the sweep saw that is compared
    - `moved`: the longest way of a control point in the last step
    - `steps`, `level`: steps that were taken, and the level of the pyramid, from 0 on
    - `finished`: False if the callback stopped it
    """

    finished = False

    def take(self, figures):
        (_, steps, level, self.compared, self.disagreement, self.disagreement_before, self.moved,
         self.share, _) = figures
        self.steps, self.level = int(steps), int(level)


def _turned(degrees):
    """The matrix of a rotation: degrees about x, then y, then z."""
    import numpy

    x, y, z = numpy.radians(degrees)
    about_x = numpy.array(((1, 0, 0), (0, numpy.cos(x), -numpy.sin(x)),
                           (0, numpy.sin(x), numpy.cos(x))))
    about_y = numpy.array(((numpy.cos(y), 0, numpy.sin(y)), (0, 1, 0),
                           (-numpy.sin(y), 0, numpy.cos(y))))
    about_z = numpy.array(((numpy.cos(z), -numpy.sin(z), 0), (numpy.sin(z), numpy.cos(z), 0),
                           (0, 0, 1)))
    return about_z @ about_y @ about_x


def _degrees(matrix):
    """The inverse of `_turned`."""
    import numpy

    return numpy.degrees((numpy.arctan2(matrix[2, 1], matrix[2, 2]),
                          -numpy.arcsin(numpy.clip(matrix[2, 0], -1.0, 1.0)),
                          numpy.arctan2(matrix[1, 0], matrix[0, 0])))


def _place(compare, matrix):
    """Moves the reference, from where it lies, by a 4 x 4 matrix."""
    import numpy

    bounds = numpy.array(compare.Reference.GetDataInformation().GetBounds()).reshape(3, 2)
    middle = bounds.mean(axis=1)
    lies = middle + numpy.array(compare.ReferenceTranslation)
    compare.ReferenceTranslation = (matrix[:3, :3] @ lies + matrix[:3, 3] - middle).tolist()
    compare.ReferenceRotation = _degrees(
        matrix[:3, :3] @ _turned(compare.ReferenceRotation)).tolist()


def align(compare, callback=None):
    """Move the reference rigidly to where it says most about the volume.

    The measure is mutual information, so the two volumes need no common contrast. The volume is
    compared as it is bent; under a mask only the tissue inside. The cavity does not count.

    - `compare`: a Compare Volumes. Its `ReferenceRotation` and `ReferenceTranslation` are set, from
      where the reference lies.
    - `callback`: is called after each step with the `Alignment` so far. If it returns `False`, the
      search stops there. The default is `None`.

    Returns an `Alignment`.

    Raises `ValueError` with the reason if the volumes cannot be compared.
    """
    import warnings

    import numpy

    run = _Run(compare, "BeginAlignment")
    result = Alignment()
    run.steps(result, callback)
    result.matrix = numpy.array(run.answer("Motion")).reshape(4, 4)
    if result.compared < _LEAST_OVERLAP:
        raise ValueError(f"{100 * result.compared:.0f} % of the volume lies within the reference; "
                         "at least 25 % must. Move the reference closer first")
    _place(compare, result.matrix)
    result.rotation = numpy.array(compare.ReferenceRotation)
    result.translation = numpy.array(compare.ReferenceTranslation)
    if result.shift > _FARTHEST_SHIFT or result.turn > _FARTHEST_TURN:
        warnings.warn(f"The reference was moved by {result.shift:.0f} mm and {result.turn:.0f} "
                      "degrees. Nobody has tested this from more than 20 mm or 15 degrees; look "
                      "whether it lies right", stacklevel=2)
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
        ControlPoints=control_points.ravel().tolist()))
    bent.Lattice = held
    bent.Strokes = []
    if is_kind(former, "RefinedLattice"):
        forget_former(former)  # a fit stays: its figures are still to be read
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    return held


def refine(filter, reference, similarity="auto", stiffness=1.0, cavity=None, callback=None):
    """Bend a volume until it agrees with a reference.

    It begins with what is there, a fit and strokes, and changes it as little as the volumes ask.
    The result takes the place of both; strokes that are made later follow it. Where tissue slides,
    as along the falx, or was removed without a cavity, the result is wrong.

    - `filter`: a Free-Form Deformation. Its `Lattice` becomes the result, and its `Strokes` become
      empty.
    - `reference`: a Compare Volumes of the deformation, with its cavity and with the reference
      where it lies; or a ParaView source of the reference.
    - `similarity`: "auto" for any contrast, "same contrast", or "ultrasound" if the reference is
      one.
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

    import numpy
    from paraview import simple

    if similarity not in _SIMILARITIES:
        raise ValueError(f"similarity is {similarity!r}; it must be one of {_SIMILARITIES}")
    active = simple.GetActiveSource()
    compare, made = _compared(filter, reference, cavity)
    result = Refinement()
    try:
        run = _Run(compare, "BeginRefinement", Similarity=_SIMILARITIES.index(similarity),
                   Stiffness=float(stiffness))
        before = numpy.array(run.answer("ControlPoints")).reshape(-1, 3)
        run.steps(result, callback)
        after = numpy.array(run.answer("ControlPoints")).reshape(-1, 3)
    finally:
        if made:
            simple.Delete(compare)
        simple.SetActiveSource(active)
    if result.compared == 0.0:
        raise ValueError("the volumes have nothing in common to compare; nothing was changed")
    changes = numpy.linalg.norm(after - before, axis=1)
    result.largest_change, result.mean_change = float(changes.max()), float(changes.mean())
    result.strokes = tuple(filter.Strokes)
    result.filter = _hold(filter, after)
    result.smallest_determinant = filter.GetPropertyValue("MinimumJacobian")
    simple.SetActiveSource(active)
    if result.disagreement > result.disagreement_before:
        warnings.warn("The volumes disagree more than before the refinement", stacklevel=2)
    return result
