# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled OME-Zarr stores: metadata, chunks, missing files, zip files.

What BrainShift reads is compared with what zarr-python reads, at the places that Python's json and
numpy make of the metadata.
"""

import json
import math
import os
import shutil
import zipfile

import numpy
import zarr
import zarr_files
from files_cases import image_of, misplaced
from mutation import INTEGERS, REALS, WORDS
from oracle import Open

VALUES = [*INTEGERS, *REALS, *WORDS, None, True, [], {}, "../other", "0/0", 2 ** 31, 2 ** 40,
          2 ** 53 + 1, 2 ** 63, -2 ** 63, "<u2", ">i2", "<f4", "|u1", "uint8", "float32", "zstd",
          "blosc", "F", "C", ".", "/", "x", "y", "z", "t", "c", "space", "micrometer", "meter",
          "scale", "translation", "identity", "0.4", "0.5", "1", [1, 1, 1], [2, 2, 2], [4, 4, 4]]
METADATA = (".zattrs", ".zarray", ".zgroup", "zarr.json")
MILLIMETRES = {"millimeter": 1.0, "micrometer": 1e-3, "meter": 1e3}


def write(random, path):
    """A good store of one or two levels."""
    version = random.choice((2, 3))
    codecs = zarr_files.OF_VERSION_2 if version == 2 else zarr_files.OF_VERSION_3
    axes = random.choice([[], [zarr_files.TIME], [zarr_files.CHANNEL],
                          [zarr_files.TIME, zarr_files.CHANNEL]])
    lengths = [random.randrange(1, 3) for _ in axes] + [random.randrange(2, 8) for _ in range(3)]
    axes = axes + [{**axis, "unit": random.choice(list(MILLIMETRES))} for axis in zarr_files.SPACE]
    kind = random.choice(zarr_files.TYPES)
    words = {"codecs": codecs[random.choice(list(codecs))], "order": random.choice("CF")}
    if version == 3 and random.random() < 0.3 and words["order"] == "C":
        words.update(chunks=(2,) * len(axes), shards=(4,) * len(axes))
    datasets = []
    for i in range(random.choice((1, 2))):
        values = zarr_files.values_of([max(1, side >> i) for side in lengths], kind)
        values = values.astype(values.dtype.newbyteorder(random.choice("<>")))
        zarr_files.write_array(path, str(i), values, version, **words)
        datasets.append(zarr_files.level(
            str(i), [random.choice((0.5, 1.0, 2.5)) for _ in axes],
            [random.uniform(-90, 90) for _ in axes]))
    more = {}
    if random.random() < 0.3:
        more["coordinateTransformations"] = zarr_files.level(
            "", [random.choice((0.5, 1.0, 2.5)) for _ in axes])["coordinateTransformations"]
    zarr_files.describe(path, datasets, axes, version, more)
    if random.random() < 0.3:
        _add_own(random, path)


def _add_own(random, path):
    """What BrainShift's writer adds."""
    angle = random.uniform(-0.6, 0.6)
    cosine, sine = math.cos(angle), math.sin(angle)
    own = random.choice([
        {"world": "RAS"}, {"direction": [[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]]}])
    file, said = group_of(path)
    (said["attributes"] if "attributes" in said else said)["brainshift"] = own
    zarr_files.put(path, os.path.basename(file), said)


def group_of(path):
    """The file of the group's metadata, and its json."""
    third = os.path.join(path, "zarr.json")
    name = third if os.path.exists(third) else os.path.join(path, ".zattrs")
    with open(name, encoding="utf-8") as file:
        return name, json.load(file)


def files_in(path):
    return sorted(os.path.join(folder, name) for folder, _, names in os.walk(path)
                  for name in names)


def _metadata(random, path):
    """Another value somewhere in the JSON, or a member or an entry less."""
    name = random.choice([file for file in files_in(path) if os.path.basename(file) in METADATA])
    try:
        with open(name, encoding="utf-8") as file:
            content = json.load(file)
    except ValueError:
        return
    inner = content
    while isinstance(inner, (dict, list)) and inner:
        key = random.choice(list(inner) if isinstance(inner, dict) else range(len(inner)))
        deeper = inner[key]
        if not isinstance(deeper, (dict, list)) or not deeper or random.random() < 0.15:
            if random.random() < 0.2:
                del inner[key]
            else:
                inner[key] = random.choice(VALUES)
            break
        inner = deeper
    zarr_files.put(os.path.dirname(name), os.path.basename(name), content)


