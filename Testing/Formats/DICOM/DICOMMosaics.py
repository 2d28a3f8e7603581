# SPDX-License-Identifier: BSD-3-Clause
# Proves that the tiles of Siemens' mosaics become slices where dcm2niix puts them, with its
# numbers, from feet to head and from head to feet, packed and not; and that a mosaic without what
# its slices need is refused with a sentence.
import glob
import os
import shutil
import struct

import nibabel
import numpy
import pydicom
from brainshift_testing import assert_says, data, load_plugin, output, run_tests
from dicom_testing import AXIAL, OBLIQUE, assert_placed, folder, read, scalars, write_slices

load_plugin()

SIEMENS = "SIEMENS CSA HEADER"
TILE = (4, 5)  # rows, columns


def siemens_header(**fields):
    """Siemens' own header (SV10) of fields with numbers, which are texts behind a name."""
    header = b"SV10\4\3\2\1" + struct.pack("<2I", len(fields), 77)
    for name, numbers in fields.items():
        header += (name.encode().ljust(64, b"\0")
                   + struct.pack("<i4s3i", len(numbers), b"FD", 4, 6, 77))
        for item in range(6):  # as many as scanners write; those behind the last one are empty
            text = f"{numbers[item]:.8f}".encode() + b"\0" if item < len(numbers) else b""
            header += struct.pack("<4i", *[len(text)] * 4)
            header += text.ljust(-(-len(text) // 4) * 4, b"\0")
    return header


def tiles_of(slices):
    """A picture whose tiles are slices [slice, row, column]."""
    along = int(numpy.ceil(numpy.sqrt(len(slices))))
    picture = numpy.zeros((along * TILE[0], along * TILE[1]), slices.dtype)
    for i, tile in enumerate(slices):
        row, column = TILE[0] * (i // along), TILE[1] * (i % along)
        picture[row:row + TILE[0], column:column + TILE[1]] = tile
    return picture


def mosaic(name, axes=AXIAL, slices=7, volumes=2, sign=1.0, change=None, header=None, step=3.5):
    """Writes mosaics, one for each volume. Returns the folder, the right affine to RAS mm and the
    voxels [time, slice, row, column]. header: fields of Siemens' own; None: the right ones."""
    voxels = numpy.arange(volumes * slices * TILE[0] * TILE[1], dtype=numpy.int16)
    voxels = voxels.reshape(volumes, slices, *TILE)
    normal = sign * numpy.cross(*axes)
    along = int(numpy.ceil(numpy.sqrt(slices)))
    header = header if header is not None else {
        "NumberOfImagesInMosaic": [slices], "SliceNormalVector": list(normal)}

    def edit(image, index):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M", "MOSAIC"]
        image.SpacingBetweenSlices = f"{step:.6g}"
        image.AcquisitionTime = f"1015{2.5 * index:09.6f}"
        if header:
            block = image.private_block(0x0029, SIEMENS, create=True)
            block.add_new(0x10, "OB", siemens_header(**header))
        if change:
            change(image)

    path = write_slices(folder(name), [tiles_of(volume) for volume in voxels], axes=axes,
                        positions=[0] * volumes, change=edit)
    across, down = (numpy.asarray(axis) for axis in axes)
    # The centre of the picture is that of the first slice.
    first = (numpy.array((-11.0, 22.0, 33.0)) + 0.7 * across * TILE[1] * (along - 1) / 2
             + 0.9 * down * TILE[0] * (along - 1) / 2)
    affine = numpy.eye(4)
    affine[:3] = numpy.stack([0.7 * across, 0.9 * down, step * normal, first], axis=1)
    return path, numpy.diag((-1.0, -1.0, 1.0, 1.0)) @ affine, voxels


def assert_volumes(reader, affine, voxels):
    assert len(reader.TimestepValues) == len(voxels), reader.TimestepValues
    for time, volume in zip(reader.TimestepValues, voxels):
        reader.UpdatePipeline(time)
        assert_placed(reader, affine, volume)


def test_real_mosaics_are_those_of_another_program():
    for name, first, second in (("heads_first", 0.0, 3.2), ("epi_pe_ap", 0.0, 2.435)):
        nifti = nibabel.load(data("dcm-qa-mosaic", name + ".nii.gz"))
        reader, told = read(data("dcm-qa-mosaic", name + "-00001.dcm"))
        assert not told, told
        numpy.testing.assert_allclose(list(reader.TimestepValues), (first, second), atol=1e-6)
        assert_volumes(reader, nifti.affine, numpy.asarray(nifti.dataobj).T)


def test_tiles_lie_along_siemens_normal():
    for axes in (AXIAL, OBLIQUE):
        for sign in (1.0, -1.0):
            for slices in (2, 7, 9):
                path, affine, voxels = mosaic("normal", axes, slices, sign=sign)
                reader, told = read(path)
                assert not told, told
                assert_volumes(reader, affine, voxels)


def united_mosaic(name, axes=OBLIQUE, slices=6, change=None):
    """Mosaics as United Imaging writes them, of 3 x 2 tiles: as those of Siemens above, but with a
    position for each slice, in a sequence of its own, and none for the picture."""
    voxels = numpy.arange(2 * slices * TILE[0] * TILE[1], dtype=numpy.int16)
    voxels = voxels.reshape(2, slices, *TILE)
    first, normal = numpy.array((-11.0, 22.0, 33.0)), numpy.cross(*axes)

    def edit(image, index):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M", "VFRAME"]
        image.AcquisitionTime = f"1015{2.5 * index:09.6f}"
        del image.ImagePositionPatient
        places = [pydicom.Dataset() for _ in range(slices)]
        for i, place in enumerate(places):
            place.ImagePositionPatient = [f"{each:.9g}" for each in first - 4.2 * i * normal]
        block = image.private_block(0x0065, "Image Private Header", create=True)
        block.add_new(0x50, "DS", str(slices))
        block.add_new(0x51, "SQ", pydicom.Sequence(places))
        if change:
            change(image)

    across = int(numpy.ceil(numpy.sqrt(slices)))
    pictures = [tiles_of(volume)[:TILE[0] * -(-slices // across)] for volume in voxels]
    path = write_slices(folder(name), pictures, axes=axes, change=edit)
    affine = numpy.eye(4)
    affine[:3] = numpy.stack([0.7 * numpy.asarray(axes[0]), 0.9 * numpy.asarray(axes[1]),
                              -4.2 * normal, first], axis=1)
    return path, numpy.diag((-1.0, -1.0, 1.0, 1.0)) @ affine, voxels


def test_tiles_of_united_imaging_lie_at_their_own_positions():
    for slices in (5, 6, 9):
        path, affine, voxels = united_mosaic("united", slices=slices)
        reader, told = read(path)
        assert not told, told
        assert_volumes(reader, affine, voxels)


def test_their_number_tells_mosaics_of_united_imaging():
    """Without the word VFRAME, if the picture has room for so many tiles."""
    def unnamed(image):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M"]

    def cut(image):
        unnamed(image)
        image.AcquisitionMatrix = [0, 15, 15, 0]

    def other(image):
        unnamed(image)
        image[0x0065, 0x1050].value = "5"

    def uncounted(image):
        unnamed(image)
        del image[0x0065, 0x1050]

    path, affine, voxels = united_mosaic("united-unnamed", change=unnamed)
    reader, told = read(path)
    assert not told, told
    assert_volumes(reader, affine, voxels)
    for change in (cut, other, uncounted):
        reader, _ = read(united_mosaic("united-cut", change=change)[0])
        assert output(reader).GetDimensions()[:2] == (3 * TILE[1], 2 * TILE[0]), change


def test_slices_of_united_imaging_may_have_the_orientation():
    """And may be in an attribute that another program did not know (UN)."""
    def within(image):
        for place in image[0x0065, 0x1051].value:
            place.ImageOrientationPatient = image.ImageOrientationPatient
        del image.ImageOrientationPatient

    def unknown(image):
        within(image)
        buffer = pydicom.filebase.DicomBytesIO()
        buffer.is_little_endian, buffer.is_implicit_VR = True, True
        pydicom.filewriter.write_sequence(buffer, image[0x0065, 0x1051], ["iso8859"])
        image[0x0065, 0x1051] = pydicom.DataElement(0x00651051, "UN", buffer.getvalue())

    for change in (within, unknown):
        path, affine, voxels = united_mosaic("united-within", change=change)
        reader, told = read(path)
        assert not told, told
        assert_volumes(reader, affine, voxels)


def test_mosaics_of_united_imaging_that_are_refused():
    def bare(image):
        del image[0x0065, 0x1051]

    def unplaced(image):
        del image[0x0065, 0x1051].value[2].ImagePositionPatient

    def more(image):
        image[0x0065, 0x1051].value.extend([image[0x0065, 0x1051].value[0]] * 4)

    def unturned(image):
        del image.ImageOrientationPatient

    def turned(image):
        image[0x0065, 0x1051].value[2].ImageOrientationPatient = [1, 0, 0, 0, 1, 0]

    for change, words in ((bare, "without the positions of its slices"),
                          (unturned, "without ImageOrientationPatient"),
                          (turned, "slice 3 has another ImageOrientationPatient"),
                          (unplaced, "slice 3 has no ImagePositionPatient"),
                          (more, "4 x 3 tiles divide")):
        told = read(united_mosaic("united-refused", change=change)[0])[1]
        assert_says(told, words, "dcm2niix")


def test_packed_and_rescaled_tiles_have_their_numbers():
    def change(image):
        image.RescaleSlope, image.RescaleIntercept = "2", "-5"
        image.compress(pydicom.uid.RLELossless)

    path, affine, voxels = mosaic("packed", change=change)
    reader, told = read(path)
    assert not told, told
    assert_volumes(reader, affine, 2.0 * voxels - 5.0)


def test_private_attributes_alone_tell_mosaics():
    def unnamed(image):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M"]
        image.private_block(0x0019, "SIEMENS MR HEADER", create=True).add_new(0x0a, "US", 7)

    path, affine, voxels = mosaic("unnamed", change=unnamed)
    reader, told = read(path)
    assert not told, told
    assert_volumes(reader, affine, voxels)


def test_the_step_may_be_in_siemens_header():
    def without(image):
        del image.SpacingBetweenSlices

    path, affine, voxels = mosaic("step", change=without, header={
        "NumberOfImagesInMosaic": [7], "SliceNormalVector": [0, 0, 1],
        "SpacingBetweenSlices": [3.5]})
    reader, told = read(path)
    assert not told, told
    assert_volumes(reader, affine, voxels)


def refused(*words, change=None, **fields):
    path, _, _ = mosaic("refused", change=change, **fields)
    reader, told = read(path)
    assert_says(told, path, *words)
    assert "dcm2niix" in told, told
    assert output(reader).GetNumberOfPoints() == 0


def test_what_is_not_known_is_refused():
    def setting(**values):
        def change(image):
            for keyword, value in values.items():
                setattr(image, keyword, value)
        return change

    def counted(count):
        def change(image):
            block = image.private_block(0x0019, "SIEMENS MR HEADER", create=True)
            block.add_new(0x0a, "US", count)
        return change

    def words(image):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M"]
        image.private_block(0x0051, "SIEMENS MR HEADER", create=True).add_new(
            0x16, "LO", "p2 M/NORM/MOSAIC")

    count = {"NumberOfImagesInMosaic": [7]}
    normal = {"SliceNormalVector": [0, 0, 1]}
    refused("an unknown number of slices", header={})
    refused("an unknown number of slices", header={}, change=words)
    refused("an unknown number of slices", header=normal)
    refused("has no SliceNormalVector", header=count)
    refused("has no SliceNormalVector", header={}, change=counted(7))
    refused("not perpendicular", "cosine 0", header={**count, "SliceNormalVector": [0, 1, 0]})
    refused("of 8 slices by", "of 7 by", change=counted(8))
    refused("SpacingBetweenSlices is missing", change=setting(SpacingBetweenSlices=""))
    refused("SpacingBetweenSlices is 0;", change=setting(SpacingBetweenSlices="0"))
    refused("4 x 4 tiles do not divide", header={**normal, "NumberOfImagesInMosaic": [16]})
    refused("without ImagePositionPatient", change=setting(ImagePositionPatient=None))
    def doubled(image):
        image.NumberOfFrames, image.PixelData = 2, 2 * image.PixelData

    refused("has 2 frames that are mosaics", change=doubled)


def test_one_frame_may_be_counted():
    def counted(image):
        image.NumberOfFrames = 1

    path, affine, voxels = mosaic("counted", change=counted)
    reader, told = read(path)
    assert not told, told
    assert_volumes(reader, affine, voxels)


def test_slices_that_were_cut_out_of_a_mosaic_are_slices():
    def cut(image):
        image.ImageType = ["ORIGINAL", "PRIMARY", "M"]
        image.AcquisitionMatrix = [0, 15, 15, 0]

    for change, header in ((cut, None), (None, {
            "NumberOfImagesInMosaic": [1], "SliceNormalVector": [0, 0, 1]})):
        path, _, _ = mosaic("cut", volumes=1, change=change, header=header)
        reader, _ = read(path)
        assert output(reader).GetNumberOfPoints() == 9 * TILE[0] * TILE[1]


def test_mosaics_that_nothing_tells_are_suspected():
    def measured(side, maker):
        def change(image, _):
            image.AcquisitionMatrix, image.Manufacturer = [side, 0, 0, side], maker
        return change

    voxels = numpy.arange(36, dtype=numpy.int16).reshape(1, 6, 6)
    for side, maker, doubts in ((2, "SIEMENS", True), (3, "SIEMENS", False), (2, "GE", False)):
        path = write_slices(folder("suspected"), voxels, change=measured(side, maker))
        reader, told = read(path)
        assert ("they may be mosaics" in told) == doubts, (side, maker, told)
        assert output(reader).GetNumberOfPoints() == 36


def test_short_mosaics_are_refused():
    path = folder("short")
    for file in glob.glob(data("dcm-qa-mosaic", "epi*.dcm")):
        shutil.copy(file, path)
    for name in os.listdir(path):
        os.truncate(os.path.join(path, name), os.path.getsize(os.path.join(path, name)) - 1000)
    reader, told = read(path)
    assert_says(told, "need 93312")
    assert len(scalars(reader)) == 0 if output(reader).GetPointData().GetScalars() else True


run_tests(globals())
