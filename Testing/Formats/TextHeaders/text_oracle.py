# SPDX-License-Identifier: BSD-3-Clause
"""A second reader of fields and volumes in MetaImage and NRRD files, written from their texts with
nothing but numpy and zlib. Its answers are in RAS mm."""

import re
import zlib

import numpy
from oracle import Open, Volume, Wrong

META_KINDS = {"MET_UCHAR": "u1", "MET_SHORT": "i2", "MET_USHORT": "u2", "MET_INT": "i4",
              "MET_FLOAT": "f4", "MET_DOUBLE": "f8"}
NRRD_KINDS = {"uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "float": "f4",
              "double": "f8"}
SPACES = {"left-posterior-superior": (-1, -1, 1), "LPS": (-1, -1, 1),
          "left-anterior-superior": (-1, 1, 1), "LAS": (-1, 1, 1),
          "right-anterior-superior": (1, 1, 1), "RAS": (1, 1, 1), "scanner-xyz": (1, 1, 1)}
VECTOR = r"\(([^(),]*),([^(),]*),([^(),]*)\)"
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$")


def numbers(text, count):
    words = text.split()
    if len(words) != count or not all(NUMBER.match(word) for word in words):
        raise Wrong(f"not {count} numbers: {text!r}")
    values = numpy.array(words, float)
    if not numpy.isfinite(values).all():
        raise Wrong("a number beyond all bounds")
    return values


def sides_of(values):
    if (values != numpy.floor(values)).any() or (values < 1).any():
        raise Wrong("sides")
    return [int(side) for side in values]


def lines_of(raw, mark, last):
    """The lines of a header by their keys, and where the numbers begin."""
    found, place = {}, 0
    while place < len(raw):
        end = raw.find(b"\n", place)
        end = len(raw) if end < 0 else end
        try:
            line = raw[place:end].decode("ascii").strip(" \t\r")
        except UnicodeDecodeError as error:
            raise Open("letters beyond ASCII") from error
        place = end + 1
        if mark == ":" and not line:
            return found, place
        if mark not in line or line.startswith("#"):
            continue
        key, _, value = line.partition(mark)
        key, value = key.strip(), value.lstrip("=" if mark == ":" else "").strip()
        if key in found:
            raise Open(f"{key} twice")
        found[key] = value
        if key == last:
            return found, place
    return found, len(raw)


class Field:
    """`world(index)` in RAS mm, `values[x, y, z, component]` in RAS mm."""

    def __init__(self, origin, steps, values):
        if abs(numpy.linalg.det(steps)) == 0.0:
            raise Wrong("flat")
        self.flip = numpy.array([-1.0, -1.0, 1.0])
        self.origin, self.steps = origin, steps
        self.values = values * self.flip

    def world(self, index):
        return self.flip * (self.origin + self.steps @ numpy.asarray(index, float))


def numbers_of(raw, shape, kind, packed):
    """All numbers of a file; the first index runs fastest."""
    dtype = numpy.dtype(kind)
    count = int(numpy.prod(shape, dtype=float))
    if packed:
        stream = zlib.decompressobj(47)
        try:
            raw = stream.decompress(raw, count * dtype.itemsize)
        except zlib.error as error:
            raise Wrong(f"packed: {error}") from error
    if len(raw) < count * dtype.itemsize:
        raise Wrong("truncated")
    return numpy.frombuffer(raw, dtype, count).astype(float).reshape(shape, order="F")


def _values(raw, sides, kind, packed):
    return numbers_of(raw, [3, *sides], kind, packed).transpose(1, 2, 3, 0)


def first_of(lines, *keys, default=None):
    """The value of the one of some keys that a header has."""
    present = [key for key in keys if key in lines]
    capitals = {key.lower() for key in keys}
    if any(line.lower() in capitals and line not in keys for line in lines):
        raise Open("a key in other capitals")
    if len(present) > 1 and default is None:
        raise Open(f"{present} together")
    if present:
        return lines[present[0]]
    if default is None:
        raise Wrong(f"no {keys[0]}")
    return default


def meta_image(raw):
    lines, start = lines_of(raw, "=", "ElementDataFile")
    truth = {"True": True, "False": False}
    flags = {key: truth.get(lines.get(key, default)) for key, default in (
        ("BinaryData", "True"), ("BinaryDataByteOrderMSB", "False"), ("CompressedData", "False"))}
    if None in flags.values() or "ElementByteOrderMSB" in lines:
        raise Open("a word that is neither True nor False")
    if not flags["BinaryData"] or lines.get("ElementNumberOfChannels") != "3":
        raise Wrong("not binary vectors")
    if lines.get("ElementDataFile") != "LOCAL" or lines.get("HeaderSize", "0") != "0":
        raise Open("numbers elsewhere")
    kind = {"MET_FLOAT": "f4", "MET_DOUBLE": "f8"}.get(lines.get("ElementType"))
    if kind is None:
        raise Open("type")
    if lines.get("NDims", "3") != "3":
        raise Open("dimensions")
    sides = sides_of(numbers(first_of(lines, "DimSize"), 3))
    origin = numbers(first_of(lines, "Offset", "Position", "Origin"), 3)
    spacing = numbers(first_of(lines, "ElementSpacing", "ElementSize", default="1 1 1"), 3)
    rows = numbers(first_of(lines, "TransformMatrix", "Rotation", "Orientation",
                          default="1 0 0 0 1 0 0 0 1"), 9).reshape(3, 3)
    order = ">" if flags["BinaryDataByteOrderMSB"] else "<"
    return Field(origin, (rows * spacing[:, None]).T,
                 _values(raw[start:], sides, order + kind, flags["CompressedData"]))


def nrrd(raw):
    if raw[:4] != b"NRRD":
        raise Wrong("magic")
    lines, start = lines_of(raw, ":", None)
    for skip in ("byte skip", "line skip", "byteskip", "lineskip"):
        if lines.get(skip, "0") != "0":
            raise Open(skip)
    if any(key in lines for key in ("data file", "datafile", "measurement frame")):
        raise Open("numbers elsewhere")
    if lines.get("dimension") != "4":
        raise Open("dimensions")
    sides = sides_of(numbers(first_of(lines, "sizes"), 4))
    kind = {"float": "f4", "double": "f8"}.get(lines.get("type"))
    order = {"little": "<", "big": ">"}.get(lines.get("endian"))
    packed = {"raw": False, "gzip": True, "gz": True}.get(lines.get("encoding"))
    if None in (kind, order, packed) or sides[0] != 3:
        raise Wrong("type, endian, encoding or components")
    if lines.get("space") not in ("left-posterior-superior", "LPS"):
        raise Wrong("space")
    vector = r"\(([^(),]*),([^(),]*),([^(),]*)\)"
    three = rf"none\s+{vector}\s+{vector}\s+{vector}"
    found = re.fullmatch(three, lines.get("space directions", ""))
    place = re.fullmatch(vector, lines.get("space origin", ""))
    if not found or not place:
        raise Wrong("place")
    steps = numbers(" ".join(found.groups()), 9).reshape(3, 3).T
    return Field(numbers(" ".join(place.groups()), 3), steps,
                 _values(raw[start:], sides[1:], order + kind, packed))


def _whole(text):
    if not re.fullmatch(r"\d+", text):
        raise Open(f"not a plain number: {text!r}")
    return int(text)


def meta_volume(raw):
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


def nrrd_volume(raw):
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
