# SPDX-License-Identifier: BSD-3-Clause
# Proves that colours, palettes, inverse greys and parametric maps of DICOM are read as what they
# are, with their units, and that those that are not read are named.
import os
import shutil

import numpy
import pydicom
from brainshift_testing import assert_says, data, load_plugin, output, run_tests, scratch
from dicom_testing import (AXIAL, OBLIQUE, affine_of, assert_placed, enhanced, folder, numbered,
                           read, read_again, scalars, write_slices)
from pydicom.encaps import encapsulate
from pydicom.sequence import Sequence
from segment_files import code, item, run_lengths
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()

PARAMETRIC = "1.2.840.10008.5.1.4.1.1.30"
COLOURS = numpy.random.default_rng(8).integers(0, 256, (3, 4, 6, 3)).astype(numpy.uint8)


def refused(change, *words):
    path = write_slices(folder("colours-refused"), numbered(), change=change)
    reader, told = read(path)
    assert_says(told, *words)
    assert output(reader).GetNumberOfPoints() == 0, words


def coloured(pixels, kind="RGB", planar=0, syntax=None):
    """A change that gives slices these colours [slice, row, column, 3]."""
    def change(image, index):
        image.PhotometricInterpretation, image.SamplesPerPixel = kind, 3
        image.PlanarConfiguration = planar
        plane = pixels[index]
        stored = plane.transpose(2, 0, 1) if planar else plane
        image.PixelData = stored.tobytes()
        if syntax:
            image.file_meta.TransferSyntaxUID = pydicom.uid.RLELossless
            image.PixelData = encapsulate([run_lengths(
                *(plane[..., c].tobytes() for c in range(3)))])
            image["PixelData"].is_undefined_length = True
        image["PixelData"].VR = "OB"
    return change


def written(change, axes=AXIAL):
    return write_slices(folder("colours"), numbered(3, 4, 6, numpy.uint8), axes=axes, change=change)


def rgb_at(reader):
    return vtk_to_numpy(output(reader).GetPointData().GetScalars())


def luminance(colours):
    return numpy.rint(colours @ (0.299, 0.587, 0.114))


def grey_affine(axes=AXIAL):
    """Where the same slices lie in grey."""
    path = write_slices(folder("colours-grey"), numbered(3, 4, 6, numpy.uint8), axes=axes)
    return read_again(path)[0]


def assert_colours(change, colours, axes=AXIAL):
    """Three components, or one on request: each voxel has its colour at its place."""
    path = written(change, axes)
    affine = grey_affine(axes)
    reader, told = read(path)
    assert not told, told
    array = output(reader).GetPointData().GetScalars()
    assert array.GetNumberOfComponents() == 3 and array.GetDataTypeAsString() == "unsigned char"
    for channel in range(3):
        shown = rgb_at(reader)[:, channel]
        assert sorted(shown) == sorted(colours[..., channel].ravel())
    grey, told = read(path, Luminance=True)
    assert not told, told
    assert output(grey).GetPointData().GetScalars().GetNumberOfComponents() == 1
    assert_placed(grey, affine, luminance(colours), most=0)
    numpy.testing.assert_array_equal(luminance(rgb_at(reader)), scalars(grey))


def test_colours_are_three_components_or_their_brightness():
    for axes in (AXIAL, OBLIQUE):
        assert_colours(coloured(COLOURS), COLOURS, axes)
    assert_colours(coloured(COLOURS, planar=1), COLOURS)
    assert_colours(coloured(COLOURS, syntax="RLE"), COLOURS)


def test_brightness_and_differences_become_colours():
    ybr = COLOURS.astype(float)
    y, b, r = ybr[..., 0], ybr[..., 1] - 128, ybr[..., 2] - 128
    right = numpy.stack([y + 1.402 * r, y - 0.344136 * b - 0.714136 * r, y + 1.772 * b], axis=-1)
    right = numpy.rint(right.clip(0, 255)).astype(numpy.uint8)
    assert_colours(coloured(COLOURS, "YBR_FULL"), right)


def palette(numbers, entries, bits=16, first=0, stored=8):
    """A change that gives slices a palette. numbers: [slice, row, column]."""
    table = numpy.random.default_rng(9).integers(0, 256, (entries, 3)).astype(numpy.uint8)

    def change(image, index):
        image.PhotometricInterpretation = "PALETTE COLOR"
        image.BitsAllocated = image.BitsStored = stored
        image.HighBit, image.PixelRepresentation = stored - 1, 0
        image.PixelData = numbers[index].astype(f"<u{stored // 8}").tobytes()
        image["PixelData"].VR = "OB" if stored == 8 else "OW"
        for c, name in enumerate(("Red", "Green", "Blue")):
            setattr(image, f"{name}PaletteColorLookupTableDescriptor", [entries, first, bits])
            words = table[:, c].astype("<u2") * (257 if bits == 16 else 1)
            values = words.tobytes() if bits == 16 or entries % 2 else table[:, c].tobytes()
            setattr(image, f"{name}PaletteColorLookupTableData", values)
            image[f"{name}PaletteColorLookupTableData"].VR = "OW"
    return change, table[(numbers.astype(int) - first).clip(0, entries - 1)]


