# SPDX-License-Identifier: BSD-3-Clause
"""What the second readers share: their two exceptions, a placed volume, and gzip."""

import zlib

import numpy


class Wrong(Exception):
    """The file breaks the standard."""


class Open(Exception):
    """The standard leaves open what this means, or this oracle does not know it."""


def unpacked(raw):
    """The bytes of a file that may be packed with gzip."""
    if raw[:2] != b"\x1f\x8b":
        return raw
    out = b""
    while raw:
        stream = zlib.decompressobj(31)
        try:
            out += stream.decompress(raw)
        except zlib.error as error:
            raise Wrong(f"gzip: {error}") from error
        raw = stream.unused_data  # a truncated stream may still hold all voxels
        if raw and raw[:2] != b"\x1f\x8b":
            raise Open("bytes after the packed ones")
    return out


class Volume:
    """`world(index)` in RAS mm, `values[x, y, z, component]`."""

    def __init__(self, origin, steps, signs, values):
        if not numpy.linalg.det(steps):
            raise Wrong("flat")
        self.signs = numpy.array(signs, float)
        self.origin, self.steps, self.values = origin, steps, values

    def world(self, index):
        return self.signs * (self.origin + self.steps @ numpy.asarray(index, float))
