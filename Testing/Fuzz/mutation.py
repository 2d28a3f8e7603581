# SPDX-License-Identifier: BSD-3-Clause
"""Makes good files of fields and volumes, and spoils them: bytes, numbers, lines and lengths."""

import gzip
import struct
import zlib

import numpy

#: Numbers that readers stumble over.
REALS = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 1e-320, 1e-38, 1e38, -1e38, 1e308, float("nan"),
         float("inf"), float("-inf")]
SINGLES = [value for value in REALS if not 1e39 < abs(value) < float("inf")]
INTEGERS = [0, 1, -1, 2, 3, 5, 7, 8, 64, 255, 256, 1006, 1007, 32767, -32768]
WORDS = ["0", "-1", "1", "2", "3", "65535", "65536", "2147483648", "99999999999999999999", "2.5",
         "1e-320", "1e308", "1e400", "nan", "inf", "-inf", "", "x", "True", "False", "LOCAL", "(",
         ")", "none", "big", "little", "raw", "gzip", "RAS", "MET_FLOAT", "MET_DOUBLE", "double"]

#: Offset, kind and number of the fields of a NIfTI-1 header that say where and what.
NIFTI_FIELDS = [(0, "i", 1), (40, "h", 8), (56, "f", 3), (68, "h", 1), (70, "h", 1), (72, "h", 1),
                (76, "f", 8), (108, "f", 1), (112, "f", 2), (123, "b", 1), (252, "h", 2),
                (256, "f", 6), (280, "f", 12)]


def rotation(random):
    """A matrix of unit columns at right angles, mirrored every other time."""
    q = numpy.array([random.gauss(0, 1) for _ in range(4)])
    w, x, y, z = q / numpy.linalg.norm(q)
    turned = numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    if random.random() < 0.5:
        turned[:, random.randrange(3)] *= -1
    if random.random() < 0.3:
        turned = numpy.eye(3)[random.sample(range(3), 3)] * random.choice([1.0, -1.0])
    return turned


def _numbers(random, count, kind):
    values = [random.randrange(0, 100) for _ in range(count)]
    return numpy.array(values, kind).tobytes()


def nifti(random):
    """A good NIfTI-1 file: a volume, or a field of vectors."""
    order = random.choice("<>")
    sides = [random.randrange(2, 6) for _ in range(3)]
    vectors = random.random() < 0.5
    kind, code = ("f4", 16) if vectors else random.choice(
        [("u1", 2), ("i2", 4), ("i4", 8), ("f4", 16), ("f8", 64), ("i1", 256), ("u2", 512)])
    times = 1 if vectors else random.choice([1, 1, 2])
    header = bytearray(352)

    def put(offset, kinds, *values):
        struct.pack_into(order + kinds, header, offset, *values)
    put(0, "i", 348)
    shape = [*sides, times, 3] if vectors else [*sides, times]
    put(40, "8h", len(shape), *(shape + [1] * (7 - len(shape))))
    put(68, "h", random.choice([1006, 1007]) if vectors else 0)
    put(70, "2h", code, 8 * int(kind[1]))
    steps = [random.choice([0.5, 1.0, 2.5]) for _ in range(3)]
    put(76, "8f", random.choice([1.0, -1.0]), *steps, 1.0, 0.0, 0.0, 0.0)
    put(108, "3f", 352.0, random.choice([0.0, 1.0, 2.0]), random.choice([0.0, 5.0]))
    header[123] = 2 + 8
    turned = rotation(random)
    offset = [random.uniform(-90, 90) for _ in range(3)]
    put(252, "2h", random.choice([0, 1]), random.choice([0, 1, 2]))
    bcd = numpy.array([random.gauss(0, 1) for _ in range(4)])
    put(256, "6f", *(bcd / numpy.linalg.norm(bcd))[:3], *offset)
    rows = numpy.column_stack([turned * steps, offset])
    put(280, "12f", *rows.ravel())
    header[344:348] = b"n+1\0"
    count = int(numpy.prod(shape))
    data = _numbers(random, count, order + kind)
    return bytes(header) + data, 348


def _headed(lines, data):
    """A file of a header and data, and the length of the header."""
    text = ("\n".join(lines) + "\n").encode()
    return text + data, len(text)


def _meta_storage(random):
    """Whether the numbers are big-endian, and whether they are packed."""
    return random.random() < 0.5, random.random() < 0.3


