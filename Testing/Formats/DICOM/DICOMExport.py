# SPDX-License-Identifier: BSD-3-Clause
# Proves that a volume leaves as a DICOM series of the patient's study: pydicom, GDCM and our reader
# find each voxel within 1e-3 mm of where it lay, with its value, in images that are new and marked.
import os
import shutil
import subprocess

import numpy
import pydicom
from brainshift_testing import (assert_says, data, load_plugin, messages, output, picture,
                                run_tests, scratch, show_volume, view_along, volume, voxels)
from dicom_testing import assert_placed as assert_read
from dicom_testing import enhanced, set_pixels
from pydicom.dataset import FileDataset, FileMetaDataset
from pydicom.sequence import Sequence
from saving_testing import assert_fails, assert_nothing_left, full_disk
from vtkmodules.vtkCommonCore import vtkStringArray, vtkUnsignedCharArray

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, Delete, FreeFormDeformation, OpenDataFile, SaveData)

OBLIQUE = numpy.array(((0.8, -0.36, 0.48), (0.6, 0.48, -0.64), (0.0, 0.8, 0.6)))
DIRECTIONS = {"along": numpy.eye(3), "oblique": OBLIQUE,
              "mirrored": OBLIQUE @ numpy.diag((1.0, -1.0, 1.0)),
              "turned": numpy.diag((1.0, -1.0, -1.0)),
              "sagittal": numpy.array(((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0))),
              "sagittal and oblique": OBLIQUE[:, (1, 2, 0)],
              "coronal and mirrored": OBLIQUE[:, (0, 2, 1)]}
SHAPE = (4, 5, 7)
STORED = {"CT": "1.2.840.10008.5.1.4.1.1.2", "MR": "1.2.840.10008.5.1.4.1.1.4"}
PET, SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.128", "1.2.840.10008.5.1.4.1.1.7"
FRAME = "1.2.3.4.5.6"
NOTICE = "research, not for clinical use"


def like(modality="MR", implicit=False):
    """A file of the patient's scan."""
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID = STORED[modality]
    meta.MediaStorageSOPInstanceUID = "1.2.3.9"
    meta.TransferSyntaxUID = (pydicom.uid.ImplicitVRLittleEndian if implicit
                              else pydicom.uid.ExplicitVRLittleEndian)
    scan = FileDataset(None, {}, file_meta=meta, preamble=b"\0" * 128)
    scan.is_little_endian, scan.is_implicit_VR = True, implicit
    scan.SOPClassUID, scan.SOPInstanceUID = STORED[modality], "1.2.3.9"
    scan.SpecificCharacterSet = "ISO_IR 192"
    scan.PatientName, scan.PatientID = "Müller^Anna", "4711"
    scan.PatientBirthDate, scan.PatientSex = "19700131", "F"
    scan.StudyInstanceUID, scan.StudyID, scan.StudyDate = "1.2.3.4", "7", "20240229"
    scan.SeriesInstanceUID, scan.SeriesNumber = "1.2.3.4.5", 3
    scan.SeriesDescription = "T1 head"
    scan.FrameOfReferenceUID, scan.Modality = FRAME, modality
    set_pixels(scan, numpy.zeros((2, 3), numpy.int16))
    name = scratch(f"like-{modality}-{implicit}.dcm")
    scan.save_as(name, write_like_original=False)
    return name


def changed_scan(name, change):
    scan = pydicom.dcmread(like())
    change(scan)
    scan.save_as(name, write_like_original=False)
    return name


def without_rows(scan):  # of structures, reports and presentations
    del scan.Rows, scan.Columns, scan.PixelData
    scan.Modality = "RTSTRUCT"


def without_pixels(scan):
    del scan.PixelData


def segments(scan):
    scan.SOPClassUID, scan.Modality = "1.2.840.10008.5.1.4.1.1.66.4", "SEG"
    scan.SegmentationType = "BINARY"


