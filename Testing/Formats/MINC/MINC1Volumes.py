# SPDX-License-Identifier: BSD-3-Clause
# Proves that MINC1 volumes lie where nibabel puts them and have its values: in all orders of axes,
# with negative steps, tilted, with ranges of slices and of times; and that what cannot be read is
# refused with a sentence. scipy writes the files; one is of another program.
import itertools
import os

import nibabel
import numpy
import volume_files
from brainshift_testing import data, load_plugin, messages, output, run_tests, scratch, voxels
from scipy.io import netcdf_file
from volume_places import assert_same_places, matrix, opened

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

READER = "MINC1VolumeReader"
SIDES = {"zspace": 3, "yspace": 4, "xspace": 5, "time": 2, "vector_dimension": 3}
COSINES = {"xspace": (0.8, 0.6, 0.0), "yspace": (-0.6, 0.8, 0.0), "zspace": (0.0, 0.0, 1.0)}
ORDER = ("zspace", "yspace", "xspace")
TYPES = {"uint8": ("b", b"unsigned"), "int8": ("b", b"signed__"), "int16": ("h", b"signed__"),
         "uint16": ("h", b"unsigned"), "int32": ("i", b"signed__"), "float32": ("f", None),
         "float64": ("d", None)}


def numbers(order, kind):
    """Voxels with numbers that differ, in the order of the axes."""
    shape = [SIDES[name] for name in order]
    low = 1 if kind.startswith("float") else -40 if kind.startswith("int") else 0
    return (numpy.arange(numpy.prod(shape)) % 120 + low).reshape(shape).astype(kind)


def write(name, order=ORDER, kind="int16", ranged=("zspace",), valid=(-50.0, 150.0), steps=None,
          change=None):
    """Writes a MINC1 file and returns its path. ranged: the axes of image-max; None: there is none.
    change(file): what else to set before it is closed."""
    path = scratch(name + ".mnc")
    stored = numbers(order, kind)
    code, sign = TYPES[kind]
    with netcdf_file(path, "w") as file:
        for axis in order:
            file.createDimension(axis, SIDES[axis])
        for axis in order:
            variable = file.createVariable(axis, "i", ())
            variable[...] = 0
            variable.spacing = b"regular__"
            if axis in COSINES:
                variable.start, variable.step = 7.0, (steps or {}).get(axis, 2.5)
                variable.direction_cosines = numpy.array(COSINES[axis])
                variable.units = b"mm"
            else:
                variable.start, variable.step = 1.0, 0.5
        image = file.createVariable("image", code, order)
        image[...] = stored.view(code) if code in "bhi" else stored
        if sign:
            image.signtype = sign
        if valid:
            image.valid_range = numpy.array(valid)
        if ranged is not None:
            sides = [SIDES[axis] for axis in ranged]
            for limit, first in (("image-max", 10.0), ("image-min", -3.0)):
                variable = file.createVariable(limit, "d", ranged)
                values = first + 0.5 * numpy.arange(numpy.prod(sides, dtype=int))
                if ranged:
                    variable[...] = values.reshape(sides)
                else:
                    variable[...] = values[0]
        if change:
            change(file)
    return path


def test_it_lies_where_nibabel_puts_it_and_has_its_values():
    farthest = 0.0
    for order in itertools.permutations(ORDER):
        for signs in itertools.product((2.5, -2.5), repeat=3):
            path = write("order", order, "float32", ranged=(), steps=dict(zip(ORDER, signs)))
            farthest = max(farthest, assert_same_places(path, READER, nibabel.load(path)))
    assert farthest < 1e-3, farthest
    print(f"MINC1: farthest voxel {farthest} mm")


def test_a_file_of_another_program_is_read():
    path = data("minc1", "minc1_1_scale.mnc")
    judged = nibabel.load(path)
    source = opened(path, READER)
    numpy.testing.assert_allclose(
        matrix(output(source)), judged.affine[:, [2, 1, 0, 3]], atol=1e-6)
    numpy.testing.assert_allclose(voxels(source), judged.get_fdata(), rtol=1e-6)


