# SPDX-License-Identifier: BSD-3-Clause
# Proves that voxels of OME-Zarr lie where their metadata say, to the last digit: scale and
# translation of levels and of the group, every unit, 2D, levels by memory, labels, several images.
import os

import numpy
import zarr_files
from brainshift_testing import load_plugin, messages, output, run_tests
from zarr_files import CHANNEL, SPACE, TIME, describe, fresh, level, read, refused, write_array

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

#: Millimetres in each unit of length that OME-Zarr names, and seconds in each unit of time.
PREFIXES = {"yocto": -24, "zepto": -21, "atto": -18, "femto": -15, "pico": -12, "nano": -9,
            "micro": -6, "milli": -3, "centi": -2, "deci": -1, "": 0, "hecto": 2, "kilo": 3,
            "mega": 6, "giga": 9, "tera": 12, "peta": 15, "exa": 18, "zetta": 21, "yotta": 24}
LENGTHS = {**{f"{name}meter": float(f"1e{power + 3}") for name, power in PREFIXES.items()},
           "angstrom": 1e-7, "foot": 304.8, "inch": 25.4, "mile": 1609344.0,
           "parsec": 3.0856775814913673e19, "yard": 914.4}
TIMES = {**{f"{name}second": float(f"1e{power}") for name, power in PREFIXES.items()},
         "day": 86400.0, "hour": 3600.0, "minute": 60.0}
CUBE = numpy.arange(4 * 3 * 2, dtype="uint8").reshape(4, 3, 2)


def near(found, expected):
    assert numpy.allclose(found, expected, rtol=4e-16, atol=0), (list(found), list(expected))


def one_level(transformations, more=None, axes=None, values=CUBE, version=3):
    path = fresh()
    write_array(path, "0", values, version)
    return describe(path, [{"path": "0", "coordinateTransformations": transformations}], axes,
                    version, more)


def test_scale_and_translation():
    for version in (2, 3):
        path = one_level([{"type": "scale", "scale": [2.5, 0.5, 0.25]},
                          {"type": "translation", "translation": [10, -20, 30.5]}], None, None,
                         CUBE, version)
        _, image, _ = read(path)
        near(image.GetSpacing(), (0.25, 0.5, 2.5))
        near(image.GetOrigin(), (30.5, -20, 10))
        assert image.GetDimensions() == (2, 3, 4)


def test_the_group_transforms_last():
    path = one_level([{"type": "scale", "scale": [2, 3, 4]},
                      {"type": "translation", "translation": [1, 2, 3]}],
                     {"coordinateTransformations": [
                         {"type": "identity"}, {"type": "scale", "scale": [10, 100, 0.5]},
                         {"type": "translation", "translation": [-1, -2, -3]}]})
    _, image, _ = read(path)
    near(image.GetSpacing(), (2, 300, 20))
    near(image.GetOrigin(), (3 * 0.5 - 3, 2 * 100 - 2, 1 * 10 - 1))


def test_a_negative_scale_flips():
    """The voxels stay where they are said to be: the last along the axis comes first."""
    path = one_level([{"type": "scale", "scale": [2, -3, 4]},
                      {"type": "translation", "translation": [1, 2, 3]}])
    found, image, _ = read(path)
    near(image.GetSpacing(), (4, 3, 2))
    near(image.GetOrigin(), (3, 2 - 2 * 3, 1))
    assert (found == CUBE[:, ::-1]).all()
    reader = simple.OMEZarrReader(FileName=path).GetClientSideObject()
    reader.UpdateInformation()
    reader.UpdateExtent([0, 1, 0, 0, 1, 2])
    assert (zarr_files.numbers_of(reader.GetOutput()) == CUBE[1:3, 2:3]).all()


def test_units_of_length():
    for unit, millimetres in LENGTHS.items():
        axes = [{**axis, "unit": unit} for axis in SPACE]
        scale = [step / millimetres for step in (0.5, 2.0, 4.0)]
        path = one_level([{"type": "scale", "scale": scale}], None, axes)
        _, image, _ = read(path)
        assert numpy.allclose(image.GetSpacing(), (4.0, 2.0, 0.5), rtol=1e-15), unit
    print(f"{len(LENGTHS)} units of length")


def test_units_of_time():
    values = numpy.zeros((3, 4, 3, 2), "uint8")
    for unit, seconds in TIMES.items():
        axes = [{**TIME, "unit": unit}, *SPACE]
        path = one_level([{"type": "scale", "scale": [2.0 / seconds, 1, 1, 1]},
                          {"type": "translation", "translation": [1.0 / seconds, 0, 0, 0]}],
                         None, axes, values)
        _, _, source = read(path)
        assert numpy.allclose(list(source.TimestepValues), (1.0, 3.0, 5.0), rtol=1e-15), unit
    print(f"{len(TIMES)} units of time")


