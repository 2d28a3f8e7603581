# SPDX-License-Identifier: BSD-3-Clause
"""FreeSurfer volumes for the fuzz, what spoils them, and a second reader. That was written from the
text of the format with nothing but numpy and zlib. Its answers are in RAS mm."""

import struct

import numpy
from mutation import INTEGERS, SINGLES, Spoiled, cut, flip, numbers, rotation
from oracle import Volume, Wrong, unpacked

MGH_KINDS = {0: "u1", 1: "i4", 3: "f4", 4: "i2", 10: "u2"}


def mgh(random):
    """A good volume of FreeSurfer."""
    sides = [random.randrange(1, 6) for _ in range(3)]
    frames = random.choice([1, 1, 2])
    kind, code = random.choice([("u1", 0), ("i4", 1), ("f4", 3), ("i2", 4), ("u2", 10)])
    header = struct.pack(">7ih", 1, *sides, frames, code, 0, random.choice([1, 1, 1, 0]))
    steps = [random.choice([0.5, 1.0, 2.5]) for _ in range(3)]
    header += struct.pack(">15f", *steps, *rotation(random).T.ravel(),
                          *(random.uniform(-90, 90) for _ in range(3)))
    data = numbers(random, frames * int(numpy.prod(sides)), ">" + kind)
    return header.ljust(284, b"\0") + data + struct.pack(">4f", 2000.0, 0.0, 0.0, 0.0), 90


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


def _answer(raw):
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
    volume = Volume(centre - steps @ (numpy.array(sides) / 2.0), steps, (1, 1, 1),
                    values.reshape([*sides, 1], order="F"))
    return volume.world, volume.values


FILES = [Spoiled("volume.mgh", mgh, [flip, cut, _mgh_field, _mgh_field, _mgh_field],
                 "FreeSurferVolumeReader", _answer, packs=True)]