NO_IMAGES = {"A1-structures.dcm": without_rows, "A2-empty.dcm": without_pixels,
             "A3-segments.dcm": segments}


def source_of(array, direction=OBLIQUE, world="RAS"):
    source = volume(array, origin=(-90.5, 12.25, -300.75), spacing=(0.7, 1.1, 2.5),
                    direction=direction.ravel())
    if world:
        word = vtkStringArray()
        word.SetName("WorldAxes")
        word.InsertNextValue(world)
        output(source).GetFieldData().AddArray(word)
        source.MarkModified(source.SMProxy)
        source.UpdatePipeline()
    return source


def fresh(name):
    path = scratch("export-" + name)
    shutil.rmtree(path, ignore_errors=True)
    return path


def numbers(dtype):
    top = 250 if dtype == numpy.uint8 else 65535 if dtype == numpy.uint16 else 32000
    low = -32000 if numpy.dtype(dtype).kind in "if" else 0
    values = numpy.linspace(low, top, int(numpy.prod(SHAPE))).reshape(SHAPE)
    return (values if dtype == numpy.float32 else numpy.rint(values)).astype(dtype)


def slices_of(folder):
    names = sorted(os.listdir(folder))
    return [pydicom.dcmread(os.path.join(folder, name)) for name in names]


def points_and_values(images):
    """World positions, mm, RAS, and values of all pixels, from the words of the standard."""
    points, values = [], []
    for image in images:
        place = numpy.asarray(image.ImagePositionPatient, float)
        across, down = numpy.asarray(image.ImageOrientationPatient, float).reshape(2, 3)
        between_rows, between_columns = (float(number) for number in image.PixelSpacing)
        row, column = numpy.mgrid[0:image.Rows, 0:image.Columns]
        points.append(place + (column.ravel() * between_columns)[:, None] * across
                      + (row.ravel() * between_rows)[:, None] * down)
        values.append(image.pixel_array.ravel() * float(image.RescaleSlope)
                      + float(image.RescaleIntercept))
    return numpy.concatenate(points) * (-1, -1, 1), numpy.concatenate(values)


def affine_of(source):
    matrix = output(source).GetIndexToPhysicalMatrix()
    return numpy.array([[matrix.GetElement(i, j) for j in range(4)] for i in range(4)])


def assert_placed(images, source, array, most, case):
    """Each pixel lies on a voxel of its own, within 1e-3 mm, and has its value, within `most`."""
    points, values = points_and_values(images)
    affine = affine_of(source)
    index = numpy.linalg.solve(affine, numpy.c_[points, numpy.ones(len(points))].T)[:3]
    nearest = numpy.rint(index).astype(int)
    error = numpy.linalg.norm(affine[:3, :3] @ (index - nearest), axis=0).max()
    assert error <= 1e-3, (case, error)
    assert len({tuple(voxel) for voxel in nearest.T}) == array.size, case
    right = array[nearest[2], nearest[1], nearest[0]].astype(float)
    assert numpy.abs(values - right).max() <= most, (case, numpy.abs(values - right).max())


def test_pydicom_finds_the_same_voxels_at_the_same_places():
    scan = like()
    for kind, direction in DIRECTIONS.items():
        for dtype in (numpy.uint8, numpy.int16, numpy.uint16, numpy.float32):
            array = numbers(dtype)
            source = source_of(array, direction)
            folder = fresh("places")
            brainshift.save_dicom(source, folder, scan)
            images = slices_of(folder)
            assert len(images) == SHAPE[0]
            step = 64000 / 65535 if dtype == numpy.float32 else 0.0
            assert_placed(images, source, array, 0.51 * step, (kind, dtype))
            if kind == "along":
                assert images[0].ImageOrientationPatient == [1, 0, 0, 0, 1, 0], "as stations show"


