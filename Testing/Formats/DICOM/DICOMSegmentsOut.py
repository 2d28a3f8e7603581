# SPDX-License-Identifier: BSD-3-Clause
# Proves that labels leave as a segmentation of the patient's study: pydicom and our reader find
# each label within 1e-3 mm of where it lay, dciodvfy and GDCM find a file of the standard, and what
# cannot be written is named.
import os
import shutil
import subprocess

import numpy
import pydicom
from brainshift_testing import (assert_says, data, load_plugin, messages, output, run_tests,
                                scratch, volume, voxels)
from dicom_testing import AXIAL, CORONAL, MR, OBLIQUE, SAGITTAL, enhanced, write_slices
from dicom_testing import assert_placed, folder
from vtkmodules.vtkCommonCore import vtkIntArray, vtkStringArray, vtkUnsignedCharArray

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, DICOMVolumeReader, FreeFormDeformation, OpenDataFile, SaveData)

SHAPE = (4, 5, 7)  # slices, rows, columns
NOTICE = "research, not for clinical use"


def scan(axes=AXIAL, name="scan", change=None):
    """A folder with the patient's scan of SHAPE."""
    def named(image, index):
        image.FrameOfReferenceUID, image.SpecificCharacterSet = "1.2.3.4.9", "ISO_IR 100"
        image.PatientName, image.StudyDate = "Müller^Anna", "20240229"
        if change:
            change(image, index)

    return write_slices(folder(name), numpy.arange(140).reshape(SHAPE).astype(numpy.int16),
                        axes=axes, sop_class=MR, change=named)


def labelled(path, values, names=(), terms=()):
    """Labels on the grid of a series: values [z, y, x] of its image."""
    image = output(OpenDataFile(path))
    spacing, origin = image.GetSpacing(), image.GetOrigin()
    matrix = image.GetDirectionMatrix()
    direction = [matrix.GetElement(i, j) for i in range(3) for j in range(3)]
    source = volume(values, origin=origin, spacing=spacing, direction=direction)
    fields = output(source).GetFieldData()
    arrays = vtkIntArray(), vtkStringArray(), vtkUnsignedCharArray(), vtkStringArray()
    for array, name in zip(arrays, ("Values", "Names", "Colors", "Terms")):
        array.SetName("Label" + name)
    arrays[2].SetNumberOfComponents(3)
    for i, (value, name) in enumerate(names):
        arrays[0].InsertNextValue(value)
        arrays[1].InsertNextValue(name)
        arrays[2].InsertNextTuple3(10 * value, 255 - value, 90)
        arrays[3].InsertNextValue(terms[i] if terms else "")
    world = vtkStringArray()
    world.SetName("WorldAxes")
    world.InsertNextValue("RAS")
    for array in (*(arrays if names else ()), world):
        fields.AddArray(array)
    source.MarkModified(source.SMProxy)
    source.UpdatePipeline()
    return source


def image_shape(path):
    return output(OpenDataFile(path)).GetDimensions()[::-1]


def saved(source, like, name="labels.seg.dcm", **options):
    """The path of a segmentation, and what was told."""
    path = os.path.join(folder("segments-out"), name)
    with messages() as told:
        brainshift.save_segmentation(source, path, like, **options)
    return path, told.text


def random_labels(shape, most=3, seed=2):
    return numpy.random.default_rng(seed).integers(0, most + 1, shape).astype(numpy.uint8)


