# SPDX-License-Identifier: BSD-3-Clause
"""Walks the list of fields in the README.md of a format: what it says of a field must be so.

A row names one field or several, then what BrainShift does: `honoured` (another value changes what
is read, or what is said of it), `refused` (an error names the field) or `irrelevant` (nothing
changes)."""

import pathlib
import re

import numpy
from brainshift_testing import messages, output, scratch
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

CHECKOUT = pathlib.Path(__file__).resolve().parents[3]
VERDICTS = ("honoured", "refused", "irrelevant")


def listed(folder, heading):
    """(field, verdict) of each field in the table below a heading of Formats/FOLDER/README.md."""
    text = (CHECKOUT / "Formats" / folder / "README.md").read_text(encoding="utf-8")
    assert f"\n## {heading}\n" in text, (folder, heading)
    section = re.split(r"^## ", text.split(f"\n## {heading}\n")[1], flags=re.MULTILINE)[0]
    for row in re.findall(r"^\| (`.*) \|$", section, re.MULTILINE):
        names, verdict = row.split(" | ")[:2]
        assert verdict.split()[0] in VERDICTS, row
        for name in re.findall(r"`([^`]+)`", names):
            yield name, verdict.split()[0]


def said_of(text):
    """The sentences of messages, without the place in the source and the name of the file."""
    text = re.sub(r"(ERROR|Warning): In [^\n]*\n", "", text)
    return re.sub(r"\S*/walk[\w.]*", "FILE", re.sub(r"\(0x[0-9a-f]+\)", "", text)).strip()


def arrays_of(data):
    """All numbers of points and cells, and all field arrays, by their names."""
    found = {}
    for attributes in (data.GetPointData(), data.GetCellData(), data.GetFieldData()):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetAbstractArray(i)
            name = array.GetName()
            found[name] = (vtk_to_numpy(array).tolist() if array.IsNumeric() else
                           [array.GetValue(j) for j in range(array.GetNumberOfValues())])
    return found


def outcome(proxy_name, name, content, **properties):
    """(errors, what is read and said) of a file of these bytes."""
    path = scratch(name)
    with open(path, "wb") as file:
        file.write(content)
    return outcome_of(proxy_name, path, **properties)


def outcome_of(proxy_name, path, **properties):
    """The same of a file or folder that is there."""
    with messages() as said:
        source = getattr(simple, proxy_name)(FileName=path, **properties)
        source.UpdatePipeline()
    data = output(source)
    text = said_of(said.text)
    series = source.GetProperty("SeriesList") if "SeriesList" in source.ListProperties() else ()
    facts = [text, arrays_of(data), str(getattr(source, "TimestepValues", None)), list(series)]
    if hasattr(data, "GetSpacing"):
        direction = data.GetDirectionMatrix()
        facts += [data.GetDimensions(), numpy.round(data.GetSpacing(), 9).tolist(),
                  numpy.round(data.GetOrigin(), 6).tolist(), data.GetScalarTypeAsString(),
                  [round(direction.GetElement(i // 3, i % 3), 9) for i in range(9)]]
        scalars = data.GetPointData().GetScalars()
        facts += [scalars.GetComponentName(i) for i in range(
            scalars.GetNumberOfComponents() if scalars and scalars.HasAComponentName() else 0)]
    elif data.GetNumberOfPoints():
        facts += [vtk_to_numpy(data.GetPoints().GetData()).round(6).tolist(),
                  vtk_to_numpy(data.GetPolys().GetConnectivityArray()).tolist()]
    count = data.GetNumberOfPoints()
    simple.Delete(source)
    return ("" if count else text or "nothing was read"), facts


def walk(folder, heading, changes, read):
    """Compares each row with what happens. `changes`: for each field (good, changed, ...), contents
    of files; `read(content)`: an outcome. Each field must have changes, and each change a row."""
    rows = dict(listed(folder, heading))
    assert set(rows) == set(changes), (sorted(set(rows) ^ set(changes)))
    wrong = []
    for name, verdict in rows.items():
        good, *changed = changes[name]
        problem, right = read(good)
        assert not problem, (name, problem)
        for other in changed:
            assert other != good, name
            error, found = read(other)
            is_right = {"honoured": not error and found != right,
                        "refused": name.lower() in error.lower(),
                        "irrelevant": not error and found == right}[verdict]
            if not is_right:
                wrong.append(f"{name} is not {verdict}: {error or found[0] or 'no word'}")
    assert not wrong, "\n".join(wrong)
    print(f"{folder}, {heading}: {len(rows)} fields")
