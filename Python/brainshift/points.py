# SPDX-License-Identifier: BSD-3-Clause
"""Reads and maps files of landmarks and traced points."""

import collections

from .files import _write

_DIRECTIONS = {"forward": "Forward", "backward": "Backward"}

Points = collections.namedtuple("Points", "positions labels numbers times deviations")


def _reader(name, volume, table_axes):
    """A Landmark Reader that has read a file; an error with the reason if it could not."""
    from paraview import simple

    reader = simple.LandmarkReader(FileName=name, Volume=volume, TableAxes=table_axes)
    reader.UpdatePipeline()
    reader.SMProxy.UpdatePropertyInformation()
    problem = reader.GetPropertyValue("Problem")
    if problem:
        simple.Delete(reader)
        raise ValueError(problem)
    return reader


def _labels(array, count):
    return [array.GetValue(i) for i in range(count)] if array else [""] * count


def read_points(name, volume=1, table_axes="RAS"):
    """Read landmarks or traced points from a file.

    - `name`: path of the file. It ends in `.mrk.json`, `.json`, `.fcsv`, `.tag`, `.csv` or `.tsv`.
    - `volume`: 1, the default, or 2, the volume of an MNI tag file whose points are read.
    - `table_axes`: `"RAS"`, the default, or `"LPS"`, the axes of a table whose columns are called
      x, y and z.

    Returns a named tuple of `positions`, an N x 3 array in mm, RAS; `labels`, a list of N strings;
    and `numbers`, `times` and `deviations`, arrays of N numbers. A number that the file does not
    say is NaN.

    Raises `ValueError` with the reason if the file cannot be read.
    """
    import numpy
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import vtk_to_numpy

    active = simple.GetActiveSource()
    reader = _reader(name, volume, table_axes)
    try:
        points = servermanager.Fetch(reader)
        count = points.GetNumberOfPoints()
        arrays = points.GetPointData()

        def numbers(array):
            stored = arrays.GetArray(array)
            return vtk_to_numpy(stored).copy() if stored else numpy.full(count, numpy.nan)
        positions = (vtk_to_numpy(points.GetPoints().GetData()).copy() if count
                     else numpy.empty((0, 3)))
        return Points(positions, _labels(arrays.GetAbstractArray("Label"), count),
                      numbers("Number"), numbers("Time"), numbers("Deviation"))
    finally:
        simple.Delete(reader)
        simple.SetActiveSource(active)


def map_points(file_in, file_out, filter=None, direction="forward", volume=1, table_axes="RAS",
               file_axes="Of The Format"):
    """Map the points of a file and write them to another file, labels and all.

    - `file_in`: path of the file to read, in a format of `read_points`.
    - `file_out`: path of the file to write, in a format of `read_points`. Its ending chooses the
      format. Times and deviations are kept by `.csv` and `.tsv` only.
    - `filter`: a Free-Form Deformation. The default, `None`, leaves the points where they are and
      only changes the format.
    - `direction`: `"forward"`, the default, maps points at rest to where they go. `"backward"`
      maps points in the deformed volume to the tissue that is seen there.
    - `volume`: 1, the default, or 2, the volume of an MNI tag file whose points are read.
    - `table_axes`: `"RAS"`, the default, or `"LPS"`, the axes of a table whose columns are called
      x, y and z.
    - `file_axes`: `"RAS"` or `"LPS"`, the axes in the file to write, which names them. The
      default, `"Of The Format"`, writes LPS to files of Slicer and RAS to all others.

    Both files lie on the machine that has the volume. The new file takes the place of an old one
    only when the disk holds all of it.

    Returns the number of points.

    Raises `ValueError` if `direction` is another word, `file_in` cannot be read or `filter`
    attaches no deformation, and `OSError` with the reason if `file_out` is not written.
    """
    from paraview import servermanager, simple

    if str(direction).lower() not in _DIRECTIONS:
        raise ValueError(f'direction is {direction!r}; it must be "forward" or "backward"')
    active = simple.GetActiveSource()
    made = [_reader(file_in, volume, table_axes)]
    try:
        if filter is not None:
            made.append(simple.DeformGeometry(Input=made[0], Deformation=filter,
                                              Direction=_DIRECTIONS[str(direction).lower()]))
            made[1].UpdatePipeline()
        count = made[0].GetDataInformation().GetNumberOfPoints()
        if made[-1].GetDataInformation().GetNumberOfPoints() != count:
            raise ValueError("filter attaches no deformation; it must be a Free-Form Deformation")
        writer = servermanager.writers.LandmarkWriter(
            Input=made[-1], FileName=file_out, FileAxes=file_axes)
        _write(writer, file_out)
        return count
    finally:
        for proxy in reversed(made):
            simple.Delete(proxy)
        simple.SetActiveSource(active)