def test_files_of_minc_tools_are_read():
    path = data("other-writers", "minc_tools.mnc")
    judged = nibabel.load(path)
    source = opened(path, READER)
    affine, found, values = matrix(output(source)), voxels(source), judged.get_fdata()
    for index in numpy.ndindex(*judged.shape):
        place = numpy.linalg.solve(affine, judged.affine @ (*index, 1.0))[:3]
        at = numpy.rint(place).astype(int)
        assert numpy.linalg.norm(affine[:3, :3] @ (place - at)) < 1e-3, index
        assert abs(found[tuple(at[::-1])] - values[index]) < 1e-5, index
    # nibabel reads no uneven times; the numbers are those that rawtominc was given.
    with messages() as said:
        source = opened(data("other-writers", "minc_tools_times.mnc"), READER)
        source.UpdatePipeline()
    right = (numpy.arange(120).reshape(2, 3, 4, 5) / 7 - 3).astype(numpy.float32)  # [t, z, x, y]
    assert list(source.TimestepValues) == [0.0, 2.5], source.TimestepValues
    for time, volume in zip((0.0, 2.5), right):
        source.UpdatePipeline(time)
        numpy.testing.assert_array_equal(voxels(source), volume.transpose(0, 2, 1)[::-1])
    assert "start along zspace, which counts as 0" in said.text, said.text


def test_types_and_ranges_are_those_of_nibabel():
    for kind in TYPES:
        isReal = kind.startswith("float")
        for ranged in (("zspace",), ()):
            for valid in ((0.0, 100.0), None):
                path = write("types", kind=kind, ranged=ranged, valid=None if isReal else valid)
                judged = nibabel.load(path).get_fdata()
                shown = voxels(opened(path, READER))
                assert shown.dtype == ("float64" if kind in ("int32", "float64") else "float32")
                numpy.testing.assert_allclose(shown, judged, rtol=1e-6, atol=1e-6)


def test_times_and_components():
    for order, ranged in ((("time", *ORDER), ("time", "zspace")), ((*ORDER[:1], "time", *ORDER[1:]),
                                                                ("zspace",))):
        path = write("times", order, ranged=ranged)
        judged = numpy.moveaxis(nibabel.load(path).get_fdata(), order.index("time"), 0)
        source = opened(path, READER)
        assert list(source.TimestepValues) == [1.0, 1.5], source.TimestepValues
        for time, right in zip((1.0, 1.5), judged):
            source.UpdatePipeline(time)
            numpy.testing.assert_allclose(voxels(source), right, rtol=1e-6)
    for place in range(4):
        order = (*ORDER[:place], "vector_dimension", *ORDER[place:])
        path = write("vectors", order, kind="float32")
        source = opened(path, READER)
        right = numpy.moveaxis(numbers(order, "float32"), place, 3)
        array = output(source).GetPointData().GetScalars()
        assert array.GetNumberOfComponents() == 3
        numpy.testing.assert_array_equal(
            [array.GetTuple(i) for i in range(array.GetNumberOfTuples())], right.reshape(-1, 3))


def said_of(path):
    with messages() as said:
        source = simple.MINC1VolumeReader(FileName=path)
        source.UpdatePipeline()
    return source, said.text


def setting(variable, **attributes):
    def change(file):
        for name, value in attributes.items():
            setattr(file.variables[variable], name, value)
    return change


def test_units_have_their_size():
    for units, mm in ((b"m", 1000.0), (b"um", 1e-3), (b"cm", 10.0)):
        path = write("units", change=setting("xspace", units=units))
        source, said = said_of(path)
        assert not said, said
        assert abs(output(source).GetSpacing()[0] / (2.5 * mm) - 1.0) < 1e-9, units


def test_a_template_is_named():
    for word, name in ((b"native____", None), (b"talairach_", "not named")):
        source, said = said_of(write("template", change=setting("xspace", spacetype=word)))
        found = output(source).GetFieldData().GetAbstractArray("Template")
        assert not said and (found.GetValue(0) if found else None) == name, (said, word)


def test_cosines_count_as_directions_alone():
    for length, said_words in ((1.0009, False), (1.1, True)):
        cosines = length * numpy.array(COSINES["xspace"])
        source, said = said_of(write("long", change=setting("xspace", direction_cosines=cosines)))
        assert ("long, which count as 1" in said) == said_words, said
        assert abs(output(source).GetSpacing()[0] - 2.5) < 1e-9, length


def test_what_an_axis_lacks_is_reported():
    def change(file):
        del file.variables["xspace"]._attributes["step"]  # scipy has no call for it

    source, said = said_of(write("lacks", change=change))
    assert "has no step along xspace, which counts as 1" in said, said
    assert output(source).GetSpacing()[0] == 1.0


