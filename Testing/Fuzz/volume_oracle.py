# SPDX-License-Identifier: BSD-3-Clause
"""A second reader of volumes in MetaImage, NRRD and FreeSurfer files, written from their texts with
nothing but numpy and zlib. Its answers are in RAS mm."""

import re
import struct

import numpy
from nifti_oracle import Open, Wrong, unpacked
from text_oracle import first_of, lines_of, numbers, numbers_of, sides_of

META_KINDS = {"MET_UCHAR": "u1", "MET_SHORT": "i2", "MET_USHORT": "u2", "MET_INT": "i4",
              "MET_FLOAT": "f4", "MET_DOUBLE": "f8"}
NRRD_KINDS = {"uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "float": "f4",
              "double": "f8"}
MGH_KINDS = {0: "u1", 1: "i4", 3: "f4", 4: "i2", 10: "u2"}
SPACES = {"left-posterior-superior": (-1, -1, 1), "LPS": (-1, -1, 1),
          "left-anterior-superior": (-1, 1, 1), "LAS": (-1, 1, 1),
          "right-anterior-superior": (1, 1, 1), "RAS": (1, 1, 1), "scanner-xyz": (1, 1, 1)}
VECTOR = r"\(([^(),]*),([^(),]*),([^(),]*)\)"


class Volume:
    """`world(index)` in RAS mm, `values[x, y, z, component]`."""

    def __init__(self, origin, steps, signs, values):
        if not numpy.linalg.det(steps):
            raise Wrong("flat")
        self.signs = numpy.array(signs, float)
        self.origin, self.steps, self.values = origin, steps, values

    def world(self, index):
        return self.signs * (self.origin + self.steps @ numpy.asarray(index, float))


def _whole(text):
    if not re.fullmatch(r"\d+", text):
        raise Open(f"not a plain number: {text!r}")
    return int(text)


def meta_image(raw):
    lines, start = lines_of(raw, "=", "ElementDataFile")
    truth = {"True": True, "False": False}
    flags = {key: truth.get(lines.get(key, "False"))
             for key in ("BinaryData", "BinaryDataByteOrderMSB", "CompressedData")}
    if None in flags.values() or "ElementByteOrderMSB" in lines or not flags["BinaryData"]:
        raise Open("a word that is neither True nor False, or numbers as text")
    if lines.get("ElementDataFile") != "LOCAL" or lines.get("HeaderSize", "0") != "0":
        raise Open("numbers elsewhere")
    if lines.get("NDims", "3") != "3" or any("Intensity" in key for key in lines):
        raise Open("dimensions or a scale")
    kind = META_KINDS.get(lines.get("ElementType"))
    if kind is None:
        raise Open("type")
    channels = _whole(lines.get("ElementNumberOfChannels", "1"))
    sides = sides_of(numbers(first_of(lines, "DimSize"), 3))
    origin = numbers(first_of(lines, "Offset", "Position", "Origin", default="0 0 0"), 3)
    spacing = numbers(first_of(lines, "ElementSpacing", "ElementSize", default="1 1 1"), 3)
    rows = numbers(first_of(lines, "TransformMatrix", "Rotation", "Orientation",
                            default="1 0 0 0 1 0 0 0 1"), 9).reshape(3, 3)
    order = ">" if flags["BinaryDataByteOrderMSB"] else "<"
    values = numbers_of(raw[start:], [channels, *sides], order + kind, flags["CompressedData"])
    return Volume(origin, (rows * spacing[:, None]).T, (-1, -1, 1), values.transpose(1, 2, 3, 0))


def nrrd(raw):
    if raw[:4] != b"NRRD":
        raise Wrong("magic")
    lines, start = lines_of(raw, ":", None)
    known = {"type", "dimension", "space", "sizes", "space directions", "kinds", "endian",
             "encoding", "space origin"}
    if not set(lines) <= known or not {"space", "space directions", "space origin"} <= set(lines):
        raise Open("other lines")
    sides = sides_of(numbers(lines.get("sizes", ""), _whole(lines.get("dimension", ""))))
    kinds = lines.get("kinds", "").split()
    if len(sides) == 4 and (len(kinds) != 4 or kinds[0] != "vector"):
        raise Open("kinds")
    if len(sides) not in (3, 4):
        raise Wrong("dimensions")
    kind = NRRD_KINDS.get(lines.get("type"))
    order = {"little": "<", "big": ">"}.get(lines.get("endian"))
    packed = {"raw": False, "gzip": True, "gz": True}.get(lines.get("encoding"))
    if None in (kind, order, packed):
        raise Open("type, endian or encoding")
    if lines["space"] not in SPACES:
        raise Open("space")
    three = rf"{VECTOR}\s*{VECTOR}\s*{VECTOR}"
    found = re.fullmatch((r"none\s*" if len(sides) == 4 else "") + three,
                         lines["space directions"])
    place = re.match(VECTOR, lines["space origin"])
    if not found or not place:
        raise Open("place")
    steps = numbers(" ".join(found.groups()), 9).reshape(3, 3).T
    components = sides if len(sides) == 4 else [1, *sides]
    values = numbers_of(raw[start:], components, order + kind, packed)
    return Volume(numbers(" ".join(place.groups()), 3), steps, SPACES[lines["space"]],
                  values.transpose(1, 2, 3, 0))


def mgh(raw):
    raw = unpacked(raw)
    if len(raw) < 284:
        raise Wrong("short")
    version, *sides, frames, kind, _ = struct.unpack_from(">7i", raw)
    if version != 1 or min(sides) < 1 or frames < 1 or kind not in MGH_KINDS:
        raise Wrong("version, sides or type")
    good, = struct.unpack_from(">h", raw, 28)
    place = numpy.array(struct.unpack_from(">15f", raw, 30), float)
    steps = place[3:12].reshape(3, 3).T * place[:3]
    centre = place[12:]
    if good <= 0:
        steps = numpy.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
        centre = numpy.zeros(3)
    dtype = numpy.dtype(">" + MGH_KINDS[kind])
    count = int(numpy.prod([float(side) for side in sides]))
    if len(raw) < 284 + count * frames * dtype.itemsize:
        raise Wrong("truncated")
    values = numpy.frombuffer(raw, dtype, count, 284).astype(float)
    if not numpy.isfinite(steps).all() or not numpy.isfinite(centre).all():
        raise Wrong("a place that is not finite")
    return Volume(centre - steps @ (numpy.array(sides) / 2.0), steps, (1, 1, 1),
                  values.reshape([*sides, 1], order="F"))
