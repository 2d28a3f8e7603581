# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled packed frames: JPEG, JPEG-LS, JPEG 2000 and RLE in a DICOM file.

The frame alone is spoiled, so that all changes reach the decoder. A case is good if BrainShift
refuses the file, or reads as many numbers as it announces; a frame that is left whole must unpack
to what was packed, or near it if it is lossy.
"""

import io
import os
import struct
import subprocess

import numpy
import pydicom
from dicom_cases import LENGTHS
from dicom_testing import MR, plain_header, set_pixels
from jpeg_writer import encode, encode_transformed
from PIL import Image

ROWS, COLUMNS = 33, 41
JPEG = "1.2.840.10008.1.2.4."
#: What GDCM packs: its options, the transfer syntax, and how far a number may be off.
PACKINGS = ((("--jpeg",), JPEG + "70", 0), (("--jpeg", "--lossy", "-q", "90"), JPEG + "50", 25),
            (("--jpegls",), JPEG + "80", 0), (("--j2k",), JPEG + "90", 0),
            (("--j2k", "--lossy"), JPEG + "91", 8), (("--rle",), "1.2.840.10008.1.2.5", 0))
HEADER = 180  # most changes are made before this byte, where the tables are


def _picture(most):
    y, x = numpy.mgrid[:ROWS, :COLUMNS]
    noise = numpy.random.default_rng(5).integers(0, most // 8, (ROWS, COLUMNS))
    return numpy.clip((x * y) * most // (ROWS * COLUMNS) + noise, 0, most)


def _image(pixels, bits):
    image = plain_header(MR)
    image.SliceThickness = 1
    image.ImagePositionPatient, image.PixelSpacing = [0, 0, 0], [1, 1]
    image.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    set_pixels(image, pixels)
    image.BitsStored, image.HighBit = bits, bits - 1
    return image


def _packed(folder, image, options):
    source, to = os.path.join(folder, "plain.dcm"), os.path.join(folder, "packed.dcm")
    image.save_as(source, write_like_original=False)
    made = subprocess.run(["gdcmconv", *options, source, to], capture_output=True)
    if made.returncode != 0:
        return None
    return next(pydicom.encaps.generate_pixel_data_frame(pydicom.dcmread(to).PixelData, 1))


def _frames(folder):
    """(image, frame, transfer syntax, tolerance) of all packings and some sizes of numbers."""
    for bits, dtype in ((8, numpy.uint8), (12, numpy.uint16), (16, numpy.uint16)):
        image = _image(_picture((1 << bits) - 1).astype(dtype), bits)
        for options, syntax, off in PACKINGS:
            frame = _packed(folder, image, options)
            if frame is not None and (bits == 8 or syntax != JPEG + "50"):
                yield image, frame, syntax, off
        if bits < 16:
            yield image, encode_transformed(image.pixel_array, bits), JPEG + "51", 1
        for predictor in range(1, 8):
            restarts = predictor % 3 * 5
            yield image, encode(image.pixel_array, bits, predictor, 0, restarts), JPEG + "57", 0
    small = _image(_picture(255).astype(numpy.uint8), 8)
    packed = io.BytesIO()
    Image.fromarray(small.pixel_array).save(packed, "JPEG", restart_marker_blocks=3)
    yield small, packed.getvalue(), JPEG + "50", 60


def _spoiled(random, data):
    change = random.random()
    end = min(HEADER, len(data)) if random.random() < 0.6 else len(data)
    place = random.randrange(end)
    if change < 0.45:
        byte = random.choice([0, 1, 7, 8, 16, 127, 128, 254, 255, random.randrange(256)])
        return data[:place] + bytes([byte]) + data[place + 1:]
    if change < 0.6:
        kind = random.choice([">H", ">I"])
        length = random.choice(LENGTHS) & (0xffff if kind == ">H" else 0xffffffff)
        return data[:place] + struct.pack(kind, length) + data[place + struct.calcsize(kind):]
    if change < 0.7:
        return data[:place] + bytes(random.randrange(256) for _ in range(3)) + data[place:]
    if change < 0.8:
        return data[:place] + data[place + random.randrange(1, 20):]
    if change < 0.9:
        other = random.randrange(len(data))
        return data[:place] + data[other:other + random.randrange(2, 60)] + data[place:]
    return data[:max(place, 2)]


class Cases:
    """Reads files with spoiled frames, one for each case."""

    def __init__(self, folder):
        self.name = os.path.join(folder, "frame.dcm")
        place = os.path.join(folder, "to-pack")
        os.makedirs(place, exist_ok=True)
        self.frames = list(_frames(place))

    def run(self, random):
        """What became of one frame: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages
        image, whole, syntax, off = random.choice(self.frames)
        frame = whole
        for _ in range(random.choice([0, 1, 1, 1, 2, 3, 6])):
            frame = _spoiled(random, frame) or b"\0\0"
        right = _write(image, frame, syntax, self.name)
        with messages() as said:
            numbers = _read(self.name)
        if numbers is None:
            is_told = "error" in said.text.lower() and frame != whole
            return "refused" if is_told else "misplaced: no image and no error"
        if numbers.size != right.size:
            return f"misplaced: {numbers.size} numbers"
        if frame != whole:
            return "taken"
        farthest = numpy.abs(numbers.astype(int) - right.astype(int)).max()
        return "same" if farthest <= off else f"misplaced: a number is off by {farthest}"


def _write(image, frame, syntax, name):
    """Writes a file with the header of an image and a frame. The numbers of the image."""
    pixels, plain = image.pixel_array, image.PixelData
    plain_syntax = image.file_meta.TransferSyntaxUID
    image.file_meta.TransferSyntaxUID = pydicom.uid.UID(syntax)
    image.PixelData = pydicom.encaps.encapsulate([frame + b"\0" * (len(frame) % 2)])
    image["PixelData"].VR, image["PixelData"].is_undefined_length = "OB", True
    image.save_as(name, write_like_original=False)
    image.file_meta.TransferSyntaxUID, image.PixelData = plain_syntax, plain
    image["PixelData"].VR = "OB" if pixels.dtype.itemsize == 1 else "OW"
    image["PixelData"].is_undefined_length = False
    return pixels


def _read(name):
    """The numbers [row, column] in the order of the file; None if there are none."""
    from paraview import simple
    from vtkmodules.util.numpy_support import vtk_to_numpy
    proxy = simple.DICOMVolumeReader(FileName=name)
    try:
        proxy.UpdatePipeline()
        shown = proxy.GetClientSideObject().GetOutputDataObject(0)
        scalars = shown.GetPointData().GetScalars()
        if scalars is None:
            return None
        columns, rows, _ = shown.GetDimensions()
        return vtk_to_numpy(scalars).reshape(rows, columns)[::-1, ::-1].copy()
    finally:
        simple.Delete(proxy)
