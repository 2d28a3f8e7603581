# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of DICOM share: files written by pydicom, and a second reading of them.

The second reading is written from the standard and nibabel's documentation of DICOM orientation,
with nothing but pydicom and numpy.
"""

import os
import shutil

import numpy
import pydicom
from brainshift_testing import messages, output, scratch
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.sequence import Sequence
from vtkmodules.util.numpy_support import vtk_to_numpy

CT = "1.2.840.10008.5.1.4.1.1.2"
MR = "1.2.840.10008.5.1.4.1.1.4"
ENHANCED_MR = "1.2.840.10008.5.1.4.1.1.4.1"
EXPLICIT = pydicom.uid.ExplicitVRLittleEndian
PATIENT = "Secret^Patient"
NUMBER = "SECRET-4711"

AXIAL = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
CORONAL = ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
SAGITTAL = ((0.0, 1.0, 0.0), (0.0, 0.0, -1.0))
OBLIQUE = ((0.8, 0.6, 0.0), (-0.36, 0.48, 0.8))


def folder(name):
    """An empty folder of the test's own."""
    path = scratch("DICOM-" + name)
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    return path


def affine_of(axes=AXIAL, spacing=(0.7, 0.9), step=2.5, origin=(-11.0, 22.0, 33.0)):
    """To RAS mm, from (column, row, slice)."""
    affine = numpy.eye(4)
    affine[:3, 0] = numpy.multiply(axes[0], spacing[0])
    affine[:3, 1] = numpy.multiply(axes[1], spacing[1])
    affine[:3, 2] = numpy.cross(*axes) * step
    affine[:3, 3] = origin
    return numpy.diag((-1.0, -1.0, 1.0, 1.0)) @ affine


def read(path, **properties):
    """The reader, and what it told."""
    from paraview import simple
    with messages() as told:
        reader = simple.DICOMVolumeReader(FileName=path, **properties)
        reader.UpdatePipeline()
    return reader, told.text


def numbered(slices=4, rows=5, columns=6, dtype=numpy.int16, start=0):
    """Voxels [slice, row, column], each with a number of its own."""
    count = slices * rows * columns
    return (numpy.arange(count) + start).reshape(slices, rows, columns).astype(dtype)


def plain_header(sop_class, syntax=EXPLICIT):
    """A data set with what all images of a patient have."""
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = sop_class
    meta.MediaStorageSOPInstanceUID = pydicom.uid.generate_uid()
    meta.TransferSyntaxUID = syntax
    image = FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128,
                        is_implicit_VR=syntax == pydicom.uid.ImplicitVRLittleEndian,
                        is_little_endian=syntax != pydicom.uid.ExplicitVRBigEndian)
    image.SOPClassUID = sop_class
    image.SOPInstanceUID = meta.MediaStorageSOPInstanceUID
    image.PatientName = PATIENT
    image.PatientID = NUMBER
    image.Modality = "CT" if sop_class == CT else "MR"
    image.SeriesDescription = "Test head"
    image.SeriesNumber = 3
    image.SeriesDate = "20240229"
    image.StudyInstanceUID = "1.2.3.4"
    image.SeriesInstanceUID = "1.2.3.4.5"
    image.ImageType = ["ORIGINAL", "PRIMARY", "OTHER"]
    return image


def set_pixels(image, pixels):
    """Puts whole numbers [row, column] or [frame, row, column] into a data set."""
    syntax = image.file_meta.TransferSyntaxUID
    image.Rows, image.Columns = pixels.shape[-2:]
    image.SamplesPerPixel = 1
    image.PhotometricInterpretation = "MONOCHROME2"
    image.BitsAllocated = image.BitsStored = 8 * pixels.dtype.itemsize
    image.HighBit = image.BitsStored - 1
    image.PixelRepresentation = int(pixels.dtype.kind == "i")
    image.PixelData = pixels.astype(pixels.dtype.newbyteorder(
        ">" if syntax == pydicom.uid.ExplicitVRBigEndian else "<")).tobytes()
    image["PixelData"].VR = "OB" if pixels.dtype.itemsize == 1 else "OW"


def write_slices(path, voxels, axes=AXIAL, spacing=(0.7, 0.9), step=2.5, origin=(-11.0, 22.0, 33.0),
                 sop_class=CT, syntax=EXPLICIT, positions=None, change=None, start=1):
    """Writes one file for each slice.

    axes: directions of rows and columns, LPS. spacing: between columns and between rows, mm. step:
    from slice to slice, mm along the normal, or a vector. positions: of the slices in steps;
    default 0, 1, 2, ... change(image, index): what else to set.
    """
    step = numpy.cross(*axes) * step if numpy.isscalar(step) else numpy.asarray(step)
    for index, pixels in enumerate(voxels):
        image = plain_header(sop_class, syntax)
        along = index if positions is None else positions[index]
        image.ImagePositionPatient = [f"{number:.9g}" for number in origin + along * step]
        image.ImageOrientationPatient = [f"{number:.9g}" for axis in axes for number in axis]
        image.PixelSpacing = [f"{spacing[1]:.9g}", f"{spacing[0]:.9g}"]
        image.SliceThickness = "99"  # must not count
        image.InstanceNumber = index + start
        set_pixels(image, pixels)
        if change:
            change(image, index)
        name = f"IM{index + start:04d}.dcm"
        image.save_as(os.path.join(path, name), write_like_original=False)
    return path


