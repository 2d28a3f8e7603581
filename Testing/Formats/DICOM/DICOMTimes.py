# SPDX-License-Identifier: BSD-3-Clause
# Proves that series that go over midnight keep their order and times, with or without a date, that
# PET takes the times of its frames, that triggers which differ from slice to slice mix no volumes,
# and that slices that are parted from their volume are said.
import os

import numpy
from brainshift_testing import assert_says, load_plugin, messages, output, run_tests
from dicom_testing import SAGITTAL, enhanced, folder, numbered, scalars, write_slices

load_plugin()
from paraview.simple import DICOMVolumeReader  # noqa: E402 after the plugin

EVENING = ("235950", "235955", "000000", "000005")
DATES = ("20240229", "20240229", "20240301", "20240301")


def series(change, times=4, slices=3):
    """A folder with `times` volumes of numbers of their own; change(image, time, slice)."""
    path = folder("times")
    for t in range(times):
        write_slices(path, numbered(slices, start=1000 * t), start=1 + slices * t,
                     change=lambda image, index, t=t: change(image, t, index))
    return path


def read(path):
    """The reader and what it told."""
    with messages() as told:
        reader = DICOMVolumeReader(FileName=path)
        reader.UpdatePipeline()
    return reader, told.text


def assert_times(reader, right):
    """The times, s, and that the volumes are those that `series` wrote one after the other."""
    numpy.testing.assert_allclose(reader.TimestepValues, right)
    for t, time in enumerate(right):
        reader.UpdatePipeline(time)
        image = reader.GetClientSideObject().GetOutputDataObject(0)
        least, most = image.GetPointData().GetScalars().GetRange()
        assert least == 1000 * t and most < 1000 * (t + 1), (t, least, most)


def test_a_day_passes_where_another_attribute_shows_the_order():
    def plain(image, t, _):
        image.AcquisitionTime = EVENING[t]

    def dated(image, t, _):
        image.AcquisitionTime, image.AcquisitionDate = EVENING[t], "20240229"

    def by_slice(image, t, index):  # times count up fastest
        image.AcquisitionTime, image.InstanceNumber = EVENING[t], 1 + t + 4 * index

    def by_position(image, t, _):
        image.AcquisitionTime, image.TemporalPositionIdentifier = EVENING[t], t + 1
        image.InstanceNumber = 1

    def by_content(image, t, index):
        image.AcquisitionTime, image.InstanceNumber = EVENING[t], 1 + index
        image.ContentDate, image.ContentTime = DATES[t], EVENING[t]

    def content_only(image, t, _):
        image.ContentTime = EVENING[t]

    def within_a_volume(image, t, index):  # midnight is between two slices
        seconds = (86388 + 5 * t + index) % 86400
        image.AcquisitionTime = f"{seconds // 3600:02d}{seconds // 60 % 60:02d}{seconds % 60:02d}"

    for change, word in ((plain, "InstanceNumber"), (dated, "InstanceNumber"),
                         (by_slice, "InstanceNumber"), (by_position, "TemporalPositionIdentifier"),
                         (by_content, "ContentDate"), (content_only, "InstanceNumber"),
                         (within_a_volume, "InstanceNumber")):
        reader, told = read(series(change))
        assert_says(told, "has times of day that fall by more than half a day", word,
                    "a day passed, which its dates do not say")
        assert_times(reader, (0, 5, 10, 15))


def test_dates_that_say_it_need_no_word():
    def dated(image, t, _):
        image.AcquisitionTime, image.AcquisitionDate = EVENING[t], DATES[t]

    reader, told = read(series(dated))
    assert not told, told
    assert_times(reader, (0, 5, 10, 15))


def test_without_an_order_the_shortest_span_counts():
    def unordered(image, t, _):
        image.AcquisitionTime, image.InstanceNumber = EVENING[t], 1

    reader, told = read(series(unordered))
    assert_says(told, "no other attribute says their order", "made over midnight",
                "the shortest span")
    assert_times(reader, (0, 5, 10, 15))


def test_a_long_day_stays_one():
    def long(image, t, _):
        image.AcquisitionTime = ("080000", "213000")[t]

    reader, told = read(series(long, times=2))
    assert_says(told, "has images up to 13.5 hours apart on one date", "in the order of "
                "InstanceNumber", "if they were made over midnight")
    assert_times(reader, (0, 13.5 * 3600))


