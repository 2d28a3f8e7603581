# SPDX-License-Identifier: BSD-3-Clause
"""Transforms of registration programs: read, used and written."""

import math
import os
import warnings

from .files import require_read, save_field
from .views import world_axes

#: Reverses x and y: from LPS, in which ITK's files are, to RAS and back.
_LPS = (-1.0, -1.0, 1.0, 1.0)
_DIRECTIONS = ("backward", "forward")
#: Solved positions that miss by more (mm) are told.
_TOLD_MISS_MM = 1e-3
#: Programs whose files do not name them, and their words in the property MatrixProgram.
_PROGRAMS = {None: "Unknown", "fsl": "FSL", "niftyreg": "NiftyReg", "spm": "SPM"}


def _direction(direction):
    if str(direction).lower() not in _DIRECTIONS:
        raise ValueError(f"direction is {direction!r}; it must be 'backward' or 'forward'")
    return str(direction).lower()


def _names(files):
    names = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    if not names:
        raise ValueError("files is empty; it must name a transform")
    return [os.fspath(name) for name in names]


def _program(program):
    word = program.lower() if isinstance(program, str) else program
    if word not in _PROGRAMS:
        raise ValueError(f"program is {program!r}; it must be 'fsl', 'niftyreg', 'spm' or "
                         "None")
    return _PROGRAMS[word]


def _report(files, world, fixed_image, moving_image, program):
    """The report on files, in the process that reads them."""
    from paraview import simple
    manager = simple.servermanager.ProxyManager().SMProxyManager
    report = manager.NewProxy("misc", "TransformReport")
    report.UnRegister(None)  # Python holds it
    report.PrototypeOn()  # a question is no step to undo
    report.GetProperty("FileName").SetElement(0, files[0])
    for i, name in enumerate(files[1:]):
        report.GetProperty("LaterFileNames").SetElement(i, name)
    report.GetProperty("FixedImage").SetElement(0, os.fspath(fixed_image or ""))
    report.GetProperty("MovingImage").SetElement(0, os.fspath(moving_image or ""))
    report.GetProperty("MatrixProgram").SetElement(0, list(_PROGRAMS.values()).index(program))
    report.GetProperty("World").SetElement(0, ("RAS", "LPS").index(world))
    report.UpdateVTKObjects()
    report.UpdatePropertyInformation()
    problem = report.GetProperty("Problem").GetElement(0)
    if problem:
        raise OSError(problem)
    return report


def _answer(report, name):
    import numpy
    answer = report.GetProperty(name)
    return numpy.array([answer.GetElement(i) for i in range(answer.GetNumberOfElements())])


class Transform:
    """The result of `read_transform`.

    - `kind`: `"identity"`, `"rigid"`, `"affine"` or `"nonlinear"`.
    - `moving_from_fixed`: a 4 x 4 array that takes points of the fixed image to the moving image
      (mm, world axes), or `None` if the transform is nonlinear.
    """

    def __init__(self, report):
        self._report = report
        self.kind = report.GetProperty("Kind").GetElement(0)
        self._knows_sides = bool(report.GetProperty("KnowsSides").GetElement(0))
        rows = _answer(report, "Matrix")
        self.moving_from_fixed = rows.reshape(4, 4) if len(rows) else None

    def map(self, points):
        """Take points of the fixed image to the moving one.

        - `points`: an N x 3 array of positions in mm, world axes.

        Returns an N x 3 array of positions in mm, world axes. A point outside a B-spline or a field
        does not move, as in ITK. A point where the field has no finite number becomes NaN. Files
        that store the inverse of a map are solved for each point, as in `map_back`.
        """
        return self._mapped(points, "MappedPoints")

    def map_back(self, points):
        """Take points of the moving image to the fixed one: the inverse of `map`, solved for each
        point. Points and result as in `map`. Where the map folds, one of its places is returned.
        Where it jumps, the best position that was found; a warning says how far it misses.
        """
        return self._mapped(points, "MappedBackPoints")

    def _mapped(self, points, answer):
        import numpy
        points = numpy.asarray(points, float)
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError(f"points has the shape {points.shape}; it must be N x 3")
        numbers = points.ravel().tolist()
        if not numbers:
            return points.copy()
        self._report.GetProperty("Points").SetNumberOfElements(len(numbers))
        self._report.GetProperty("Points").SetElements(numbers)
        self._report.UpdateVTKObjects()
        self._report.UpdatePropertyInformation()
        mapped = _answer(self._report, answer).reshape(-1, 4)
        missed = mapped[:, 3] > _TOLD_MISS_MM
        if missed.any():
            warnings.warn(f"{missed.sum()} of {len(points)} points miss their positions by up to "
                          f"{mapped[:, 3].max():.2g} mm: the transform folds or jumps there.",
                          stacklevel=3)
        return mapped[:, :3].copy()


