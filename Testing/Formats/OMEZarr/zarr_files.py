# SPDX-License-Identifier: BSD-3-Clause
"""OME-Zarr stores as zarr-python writes them, which also judges: it reads the expected values."""

import json
import os
import shutil
import zipfile

import numcodecs
import numpy
import zarr
from brainshift_testing import messages, output, scratch
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

SPACE = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
TIME = {"name": "t", "type": "time", "unit": "second"}
CHANNEL = {"name": "c", "type": "channel"}

#: Codecs of zarr version 2 and 3 by what a test calls them.
OF_VERSION_2 = {
    "none": None, "zstd": numcodecs.Zstd(), "gzip": numcodecs.GZip(), "zlib": numcodecs.Zlib(),
    "lz4": numcodecs.LZ4(),
    **{f"blosc {name} {shuffle}": numcodecs.Blosc(name, 5, shuffle)
       for name in ("lz4", "lz4hc", "zstd", "zlib", "blosclz") for shuffle in (0, 1, 2)}}
OF_VERSION_3 = {
    "none": (), "zstd": (zarr.codecs.ZstdCodec(),), "gzip": (zarr.codecs.GzipCodec(),),
    "crc32c": (zarr.codecs.Crc32cCodec(),),
    "zstd crc32c": (zarr.codecs.ZstdCodec(checksum=True), zarr.codecs.Crc32cCodec()),
    "crc32c gzip": (zarr.codecs.Crc32cCodec(), zarr.codecs.GzipCodec()),
    **{f"blosc {name} {shuffle}": (zarr.codecs.BloscCodec(cname=name, shuffle=shuffle),)
       for name in ("lz4", "zstd", "zlib") for shuffle in ("noshuffle", "shuffle", "bitshuffle")}}
TYPES = ("uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float32",
         "float64", "bool")


def values_of(shape, kind):
    """Numbers of a type: all of its bytes count."""
    bits = numpy.random.default_rng(len(shape)).integers(0, 256, (*shape, 8), "uint8")
    if kind == "bool":
        return bits[..., 0] > 127
    size = numpy.dtype(kind).itemsize
    numbers = numpy.ascontiguousarray(bits[..., :size]).view(kind)[..., 0]
    return numpy.nan_to_num(numbers) if kind.startswith("float") else numbers


def write_array(path, name, values, version=3, chunks=None, order="C", codecs=None, **words):
    """An array as zarr-python writes it. `words` go to zarr.create_array."""
    chunks = chunks or tuple(min(side, 4) for side in values.shape)
    if version == 3:
        if order == "F":
            turned = tuple(reversed(range(values.ndim)))
            words["filters"] = [zarr.codecs.TransposeCodec(order=turned)]
        if values.dtype.byteorder == ">":
            words["serializer"] = zarr.codecs.BytesCodec(endian="big")
    else:
        words["order"] = order
    kind = values.dtype if version == 2 else values.dtype.newbyteorder("=")
    array = zarr.create_array(path, name=name, shape=values.shape, chunks=chunks, dtype=kind,
                              zarr_format=version, compressors=codecs, overwrite=True, **words)
    array[...] = values
    return array


def level(path, scale, *translation):
    """The metadata of one dataset."""
    steps = [{"type": "scale", "scale": list(scale)}]
    steps += [{"type": "translation", "translation": list(shift)} for shift in translation]
    return {"path": path, "coordinateTransformations": steps}


def describe(path, datasets, axes=None, version=3, more=None, **group):
    """Writes the metadata of the image. `more` belongs to the multiscales, `group` beside them."""
    image = {"axes": axes or SPACE, "datasets": datasets, **(more or {})}
    if version == 2:
        image.setdefault("version", "0.4")
        put(path, ".zgroup", {"zarr_format": 2})
        put(path, ".zattrs", {"multiscales": [image], **group})
    else:
        said = {"version": "0.5", "multiscales": [image], **group}
        put(path, "zarr.json", {"zarr_format": 3, "node_type": "group",
                                "attributes": {"ome": said}})
    return path


def put(path, name, json_or_text):
    """Writes one file of metadata."""
    file = os.path.join(path, name)
    os.makedirs(os.path.dirname(file), exist_ok=True)
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(json_or_text if isinstance(json_or_text, str) else json.dumps(json_or_text))
    return file


def fresh(name="image.zarr"):
    """An empty folder for a store."""
    path = scratch(name)
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    return path


def made(values, name="image.zarr", axes=None, version=3, scale=None, **words):
    """A store of one level, and its path."""
    path = fresh(name)
    write_array(path, "0", values, version, **words)
    scale = scale or [1.0] * values.ndim
    return describe(path, [level("0", scale)], axes or SPACE[-values.ndim:], version)


def zipped(path, name="image.ozx", method=zipfile.ZIP_STORED, top=""):
    """A store as a zip file."""
    file = scratch(name)
    with zipfile.ZipFile(file, "w", method) as archive:
        for folder, _, names in sorted(os.walk(path)):
            for one in sorted(names):
                full = os.path.join(folder, one)
                archive.write(full, top + os.path.relpath(full, path))
    return file


def numbers_of(image):
    """Of an image, indexed [z, y, x] or [z, y, x, component]."""
    array = vtk_to_numpy(image.GetPointData().GetArray("Intensity"))
    return array.reshape(tuple(reversed(image.GetDimensions())) + array.shape[1:])


def expected_warnings(text):
    """How many warnings a text has that good stores get: of unknown sides, and of an array that is
    all fill value, which zarr-python writes without chunks."""
    return (text.count("does not say where the sides of the patient are")
            + text.count("seems to have no chunk"))


def read(path, **properties):
    """(numbers, image, source) of a store, and nothing may be wrong with it but unknown sides."""
    with messages() as said:
        source = simple.OMEZarrReader(FileName=path, **properties)
        image = output(source)
    assert "ERROR" not in said.text, (path, said.text)
    assert said.text.count("Warning: ") == expected_warnings(said.text) > 0, said.text
    return numbers_of(image), image, source


def refused(path, **properties):
    """What the reader says of a store that it does not read."""
    with messages() as said:
        source = simple.OMEZarrReader(FileName=path, **properties)
        image = output(source)
    assert image.GetNumberOfPoints() == 0, path
    assert "ERROR" in said.text, path
    simple.Delete(source)
    return said.text


def transformed(image, dataset, axes):
    """(scale, translation) along the axes of a level."""
    scale, shift = numpy.ones(len(axes)), numpy.zeros(len(axes))
    for step in [*dataset["coordinateTransformations"],
                 *(image.get("coordinateTransformations") or [])]:
        if step["type"] == "scale":
            scale, shift = scale * step["scale"], shift * step["scale"]
        elif step["type"] == "translation":
            shift = shift + step["translation"]
    return scale, shift