def test_what_cannot_be_read_is_refused():
    def infinite(file):
        file.variables["image-max"][...] = numpy.inf

    def renamed(file):
        file.variables["picture"] = file.variables.pop("image")

    cases = (
        (dict(change=setting("xspace", spacing=b"irregular")), "irregular spacing along xspace"),
        (dict(change=setting("xspace", units=b"furlong")), "has the units 'furlong' along xspace"),
        (dict(change=setting("xspace", direction_cosines=numpy.ones(2))),
         "has 2 direction_cosines"),
        (dict(valid=(5.0, 5.0)), "has a valid_range from 5 to 5"),
        (dict(valid=(0.0, 40000.0)), "has a valid_range from 0 to 40000"),
        (dict(ranged=None), "has no image-max"),
        (dict(ranged=("xspace",)), "has an image-max along an axis"),
        (dict(change=infinite), "has an image-max that is no number"),
        (dict(change=renamed), "without a variable image"))
    for arguments, words in cases:
        source, said = said_of(write("refused", **arguments))
        assert words in said, (words, said)
        assert output(source).GetNumberOfPoints() == 0, words


def test_dimensions_without_an_end_are_refused():
    path = write("unlimited", change=lambda file: file.createDimension("record", 1))
    with open(path, "rb") as file:
        content = file.read()
    assert content.count(b"record\0\0\0\0\0\1") == 1
    volume_files.write(path, content.replace(b"record\0\0\0\0\0\1", b"record" + bytes(6)))
    source, said = said_of(path)
    assert "dimension without an end" in said, said
    assert output(source).GetNumberOfPoints() == 0


def test_a_file_that_is_cut_anywhere_is_refused():
    path = write("whole")
    size = os.path.getsize(path)
    with open(path, "rb") as file:
        content = file.read()
    for end in (*range(4, size, 97), size - 4):
        short = volume_files.write(scratch("short.mnc"), content[:end])
        source, said = said_of(short)
        assert said and output(source).GetNumberOfPoints() == 0, (end, said)


def with_gap(content, gap):
    """A netCDF file with unused bytes between its header and its data, as nc__enddef can leave.
    The offsets of all variables are the last words of their entries in the header."""
    count = content.index(b"\0\0\0\x0b") + 4
    begins = []
    at = count + 4

    def word(place):
        return int.from_bytes(content[place:place + 4], "big")

    def padded(size):
        return -(-size // 4) * 4

    for _ in range(word(count)):
        at += 4 + padded(word(at))
        at += 4 + 4 * word(at)
        attributes, at = word(at + 4), at + 8
        for _ in range(attributes):
            at += 4 + padded(word(at))
            at += 8 + padded(word(at + 4) * {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8}[word(at)])
        at += 12
        begins.append(at - 4)
    first = min(word(place) for place in begins)
    moved = bytearray(content)
    for place in begins:
        moved[place:place + 4] = (word(place) + gap).to_bytes(4, "big")
    return bytes(moved[:first]) + bytes(gap) + bytes(moved[first:])


def test_a_file_with_a_gap_before_its_data_is_whole_or_refused():
    path = write("gap", kind="float32", ranged=())
    with open(path, "rb") as file:
        content = with_gap(file.read(), 256)
    source, said = said_of(volume_files.write(scratch("gap whole.mnc"), content))
    assert not said, said
    numpy.testing.assert_array_equal(voxels(source), numbers(ORDER, "float32"))
    for cut in (4, 100, 256, 300):
        short = volume_files.write(scratch("gap cut.mnc"), content[:-cut])
        source, said = said_of(short)
        assert f"its header announces {len(content)}" in said, (cut, said)
        assert output(source).GetNumberOfPoints() == 0, cut


def test_counts_that_no_file_has_are_refused_before_netcdf_takes_memory():
    path = write("counts", kind="float32", ranged=())
    with open(path, "rb") as file:
        content = file.read()
    for place, words in ((12, "announces 2147483647 dimensions in"),
                         (16, "ends within its header")):  # the length of the first name
        spoiled = content[:place] + (2 ** 31 - 1).to_bytes(4, "big") + content[place + 4:]
        source, said = said_of(volume_files.write(scratch("counts spoiled.mnc"), spoiled))
        assert words in said and output(source).GetNumberOfPoints() == 0, said


run_tests(globals())
