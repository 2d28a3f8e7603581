# SPDX-License-Identifier: BSD-3-Clause
"""Finds the tissue under the contacts of electrode grids before the brain moved."""

import collections
import csv
import io
import json
import os

from .files import _write, reason_of
from .fitting import _cortex, _names, _opening, _point_axes, _points, fit
from .images import source_of
from .points import Points, read_points
from .views import warn_of_axes, world_axes

ElectrodeGrid = collections.namedtuple(
    "ElectrodeGrid", "name kind rows columns pitch by_labels labels missing")
ElectrodeGrid.__doc__ = """An electrode in a result of `electrodes`.

- `name`: what is before the numbers in the labels of its contacts
- `kind`: `"grid"`, `"strip"`, `"depth"` or `"unknown"`
- `rows`, `columns`: its shape; 1 row for a strip or a shaft, 0 if there is no order
- `pitch`: the distance between neighbours in mm
- `by_labels`: whether the numbers in the labels say the order; else the positions do
- `labels`: the labels of its places, row after row
- `missing`: those of contacts that the list lacks; without labels, by row and column, such as r2c3
"""

#: Columns of BIDS that say the shape of an electrode, and what the kinds are called there.
_KINDS = {"grid": "grid", "strip": "strip", "depth": "depth", "seeg": "depth"}


class Electrodes:
    """The result of `electrodes`. Lengths are mm, world axes.

    - `grids`: a list of `ElectrodeGrid`, strips and depth shafts among them
    - `names`: N labels of contacts, in the order of the input
    - `measured`: an N x 3 array, the contacts in the measured frame
    - `rest`: an N x 3 array, the tissue under each contact in the rest frame, on the cortex for
      grids. Other contacts are where they were measured.
    - `bent`: an N x 3 array, where that tissue is in the measured frame, on the bent cortex
    - `floating`: N distances of the contacts from the bent cortex, positive above it, negative for
      a contact that is buried, as all other contacts say; NaN for a contact on no grid
    - `off`: N booleans, whether a contact is not on the cortex
    - `deviation`: N standard deviations of `rest` along the cortex; NaN likewise. They assume that
      the cortex slides little: the contacts do not show it.
    - `leave_one_out`: N distances of the contacts from where all others predict them; NaN likewise
    - `row`, `column`: N integers from 1 on; 0 for a contact with no place on a grid
    - `label`: N numbers, as text, of the regions at `rest`, if labels were given; else empty
    - `missing`: a dict from the label of each contact that a grid lacks to its predicted position
      in the rest frame and in the measured frame, two arrays of 3 numbers
    - `fit`: the `Fit`, or `None`
    - `filter`: the Electrode Grids, a ParaView source
    - `warning`: doubts about electrodes and contacts that are not on the cortex, or empty

    Printed, it is a line of figures.
    """

    def __init__(self, source, axes):
        import numpy
        from paraview import servermanager
        from vtkmodules.util.numpy_support import vtk_to_numpy

        self.filter, self.fit, self.label, self._axes = source, None, [], axes
        self.warning = source.GetPropertyValue("Warning") or ""
        self.grids = _grids(source.GetPropertyValue("Electrodes") or "")
        output = servermanager.Fetch(source)
        arrays = output.GetPointData()
        count = output.GetNumberOfPoints()

        def numbers(name):
            return vtk_to_numpy(arrays.GetArray(name)).copy()
        found = numbers("Missing") == 0
        labels = arrays.GetAbstractArray("Label")
        names = [labels.GetValue(i) for i in range(count)]
        rest, bent = vtk_to_numpy(output.GetPoints().GetData()).copy(), numbers("Bent")
        self.missing = {names[i]: (rest[i], bent[i]) for i in numpy.nonzero(~found)[0]}
        self.names = [name for name, is_found in zip(names, found) if is_found]
        self.rest, self.bent, self.measured = rest[found], bent[found], numbers("Measured")[found]
        self.floating, self.deviation = numbers("Outside")[found], numbers("Deviation")[found]
        self.leave_one_out = numbers("LeftOut")[found]
        self._electrode = numbers("Electrode")[found] - 1
        self.row, self.column = numbers("Row")[found], numbers("Column")[found]
        self.off = (numbers("Weight")[found] == 0) & numpy.isfinite(self.floating)

    def __repr__(self):
        import numpy

        kinds = [f"{one.name or 'unnamed'} {one.kind} {one.rows} x {one.columns} at "
                 f"{one.pitch:.1f} mm" + (f", {len(one.missing)} missing" if one.missing else "")
                 for one in self.grids]
        words = [f"{len(self.names)} contacts: " + "; ".join(kinds)]
        on = numpy.isfinite(self.floating)
        if on.any():
            shift = numpy.linalg.norm(self.bent - self.rest, axis=1)[on]
            words.append(f"shift {shift.mean():.1f} mm (largest {shift.max():.1f})")
            known = self.leave_one_out[on & ~self.off]  # the sheet was made without the others
            if len(known):
                words.append(f"leave-one-out error {known.mean():.2f} mm (mean)")
            words.append(f"{int(self.off.sum())} not on the cortex")
        return "Electrodes: " + ", ".join(words) + (f". {self.warning}" if self.warning else "")

    def save(self, name):
        """Save the contacts at rest.

        - `name`: path of the file on this machine. `_electrodes.tsv` is BIDS, with
          `_coordsystem.json` beside it; `.mrk.json` are markups of Slicer; `.csv` and `.tsv` are
          tables with all figures. All are RAS mm, except markups, which are LPS as Slicer
          writes them. Contacts whose axes are not known count as RAS.

        A BIDS table has the position at rest of each contact, its electrode as `group`, its kind as
        `type` and its shape as `dimension`.

        Raises `ValueError` for another ending, or if the axes of the contacts are not RAS, and
        `OSError` if a file cannot be written, as markups while a server is connected.
        """
        name = os.fspath(name)
        if self._axes == "LPS":
            raise ValueError("the contacts are LPS; files are written for contacts that are RAS")
        if name.endswith("_electrodes.tsv"):
            _save_bids(self, name)
        elif name.endswith(".mrk.json"):
            _save_markups(self, name)
        elif name.endswith((".csv", ".tsv")):
            header, rows = _table(self)
            _save_table(name, header, rows)
        else:
            raise ValueError(f"{name} must end in _electrodes.tsv, .mrk.json, .csv or .tsv")