def points_of(image):
    """World positions, mm, RAS, and segments of the bits that are set, by the standard."""
    bits = numpy.unpackbits(numpy.frombuffer(image.PixelData, numpy.uint8), bitorder="little")
    count = image.NumberOfFrames * image.Rows * image.Columns
    bits = bits[:count].reshape(-1, image.Rows, image.Columns)
    shared = image.SharedFunctionalGroupsSequence[0]
    across, down = numpy.asarray(
        shared.PlaneOrientationSequence[0].ImageOrientationPatient, float).reshape(2, 3)
    between_rows, between_columns = (
        float(number) for number in shared.PixelMeasuresSequence[0].PixelSpacing)
    points, segments = [], []
    for frame, group in zip(bits, image.PerFrameFunctionalGroupsSequence):
        row, column = numpy.nonzero(frame)
        place = numpy.asarray(group.PlanePositionSequence[0].ImagePositionPatient, float)
        points.append(place + numpy.outer(column * between_columns, across)
                      + numpy.outer(row * between_rows, down))
        number = group.SegmentIdentificationSequence[0].ReferencedSegmentNumber
        segments += len(row) * [number]
    return numpy.concatenate(points) * (-1, -1, 1), numpy.array(segments)


def affine_of(source):
    matrix = output(source).GetIndexToPhysicalMatrix()
    return numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


def test_each_label_lies_where_it_lay():
    for axes in (AXIAL, CORONAL, SAGITTAL, OBLIQUE):
        like = scan(axes)
        labels = random_labels(image_shape(like))
        source = labelled(like, labels, [(1, "one"), (2, "two"), (3, "three")])
        path, told = saved(source, like)
        assert not told, told
        image = pydicom.dcmread(path)
        points, segments = points_of(image)
        assert len(points) == (labels > 0).sum()
        index = numpy.linalg.solve(affine_of(source), numpy.c_[points, numpy.ones(len(points))].T)
        nearest = numpy.rint(index[:3]).astype(int)
        assert numpy.abs(affine_of(source)[:3, :3] @ (index[:3] - nearest)).max() < 1e-3
        assert numpy.array_equal(labels[nearest[2], nearest[1], nearest[0]], segments)
        # Frames lie in the planes of the scan's images and refer to them.
        instances = {item.SOPInstanceUID: item for item in (
            pydicom.dcmread(os.path.join(like, name)) for name in os.listdir(like))}
        for group in image.PerFrameFunctionalGroupsSequence:
            [derivation] = group.DerivationImageSequence
            one = instances[derivation.SourceImageSequence[0].ReferencedSOPInstanceUID]
            numpy.testing.assert_allclose(
                group.PlanePositionSequence[0].ImagePositionPatient, one.ImagePositionPatient,
                atol=1e-3)
        read = DICOMVolumeReader(FileName=path)
        assert_placed(read, affine_of(source), labels, most=0)


def test_study_names_colours_and_terms_go_along():
    like = scan()
    terms = ["SCT^49755003^Morphologically Abnormal Structure~SCT^4147007^Mass~^^",
             "SCT^123037004^Anatomical Structure~SCT^64033007^Kidney~SCT^7771000^Left~"
             "SCT^818983003^Abdomen~SCT^255554000^Dorsal"]
    labels = random_labels(image_shape(like), 2)
    path, told = saved(labelled(like, labels, [(1, "Tumour"), (2, "Nière")], terms), like)
    assert not told, told
    image = pydicom.dcmread(path)
    one = pydicom.dcmread(os.path.join(like, sorted(os.listdir(like))[0]))
    for name in ("PatientName", "PatientID", "StudyInstanceUID", "FrameOfReferenceUID",
                 "StudyDate"):
        assert str(image[name].value) == str(one[name].value), name
    assert image.SeriesInstanceUID != one.SeriesInstanceUID
    assert image.SeriesNumber == 1003 and image.Modality == "SEG"
    assert image.SeriesDescription.startswith(NOTICE)
    assert image.SpecificCharacterSet == "ISO_IR 192"
    assert [item.SegmentLabel for item in image.SegmentSequence] == ["Tumour", "Nière"]
    [series] = image.ReferencedSeriesSequence
    assert series.SeriesInstanceUID == one.SeriesInstanceUID
    assert len(series.ReferencedInstanceSequence) == SHAPE[0]
    type_of = image.SegmentSequence[1].SegmentedPropertyTypeCodeSequence[0]
    assert type_of.CodeMeaning == "Kidney"
    assert type_of.SegmentedPropertyTypeModifierCodeSequence[0].CodeMeaning == "Left"
    assert "AnatomicRegionSequence" not in image.SegmentSequence[0]
    [region] = image.SegmentSequence[1].AnatomicRegionSequence
    assert region.CodeValue == "818983003", region
    assert region.AnatomicRegionModifierSequence[0].CodeMeaning == "Dorsal"

    fields = output(DICOMVolumeReader(FileName=path)).GetFieldData()
    names, colours, codes = (
        fields.GetAbstractArray("Label" + word) for word in ("Names", "Colors", "Terms"))
    assert [names.GetValue(i) for i in range(2)] == ["Tumour", "Nière"]
    assert [codes.GetValue(i) for i in range(2)] == [terms[0], terms[1]]
    assert [colours.GetTuple3(i) for i in range(2)] == [(10, 254, 90), (20, 253, 90)]


