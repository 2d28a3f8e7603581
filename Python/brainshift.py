# SPDX-License-Identifier: BSD-3-Clause
"""BrainShift's helpers for pvpython: strokes to bend a volume with, maps and picks to measure it.

    import brainshift
    ffd.Strokes = brainshift.stamp(anchor, toward, 10.0) + brainshift.move(point, (0, 0, 2))

A stroke is a tuple of 14 numbers; concatenated tuples are what the property `Strokes` of
Free-Form Deformation holds. All positions are millimetres in world axes.

Research software, not a medical device.
"""

import math

from brainshift_views import four_views  # noqa: F401 part of this module

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


def _mapped(filter, points, direction):
    """N x 3 positions (mm), mapped by Deform Geometry where the volume is."""
    import numpy
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = numpy.asarray(points, float)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"points has the shape {points.shape}; it must be N x 3")
    if len(points) == 0:
        return points.copy()
    active = simple.GetActiveSource()
    source = simple.PolyPointSource(Points=points.ravel().tolist())
    moved = simple.DeformGeometry(Input=source, Deformation=filter, Direction=direction)
    try:
        result = servermanager.Fetch(moved).GetPoints()
        if result is None:
            raise ValueError("filter attaches no deformation; it must be a Free-Form Deformation")
        return vtk_to_numpy(result.GetData()).copy()
    finally:
        simple.Delete(moved)
        simple.Delete(source)
        simple.SetActiveSource(active)


def deformed_from_rest(filter, points):
    """Where tissue at rest goes: N x 3 positions (mm, world) to N x 3 positions.

    `filter`: a Free-Form Deformation. The map is the cubic itself, not the field pictures are
    drawn with; it is evaluated where the volume is, so it works with a server too.
    """
    return _mapped(filter, points, "Forward")


def rest_from_deformed(filter, points):
    """Which tissue is seen: the inverse of deformed_from_rest, N x 3 positions (mm, world)."""
    return _mapped(filter, points, "Backward")


def _write(writer, name):
    """Runs a writer proxy; raises if no file came of it. A server's files are not looked for."""
    import os
    from paraview import servermanager

    here = not servermanager.ActiveConnection.IsRemote()
    if here and os.path.exists(name):
        os.remove(name)
    writer.UpdatePipeline()
    if here and not os.path.exists(name):
        raise OSError(f"{name} was not written; the output window tells why")


def save_lattice(filter, name):
    """Writes the control points of a Free-Form Deformation, as drawn, into an image file (.vti)."""
    from paraview import simple

    lattice = simple.DeformationLattice(Input=filter)
    try:
        simple.SaveData(name, proxy=lattice)
    finally:
        simple.Delete(lattice)


def load_lattice(filter, name):
    """Makes a file of save_lattice the base lattice of a Free-Form Deformation, with the density
    and the kernel it was saved with. Its strokes add to it. Returns the reader."""
    from paraview import simple

    reader = simple.XMLImageDataReader(FileName=[name])
    reader.UpdatePipeline()
    information = reader.GetDataInformation()
    low_x, high_x, low_y, high_y, low_z, high_z = information.GetExtent()
    kernel = information.GetFieldDataInformation().GetArrayInformation("FFDKernel")
    filter.Lattice = reader
    filter.LatticeDimensions = [high_x - low_x + 1, high_y - low_y + 1, high_z - low_z + 1]
    if kernel is not None:
        filter.Kernel = int(kernel.GetComponentRange(0)[0])
    return reader


