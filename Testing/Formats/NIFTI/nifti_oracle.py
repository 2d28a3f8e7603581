# SPDX-License-Identifier: BSD-3-Clause
"""A second reader of NIfTI-1 files, written from the standard with nothing but numpy and zlib.

It answers where each voxel lies and what it holds, slowly. What the standard leaves open raises
`Open`; what it forbids raises `Wrong`.
"""

import struct

import numpy
from oracle import Open, Wrong, unpacked

#: numpy's types for the data types that are compared.
TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 64: "f8", 256: "i1", 512: "u2", 768: "u4"}
MM_PER_UNIT = {0: 1.0, 1: 1000.0, 2: 1.0, 3: 0.001}


class Header:
    """The fields of a NIfTI-1 header by their offsets."""

    def __init__(self, raw):
        if len(raw) < 352:
            raise Wrong("short")
        self.raw = raw
        self.order = "<"
        if not 1 <= self.get("h", 40) <= 7:
            self.order = ">"
        if not 1 <= self.get("h", 40) <= 7:
            raise Wrong("no header")
        if raw[344:348] != b"n+1\0":
            raise Open("magic")
        if raw[348] != 0:
            raise Open("extensions")

    def get(self, kind, offset, count=1):
        values = struct.unpack_from(f"{self.order}{count}{kind}", self.raw, offset)
        return values[0] if count == 1 else values

    def shape(self):
        """Sizes along x, y, z, time and components."""
        dim = self.get("h", 40, 8)
        sides = [dim[i] if i <= dim[0] else 1 for i in range(1, 8)]
        if min(sides) < 1:
            raise Wrong("a side below 1")
        if max(sides[5:]) > 1:
            raise Open("more than five dimensions")
        return sides[:5]

    def affine(self):
        """World RAS mm from voxel indices."""
        scale = MM_PER_UNIT.get(self.raw[123] & 7)
        if scale is None:
            raise Open("unit of length")
        if self.get("h", 254) > 0:
            rows = numpy.array(self.get("f", 280, 12), float).reshape(3, 4)
            return rows * scale
        pixdim = numpy.array(self.get("f", 76, 8), float)
        if not (numpy.isfinite(pixdim[:4]).all() and (pixdim[1:4] > 0).all()):
            raise Open("pixdim that is not above 0")
        axes, offset = numpy.eye(3), numpy.zeros(3)
        if self.get("h", 252) > 0:
            axes = self._rotation(numpy.array(self.get("f", 256, 3), float))
            axes[:, 2] *= -1.0 if pixdim[0] < 0.0 else 1.0
            offset = numpy.array(self.get("f", 268, 3), float)
        return numpy.column_stack([axes * pixdim[1:4], offset]) * scale

    @staticmethod
    def _rotation(bcd):
        length = float(bcd @ bcd)
        if not numpy.isfinite(length) or length > 1.0 + 1e-5:
            raise Open("quaternion longer than 1")
        b, c, d = bcd
        a = max(0.0, 1.0 - length) ** 0.5
        if a < 1e-3:
            raise Open("half a turn, decided by rounding")
        return numpy.array([
            [a * a + b * b - c * c - d * d, 2 * b * c - 2 * a * d, 2 * b * d + 2 * a * c],
            [2 * b * c + 2 * a * d, a * a + c * c - b * b - d * d, 2 * c * d - 2 * a * b],
            [2 * b * d - 2 * a * c, 2 * c * d + 2 * a * b, a * a + d * d - c * c - b * b]])

    def values(self):
        """All numbers, indexed [x, y, z, time, component], scaled as the header says."""
        kind = TYPES.get(self.get("h", 70))
        if kind is None:
            raise Open("data type")
        start = self.get("f", 108)
        if not (numpy.isfinite(start) and start == int(start) and start >= 352):
            raise Open("offset of the voxels")
        shape = self.shape()
        dtype = numpy.dtype(self.order + kind)
        count = int(numpy.prod(shape, dtype=float))
        if len(self.raw) < start + count * dtype.itemsize:
            raise Wrong("truncated")
        numbers = numpy.frombuffer(self.raw, dtype, count, int(start)).astype(float)
        slope, intercept = self.get("f", 112), self.get("f", 116)
        if not numpy.isfinite(slope) or not numpy.isfinite(intercept):
            raise Open("scale that is not finite")
        if slope != 0.0:
            numbers = slope * numbers + intercept
        return numbers.reshape(shape, order="F")


class Volume:
    """What a file holds: `world(index)` in RAS mm, `values[x, y, z, time, component]`."""

    def __init__(self, raw):
        header = Header(unpacked(raw))
        self.matrix = header.affine()
        if not numpy.isfinite(self.matrix).all():
            raise Wrong("affine that is not finite")
        self.values = header.values()
        self.header = header

    def world(self, index):
        return self.matrix[:, :3] @ numpy.asarray(index, float) + self.matrix[:, 3]

    def as_field(self):
        """The displacements of a field of vectors in RAS mm, indexed [x, y, z, component]."""
        header = self.header
        intent = header.get("h", 68)
        if intent not in (1006, 1007) or self.values.shape[3:] != (1, 3):
            raise Wrong("not vectors")
        if header.raw[123] & 7 not in (0, 2):
            raise Open("unit of vectors")
        vectors = self.values[:, :, :, 0, :].copy()
        if intent == 1007:
            if header.raw[328:338] == b"NREG_TRANS":
                raise Open("NiftyReg")
            vectors[..., :2] *= -1.0  # LPS
        return vectors