def test_colours_come_back_as_they_went():
    like = scan()
    values = random_labels(image_shape(like), 200)
    path, _ = saved(labelled(like, values, [(i, str(i)) for i in range(1, 25)]), like)
    colours = output(DICOMVolumeReader(FileName=path)).GetFieldData().GetAbstractArray(
        "LabelColors")
    for i in range(24):
        assert colours.GetTuple3(i) == (10 * (i + 1), 254 - i, 90), i


def assert_of_the_standard(path):
    judged = subprocess.run([os.environ["BRAINSHIFT_DCIODVFY"], path], capture_output=True,
                            text=True, check=False)
    said = judged.stdout + judged.stderr
    assert "Error" not in said and "Segmentation" in said, said


def test_other_programs_find_a_file_of_the_standard():
    like = scan()
    path, _ = saved(labelled(like, random_labels(image_shape(like)), [(1, "one")]), like)
    assert_of_the_standard(path)
    shown = subprocess.run([os.environ["BRAINSHIFT_GDCMINFO"], path], capture_output=True,
                           text=True, check=False)
    assert_says(shown.stdout, "MediaStorage is 1.2.840.10008.5.1.4.1.1.66.4",
                "ScalarType found   :SINGLEBIT")


def test_labels_through_the_bend_are_those_of_the_baked_volume():
    like = scan()
    labels = numpy.zeros(image_shape(like), numpy.uint8)
    labels[1:3, 1:4, 2:5] = 1
    bent = FreeFormDeformation(Input=labelled(like, labels, [(1, "Tumour")]),
                               LatticeDimensions=(4, 4, 4),
                               Strokes=brainshift.soft((9, -24, 36), (1.5, 0, 0), 8.0))
    baked = BakeDeformation(Input=bent)
    path, told = saved(baked, like)
    assert not told, told
    read = DICOMVolumeReader(FileName=path)
    right = voxels(baked)
    assert right.max() == 1 and not numpy.array_equal(right, labels)
    shown, whole = voxels(read), right[right.any(axis=(1, 2))]
    numpy.testing.assert_array_equal(shown, whole)
    assert output(read).GetFieldData().GetAbstractArray("LabelNames").GetValue(0) == "Tumour"


def test_a_multi_frame_scan_is_referred_to_by_frames():
    path = os.path.join(folder("multi"), "scan.dcm")
    image = enhanced(numpy.arange(140).reshape(1, *SHAPE).astype(numpy.int16))
    image.FrameOfReferenceUID = "1.2.3.4.9"
    image.save_as(path, write_like_original=False)
    labels = random_labels(image_shape(path), 1)
    made, told = saved(labelled(path, labels), path)
    assert not told, told
    groups = pydicom.dcmread(made).PerFrameFunctionalGroupsSequence
    assert [group.DerivationImageSequence[0].SourceImageSequence[0].ReferencedFrameNumber
            for group in groups] == [1, 2, 3, 4]


