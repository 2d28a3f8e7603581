# SPDX-License-Identifier: BSD-3-Clause
"""NIfTI-1 files of volumes and fields for the fuzz, and what spoils them."""

import struct

import numpy
from mutation import INTEGERS, SINGLES, Spoiled, cut, flip, numbers, rotation
from nifti_oracle import Volume

#: Offset, kind and number of the fields of a NIfTI-1 header that say where and what.
NIFTI_FIELDS = [(0, "i", 1), (40, "h", 8), (56, "f", 3), (68, "h", 1), (70, "h", 1), (72, "h", 1),
                (76, "f", 8), (108, "f", 1), (112, "f", 2), (123, "b", 1), (252, "h", 2),
                (256, "f", 6), (280, "f", 12)]


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
    data = numbers(random, count, order + kind)
    return bytes(header) + data, 348


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


def _as_volume(data):
    volume = Volume(data)
    return volume.world, volume.values[:, :, :, 0, :]


def _as_field(data):
    volume = Volume(data)
    return volume.world, volume.as_field()


CHANGES = [flip, cut, _field, _field, _field]
FILES = [Spoiled("volume.nii", nifti, CHANGES, "NIFTIVolumeReader", _as_volume, packs=True),
         Spoiled("field.nii", nifti, CHANGES, "DisplacementFieldReader", _as_field, packs=True)]
