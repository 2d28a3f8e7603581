# SPDX-License-Identifier: BSD-3-Clause
# Proves that each attribute of a MINC2 file does what the list of fields in README.md says of it.
import shutil

import fields_walk
import h5py
import minc_files
import numpy
import volume_files
from brainshift_testing import load_plugin, run_tests, scratch

load_plugin()

AXIS = "minc-2.0/dimensions/xspace"
TIME = "minc-2.0/dimensions/time"
IMAGE = "minc-2.0/image/0/image"


def good():
    series = numpy.stack([volume_files.numbered((4, 5, 3)) + 100 * i for i in range(3)])
    return minc_files.write(scratch("good.mnc"), series, numpy.eye(4), times=(1.0, 2.0))


def changed(number, path, name, value):
    """A copy of the good file with another value of an attribute, or of a data set."""
    copy = scratch(f"walk{number}.mnc")
    shutil.copy(scratch("good.mnc"), copy)
    with h5py.File(copy, "r+") as file:
        if name is None:
            file[path][...] = value
        else:
            before = file[path].attrs.get(name)
            isText = isinstance(value, str)
            file[path].attrs[name] = (numpy.bytes_(value) if isText else
                                      numpy.asarray(value, getattr(before, "dtype", float)))
    return copy


def changes():
    first = good()
    found = {
        "start": [(AXIS, "start", 5.0), (TIME, "start", 5.0)],
        "step": [(AXIS, "step", 2.0), (TIME, "step", 3.0), (TIME, "step", -1.0)],
        "direction_cosines": [(AXIS, "direction_cosines", (0.8, 0.6, 0.0))],
        "units": [(AXIS, "units", "cm"), (TIME, "units", "ms")],
        "spacetype": [(AXIS, "spacetype", "talairach_")],
        "spacing": [(TIME, "spacing", "irregular")],
        "alignment": [(AXIS, "alignment", "start_")],
        "width": [(AXIS, "width", 3.0)], "comments": [(AXIS, "comments", "none")],
        "valid_range": [(IMAGE, "valid_range", (0.0, 1000.0))],
        "dimorder": [(IMAGE, "dimorder", "zspace,xspace,yspace,time")],
        "image-min": [("minc-2.0/image/0/image-min", None, 7.0)],
        "image-max": [("minc-2.0/image/0/image-max", None, 9.0)],
        "ident": [("minc-2.0", "ident", "somebody")]}
    return {name: [first, *(changed(f"{name}{i}", *change) for i, change in enumerate(these))]
            for name, these in found.items()}


def test_each_field_does_what_the_list_says():
    fields_walk.walk("MINC", "Fields of the file", changes(),
                     lambda path: fields_walk.outcome_of("MINCVolumeReader", path))


def test_units_that_are_none_are_refused_by_name():
    good()
    for path, name in ((AXIS, "xspace"), (TIME, "time")):
        error, _ = fields_walk.outcome_of(
            "MINCVolumeReader", changed("unit", path, "units", "furlong"))
        assert f"has the units 'furlong' along {name}" in error, error


def without(name):
    """The good file without an attribute of an axis."""
    copy = scratch(f"without_{name}.mnc")
    shutil.copy(scratch("good.mnc"), copy)
    with h5py.File(copy, "r+") as file:
        del file[AXIS].attrs[name]
    return copy


def test_what_an_axis_does_not_say_is_said():
    good()
    for path, words in (
            (without("step"), "has no step along xspace, which counts as 1"),
            (without("start"), "has no start along xspace, which counts as 0"),
            (changed("long", AXIS, "direction_cosines", (2.0, 0.0, 0.0)),
             "has direction_cosines along xspace that are 2 long, which count as 1")):
        error, found = fields_walk.outcome_of("MINCVolumeReader", path)
        assert not error and words in found[0], (error, found[0])
        assert found[5] == [1.0, 1.0, 1.0], found[5]
    assert not fields_walk.outcome_of("MINCVolumeReader", scratch("good.mnc"))[1][0]


run_tests(globals())
