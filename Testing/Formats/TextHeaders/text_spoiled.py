# SPDX-License-Identifier: BSD-3-Clause
"""MetaImage and NRRD files of volumes and fields for the fuzz, and what spoils them."""

import gzip
import zlib

import numpy
import text_oracle
from mutation import Spoiled, cut, flip, numbers, rotation, word


def _headed(lines, data):
    """A file of a header and data, and the length of the header."""
    text = ("\n".join(lines) + "\n").encode()
    return text + data, len(text)


def _meta_storage(random):
    """Whether the numbers are big-endian, and whether they are packed."""
    return random.random() < 0.5, random.random() < 0.3


def _meta_data(random, count, kind, msb, packed):
    data = numbers(random, count, (">" if msb else "<") + kind)
    return zlib.compress(data) if packed else data


def _meta_lines(random, msb, packed):
    """Lines on the storage and the axes, and the words of the spacing."""
    matrix, offset, spacing = (" ".join(map(repr, map(float, values))) for values in (
        rotation(random).ravel(), [random.uniform(-90, 90) for _ in range(3)],
        [random.choice([0.5, 1.0, 2.5]) for _ in range(3)]))
    return ["ObjectType = Image", "NDims = 3", "BinaryData = True",
            f"BinaryDataByteOrderMSB = {msb}", f"CompressedData = {packed}",
            f"TransformMatrix = {matrix}", f"Offset = {offset}"], spacing


def meta_image(random):
    """A good field in a MetaImage."""
    sides = [random.randrange(1, 5) for _ in range(3)]
    msb, packed = _meta_storage(random)
    kind, name = random.choice([("f4", "MET_FLOAT"), ("f8", "MET_DOUBLE")])
    data = _meta_data(random, 3 * int(numpy.prod(sides)), kind, msb, packed)
    lines, spacing = _meta_lines(random, msb, packed)
    return _headed([
        *lines, f"{random.choice(['ElementSpacing', 'ElementSize'])} = {spacing}",
        f"DimSize = {sides[0]} {sides[1]} {sides[2]}", "ElementNumberOfChannels = 3",
        f"ElementType = {name}", "ElementDataFile = LOCAL"], data)


def _nrrd_storage(random):
    """The order of bytes, and whether the numbers are packed."""
    return random.choice(["little", "big"]), random.random() < 0.3


def _nrrd_data(random, count, kind, order, packed):
    data = numbers(random, count, ("<" if order == "little" else ">") + kind)
    return gzip.compress(data) if packed else data


def _nrrd_places(random):
    """The words of the directions and of the origin."""
    steps = rotation(random) * random.choice([0.5, 1.0, 2.5])
    places = [",".join(map(repr, map(float, step))) for step in steps]
    origin = ",".join(repr(random.uniform(-90, 90)) for _ in range(3))
    return " ".join(f"({place})" for place in places), origin


def _nrrd_lines(name, space, sides, places, storage, vectors):
    """A header; with vectors, an axis of three components comes first."""
    (directions, origin), (order, packed) = places, storage
    size, none, vector = ("3 ", "none ", "vector ") if vectors else ("", "", "")
    return ["NRRD0005", f"type: {name}", f"dimension: {4 if vectors else 3}", f"space: {space}",
            f"sizes: {size}{sides[0]} {sides[1]} {sides[2]}",
            f"space directions: {none}{directions}",
            f"kinds: {vector}domain domain domain", f"endian: {order}",
            f"encoding: {'gzip' if packed else 'raw'}", f"space origin: ({origin})", ""]


def nrrd(random):
    """A good field in an NRRD."""
    sides = [random.randrange(1, 5) for _ in range(3)]
    storage = _nrrd_storage(random)
    kind, name = random.choice([("f4", "float"), ("f8", "double")])
    data = _nrrd_data(random, 3 * int(numpy.prod(sides)), kind, *storage)
    places = _nrrd_places(random)
    return _headed(_nrrd_lines(name, "left-posterior-superior", sides, places, storage, True), data)


def meta_volume(random):
    """A good volume in a MetaImage."""
    sides = [random.randrange(1, 5) for _ in range(3)]
    channels = random.choice([1, 1, 3])
    msb, packed = _meta_storage(random)
    kind, name = random.choice([("u1", "UCHAR"), ("i2", "SHORT"), ("u2", "USHORT"), ("i4", "INT"),
                                ("f4", "FLOAT"), ("f8", "DOUBLE")])
    data = _meta_data(random, channels * int(numpy.prod(sides)), kind, msb, packed)
    lines, spacing = _meta_lines(random, msb, packed)
    return _headed([
        *lines, f"AnatomicalOrientation = {random.choice(['RAI', 'LPS', '???'])}",
        f"ElementSpacing = {spacing}", f"DimSize = {sides[0]} {sides[1]} {sides[2]}",
        f"ElementNumberOfChannels = {channels}", f"ElementType = MET_{name}",
        "ElementDataFile = LOCAL"], data)


def nrrd_volume(random):
    """A good volume in an NRRD."""
    sides = [random.randrange(1, 5) for _ in range(3)]
    vectors = random.random() < 0.3
    storage = _nrrd_storage(random)
    kind, name = random.choice([("u1", "uchar"), ("i2", "short"), ("u2", "ushort"), ("i4", "int"),
                                ("f4", "float"), ("f8", "double")])
    data = _nrrd_data(random, (3 if vectors else 1) * int(numpy.prod(sides)), kind, *storage)
    places = _nrrd_places(random)
    space = random.choice(["left-posterior-superior", "RAS", "left-anterior-superior"])
    return _headed(_nrrd_lines(name, space, sides, places, storage, vectors), data)


def _answer(read):
    def answer(data):
        volume = read(data)
        return volume.world, volume.values
    return answer


CHANGES = [flip, cut, word, word, word]
FILES = [Spoiled("field.mha", meta_image, CHANGES, "DisplacementFieldReader",
                 _answer(text_oracle.meta_image)),
         Spoiled("field.nrrd", nrrd, CHANGES, "DisplacementFieldReader",
                 _answer(text_oracle.nrrd)),
         Spoiled("volume.mha", meta_volume, CHANGES, "MetaImageVolumeReader",
                 _answer(text_oracle.meta_volume)),
         Spoiled("volume.nrrd", nrrd_volume, CHANGES, "NRRDVolumeReader",
                 _answer(text_oracle.nrrd_volume))]