def bytes_spoiled(random, name):
    """One byte is another, the end is missing, or there are more."""
    with open(name, "rb") as file:
        content = file.read()
    change, place = random.random(), random.randrange(max(1, len(content)))
    if change < 0.5:
        content = content[:place] + bytes([random.randrange(256)]) + content[place + 1:]
    elif change < 0.9:
        content = content[:place]
    else:
        content += bytes(random.randrange(1, 99))
    with open(name, "wb") as file:
        file.write(content)


def _file(random, path):
    """A file is spoiled, gone or in the place of another."""
    names = files_in(path)
    name, change = random.choice(names), random.random()
    if change < 0.7:
        bytes_spoiled(random, name)
    elif change < 0.85:
        os.remove(name)
    else:
        other = random.choice(names)
        if other != name:
            shutil.copyfile(name, other)


def factor(axis):
    """Millimetres in the unit of an axis; None if the judge does not know it."""
    return MILLIMETRES.get(axis.get("unit"))


def require_separator(name):
    """zarr-python 3.0.6 takes a full stop where keys of chunks name no separator. The standard says
    a slash."""
    if os.path.exists(name):
        with open(name, encoding="utf-8") as file:
            keys = json.load(file)["chunk_key_encoding"]
        if "separator" not in keys["configuration"]:
            raise Open


def judged(path, shown):
    """World places of voxels, and their numbers as [x, y, z, component], of a level, by json, numpy
    and zarr-python. It raises what they raise."""
    said = group_of(path)[1]
    image = (said["attributes"]["ome"] if "attributes" in said else said)["multiscales"][0]
    own = said.get("attributes", said).get("brainshift")
    rows = (own.get("direction") if isinstance(own, dict) else None)
    direction = numpy.eye(3) if rows is None else numpy.array(rows, float)
    dataset = image["datasets"][shown]
    axes = image["axes"]
    scale, shift = zarr_files.transformed(image, dataset, axes)
    fixed = zarr_files.transformed(image, image["datasets"][0], axes)[1]
    require_separator(os.path.join(path, dataset["path"], "zarr.json"))
    values = zarr.open_array(os.path.join(path, dataset["path"]), mode="r")[...]
    names = [axis["name"] for axis in axes]
    if "t" in names:
        values = values.take(0, names.index("t"))
    order = [name for name in names if name != "t"]
    wanted = [*"xyz", *(["c"] if "c" in order else [])]
    values = values.transpose([order.index(name) for name in wanted]).astype(float)
    units = numpy.array([factor(axes[names.index(name)]) for name in "xyz"])
    place = [names.index(name) for name in "xyz"]

    def world(index):
        plain = (numpy.array(index) * scale[place] + shift[place]) * units
        first = fixed[place] * units
        return plain if rows is None else first + direction @ (plain - first)
    return world, values if values.ndim == 4 else values[..., None]


class Cases:
    """Reads spoiled stores, one for each case."""

    def __init__(self, folder):
        self.folder = os.path.join(folder, "store.zarr")
        self.zip = os.path.join(folder, "store.zip")

    def run(self, random):
        """What became of one store: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        shutil.rmtree(self.folder, ignore_errors=True)
        os.makedirs(self.folder)
        write(random, self.folder)
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            random.choice([_metadata, _metadata, _file])(random, self.folder)
        name, is_spoiled_zip = self.folder, random.random() < 0.1
        if is_spoiled_zip or random.random() < 0.2:
            name = self.zip
            with zipfile.ZipFile(name, "w", random.choice([0, zipfile.ZIP_DEFLATED])) as archive:
                for file in files_in(self.folder):
                    archive.write(file, os.path.relpath(file, self.folder))
            if is_spoiled_zip:
                bytes_spoiled(random, name)
        with messages() as said:
            image, level = self._read(name)
        if image is None:
            return "refused" if "error" in said.text.lower() else "misplaced: no image and no error"
        if said.text.count("Warning: ") != zarr_files.expected_warnings(said.text):
            return "told"
        if is_spoiled_zip:
            return "taken"  # an entry of another name is one that is not there
        return self._compared(random, image, level)

    @staticmethod
    def _read(name):
        from paraview import simple
        proxy = simple.OMEZarrReader(FileName=name)
        try:
            proxy.UpdatePipeline()
            image = image_of(proxy, "Intensity")
            output = proxy.GetClientSideObject().GetOutputDataObject(0)
            return image, int(output.GetFieldData().GetArray("OMEZarrLevel").GetValue(0)) \
                if image else None
        finally:
            simple.Delete(proxy)

    def _compared(self, random, image, level):
        with numpy.errstate(all="ignore"):
            try:
                world, values = judged(self.folder, level)
            except Open:
                return "open"
            except Exception as error:  # of many kinds
                return f"accepted: the other reader says: {type(error).__name__} {error}"[:200]
            problem = misplaced(random, image, world, values)
        return f"misplaced: {problem}" if problem else "same"
