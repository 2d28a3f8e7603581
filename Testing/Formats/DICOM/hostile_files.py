# SPDX-License-Identifier: BSD-3-Clause
"""DICOM files that are made to harm, each by a pattern of faults found in other readers.

A function takes random numbers, for other sizes, and a path that it may use, and returns the bytes.
"""

import struct
import zlib

import numpy
import pydicom
from brainshift_testing import messages, output
from dicom_testing import (CT, ENHANCED_MR, enhanced, numbered, plain_header, scalars,
                           set_pixels)
from segment_files import masks, segmentation

RLE = "1.2.840.10008.1.2.5"
DEFLATED = "1.2.840.10008.1.2.1.99"
UNDEFINED = 0xffffffff
HEADER_LIMIT = 1 << 26  # bytes of a header that are inflated


def slice_of(random, syntax=pydicom.uid.ExplicitVRLittleEndian, dtype=numpy.uint8):
    """A good slice."""
    image = plain_header(CT, syntax)
    image.ImagePositionPatient, image.PixelSpacing = [0, 0, 0], [1, 1]
    image.ImageOrientationPatient, image.SliceThickness = [1, 0, 0, 0, 1, 0], 1
    set_pixels(image, numbered(1, random.randrange(3, 30), random.randrange(3, 30), dtype)[0])
    return image


def bytes_of(image, path):
    image.save_as(path, write_like_original=False)
    with open(path, "rb") as file:
        return file.read()


def fragments(*parts):
    """Pixels in fragments (item, length, bytes); a length of None is the right one."""
    data = b""
    for part, length in ((b"", None), *parts):
        data += struct.pack("<HHI", 0xfffe, 0xe000, len(part) if length is None else length) + part
    return data + struct.pack("<HHI", 0xfffe, 0xe0dd, 0)


def packed(random, path, *parts, **attributes):
    """A slice in RLE whose pixels are these fragments."""
    image = slice_of(random)
    for name, value in attributes.items():
        setattr(image, name, value)
    data = bytes_of(image, path).replace(
        b"1.2.840.10008.1.2.1\0", RLE.encode() + b"\0", 1)
    head = data[:data.rindex(b"\xe0\x7f\x10\x00")]
    return head + b"\xe0\x7f\x10\x00OB\0\0" + struct.pack("<I", UNDEFINED) + fragments(*parts)


def runs(count, *offsets):
    """A frame in RLE of `count` bytes in one literal run each, that announces segments."""
    data = b"".join(bytes([min(count - i, 128) - 1]) + bytes(min(count - i, 128))
                    for i in range(0, count, 128))
    data += b"\0" * (len(data) % 2)
    begins = [64, *offsets]
    return struct.pack("<16I", len(begins), *begins, *(15 - len(begins)) * [0]) + data


def rle_that_claims_three_times_its_bytes(random, path):
    """GDCM: a segment of N bytes for 3 N pixels; three planes of colours in one."""
    image = slice_of(random)
    pixels = image.Rows * image.Columns
    return packed(random, path, (runs(pixels, 64, 64), None), SamplesPerPixel=3,
                  PhotometricInterpretation="RGB", PlanarConfiguration=1,
                  Rows=3 * image.Rows, Columns=image.Columns)


def rle_segments_beyond_the_frame(random, path):
    return packed(random, path, (runs(9, random.choice([500, 0x7fffffff, UNDEFINED])), None))


def fragment_lengths_that_underflow(random, path):
    frame = runs(random.randrange(3, 900))
    length = random.choice([0, 1, 7, 63, len(frame) + 8, 0x7fffffff, 0xfffffff8, 0xfffffffe])
    return packed(random, path, (frame, length))


def fragment_table_beyond_the_fragments(random, path):
    """Two frames in three fragments, of which the table names none."""
    data = packed(random, path, (runs(9), None), (runs(9), None), (runs(9), None),
                  NumberOfFrames=2, SpacingBetweenSlices=1, Rows=3, Columns=3)
    table = struct.pack("<2I", random.choice([8, UNDEFINED]), random.choice([4, 0x7ffffffe]))
    item = struct.pack("<HHI", 0xfffe, 0xe000, 0)
    return data.replace(item, struct.pack("<HHI", 0xfffe, 0xe000, len(table)) + table, 1)


def image_of_the_class_of_segments(random, path):
    """A slice that says it is a segmentation, or a report, or a segmentation that says it is a
    slice."""
    kind = random.randrange(2)
    if kind == 0:
        image = slice_of(random)
        image.SOPClassUID = image.file_meta.MediaStorageSOPClassUID = (
            pydicom.uid.SegmentationStorage)
        return bytes_of(image, path)
    image = segmentation([(1, k, mask) for k, mask in enumerate(masks(3))])
    image.SOPClassUID = image.file_meta.MediaStorageSOPClassUID = random.choice([CT, ENHANCED_MR])
    return bytes_of(image, path)


