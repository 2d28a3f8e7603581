# SPDX-License-Identifier: BSD-3-Clause
"""Opens OME-Zarr images of other writers, and compares them with what zarr-python and json read.

    pvpython other_writers.py FOLDER...

It walks the folders, opens each group that has multiscales, and its levels of up to 2^25 numbers,
in all channels, at the first and the last time. Values must be equal bit for bit, places to
1e-12. It prints one line for each level that differs or is refused, then counts.
No file of another project is in this repository. Public ones are in the test data of
bioio-devs/bioio-ome-zarr, BioImageTools/ome-zarr-fiji-java and BioImageTools/ome-zarr-examples.
"""

import json
import os
import sys

import numpy
import zarr
import zarr_files
from brainshift_testing import load_plugin, messages

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

MOST_NUMBERS = 2 ** 25
MILLIMETRES = {"millimeter": 1.0, "micrometer": 1e-3, "nanometer": 1e-6, "meter": 1e3,
               "centimeter": 10.0, "angstrom": 1e-7}


def said_of(group):
    """The multiscales of a group; none if it has no image."""
    for name in ("zarr.json", ".zattrs"):
        path = os.path.join(group, name)
        if os.path.isfile(path):
            with open(path, encoding="utf-8") as file:
                said = json.load(file)
            if name == "zarr.json":
                said = said.get("attributes", {}).get("ome", {})
            return said.get("multiscales") or []
    return []


def groups_below(folder):
    for group, folders, names in os.walk(folder):
        folders.sort()
        if {"zarr.json", ".zattrs"} & set(names):
            try:
                if said_of(group):
                    yield group
            except (ValueError, AttributeError) as error:
                print(f"no JSON: {group}: {error}")


def place_of(image, dataset, axes):
    """(scale, translation) in mm along x, y, z, by json."""
    scale, shift = zarr_files.transformed(image, dataset, axes)
    names = [axis["name"] for axis in axes]
    result = []
    for name in "xyz":
        at = names.index(name) if name in names else None
        unit = 1.0 if at is None else MILLIMETRES.get(axes[at].get("unit"), 1.0)
        result.append((1.0, 0.0) if at is None else (scale[at] * unit, shift[at] * unit))
    return numpy.array(result).T


def expected_of(array, axes, time):
    """Numbers as [z, y, x, channel]."""
    names = [axis["name"] for axis in axes]
    values = array[tuple(time if name == "t" else slice(None) for name in names)]
    names = [name for name in names if name != "t"]
    for name in "zyxc":
        if name not in names:
            values, names = values[None], [name, *names]
    return values.transpose([names.index(name) for name in "zyxc"])


def difference(group, image, level):
    """What differs at one level: a sentence; empty if nothing, None if it was not compared."""
    dataset, axes = image["datasets"][level], image["axes"]
    array = zarr.open_array(os.path.join(group, dataset["path"]), mode="r")
    if array.size > MOST_NUMBERS:
        return None
    source = simple.OMEZarrReader(FileName=group, Level=level)
    try:
        return compared(source, array, place_of(image, dataset, axes), axes)
    finally:
        simple.Delete(source)


def compared(source, array, place, axes):
    names = [axis["name"] for axis in axes]
    count = array.shape[names.index("t")] if "t" in names else 1
    for time in sorted({0, count - 1}):
        with messages():
            source.UpdatePipelineInformation()
            times = list(source.TimestepValues or []) if count > 1 else [0.0]
            source.UpdatePipeline(times[time])
        image = source.GetClientSideObject().GetOutputDataObject(0)
        if image.GetNumberOfPoints() == 0:
            source.SMProxy.UpdatePropertyInformation()
            return "refused: " + source.GetPropertyValue("Problem")
        found = zarr_files.numbers_of(image)
        expected = expected_of(array, axes, time)
        if found.ndim == 3:
            found = found[..., None]
        if found.shape != expected.shape:
            return f"shape {found.shape}, zarr-python has {expected.shape}"
        if not numpy.array_equal(found, expected, equal_nan=expected.dtype.kind == "f"):
            return f"{int((found != expected).sum())} numbers at time {time}"
        spacing, origin = numpy.array(image.GetSpacing()), numpy.array(image.GetOrigin())
        if not (numpy.allclose(spacing, place[0], rtol=1e-12, atol=0)
                and numpy.allclose(origin, place[1], rtol=1e-12, atol=1e-12)):
            return f"spacing {spacing}, origin {origin}; json has {place.tolist()}"
    return ""


def main(folders):
    counts = {"same": 0, "different": 0, "refused": 0, "too large": 0}
    for group in (group for folder in folders for group in groups_below(folder)):
        image = said_of(group)[0]
        for level in range(len(image.get("datasets", []))):
            try:
                problem = difference(group, image, level)
            except Exception as error:  # of many kinds, from zarr-python and json
                problem = f"refused: the other reader says {type(error).__name__}: {error}"
            word = "same" if problem == "" else "too large" if problem is None else \
                "refused" if problem.startswith("refused") else "different"
            counts[word] += 1
            if problem:
                print(f"{word}: {group} level {level}: {problem}"[:500].replace("\n", " "))
    print(", ".join(f"{count} {word}" for word, count in counts.items()))
    return 1 if counts["different"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
