# SPDX-License-Identifier: BSD-3-Clause
"""BrainShift's helpers for pvpython: strokes to bend a volume with, maps and picks to measure it.

    import brainshift
    ffd.Strokes = brainshift.stamp(anchor, toward, 10.0) + brainshift.move(point, (0, 0, 2))

A stroke is a tuple of 14 numbers; concatenated tuples are what the property `Strokes` of
Free-Form Deformation holds. All positions are millimetres in world axes.

Research software, not a medical device.
"""

import math

MOVE, SOFT, STAMP = 0, 1, 2

#: Numbers in one stroke.
NUMBERS_PER_STROKE = 14


def _vector(name, values):
    vector = tuple(float(value) for value in values)
    if len(vector) != 3:
        raise ValueError(f"{name} has {len(vector)} numbers; it must have 3")
    if not all(math.isfinite(value) for value in vector):
        raise ValueError(f"{name} is {vector}; its numbers must be finite")
    return vector


def _positive(name, value, unit=" mm"):
    value = float(value)
    if not (math.isfinite(value) and value > 0.0):
        raise ValueError(f"{name} is {value}{unit}; it must be above 0{unit}")
    return value


def move(anchor, vector, spacing=(0.0, 0.0, 0.0)):
    """Move the one control point nearest to `anchor` (mm, rest frame) by `vector` (mm).

    `spacing`: distance between control points (mm along each lattice axis) that the stroke is
    meant for; a denser lattice then replays it as that control point's basis function. 0 0 0, the
    default: the spacing of the lattice it meets.
    """
    spacing = _vector("spacing", spacing)
    return (MOVE,) + _vector("anchor", anchor) + _vector("vector", vector) + spacing + (
        max(spacing), 0.0, 0.5, 1)


def soft(anchor, vector, radius, sigma=0.5):
    """Move all control points within `radius` (mm) of `anchor` (mm, deformed frame).

    Their share of `vector` (mm) is a Gaussian of the distance, `sigma` wide as a share of the
    radius, that falls smoothly to 0 at the radius.
    """
    return (SOFT,) + _vector("anchor", anchor) + _vector("vector", vector) + (0.0, 0.0, 0.0) + (
        _positive("radius", radius), 0.0, _positive("sigma", sigma, ""), 1)


def stamp(anchor, toward, amount, major=40.0, minor=25.0, sigma=0.5):
    """Pull (`amount` above 0, mm) or push (below 0) tissue around `anchor` (mm, deformed frame).

    The stroke acts within an ellipsoid of revolution around the anchor whose long axis points at
    `toward` (mm), the point of interest: `major` mm along it, `minor` mm across. Pull is away from
    the point of interest. `sigma`: width of the Gaussian as a share of the radii.
    """
    anchor = _vector("anchor", anchor)
    toward = _vector("toward", toward)
    away = tuple(a - t for a, t in zip(anchor, toward))
    length = math.sqrt(sum(value * value for value in away))
    if length == 0.0:
        raise ValueError(f"anchor and toward are both {anchor}; they must differ")
    amount = float(amount)
    vector = _vector("amount times direction", (amount * value / length for value in away))
    axis = tuple(-value / length for value in away)
    return (STAMP,) + anchor + vector + axis + (
        _positive("major", major), _positive("minor", minor), _positive("sigma", sigma, ""), 1)


def _report(representation, view=None):
    """The proxy that answers for a representation, in the process that draws it."""
    shown_as = getattr(representation, "Representation", None)
    if shown_as != "Deformed Volume":
        raise ValueError(f"the representation is {shown_as}; it must be Deformed Volume")
    manager = representation.SMProxy.GetSessionProxyManager()
    report = manager.NewProxy("misc", "DeformedVolumeReport")
    report.UnRegister(None)  # Python holds it
    report.PrototypeOn()  # questions are no steps to undo
    report.GetProperty("Representation").AddProxy(representation.SMProxy)
    if view is not None:
        report.GetProperty("View").AddProxy(view.SMProxy)
    report.UpdateVTKObjects()
    return report


def _told(report, name):
    told = report.GetProperty(name)
    report.UpdatePropertyInformation(told)
    return told


def pick(representation, view, x, y):
    """Position (mm, world, deformed frame) of the tissue that `view` shows at a pixel, or None.

    `x`, `y`: pixels from the view's lower left corner, in the picture drawn last; nothing is drawn.
    Tissue is where the opacity along the ray reaches one half. `representation` is shown in `view`
    as Deformed Volume.
    """
    if representation not in view.Representations:
        raise ValueError("the representation is not shown in this view")
    report = _report(representation, view)
    report.GetProperty("Pixel").SetElements2(int(x), int(y))
    report.UpdateVTKObjects()
    tissue = _told(report, "Tissue")
    *position, found = (tissue.GetElement(i) for i in range(4))
    return tuple(position) if found else None


def _numbers(representation):
    lines = _told(_report(representation), "Counters").GetElement(0).splitlines()
    return {name: int(number) for name, number in (line.split() for line in lines)}


def counters(representation):
    """What the Deformed Volume renderer of a representation did since it was made, as a dict:
    frames, volumeUploads, latticeUploads, transferUploads, bytesUploaded, texelsRefined,
    presenceUpdates, skippingBytes (faces and leaps made of the presence map), samplesTaken and
    samplesSkipped (while the representation's CountSamples is on), imageScale (screen pixels a side for one drawn), programsCompiled."""
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if not name.startswith("gpu")}


def gpu(representation):
    """How things are on the GPU, as a dict: gpuScalarBytes (the volume's scalars), gpuOtherBytes (all
    other textures and buffers, those as large as the picture included), gpuFieldMicroseconds (its last
    run from control points to offset field; 0 where the driver does not tell)."""
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if name.startswith("gpu")}