def test_a_mosaic_is_referred_to_as_one_picture():
    like = data("dcm-qa-mosaic", "heads_first-00001.dcm")
    labels = random_labels(image_shape(like), 1)
    made, told = saved(labelled(like, labels), like)
    assert not told, told
    assert_of_the_standard(made)
    groups = pydicom.dcmread(made).PerFrameFunctionalGroupsSequence
    sources = [group.DerivationImageSequence[0].SourceImageSequence[0] for group in groups]
    assert len(sources) == 36
    for source in sources:
        assert "ReferencedFrameNumber" not in source  # which only multi-frame images have
        assert source.SpatialLocationsPreserved == "NO"  # its tiles are beside each other


def test_other_numbers_are_said():
    like = scan()
    labels = random_labels(image_shape(like)) * 500.0
    source = labelled(like, labels.astype(numpy.float32))
    path, told = saved(source, like)
    assert_says(told, "Segments are numbered from 1 to 3: label 500 became segment 1, and so on")
    assert [item.SegmentLabel for item in pydicom.dcmread(path).SegmentSequence] == [
        "Label 500", "Label 1000", "Label 1500"]
    assert_placed(DICOMVolumeReader(FileName=path), affine_of(source), labels / 500, most=0)


def test_names_that_are_cut_are_said():
    like = scan()
    labels = random_labels(image_shape(like), 2)
    names = "a" * 63 + "ä and more", "ö" * 64
    path, told = saved(labelled(like, labels, [(1, names[0]), (2, names[1])]), like)
    assert_says(told, "1 name is longer than the 64 letters of a SegmentLabel and cut",
                "a" * 63 + "ä'")
    assert [item.SegmentLabel for item in pydicom.dcmread(path).SegmentSequence] == [
        "a" * 63 + "ä", "ö" * 64]


def test_characters_that_are_not_known_become_question_marks():
    def greek(image, _):
        image.SpecificCharacterSet, image.PatientName = "ISO_IR 126", "Αλφα"

    like = scan(change=greek, name="greek")
    path, told = saved(
        labelled(like, random_labels(image_shape(like), 1), [(1, "Läsion")]), like)
    assert_says(told, "characters ISO_IR 126, which lack letters of the labels")
    image = pydicom.dcmread(path)
    assert image.SegmentSequence[0].SegmentLabel == "L??sion"
    assert str(image.PatientName) == "Αλφα"


def test_the_window_writes_by_the_ending():
    like = scan()
    labels = random_labels(image_shape(like))
    path = scratch("window.seg.dcm")
    SaveData(path, labelled(like, labels, [(1, "one")]), Like=like)
    assert pydicom.dcmread(path).SOPClassUID == pydicom.uid.SegmentationStorage


def fails(source, *words, like=None, name="labels.seg.dcm", **options):
    path = os.path.join(folder("segments-out"), name)
    try:
        brainshift.save_segmentation(source, path, like, **options)
    except (OSError, ValueError) as problem:
        assert_says(str(problem), *words)
        assert not os.path.exists(path) and not os.listdir(os.path.dirname(path))
        return
    raise AssertionError("written, without " + words[0])


def test_what_cannot_be_written_is_named():
    like = scan()
    shape = image_shape(like)
    good = labelled(like, random_labels(shape))
    fails(good, "Like is missing", like="")
    fails(good, "is no DICOM image", like=__file__)
    fails(good, "must end in .seg.dcm", like=like, name="labels.dcm")
    fails(labelled(like, random_labels(shape) * 0.5), "has the value", "Threshold it", like=like)
    fails(labelled(like, random_labels(shape) - 2.0), "has the value -", "from 0 to 65535",
          like=like)
    fails(labelled(like, random_labels(shape) * 30000.0), "has the value", "65535", like=like)
    fails(labelled(like, random_labels(shape) * numpy.nan), "has the value", like=like)
    fails(labelled(like, random_labels(shape) * 0), "has no voxel above 0", like=like)
    fails(labelled(like, numpy.ones((*shape, 3), numpy.uint8)), "3 components", like=like)
    unknown = volume(random_labels(shape))
    fails(unknown, "The world axes of the input are unknown", like=like)
    shutil.rmtree(like)


run_tests(globals())