def read_transform(files, world="RAS", fixed_image=None, moving_image=None, program=None):
    """Read a transform of ITK, Slicer, ANTs, elastix, FSL, FreeSurfer, SPM, NiftyReg or MINC.

    Such a transform takes points of the fixed image to the moving one. Images are resampled with
    it.

    - `files`: path of a file, or a list of paths. Points of the fixed image pass them in order, as
      with the options `-t` of `antsApplyTransforms`: `["1Warp.nii.gz", "0GenericAffine.mat"]`. The
      files are read where the volumes are.
    - `world`: `"RAS"`, the default, or `"LPS"`, the world axes of your points and volumes.
    - `fixed_image`, `moving_image`: the NIfTI files of the options `-ref` and `-in` of FSL's
      `flirt` and `fnirt`. FSL's matrices and coefficients are undefined without both, its warps
      without the moving image. An `.lta` leads from its `src` to its `dst`: without images, `src`
      is the moving image, as FreeSurfer has it. Other files do not need images.
    - `program`: the program that wrote a file that does not name it. `"fsl"`, a text of 16 numbers.
      `"niftyreg"`, such a text from RAS to RAS, from the fixed image to the moving one. `"spm"`, a
      NIfTI file of three numbers at each voxel: positions in RAS, as in SPM's `y_` and `iy_` files.
      The default, `None`, counts as `"fsl"` if an image is named; else such a file is refused.

    Returns a `Transform` with `kind`, `moving_from_fixed`, `map(points)` and `map_back(points)`.

    Raises `OSError` with the reason if a file cannot be read.
    """
    return Transform(_report(_names(files), world, fixed_image, moving_image, _program(program)))


def _rotation_degrees(rotation):
    """Angles about x, then y, then z of a rotation matrix."""
    y = math.asin(max(-1.0, min(1.0, -rotation[2, 0])))
    if abs(rotation[2, 0]) < 1.0 - 1e-12:
        x = math.atan2(rotation[2, 1], rotation[2, 2])
        z = math.atan2(rotation[1, 0], rotation[0, 0])
    else:  # x and z rotate about the same axis
        x, z = math.atan2(-rotation[1, 2], rotation[1, 1]), 0.0
    return [math.degrees(angle) for angle in (x, y, z)]


def _middle(source):
    import numpy
    source.UpdatePipeline()
    bounds = source.GetDataInformation().GetBounds()
    return numpy.array([(bounds[i] + bounds[i + 1]) / 2.0 for i in (0, 2, 4)])


def _warn_of_sides(source, noun, world):
    """Warns if a volume does not lie in the world of a transform, or does not say where it lies."""
    import warnings
    source.UpdatePipeline()
    axes = world_axes(source)
    if axes != world:
        warnings.warn(f"The world axes of {noun} are {axes or 'unknown'}, and those of the "
                      f"transform are {world or 'unknown'}: left and right may be exchanged "
                      "between them. Check it in a picture", stacklevel=4)


def _move_reference(compare, transform, direction, world):
    """Sets the rigid motion of a Compare Volumes."""
    import numpy
    if transform.kind not in ("identity", "rigid"):
        raise ValueError(f"the transform is {transform.kind}; Compare Volumes moves its reference "
                         "rigidly, so it must be rigid. Free-Form Deformation takes any transform")
    _warn_of_sides(compare.Reference, "the reference", world if transform._knows_sides else None)
    matrix = transform.moving_from_fixed
    drawn_from_loaded = matrix if direction == "forward" else numpy.linalg.inv(matrix)
    left, _, right = numpy.linalg.svd(drawn_from_loaded[:3, :3])
    middle = _middle(compare.Reference)
    compare.ReferenceRotation = _rotation_degrees(left @ right)
    compare.ReferenceTranslation = list(
        drawn_from_loaded[:3, :3] @ middle + drawn_from_loaded[:3, 3] - middle)


