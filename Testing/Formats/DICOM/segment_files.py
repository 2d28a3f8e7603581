# SPDX-License-Identifier: BSD-3-Clause
"""DICOM segmentations for the tests, written by pydicom."""

import struct

import numpy
import pydicom
from dicom_testing import AXIAL, plain_header
from pydicom.sequence import Sequence

SEGMENTATION = "1.2.840.10008.5.1.4.1.1.66.4"
LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.7"
ORIGIN, SPACING, STEP = (-11.0, 22.0, 33.0), (0.7, 0.9), 2.5


def item(**values):
    made = pydicom.Dataset()
    for name, value in values.items():
        setattr(made, name, value)
    return made


def code(scheme, value, meaning):
    return Sequence([item(CodeValue=value, CodingSchemeDesignator=scheme, CodeMeaning=meaning)])


def described(number, name=None):
    made = item(SegmentNumber=number, SegmentLabel=name or f"Part {number}",
                SegmentAlgorithmType="MANUAL",
                SegmentedPropertyCategoryCodeSequence=code("SCT", "85756007", "Tissue"),
                SegmentedPropertyTypeCodeSequence=code("SCT", "10200004", "Liver"))
    made.RecommendedDisplayCIELabValue = [41661, 41167, 40792]
    return made


def packed(pixels):
    """Bits of all frames in a row, the lowest first."""
    data = numpy.packbits(numpy.asarray(pixels, bool).ravel(), bitorder="little").tobytes()
    return data + b"\0" * (len(data) % 2)


def run_lengths(*segments):
    """A frame in RLE, of literal runs."""
    runs, begins = b"", []
    for data in segments:
        begins.append(64 + len(runs))
        runs += b"".join(bytes([len(data[i:i + 128]) - 1]) + data[i:i + 128]
                         for i in range(0, len(data), 128))
        runs += b"\0" * (len(runs) % 2)
    return struct.pack("<16I", len(segments), *begins, *(15 - len(begins)) * [0]) + runs


def segmentation(frames, kind="BINARY", axes=AXIAL, numbers=None, step=STEP, spacing=SPACING,
                 bits=None):
    """A segmentation. frames: (segment, slice, pixels [row, column]). The segment is None in a
    label map. numbers: of the segments that are described."""
    image = plain_header(LABEL_MAP if kind == "LABELMAP" else SEGMENTATION)
    image.Modality, image.SegmentationType = "SEG", kind
    if numbers is None:
        numbers = sorted({segment for segment, *_ in frames if segment})
    image.SegmentSequence = Sequence([described(number) for number in numbers])
    measures = item(PixelSpacing=[f"{spacing[1]:.9g}", f"{spacing[0]:.9g}"],
                    SliceThickness=f"{step:.9g}", SpacingBetweenSlices=f"{step:.9g}")
    plane = item(ImageOrientationPatient=[f"{number:.9g}" for axis in axes for number in axis])
    image.SharedFunctionalGroupsSequence = Sequence([item(
        PixelMeasuresSequence=Sequence([measures]), PlaneOrientationSequence=Sequence([plane]))])
    groups = []
    for segment, slice_, _ in frames:
        place = ORIGIN + slice_ * step * numpy.cross(*axes)
        group = item(
            FrameContentSequence=Sequence([item(DimensionIndexValues=[segment or 1, 1])]),
            PlanePositionSequence=Sequence([item(
                ImagePositionPatient=[f"{number:.9g}" for number in place])]))
        if segment:
            group.SegmentIdentificationSequence = Sequence([item(ReferencedSegmentNumber=segment)])
        groups.append(group)
    image.PerFrameFunctionalGroupsSequence = Sequence(groups)
    pixels = numpy.stack([pixels for *_, pixels in frames])
    set_segment_pixels(image, pixels, bits or (1 if kind == "BINARY" else 8))
    if kind == "FRACTIONAL":
        image.SegmentationFractionalType, image.MaximumFractionalValue = "PROBABILITY", 200
    return image


def set_segment_pixels(image, pixels, bits):
    image.NumberOfFrames, (image.Rows, image.Columns) = len(pixels), pixels.shape[1:]
    image.SamplesPerPixel, image.PhotometricInterpretation = 1, "MONOCHROME2"
    image.BitsAllocated = image.BitsStored = bits
    image.HighBit, image.PixelRepresentation = bits - 1, 0
    data = packed(pixels) if bits == 1 else pixels.astype(f"<u{bits // 8}").tobytes()
    image.PixelData = data + b"\0" * (len(data) % 2)
    image["PixelData"].VR = "OB" if bits <= 8 else "OW"


def masks(count, rows=5, columns=7, seed=3):
    """Frames of random bits: [frame, row, column]. A frame has 35 bits, which end inside a byte."""
    return numpy.random.default_rng(seed).integers(0, 2, (count, rows, columns)).astype(numpy.uint8)
