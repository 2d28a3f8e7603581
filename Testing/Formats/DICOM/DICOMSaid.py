# SPDX-License-Identifier: BSD-3-Clause
# Proves that slices of nuclear medicine lie where SliceVector and the sign of their spacing put
# them, and that what contradicts itself, is missing or is no number in a DICOM header is said or
# refused by name.
import os

import numpy
import pydicom
from brainshift_testing import assert_says, load_plugin, output, run_tests
from dicom_testing import (AXIAL, CORONAL, affine_of, assert_placed, enhanced, folder, numbered,
                           plain_header, read, read_again, scalars, set_pixels, write_slices)
from pydicom.sequence import Sequence

load_plugin()


def nuclear(step, order=None, axes=AXIAL, placed=True):
    """A multi-frame file of nuclear medicine, whose frames are slices in this order; its voxels."""
    image = plain_header("1.2.840.10008.5.1.4.1.1.20")
    voxels = numbered(4)
    set_pixels(image, voxels)
    image.Modality, image.NumberOfFrames = "NM", 4
    image.PixelSpacing, image.SpacingBetweenSlices = [2, 2], str(step)
    image.FrameIncrementPointer = 0x00540080
    if order:
        image.SliceVector = order
    if placed:
        detector = pydicom.Dataset()
        detector.ImagePositionPatient = [-11, 22, 33]
        detector.ImageOrientationPatient = [number for axis in axes for number in axis]
        image.DetectorInformationSequence = Sequence([detector])
    path = os.path.join(folder("nuclear"), "a.dcm")
    image.save_as(path, write_like_original=False)
    return path, voxels


def test_the_sign_of_the_spacing_says_where_slices_go():
    for axes in (AXIAL, CORONAL):
        for step in (3.0, -3.0):
            path, voxels = nuclear(step, axes=axes)
            reader, told = read(path)
            assert not told, told
            assert_placed(reader, affine_of(axes, (2.0, 2.0), step), voxels)


def test_slice_vectors_say_which_slice_a_frame_is():
    for order, step in (([1, 3, 2, 4], 3.0), ([1, 4, 3, 2], -3.0)):
        path, voxels = nuclear(step, order)
        reader, told = read(path)
        assert not told, told
        sorted_voxels = voxels[numpy.argsort(order)]
        assert_placed(reader, affine_of(AXIAL, (2.0, 2.0), step), sorted_voxels)
        path, voxels = nuclear(step, order, placed=False)
        reader, told = read(path)
        assert_says(told, "has no positions of its images")
        shown = scalars(reader).reshape(4, 5, 6)
        numpy.testing.assert_array_equal(shown if step > 0 else shown[::-1], sorted_voxels)
    path, voxels = nuclear(3.0, [4, 3, 2, 1])
    reader, told = read(path)
    assert_says(told, "has slice 4 as its first frame (SliceVector)")
    assert_placed(reader, affine_of(AXIAL, (2.0, 2.0), -3.0), voxels)
    for order in ([1, 2, 2, 3], [1, 2, 3]):
        reader, told = read(nuclear(3.0, order)[0])
        assert_says(told, "has a SliceVector of", "another number for each frame")
        assert output(reader).GetNumberOfPoints() == 0
    path, _ = nuclear(3.0)
    image = pydicom.dcmread(path)
    image.FrameIncrementPointer, image.EnergyWindowVector = 0x00540010, [1, 1, 1, 1]
    image.save_as(path, write_like_original=False)
    _, told = read(path)
    assert_says(told, "count something other than slices", "EnergyWindowVector")
    reader, told = read(nuclear(0.0)[0])
    assert_says(told, "no SpacingBetweenSlices other than 0")


def test_a_number_that_is_none_is_refused_by_name():
    for name, value in (("ImagePositionPatient", "1\\2\\x"), ("ImagePositionPatient", "1\\2"),
                        ("ImageOrientationPatient", "1\\0\\0\\0\\1\\,0"), ("PixelSpacing", "1"),
                        ("PixelSpacing", "-1\\1"), ("PixelSpacing", "0\\0"),
                        ("PixelSpacing", "1,5\\1,5"), ("RescaleSlope", "two"),
                        ("RescaleIntercept", "1;5"), ("DoseGridScaling", "x"),
                        ("NumberOfFrames", "x")):
        def change(image, _, name=name, value=value):
            tag = pydicom.datadict.tag_for_keyword(name)
            image[tag] = pydicom.dataelem.DataElement(tag, "LO", value)  # not checked
        reader, told = read(write_slices(folder("no-number"), numbered(), change=change))
        assert_says(told, name)
        assert output(reader).GetNumberOfPoints() == 0, (name, value)


