# SPDX-License-Identifier: BSD-3-Clause
# Proves that label maps show no label that does not exist: a colour map that interprets values as
# categories colours each value by its annotation in Deformed Volume and Deformed Slices, also where
# values are above 2^24, and a file that says it holds labels is drawn by nearest neighbour.
import gzip
import re
import struct

import numpy
from brainshift_testing import (assert_says, load_plugin, messages, object_pixels, picture,
                                run_tests, scratch, show_volume, view_along, volume)
from slices_testing import flat_view, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

COLORS = {1: (1, 0, 0), 2: (0, 1, 0), 7: (1, 1, 0), 9: (0, 0, 1), 200: (1, 0, 1)}
SIDE = 24
MIDDLE = ((SIDE - 1) / 2,) * 3
TOLERANCE = 0.03


def labels(values=(1, 9, 2, 200), kind=numpy.float64):
    """Four blocks that touch each other, and a wall of one voxel of 7 if there is a 200."""
    voxels = numpy.zeros((SIDE,) * 3, kind)
    middle = SIDE // 2
    for number, value in enumerate(values):
        x, y = number % 2, number // 2
        voxels[4:-4, 4 + y * (middle - 4):middle + y * (middle - 4),
               4 + x * (middle - 4):middle + x * (middle - 4)] = value
    if values[-1] == 200:
        voxels[4:-4, middle + 4, middle:-4] = 7
    return voxels


def bend(source):
    bent = simple.FreeFormDeformation(
        Input=source, Strokes=brainshift.soft(MIDDLE, (3.0, 0.5, 0.0), 12.0))
    bent.UpdatePipeline()
    return bent


def interpret_as_categories(display, colors):
    display.LookupTable.InterpretValuesAsCategories = 1
    display.LookupTable.Annotations = [word for value in colors for word in (str(value), "label")]
    display.LookupTable.IndexedColors = [x for color in colors.values() for x in color]
    display.LookupTable.NanColor = [0.0, 0.0, 0.0]


def strange_pixels(image, colors):
    """The fraction of the object that has none of the colours."""
    seen = object_pixels(image)
    known = numpy.zeros(seen.shape, bool)
    for color in colors:
        known |= numpy.abs(image - numpy.array(color, float)).max(axis=-1) < TOLERANCE
    return (seen & ~known).sum() / seen.sum()


def colored_pixels(image, color):
    return (numpy.abs(image - numpy.array(color, float)).max(axis=-1) < TOLERANCE).sum()


def slices_of(source, colors, change=interpret_as_categories, **named):
    view = flat_view(2, MIDDLE, 13.0)
    display = show_slices(source, view, position=MIDDLE, high=200.0)
    change(display, colors)
    for name, value in named.items():
        setattr(display, name, value)
    image = picture(view)
    simple.Delete(view)
    return image


def volume_of(source, colors, blend=0):
    view = view_along((0.2, 0.3, -1), MIDDLE, 90.0, half_height=14.0)
    view.MultiSamples = 0
    top = max(colors)
    display = show_volume(source, view, "Deformed Volume", [0, 0, 0, 0, top, 1, 1, 1],
                          [0, 0, 0.5, 0, 0.5, 1, 0.5, 0, top, 1, 0.5, 0])
    display.AmbientOcclusion = 0.0
    display.BlendMode = blend
    interpret_as_categories(display, colors)
    image = picture(view)
    simple.Delete(view)
    return image


def test_sums_of_categories_are_refused_with_a_word():
    for blend in (3, 4):  # Average, Additive
        with messages() as said:
            volume_of(volume(labels()), COLORS, blend)
        assert "Average and Additive need continuous values" in said.text, (blend, said.text)


def test_categories_are_never_blended():
    bent = bend(volume(labels()))
    for interpolation in ("Linear", "Cubic", "Nearest"):
        image = slices_of(bent, COLORS, SliceInterpolation=interpolation)
        assert strange_pixels(image, COLORS.values()) == 0.0, interpolation
        for label, color in COLORS.items():
            assert colored_pixels(image, color) > 20, (interpolation, label)
    image = volume_of(bent, COLORS)
    strange = strange_pixels(image, COLORS.values())
    print(f"  volume: {100 * strange:.2f} % of the pixels have the colour of no label")
    assert strange < 0.06, strange  # edges, drawn smoothly
    for label in (1, 9, 2, 200):
        assert colored_pixels(image, COLORS[label]) > 200, label


