# SPDX-License-Identifier: BSD-3-Clause
# Proves that points of each format arrive in RAS mm with their labels, as independent parsers of a
# few lines read them, that a damaged file ends in one sentence, and that File > Open offers the
# reader for its files and for no others.
import csv
import json
import os
import re

import numpy
from brainshift_testing import assert_says, data, load_plugin, messages, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402

AFIDS = data("afids-colin27", "sub-Colin27_afids.fcsv")
RESECT = data("resect", "Case1-MRI-beforeUS.tag")
LABELS = ['Straße, "links"', "後頭葉", "", "#1; a\tb"]
PLACES = numpy.array([[1.5, -2.25, 3.0], [-10.0, 20.0, 1e-3], [0.1, 0.2, 0.3], [7.0, 8.0, -9.0]])
LPS = (-1.0, -1.0, 1.0)


def written(name, text):
    path = scratch(name)
    with open(path, "wb") as file:
        file.write(text if isinstance(text, bytes) else text.encode())
    return path


def refusal(name, text, **named):
    """The one sentence with which a file is refused."""
    with messages():
        try:
            brainshift.read_points(written(name, text), **named)
        except ValueError as error:
            return str(error)
    raise AssertionError(f"{text!r} was read")


def test_fiducials_of_slicer():
    with open(AFIDS, encoding="utf-8") as file:
        rows = [row for row in csv.reader(file) if not row[0].startswith("#")]
    points = brainshift.read_points(AFIDS)
    assert len(rows) == 32 and points.labels == [row[11] for row in rows]
    assert numpy.array_equal(points.positions, numpy.array([row[1:4] for row in rows], float))
    assert numpy.array_equal(points.numbers, numpy.arange(1, 33))
    # Version 4 says 0 for RAS and 1 for LPS, version 5 uses the words.
    with open(AFIDS, encoding="utf-8") as file:
        text = file.read()
    assert "CoordinateSystem = 0" in text
    for word, signs in (("1", LPS), ("LPS", LPS), ("RAS", (1, 1, 1))):
        said = text.replace("CoordinateSystem = 0", f"CoordinateSystem = {word}")
        name = written("axes.fcsv", said)
        assert numpy.array_equal(brainshift.read_points(name).positions, points.positions * signs)


def test_fiducials_of_slicer_5_and_3():
    five = ("# Markups fiducial file version = 5.6\n# CoordinateSystem = LPS\n"
            "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
            '1,1,2,3,0,0,0,1,1,1,0,"a, ""b""",,,2,0\n2,0,0,0,0,0,0,1,1,1,0,none,,,0,0\n')
    with messages() as said:
        points = brainshift.read_points(written("five.fcsv", five))
    assert points.labels == ['a, "b"'] and points.positions.tolist() == [[-1, -2, 3]]
    assert_says(said.text, "1 point without a position")
    three = "# columns = label,x,y,z,sel,vis\nF-1,1,2,3,1,1\n"
    points = brainshift.read_points(written("three.fcsv", three))
    assert points.labels == ["F-1"] and points.positions.tolist() == [[1, 2, 3]]


def test_tags_of_two_volumes():
    with open(RESECT, encoding="utf-8") as file:
        body = file.read().split("Points =")[1]
    numbers = numpy.array(re.findall(r"-?\d+\.\d+", body), float).reshape(-1, 6)
    assert len(numbers) == 15
    assert numpy.array_equal(brainshift.read_points(RESECT).positions, numbers[:, :3])
    assert numpy.array_equal(brainshift.read_points(RESECT, volume=2).positions, numbers[:, 3:])


def test_tags_of_one_volume():
    text = ("MNI Tag Point File\nVolumes = 1; % a comment\n\nPoints =\n"
            " 1 2.5 -3e0 1 -1 -1 \"Straße, links\"\n 4 5\n 6 \"\"\n 7 8 9\n 1 1 1 2 3 4;\n")
    points = brainshift.read_points(written("one.tag", text))
    assert points.labels == ["Straße, links", "", "", ""]
    assert points.positions.tolist() == [[1, 2.5, -3], [4, 5, 6], [7, 8, 9], [1, 1, 1]]
    assert "Volume is 2" in refusal("one.tag", text, volume=2)


def markups(*lists):
    return json.dumps({"@schema": "markups-schema-v1.0.3.json#", "markups": lists},
                      ensure_ascii=False)


def controls(places, labels, **more):
    return [{"id": str(i), "label": label, "position": list(place), **more}
            for i, (place, label) in enumerate(zip(places, labels))]