def assert_our_reader_finds(source, array, most):
    """Writes a series; our reader, which reads it without a word, has the voxels in place."""
    folder = fresh("ours")
    brainshift.save_dicom(source, folder, like())
    with messages() as said:
        reader = OpenDataFile(folder)
        reader.UpdatePipeline()
    assert not said.text, said.text
    assert reader.GetXMLName() == "DICOMFileReader", reader.GetXMLName()
    assert_read(reader, affine_of(source), array, most=most)
    assert output(reader).GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
    names = list(reader.GetProperty("SeriesList"))
    assert len(names) == 1, names
    assert_says(names[0], "1003, " + NOTICE, "T1 head", "MR")
    Delete(reader)


def test_our_reader_finds_the_same_voxels_at_the_same_places():
    for kind, direction in DIRECTIONS.items():
        for dtype in (numpy.uint8, numpy.int16, numpy.uint16, numpy.float32):
            print(kind, dtype, flush=True)
            array = numbers(dtype)
            step = 64000 / 65535 if dtype == numpy.float32 else 0.0
            assert_our_reader_finds(source_of(array, direction), array, 0.51 * step + 1e-6)


def test_our_reader_finds_a_bent_volume():
    for direction in (DIRECTIONS["oblique"], DIRECTIONS["sagittal"]):
        array = numpy.random.default_rng(11).uniform(-50, 900, (14, 15, 16)).astype(numpy.float32)
        source = source_of(array, direction)
        bent = FreeFormDeformation(Input=source, Strokes=brainshift.soft(
            output(source).GetCenter(), (2.0, 1.5, -1.0), 12.0))
        baked = BakeDeformation(Input=bent)
        changed = voxels(baked)
        assert (numpy.abs(changed - array) > 10.0).mean() > 0.2, "it was bent"
        step = (changed.max() - changed.min()) / 65535
        assert_our_reader_finds(baked, changed, 0.51 * step)


