# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled DICOM segmentations: bytes, lengths, ends; counts and numbers that do not fit.

BrainShift's labels are compared with those of pydicom and numpy. A case is good if both have the
same labels at the same places, if BrainShift refuses the file, or if it says what it left out.
"""

import os

import numpy
import pydicom
from dicom_cases import spoiled
from dicom_testing import places
from mutation import rotation
from pydicom.encaps import encapsulate
from pydicom.sequence import Sequence
from segment_files import masks, packed, run_lengths, segmentation
from vtkmodules.util.numpy_support import vtk_to_numpy

DEFLATED, RLE = pydicom.uid.DeflatedExplicitVRLittleEndian, pydicom.uid.RLELossless
NUMBERS = [0, 1, 2, 3, 5, 7, 255, 256, 32767, 65535]




def _made(random):
    """A good segmentation."""
    rows, columns, count = random.randrange(2, 9), random.randrange(2, 9), random.randrange(1, 6)
    slices = random.sample(range(9), count)
    bits = masks(count, rows, columns, seed=random.randrange(10 ** 6))
    alone = random.random() < 0.7  # one segment in each slice: no layers
    frames = [(random.randrange(1, 4), slices[i if alone else i % 2], bits[i])
              for i in range(count)]
    axes = rotation(random)
    image = segmentation(frames, axes=(axes[:, 0], axes[:, 1]), numbers=[1, 2, 3])
    syntax = random.choice([None, None, DEFLATED, RLE])
    if syntax:
        image.file_meta.TransferSyntaxUID = syntax
    if syntax == RLE:
        image.PixelData = encapsulate([run_lengths(packed(frame)) for frame in bits])
        image["PixelData"].is_undefined_length = True
    return image


def _misfit(random, image):
    """Gives one attribute a number that does not fit the others."""
    number = random.choice(NUMBERS)
    group = random.choice(image.PerFrameFunctionalGroupsSequence)
    segment = random.choice(image.SegmentSequence)
    shared = image.SharedFunctionalGroupsSequence[0]
    random.choice([
        lambda: setattr(image, "Rows", number), lambda: setattr(image, "Columns", number),
        lambda: setattr(image, "NumberOfFrames", number * random.choice([1, 1000, 65535])),
        lambda: setattr(image, "BitsAllocated", random.choice([0, 1, 8, 16, 32])),
        lambda: setattr(image, "SegmentationType", random.choice(
            ["BINARY", "FRACTIONAL", "LABELMAP", "OTHER"])),
        lambda: setattr(segment, "SegmentNumber", number),
        lambda: setattr(image, "SegmentSequence", Sequence([])),
        lambda: setattr(group, "SegmentIdentificationSequence", Sequence([])),
        lambda: setattr(group.SegmentIdentificationSequence[0], "ReferencedSegmentNumber", number),
        lambda: setattr(group.FrameContentSequence[0], "DimensionIndexValues", [number] * 5),
        lambda: setattr(group.PlanePositionSequence[0], "ImagePositionPatient",
                        [random.uniform(-1e6, 1e6) for _ in range(3)]),
        lambda: setattr(shared.PixelMeasuresSequence[0], "SpacingBetweenSlices", str(random.choice(
            [0, -2.5, 1.25, 1e-300, 1e300]))),
        lambda: image.file_meta.TransferSyntaxUID == RLE or setattr(
            image, "PixelData", image.PixelData[:random.randrange(9)]),
    ])()


def _bits(image):
    if image.file_meta.TransferSyntaxUID == RLE:
        raise ValueError("not read here")
    count = int(image.NumberOfFrames) * image.Rows * image.Columns
    if image.BitsAllocated == 8:
        data = numpy.frombuffer(image.PixelData, numpy.uint8)
    else:
        data = numpy.unpackbits(numpy.frombuffer(image.PixelData, numpy.uint8), bitorder="little")
    return data[:count].reshape(-1, image.Rows, image.Columns)


def _points(image):
    """World positions, mm, RAS, and segments of all bits that are set."""
    shared = image.SharedFunctionalGroupsSequence[0]
    frames = image.PerFrameFunctionalGroupsSequence
    points, segments = [numpy.zeros((0, 3))], []
    for frame, group in zip(_bits(image), frames):
        across, down = numpy.asarray((group if "PlaneOrientationSequence" in group else shared)
                                     .PlaneOrientationSequence[0].ImageOrientationPatient,
                                     float).reshape(2, 3)
        between_rows, between_columns = map(float, (
            group if "PixelMeasuresSequence" in group else shared)
            .PixelMeasuresSequence[0].PixelSpacing)
        row, column = numpy.nonzero(frame)
        place = numpy.asarray(group.PlanePositionSequence[0].ImagePositionPatient, float)
        points.append(place + numpy.outer(column * between_columns, across)
                      + numpy.outer(row * between_rows, down))
        number = group.SegmentIdentificationSequence[0].ReferencedSegmentNumber
        segments += len(row) * [number]
    return numpy.concatenate(points) * (-1, -1, 1), numpy.array(segments, int)


def _compared(path, image):
    try:
        points, segments = _points(pydicom.dcmread(path))
    except Exception:  # of many kinds: pydicom checks little before it uses it
        return "open"
    labels = vtk_to_numpy(image.GetPointData().GetScalars())
    shown = places(image)[labels > 0]
    if len(shown) != len(points):
        return f"misplaced: {len(shown)} voxels are labelled, not {len(points)}"
    if not len(shown):
        return "same"
    apart = numpy.linalg.norm(shown[:, None] - points[None], axis=2)
    nearest = apart.argmin(axis=1)
    error = apart.min(axis=1).max()
    if error > 0.05 or not numpy.array_equal(segments[nearest], labels[labels > 0]):
        return f"misplaced: a voxel is {error} mm from that of the file, or has another label"
    return "same"


class Cases:
    """Reads spoiled segmentations, one for each case."""

    def __init__(self, folder):
        self.path = os.path.join(folder, "segments", "segments.dcm")
        os.makedirs(os.path.dirname(self.path), exist_ok=True)

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages, output
        from paraview import simple
        image = _made(random)
        if random.random() < 0.5:
            _misfit(random, image)
        image.save_as(self.path, write_like_original=False)
        with open(self.path, "rb") as file:
            data = file.read()
        for _ in range(random.choice([0, 0, 1, 1, 2, 3])):
            data = spoiled(random, data) if len(data) > 133 else data
        with open(self.path, "wb") as file:
            file.write(data)
        with messages() as said:
            proxy = simple.DICOMVolumeReader(FileName=self.path)
            proxy.UpdatePipeline()
        read = output(proxy)
        simple.Delete(proxy)
        if not read.GetNumberOfPoints():
            return ("refused" if "error" in said.text.lower()
                    else "misplaced: no image and no error")
        return "told" if said.text else _compared(self.path, read)