def test_an_attribute_that_occurs_twice_is_refused():
    path = write_slices(folder("twice"), numbered(1))
    name = os.path.join(path, "IM0001.dcm")
    with open(name, "rb") as file:
        whole = file.read()
    begin = whole.index(b"\x28\x00\x30\x00DS")
    end = begin + 8 + whole[begin + 6]
    element = whole[begin:end]
    for value, words in ((element, ""), (element.replace(b"0.9", b"0.8"), "(0028,0030) twice")):
        with open(name, "wb") as file:
            file.write(whole[:end] + value + whole[end:])
        reader, told = read(path)
        assert_says(told, words)
        assert (output(reader).GetNumberOfPoints() == 0) == bool(words), told


def test_pixels_of_a_byte_in_words_with_the_high_byte_first():
    """Two pixels are one word, whose low byte is the first of them (PS3.5, 8.1.1)."""
    for shape in ((4, 5, 6), (4, 5, 3)):  # the last one: frames of an odd number of bytes
        voxels = numbered(*shape, dtype=numpy.uint8)

        def words(image, index, voxels=voxels):
            pixels = voxels[index].tobytes()
            pixels += b"\0" * (len(pixels) % 2)
            image.PixelData = numpy.frombuffer(pixels, "<u2").astype(">u2").tobytes()
            image["PixelData"].VR = "OW"

        path = write_slices(folder("words"), voxels, change=words,
                            syntax=pydicom.uid.ExplicitVRBigEndian)
        reader, told = read(path)
        assert not told, told
        shown = scalars(reader).reshape(shape)[:, ::-1, ::-1]  # to the right and to the front
        numpy.testing.assert_array_equal(shown, voxels)
    several = nuclear_of_bytes()
    reader, told = read(several)
    assert not told, told
    shown = scalars(reader).reshape(4, 5, 3)[:, ::-1, ::-1]
    numpy.testing.assert_array_equal(shown, numbered(4, 5, 3, numpy.uint8))


def nuclear_of_bytes():
    """Frames of 15 bytes: the second one begins inside a word."""
    image = plain_header("1.2.840.10008.5.1.4.1.1.20", pydicom.uid.ExplicitVRBigEndian)
    voxels = numbered(4, 5, 3, numpy.uint8)
    set_pixels(image, voxels)
    image.PixelData = numpy.frombuffer(voxels.tobytes(), "<u2").astype(">u2").tobytes()
    image["PixelData"].VR = "OW"
    image.Modality, image.NumberOfFrames = "NM", 4
    image.PixelSpacing, image.SpacingBetweenSlices = [2, 2], "3"
    image.FrameIncrementPointer, image.SliceVector = 0x00540080, [1, 2, 3, 4]
    image.ImagePositionPatient = [-11, 22, 33]
    image.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    path = os.path.join(folder("nuclear-bytes"), "a.dcm")
    image.save_as(path, write_like_original=False)
    return path


def test_a_time_that_is_none_is_said():
    for name, count in (("TriggerTime", "0"), ("RepetitionTime", "0"), ("EchoTime", "0"),
                        ("TemporalPositionIdentifier", "0"), ("InstanceNumber", "0")):
        def change(image, _, name=name):
            tag = pydicom.datadict.tag_for_keyword(name)
            image[tag] = pydicom.dataelem.DataElement(tag, "LO", "later")

        reader, told = read(write_slices(folder("no-time"), numbered(), change=change))
        assert_says(told, f"has the {name} 'later'", f"It counts as {count}")
        assert output(reader).GetDimensions() == (6, 5, 4)


def test_missing_distances_are_said():
    def unmeasured(image, _):
        del image.PixelSpacing

    def imager(image, _):
        unmeasured(image, _)
        image.ImagerPixelSpacing = [2, 3]

    def ratio(image, _):
        unmeasured(image, _)
        image.PixelAspectRatio = [3, 2]

    for change, words, spacing in (
            (unmeasured, "columns count as 1 mm apart, rows as well", (1, 1)),
            (imager, "on the detector (ImagerPixelSpacing)", (3, 2)),
            (ratio, "rows by its PixelAspectRatio", (1, 1.5))):
        reader, told = read(write_slices(folder("unmeasured"), numbered(), change=change))
        assert_says(told, "has no PixelSpacing", words)
        numpy.testing.assert_allclose(output(reader).GetSpacing()[:2], spacing)

    def thin(image, _):
        del image.SliceThickness

    _, told = read(write_slices(folder("thin"), numbered(1), change=thin))
    assert_says(told, "one slice without a SliceThickness; it counts as 1 mm thick")


