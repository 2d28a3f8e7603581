# SPDX-License-Identifier: BSD-3-Clause
"""Reads and maps files of landmarks and traced points."""

import collections
import os

from .files import _write, reason_of
from .transforms import Transform, read_transform

_DIRECTIONS = {"forward": "Forward", "backward": "Backward"}

Points = collections.namedtuple("Points", "positions labels numbers times deviations")


def _reader(name, volume, table_axes, columns=None):
    """A Landmark Reader that has read a file; an error with the reason if it could not."""
    from paraview import simple

    named = {} if columns is None else {"PositionColumns": list(columns)}
    reader = simple.LandmarkReader(FileName=name, Volume=volume, TableAxes=table_axes, **named)
    reader.UpdatePipeline()
    problem = reason_of(reader)
    if problem:
        simple.Delete(reader)
        raise ValueError(problem)
    return reader


def _labels(array, count):
    return [array.GetValue(i) for i in range(count)] if array else [""] * count


def read_from(source):
    """The points of a source, as `read_points` returns them."""
    import numpy
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = servermanager.Fetch(source)
    count = points.GetNumberOfPoints()
    arrays = points.GetPointData()

    def numbers(array):
        stored = arrays.GetArray(array)
        return vtk_to_numpy(stored).copy() if stored else numpy.full(count, numpy.nan)
    positions = (vtk_to_numpy(points.GetPoints().GetData()).copy() if count
                 else numpy.empty((0, 3)))
    return Points(positions, _labels(arrays.GetAbstractArray("Label"), count),
                  numbers("Number"), numbers("Time"), numbers("Deviation"))


def read_points(name, volume=0, table_axes="RAS", columns=None):
    """Read landmarks or traced points from a file.

    - `name`: path of the file. It ends in `.mrk.json`, `.json`, `.fcsv`, `.tag`, `.csv` or `.tsv`.
    - `volume`: 1 or 2, the volume of an MNI tag file whose points are read. The default, `0`, reads
      the first, with a warning if there are two.
    - `table_axes`: `"RAS"`, the default, or `"LPS"`, the axes of a table whose columns are called
      x, y and z.
    - `columns`: names of the three columns of a table that hold the position, in the order x, y, z.
      Axes, units and signs in these names count: L, A, S; `native_x_lps`; `z_cm`; `-x`. The
      default, `None`, takes those whose names mean a position.

    Returns a named tuple of `positions`, an N x 3 array in mm, RAS; `labels`, a list of N strings;
    and `numbers`, `times` and `deviations`, arrays of N numbers. A number that the file does not
    have is NaN. Labels of a table come from `label` or `name`, else from the column that is called
    as names are, or whose words all differ; a warning says which.

    Raises `ValueError` with the reason if the file cannot be read.
    """
    from paraview import simple

    active = simple.GetActiveSource()
    reader = _reader(os.fspath(name), volume, table_axes, columns)
    try:
        return read_from(reader)
    finally:
        simple.Delete(reader)
        simple.SetActiveSource(active)


def _moved_by(filter, points, direction):
    """The points of a source, moved by a Free-Form Deformation."""
    from paraview import simple

    moved = simple.DeformGeometry(Input=points, Deformation=filter, Direction=direction)
    moved.UpdatePipeline()
    count = points.GetDataInformation().GetNumberOfPoints()
    if moved.GetDataInformation().GetNumberOfPoints() != count:
        simple.Delete(moved)
        raise ValueError("filter attaches no deformation; it must be a Free-Form Deformation")
    return moved


def taken_by(report, points, direction):
    """The points of a source, taken along by a transform, in the process that has them; in no
    pipeline yet."""
    from paraview import servermanager

    moved = servermanager.misc.TransformPoints(Input=points, Direction=direction)
    moved.SMProxy.GetProperty("Transform").SetProxy(0, report)
    moved.SMProxy.UpdateVTKObjects()
    moved.UpdatePipeline()
    return moved


def _report_in_ras(transform):
    """The proxy of a transform that is in RAS, as all points are."""
    if transform._report.GetProperty("World").GetElement(0) != 0:
        raise ValueError("transform was read with world='LPS'; the points are RAS, so read it with "
                         "world='RAS'")
    return transform._report


def _path(name, value):
    """The path of a file. An array goes to other functions."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(
            f"{name} is a {type(value).__name__}; map_points takes paths of files. Arrays go to "
            "deformed_from_rest(filter, points), rest_from_deformed(filter, points), "
            "Fit.measured_from_rest(points) or read_transform(files).map(points)")
    return os.fspath(value)


def map_points(file_in, file_out, filter=None, direction="forward", volume=0, table_axes="RAS",
               file_axes="Of The Format", transform=None, columns=None):
    """Map the points of a file and write them to another file, labels and all.

    - `file_in`: path of the file to read, in a format of `read_points`.
    - `file_out`: path of the file to write, in a format of `read_points`. Its ending chooses the
      format. Times and deviations are kept by `.csv` and `.tsv` only.
    - `filter`: a Free-Form Deformation. The default, `None`, does not move the points and
      only changes the format, unless there is a `transform`.
    - `direction`: with a `filter`, `"forward"`, the default, maps points of the rest frame to the
      deformed frame, and `"backward"` maps points of the deformed frame to the rest frame. With a
      `transform`, `"forward"` takes points of the fixed image to the moving image, as the files do,
      and `"backward"` takes points of the moving image to the fixed image.
    - `volume`, `table_axes`, `columns`: as in `read_points`.
    - `file_axes`: `"RAS"` or `"LPS"`, the axes in the file to write, which names them. The
      default, `"Of The Format"`, writes LPS to files of Slicer and RAS to all others.
    - `transform`: instead of a `filter`, a transform of a registration program: the `files` of
      `read_transform`, in its order, or its result. Points outside a B-spline or a field do not
      move, as in ITK.

    All files are on the machine that has the volume. The new file takes the place of an old one
    only when the disk holds all of it.

    Returns the number of points.

    Raises `TypeError` if a file is no path; arrays go to `deformed_from_rest`,
    `rest_from_deformed` or `Transform.map`. Raises `ValueError` if `direction` is another word,
    `file_in` cannot be read, `filter` attaches no deformation, or there are a `filter` and a
    `transform`. Raises `OSError` with the reason if the transform cannot be read, if a point maps
    to no finite position, or if `file_out` is not written.
    """
    from paraview import servermanager, simple

    file_in, file_out = _path("file_in", file_in), _path("file_out", file_out)
    leads = _DIRECTIONS.get(str(direction).lower())
    if leads is None:
        raise ValueError(f'direction is {direction!r}; it must be "forward" or "backward"')
    if filter is not None and transform is not None:
        raise ValueError("filter and transform are both given; name one of them")
    if transform is not None and not isinstance(transform, Transform):
        transform = read_transform(transform)
    active = simple.GetActiveSource()
    points = _reader(file_in, volume, table_axes, columns)
    moved = None
    try:
        if filter is not None:
            moved = _moved_by(filter, points, leads)
        elif transform is not None:
            moved = taken_by(_report_in_ras(transform), points, leads)
        writer = servermanager.writers.LandmarkWriter(
            Input=moved or points, FileName=file_out, FileAxes=file_axes)
        _write(writer, file_out)
        return points.GetDataInformation().GetNumberOfPoints()
    finally:
        if filter is not None and moved is not None:
            simple.Delete(moved)
        simple.Delete(points)
        simple.SetActiveSource(active)