def test_a_series_that_lacks_times_is_not_moved():
    def some(image, t, _):
        if t:
            image.AcquisitionTime = "2359" + str(50 + t)

    _, told = read(series(some))
    assert "midnight" not in told and "day" not in told, told


def test_frames_over_midnight():
    voxels = numpy.stack([numbered(3, start=1000 * t) for t in range(4)])
    image = enhanced(voxels, [(t + 1, 0.0) for t in range(4)])
    for index, group in enumerate(image.PerFrameFunctionalGroupsSequence):
        content = group.FrameContentSequence[0]
        content.FrameAcquisitionDateTime = "20240229" + EVENING[index // 3]
    path = folder("frames")
    image.save_as(path + "/a.dcm", write_like_original=False)
    reader, told = read(path)
    assert_says(told, "in the order of TemporalPositionIdentifier): a day passed")
    assert_times(reader, (0, 5, 10, 15))


def test_frames_of_pet_have_the_times_of_their_reference():
    def frame(image, t, index):
        image.Modality, image.FrameReferenceTime = "PT", str(1000 * (30 + 60 * t))
        image.InstanceNumber = 10 - 3 * t + index  # not in the order of time

    def acquired(image, t, index):
        frame(image, t, index)
        image.AcquisitionTime = "100000"

    for change in (frame, acquired):
        reader, told = read(series(change, times=2))
        assert not told, told
        assert_times(reader, (0, 60))


def gated(triggers, weights):
    """The reader of a gated series, and what it told. triggers [slice][volume], ms."""
    def change(image, t, index):
        image.TriggerTime, image.DiffusionBValue = str(triggers[index][t]), weights[t]

    return read(series(change, len(weights), len(triggers)))


def test_triggers_that_differ_from_slice_to_slice_mix_no_volumes():
    for triggers, weights in ((((900, 850), (860, 910)), (0.0, 1000.0)),
                              (((900, 850), (850, 900)), (0.0, 1000.0)),
                              # two directions of one weighting
                              (((900, 870, 850), (860, 880, 910)), (0.0, 1000.0, 1000.0)),
                              (((900, 850), (860, 910)), (0.0, 0.0))):
        reader, told = gated(triggers, weights)
        assert_says(told, "has triggers of the heart (TriggerTime) that differ from slice to "
                    "slice; images of one position are sorted by other attributes")
        assert_times(reader, range(len(weights)))


def test_all_forms_of_a_time_count():
    def said(name, values, date=None):
        def change(image, t, index):
            setattr(image, name, values[t])
            image.AcquisitionDate = date or ""
        return read(series(change, len(values)))

    # As former versions of the standard have it; before 1970, as dates that hide a patient are.
    for values, right in ((("10:58:00", "10:59:30", "11:01:00"), (0, 90, 180)),
                          (("1058", "1059", "1101"), (0, 60, 180)),
                          (("105800.25", "105800.5", "105801"), (0, 0.25, 0.75))):
        for date in (None, "19000228", "2024.02.29", "00000000"):
            reader, told = said("AcquisitionTime", values, date)
            assert not told, (values, date, told)
            assert_times(reader, right)
    # The end of summer time.
    reader, told = said("AcquisitionDateTime", (
        "20241027025950+0200", "20241027020000+0100", "20241027020010+0100"))
    assert not told, told
    assert_times(reader, (0, 10, 20))


def test_what_is_no_time_is_said():
    for name, values in (("AcquisitionTime", ("101010", "xx", "101012")),
                         ("AcquisitionTime", ("251010", "101011", "101012")),
                         ("AcquisitionTime", ("1010 10", "101011", "101012")),
                         ("AcquisitionDateTime", ("20240229101010+9900", "20240229101011",
                                                  "20240229101012"))):
        def change(image, t, index, name=name, values=values):
            setattr(image, name, values[t])
        wrong = values[1] if values[1] == "xx" else values[0]
        reader, told = read(series(change, 3))
        assert_says(told, f"has the {name} {wrong}, which is no time. It does not count")
        assert_times(reader, (0, 1, 2))


def test_a_time_that_would_not_have_counted_needs_no_word():
    def change(image, t, index):
        image.ContentDate, image.ContentTime = "20240229", "xx"
        if t < 3:
            image.AcquisitionTime = f"10101{t}"
    reader, told = read(series(change, 3))
    assert not told, told
    assert_times(reader, (0, 1, 2))

    def alone(image, t, index):
        image.ContentTime = "xx"
        if "AcquisitionTime" in image:
            del image.AcquisitionTime
    assert_says(read(series(alone, 3))[1], "has the ContentTime xx, which is no time")
    image = enhanced(numbered(4)[None])
    image.ContentTime = "xx"
    path = os.path.join(folder("own-times"), "frames.dcm")
    image.save_as(path, write_like_original=False)
    told = read(path)[1]
    assert not told, told
    for groups in image.PerFrameFunctionalGroupsSequence:
        del groups.FrameContentSequence[0].FrameAcquisitionDateTime
    image.save_as(path, write_like_original=False)
    assert_says(read(path)[1], "has the ContentTime xx, which is no time")


def test_triggers_of_a_beating_heart_are_times():
    def turned(image, t, index):  # not in the order of their numbers
        image.TriggerTime, image.InstanceNumber = str(40.0 * t + 0.3 * index), 10 - 3 * t + index

    reader, told = read(series(turned))
    assert not told, told
    assert_times(reader, (0.0, 0.04, 0.08, 0.12))
    # Another heart rate in the second slice.
    reader, told = gated(((0, 40, 80), (0, 45, 90)), (0.0, 0.0, 0.0))
    assert_says(told, "differ from slice to slice",
                "times that are the triggers of its first slice")
    assert_times(reader, (0.0, 0.04, 0.08))


def test_slices_of_other_settings_in_a_volume_are_said():
    def change(image, t, index):
        image.DiffusionBValue = 1000.0 * t * index

    _, told = read(series(change, 2, 2))
    assert_says(told, "has volumes whose slices differ in echo, diffusion weighting or another "
                "setting")


def parted(change):
    """What is told of five slices, of which the last two differ."""
    def last(image, index):
        image.RescaleIntercept, image.RescaleSlope, image.RescaleType = "-1000", "1", "HU"
        if index > 2:
            change(image)
    reader, told = read(write_slices(folder("parted"), numbered(5), change=last))
    assert output(reader).GetDimensions() == (6, 5, 3), output(reader).GetDimensions()
    return told


def test_slices_that_are_another_entry_are_said():
    def unit(image):
        del image.RescaleType

    def turned(image):
        angle = numpy.radians(0.2)
        image.ImageOrientationPatient = [f"{x:.9g}" for x in (
            numpy.cos(angle), numpy.sin(angle), 0, -numpy.sin(angle), numpy.cos(angle), 0)]

    def spaced(image):
        image.PixelSpacing = ["0.9", "0.703"]

    def typed(image):
        image.ImageType = ["DERIVED", "PRIMARY", "OTHER"]

    for change, name in ((unit, "RescaleType or Units"), (turned, "ImageOrientationPatient"),
                         (spaced, "PixelSpacing"), (typed, "ImageType")):
        assert_says(parted(change), "lacks images at other positions, which are another entry of "
                    f"its list: 2 with another {name}")


def test_a_slice_that_is_stored_mirrored_is_said():
    row, column = numpy.array((1.0, 0, 0)), numpy.array((0, 1.0, 0))
    for along_row, along_column in ((-row, column), (row, -column), (-row, -column),
                                    (column, row), (-column, row)):
        def change(image, index, axes=(along_row, along_column)):
            if index == 2:
                image.ImageOrientationPatient = [*axes[0], *axes[1]]
        told = read(write_slices(folder("mirrored"), numbered(5), change=change))[1]
        assert_says(told, "lacks images at other positions, which are another entry of its list: 1 "
                    "with another ImageOrientationPatient; they are stored mirrored or rotated")


def test_entries_that_are_meant_are_not_said():
    path = write_slices(folder("meant"), numbered())
    write_slices(path, numbered(start=1000), start=100, change=lambda image, _: setattr(
        image, "RescaleType", "US"))  # another map at the same positions
    write_slices(path, numbered(3), SAGITTAL, start=200)
    reader, told = read(path)
    assert not told, told
    assert len(list(reader.GetProperty("SeriesList"))) == 3
    numpy.testing.assert_array_equal(numpy.unique(scalars(reader))[:1], [0])


run_tests(globals())