def _bend(bent, files, options):
    """Makes a transform the base lattice of a Free-Form Deformation; returns the error in mm."""
    from paraview import simple
    active = simple.GetActiveSource()
    reader = simple.TransformReader(
        Volume=bent.Input, **options,  # before the name: it reads as soon as it has one
        FileName=files[0], LaterFileNames=files[1:],
        LatticeDimensions=bent.LatticeDimensions, Kernel=bent.Kernel)
    require_read(reader, active)
    bent.Lattice = reader
    simple.SetActiveSource(active)
    return reader.SMProxy.GetProperty("LargestError").GetElement(0)


def apply_transform(filter, files, direction="backward", world="RAS", fixed_image=None,
                    moving_image=None, program=None):
    """Deform a volume, or move a reference, with a transform of a registration program.

    - `filter`: a Free-Form Deformation or a Compare Volumes. A Free-Form Deformation gets the
      transform as its `Lattice`, for its present `LatticeDimensions` and `Kernel`; strokes add to
      it. A Compare Volumes moves its reference; the transform must be rigid.
    - `files`, `world`, `fixed_image`, `moving_image`, `program`: as in `read_transform`.
    - `direction`: `"backward"`, the default, if the volume to deform or move was the moving
      image: the transform takes points of the picture to points of the volume as loaded.
      `"forward"`, if it was the fixed image: the transform takes points of the volume as loaded
      to points of the picture.

    Returns the largest distance in mm between the lattice and the transform, measured between
    control points, and 0 for Compare Volumes. More `LatticeDimensions` make it smaller.

    Raises `OSError` with the reason if a file cannot be read, and `ValueError` if the filter cannot
    use the transform, or if `"forward"` a control point has no finite number. If `"backward"` a
    warning names the control points that have none; the tissue there stays. Another one says that
    the volume or the reference does not carry the world axes `world`.
    """
    direction, files = _direction(direction), _names(files)
    kind = filter.SMProxy.GetXMLName()
    if kind not in ("FreeFormDeformation", "CompareVolumes"):
        raise ValueError(f"filter is a {kind}; it must be a Free-Form Deformation or a Compare "
                         "Volumes")
    transform = read_transform(files, world, fixed_image, moving_image, program)
    if kind == "CompareVolumes":
        _move_reference(filter, transform, direction, world)
        return 0.0
    return _bend(filter, files, {
        "Direction": direction.capitalize(), "World": world, "MatrixProgram": _program(program),
        "FixedImage": os.fspath(fixed_image or ""), "MovingImage": os.fspath(moving_image or "")})


def _write_itk(name, kind, parameters, fixed):
    """Writes an ITK transform file as text. It replaces an old file only when it is complete."""
    beside = f"{name}.part"
    with open(beside, "w", encoding="ascii") as file:
        file.write("#Insight Transform File V1.0\n#Transform 0\n"
                   f"Transform: {kind}_double_3_3\n")
        for key, numbers in (("Parameters", parameters), ("FixedParameters", fixed)):
            file.write(f"{key}: " + " ".join(repr(float(number)) for number in numbers) + "\n")
        file.flush()
        os.fsync(file.fileno())
    os.replace(beside, name)


def _signs(world):
    import numpy
    return numpy.array(_LPS if world == "RAS" else (1.0, 1.0, 1.0, 1.0))


def _save_rigid(compare, name, direction, world):
    """The motion of a reference as an affine transform."""
    import numpy
    x, y, z = (math.radians(angle) for angle in compare.ReferenceRotation)
    (cx, sx), (cy, sy), (cz, sz) = ((math.cos(angle), math.sin(angle)) for angle in (x, y, z))
    rotation = (numpy.array(((cz, -sz, 0), (sz, cz, 0), (0, 0, 1)))
                @ numpy.array(((cy, 0, sy), (0, 1, 0), (-sy, 0, cy)))
                @ numpy.array(((1, 0, 0), (0, cx, -sx), (0, sx, cx))))
    middle = _middle(compare.Reference)
    matrix = numpy.eye(4)
    matrix[:3, :3] = rotation
    matrix[:3, 3] = middle - rotation @ middle + numpy.array(list(compare.ReferenceTranslation))
    if direction == "backward":
        matrix = numpy.linalg.inv(matrix)
    signs = _signs(world)
    matrix = signs[:, None] * matrix * signs
    _write_itk(name, "AffineTransform",
               [*matrix[:3, :3].ravel(), *matrix[:3, 3]], (0.0, 0.0, 0.0))


