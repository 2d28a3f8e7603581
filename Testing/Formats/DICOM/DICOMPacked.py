# SPDX-License-Identifier: BSD-3-Clause
# Proves that packed frames unpack to what was packed, or for lossy ones to what is near it or what
# Pillow unpacks, and that damaged ones end in a sentence that names the file: no decoder of GDCM,
# which ends the program at some of them, is asked.
import io
import os
import subprocess

import numpy
import pydicom
from PIL import Image
from brainshift_testing import assert_says, load_plugin, messages, output, run_tests
from dicom_testing import (MR, folder, numbered, plain_header, scalars, set_pixels)
from jpeg_writer import encode, encode_transformed, segment

load_plugin()
from paraview.simple import DICOMVolumeReader  # noqa: E402 after the plugin

BASELINE = "1.2.840.10008.1.2.4.50"
EXTENDED = "1.2.840.10008.1.2.4.51"
LOSSLESS = "1.2.840.10008.1.2.4.57"
JPEG_LS = "1.2.840.10008.1.2.4.80"
JPEG_2000 = "1.2.840.10008.1.2.4.90"
LOSSY_2000 = "1.2.840.10008.1.2.4.91"


def head(rows=33, columns=41, most=4095):
    """A picture [row, column] with smooth parts, edges and noise, from 0 to `most`."""
    y, x = numpy.mgrid[:rows, :columns]
    noise = numpy.random.default_rng(5).integers(0, most // 8, (rows, columns))
    picture = (x + y) * most // (2 * (rows + columns)) + noise
    picture[rows // 3:rows // 2, columns // 4:] += most // 3
    return numpy.clip(picture, 0, most).astype(numpy.uint16)


def with_frame(name, pixels, frame, syntax, change=None):
    """A file whose header says `pixels` and whose only frame is `frame`."""
    image = plain_header(MR)
    image.SliceThickness = 1
    image.ImagePositionPatient, image.PixelSpacing = [0, 0, 0], [1, 1]
    image.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    set_pixels(image, pixels)
    if change:
        change(image)
    image.file_meta.TransferSyntaxUID = pydicom.uid.UID(syntax)
    image.PixelData = pydicom.encaps.encapsulate([frame + b"\0" * (len(frame) % 2)])
    image["PixelData"].VR = "OB"
    image["PixelData"].is_undefined_length = True
    path = os.path.join(folder(name), "frame.dcm")
    image.save_as(path, write_like_original=False)
    return path


def read(path):
    """Numbers [row, column] in the order of the file, or None; and what was told."""
    with messages() as told:
        reader = DICOMVolumeReader(FileName=path)
        reader.UpdatePipeline()
    if output(reader).GetNumberOfPoints() == 0:
        return None, told.text
    columns, rows, _ = output(reader).GetDimensions()
    return scalars(reader).reshape(rows, columns)[::-1, ::-1], told.text


def assert_exact(path, pixels):
    numbers, told = read(path)
    assert not told, told
    numpy.testing.assert_array_equal(numbers, pixels)


def test_lossless_frames_of_all_predictors_are_exact():
    for predictor in range(1, 8):
        for bits, dropped, restart_rows in ((16, 0, 0), (12, 0, 4), (12, 3, 0), (5, 0, 1)):
            pixels = head(most=(1 << bits) - 1)
            frame = encode(pixels, bits, predictor, dropped, restart_rows)
            assert_exact(with_frame("lossless", pixels, frame, LOSSLESS),
                         pixels >> dropped << dropped)


def test_lossless_frames_of_bytes_and_of_signed_numbers_are_exact():
    small = head(most=255).astype(numpy.uint8)
    assert_exact(with_frame("bytes", small, encode(small, 8), LOSSLESS), small)
    leaps = numpy.array([[0, -32768, 32767], [-1, 1, 0], [-32768, 0, 32767]], numpy.int16)
    frame = encode(leaps.view(numpy.uint16), 16, 4)
    assert_exact(with_frame("signed", leaps, frame, LOSSLESS), leaps)

    def twelve(image):
        image.BitsStored, image.HighBit = 12, 11

    signed = (head().astype(numpy.int16) - 2048)
    frame = encode((signed & 0xfff).astype(numpy.uint16), 12)
    assert_exact(with_frame("signed-12", signed, frame, LOSSLESS, change=twelve), signed)


def test_baseline_frames_are_those_of_another_reader():
    pixels = head(most=255).astype(numpy.uint8)
    for options in ({"quality": 90}, {"quality": 40, "restart_marker_blocks": 5},
                    {"quality": 75, "optimize": True, "restart_marker_rows": 2}):
        packed = io.BytesIO()
        Image.fromarray(pixels).save(packed, "JPEG", **options)
        right = numpy.asarray(Image.open(packed)).astype(int)
        numbers, told = read(with_frame("baseline", pixels, packed.getvalue(), BASELINE))
        assert not told, told
        # libjpeg transforms whole numbers, which may round the other way.
        assert numpy.abs(numbers.astype(int) - right).max() <= 1, options


def test_extended_frames_of_12_bits_are_near_what_was_packed():
    pixels = head()
    frame = encode_transformed(pixels, 12)
    numbers, told = read(with_frame("extended", pixels, frame, EXTENDED))
    assert not told, told
    assert numpy.abs(numbers.astype(int) - pixels).max() <= 1

    def ten(image):
        image.BitsStored, image.HighBit = 10, 9

    numbers, told = read(with_frame("bright", pixels, frame, EXTENDED, ten))
    assert not told, told
    right = numpy.minimum(pixels, 1023).astype(int)  # too bright stays bright
    assert numpy.abs(numbers.astype(int) - right).max() <= 1


def test_frames_of_16_bits_with_the_cosine_transform_are_refused():
    """GDCM writes them; the standard ends at 12 bits, and no two programs read them alike."""
    pixels = head()
    frame = encode_transformed(pixels, 12).replace(b"\xff\xc1\0\x0b\x0c", b"\xff\xc1\0\x0b\x10")
    numbers, told = read(with_frame("sixteen", pixels, frame, EXTENDED))
    assert numbers is None
    assert_says(told, "a DCT of 16 bits")


def replaced(frame, marker, change):
    """The frame with the first segment of a marker changed: change(payload), a new frame part."""
    begin = frame.index(bytes([0xff, marker]))
    end = begin + 2 + int.from_bytes(frame[begin + 2:begin + 4], "big")
    return frame[:begin] + change(frame[begin + 4:end]) + frame[end:]


def test_damaged_jpeg_frames_end_in_a_sentence():
    pixels = head()
    frame = encode(pixels, 16, restart_rows=4)
    start = replaced(frame, 0xc3, lambda old: segment(0xc3, old))
    assert start == frame
    cases = {
        "another size": (replaced(frame, 0xc3, lambda old: segment(
            0xc3, old[:1] + b"\0\x22" + old[3:])), "41 x 34 pixels"),
        "three samples": (replaced(frame, 0xc3, lambda old: segment(
            0xc3, old[:5] + b"\3" + 3 * old[6:])), "3 samples"),
        "progressive": (replaced(frame, 0xc3, lambda old: segment(0xc2, old)), "progressive"),
        "two headers": (replaced(frame, 0xc3, lambda old: 2 * segment(0xc3, old)), "two headers"),
        "a byte too many": (replaced(frame, 0xfe, lambda old: segment(0xfe, old) + b"\0"),
                            "ends before its scan"),
        "no codes": (replaced(frame, 0xc4, lambda old: b""), "lacks a Huffman table"),
        "too many codes": (replaced(frame, 0xc4, lambda old: segment(
            0xc4, b"\0\3" + bytes(15) + b"\0\1\2")), "a Huffman table is invalid"),
        "predictor 8": (replaced(frame, 0xda, lambda old: segment(
            0xda, old[:3] + b"\x08" + old[4:])), "its predictor is 8"),
        "restarts inside rows": (replaced(frame, 0xdd, lambda old: segment(0xdd, b"\0\7")),
                                 "its restart interval is 7 samples", "its 41 columns"),
        "no restart": (frame.replace(b"\xff\xd3", b"\xff\xd5"), "its Huffman data"),
        "half": (frame[:len(frame) // 2], "its Huffman data ends or is invalid"),
        "the header alone": (frame[:30], "ends before its scan"),
        "nothing": (b"\xff\xd8", "ends before its scan"),
        "JPEG 2000": (b"\xff\x4f" + frame, "does not begin with the marker of an image"),
    }
    for name, (damaged, *words) in cases.items():
        numbers, told = read(with_frame("damaged", pixels, damaged, LOSSLESS))
        assert numbers is None, name
        assert_says(told, "frame.dcm cannot be read", *words)


def frame_of(pixels, option):
    """One frame, packed by GDCM."""
    image = plain_header(MR)
    image.SliceThickness = 1
    set_pixels(image, pixels)
    source = os.path.join(folder("to-pack"), "plain.dcm")
    image.save_as(source, write_like_original=False)
    to = os.path.join(folder("by-gdcm"), "packed.dcm")
    subprocess.run(["gdcmconv", option, source, to], check=True, capture_output=True)
    return next(pydicom.encaps.generate_pixel_data_frame(pydicom.dcmread(to).PixelData, 1))


def test_frames_of_fewer_bits_than_the_file_says_are_read_and_of_more_refused():
    """GDCM ends the program at the first and writes behind its buffer at the second."""
    small, large = head(most=255).astype(numpy.uint8), head(most=65535)
    packers = ((JPEG_LS, lambda pixels: frame_of(pixels, "--jpegls")),
               (JPEG_2000, lambda pixels: frame_of(pixels, "--j2k")),
               (LOSSLESS, lambda pixels: encode(pixels, 8 * pixels.itemsize)))
    for syntax, packed in packers:
        few = with_frame("few-bits", small.astype(numpy.uint16), packed(small), syntax)
        assert_exact(few, small)
        many = with_frame("many-bits", small, packed(large), syntax)
        numbers, told = read(many)
        assert numbers is None, syntax
        assert_says(told, "in 16 bits; the file says 41 x 33 pixels of 1 sample in up to 8 bits")


def test_the_highest_bit_of_the_frame_is_the_sign():
    signed = head().astype(numpy.int16) - 2048
    frame = encode((signed & 0xfff).astype(numpy.uint16), 12)
    assert_exact(with_frame("sign-of-12", signed, frame, LOSSLESS), signed)
    assert_exact(with_frame("sign-of-2000", signed, frame_of(signed, "--j2k"), JPEG_2000), signed)
    numbers, told = read(with_frame("no-sign", signed.astype(numpy.uint16),
                                    frame_of(signed, "--j2k"), JPEG_2000))
    assert numbers is None
    assert_says(told, "a frame has signed numbers", "Pixel Representation 0")


def test_lossy_signed_numbers_end_at_the_darkest_and_brightest():
    def twelve(image):
        image.BitsStored, image.HighBit = 12, 11

    signed = head().astype(numpy.int16) * 2 - 4096
    numbers, told = read(with_frame("clamped", signed, frame_of(signed, "--j2k"), LOSSY_2000,
                                    twelve))
    assert not told, told
    numpy.testing.assert_array_equal(numbers, numpy.clip(signed, -2048, 2047))


def in_tiles(pixels, side):
    packed = io.BytesIO()
    Image.fromarray(pixels).save(packed, "JPEG2000", tile_size=(side, side), no_jp2=True)
    return packed.getvalue()


def test_jpeg_2000_has_all_tiles():
    pixels = head(64, 64, 255).astype(numpy.uint8)
    frame = in_tiles(pixels, 32)
    assert_exact(with_frame("tiles", pixels, frame, JPEG_2000), pixels)
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "JPEG2000")
    assert_exact(with_frame("jp2", pixels, file.getvalue(), JPEG_2000), pixels)
    last = frame.rindex(b"\xff\x90\0\x0a\0\3")
    one = frame[:8 + 16] + (1).to_bytes(4, "big") * 2 + frame[8 + 24:]
    huge = frame[:8] + b"\x7f" * 8 + frame[16:]
    for damaged, words in ((frame[:last] + b"\xff\xd9", "it has 3 of its 4 tiles"),
                           (one, "it has 4 of its 4096 tiles"),
                           (frame[:24] + bytes(8) + frame[32:], "it announces 0 x 0 tiles"),
                           (huge, "2139062143 x 2139062143 pixels"),
                           (frame[:40] + b"\x40\0" + frame[42:], "16384 samples"),
                           (frame[:2] + frame[60:], "does not begin with its size")):
        numbers, told = read(with_frame("tiles", pixels, damaged, JPEG_2000))
        assert numbers is None, words
        assert_says(told, words)


def test_markers_of_restart_may_be_filled_up():
    pixels = head()
    frame = encode(pixels, 16, restart_rows=4)
    filled = frame.replace(b"\xff\xd1", b"\xff\xff\xff\xd1")
    assert filled != frame
    assert_exact(with_frame("filled", pixels, filled, LOSSLESS), pixels)


def test_packed_pixels_come_in_fragments():
    pixels = head()
    path = with_frame("plain", pixels, encode(pixels, 16), LOSSLESS)
    with open(path, "rb") as file:
        data = file.read()
    begin = data.index(b"\xe0\x7f\x10\0OB\0\0\xff\xff\xff\xff")
    with open(path, "wb") as file:
        file.write(data[:begin + 8] + (len(data) - begin - 12).to_bytes(4, "little") +
                   data[begin + 12:])
    numbers, told = read(path)
    assert numbers is None
    assert_says(told, "its packed pixels do not come in fragments")


def test_damaged_frames_of_the_libraries_end_in_a_sentence():
    pixels = head(64, 64)
    for option, syntax, word in (("--jpegls", JPEG_LS, "JPEG-LS"),
                                 ("--j2k", JPEG_2000, "JPEG 2000")):
        frame = frame_of(pixels, option)
        for damaged in (frame[:20], frame[:len(frame) // 3], b"\xff\xd8" + frame[20:]):
            numbers, told = read(with_frame("damaged-too", pixels, damaged, syntax))
            assert numbers is None, option
            assert_says(told, f"frame.dcm cannot be read: a {word} frame is damaged")
        numbers, told = read(with_frame("other-size", numbered(1, 60, 64)[0], frame, syntax))
        assert numbers is None
        assert_says(told, "a frame has 64 x 64 pixels")


run_tests(globals())