def test_images_that_are_left_out_are_counted():
    def spoiled(image, index):
        if index == 3:
            image.PhotometricInterpretation = "CMYK"

    reader, told = read(write_slices(folder("left-out"), numbered(), change=spoiled))
    assert_says(told, "has images that cannot be read and are left out: 1", "'CMYK'")
    assert output(reader).GetDimensions() == (6, 5, 3)

    def lost(image, index):
        if index == 3:
            del image.ImagePositionPatient

    reader, told = read(write_slices(folder("lost"), numbered(), change=lost))
    assert_says(told, "has images without a position (ImagePositionPatient", ": 1")
    assert output(reader).GetDimensions() == (6, 5, 3)


def test_a_meta_group_without_a_transfer_syntax_is_damaged():
    """Its elements would be read in an order of bytes that is guessed."""
    path = write_slices(folder("no-syntax"), numbered())
    name = os.path.join(path, "IM0004.dcm")
    with open(name, "rb") as file:
        whole = file.read()
    with open(name, "wb") as file:
        file.write(whole.replace(b"\x02\x00\x10\x00UI", b"\x02\x00\x11\x00UI", 1))
    reader, told = read(path)
    assert_says(told, "has files that are damaged and left out: 1")
    assert output(reader).GetDimensions() == (6, 5, 3)
    _, told = read(name)
    assert_says(told, "is a DICOM file whose header is damaged")


def test_one_uid_at_several_positions_is_several_images():
    def same(image, _):
        image.SOPInstanceUID = "1.2.3"

    path = write_slices(folder("same-uid"), numbered(), change=same)
    reader, told = read(path)
    assert_says(told, "has the same SOPInstanceUID in images at different positions")
    assert_placed(reader, *read_again(path))


def test_positions_that_contradict_slice_locations_are_said():
    def change(image, index):
        image.ImagePositionPatient = [-11, 22, 33]
        image.SliceLocation = str(2.5 * index)

    _, told = read(write_slices(folder("one-position"), numbered(), change=change))
    assert_says(told, "has images at one position (ImagePositionPatient) whose SliceLocation "
                "differs by 7.5 mm")


def test_echoes_are_sorted_by_their_times():
    """Of two echoes without a number, in the wrong order of numbers at every other position."""
    path = folder("echoes")
    voxels = numbered(8).reshape(2, 4, 5, 6)

    for t in range(2):
        def change(image, index, t=t):
            image.EchoTime = "20" if t else "10"
            image.InstanceNumber = 10 * index + (t if index % 2 else 1 - t)
        write_slices(path, voxels[t], change=change, start=1 + 100 * t)
    reader, told = read(path)
    assert not told, told
    assert list(reader.TimestepValues) == [0.0, 1.0]
    for t in range(2):
        reader.UpdatePipeline(float(t))
        image = reader.GetClientSideObject().GetOutputDataObject(0)
        assert image.GetPointData().GetScalars().GetRange() == (voxels[t].min(), voxels[t].max())


def test_groups_that_disagree_are_said():
    image = enhanced(numbered(3)[None])
    measures = pydicom.Dataset()
    measures.PixelSpacing = [5, 6]
    for group in image.PerFrameFunctionalGroupsSequence:
        group.PixelMeasuresSequence = Sequence([measures])
    path = os.path.join(folder("groups"), "a.dcm")
    image.save_as(path, write_like_original=False)
    reader, told = read(path)
    assert_says(told, "has a PixelMeasuresSequence for all frames and another one for single")
    assert output(reader).GetSpacing()[:2] == (6.0, 5.0)


def test_real_values_and_axes_of_animals_are_said():
    def change(image, _):
        mapping, unit = pydicom.Dataset(), pydicom.Dataset()
        unit.CodeValue = "mm2/s"
        mapping.RealWorldValueSlope, mapping.RealWorldValueIntercept = 0.5, -3.0
        mapping.MeasurementUnitsCodeSequence = Sequence([unit])
        image.RealWorldValueMappingSequence = Sequence([mapping])
        image.AnatomicalOrientationType = "QUADRUPED"

    _, told = read(write_slices(folder("real-values"), numbered(), change=change))
    assert_says(told, "has real values of 0.5 times the stored ones plus -3 mm2/s",
                "AnatomicalOrientationType QUADRUPED")


run_tests(globals())