def test_coronal_slices_have_the_head_on_top():
    folder = fresh("coronal")
    to_the_head = numpy.array(((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
    source = source_of(numbers(numpy.int16), to_the_head)
    brainshift.save_dicom(source, folder, like())
    assert slices_of(folder)[0].ImageOrientationPatient == [1, 0, 0, 0, 0, -1]
    assert_placed(slices_of(folder), source, numbers(numpy.int16), 0.0, "coronal")


def test_volumes_of_the_lps_world():
    array = numbers(numpy.int16)
    folders = fresh("lps"), fresh("ras")
    half_turn = numpy.diag((-1.0, -1.0, 1.0))
    brainshift.save_dicom(source_of(array, world="LPS"), folders[0], like())
    brainshift.save_dicom(source_of(array, world=""), folders[1], like(), world="LPS")
    right = source_of(array)
    for folder in folders:
        points, _ = points_and_values(slices_of(folder))
        center = numpy.array(output(right).GetCenter()) @ half_turn
        assert numpy.allclose(points.mean(axis=0), center, atol=1e-3)


def test_an_enhanced_scan_gives_slices_what_its_groups_say():
    """RepetitionTime and EchoTrainLength, EchoTime and empty ones: a slice of MR must have them."""
    timing, echo = pydicom.Dataset(), pydicom.Dataset()
    timing.RepetitionTime, timing.EchoTrainLength = "2300", "7"
    echo.EffectiveEchoTime = 2.98
    for whole in (True, False):
        scan = enhanced(numbers(numpy.int16)[None])
        shared = scan.SharedFunctionalGroupsSequence[0]
        if whole:
            shared.MRTimingAndRelatedParametersSequence = Sequence([timing])
            shared.MREchoSequence = Sequence([echo])
        name = scratch("like-enhanced.dcm")
        scan.save_as(name, write_like_original=False)
        folder = fresh("enhanced")
        brainshift.save_dicom(source_of(numbers(numpy.int16)), folder, name)
        for image in slices_of(folder):
            said = image.RepetitionTime, image.EchoTime, image.EchoTrainLength
            assert said == ((2300, 2.98, 7) if whole else (None, None, None)), said


def test_gdcm_reads_the_series():
    folder = fresh("gdcm")
    source = source_of(numbers(numpy.int16))
    brainshift.save_dicom(source, folder, like())
    name = os.path.join(folder, "IM00002.dcm")
    said = subprocess.run([os.environ["BRAINSHIFT_GDCMINFO"], name], capture_output=True, text=True,
                          check=True).stdout
    place = pydicom.dcmread(name).ImagePositionPatient
    line = next(line for line in said.splitlines() if line.startswith("Origin"))
    found = [float(number) for number in line.split("(")[1].rstrip(")").split(",")]
    assert numpy.allclose(found, numpy.asarray(place, float), atol=1e-3), (found, place)
    assert_says(said, "MR Image Storage", "Dimensions: (7,5,1)", "ScalarType found   :INT16")


def test_patient_and_study_stay_and_the_series_is_new():
    for modality in STORED:
        for implicit in (False, True):
            folders = fresh("one"), fresh("two")
            for folder in folders:
                brainshift.save_dicom(source_of(numbers(numpy.int16)), folder,
                                      like(modality, implicit))
            one, two = (slices_of(folder) for folder in folders)
            for image in one:
                assert str(image.PatientName) == "Müller^Anna" and image.PatientID == "4711"
                assert image.PatientBirthDate == "19700131" and image.PatientSex == "F"
                assert image.StudyInstanceUID == "1.2.3.4" and image.StudyDate == "20240229"
                assert image.FrameOfReferenceUID == FRAME and image.Modality == modality
                assert image.SOPClassUID == STORED[modality]
                assert image.file_meta.MediaStorageSOPInstanceUID == image.SOPInstanceUID
                assert image.ImageType[:2] == ["DERIVED", "SECONDARY"]
                assert image.SeriesDescription == NOTICE + ": T1 head"
                assert image.SeriesNumber == 1003 and image.SpacingBetweenSlices == 2.5
                assert image.BitsAllocated == 16 and image.BurnedInAnnotation == "NO"
            assert [image.InstanceNumber for image in one] == [1, 2, 3, 4]
            assert len({image.SeriesInstanceUID for image in one}) == 1
            assert len({image.SOPInstanceUID for image in one + two} | {"1.2.3.9"}) == 9
            assert len({"1.2.3.4.5", one[0].SeriesInstanceUID, two[0].SeriesInstanceUID}) == 3


def test_save_data_writes_a_folder_and_like_may_be_one():
    scans = fresh("scans")
    os.makedirs(scans)
    with open(os.path.join(scans, "A.txt"), "w", encoding="utf-8") as file:
        file.write("no image")
    for name, change in NO_IMAGES.items():
        changed_scan(os.path.join(scans, name), change)
    shutil.copy(like("CT"), os.path.join(scans, "B.dcm"))
    folder = fresh("save_data")
    array = numbers(numpy.int16)
    source = source_of(array)
    SaveData(folder + ".dcm", proxy=source, Like=scans)
    images = slices_of(folder)
    assert_placed(images, source, array, 0.0, "Save Data")
    assert images[0].Modality == "CT" and images[0].SOPClassUID == STORED["CT"]


def test_like_must_be_an_image_of_a_scanner():
    folder = fresh("no-image")
    for name, change in NO_IMAGES.items():
        scan = changed_scan(scratch(name), change)
        assert_fails(lambda: brainshift.save_dicom(  # noqa: B023
            source_of(numbers(numpy.int16)), folder, scan), f"Like is {scan}, which is no DICOM "
            "image", "segmentation" if "segments" in name else "it lacks Rows, Columns or pixels")
        assert not os.path.exists(folder)


def test_small_numbers_that_are_bright_stay_so():
    mark = vtkUnsignedCharArray()
    mark.SetName("SmallIsBright")
    mark.InsertNextValue(1)
    array = numbers(numpy.int16)
    source = source_of(array)
    output(source).GetFieldData().AddArray(mark)
    source.MarkModified(source.SMProxy)
    for one in (source, BakeDeformation(Input=FreeFormDeformation(Input=source))):
        folder = fresh("bright")
        with messages() as told:
            brainshift.save_dicom(one, folder, like())
        assert not told.text, told.text
        images = slices_of(folder)
        assert {image.PhotometricInterpretation for image in images} == {"MONOCHROME1"}
        assert_placed(images, source, array, 0.0, "MONOCHROME1")
    with messages() as told:
        reader = OpenDataFile(folder)
        reader.UpdatePipeline()
    assert_says(told.text, "has small numbers that are bright", "MONOCHROME1")
    assert output(reader).GetFieldData().GetArray("SmallIsBright").GetValue(0) == 1


def test_pet_keeps_its_unit():
    def pet(units):
        def change(scan):
            scan.SOPClassUID, scan.Modality = PET, "PT"
            if units:
                scan.Units = units
        return change

    for units, kind in (("BQML", PET), ("", SECONDARY_CAPTURE)):
        folder = fresh("pet")
        brainshift.save_dicom(source_of(numbers(numpy.int16)), folder,
                              changed_scan(scratch("like-pet.dcm"), pet(units)))
        for image in slices_of(folder):
            assert image.SOPClassUID == kind and image.Modality == "PT"
            assert image.get("Units", "") == units
    brainshift.save_dicom(source_of(numbers(numpy.int16)), fresh("mr"), changed_scan(
        scratch("like-mr.dcm"), lambda scan: setattr(scan, "Units", "BQML")))
    assert "Units" not in slices_of(scratch("export-mr"))[0]


def test_what_cannot_be_written_says_so_and_leaves_nothing():
    array = numbers(numpy.int16)
    folder = fresh("refused")
    scan = like()

    def save(changed=array, world="RAS", where=folder, as_in=scan):
        return lambda: brainshift.save_dicom(source_of(changed, world=world), where, as_in)

    spoiled = array.astype(numpy.float32)
    spoiled[1, 2, 3] = numpy.nan
    assert_fails(save(spoiled), "not finite")
    assert_fails(save(numpy.stack([array] * 3, axis=-1)), "3 components", "must have 1")
    assert_fails(save(world=""), "world axes of the input are unknown", "set World")
    assert_fails(save(as_in=__file__), "Like is ", "DICOMExport.py", "no DICOM image",
                 "choose another")
    assert_fails(save(as_in=folder + ".none"), "export-refused.none, which does not exist")
    assert_fails(save(as_in=os.path.dirname(__file__)), "no DICOM image that can be read")
    assert_fails(save(where=folder + ".dcm", as_in=""), "Like is missing")
    assert_fails(save(where=os.path.join(folder, "deeper")), "deeper cannot be written: ",
                 "No such file")
    assert not os.path.exists(folder)
    brainshift.save_dicom(source_of(array), folder, scan)
    before = sorted(os.listdir(folder))
    assert_fails(save(), "holds files already")
    assert sorted(os.listdir(folder)) == before


def replaced(scan, name, *changes):
    """A copy of a file of which bytes are replaced: (where, what)."""
    with open(scan, "rb") as file:
        content = bytearray(file.read())
    for where, what in changes:
        content[where:where + len(what)] = what
    path = scratch(f"like-{name}.dcm")
    with open(path, "wb") as file:
        file.write(content)
    return path


def test_a_damaged_file_is_refused_and_nothing_is_lost():
    array = numbers(numpy.int16)
    source, folder, never = source_of(array), fresh("kept"), fresh("never")
    brainshift.save_dicom(source, folder, like())
    written = {name: open(os.path.join(folder, name), "rb").read() for name in os.listdir(folder)}
    strokes = list(brainshift.soft(output(source).GetCenter(), (2.0, 1.5, -1.0), 12.0))
    bent = FreeFormDeformation(Input=source, Strokes=strokes)
    view = view_along((0.3, -0.4, -1.0), output(source).GetCenter(), 60.0, half_height=9.0, size=64)
    show_volume(bent, view, "Deformed Volume", [-32000, 0, 0, 0, 32000, 1, 1, 1],
                [-32000, 0, 0.5, 0, 32000, 1, 0.5, 0])
    shown, changed = picture(view), voxels(bent)
    scan = data("pydicom-data", "emri_small_jpeg_ls_lossless.dcm")
    with open(scan, "rb") as file:
        content = file.read()
    study = content.index(b"\x20\0\x0d\0UI")
    name = content.index(b"\x10\0\x10\0PN")
    sequence = (b"SQ\0\0\x14\0\0\0" b"\xfe\xff\0\xe0\x0c\0\0\0"  # of one item
                b"\x10\0\x20\0LO\4\0004711")
    for case, (spoiled, *words) in {
            "a length": (replaced(scan, "length", (1057, b"\xe8")), "is damaged at byte 1058",
                         "of 42834", "its length is wrong"),
            "the first tag": (replaced(scan, "tag", (133, b"\xff")), "is damaged at byte 1"),
            "a command": (replaced(scan, "command", (content.index(b"\x08\0\x05\0CS"), b"\0")),
                          "is damaged at byte"),
            "no study": (replaced(scan, "study", (study + 2, b"\x0c")), "has no study (0020,000D)"),
            "a byte": (replaced(scan, "byte", (content.index(b"ISO_IR 100") + 4, b"\0")),
                       "has the byte 0 in its attribute (0008,0005)", "in ASCII (CS)"),
            "a sequence": (replaced(scan, "sequence", (name + 4, sequence)),
                           "has a sequence as its attribute (0010,0010)"),
    }.items():
        print(case, flush=True)
        for where in (never, folder):
            assert_fails(lambda: brainshift.save_dicom(source, where, spoiled),  # noqa: B023
                         f"Like is {spoiled}, which ", "choose another image", *words)
    assert not os.path.exists(never)
    assert_nothing_left(folder)
    assert {name: open(os.path.join(folder, name), "rb").read()
            for name in os.listdir(folder)} == written
    assert list(bent.Strokes) == strokes and numpy.array_equal(voxels(bent), changed)
    assert numpy.array_equal(picture(view), shown)
    for proxy in (view, bent):
        Delete(proxy)


def test_values_that_cannot_be_kept_are_refused():
    """A sequence in place of a text, and a text whose length does not fit into 16 bits."""
    source, scan = source_of(numbers(numpy.int16)), pydicom.dcmread(like(implicit=True))
    path = scratch("like-long.dcm")
    for letters in (65534, 65536, 1 << 21):
        scan.PatientName = "A" * letters
        scan.save_as(path, write_like_original=False)
        folder = fresh("long")
        if letters > 65534:
            assert_fails(lambda: brainshift.save_dicom(source, folder, path),
                         f"has {letters} bytes in its attribute (0010,0010)", "at most 65534")
            assert not os.path.exists(folder)
        else:
            brainshift.save_dicom(source, folder, path)
            assert str(slices_of(folder)[0].PatientName) == scan.PatientName


def test_a_full_disk_leaves_no_series():
    folder = fresh("full")
    scan = like()
    source = source_of(numbers(numpy.int16))
    brainshift.save_dicom(source, folder, scan)
    size = os.path.getsize(os.path.join(folder, "IM00001.dcm"))
    folder = fresh("full")
    for limit in (200, size - 100):  # the random UIDs of a file differ in length
        with full_disk(limit):
            assert_fails(lambda: brainshift.save_dicom(source, folder, scan), "cannot be written: ")
        assert not os.path.exists(folder), limit
    assert_nothing_left(folder)


run_tests(globals())