def _grids(text):
    """The lines of the property Electrodes."""
    grids = []
    for line in filter(None, text.split("\n")):
        name, kind, rows, columns, pitch, by_labels, labels, missing = line.split("\t")
        grids.append(ElectrodeGrid(
            name, kind, int(rows), int(columns), float(pitch), by_labels == "1",
            labels.split(",") if labels else [], missing.split(",") if missing else []))
    return grids


def _write_whole(name, write):
    """Lets a function write a file, which takes the place of an old one only when it is whole."""
    part = f"{name}.part"
    try:
        with open(part, "w", encoding="utf-8", newline="") as file:
            write(file)
        os.replace(part, name)
    finally:
        if os.path.exists(part):
            os.remove(part)


def _number(value, digits=3):
    """A number for a table; n/a, the empty value of BIDS, if there is none."""
    return f"{value:.{digits}f}" if value == value else "n/a"


def _save_table(name, header, rows):
    def write(file):
        writer = csv.writer(file, delimiter="\t" if name.endswith(".tsv") else ",",
                            lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)
    _write_whole(name, write)


def _owners(found):
    """The electrode of each contact. One without a name is called by its number."""
    named = [one if one.name else one._replace(name=f"electrode{i + 1}")
             for i, one in enumerate(found.grids)]
    return [named[number] for number in found._electrode]