def _problem_of_spline(bent, direction):
    """The reason why a deformation is no B-spline of ITK, or None."""
    if direction != "forward":
        return "the backward map of a lattice is no B-spline"
    if bent.Kernel != "B-Spline":
        return f"the kernel is {bent.Kernel}; ITK's is B-Spline"
    bent.UpdatePipeline()
    fields = bent.GetDataInformation().GetFieldDataInformation()
    return "a mask cuts the cubic" if fields.GetArrayInformation("FFDMaskWeights") else None


def _save_spline(bent, name, world):
    """The lattice as ITK's B-spline: its control points, and those beside them once more."""
    import numpy
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
    source = simple.DeformationLattice(Input=bent)
    try:
        image = servermanager.Fetch(source)
        sides = image.GetDimensions()
        points = vtk_to_numpy(image.GetPointData().GetArray("Displacement")).astype(float)
        spacing = numpy.array(image.GetSpacing())
        matrix = image.GetDirectionMatrix()
        axes = numpy.array([[matrix.GetElement(i, j) for j in range(3)] for i in range(3)])
        origin = numpy.array(image.GetOrigin()) - axes @ spacing
    finally:
        simple.Delete(source)
    signs = _signs(world)[:3]
    lattice = numpy.pad(points.reshape(*reversed(sides), 3),
                        ((1, 1), (1, 1), (1, 1), (0, 0)), mode="edge") * signs
    fixed = [*(side + 2 for side in sides), *(signs * origin), *spacing,
             *(signs[:, None] * axes).ravel()]
    _write_itk(name, "BSplineTransform", numpy.moveaxis(lattice, 3, 0).ravel(), fixed)


def save_transform(filter, name, direction="backward", spacing=None, world="RAS"):
    """Save a deformation, or the motion of a reference, for ITK, ANTs, elastix or Slicer.

    - `filter`: a Free-Form Deformation or a Compare Volumes.
    - `name`: path of the file to write. A Compare Volumes goes into `.tfm` or `.txt`, as an affine
      transform. A Free-Form Deformation goes into `.nii`, `.nii.gz`, `.mha`, `.mhd` or `.nrrd`, as
      a displacement field; or into `.tfm` or `.txt`, as a cubic B-spline, where that is exact:
      forward, with the kernel B-Spline and without a mask. ITK's B-spline ends at the lattice. Text
      files are written where Python runs.
    - `direction`: `"backward"`, the default, takes points of the picture to points of the volume as
      loaded. Images are resampled with it. `"forward"` takes points of the volume as loaded to
      points of the picture.
    - `spacing`: distances in mm between the samples of a displacement field, as in `save_field`.
    - `world`: `"RAS"`, the default, or `"LPS"`, the world axes of the volume.

    Raises `ValueError` if the file cannot hold the map exactly, and `OSError` with the reason if it
    is not written.
    """
    direction, name = _direction(direction), os.fspath(name)
    kind = filter.SMProxy.GetXMLName()
    is_text = name.lower().endswith((".tfm", ".txt"))
    if is_text:
        _warn_of_sides(getattr(filter, "Reference", filter), "the volume", world)
    if kind == "CompareVolumes" and is_text:
        _save_rigid(filter, name, direction, world)
    elif kind == "FreeFormDeformation" and is_text:
        problem = _problem_of_spline(filter, direction)
        if problem:
            raise ValueError(f"{name} cannot hold this deformation exactly: {problem}. Save a "
                             "displacement field (.nii.gz, .mha, .nrrd) instead")
        _save_spline(filter, name, world)
    elif kind == "FreeFormDeformation":
        save_field(filter, name, direction.capitalize(), spacing, world)
    else:
        raise ValueError(f"a {kind} does not go into {name}; a Compare Volumes goes into .tfm or "
                         ".txt, a Free-Form Deformation also into files of displacement fields")
