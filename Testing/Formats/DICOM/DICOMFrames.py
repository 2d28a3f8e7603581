# SPDX-License-Identifier: BSD-3-Clause
# Proves that multi-frame files and packed files are read as pydicom and numpy read them, that a
# real one lies where dcm2niix says, and that damaged packed files end in a sentence.
import os
import subprocess

import nibabel
import numpy
import pydicom
from brainshift_testing import assert_says, data, load_plugin, output, run_tests
from dicom_testing import (CORONAL, OBLIQUE, affine_of, assert_placed, enhanced, folder, numbered,
                           plain_header, read, read_again, scalars, set_pixels, write_slices)
from pydicom.sequence import Sequence
from real_dicom import differences

load_plugin()


def written(name, image):
    path = os.path.join(folder(name), "frames.dcm")
    image.save_as(path, write_like_original=False)
    return path


def test_frames_lie_where_their_groups_say():
    voxels = numbered(7)
    order = [3, 0, 6, 1, 5, 2, 4]
    for axes in (CORONAL, OBLIQUE):
        path = written("frames", enhanced(voxels[None], axes=axes, order=order))
        reader, told = read(path)
        assert not told, told
        assert_placed(reader, affine_of(axes), voxels)


def test_times_of_frames_become_time_steps():
    voxels = numbered(12).reshape(3, 4, 5, 6)
    order = numpy.random.default_rng(4).permutation(12)
    path = written("frame-times", enhanced(
        voxels, moments=((3, 0.8), (1, 0.0), (2, 0.25)), order=order))
    reader, told = read(path)
    assert not told, told
    numpy.testing.assert_allclose(reader.TimestepValues, (0.0, 0.25, 0.8), atol=1e-6)
    for time, right in ((0.0, voxels[1]), (0.25, voxels[2]), (0.8, voxels[0])):
        reader.UpdatePipeline(time)
        shown = reader.GetClientSideObject().GetOutputDataObject(0).GetPointData().GetScalars()
        read_now = [shown.GetTuple1(i) for i in range(shown.GetNumberOfTuples())]
        numpy.testing.assert_array_equal(numpy.sort(read_now), right.ravel())


def test_a_time_of_a_frame_that_is_none_is_said():
    for name, value in (("FrameAcquisitionDateTime", "2024xx"),
                        ("FrameReferenceDateTime", "20240229251010")):
        image = enhanced(numbered()[None])
        for i, groups in enumerate(image.PerFrameFunctionalGroupsSequence):
            content = groups.FrameContentSequence[0]
            for other in ("FrameAcquisitionDateTime", "FrameReferenceDateTime"):
                if other in content:
                    delattr(content, other)
            setattr(content, name, value + str(i % 2))
        told = read(written("no_time.dcm", image))[1]
        assert_says(told, f"has the {name} {value}0, which is no time. It does not count")
        assert told.count("which is no time") == 1, told


def test_each_frame_has_its_rescaling():
    voxels = numbered(4)
    path = written("frame-scales", enhanced(
        voxels[None], axes=OBLIQUE, rescale=lambda t, k: (str(1.5 + k), str(-10 * k))))
    reader, told = read(path)
    assert not told, told
    assert scalars(reader).dtype == numpy.float32
    right = numpy.stack([plane * (1.5 + k) - 10.0 * k for k, plane in enumerate(voxels)])
    assert_placed(reader, affine_of(OBLIQUE), right)


def test_frames_that_are_not_described_are_refused():
    image = enhanced(numbered(4)[None])
    image.NumberOfFrames = 5
    reader, told = read(written("frame-count", image))
    assert_says(told, "announces 5 frames (NumberOfFrames) and describes 4")


def scintigram(name, start, change=lambda image: None, placed=False):
    """An old multi-frame file: frames without positions of their own, one slice each."""
    image = plain_header("1.2.840.10008.5.1.4.1.1.20")
    image.Modality = "NM"
    voxels = numbered(4, start=start)
    set_pixels(image, voxels)
    image.NumberOfFrames = 4
    image.PixelSpacing, image.SpacingBetweenSlices = [2, 2], "3"
    image.FrameIncrementPointer = 0x00540080
    if placed:
        detector = pydicom.Dataset()
        detector.ImagePositionPatient = [-11, 22, 33]
        detector.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
        image.DetectorInformationSequence = Sequence([detector])
    change(image)
    image.save_as(name, write_like_original=False)
    return voxels