def deflate_bomb(random, path):
    """A header that inflates beyond its limit: a thousand times its bytes."""
    data = bytes_of(slice_of(random, pydicom.uid.UID(DEFLATED)), path)
    group_length = struct.unpack_from("<I", data, 140)[0]
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    bomb = packer.compress(struct.pack("<HH2sHI", 9, 0x1000, b"OB", 0, HEADER_LIMIT + 99))
    for _ in range(HEADER_LIMIT // (1 << 20) + random.randrange(2, 9)):
        bomb += packer.compress(bytes(1 << 20))
    return data[:144 + group_length] + bomb + packer.flush()


def nested_sequences(random, path):
    """10 000 sequences, one in the other."""
    data = bytes_of(slice_of(random), path)
    place = data.index(b"\x28\x00\x02\x00")
    depth = 10000
    begin = (struct.pack("<HH2sHI", 0x0018, 0x9999, b"SQ", 0, UNDEFINED)
             + struct.pack("<HHI", 0xfffe, 0xe000, UNDEFINED))
    end = struct.pack("<HHI", 0xfffe, 0xe00d, 0) + struct.pack("<HHI", 0xfffe, 0xe0dd, 0)
    closed = random.random() < 0.5
    return data[:place] + depth * begin + (depth * end if closed else b"") + data[place:]


def segment_beyond_its_table(random, path):
    image = segmentation([(1, k, mask) for k, mask in enumerate(masks(3))])
    group = image.PerFrameFunctionalGroupsSequence[random.randrange(3)]
    group.SegmentIdentificationSequence[0].ReferencedSegmentNumber = random.choice([0, 2, 65535])
    return bytes_of(image, path)


def frames_beyond_the_pixels(random, path):
    image = enhanced(numbered(3)[None])
    image.NumberOfFrames = random.choice([4, 1000000, 2147483647])
    return bytes_of(image, path)


def mosaic_of_more_slices_than_pixels(random, path):
    image = slice_of(random)
    image.ImageType = ["ORIGINAL", "PRIMARY", "M", "MOSAIC"]
    image.private_block(0x0019, "SIEMENS MR HEADER", create=True).add_new(
        0x0a, "US", random.choice([1000, 65535]))
    return bytes_of(image, path)


def overlay_beyond_its_array(random, path):
    """GDCM: more rows of a drawing than bytes. BrainShift shows no drawings."""
    image = slice_of(random)
    image.add_new(0x60000010, "US", random.choice([1000, 65535]))
    image.add_new(0x60000011, "US", 65535)
    image.add_new(0x60000050, "SS", [-32768, 32767])
    image.add_new(0x60000100, "US", random.choice([1, 16]))
    image.add_new(0x60000102, "US", random.choice([0, 65535]))
    image.add_new(0x60003000, "OW", b"\1\2\3\4")
    return bytes_of(image, path)


def dimension_index_beyond_its_table(random, path):
    """The index of a frame in a dimension that is not there. Positions and times say the order."""
    image = enhanced(numbered(3)[None])
    for group in image.PerFrameFunctionalGroupsSequence:
        group.FrameContentSequence[0].DimensionIndexValues = [
            random.choice([0, 9, 0x7fffffff, UNDEFINED]) for _ in range(random.randrange(1, 9))]
    return bytes_of(image, path)


#: Those that must be refused, and those that must be read as if the pattern were not there.
REFUSED = (rle_that_claims_three_times_its_bytes, rle_segments_beyond_the_frame,
           fragment_lengths_that_underflow, fragment_table_beyond_the_fragments,
           image_of_the_class_of_segments, deflate_bomb, nested_sequences, segment_beyond_its_table,
           frames_beyond_the_pixels, mosaic_of_more_slices_than_pixels)
PASSED_OVER = (overlay_beyond_its_array, dimension_index_beyond_its_table)
PATTERNS = REFUSED + PASSED_OVER


def outcome(path):
    """The numbers that BrainShift reads, or None, and what it said."""
    from paraview import simple
    with messages() as said:
        proxy = simple.DICOMVolumeReader(FileName=path)
        try:
            proxy.UpdatePipeline()
            image = output(proxy)
            numbers = scalars(proxy).copy() if image and image.GetNumberOfPoints() else None
        finally:
            simple.Delete(proxy)
    return numbers, str(said.text)


def same_numbers(path, numbers):
    right = pydicom.dcmread(path).pixel_array
    return numpy.array_equal(numpy.sort(right.ravel()), numpy.sort(numbers.ravel()))
