# SPDX-License-Identifier: BSD-3-Clause
# Proves that ParaView opens DICOM folders and slices with our reader, that each series of a folder
# can be chosen, that points in time become time steps, that what cannot be read is refused with a
# sentence, and that the patient's name goes nowhere.
import os
import shutil
import subprocess

import numpy
import pydicom
from brainshift_testing import assert_says, data, load_plugin, messages, output, run_tests, scratch
from dicom_testing import (AXIAL, CORONAL, NUMBER, assert_placed, folder, numbered, plain_header,
                           read, read_again, scalars, write_slices)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple, smtrace  # noqa: E402
from paraview.simple import (  # noqa: E402
    Delete, DICOMVolumeReader, OpenDataFile, SaveState)
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkCommand  # noqa: E402


def names(reader):
    return list(reader.GetProperty("SeriesList"))


def opened(path):
    reader = OpenDataFile(path)
    assert reader is not None, "no reader for " + path
    name = reader.GetClientSideObject().GetClassName()
    assert (name, reader.Format) == ("vtkVolumeFileReader", "DICOM"), (name, reader)
    reader.UpdatePipeline()
    return reader


def test_paraview_opens_a_folder_and_any_slice_with_our_reader():
    path = write_slices(folder("open"), numbered())
    right = read_again(path)
    os.rename(os.path.join(path, "IM0001.dcm"), os.path.join(path, "IM0001"))
    os.rename(os.path.join(path, "IM0003.dcm"), os.path.join(path, "1.2.840.3"))
    os.rename(os.path.join(path, "IM0004.dcm"), os.path.join(path, "0004.IMA"))
    for name in ("", "IM0001", "IM0002.dcm", "1.2.840.3", "0004.IMA"):
        assert_placed(opened(os.path.join(path, name) if name else path), *right)
    assert_placed(opened(path + "/"), *right)


def test_other_files_and_folders_go_to_others():
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    session = servermanager.ActiveConnection.Session
    for path in (folder("empty"), data("seg3d-utah"), data("seg3d-utah", "seg3d_mr_t1.nii.gz")):
        assert not factory.CanReadFile(path, "sources", "DICOMFileReader", session), path
    assert factory.CanReadFile(write_slices(folder("some"), numbered()), "sources",
                               "DICOMFileReader", session)
    head = OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    assert head.GetXMLName() == "NIFTIVolumeReader", head.GetXMLName()


def two_series():
    """A head, three slices of a localizer in the same series, and another series."""
    path = write_slices(folder("two"), numbered(6))

    def localizer(image, index):
        image.ImageType = ["ORIGINAL", "PRIMARY", "LOCALIZER"]
        image.InstanceNumber = 100 + index

    def other(image, _):
        image.SeriesInstanceUID = "1.2.3.4.6"
        image.SeriesNumber = 2
        image.SeriesDescription = "Neck"

    write_slices(path, numbered(3, start=1000), axes=CORONAL, change=localizer, start=100)
    write_slices(path, numbered(4, start=2000), change=other, start=200)
    return path


def part_of(path, numbers):
    """A folder of its own with some of the files."""
    part = folder("part")
    for number in numbers:
        shutil.copy(os.path.join(path, f"IM{number:04d}.dcm"), part)
    return read_again(part)


SERIES = {"3, Test head, CT, 6 x 5 x 6, 2024-02-29": range(1, 7),
          "3, Test head, CT, 6 x 5 x 3, 2024-02-29": range(100, 103),
          "2, Neck, CT, 6 x 5 x 4, 2024-02-29": range(200, 204)}


def test_each_series_can_be_chosen():
    path = two_series()
    reader, told = read(path)
    assert not told, told
    assert set(names(reader)) == set(SERIES), names(reader)
    assert names(reader)[0] == next(iter(SERIES)), "the largest is first"
    assert list(reader.GetProperty("Series").Available) == names(reader)
    assert_placed(reader, *part_of(path, next(iter(SERIES.values()))))
    for name, numbers in SERIES.items():
        reader.Series = name
        assert_placed(reader, *part_of(path, numbers))
    for number, name in ((2, 0), (101, 1), (203, 2)):
        reader, told = read(os.path.join(path, f"IM{number:04d}.dcm"))
        assert not told, told
        assert names(reader)[0] == list(SERIES)[name], "that of the file is first"
        assert_placed(reader, *part_of(path, list(SERIES.values())[name]))
    reader, told = read(path, Series="17, Foot")
    assert_says(told, 'has no series "17, Foot"', "it has 3")


