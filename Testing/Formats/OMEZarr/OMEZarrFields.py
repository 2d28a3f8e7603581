# SPDX-License-Identifier: BSD-3-Clause
# Proves that each field of the metadata does what the lists of fields in README.md say.
import copy
import json

import fields_walk
import numpy
import zarr_files
from brainshift_testing import load_plugin, run_tests
from zarr_files import CHANNEL, SPACE, fresh, level, put

load_plugin()

VALUES = numpy.arange(1, 49, dtype="<i2").reshape(2, 4, 2, 3)
ARRAY = {"zarr_format": 2, "shape": [2, 4, 2, 3], "chunks": [2, 2, 2, 3], "dtype": "<i2",
         "compressor": None, "filters": None, "order": "C", "fill_value": 7,
         "dimension_separator": "."}
IMAGE = {"version": "0.4", "axes": [CHANNEL, *SPACE], "type": "mean",
         "metadata": {"method": "mean"},
         "datasets": [level("0", [1, 2, 3, 4]), level("1", [1, 4, 6, 8])]}
GROUP = {"multiscales": [IMAGE], "omero": {"channels": [{"label": "a"}, {"label": "b"}]},
         "image-label": {"colors": [{"label-value": 1, "rgba": [1, 2, 3, 255]}]}}
ARRAY_3 = {"zarr_format": 3, "node_type": "array", "shape": [2, 4, 2, 3], "data_type": "int16",
           "chunk_grid": {"name": "regular", "configuration": {"chunk_shape": [2, 2, 2, 3]}},
           "chunk_key_encoding": {"name": "default", "configuration": {"separator": "."}},
           "fill_value": 7, "codecs": [{"name": "bytes", "configuration": {"endian": "little"}}],
           "attributes": {}, "storage_transformers": [], "dimension_names": None}


def other(content, *keys_and_value):
    """The same with another value."""
    *keys, value = keys_and_value
    changed = copy.deepcopy(content)
    inner = changed
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = value
    return changed


def store(array, group=None):
    """What a test writes: the metadata of the group and of the first array."""
    return json.dumps([array, group or GROUP])


def read(content):
    array, group = json.loads(content)
    path = fresh("walk.zarr")
    chunk = VALUES[:, :2].tobytes()
    for name in ("0", "1"):
        said = array if name == "0" else other(ARRAY, "fill_value", 9)
        put(path, f"{name}/{'.zarray' if said['zarr_format'] != 3 else 'zarr.json'}", said)
        key = "0.0.0.0" if said["zarr_format"] != 3 else "c.0.0.0.0"
        with open(f"{path}/{name}/{key}", "wb") as file:
            file.write(chunk)
    put(path, ".zattrs", group)
    return fields_walk.outcome_of("OMEZarrReader", path, Level=0)


def test_fields_of_version_2():
    images = GROUP["multiscales"]
    image = ("multiscales", 0)
    changes = {
        "multiscales": other(GROUP, "multiscales", [{**IMAGE, "datasets": [
            level("1", [1, 4, 6, 8])]}]),
        "datasets": other(GROUP, *image, "datasets", images[0]["datasets"][::-1]),
        "path": other(GROUP, *image, "datasets", 0, "path", "1"),
        "axes": other(GROUP, *image, "axes", [CHANNEL, *SPACE[::-1]]),
        "coordinateTransformations": other(
            GROUP, *image, "datasets", 0, level("0", [1, 2, 3, 5])),
        "version": other(GROUP, *image, "version", "0.3"),
        "omero": other(GROUP, "omero", "channels", 0, "label", "c"),
        "image-label": other(GROUP, "image-label", "colors", 0, "rgba", [9, 2, 3, 255]),
        "brainshift": other(GROUP, "brainshift", {"world": "RAS"}),
        "type": other(GROUP, *image, "type", "gaussian"),
        "metadata": other(GROUP, *image, "metadata", {"method": "other"})}
    changed = {name: [store(ARRAY), store(ARRAY, group)] for name, group in changes.items()}
    for name, value in (("shape", [2, 3, 2, 3]), ("chunks", [2, 3, 2, 2]), ("dtype", ">i2"),
                        ("order", "F"), ("fill_value", 8), ("dimension_separator", "/"),
                        ("filters", [{"id": "delta"}]), ("zarr_format", 1)):
        changed[name] = [store(ARRAY), store(other(ARRAY, name, value))]
    fields_walk.walk("OMEZarr", "Fields of zarr 2", changed, read)


def test_fields_of_version_3():
    little = ARRAY_3["codecs"][0]
    changes = {
        "data_type": "uint16", "fill_value": 8,
        "chunk_key_encoding": {"name": "default", "configuration": {"separator": "/"}},
        "codecs": [{"name": "transpose", "configuration": {"order": [0, 2, 1, 3]}}, little],
        "chunk_grid": {"name": "rectilinear", "configuration": {}},
        "storage_transformers": ["x"], "node_type": "group",
        "dimension_names": ["a", "b", "c", "d"], "attributes": {"a": 1}}
    changed = {name: [store(ARRAY_3), store(other(ARRAY_3, name, value))]
               for name, value in changes.items()}
    fields_walk.walk("OMEZarr", "Fields of zarr 3", changed, read)


run_tests(globals())