def _table(found):
    labels = found.label or ["n/a"] * len(found.names)
    header = ["label", "x", "y", "z", "measured_x", "measured_y", "measured_z", "electrode", "kind",
              "row", "column", "outside_mm", "deviation_mm", "leave_one_out_mm", "region"]
    rows = []
    for i, owner in enumerate(_owners(found)):
        rows.append([found.names[i], *map(_number, found.rest[i]), *map(_number, found.measured[i]),
                     owner.name, owner.kind, found.row[i], found.column[i],
                     _number(found.floating[i]), _number(found.deviation[i]),
                     _number(found.leave_one_out[i]), labels[i]])
    return header, rows


def _save_bids(found, name):
    header = ["name", "x", "y", "z", "size", "group", "type", "dimension"]
    if found.label:
        header.append("region")
    rows = []
    for i, owner in enumerate(_owners(found)):
        size = sorted((owner.rows, owner.columns))
        row = [found.names[i] or f"contact{i + 1}", *map(_number, found.rest[i]), "n/a",
               owner.name, owner.kind if owner.kind != "unknown" else "n/a",
               f"[{size[0]}x{size[1]}]" if size[0] else "n/a"]
        rows.append(row + ([found.label[i]] if found.label else []))
    system = {"iEEGCoordinateSystem": "ScanRAS", "iEEGCoordinateUnits": "mm",
              "iEEGCoordinateProcessingDescription":
                  "Positions at rest: the tissue under each contact before the brain moved, by "
                  "BrainShift. Research, not for clinical use."}
    _save_table(name, header, rows)
    _write_whole(name[:-len("_electrodes.tsv")] + "_coordsystem.json",
                 lambda file: json.dump(system, file, indent=2))


def _save_markups(found, name):
    """By the writer of landmarks: points with their labels."""
    import numpy
    from paraview import servermanager, simple
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
    from vtkmodules.vtkCommonDataModel import vtkPolyData

    data, points, labels = vtkPolyData(), vtkPoints(), vtkStringArray()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(found.rest, float), deep=True))
    labels.SetName("Label")
    for label in found.names:
        labels.InsertNextValue(label)
    data.SetPoints(points)
    data.GetPointData().AddArray(labels)
    if found._axes == "RAS":  # else the writer warns that they are not known
        axes = vtkStringArray()
        axes.SetName("WorldAxes")
        axes.InsertNextValue(found._axes)
        data.GetFieldData().AddArray(axes)
    active = simple.GetActiveSource()
    source = source_of(data, OSError(
        f"{name} was not written: the server writes markups, and gets no contacts from here. Save "
        "another kind of file"))
    try:
        _write(servermanager.writers.LandmarkWriter(Input=source, FileName=name), name)
    finally:
        simple.Delete(source)
        simple.SetActiveSource(active)


def _bids_shapes(name):
    """What the columns group, type and dimension of a BIDS table say: groups by label, hints."""
    if not str(name).endswith(".tsv"):
        return {}, []
    with open(name, "rb") as file:
        data = file.read()
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # as the reader of the positions
    rows = list(csv.DictReader(io.StringIO(text, newline=""), delimiter="\t"))
    groups, hints = {}, {}
    for row in rows:
        row = {str(key).strip().lower(): (value or "").strip() for key, value in row.items()
               if not isinstance(value, list)}
        group = row.get("group", "")
        if group in ("", "n/a") or "name" not in row:
            continue
        groups[row["name"]] = group
        kind = _KINDS.get(row.get("type", "").lower())
        size = row.get("dimension", "").strip("[]").lower().replace(" ", "")
        first, _, second = size.partition("x")
        shape = [size] if first.isdigit() and second.isdigit() else []
        if kind or shape:
            hints[group] = " ".join(([kind] if kind else []) + shape)
    return groups, [f"{group}={hint}" for group, hint in hints.items()]


