# SPDX-License-Identifier: BSD-3-Clause
# Proves that a DICOM series lies where an independent reading of its headers says, to 1e-3 mm at
# its corners, with the numbers of its files; and that uneven, missing, duplicate and tilted slices
# are told with their size in mm.
import os
import shutil

import numpy
import pydicom
from brainshift_testing import assert_says, load_plugin, messages, output, run_tests
from dicom_testing import (AXIAL, CORONAL, OBLIQUE, SAGITTAL, assert_placed, folder, numbered,
                           places, read, read_again, scalars, write_slices)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()


def assert_right(path, **properties):
    """The series lies as pydicom reads it, without a word."""
    reader, told = read(path, **properties)
    assert not told, told
    assert_placed(reader, *read_again(path))
    return reader


def test_unequal_pixels_and_gaps_between_slices():
    path = write_slices(folder("axial"), numbered())
    reader = assert_right(path)
    assert output(reader).GetSpacing() == (0.7, 0.9, 2.5)
    assert output(reader).GetDirectionMatrix().IsIdentity()
    assert scalars(reader).dtype == numpy.int16


def test_any_orientation_in_any_order():
    for name, axes in (("coronal", CORONAL), ("sagittal", SAGITTAL), ("oblique", OBLIQUE)):
        for step in (2.5, -2.5):
            path = write_slices(folder(name), numbered(), axes=axes, step=step)
            assert_right(path)