def save_field(filter, name, direction="Backward", spacing=None, world="RAS"):
    """Writes the dense displacement field (mm) of a Free-Form Deformation for other programs.

    `name`: .nii, .nii.gz, .mha, .mhd or .nrrd; each names the direction. `direction`: "Backward",
    which ITK, ANTs, elastix and Slicer resample with, or "Forward". `spacing`: mm along the
    volume's axes, three numbers; None: on the volume's own points. `world`: the volume's, "RAS" or
    "LPS".
    """
    from paraview import servermanager, simple

    grid = {} if spacing is None else {
        "SampleGrid": "Given Spacing", "Spacing": list(_vector("spacing", spacing))}
    field = simple.DeformationField(Input=filter, Direction=direction, **grid)
    try:
        writer = servermanager.writers.DisplacementFieldWriter(
            Input=field, FileName=name, World=world)
        _write(writer, name)
    finally:
        simple.Delete(field)


def load_field(name, direction="As Stored In The File", world="RAS"):
    """Opens a displacement field of ANTs, elastix, NiftyReg, Slicer or save_field; returns a source
    that leads forward, to be the Lattice of a Free-Form Deformation.

    A field that leads backward, as those of registration programs do, is inverted on its own
    points. `direction`: "Forward" or "Backward" if you know better than the file. `world`: that of
    the volume to bend, "RAS" or "LPS".
    """
    from paraview import simple

    reader = simple.DisplacementFieldReader(FileName=name, Direction=direction, World=world)
    reader.UpdatePipeline()
    leads = reader.GetDataInformation().GetFieldDataInformation().GetArrayInformation(
        "DisplacementDirection")
    if leads is None:
        raise ValueError(f"{name} is no displacement field; the output window tells why")
    return reader if leads.GetStringValue(0) == "forward" else (
        simple.InvertDisplacementField(Input=reader))


def _report(representation, view=None, wanted=("Deformed Volume", "Deformed Slices")):
    """The proxy that answers for a representation, in the process that draws it."""
    shown_as = getattr(representation, "Representation", None)
    if shown_as not in wanted:
        raise ValueError(f"the representation is {shown_as}; it must be {' or '.join(wanted)}")
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
    Tissue is where the opacity along the ray reaches one half, or the slice that is seen.
    `representation` is shown in `view` as Deformed Volume or Deformed Slices.
    """
    if representation not in view.Representations:
        raise ValueError("the representation is not shown in this view")
    report = _report(representation, view)
    report.GetProperty("Pixel").SetElements2(int(x), int(y))
    report.UpdateVTKObjects()
    tissue = _told(report, "Tissue")
    *position, found = (tissue.GetElement(i) for i in range(4))
    return tuple(position) if found else None


def slice_axes(representation):
    """How the planes of Deformed Slices lie: three directions (world, towards greater coordinates)
    that the sagittal, the coronal and the axial plane lie across, and the distances (mm) between
    voxels along them. They are known once the representation was drawn."""
    report = _report(representation, wanted=("Deformed Slices",))
    normals, steps = _told(report, "SliceNormals"), _told(report, "VoxelSteps")
    directions = tuple(tuple(normals.GetElement(3 * plane + i) for i in range(3))
                       for plane in range(3))
    return directions, tuple(steps.GetElement(plane) for plane in range(3))


def _numbers(representation):
    lines = _told(_report(representation), "Counters").GetElement(0).splitlines()
    return {name: int(number) for name, number in (line.split() for line in lines)}


def counters(representation):
    """What the renderer of a Deformed Volume or of Deformed Slices did since it was made, as a dict:
    frames, pixelsCast (of their images, about), volumeUploads, latticeUploads, transferUploads,
    segmentUploads, bytesUploaded, texelsRefined, presenceUpdates, skippingBytes (faces and leaps made
    of the presence map), samplesTaken and samplesSkipped (while the representation's CountSamples is
    on), imageScale (screen pixels a side for one drawn), programsCompiled."""
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if not name.startswith("gpu")}


def gpu(representation):
    """How things are on the GPU, as a dict: gpuScalarBytes (the volume's scalars), gpuOtherBytes (all
    other textures and buffers, those as large as the picture included), gpuFieldMicroseconds (its last
    run from control points to offset field; 0 where the driver does not tell)."""
    numbers = _numbers(representation)
    return {name: number for name, number in numbers.items() if name.startswith("gpu")}