def shapes_of(source):
    """The properties of an Electrode Grids that a source's BIDS table tells: groups and shapes."""
    from paraview import servermanager

    from .points import read_from

    name = getattr(source, "FileName", None) or ""
    if servermanager.ActiveConnection.IsRemote() or not os.path.isfile(str(name)):
        return {}
    groups, hints = _bids_shapes(str(name))
    labels = read_from(source).labels if groups else []
    return {"ContactGroups": [groups.get(label, "") for label in labels], "Shapes": hints}


def sheet_left_out(source):
    """The mean leave-one-out error (mm) of the sheets of an Electrode Grids, at the contacts that
    are on the cortex; None if there are none."""
    import numpy
    from paraview import servermanager
    from vtkmodules.util.numpy_support import vtk_to_numpy

    source.UpdatePipeline()
    arrays = servermanager.Fetch(source).GetPointData()
    if not (arrays.HasArray("LeftOut") and arrays.HasArray("Weight")):  # it failed
        return None
    errors, weights = (vtk_to_numpy(arrays.GetArray(name)) for name in ("LeftOut", "Weight"))
    known = errors[(weights > 0) & numpy.isfinite(errors)]
    return float(known.mean()) if len(known) else None


def _mesh(cortex):
    """A ParaView source of a surface that is given as points and triangles."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points, triangles = cortex
    points, triangles = _points("cortex", points), numpy.asarray(triangles)
    if triangles.ndim != 2 or triangles.shape[1] != 3 or len(triangles) == 0:
        raise ValueError(f"the triangles of cortex have the shape {triangles.shape}; it must be "
                         "N x 3")
    if triangles.min() < 0 or triangles.max() >= len(points):
        raise ValueError(f"a triangle of cortex has the point {int(triangles.max())}; there are "
                         f"{len(points)} points")
    surface, positions, cells = vtkPolyData(), vtkPoints(), vtkCellArray()
    positions.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=True))
    filled = numpy.column_stack([numpy.full(len(triangles), 3), triangles]).astype(numpy.int64)
    cells.SetCells(len(triangles), numpy_to_vtkIdTypeArray(filled.ravel(), deep=True))
    surface.SetPoints(positions)
    surface.SetPolys(cells)
    return source_of(surface, ValueError(
        "cortex is points and triangles, which a server does not get from here; give a ParaView "
        "source of a surface"), registrationName="Cortex")


def _regions(atlas, rest, axes):
    """The label of an image at each position, a number as text; n/a outside of the image. Warns if
    the image does not lie along the axes of the positions."""
    from paraview import servermanager

    warn_of_axes(atlas, "the contacts", axes, of="the labels")
    image = servermanager.Fetch(atlas)
    array = image.GetPointData().GetScalars() or image.GetPointData().GetArray(0)
    if array is None:
        raise ValueError("labels has no point array")
    result = []
    for position in rest:
        point = image.FindPoint([float(number) for number in position])
        result.append(f"{array.GetTuple1(point):.17g}" if point >= 0 else "n/a")
    return result


def _given(contacts, shapes):
    """Contacts as they are read, their positions and names, and what is known of electrodes."""
    groups, hints = {}, []
    if isinstance(contacts, (str, os.PathLike)):
        groups, hints = _bids_shapes(os.fspath(contacts))
        contacts = read_points(contacts)
    positions, names = _points("contacts", contacts), _names(contacts)
    if len(positions) == 0:
        raise ValueError("contacts has no points")
    known = {**{hint.rpartition("=")[0]: hint for hint in hints},
             **{name: f"{name}={shape}" for name, shape in (shapes or {}).items()}}
    return contacts, positions, names, {
        "ContactGroups": [groups.get(name, "") for name in names] if groups else [],
        "Shapes": list(known.values())}


def electrodes(contacts, cortex, deformation=None, threshold=None, label=None, array=None,
               opening=None, stiffness=1.0, noise=0.5, shapes=None, labels=None):
    """Find the tissue under the contacts of electrode grids before the brain moved.

    Contacts are measured on the bent cortex, for example in a CT after the implantation. Grids,
    strips and depth shafts are recognised by labels or positions. The sheet of a grid bends easily
    and hardly stretches, which averages noise, predicts missing contacts and shows those that are
    not on the cortex. Strips and shafts are left where they were measured. No contact shows how far
    the cortex slid along itself: `rest` takes the smoothest shift.

    - `contacts`: path of a file for `read_points`, a result of it, or an N x 3 array in mm,
      measured frame. The columns group, type and dimension of a BIDS table count.
    - `cortex`: the cortex at rest: a ParaView source of a volume, labels or a surface, or, without
      a server, a pair of points (N x 3, mm) and triangles (M x 3). A brain without sulci is best.
    - `deformation`: a Free-Form Deformation. Its `Lattice` becomes a fit of the contacts. Default
      `None`: none is bent.
    - `threshold` or `label`: the scalars of the cortex in a volume. The default is a threshold of
      0.5. `array`: their name; the default, `None`, takes the active ones.
    - `opening`: the opening of the skull: a ParaView source of a mask, or centre and radius in mm,
      rest frame. The default, `None`, is a ball around the contacts of grids. The cortex is held
      beyond 15 mm of it.
    - `stiffness`: factor on the stiffness of the sheets, 0 to 100. Default 1, silicone.
    - `noise`: standard deviation of a contact along each axis in mm. Default 0.5.
    - `shapes`: what is known of electrodes, a dict such as `{"LTG": "8x8 10mm", "A": "depth"}`.
      The default, `None`, recognises all.
    - `labels`: a ParaView source of an image with the numbers of regions, rest frame. The default,
      `None`, names no regions.

    Returns an `Electrodes`.

    Raises `ValueError` with the reason if an argument is wrong, the contacts cannot be read, or
    the fit fails.
    """
    from paraview import simple

    contacts, positions, names, described = _given(contacts, shapes)
    active = simple.GetActiveSource()
    surface = _mesh(cortex) if isinstance(cortex, tuple) else cortex
    made = simple.PolyPointSource(registrationName="Contacts", Points=positions.ravel().tolist())
    source = simple.ElectrodeGrids(
        registrationName="Contacts At Rest", Input=made, Cortex=surface, Stiffness=float(stiffness),
        ContactDeviation=float(noise), ShowMissing=1, ContactNames=names, **described,
        **_opening(opening), **_cortex(threshold, label, array, None), **_point_axes(contacts))
    try:
        source.UpdatePipeline()
        problem = reason_of(source)
        if problem:
            for proxy in (source, made):
                simple.Delete(proxy)
            raise ValueError(problem)
        is_read = hasattr(contacts, "labels")  # so they are RAS
        found = Electrodes(source, "RAS" if is_read else world_axes(surface) or "")
        if labels is not None:
            found.label = _regions(labels, found.rest, found._axes)
        if deformation is not None:
            found.fit = _fitted(found, deformation, surface, opening, (threshold, label, array),
                                is_read)
        return found
    finally:
        simple.SetActiveSource(active)


def _fitted(found, deformation, surface, opening, how, is_read):
    """The fit of contacts of grids that are on the cortex. If they were read, they are RAS."""
    import numpy

    used = numpy.isfinite(found.floating) & ~found.off
    if not used.any():
        raise ValueError("no contact is on a grid, so there is nothing to fit")
    threshold, label, array = how
    is_image = surface.GetDataInformation().GetDataSetTypeAsString() == "vtkImageData"
    is_own = is_image and surface.SMProxy is deformation.Input.SMProxy
    measured = found.measured[used]
    if is_read:
        measured = Points(measured, [""] * len(measured), *[None] * 3)
    return fit(deformation, rest=found.rest[used], measured=measured, traces=measured,
               threshold=threshold, label=label, array=array,
               segmentation=surface if is_image and not is_own else None, opening=opening)