def test_a_part_reads_its_slices_alone():
    """MPI ranks read so: the files of other slices are gone."""
    slices = numbered(9)
    for step in (2.5, -2.5):
        path = write_slices(folder("part"), slices, step=step)
        reader, _ = read(path)
        whole = scalars(reader).reshape(slices.shape)
        part = type(reader)(FileName=path).GetClientSideObject()
        part.UpdateInformation()
        kept = set(whole[2:5, 0, 0] // slices[0].size)
        for index in set(range(9)) - kept:
            os.remove(os.path.join(path, f"IM{index + 1:04}.dcm"))
        part.UpdateExtent([1, 4, 0, 4, 2, 4])
        image = part.GetOutputDataObject(0)
        assert image.GetExtent() == (1, 4, 0, 4, 2, 4), image.GetExtent()
        numbers = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(3, 5, 4)
        assert (numbers == whole[2:5, :, 1:5]).all(), step


def test_file_names_and_numbers_do_not_count():
    path = write_slices(folder("mixed"), numbered(6), positions=(3, 0, 5, 1, 4, 2))
    assert_right(path)


def assert_right_file(path):
    reader, told = read(path)
    assert not told, told
    assert_placed(reader, *read_again(os.path.dirname(path)))


def test_any_slice_opens_its_series():
    path = write_slices(folder("slice"), numbered())
    assert_right_file(os.path.join(path, "IM0003.dcm"))


def test_a_single_slice_is_a_volume():
    path = write_slices(folder("single"), numbered(1))
    reader, told = read(path)
    assert not told, told
    affine, voxels = read_again(path)
    affine[2, 2] = 99.0  # only its thickness says how far it reaches
    assert_placed(reader, affine, voxels)


def test_all_types_of_numbers():
    implicit, explicit = "1.2.840.10008.1.2", "1.2.840.10008.1.2.1"
    deflated = "1.2.840.10008.1.2.1.99"
    big_endian = "1.2.840.10008.1.2.2"  # the standard leaves open how it orders words of 32 bits
    for dtype in (numpy.uint8, numpy.int8, numpy.uint16, numpy.int16, numpy.uint32, numpy.int32):
        wide = numpy.dtype(dtype).itemsize == 4
        for syntax in (implicit, explicit, deflated) + (() if wide else (big_endian,)):
            start = -7 if numpy.dtype(dtype).kind == "i" else 0
            voxels = numbered(3, 4, 5, dtype, start)
            path = write_slices(folder("types"), voxels, syntax=pydicom.uid.UID(syntax))
            reader, told = read(path)
            assert not told, (dtype, syntax, told)
            assert scalars(reader).dtype == dtype, (dtype, syntax, scalars(reader).dtype)
            assert_placed(reader, read_again(path)[0], voxels)


def test_pixels_in_floating_point_are_exact():
    for name, kind in (("FloatPixelData", "<f4"), ("DoubleFloatPixelData", "<f8")):
        voxels = (numbered(3) / 7.0).astype(kind)

        def real(image, index, name=name, voxels=voxels):
            setattr(image, name, voxels[index].tobytes())
            image.BitsAllocated = 8 * voxels.dtype.itemsize
            for whole in ("PixelData", "BitsStored", "HighBit", "PixelRepresentation"):
                delattr(image, whole)

        for syntax in ("1.2.840.10008.1.2", "1.2.840.10008.1.2.1", "1.2.840.10008.1.2.1.99"):
            path = write_slices(folder("real"), numbered(3), change=real,
                                syntax=pydicom.uid.UID(syntax))
            reader, told = read(path)
            assert not told, told
            assert scalars(reader).dtype == voxels.dtype.newbyteorder("="), scalars(reader).dtype
            shown = scalars(reader).reshape(3, 5, 6)[:, ::-1, ::-1]
            numpy.testing.assert_array_equal(shown, voxels)


def test_twelve_bits_have_their_own_sign_and_no_neighbours():
    def pack(image, _):
        image.BitsStored, image.HighBit = 12, 11
        stored = numpy.frombuffer(image.PixelData, numpy.uint16)
        image.PixelData = ((stored & 0x0fff) | 0x5000).tobytes()  # drawings in the upper bits

    voxels = numbered(start=-60)
    for syntax in ("1.2.840.10008.1.2.1", "1.2.840.10008.1.2.1.99"):  # read here, and by GDCM
        path = write_slices(folder("bits"), voxels, change=pack, syntax=pydicom.uid.UID(syntax))
        reader, told = read(path)
        assert not told, told
        assert_placed(reader, read_again(path)[0], voxels)


def test_rescaling_of_all_and_of_each_slice():
    def same(image, _):
        image.RescaleSlope, image.RescaleIntercept = "0.5", "-1024"

    def other(image, index):
        image.RescaleSlope, image.RescaleIntercept = str(0.5 + index), str(-index)

    for change in (same, other):
        reader = assert_right(write_slices(folder("rescaled"), numbered(), change=change))
        assert scalars(reader).dtype == numpy.float32


def test_uneven_slices_are_told_and_resampled_on_request():
    voxels = numbered(5).astype(numpy.int16)
    voxels[:] = numpy.array([0, 10, 20, 34, 40], numpy.int16)[:, None, None]
    path = write_slices(folder("uneven"), voxels, positions=(0, 1, 2, 3.4, 4))
    reader, told = read(path)
    assert_says(told, "uneven slices", "from 1.5 to 3.5 mm", "up to 1 mm",
                # 0.4 of a slice: less than half a voxel
                "as if they were even; Resample Slices \"Always\"")
    assert "missing" not in told, told
    reader, told = read(path, ResampleSlices=1)
    assert_says(told, "interpolated there")
    heights = places(output(reader))[:, 2] - 33.0
    assert numpy.abs(scalars(reader) - heights * 4.0).max() < 0.51  # 10 for each 2.5 mm, rounded


def test_missing_slices_are_counted():
    path = write_slices(folder("missing"), numbered(5), positions=(0, 1, 2, 5, 6))
    reader, told = read(path, ResampleSlices=0)
    assert_says(told, "as if 2 slices were missing", "from 2.5 to 7.5 mm", "up to 2.5 mm")
    assert output(reader).GetDimensions() == (6, 5, 5)
    reader, told = read(path)  # a whole slice: interpolated by default
    assert_says(told, "interpolated there; Resample Slices \"Never\"")
    assert output(reader).GetDimensions() == (6, 5, 7)
    affine, voxels = read_again(path)
    affine[2, 2] = 2.5
    middle = [voxels[2] + (voxels[3] - voxels[2]) * share for share in (1 / 3, 2 / 3)]
    assert_placed(reader, affine, numpy.rint(numpy.stack([*voxels[:3], *middle, *voxels[3:]])))


def test_duplicates_are_told_and_left_out():
    path = write_slices(folder("duplicates"), numbered())
    shutil.copy(os.path.join(path, "IM0002.dcm"), os.path.join(path, "copy.dcm"))
    right = read_again(write_slices(folder("unique"), numbered()))
    reader, told = read(path)
    assert_says(told, "1 duplicate image, which is left out")
    assert_placed(reader, *right)
    other = pydicom.dcmread(os.path.join(path, "copy.dcm"))
    other.SOPInstanceUID = other.file_meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid()
    other.InstanceNumber = 77  # another image of the same place
    other.save_as(os.path.join(path, "copy.dcm"))
    reader, told = read(path)
    assert_says(told, "1 image at positions of other images")
    assert_placed(reader, *right)


def test_a_tilted_gantry_is_told_with_its_error():
    tilt = numpy.array((0.0, 0.5, 2.0))  # slices drift by 0.5 mm
    path = write_slices(folder("tilt"), numbered(40), axes=AXIAL, step=tilt)
    reader, told = read(path, ResampleSlices=0)
    affine, voxels = read_again(path)
    assert_says(told, "is sheared", "mm from where it places them", "the last is 19.5 mm beside",
                "Resample Slices")
    shown = places(output(reader))
    centre = affine @ [2.5, 2.0, 19.5, 1.0]
    numpy.testing.assert_allclose(shown.mean(axis=0), centre[:3], atol=1e-3)
    farthest = float(told.split("shown up to ")[1].split(" mm")[0])
    assert 1.0 < farthest < 10.0, farthest


def test_a_tilted_gantry_is_where_it_was_by_default():
    """18.5 degrees and gaps of 1.1 to 7 mm: each voxel lies within half a voxel of its place."""
    angle = numpy.radians(18.5)
    heights = numpy.cumsum([0.0] + 12 * [1.1] + 10 * [7.0] + [2.3])
    steps = numpy.array((0.0, numpy.tan(angle), 1.0))
    z, y, x = numpy.meshgrid(heights, numpy.arange(40), numpy.arange(6), indexing="ij")
    slope = numpy.array((3.0, 20.0, 40.0))  # of a number that grows along a line in the world
    first = numpy.array((-11.0, 22.0, 33.0))
    lps = numpy.stack([x * 0.7, y * 0.9 + z * steps[1], z], axis=-1) + first
    numbers = numpy.rint((lps * (-1.0, -1.0, 1.0)) @ slope).astype(numpy.int16)
    path = write_slices(folder("gantry"), numbers, axes=AXIAL, step=steps, positions=heights)
    reader, told = read(path)
    assert_says(told, "interpolated on an upright grid", "Resample Slices \"Never\"")
    shown = places(output(reader))
    away = shown * (-1.0, -1.0, 1.0) - first
    row = (away[:, 1] - away[:, 2] * steps[1]) / 0.9
    inside = (row > 3.0) & (row < 36.0)  # in both slices that are interpolated
    assert inside.sum() > 0.6 * numbers.size, (inside.sum(), numbers.size)
    error = numpy.abs(scalars(reader) - shown @ slope)[inside]
    assert error.max() <= 1.01, error.max()  # 0.05 mm; rounded twice
    spacing = output(reader).GetSpacing()
    assert spacing[2] < 1.2, spacing  # fine slices stay fine


def test_a_little_tilt_stays_as_it_is_stored():
    path = write_slices(folder("little"), numbered(10), axes=AXIAL,
                        step=numpy.array((0.0, 0.05, 2.0)))
    reader, told = read(path)
    assert_says(told, "has tilted slices", "Resample Slices \"Always\"")
    assert output(reader).GetDimensions() == (6, 5, 10)


def test_a_tilted_gantry_becomes_upright_on_request():
    tilt = numpy.array((-0.35, 0.5, 2.0))
    voxels = numbered(12, 15, 16)
    path = write_slices(folder("upright"), voxels, axes=AXIAL, step=tilt)
    affine = read_again(path)[0]
    z, y, x = numpy.meshgrid(*(numpy.arange(side) for side in voxels.shape), indexing="ij")
    world = numpy.einsum("ij,j...->i...", affine, numpy.stack([x, y, z, numpy.ones_like(x)]))[:3]
    slope = numpy.array((50.0, -30.0, 70.0))  # of a number that grows along a line in the world
    voxels = numpy.rint(numpy.einsum("i,i...->...", slope, world)).astype(numpy.int16)
    write_slices(path, voxels, axes=AXIAL, step=tilt)
    reader, _ = read(path, ResampleSlices=0)
    with messages() as told:
        reader.ResampleSlices = 1
        reader.UpdatePipeline()
    assert_says(told.text, "They are interpolated on an upright grid")
    assert "sheared" not in told.text, told.text
    image = output(reader)
    assert image.GetDimensions() == (16 + 6, 15 + 7, 12), image.GetDimensions()
    shown = places(image)
    index = numpy.linalg.solve(affine, numpy.c_[shown, numpy.ones(len(shown))].T)[:3]
    inside = numpy.all((index > -1e-6) & (index.T < (15 + 1e-6, 14 + 1e-6, 11 + 1e-6)).T, axis=0)
    assert inside.sum() > 0.8 * voxels.size, inside.sum()
    error = numpy.abs(scalars(reader) - shown @ slope)
    assert error[inside].max() <= 1.01, error[inside].max()  # rounded twice
    assert scalars(reader)[~inside].min() == voxels.min()


def test_images_without_places_are_told():
    def strip(image, _):
        del image.ImagePositionPatient, image.ImageOrientationPatient
        image.SpacingBetweenSlices = "4"

    path = write_slices(folder("scanned"), numbered(), change=strip)
    reader, told = read(path)
    assert_says(told, "has no positions of its images")
    assert output(reader).GetSpacing() == (0.7, 0.9, 4.0)
    assert output(reader).GetFieldData().GetAbstractArray("WorldAxes") is None
    numpy.testing.assert_array_equal(scalars(reader), numbered().ravel())


def test_the_sides_of_the_patient_are_known():
    reader = assert_right(write_slices(folder("sides"), numbered()))
    assert output(reader).GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"


run_tests(globals())