def test_markups_of_slicer():
    for system, signs in (("LPS", LPS), ("RAS", (1, 1, 1)), (0, (1, 1, 1)), ("1", LPS)):
        text = markups({"type": "Fiducial", "coordinateSystem": system, "coordinateUnits": "mm",
                        "controlPoints": controls(PLACES, LABELS, positionStatus="defined")})
        points = brainshift.read_points(written("points.mrk.json", text))
        assert points.labels == LABELS, points.labels
        assert numpy.array_equal(points.positions, PLACES * signs), system
    # Several lists, each with its own axes; none named is LPS, the schema's default.
    text = markups({"type": "Curve", "coordinateSystem": "RAS",
                    "controlPoints": controls(PLACES[:1], ["r"])},
                   {"type": "Fiducial", "controlPoints": controls(PLACES[:1], ["l"])}, {})
    points = brainshift.read_points(written("lists.mrk.json", text))
    assert points.labels == ["r", "l"] and points.numbers.tolist() == [1, 2]
    assert numpy.array_equal(points.positions, [PLACES[0], PLACES[0] * LPS])


def test_points_without_a_place_are_left_out_and_told():
    placed = controls(PLACES[:2], ["first", "last"])
    unplaced = [{"label": "a"}, {"label": "b", "position": None}, {"label": "c", "position": []},
                *controls(PLACES[:1], ["d"], positionStatus="undefined"),
                *controls(PLACES[:1], ["e"], positionStatus="preview")]
    text = markups({"coordinateSystem": "RAS",
                    "controlPoints": [placed[0], *unplaced, placed[1]]})
    with messages() as said:
        points = brainshift.read_points(written("unplaced.mrk.json", text))
    assert points.labels == ["first", "last"] and points.numbers.tolist() == [1, 7]
    assert_says(said.text, "5 points without a position")


def test_tables():
    rows = [["Name", "Y (mm)", "x", "Z", "TIME", "Deviation"],
            ["a", "2", "1", "3", "0.5", "0.25"], ["b", "5", "+4", "6e0", "", "1e-2"]]
    for separator in (",", ";", "\t"):
        for end in ("\n", "\r\n"):
            for mark in ("", "\ufeff"):
                text = mark + "# a comment\n" + "".join(separator.join(row) + end for row in rows)
                points = brainshift.read_points(written("table.csv", text))
                assert points.positions.tolist() == [[1, 2, 3], [4, 5, 6]]
                assert points.labels == ["a", "b"]
                assert numpy.array_equal(points.times, [0.5, numpy.nan], equal_nan=True)
                assert points.deviations.tolist() == [0.25, 0.01]
                assert numpy.isnan(points.numbers).all()
    plain = "x,y,z\n1,2,3\n"
    named = {"R,A,S": (1, 1, 1), "l,p,s": (-1, -1, 1), "Points:0,Points:1,Points:2": (1, 1, 1)}
    for axes, signs in named.items():
        name = written("axes.csv", plain.replace("x,y,z", axes))
        assert (brainshift.read_points(name).positions == numpy.multiply([1, 2, 3], signs)).all()
    lps = brainshift.read_points(written("axes.tsv", plain), table_axes="LPS")
    assert lps.positions.tolist() == [[-1, -2, 3]]
    # What the names of columns say holds.
    ras = written("axes.csv", plain.replace("x,y,z", "r,a,s"))
    assert brainshift.read_points(ras, table_axes="LPS").positions.tolist() == [[1, 2, 3]]


def test_table_of_slicer():
    text = ('label,l,p,s,defined,selected,visible,locked,description\n'
            '"a ""1"", two\nlines",1,2,3,1,1,1,0,\nF-2,,,,0,1,1,0,\n#3,4,5,6,1,1,1,0,\n')
    with messages() as said:
        points = brainshift.read_points(written("slicer.csv", text))
    assert points.labels == ['a "1", two\nlines', "#3"]
    assert points.positions.tolist() == [[-1, -2, 3], [-4, -5, 6]]
    assert_says(said.text, "1 point without a position")