def test_palettes_are_colours():
    numbers = numpy.random.default_rng(7).integers(0, 256, (3, 4, 6))
    for options in ({"entries": 256}, {"entries": 200, "bits": 8}, {"entries": 100, "first": 50},
                    {"entries": 99, "bits": 8}):
        assert_colours(*palette(numbers, **options))
    assert_colours(*palette(numbers * 100, 20000, stored=16))


def test_colours_that_are_not_read_are_named():
    def of(**values):
        def change(image, _):
            image.SamplesPerPixel, image.PhotometricInterpretation = 3, "RGB"
            for name, value in values.items():
                setattr(image, name, value)
        return change

    refused(of(), "has colours of 16 bits in 16 with a sign; BrainShift reads 8 bits in 8")
    refused(of(SamplesPerPixel=4), "has 4 samples per pixel", "RGB and YBR_FULL with 3")
    refused(of(PhotometricInterpretation="YBR_FULL_422"), "'YBR_FULL_422'; BrainShift reads")
    refused(of(SamplesPerPixel=1), "has 1 samples per pixel (SamplesPerPixel) with", "'RGB'")
    refused(of(SamplesPerPixel=1, PhotometricInterpretation="PALETTE COLOR"),
            "has numbers of 16 bits with a sign for a PALETTE COLOR")

    def lost(image, _):
        change, _ = palette(numpy.zeros((4, 5, 6)), 256)
        change(image, 0)
        del image.GreenPaletteColorLookupTableData

    refused(lost, "a palette of 256 colours in 0 bytes")

    def cut(image, _):
        coloured(numpy.zeros((4, 5, 6, 3), numpy.uint8))(image, 0)
        image.PixelData = image.PixelData[:60]

    path = write_slices(folder("cut"), numbered(4, 5, 6, numpy.uint8), change=cut)
    assert_says(read(path)[1], "has 60 bytes of pixel data", "need 90")

    def packed(image, _):
        coloured(numpy.zeros((4, 5, 6, 3), numpy.uint8))(image, 0)
        image.file_meta.TransferSyntaxUID = pydicom.uid.JPEGBaseline8Bit
        image.PixelData = encapsulate([b"\xff\xd8\xff\xd9"])
        image["PixelData"].is_undefined_length = True

    path = write_slices(folder("jpeg"), numbered(4, 5, 6, numpy.uint8), change=packed)
    assert_says(read(path)[1], "has colours packed in a way that BrainShift does not unpack",
                "1.2.840.10008.1.2.4.50", "gdcmconv --raw")


def test_small_numbers_that_are_bright_are_kept_and_said():
    def inverted(image, _):
        image.PhotometricInterpretation = "MONOCHROME1"

    def shaped(image, _):
        image.PresentationLUTShape = "INVERSE"

    for change, word in ((inverted, "MONOCHROME1"), (shaped, "PresentationLUTShape INVERSE")):
        path = write_slices(folder("inverse"), numbered(), change=change)
        reader, told = read(path)
        assert_says(told, "has small numbers that are bright", word, "kept as stored",
                    "invert the colour map")
        assert_placed(reader, *read_again(path), most=0)
        assert output(reader).GetFieldData().GetAbstractArray("SmallIsBright").GetValue(0) == 1

    def one(image, index):
        if index == 3:
            inverted(image, index)

    reader, told = read(write_slices(folder("one-inverse"), numbered(), change=one))
    assert_says(told, "lacks images at other positions", "1 with another PhotometricInterpretation")
    assert output(reader).GetDimensions() == (6, 5, 3)


def parametric(voxels, mappings, floats=False):
    """A parametric map: a mapping for each quantity of `voxels` [quantity, slice, row, column]."""
    whole = voxels if not floats else numpy.zeros(voxels.shape, numpy.uint16)
    image = enhanced(whole, moments=[(1, 0.0)] * len(voxels))
    image.SOPClassUID = image.file_meta.MediaStorageSOPClassUID = PARAMETRIC
    for group, (quantity, _) in zip(image.PerFrameFunctionalGroupsSequence, (
            (t, k) for t in range(len(voxels)) for k in range(len(voxels[t])))):
        group.RealWorldValueMappingSequence = Sequence([mappings[quantity]])
    if floats:
        del image.PixelData
        image.BitsAllocated = 32
        for name in ("BitsStored", "HighBit", "PixelRepresentation"):
            delattr(image, name)
        image.FloatPixelData = voxels.astype("<f4").tobytes()
    return image


def mapping(label, unit, slope, intercept=0.0):
    return item(RealWorldValueSlope=slope, RealWorldValueIntercept=intercept, LUTLabel=label,
                RealWorldValueFirstValueMapped=0, RealWorldValueLastValueMapped=65535,
                MeasurementUnitsCodeSequence=code("UCUM", unit, unit))