def read_again(path):
    """The affine to RAS mm from (column, row, slice), and voxels [slice, row, column] in the order
    of positions along the normal, of the only series of a folder."""
    images = [pydicom.dcmread(os.path.join(path, name)) for name in sorted(os.listdir(path))]
    across, down = numpy.asarray(images[0].ImageOrientationPatient, float).reshape(2, 3)
    normal = numpy.cross(across, down)
    images.sort(key=lambda image: normal @ numpy.asarray(image.ImagePositionPatient, float))
    first, last = (numpy.asarray(image.ImagePositionPatient, float)
                   for image in (images[0], images[-1]))
    between_rows, between_columns = (float(number) for number in images[0].PixelSpacing)
    affine = numpy.eye(4)
    affine[:3, 0] = across * between_columns
    affine[:3, 1] = down * between_rows
    affine[:3, 2] = (last - first) / max(len(images) - 1, 1)
    affine[:3, 3] = first
    voxels = numpy.stack([
        image.pixel_array * float(image.get("RescaleSlope", 1))
        + float(image.get("RescaleIntercept", 0)) for image in images])
    return numpy.diag((-1.0, -1.0, 1.0, 1.0)) @ affine, voxels


def corners(shape):
    """Indices (column, row, slice) of the eight corners of voxels [slice, row, column]."""
    return numpy.array([[i, j, k] for i in (0, shape[2] - 1) for j in (0, shape[1] - 1)
                        for k in (0, shape[0] - 1)], float)


def places(image):
    """World positions, mm, of all points of an image, one a row, in the order of its scalars."""
    matrix = image.GetIndexToPhysicalMatrix()
    affine = numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])
    size = image.GetDimensions()
    z, y, x = numpy.meshgrid(*(numpy.arange(side) for side in reversed(size)), indexing="ij")
    index = numpy.stack([x, y, z, numpy.ones_like(x)]).reshape(4, -1)
    return (affine @ index)[:3].T


def scalars(proxy):
    return vtk_to_numpy(output(proxy).GetPointData().GetScalars())


def assert_placed(proxy, affine, voxels, tolerance_mm=1e-3, most=1e-6):
    """Each corner landmark of the file lies where it should, and each voxel of the image has the
    number that the file has there. `most`: how far the numbers may be apart."""
    image = output(proxy)
    shown = places(image)
    assert len(shown) == voxels.size, (image.GetDimensions(), voxels.shape)
    for corner in corners(voxels.shape):
        right = (affine @ [*corner, 1.0])[:3]
        nearest = numpy.linalg.norm(shown - right, axis=1).min()
        assert nearest <= tolerance_mm, (corner, right, nearest)
    index = numpy.linalg.solve(affine, numpy.c_[shown, numpy.ones(len(shown))].T)[:3]
    rounded = numpy.rint(index).astype(int)
    assert numpy.abs(affine[:3, :3] @ (index - rounded)).max() <= tolerance_mm
    right = voxels[rounded[2], rounded[1], rounded[0]]
    numpy.testing.assert_allclose(scalars(proxy), right, rtol=1e-6, atol=most)


def enhanced(voxels, moments=((1, 0.0),), axes=AXIAL, spacing=(0.7, 0.9), step=2.5,
             origin=(-11.0, 22.0, 33.0), order=None, rescale=None):
    """A multi-frame MR with one frame for each slice of each volume of `voxels` [time, slice, row,
    column]. moments: number of the point in time, and seconds. order: of frames in the file."""
    image = plain_header(ENHANCED_MR)
    frames = [(t, k) for t in range(len(voxels)) for k in range(len(voxels[t]))]
    frames = [frames[i] for i in order] if order is not None else frames
    measures, plane = pydicom.Dataset(), pydicom.Dataset()
    measures.PixelSpacing = [f"{spacing[1]:.9g}", f"{spacing[0]:.9g}"]
    measures.SliceThickness = "99"
    plane.ImageOrientationPatient = [f"{number:.9g}" for axis in axes for number in axis]
    shared = pydicom.Dataset()
    shared.PixelMeasuresSequence = Sequence([measures])
    shared.PlaneOrientationSequence = Sequence([plane])
    image.SharedFunctionalGroupsSequence = Sequence([shared])
    groups = []
    for t, k in frames:
        position, content, group = pydicom.Dataset(), pydicom.Dataset(), pydicom.Dataset()
        place = origin + k * step * numpy.cross(*axes)
        position.ImagePositionPatient = [f"{number:.9g}" for number in place]
        content.TemporalPositionIndex = moments[t][0]
        content.FrameAcquisitionDateTime = f"20240229101500.{round(moments[t][1] * 1000):03d}"
        group.PlanePositionSequence = Sequence([position])
        group.FrameContentSequence = Sequence([content])
        if rescale:
            values = pydicom.Dataset()
            values.RescaleSlope, values.RescaleIntercept = rescale(t, k)
            values.RescaleType = "US"
            group.PixelValueTransformationSequence = Sequence([values])
        groups.append(group)
    image.PerFrameFunctionalGroupsSequence = Sequence(groups)
    image.NumberOfFrames = len(frames)
    image.InstanceNumber = 1
    set_pixels(image, numpy.stack([voxels[t][k] for t, k in frames]))
    return image