def _meta_data(random, count, kind, msb, packed):
    data = _numbers(random, count, (">" if msb else "<") + kind)
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
    data = _numbers(random, count, ("<" if order == "little" else ">") + kind)
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


def mgh(random):
    """A good volume of FreeSurfer."""
    sides = [random.randrange(1, 6) for _ in range(3)]
    frames = random.choice([1, 1, 2])
    kind, code = random.choice([("u1", 0), ("i4", 1), ("f4", 3), ("i2", 4), ("u2", 10)])
    header = struct.pack(">7ih", 1, *sides, frames, code, 0, random.choice([1, 1, 1, 0]))
    steps = [random.choice([0.5, 1.0, 2.5]) for _ in range(3)]
    header += struct.pack(">15f", *steps, *rotation(random).T.ravel(),
                          *(random.uniform(-90, 90) for _ in range(3)))
    data = _numbers(random, frames * int(numpy.prod(sides)), ">" + kind)
    return header.ljust(284, b"\0") + data + struct.pack(">4f", 2000.0, 0.0, 0.0, 0.0), 90


def _flip(random, data, end):
    place = random.randrange(max(1, min(end, len(data))))
    return data[:place] + bytes([random.randrange(256)]) + data[place + 1:]


def _cut(random, data, end):
    kept = random.choice([0, 1, 40, end, end + 1, len(data) // 2, len(data) - 1])
    return data[:kept] if random.random() < 0.8 else data + bytes(random.randrange(1, 99))


def _field(random, data, end):
    offset, kind, count = random.choice(NIFTI_FIELDS)
    place = offset + random.randrange(count) * struct.calcsize(kind)
    order = random.choice("<>")
    value = random.choice(SINGLES) if kind == "f" else random.choice(INTEGERS)
    if kind == "b":
        value = random.randrange(-128, 128)
    if place + 8 > len(data):
        return data
    spoiled = bytearray(data)
    struct.pack_into(order + kind, spoiled, place, value)
    return bytes(spoiled)


def _word(random, data, end):
    """Another word in a line of the header, or a line twice, gone or elsewhere."""
    lines = data[:end].split(b"\n")
    which = random.randrange(len(lines))
    change = random.random()
    if change < 0.7:
        words = lines[which].split(b" ")
        words[random.randrange(len(words))] = random.choice(WORDS).encode()
        lines[which] = b" ".join(words)
    elif change < 0.8:
        lines.insert(which, random.choice(lines))
    elif change < 0.9:
        del lines[which]
    else:
        other = random.randrange(len(lines))
        lines[which], lines[other] = lines[other], lines[which]
    return b"\n".join(lines) + data[end:]


#: Offset, kind and number of the fields of a FreeSurfer header.
MGH_FIELDS = [(0, "i", 1), (4, "i", 3), (16, "i", 1), (20, "i", 1), (28, "h", 1), (30, "f", 3),
              (42, "f", 9), (78, "f", 3)]


def _mgh_field(random, data, end):
    offset, kind, count = random.choice(MGH_FIELDS)
    place = offset + random.randrange(count) * struct.calcsize(kind)
    if place + 4 > len(data):
        return data
    spoiled = bytearray(data)
    value = random.choice(SINGLES) if kind == "f" else random.choice(INTEGERS)
    struct.pack_into(">" + kind, spoiled, place, value)
    return bytes(spoiled)


#: By the name of a file: what makes it, and what spoils it.
FORMATS = {"case.nii": (nifti, [_flip, _cut, _field, _field, _field]),
           "field.mha": (meta_image, [_flip, _cut, _word, _word, _word]),
           "field.nrrd": (nrrd, [_flip, _cut, _word, _word, _word]),
           "volume.mha": (meta_volume, [_flip, _cut, _word, _word, _word]),
           "volume.nrrd": (nrrd_volume, [_flip, _cut, _word, _word, _word]),
           "volume.mgh": (mgh, [_flip, _cut, _mgh_field, _mgh_field, _mgh_field])}


def spoiled_file(random):
    """The name and the bytes of a file in which up to three things are spoiled."""
    name = random.choice(["case.nii", *FORMATS])
    make, changes = FORMATS[name]
    data, end = make(random)
    for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
        data = random.choice(changes)(random, data, end)
    if name in ("case.nii", "volume.mgh") and random.random() < 0.3:
        data = gzip.compress(data)
        name += ".gz"
        if random.random() < 0.3:
            data = random.choice([_flip, _cut])(random, data, len(data))
    return name, data