def test_damaged_files_end_in_one_sentence():
    head = "# CoordinateSystem = RAS\n"
    tag = "MNI Tag Point File\nVolumes = 2;\nPoints =\n"
    point = {"label": "a", "position": [1, 2, 3]}
    cases = [
        ("a.mrk.json", "", "is not good JSON"),
        ("a.mrk.json", markups({"controlPoints": [point]})[:-9], "is not good JSON"),
        ("a.mrk.json", "[" * 100000, "is not good JSON"),
        ("a.mrk.json", markups({"controlPoints": [{"position": [1, 2, float("nan")]}]}),
         "is not good JSON"),
        ("a.mrk.json", markups({"controlPoints": [{"label": "\udcff"}]}).encode(
            "utf-8", "surrogateescape"), "is not good JSON"),
        ("a.mrk.json", markups(1), "list of markups that is no object"),
        ("a.mrk.json", "[1]", 'has no array "markups"'),
        ("a.mrk.json", markups({"controlPoints": 1}), "controlPoints that are no array"),
        ("a.mrk.json", markups({"controlPoints": [1]}), "control point 1 that is no object"),
        ("a.mrk.json", markups({"controlPoints": [{"position": [1, 2]}]}), "not 3 numbers"),
        ("a.mrk.json", markups({"controlPoints": [{"position": [1, 2, "3"]}]}), "not 3 numbers"),
        ("a.mrk.json", markups({"controlPoints": [{"position": [1, 2, 1e7]}]}), "1e+07 mm"),
        ("a.mrk.json", markups({"coordinateSystem": "IJK"}), "coordinate system IJK"),
        ("a.mrk.json", markups({"coordinateUnits": "um"}), "other than mm"),
        ("a.fcsv", head.replace("RAS", "2") + "1,1,2,3\n", "coordinate system 2"),
        ("a.fcsv", head + "1,1,2,x\n", 'line 2 that has no number z, but "x"'),
        ("a.fcsv", head + "1,1,2\n", 'no number z, but ""'),
        ("a.fcsv", head + '1,1,2,3,"\n', "ends inside quotes"),
        ("a.fcsv", "# columns = id,a\n", "no columns x, y and z"),
        ("a.fcsv", head + "1,nan,2,3\n", "coordinate of nan mm"),
        ("a.tag", "MNI Transform File\n", "does not begin with"),
        ("a.tag", tag.replace("2", "3"), "points of 3 volumes"),
        ("a.tag", tag + " 1 2 3 4 5 -inf;", '"-inf" in place of a number'),
        ("a.tag", tag + " 1 2 3 4 5 6", "ends before the semicolon"),
        ("a.tag", tag + " 1 2 3 4 5;", "5 numbers for a point in line 4"),
        ("a.tag", tag + " 1 2 3 4 5 6 7;", "7 numbers for a point"),
        ("a.tag", tag + ' 1 2 3 "a" ;', "at a wrong place in line 4"),
        ("a.tag", tag + " 1 2 3 4 5 6,5;", '"6,5" in place of a number'),
        ("a.csv", "x,y\n1,2\n", "names the columns x, y and z"),
        ("a.csv", "", "names the columns x, y and z"),
        ("a.csv", "x;y;z\n1,5;2;3\n", "a number has a point, not a comma"),
        ("a.csv", "x,y,z\n1,5,2,3\n", "a number has a point, not a comma"),
        ("a.csv", "x,y,z\n1,2\n", "2 of 3 coordinates"),
        ("a.csv", "x,y,z\n1,2,3mm\n", "z = 3mm; it is no number"),
        ("a.csv", "x,y,z\n1,2,inf\n", "coordinate of inf mm"),
        ("a.csv", "x,y,z\n1,2,3\n".encode("utf-16"), "text in UTF-8"),
        ("a.txt", "x,y,z\n1,2,3\n", "must be .mrk.json, .json, .fcsv, .tag, .csv or .tsv"),
    ]
    for name, text, words in cases:
        problem = refusal(name, text)
        assert words in problem, (name, text[:60], problem)
        assert "\n" not in problem and len(problem) < 500, problem
    for name, words in ((scratch("none.tag"), "does not exist"), (scratch("."), "extension"),
                        ("", "empty")):
        with messages():
            try:
                brainshift.read_points(name)
            except ValueError as error:
                assert words in str(error), error
            else:
                raise AssertionError(name)


def test_labels_in_other_encodings_are_marked():
    points = brainshift.read_points(written("latin.csv", b"label,x,y,z\nStra\xdfe,1,2,3\n"))
    assert points.labels == ["Stra\ufffde"]


def readers_of(name):
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    found = factory.GetReaders(name, servermanager.ActiveConnection.Session)
    return [found.GetString(i) for i in range(1, found.GetLength(), 3)]


def test_file_open_offers_the_reader_for_its_files():
    point = markups({"controlPoints": [{"position": [1, 2, 3]}]})
    for name in (AFIDS, RESECT, written("F.1.mrk.json", point)):
        assert readers_of(name) == ["LandmarkReader"], readers_of(name)
        source = simple.OpenDataFile(name)
        assert source.GetXMLName() == "LandmarkReader", source.GetXMLName()
        simple.Delete(source)
    # ParaView's own readers stay first for their endings, and alone with files of others.
    assert "LandmarkReader" not in readers_of(written("other.csv", "a,b\n1,2\n"))
    assert "LandmarkReader" not in readers_of(written("other.json", point))
    assert "LandmarkReader" not in readers_of(written("other.mrk.json", "{}"))
    table = written("named.csv", "X;Y;Z\n1;2;3\n")
    assert "LandmarkReader" in readers_of(table)
    source = simple.OpenDataFile(table)
    assert source.GetXMLName() == "CSVReader", "ParaView's own is the default"
    simple.Delete(source)
    os.remove(table)


run_tests(globals())