def saved(image):
    path = os.path.join(folder("parametric"), "map.dcm")
    image.save_as(path, write_like_original=False)
    return path


def unit_of(reader):
    array = output(reader).GetFieldData().GetAbstractArray("Unit")
    return array.GetValue(0) if array else ""


def test_parametric_maps_are_real_values_with_units():
    voxels = numpy.arange(2 * 3 * 20).reshape(2, 3, 4, 5).astype(numpy.uint16)
    path = saved(parametric(
        voxels, [mapping("ADC", "mm2/s", 1e-6), mapping("FA", "1", 0.01, -2.0)]))
    reader, told = read(path)
    assert not told, told
    series = list(reader.GetProperty("SeriesList"))
    assert len(series) == 2 and series[0].endswith("ADC in mm2/s") and series[1].endswith("FA")
    assert_placed(reader, affine_of(), voxels[0] * 1e-6, most=1e-9)
    assert unit_of(reader) == "mm2/s"
    second, _ = read(path, Series=series[1])
    assert_placed(second, affine_of(), voxels[1] * 0.01 - 2.0)
    assert unit_of(second) == ""

    floats = numpy.random.default_rng(1).normal(size=(1, 3, 4, 5)).astype(numpy.float32)
    reader, told = read(saved(parametric(floats, [mapping("T1", "ms", 1.0)], floats=True)))
    assert not told, told
    assert_placed(reader, affine_of(), floats[0])
    assert unit_of(reader) == "ms"


def test_numbers_in_floating_point_are_rescaled_image_by_image():
    floats = numpy.random.default_rng(1).normal(size=(1, 3, 4, 5)).astype(numpy.float32)
    slopes, intercepts = numpy.array((1.0, 2.0, 0.5)), numpy.array((0.0, 0.0, 7.0))
    for count in (1, 3):  # a rescaling of all frames, one of each
        image = parametric(floats, [mapping("T1", "ms", 2.0, 3.0)], floats=True)
        right = floats[0] * 2.0 + 3.0
        if count == 3:
            for group, slope, intercept in zip(
                    image.PerFrameFunctionalGroupsSequence, slopes, intercepts):
                group.RealWorldValueMappingSequence = Sequence(
                    [mapping("T1", "ms", slope, intercept)])
            right = floats[0] * slopes[:, None, None] + intercepts[:, None, None]
        reader, told = read(saved(image))
        assert not told, told
        assert_placed(reader, affine_of(), right)

    def change(image, index):  # a file for each image
        del image.PixelData
        image.FloatPixelData = floats[0, index].astype("<f4").tobytes()
        image.BitsAllocated = 32
        image.RescaleSlope, image.RescaleIntercept = str(slopes[index]), str(intercepts[index])

    path = write_slices(folder("floats"), numbered(3, 4, 5, numpy.uint32), change=change)
    assert_placed(read(path)[0], affine_of(), right)


def test_of_several_mappings_the_first_counts_with_a_word():
    voxels = numpy.arange(60).reshape(1, 3, 4, 5).astype(numpy.uint16)
    image = parametric(voxels, [mapping("ADC", "mm2/s", 1e-6)])
    for group in image.PerFrameFunctionalGroupsSequence:
        group.RealWorldValueMappingSequence.append(mapping("FA", "1", 0.01))
    reader, told = read(saved(image))
    assert_says(told, "has 2 mappings of real values for a frame", "first counts, ADC in mm2/s")
    assert_placed(reader, affine_of(), voxels[0] * 1e-6, most=1e-9)


def test_a_real_parametric_map_is_read():
    path = data("pydicom-data", "parametric_map_float.dcm")
    reader, told = read(path)
    right = numpy.frombuffer(pydicom.dcmread(path).FloatPixelData, "<f4")
    assert output(reader).GetDimensions() == (128, 128, 1)
    assert numpy.array_equal(numpy.sort(scalars(reader)), numpy.sort(right))
    shutil.copy(path, os.path.join(folder("real-map"), "map.dcm"))
    reader, told = read(os.path.join(scratch("DICOM-real-map"), "map.dcm"))
    [series] = reader.GetProperty("SeriesList")
    assert_says(series, "128 x 128 x 1, 2024-09-16, feature_001")
    assert not told, told


def test_parametric_maps_that_are_not_read_are_named():
    voxels = numpy.zeros((1, 3, 4, 5), numpy.uint16)
    table = mapping("ADC", "mm2/s", 1.0)
    table.RealWorldValueLUTData = [0.0] * 4
    for made, words in ((table, "in a table (RealWorldValueLUTData)"),
                        (mapping("ADC", "mm2/s", 0.0), "both must be numbers, and the slope not 0"),
                        (mapping("ADC", "mm2/s", numpy.inf), "both must be numbers")):
        reader, told = read(saved(parametric(voxels, [made])))
        assert_says(told, words)
        assert output(reader).GetNumberOfPoints() == 0


run_tests(globals())