def said_of(path, **properties):
    with messages() as said:
        output(simple.OMEZarrReader(FileName=path, **properties))
    return said.text


def test_other_units_are_reported():
    for unit in ("furlong", "micron", "Millimeter", None, 3):
        axes = [{**SPACE[0], "unit": unit}, *SPACE[1:]]
        if unit is None:
            del axes[0]["unit"]
        text = said_of(one_level([{"type": "scale", "scale": [1, 1, 1]}], None, axes))
        known = "no unit" if unit is None else "the unit"
        assert f"names {known}" in text and "mm is taken" in text, text
        assert unit is None or str(unit) in text, text
    axes = [{"name": axis["name"], "type": "space"} for axis in SPACE]
    text = said_of(one_level([{"type": "scale", "scale": [1, 1, 1]}], None, axes))
    assert 'names no unit of the axes "z", "y" and "x"; mm is taken' in text, text


def oriented(*words):
    """A store whose axes z, y and x lead along these words (RFC 4 of NGFF); None: not said."""
    axes = [{**axis, **({"orientation": {"type": "anatomical", "value": word}} if word else {})}
            for axis, word in zip(SPACE, words)]
    return one_level([{"type": "scale", "scale": [1, 2, 3]},
                      {"type": "translation", "translation": [10, 20, 30]}], None, axes)


def test_orientations_of_axes_name_the_sides():
    values = CUBE
    for words, signs, order in (
            (("inferior-to-superior", "posterior-to-anterior", "left-to-right"), (1, 1, 1),
             (0, 1, 2)),
            (("inferior-to-superior", "anterior-to-posterior", "right-to-left"), (-1, -1, 1),
             (0, 1, 2)),
            (("right-to-left", "superior-to-inferior", "anterior-to-posterior"), (-1, -1, -1),
             (2, 0, 1))):
        path = oriented(*words)
        assert "sides of the patient" not in said_of(path), words
        image = output(simple.OMEZarrReader(FileName=path))
        assert image.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
        # Of each axis of the world, R A S: the axis of z, y, x in the store that leads along it.
        stored = [2 - axis for axis in order]
        for index in numpy.ndindex(*values.shape):
            at = [([10, 20, 30][i] + [1, 2, 3][i] * index[i]) for i in stored]
            place = [sign * each for sign, each in zip(signs, at)]
            found = image.FindPoint(place)
            near(image.GetPoint(found), place)
            assert image.GetPointData().GetScalars().GetValue(found) == values[index], index


def test_other_orientations_name_no_side():
    for words in (("dorsal-to-ventral", "rostral-to-caudal", "left-to-right"),
                  ("inferior-to-superior", "left-to-right", "right-to-left"),
                  ("inferior-to-superior", "posterior-to-anterior", None)):
        text = said_of(oriented(*words))
        assert "sides of the patient" in text and "they are not used" in text, text
        near(output(simple.OMEZarrReader(FileName=oriented(*words))).GetOrigin(), (30, 20, 10))


def test_axes_of_other_names_are_reported():
    axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in ("dim_0", "b", "c")]
    path = one_level([{"type": "scale", "scale": [1, 2, 3]}], None, axes)
    assert "taken as z, y, x" in said_of(path)
    near(output(simple.OMEZarrReader(FileName=path)).GetSpacing(), (3, 2, 1))


def test_two_axes_make_a_slice():
    path = one_level([{"type": "scale", "scale": [2, 3]}], None, SPACE[1:], CUBE[0])
    with messages() as said:
        image = output(simple.OMEZarrReader(FileName=path))
    assert image.GetDimensions() == (2, 3, 1) and "one slice of 1 mm" in said.text, said.text
    near(image.GetSpacing(), (3, 2, 1))


def test_levels_without_translations_are_reported():
    path = fresh()
    for i, side in enumerate((32, 16)):
        write_array(path, str(i), numpy.full((side,) * 3, i + 1, "uint16"), chunks=(8, 8, 8))
    describe(path, [level(str(i), [2.0 ** i] * 3) for i in range(2)])
    assert "no translation" not in said_of(path, Level=0)
    text = said_of(path, Level=1)
    assert "no translation of level 1" in text and "up to 0.5 mm from its place" in text, text


def test_a_store_without_chunks_is_reported():
    path = one_level([{"type": "scale", "scale": [1, 1, 1]}])
    assert "no chunk" not in said_of(path)
    kept = {"zarr.json", ".zarray", ".zattrs", ".zgroup"}
    for folder, _, names in os.walk(path):
        for name in set(names) - kept:
            os.remove(os.path.join(folder, name))
    text = said_of(path)
    assert "seems to have no chunk of level 0, such as '0/" in text, text


def test_the_sides_are_not_known():
    _, image, _ = read(one_level([{"type": "scale", "scale": [1, 1, 1]}]))
    assert image.GetFieldData().GetAbstractArray("WorldAxes") is None