def test_labels_that_are_drawn_coarser_for_want_of_memory_are_not_averaged():
    fine = labels().repeat(4, 0).repeat(4, 1).repeat(4, 2)
    bent = bend(volume(fine, (-0.375,) * 3, (0.25,) * 3))
    view = view_along((0.2, 0.3, -1), MIDDLE, 90.0, half_height=14.0)
    view.MultiSamples = 0
    top = max(COLORS)
    display = show_volume(bent, view, "Deformed Volume", [0, 0, 0, 0, top, 1, 1, 1],
                          [0, 0, 0.5, 0, 0.5, 1, 0.5, 0, top, 1, 0.5, 0])
    interpret_as_categories(display, COLORS)
    whole = picture(view)
    display.MemoryLimit = 0.01
    with messages() as said:
        picture(view)
    total, corrections = (float(re.search(words, said.text).group(1)) for words in (
        r"needs ([\d.]+) MiB", r"corrections of it ([\d.]+)"))
    display.MemoryLimit = total - corrections - 0.5
    with messages() as said:
        coarse = picture(view)
    assert_says(said.text, "one value for 2 x 2 x 2 voxels")
    strange = [strange_pixels(image, COLORS.values()) for image in (whole, coarse)]
    print(f"  of no label: {100 * strange[0]:.2f} %, coarser {100 * strange[1]:.2f} %")
    assert strange[1] < 0.06, strange
    for label in (1, 9, 2, 200):
        assert colored_pixels(coarse, COLORS[label]) > 200, label


def test_labels_of_any_size_stay_apart():
    large = {2 ** 24 + 1: COLORS[1], 2 ** 24 + 2: COLORS[9], 2 ** 24 + 3: COLORS[2],
             2 ** 31 - 1: COLORS[200]}
    for kind in (numpy.int32, numpy.int64, numpy.float64):
        source = volume(labels(tuple(large), kind))
        for image in (slices_of(source, large), volume_of(source, large)):
            assert strange_pixels(image, large.values()) < 0.06
            for label, color in large.items():
                assert colored_pixels(image, color) > 100, (kind, label)


def test_a_value_without_annotation_has_the_colour_for_nan():
    some = {label: color for label, color in COLORS.items() if label != 9}

    def change(display, colors):
        interpret_as_categories(display, colors)
        display.LookupTable.NanColor = [0.2, 0.8, 0.9]

    image = slices_of(volume(labels()), some, change)
    assert colored_pixels(image, (0.2, 0.8, 0.9)) > 200
    assert colored_pixels(image, COLORS[9]) == 0


def test_of_too_many_values_those_with_an_annotation_are_drawn():
    """A volume has more values than colours have entries in the texture."""
    voxels = labels() * 1e6
    inside = voxels > 0
    voxels[~inside] = numpy.arange((~inside).sum())
    large = {int(label * 1e6): color for label, color in COLORS.items()}
    source = volume(voxels)
    for image in (slices_of(source, large), volume_of(source, large)):
        assert strange_pixels(image, large.values()) < 0.06
        for label in (1, 9, 2, 200):
            assert colored_pixels(image, COLORS[label]) > 100, label


def test_too_many_annotations_are_said():
    many = {value: COLORS[1] for value in range(4097)}
    source = volume(numpy.arange(SIDE ** 3, dtype=numpy.float32).reshape((SIDE,) * 3))
    with messages() as said:
        slices_of(source, many)
    assert "Interpret Values As Categories" in said.text and "4095" in said.text, said.text


def nifti(name, voxels, intent):
    """A NIfTI file of float values."""
    header = bytearray(352)
    struct.pack_into("<i", header, 0, 348)
    struct.pack_into("<8h", header, 40, 3, SIDE, SIDE, SIDE, 1, 1, 1, 1)
    struct.pack_into("<3h", header, 68, intent, 16, 32)
    struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
    struct.pack_into("<f", header, 108, 352)
    header[123] = 2
    struct.pack_into("<h", header, 254, 1)
    for row in range(3):
        struct.pack_into("<4f", header, 280 + 16 * row, *(float(i == row) for i in range(4)))
    header[344:348] = b"n+1\0"
    file = scratch(name)
    with gzip.open(file, "wb") as out:
        out.write(bytes(header) + voxels.astype("<f4").tobytes())
    return simple.OpenDataFile(file)


def test_a_file_of_labels_is_drawn_by_nearest_neighbour():
    blue = (0.0, 0.0, 1.0)

    def change(display, _):  # 5 is blue: it is only between 1 and 9
        display.LookupTable.RGBPoints = [0, 0, 0, 0, 1, 1, 0, 0, 3, 1, 0, 0, 4, *blue, 6, *blue,
                                         7, 1, 0, 0, 200, 1, 0, 0]

    found = {}
    for intent in (1002, 0):
        source = nifti(f"labels{intent}.nii.gz", labels(), intent)
        found[intent] = [colored_pixels(slices_of(shown, {}, change), blue)
                         for shown in (source, bend(source))]
    print(f"  pixels of a label 5: {found[1002]} of a label map, {found[0]} of a volume")
    assert max(found[1002]) == 0 and min(found[0]) > 0


run_tests(globals())
