# SPDX-License-Identifier: BSD-3-Clause
# Proves that points and labels go out as Slicer and MNI tools expect them, rest or deformed, as
# Python's own parsers read them, and that filters take what the reader makes as it is.
import csv
import json
import os
import re

import numpy
from brainshift_testing import (assert_says, ball, data, load_plugin, messages, run_tests, scratch,
                                volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402

LABELS = ['Straße, "links"', "後頭葉", "", "#1; a\tb", "two\nlines \\"]
PLACES = numpy.array([[1.5, -2.25, 3.0], [-10.0, 20.0, 1e-3], [0.1, 0.2, 0.3], [7, 8, -9],
                      [1 / 3, 1e5, -1e-9]])
TIMES = [0.0, 0.25, numpy.nan, 1.5, 2.0]
LPS = numpy.array([-1.0, -1.0, 1.0])
ENDINGS = (".mrk.json", ".json", ".fcsv", ".tag", ".csv", ".tsv")


def table(labels=tuple(LABELS), places=PLACES):
    name = scratch("source.csv")
    with open(name, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(["label", "x", "y", "z", "time"])
        rows.writerows([label, *map(repr, map(float, place)), "" if time != time else time]
                       for label, place, time in zip(labels, places, TIMES))
    return name


def parsed(name):
    """Labels, positions in RAS and the axes in a file, by parsers that are not ours."""
    with open(name, newline="", encoding="utf-8") as file:
        text = file.read()
    if name.endswith(".json"):
        markup, = json.loads(text)["markups"]
        assert markup["type"] == "Fiducial" and markup["coordinateUnits"] == "mm"
        points = markup["controlPoints"]
        assert len({point["id"] for point in points}) == len(points)
        assert all(point["positionStatus"] == "defined" for point in points)
        axes, labels = markup["coordinateSystem"], [point["label"] for point in points]
        places = [point["position"] for point in points]
    elif name.endswith(".fcsv"):
        axes = re.search(r"^# CoordinateSystem = (\w+)$", text, re.MULTILINE)[1]
        assert re.search(r"^# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,", text,
                         re.MULTILINE)
        rows = list(csv.reader(text.split("\n", 3)[3].splitlines(keepends=True)))
        labels, places = [row[11] for row in rows], [row[1:4] for row in rows]
    elif name.endswith(".tag"):
        assert text.startswith("MNI Tag Point File\nVolumes = 1;\n") and text.endswith(";\n")
        found = re.findall(r'^ (\S+) (\S+) (\S+) "(.*)"', text.split("Points =")[1], re.MULTILINE)
        axes, labels = "RAS", [row[3] for row in found]
        places = [row[:3] for row in found]
    else:
        rows = list(csv.reader(text.splitlines(keepends=True),
                               delimiter="," if name.endswith(".csv") else "\t"))
        axes = "".join(rows[0][1:4]).upper()
        labels, places = [row[0] for row in rows[1:]], [row[1:4] for row in rows[1:]]
        assert "time" in rows[0]
    return labels, numpy.array(places, float) * (LPS if axes == "LPS" else 1.0), axes


def test_what_is_written_is_what_others_read():
    source = table()
    for ending in ENDINGS:
        for axes in ("Of The Format", "RAS", "LPS"):
            name = scratch("written" + ending)
            if ending == ".tag" and axes == "LPS":
                continue
            with messages() as said:
                assert brainshift.map_points(source, name, file_axes=axes) == len(PLACES)
            labels, places, found = parsed(name)
            expected = LABELS
            if ending == ".tag":
                expected = [label.replace('"', "'").replace("\n", " ") for label in LABELS]
                assert_says(said.text, "2 labels with quotes or new lines")
            if ending in (".csv", ".tsv"):
                assert "cannot hold times" not in said.text
            else:
                assert_says(said.text, "cannot hold times and deviations")
            assert labels == expected, (ending, labels)
            assert numpy.array_equal(places, PLACES), (ending, axes)
            of_slicer = ending in (".mrk.json", ".json", ".fcsv")
            assert found == (axes if axes != "Of The Format" else "LPS" if of_slicer else "RAS")
            points = brainshift.read_points(name)
            assert points.labels == expected and numpy.array_equal(points.positions, PLACES)
            kept = TIMES if ending in (".csv", ".tsv") else [numpy.nan] * len(TIMES)
            assert numpy.array_equal(points.times, kept, equal_nan=True)


def test_what_cannot_be_written_leaves_the_old_file():
    name = scratch("old.tag")
    brainshift.map_points(table(), name)
    with open(name, "rb") as file:
        before = file.read()
    for target, named, words in ((name, {"file_axes": "LPS"}, "has RAS axes"),
                                 (scratch("new.txt"), {}, "must be .mrk.json"),
                                 (scratch("no/such.tag"), {}, "cannot be written")):
        with messages():
            try:
                brainshift.map_points(table(), target, **named)
            except OSError as error:
                assert words in str(error), error
            else:
                raise AssertionError(target)
    with open(name, "rb") as file:
        assert file.read() == before
    assert not os.path.exists(scratch("new.txt"))


def test_points_of_unknown_axes_are_said_to_count_as_ras():
    """The file names axes. Those of points from a file are known, and nothing is said."""
    for source, isSaid in ((simple.PointSource(NumberOfPoints=3), True),
                           (simple.LandmarkReader(FileName=table()), False)):
        with messages() as said:
            simple.SaveData(scratch("axes.mrk.json"), proxy=source)
        assert ("points whose world axes are not known; they count as RAS" in said.text) == isSaid
        labels, _, axes = parsed(scratch("axes.mrk.json"))
        assert axes == "LPS" and len(labels) == (3 if isSaid else len(LABELS))


def test_names_are_kept_whatever_their_column_is_called():
    for column, labels in (("electrode", ["A1", "A2"]), ("id", ["7", "8"]), ("wo", ["AC", "PC"])):
        name = scratch("named.csv")
        with open(name, "w", encoding="utf-8") as file:
            file.write(f"{column},x,y,z\n{labels[0]},1,2,3\n{labels[1]},4,5,6\n")
        for ending in ENDINGS:
            with messages():
                brainshift.map_points(name, scratch("kept" + ending))
            with messages():
                assert brainshift.read_points(scratch("kept" + ending)).labels == labels, ending


def bent():
    return simple.FreeFormDeformation(
        Input=volume(ball()), Strokes=brainshift.soft((16, 16, 16), (4, 3, 2), 14.0))


def test_points_go_with_the_tissue_and_back():
    filter = bent()
    places = numpy.random.default_rng(3).uniform(4.0, 28.0, (5, 3))
    for ending in ENDINGS:
        moved, back = scratch("moved" + ending), scratch("back" + ending)
        with messages():
            brainshift.map_points(table(places=places), moved, filter)
            brainshift.map_points(moved, back, filter, direction="Backward")
        expected = brainshift.deformed_from_rest(filter, places)
        assert numpy.abs(expected - places).max() > 1.0
        found = brainshift.read_points(moved)
        assert numpy.array_equal(parsed(moved)[1], found.positions)
        assert numpy.abs(found.positions - expected).max() < 1e-4
        assert len(found.labels) == 5 and found.labels[1] == LABELS[1]
        assert numpy.abs(brainshift.read_points(back).positions - places).max() < 1e-3


def test_wrong_arguments_are_named():
    for named, words in (({"direction": "up"}, "direction is 'up'"),
                         ({"filter": volume(ball())}, "attaches no deformation")):
        with messages():
            try:
                brainshift.map_points(table(), scratch("wrong.csv"), **named)
            except ValueError as error:
                assert words in str(error), error
            else:
                raise AssertionError(named)


def test_filters_take_the_reader_as_it_is():
    filter = bent()
    reader = simple.LandmarkReader(FileName=table(places=PLACES % 20.0))
    distance = simple.TraceDistance(Input=reader, Deformation=filter, Threshold=50.0)
    distance.UpdatePipeline()
    distance.SMProxy.UpdatePropertyInformation()
    assert distance.GetPropertyValue("Count") == 5
    assert distance.PointData.GetArray("DistanceToCortex") is not None
    moved = servermanager.Fetch(simple.DeformGeometry(Input=reader, Deformation=filter))
    labels = moved.GetPointData().GetAbstractArray("Label")
    assert [labels.GetValue(i) for i in range(5)] == LABELS
    assert moved.GetNumberOfVerts() == 5
    assert moved.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
    # The points up to a moment.
    early = simple.Threshold(Input=reader, Scalars=["POINTS", "Time"], LowerThreshold=0.0,
                             UpperThreshold=1.0)
    distance.Input = early
    distance.UpdatePipeline()
    distance.SMProxy.UpdatePropertyInformation()
    assert distance.GetPropertyValue("Count") == 2


def test_save_data_writes_rest_and_deformed_points():
    filter = bent()
    reader = simple.LandmarkReader(FileName=table(places=PLACES % 20.0))
    moved = simple.DeformGeometry(Input=reader, Deformation=filter)
    for ending in (".mrk.json", ".fcsv", ".tag"):
        for proxy, expected in ((reader, PLACES % 20.0),
                                (moved, brainshift.deformed_from_rest(filter, PLACES % 20.0))):
            name = scratch("saved" + ending)
            with messages():
                simple.SaveData(name, proxy=proxy)
            assert numpy.abs(parsed(name)[1] - expected).max() < 1e-4, ending


def test_points_of_lps_volumes_are_turned():
    """Points that say they are LPS come out right in files of either axes."""
    reader = simple.LandmarkReader(FileName=table())
    turned = simple.ProgrammableFilter(Input=reader, Script="""
import vtk
output.ShallowCopy(self.GetInputDataObject(0, 0))
word = vtk.vtkStringArray()
word.SetName("WorldAxes")
word.InsertNextValue("LPS")
output.GetFieldData().AddArray(word)
""")
    for axes in ("RAS", "LPS"):
        name = scratch("lps.mrk.json")
        writer = servermanager.writers.LandmarkWriter(Input=turned, FileName=name, FileAxes=axes)
        with messages():
            writer.UpdatePipeline()
        assert numpy.array_equal(parsed(name)[1], PLACES * LPS), axes


def test_real_landmarks_change_their_format():
    afids = data("afids-colin27", "sub-Colin27_afids.fcsv")
    before = brainshift.read_points(afids)
    name = scratch("afids.mrk.json")
    brainshift.map_points(afids, name)
    labels, places, axes = parsed(name)
    assert axes == "LPS" and labels == before.labels
    assert numpy.array_equal(places, before.positions)


run_tests(globals())