def pyramid():
    """Three levels of 64, 8 and 1 KiB: a constant in each."""
    path = fresh()
    for i, side in enumerate((32, 16, 8)):
        write_array(path, str(i), numpy.full((side,) * 3, i + 1, "uint16"), chunks=(8, 8, 8))
    return describe(path, [level(str(i), [2.0 ** i] * 3, [0.5 * 2 ** i - 0.5] * 3)
                           for i in range(3)])


def test_levels():
    path = pyramid()
    sizes = [[32] * 3, [16] * 3, [8] * 3]
    for properties, expected, word in (
            ({}, 0, "the finest"), ({"MemoryLimit": 0.03125}, 1, "above the MemoryLimit"),
            ({"MemoryLimit": 0.0625}, 0, "the finest"), ({"MemoryLimit": 0}, 2, "the coarsest"),
            ({"Level": 2}, 2, "Level says"), ({"Level": 0, "MemoryLimit": 0}, 0, "Level says")):
        found, image, source = read(path, **properties)
        assert (found == expected + 1).all() and list(image.GetDimensions()) == sizes[expected]
        near(image.GetSpacing(), [2.0 ** expected] * 3)
        near(image.GetOrigin(), [0.5 * 2 ** expected - 0.5] * 3)
        source.UpdatePropertyInformation()
        note = source.GetPropertyValue("Note")
        assert f"Level {expected} of 3" in note and word in note, note
        fields = image.GetFieldData()
        assert fields.GetAbstractArray("OMEZarrStore").GetValue(0) == path
        assert fields.GetAbstractArray("OMEZarrImage").GetValue(0) == "image"
        assert fields.GetArray("OMEZarrLevel").GetValue(0) == expected
        levels = fields.GetArray("OMEZarrLevelSizes")
        assert [list(levels.GetTuple3(i)) for i in range(levels.GetNumberOfTuples())] == sizes
        simple.Delete(source)
    assert "the levels 0 to 2; Level is 3" in refused(path, Level=3)


def with_labels(version):
    path = one_level([{"type": "scale", "scale": [1, 1, 1]}], None, None, CUBE, version)
    labels = path + "/labels"
    said = {"labels": ["cells"]}
    if version == 2:
        zarr_files.put(labels, ".zattrs", said)
    else:
        zarr_files.put(labels, "zarr.json", {"zarr_format": 3, "node_type": "group",
                                             "attributes": {"ome": said}})
    write_array(labels, "cells/0", CUBE.astype("int32") % 3, version)
    describe(labels + "/cells", [level("0", [1, 1, 1])], None, version, None, **{"image-label": {
        "colors": [{"label-value": 1, "rgba": [255, 128, 0, 255]}, {"label-value": 2}],
        "properties": [{"label-value": 2, "name": "nucleus"}]}})
    return path


def test_labels():
    for version in (2, 3):
        path = with_labels(version)
        _, image, source = read(path)
        assert image.GetFieldData().GetAbstractArray("LabelValues") is None
        assert list(source.GetProperty("ImageList")) == ["image", "labels/cells"]
        for found, image, source in (read(path, Image="labels/cells"),
                                     read(path + "/labels/cells"), read(path + "/labels")):
            assert (found == CUBE % 3).all()
            fields = image.GetFieldData()
            assert fields.GetArray("IsLabelMap") is not None
            names = fields.GetAbstractArray("LabelNames")
            assert [names.GetValue(i) for i in range(2)] == ["1", "nucleus"]
            colors = fields.GetArray("LabelColors")
            assert [colors.GetTuple3(i) for i in range(2)] == [(255, 128, 0), (255, 255, 255)]
        assert "it has image, labels/cells" in refused(path, Image="labels/other")


def test_series_of_bioformats():
    path = fresh()
    for i in range(3):
        write_array(path, f"{i}/0", numpy.full((2, 2, 2), i, "uint8"), 2)
        describe(f"{path}/{i}", [level("0", [1, 1, 1])], None, 2)
    zarr_files.put(path, ".zattrs", {"bioformats2raw.layout": 3})
    _, _, source = read(path)
    assert list(source.GetProperty("ImageList")) == ["0", "1", "2"]
    assert (read(path, Image="2")[0] == 2).all()


def test_names_of_channels():
    values = numpy.zeros((2, 2, 2, 2), "uint8")
    path = fresh()
    write_array(path, "0", values)
    describe(path, [level("0", [1] * 4)], [CHANNEL, *SPACE],
             omero={"channels": [{"label": "DAPI"}, {"label": "GFP"}]})
    for channel, names in ((-1, ["DAPI", "GFP"]), (1, ["GFP"])):
        array = read(path, Channel=channel)[1].GetPointData().GetArray("Intensity")
        assert [array.GetComponentName(i) for i in range(len(names))] == names


run_tests(globals())
