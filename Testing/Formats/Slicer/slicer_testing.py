# SPDX-License-Identifier: BSD-3-Clause
"""Scenes in 3D Slicer's syntax and the files that they name, written with numpy, and where points
go in Slicer by formulas and by ITK (transformix)."""

import json
import os
import shutil
import zipfile
from xml.sax.saxutils import quoteattr

import numpy
from brainshift_testing import scratch
from outside_testing import FLIP, numbers

#: Rotations and shifts without symmetry (RAS, mm).
TURN = numpy.array(((0.866025, -0.5, 0, 12), (0.5, 0.866025, 0, -7), (0, 0, 1, 30), (0, 0, 0, 1)))
HALF_TURN = numpy.diag((-1.0, -1.0, 1.0, 1.0)) + numpy.array(((0, 0, 0, 5.0),) * 3 + ((0,) * 4,))
STRETCH = numpy.array(((1.1, 0.05, 0, 3), (0, 0.95, 0.02, -2), (0.01, 0, 1.03, 4), (0, 0, 0, 1)))


def _word(identifier):
    return identifier.replace(" ", "_")  # identifiers have no spaces


class Written:
    """A scene that is being written into a folder of its own."""

    def __init__(self, name, version="Slicer 5.6.2 32448"):
        self.folder = scratch(name)
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.rmtree(self.folder + "-opened", ignore_errors=True)
        os.makedirs(self.folder)
        self.version, self.lines = version, []

    def path(self, name):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return path

    def node(self, kind, identifier, **attributes):
        words = "".join(f" {key}={quoteattr(str(value))} " for key, value in attributes.items())
        identifier = _word(identifier)
        self.lines.append(f' <{kind}\n  id="{identifier}" {words}></{kind}>')
        return identifier

    def stored(self, kind, identifier, file, *, above=None, storage=None, old=False, **attributes):
        """A node with a file, perhaps below a transform; `old`: in the words of Slicer 4.2."""
        escaped = file.replace("%", "%25").replace(" ", "%20").replace("'", "%27")
        above = above and _word(above)
        held = self.node(kind + "Storage", identifier + "Storage", fileName=escaped,
                         **(storage or {}))
        if old:
            refers = {"storageNodeRef": held, **({"transformNodeRef": above} if above else {})}
        else:
            refers = {"references": f"storage:{held};" + (f"transform:{above};" if above else "")}
        return self.node(kind, identifier, **{"name": identifier, **refers, **attributes})

    def linear(self, identifier, matrix, above=None, **attributes):
        """A linear transform: its matrix leads to the parent, RAS."""
        refers = {"references": f"transform:{above};"} if above else {}
        return self.node("LinearTransform", identifier, name=identifier,
                         matrixTransformToParent=numbers(matrix), **refers, **attributes)

    def landmarks(self, identifier, positions, above=None, **options):
        """Markups at RAS positions; the file is LPS, as Slicer 5 writes it."""
        file = options.pop("file", identifier + ".mrk.json")
        points = [{"id": str(i), "label": f"L{i}", "position": list(position * FLIP),
                   "positionStatus": "defined"} for i, position in enumerate(positions, 1)]
        with open(self.path(file), "w", encoding="utf-8") as written:
            json.dump({"@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/"
                                  "Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#",
                       "markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
                                    "coordinateUnits": "mm", "controlPoints": points}]}, written)
        return self.stored("MarkupsFiducial", identifier, file, above=above, **options)

    def written(self, name="scene.mrml"):
        text = (f'<?xml version="1.0" encoding="UTF-8"?>\n<MRML  version="{self.version}" '
                'userTags="">\n' + "\n".join(self.lines) + "\n</MRML>\n")
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def bundle(self, name, top="Bündel eins"):
        """The same as a .mrb, packed as Slicer does: one folder, in which is all."""
        self.written(f"{top}.mrml")
        path = scratch(name)
        shutil.rmtree(os.path.splitext(path)[0] + "-opened", ignore_errors=True)
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
            for root, _, names in os.walk(self.folder):
                for each in names:
                    inside = os.path.relpath(os.path.join(root, each), self.folder)
                    file.write(os.path.join(root, each), f"{top}/{inside}")
        return path


def of_rows(matrix, points):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def write_nrrd(path, values, origin, steps, more=()):
    """Voxels [z, y, x] or vectors [z, y, x, 3] in LPS: `origin` and `steps` are LPS, mm."""
    vectors = values.ndim == 4
    kind = {"f": "float", "u": "uint8", "i": "short"}[values.dtype.kind]
    sizes = (["3"] if vectors else []) + [str(side) for side in reversed(values.shape[:3])]
    steps = ["(" + ",".join(repr(float(each)) for each in step) + ")" for step in steps]
    lines = ["NRRD0005", f"type: {kind}", f"dimension: {len(sizes)}",
             "space: left-posterior-superior", "sizes: " + " ".join(sizes),
             "space directions: " + " ".join((["none"] if vectors else []) + steps),
             "kinds: " + " ".join((["vector"] if vectors else []) + ["domain"] * 3),
             "endian: little", "encoding: raw",
             "space origin: (" + ",".join(repr(float(each)) for each in origin) + ")", *more]
    with open(path, "wb") as file:
        file.write("\n".join([*lines, "", ""]).encode())
        file.write(values.astype(values.dtype.newbyteorder("<")).tobytes())
    return path


GRID_ORIGIN, GRID_STEP, GRID_SIDES = numpy.array((-90.0, -80.0, -70.0)), 10.0, (20, 18, 16)


def grid_vectors(seed=4, size=3.0):
    """Vectors (LPS, mm) at the points of a grid, smooth enough to be inverted."""
    return numpy.random.default_rng(seed).uniform(
        -size, size, (*reversed(GRID_SIDES), 3)).astype(numpy.float32)


def grid_moved(points, vectors):
    """RAS points moved by a grid: trilinear in LPS, by hand."""
    found = []
    for point in points * FLIP:
        at = (point - GRID_ORIGIN) / GRID_STEP
        low = numpy.floor(at).astype(int)
        part, moved = at - low, numpy.zeros(3)
        for corner in numpy.ndindex(2, 2, 2):
            weight = numpy.prod(numpy.where(corner, part, 1 - part))
            x, y, z = low + corner
            moved += weight * vectors[z, y, x]
        found.append((point + moved) * FLIP)
    return numpy.array(found)


def write_grid(path, vectors, kind):
    """A grid transform as Slicer writes it; `kind`: resampling (from the parent) or modeling."""
    return write_nrrd(path, vectors, GRID_ORIGIN, numpy.eye(3) * GRID_STEP,
                      (f"displacement field type:={kind}",) if kind else ())
