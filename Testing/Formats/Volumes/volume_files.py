# SPDX-License-Identifier: BSD-3-Clause
"""Writes volumes of other formats byte by byte, or with the formats' own libraries, for tests of
readers. A volume is an array indexed [i, j, k] and the 4 x 4 affine from indices to RAS mm."""

import gzip
import itertools
import zlib

import numpy

NRRD_TYPES = {"int8": "int8", "uint8": "uchar", "int16": "short", "uint16": "ushort",
              "int32": "int", "uint32": "uint", "int64": "int64", "uint64": "uint64",
              "float32": "float", "float64": "double"}
META_TYPES = {"int8": "CHAR", "uint8": "UCHAR", "int16": "SHORT", "uint16": "USHORT",
              "int32": "INT", "uint32": "UINT", "int64": "LONG_LONG", "uint64": "ULONG_LONG",
              "float32": "FLOAT", "float64": "DOUBLE"}
TO_LPS = numpy.diag([-1.0, -1.0, 1.0, 1.0])


def turns():
    """The affines of all 48 orders and directions of axes, with unlike spacings, far from 0."""
    for axes in itertools.permutations(range(3)):
        for signs in itertools.product((1.0, -1.0), repeat=3):
            affine = numpy.zeros((4, 4))
            for column, (row, sign) in enumerate(zip(axes, signs)):
                affine[row, column] = sign * (0.75, 1.5, 2.25)[column]
            affine[:, 3] = (-88.25, 31.125, 105.5, 1.0)
            yield affine


def tilted(affine):
    """The affine turned by 20 degrees about an axis that is none of the world's."""
    axis = numpy.array([1.0, -2.0, 0.5]) / numpy.linalg.norm([1.0, -2.0, 0.5])
    cross = numpy.cross(numpy.eye(3), axis)
    angle = numpy.radians(20.0)
    turn = numpy.eye(4)
    turn[:3, :3] += numpy.sin(angle) * cross + (1.0 - numpy.cos(angle)) * cross @ cross
    return turn @ affine


def affines():
    """All 48, and two that lie along no axis of the world."""
    turned = list(turns())
    return turned + [tilted(turned[5]), tilted(turned[42])]


def numbered(shape, kind="int16"):
    """Voxels that number themselves, so that each can be asked where it came to lie."""
    return numpy.arange(1, 1 + int(numpy.prod(shape))).reshape(shape).astype(kind)


def words(numbers):
    return " ".join(repr(float(number)) for number in numpy.ravel(numbers))


def nrrd(voxels, affine, space="left-posterior-superior", order="<", encoding="raw", more=()):
    """The bytes of an NRRD. `more`: further lines."""
    turned = affine
    if space == "left-posterior-superior":
        turned = TO_LPS @ affine
    if space == "left-anterior-superior":
        turned = numpy.diag([-1.0, 1.0, 1.0, 1.0]) @ affine
    vectors = [",".join(repr(float(number)) for number in turned[:3, i]) for i in range(4)]
    lines = ["NRRD0005", "# made by a test", f"type: {NRRD_TYPES[voxels.dtype.name]}",
             "dimension: 3", f"space: {space}",
             "sizes: " + " ".join(str(side) for side in voxels.shape),
             "space directions: " + " ".join(f"({vector})" for vector in vectors[:3]),
             "kinds: domain domain domain",
             f"endian: {'little' if order == '<' else 'big'}", f"encoding: {encoding}",
             f"space origin: ({vectors[3]})", *more, "", ""]
    raw = voxels.astype(voxels.dtype.newbyteorder(order)).tobytes(order="F")
    if encoding == "gzip":
        raw = gzip.compress(raw)
    if encoding == "ascii":
        raw = "\n".join(str(value) for value in voxels.ravel(order="F")).encode()
    return "\n".join(lines).encode() + raw


def segmentation(layers, affine, segments):
    """The bytes of an NRRD of segments that overlap, as 3D Slicer writes it. `layers`: indexed
    [layer, i, j, k]; `segments`: what Slicer says of each, such as {"Name": "skull"}."""
    more = [f"Segment{i}_{key}:={value}" for i, segment in enumerate(segments)
            for key, value in segment.items()]
    lines = nrrd(layers[0], affine, more=more)
    header = lines[:lines.index(b"\n\n")].decode()
    for old, new in (("dimension: 3", "dimension: 4"), ("sizes: ", f"sizes: {len(layers)} "),
                     ("directions: ", "directions: none "), ("kinds: ", "kinds: list ")):
        header = header.replace(old, new)
    return header.encode() + b"\n\n" + layers.tobytes(order="F")


def meta_image(voxels, affine, order="<", packed=False, more=()):
    """The bytes of a MetaImage."""
    lps = TO_LPS @ affine
    spacing = numpy.linalg.norm(lps[:3, :3], axis=0)
    raw = voxels.astype(voxels.dtype.newbyteorder(order)).tobytes(order="F")
    raw = zlib.compress(raw) if packed else raw
    lines = ["ObjectType = Image", "NDims = 3", "BinaryData = True",
             f"BinaryDataByteOrderMSB = {order == '>'}", f"CompressedData = {packed}",
             f"CompressedDataSize = {len(raw)}" if packed else "CenterOfRotation = 0 0 0",
             "TransformMatrix = " + words((lps[:3, :3] / spacing).T),
             "Offset = " + words(lps[:3, 3]), "ElementSpacing = " + words(spacing),
             "DimSize = " + " ".join(str(side) for side in voxels.shape), *more,
             f"ElementType = MET_{META_TYPES[voxels.dtype.name]}", "ElementDataFile = LOCAL", ""]
    return "\n".join(lines).encode() + raw


def write(name, content):
    with open(name, "wb") as file:
        file.write(content)
    return name