def test_types_part_a_series_only_where_they_share_places():
    path = folder("types")

    def typed(image, index):
        image.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL"] + (["ADD"] if index % 2 else [])

    def phase(image, _):
        image.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL", "PHASE"]

    write_slices(path, numbered(), change=typed)
    reader, told = read(path)
    assert not told, told
    assert len(names(reader)) == 1, names(reader)
    assert_placed(reader, *read_again(path))
    write_slices(path, numbered(start=1000), change=phase, start=50)
    reader, told = read(path)
    assert not told, told
    assert len(names(reader)) == 2, names(reader)
    assert any(name.endswith("ORIGINAL PRIMARY AXIAL PHASE") for name in names(reader))
    assert_placed(reader, *part_of(path, range(1, 5)))


def test_the_folder_is_read_once():
    reader = DICOMVolumeReader(FileName=write_slices(folder("once"), numbered()))
    source = reader.GetClientSideObject()
    heard = []
    source.AddObserver(vtkCommand.ProgressEvent, lambda *_: heard.append(source.GetProgress()))
    reader.UpdatePipeline()
    assert reader.Series == names(reader)[0], "ParaView writes it into the property"
    assert heard.count(0.0) <= 2, heard


def test_points_in_time_become_time_steps():
    voxels = numbered(12).reshape(3, 4, 5, 6)

    def trigger(image, index):
        image.TriggerTime = str(40.0 * times.index(image.InstanceNumber // 100))

    def acquired(image, index):
        image.AcquisitionDate, image.AcquisitionTime = "20240229", (
            f"10{15 + times.index(image.InstanceNumber // 100):02d}{index:02d}.5")

    def echo(image, index):
        image.EchoNumbers = times.index(image.InstanceNumber // 100) + 1

    times = [2, 0, 1]  # not in the order of their numbers
    for change, right in ((trigger, (0.0, 0.04, 0.08)), (acquired, (0.0, 60.0, 120.0)),
                          (echo, (0.0, 1.0, 2.0))):
        path = folder("times")
        for t, number in enumerate(times):
            write_slices(path, voxels[t], change=change, start=100 * number)
        reader, told = read(path)
        assert not told, told
        numpy.testing.assert_allclose(reader.TimestepValues, right)
        assert "6 x 5 x 4, 3 times" in names(reader)[0], names(reader)
        for t, number in enumerate(times):
            reader.UpdatePipeline(right[t])
            numpy.testing.assert_array_equal(
                numpy.unique(scalars_now(reader)), numpy.unique(voxels[t]))


def test_settings_that_have_several_times_are_entries_of_their_own():
    """Echoes, b-values, flip angles and inversion times, each at two times. States that name all of
    them together show the first."""
    def timed(image, time):
        image.AcquisitionDate, image.AcquisitionTime = "20240229", f"10{15 + 2 * time:02d}00"

    voxels = numbered(16).reshape(2, 2, 4, 5, 6)
    for keyword, pair, words in (("EchoTime", ("10", "20"), "EchoTime {} ms"),
                                 ("DiffusionBValue", (0.0, 1000.0), "DiffusionBValue {} s/mm^2"),
                                 ("FlipAngle", ("5", "30"), "FlipAngle {} degrees"),
                                 ("InversionTime", ("300", "900"), "InversionTime {} ms")):
        path = folder("settings")
        for time in range(2):
            for setting in range(2):
                def change(image, _, time=time, setting=setting):
                    setattr(image, keyword, pair[setting])
                    timed(image, time)
                write_slices(path, voxels[time, setting], change=change,
                             start=1 + 100 * time + 10 * setting)
        reader, told = read(path)
        first = words.format(pair[0]).replace(".0", "")
        assert_says(told, "several settings at several times", first)
        assert len(names(reader)) == 2, names(reader)
        for setting, name in enumerate(names(reader)):
            said = words.format(pair[setting]).replace(".0", "")
            assert "6 x 5 x 4, 2 times" in name and name.endswith(said), name
            reader, _ = read(path, Series=name)
            assert list(reader.TimestepValues) == [0.0, 120.0], reader.TimestepValues
            for time in range(2):
                reader.UpdatePipeline(120.0 * time)
                numpy.testing.assert_array_equal(
                    numpy.unique(scalars_now(reader)), numpy.unique(voxels[time, setting]))
        former = names(reader)[0].split(f", {keyword}")[0].replace("2 times", "4 times")
        reader, told = read(path, Series=former)
        assert list(reader.TimestepValues) == [0.0, 120.0], (former, told)


def test_settings_at_uneven_times_stay_one_series():
    """A diffusion weighting of several directions beside an image without: in a row, as before."""
    path = folder("weightings")
    for t, weight in enumerate((0.0, 1000.0, 1000.0)):
        def change(image, _, t=t, weight=weight):
            image.DiffusionBValue = weight
            image.InstanceNumber += 100 * t
        write_slices(path, numbered(), change=change, start=1 + 100 * t)
    reader, _ = read(path)
    assert len(names(reader)) == 1 and len(reader.TimestepValues) == 3, names(reader)
    path = folder("unfinished-echoes")
    for t, (position, time) in enumerate(((1, "10"), (1, "20"), (2, "10"))):
        def change(image, _, position=position, time=time):
            image.TemporalPositionIdentifier, image.EchoTime = position, time
        write_slices(path, numbered(), change=change, start=1 + 100 * t)
    reader, told = read(path)
    assert len(names(reader)) == 1 and list(reader.TimestepValues) == [0, 1, 2], names(reader)
    assert_says(told, "of which not all have the same times; they are numbered 0, 1, 2")


def scalars_now(reader):
    image = reader.GetClientSideObject().GetOutputDataObject(0)
    array = image.GetPointData().GetScalars()
    return numpy.array([array.GetTuple1(i) for i in range(array.GetNumberOfTuples())])


def test_an_unfinished_last_volume_is_left_out():
    path = folder("unfinished")

    def position(image, _):
        image.TemporalPositionIdentifier = image.InstanceNumber // 100 + 1

    for t in range(3):
        write_slices(path, numbered(4 if t < 2 else 2, start=1000 * t), change=position,
                     start=100 * t)
    reader, told = read(path)
    assert_says(told, "2 images at positions of other images")
    assert len(reader.TimestepValues) == 2


def refused(change, *words, voxels=None):
    path = write_slices(folder("refused"), numbered() if voxels is None else voxels, change=change)
    reader, told = read(path)
    assert_says(told, path, *words)
    assert output(reader).GetNumberOfPoints() == 0


def test_what_cannot_be_read_is_named():
    def frames(image, _):
        image.NumberOfFrames = 2
        image.PixelData = image.PixelData * 2

    refused(frames, "has 2 frames but no positions of them")


def test_reports_are_no_slices():
    path = write_slices(folder("report"), numbered())
    right = read_again(path)
    report = plain_header("1.2.840.10008.5.1.4.1.1.88.11")
    report.save_as(os.path.join(path, "report.dcm"), write_like_original=False)
    with open(os.path.join(path, "notes.txt"), "w") as notes:
        notes.write("no DICOM")
    reader, told = read(path)
    assert not told, told
    assert_placed(reader, *right)
    reader, told = read(os.path.join(folder("none"), "absent.dcm"))
    assert_says(told, "absent.dcm does not exist")
    alone = folder("alone")
    shutil.copy(os.path.join(path, "report.dcm"), alone)
    reader, told = read(alone)
    assert_says(told, "neither a DICOM image nor a folder")


def test_a_file_without_an_image_says_so_beside_a_series():
    path = write_slices(folder("beside"), numbered())
    report = plain_header("1.2.840.10008.5.1.4.1.1.88.11")
    report.Modality = "SR"
    name = os.path.join(path, "report.dcm")
    report.save_as(name, write_like_original=False)
    reader, told = read(name)
    assert_says(told, "report.dcm is a DICOM file without an image (modality SR)",
                "The folder has 1 series of images; open a file of one of them")
    assert output(reader).GetNumberOfPoints() == 0
    assert output(reader).GetNumberOfPoints() == 0, "nor at the next update"
    with open(name, "wb") as file:
        file.write(bytes(128) + b"DICM" + b"\x02\x00\x00\x00UL\x04\x00")
    reader, told = read(name)
    assert_says(told, "report.dcm is a DICOM file whose header is damaged")


def test_volumes_without_times_are_a_repetition_time_apart():
    voxels = numbered(12).reshape(3, 4, 5, 6)

    def repeated(image, _):
        image.RepetitionTime = "2500"

    def resolved(image, _):
        image.RepetitionTime, image.TemporalResolution = "30", "4000"

    def nothing(image, _):
        pass

    for change, right, words in (
            (repeated, (0.0, 2.5, 5.0), "count as 2.5 s apart"),
            (resolved, (0.0, 4.0, 8.0), "count as 4 s apart"),
            (nothing, (0.0, 1.0, 2.0), "are numbered 0, 1, 2 and so on")):
        path = folder("repeated")
        for t in range(3):
            write_slices(path, voxels[t], change=change, start=100 * t + 1)
        reader, told = read(path)
        assert_says(told, "has 3 volumes without times of their own", words)
        numpy.testing.assert_allclose(reader.TimestepValues, right)


def test_short_slices_are_refused_and_damaged_ones_told():
    path = write_slices(folder("short"), numbered())
    name = os.path.join(path, "IM0002.dcm")
    whole = open(name, "rb").read()
    with open(name, "wb") as file:
        file.write(whole[:-20])
    reader, told = read(path)
    assert_says(told, "IM0002.dcm has 40 bytes of pixel data", "6 x 5 pixels of 16 bits", "60")
    assert output(reader).GetNumberOfPoints() == 0

    def lie(image, index):
        image.Rows = 60000 if index == 1 else image.Rows

    path = write_slices(folder("lie"), numbered(1), change=lambda image, _: lie(image, 1))
    reader, told = read(path)
    assert_says(told, "6 x 60000 pixels", "need 720000")


def test_subfolders_and_directories_of_media():
    path = folder("media")
    os.makedirs(os.path.join(path, "PATIENT", "STUDY"))
    write_slices(os.path.join(path, "PATIENT", "STUDY"), numbered())
    right = read_again(os.path.join(path, "PATIENT", "STUDY"))
    for name in os.listdir(os.path.join(path, "PATIENT", "STUDY")):
        old = os.path.join(path, "PATIENT", "STUDY", name)
        os.rename(old, old.replace(".dcm", ""))
    assert_placed(opened(path), *right)
    made = subprocess.run(
        ["gdcmgendir", "-r", "-i", path, "-o", os.path.join(path, "DICOMDIR")],
        capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    assert_placed(opened(os.path.join(path, "DICOMDIR")), *right)


def two_sizes(name, slices):
    """A folder with two series of other sizes, and the path of it."""
    path = write_slices(folder(name), numbered(slices))

    def other(image, _):
        image.SeriesInstanceUID, image.SeriesNumber = "1.2.3.4.6", 4

    return write_slices(path, numbered(slices, 7, 8), change=other, start=slices + 1)


class Canceller:
    """Hears the progress of a reader, and stops it once above a share."""

    def __init__(self, source):
        self.source, self.heard, self.above = source, [], None
        source.AddObserver(vtkCommand.ProgressEvent, self._hear)

    def _hear(self, *_):
        self.heard.append(self.source.GetProgress())
        if self.above is not None and self.heard[-1] > self.above:
            self.above = None  # as a button that is pressed once
            self.source.SetAbortExecuteAndUpdateTime()

    def reads(self):
        """Whether the last update read slices, and did not only begin and end."""
        return any(0.0 < share < 1.0 for share in self.heard)

    def updated(self, above):
        """What is told while the reader is updated and stopped above a share; None: not stopped."""
        self.heard, self.above = [], above
        with messages() as told:
            self.source.Update()
        self.above = None
        return told.text


def test_progress_is_told_from_the_first_header_to_the_last_slice():
    reader = DICOMVolumeReader(FileName=two_sizes("progress", 80))
    canceller = Canceller(reader.GetClientSideObject())
    canceller.source.Modified()  # the headers were read when the reader was made
    canceller.source.UpdateInformation()
    assert len(canceller.heard) > 1 and max(canceller.heard) > 0.3, canceller.heard
    assert not canceller.updated(None)
    assert len(canceller.heard) > 4 and max(canceller.heard) == 1.0, canceller.heard


def test_cancel_of_the_first_series_shows_nothing_until_it_is_wanted_again():
    reader = DICOMVolumeReader(FileName=two_sizes("cancel", 80))
    source = reader.GetClientSideObject()
    canceller = Canceller(source)
    source.UpdateInformation()
    assert_says(canceller.updated(0.1), "was stopped. Nothing is shown")
    assert source.GetOutputDataObject(0).GetNumberOfPoints() == 0
    assert canceller.updated(None) == "" and not canceller.reads(), canceller.heard
    source.Modified()
    assert not canceller.updated(None)
    assert source.GetOutputDataObject(0).GetNumberOfPoints() == 80 * 7 * 8


def test_cancel_of_another_series_keeps_the_one_that_is_shown():
    for above_header in (False, True):
        reader = DICOMVolumeReader(FileName=two_sizes("cancel-other", 80))
        canceller = Canceller(reader.GetClientSideObject())
        assert not canceller.updated(None)
        shown = output(reader).NewInstance()
        shown.DeepCopy(output(reader))
        first, second = names(reader)
        reader.Series = second
        if above_header:
            canceller.source.UpdateInformation()
        assert_says(canceller.updated(0.1), "was stopped. What was read before is shown")
        for _ in range(2):
            image = canceller.source.GetOutputDataObject(0)
            assert image.GetDimensions() == shown.GetDimensions()
            assert image.GetOrigin() == shown.GetOrigin()
            same = vtk_to_numpy(image.GetPointData().GetScalars())
            assert (same == vtk_to_numpy(shown.GetPointData().GetScalars())).all()
            assert canceller.updated(None) == "" and not canceller.reads(), canceller.heard
        assert names(reader) == [first, second]
        canceller.source.Modified()
        assert not canceller.updated(None)
        assert canceller.source.GetOutputDataObject(0).GetDimensions() != shown.GetDimensions()


def test_the_patient_is_told_on_request_and_stays_nowhere():
    def more(image, _):
        image.PatientBirthDate, image.PatientSex = "19700131", "F"

    view = simple.CreateView("RenderView")
    smtrace.start_trace()
    reader = opened(write_slices(folder("patient"), numbered(), change=more))
    asked = brainshift.dicom_patient(reader)
    assert asked == {"name": "Secret^Patient", "number": NUMBER, "birth_date": "1970-01-31",
                     "sex": "F"}, asked
    simple.Show(reader, view)
    simple.Render(view)
    trace = smtrace.stop_trace()
    assert "DICOMVolumeReader" in trace, trace
    name, script = scratch("patient.pvsm"), scratch("patient.py")
    SaveState(name)
    SaveState(script)
    image = output(reader)
    kept = trace + str(image) + str(reader.GetClientSideObject()) + " ".join(names(reader))
    for file in (name, script):
        with open(file, encoding="utf-8") as text:
            kept += text.read()
    for index in range(image.GetFieldData().GetNumberOfArrays()):
        kept += str(image.GetFieldData().GetAbstractArray(index).GetValue(0))
    assert "DICOM-patient" in kept
    for secret in ("Secret", NUMBER, "1970-01-31", "19700131"):
        assert secret not in kept, secret
    try:
        brainshift.dicom_patient(simple.Sphere())
    except TypeError as error:
        assert_says(str(error), "SphereSource", "must be a DICOM Volume Reader")
    else:
        raise AssertionError("a sphere has no patient")


def test_the_patient_of_the_series_that_is_shown_is_told():
    path = folder("patients")
    for number, name in ((3, "One^A"), (4, "Two^B")):
        def change(image, _, number=number, name=name):
            image.SeriesNumber, image.SeriesInstanceUID = number, f"1.2.3.{number}"
            image.PatientName = name
            del image.PatientID

        write_slices(path, numbered(), change=change, start=10 * number)
    reader = opened(path)
    for series in names(reader):
        reader.Series = series
        asked = brainshift.dicom_patient(reader)
        assert asked["name"] == ("One^A" if series.startswith("3") else "Two^B"), asked
        assert asked["number"] == asked["birth_date"] == asked["sex"] == "", asked


def test_the_patient_is_not_in_the_state():
    reader = opened(write_slices(folder("state"), numbered()))
    name = scratch("dicom.pvsm")
    SaveState(name)
    text = open(name, encoding="utf-8").read()
    assert "DICOM-state" in text
    image = output(reader)
    told = str(image) + "".join(str(image.GetFieldData().GetAbstractArray(i))
                                for i in range(image.GetFieldData().GetNumberOfArrays()))
    for secret in ("Secret", NUMBER):
        assert secret not in text + told + " ".join(names(reader))
    Delete(reader)


run_tests(globals())