def test_frames_without_positions_are_no_stack_of_two_files():
    for placed in (False, True):
        path = folder("nuclear")
        first, second = (os.path.join(path, name) for name in ("a.dcm", "b.dcm"))
        one, two = scintigram(first, 0, placed=placed), scintigram(second, 1000, placed=placed)
        for name, right in ((first, one), (second, two)):
            reader, _ = read(name)
            assert output(reader).GetDimensions() == (6, 5, 4), output(reader).GetDimensions()
            numpy.testing.assert_array_equal(numpy.sort(scalars(reader)), right.ravel())
            assert len(reader.TimestepValues or []) == 0
        assert len(reader.GetProperty("SeriesList")) == 2
        if placed:
            assert output(reader).GetSpacing() == (2.0, 2.0, 3.0)
            low = numpy.reshape(output(reader).GetBounds(), (3, 2))[2]
            numpy.testing.assert_allclose(low, (33.0, 42.0))


def test_frames_that_are_no_slices_are_refused_by_name():
    def rotations(image):
        image.FrameIncrementPointer = [0x00540010, 0x00540090]

    name = os.path.join(folder("rotations"), "a.dcm")
    scintigram(name, 0, rotations)
    reader, told = read(name)
    assert_says(told, "count something other than slices",
                "FrameIncrementPointer: EnergyWindowVector")
    assert output(reader).GetNumberOfPoints() == 0


PACKINGS = (("--rle",), ("--jpegls",), ("--j2k",), ("--jpeg",), ("--deflated",))


def packed(path, options):
    to = folder("packed")
    for name in os.listdir(path):
        made = subprocess.run(
            ["gdcmconv", *options, os.path.join(path, name), os.path.join(to, name)],
            capture_output=True, text=True)
        assert made.returncode == 0, (options, made.stderr)
    return to


def test_packed_slices_and_frames_are_those_that_were_packed():
    def twelve(image, _):
        image.BitsStored, image.HighBit = 12, 11

    for options in PACKINGS:
        for dtype, change in ((numpy.uint8, None), (numpy.uint16, twelve), (numpy.int16, None)):
            voxels = numbered(3, 36, 40, numpy.int64) % (200 if dtype == numpy.uint8 else 4000)
            voxels = (voxels - (50 if dtype == numpy.int16 else 0)).astype(dtype)
            path = write_slices(folder("plain"), voxels, axes=OBLIQUE, change=change)
            right = read_again(path)[0]
            reader, told = read(packed(path, options))
            assert not told, (options, dtype, told)
            assert scalars(reader).dtype == dtype, (options, dtype)
            assert_placed(reader, right, voxels)
    frames = numbered(4, 36, 40)
    path = written("plain-frames", enhanced(frames[None], axes=OBLIQUE))
    for options in PACKINGS:
        reader, told = read(packed(os.path.dirname(path), options))
        assert not told, (options, told)
        assert_placed(reader, affine_of(OBLIQUE), frames)


def test_damaged_packed_slices_end_in_a_sentence():
    path = write_slices(folder("to-damage"), numbered(3, 40, 40))
    for options in PACKINGS[:4]:
        to = packed(path, options)
        name = os.path.join(to, "IM0002.dcm")
        whole = open(name, "rb").read()
        for keep in (len(whole) // 2 + 400, len(whole) - 60):
            with open(name, "wb") as file:
                file.write(whole[:keep])
            reader, told = read(to)
            if output(reader).GetNumberOfPoints() > 0:  # a codec that ends without its last bytes
                assert scalars(reader).size == 3 * 40 * 40
            else:
                assert_says(told, "IM0002.dcm")


def test_a_real_file_lies_where_another_program_says():
    path = data("dcm-qa-enh", "IM_0027_fMAP.dcm")
    reader, told = read(path)
    assert not told, told
    names = list(reader.GetProperty("SeriesList"))
    assert len(names) == 2, names
    for part, file in (("MAGNITUDE", "magnitude.nii.gz"), ("REAL", "field_map.nii.gz")):
        reader.Series = next(name for name in names if part in name)
        farthest, factor, left = differences(reader, nibabel.load(data("dcm-qa-enh", file)))
        assert farthest < 1e-3, (part, farthest)
        assert left < 1e-4, (part, left)
        assert part == "MAGNITUDE" or abs(factor - 1.0) < 1e-4, factor


run_tests(globals())
