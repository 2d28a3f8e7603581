# SPDX-License-Identifier: BSD-3-Clause
# Proves that points of each format arrive in RAS mm with their labels, as independent parsers of a
# few lines read them, that a damaged file ends in one sentence, and that File > Open offers the
# reader for its files and for no others.
import csv
import json
import os
import re
import shutil

import numpy
from brainshift_testing import assert_says, data, load_plugin, messages, run_tests, scratch

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import rolefiles  # noqa: E402
from landmark_testing import refusal, written  # noqa: E402
from paraview import servermanager, simple  # noqa: E402

AFIDS = data("afids-colin27", "sub-Colin27_afids.fcsv")
RESECT = data("resect", "Case1-MRI-beforeUS.tag")
LABELS = ['Straße, "links"', "後頭葉", "", "#1; a\tb"]
PLACES = numpy.array([[1.5, -2.25, 3.0], [-10.0, 20.0, 1e-3], [0.1, 0.2, 0.3], [7.0, 8.0, -9.0]])
LPS = (-1.0, -1.0, 1.0)


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
    for named, right in (({}, numbers[:, :3]), ({"volume": 1}, numbers[:, :3]),
                         ({"volume": 2}, numbers[:, 3:])):
        with messages() as said:
            found = brainshift.read_points(RESECT, **named)
        assert numpy.array_equal(found.positions, right), named
        assert ("the points of two volumes" in said.text) == (not named), (named, said.text)
    with messages() as said:  # a case reads both
        rest, measured = brainshift.Case(landmarks=RESECT).landmarks
    assert (rest.Volume, measured.Volume) == (1, 2) and "two volumes" not in said.text, said.text


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
    # The code of a unit, its scheme and its name, as Slicer's schema 1.0.3 has them.
    text = markups({"coordinateUnits": ["mm", "UCUM", "millimeter"], "coordinateSystem": "RAS",
                    "controlPoints": controls(PLACES, LABELS)})
    assert numpy.array_equal(
        brainshift.read_points(written("units.mrk.json", text)).positions, PLACES)
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
        for end in ("\n", "\r\n", "\r"):
            for mark in ("", "\ufeff"):
                text = mark + end.join(["# a comment", *map(separator.join, rows), ""])
                points = brainshift.read_points(written("table.csv", text))
                assert points.positions.tolist() == [[1, 2, 3], [4, 5, 6]]
                assert points.labels == ["a", "b"]
                assert numpy.array_equal(points.times, [0.5, numpy.nan], equal_nan=True)
                assert points.deviations.tolist() == [0.25, 0.01]
                assert numpy.isnan(points.numbers).all()
    for time in ("time_ms", "Time (ms)", "time [s]", "TIME"):
        text = f"x,y,z,{time},deviation (mm)\n1,2,3,500,0.5\n"
        points = brainshift.read_points(written("table.csv", text))
        assert points.times.tolist() == [500] and points.deviations.tolist() == [0.5], time
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


def test_names_in_the_comment_above_a_table_of_numbers():
    """numpy writes its header as a comment. The first line of numbers is a point, too."""
    for names, separator, right in (("x,y,z", ",", PLACES), ("x_cm;y_cm;z_cm", ";", 10 * PLACES),
                                    ("l\tp\ts", "\t", PLACES * LPS),
                                    ("made by hand\nx,y,z", ",", PLACES)):
        name = scratch("numpy.csv")
        numpy.savetxt(name, PLACES, header=names, delimiter=separator)
        with messages() as said:
            found = brainshift.read_points(name).positions
        assert not said.text and numpy.allclose(found, right, rtol=0, atol=1e-12), (names, found)
    numpy.savetxt(name, PLACES, header="i,j,k", delimiter=",")
    found = brainshift.read_points(name, columns=["i", "j", "k"])
    assert numpy.array_equal(found.positions, PLACES)
    assert "it names 1.5" in refusal("numpy.csv", "# made by hand\n1.5,2,3\n4,5,6\n")
    # A comment above a line of names stays one.
    found = brainshift.read_points(written("numpy.csv", "# z,y,x\nx,y,z\n1,2,3\n"))
    assert found.positions.tolist() == [[1, 2, 3]]


def test_deviations_have_their_own_unit_or_that_of_the_positions():
    """A deviation of 0.2 cm is one of 2 mm, in memory and in the file that is written."""
    for names, mm, words in (
            ("x_cm,y_cm,z_cm,deviation_cm", 2.0, ""), ("x_cm,y_cm,z_cm,deviation", 2.0, ""),
            ("x_cm,y_cm,z_cm,deviation_mm", 0.2, ""), ("x,y,z,deviation (cm)", 2.0, ""),
            ("x,y,z,deviation (1 sd, mm)", 0.2, ""), ("x,y,z,deviation", 0.2, ""),
            ("x_cm,y_cm,z_cm,deviation_s", 2.0, "deviation_s, whose unit is no length"),
            ("# units: cm\nx,y,z,deviation", 2.0, "")):
        comment, names = names.split("\n") if "\n" in names else ("", names)
        names = ",".join(f'"{name}"' for name in re.split(",(?! )", names))
        file = written("deviations.csv", f"{comment}\nname,{names}\nA,1,2,3,0.2\n")
        with messages() as said:
            found = brainshift.read_points(file).deviations
        assert numpy.allclose(found, [mm], rtol=0, atol=1e-12), (names, found)
        assert words in said.text and (words or not said.text), (names, said.text)
        with messages():
            brainshift.map_points(file, scratch("deviations_mm.csv"))
        again = brainshift.read_points(scratch("deviations_mm.csv"))
        assert numpy.allclose(again.deviations, [mm], rtol=0, atol=1e-12), (names, again)
    of_each = written("deviations.csv", "x,y,z,unit,deviation\n1,2,3,cm,0.2\n1,2,3,mm,0.2\n")
    assert numpy.allclose(brainshift.read_points(of_each).deviations, [2.0, 0.2])
    assert "have several" in refusal("deviations.csv", "x_cm,y_cm,z_mm,deviation\n1,2,3,0.2\n",
                                     columns=["x_cm", "y_cm", "z_mm"])
    assert "unit px" in refusal("deviations.csv", "x,y,z,deviation (px)\n1,2,3,0.2\n")


def test_times_keep_their_unit_when_they_are_written():
    for name, kept in (("time_ms", "time_ms"), ("Time [s]", "time_s"), ("time", "time"),
                       ("time (ticks)", "time (ticks)")):
        file = written("times.csv", f"name,x,y,z,{name}\nA,1,2,3,500\n")
        brainshift.map_points(file, scratch("times_written.csv"))
        with open(scratch("times_written.csv"), encoding="utf-8") as lines:
            assert lines.read() == f"label,r,a,s,{kept}\nA,1,2,3,500\n"


def test_table_of_slicer():
    text = ('label,l,p,s,defined,selected,visible,locked,description\n'
            '"a ""1"", two\nlines",1,2,3,1,1,1,0,\nF-2,,,,0,1,1,0,\n#3,4,5,6,1,1,1,0,\n')
    with messages() as said:
        points = brainshift.read_points(written("slicer.csv", text))
    assert points.labels == ['a "1", two\nlines', "#3"]
    assert points.positions.tolist() == [[-1, -2, 3], [-4, -5, 6]]
    assert_says(said.text, "1 point without a position")


def entries_of_page():
    """The entries that the page of the folder lists, with the kind of file."""
    here = os.path.dirname(os.path.abspath(__file__))
    page = os.path.join(here, "..", "..", "..", "Formats", "Landmarks", "README.md")
    with open(page, encoding="utf-8") as file:
        text = file.read().split("## What is honoured")[1]
    text = text.replace("(`", "(").replace("`)", ")")
    return [f"{name} {kind}"
            for name, kind in re.findall(r"^\| `([^`]*)` \((.*?)\) \|", text, re.MULTILINE)]


def table_of(names, values="1,2,3", name="walk.csv"):
    return written(name, f"name,{names}\nLA1,{values}\nLA2,7,8,9\n")


def walked_markups():
    good = markups({"coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": [
        {"label": "a", "position": [1, 2, 3], "positionStatus": "defined"}]})
    first = brainshift.read_points(written("walk.mrk.json", good)).positions.tolist()
    assert first == [[1, 2, 3]]
    lps = good.replace("RAS", "LPS")
    assert brainshift.read_points(written("walk.mrk.json", lps)).positions.tolist() == [[-1, -2, 3]]
    for old, new, words in (
            ('"RAS"', '"ARS"', "coordinate system ARS"),
            ("coordinateSystem", "coordinatesystem", "Slicer writes coordinateSystem"),
            ('"mm"', '"cm"', "other than mm"),
            ("coordinateUnits", "CoordinateUnits", "Slicer writes coordinateUnits"),
            ("controlPoints", "controlpoints", "Slicer writes controlPoints"),
            ('"position":', '"Position":', "Slicer writes position"),
            ("positionStatus", "PositionStatus", "Slicer writes positionStatus"),
            ('"label"', '"position": [4, 5, 6], "label"', "has the key position twice"),
            ('"coordinateUnits"', '"coordinateSystem": "LPS", "coordinateUnits"',
             "has the key coordinateSystem twice"),
            ('"markups": [', '"markups": [], "markups": [', "has the key markups twice"),
            ('"label"', '"Label"', "Slicer writes label"),
            ('{"@schema"', '{"coordinateSystem": "RAS", "@schema"', "at a wrong place"),
            ('{"@schema"', '{"CoordinateUnits": "cm", "@schema"', "at a wrong place"),
            ('"label"', '"coordinateSystem": "LPS", "label"', "at a wrong place"),
            ("[1, 2, 3]", "[1, 2]", "not 3 numbers")):
        assert words in refusal("walk.mrk.json", good.replace(old, new)), new
    numbered = good.replace('"a"', "7")
    assert brainshift.read_points(written("walk.mrk.json", numbered)).labels == ["7"]
    with messages() as said:
        hidden = good.replace('"defined"', '"undefined"')
        assert len(brainshift.read_points(written("walk.mrk.json", hidden)).positions) == 0
    assert_says(said.text, "1 point without a position")
    return {f"{name} .mrk.json" for name in (
        "coordinateSystem", "coordinateUnits", "label", "controlPoints", "position",
        "positionStatus")}


def walked_fiducials_and_tags():
    head = "# CoordinateSystem = LPS\n# columns = id,x,y,z,label\n1,1,2,3,a\n"
    for text in (head, head.replace("CoordinateSystem", "Coordinate System"),
                 head.replace("# columns", "# coordinateUnits = mm\n# columns")):
        found = brainshift.read_points(written("walk.fcsv", text)).positions
        assert found.tolist() == [[-1, -2, 3]], text
    # Above the points or below them, after = or a colon; without it RAS.
    mark, points = "# CoordinateSystem = LPS\n", head.split("\n", 1)[1]
    for text, right in ((points + mark, [-1, -2, 3]), (points, [1, 2, 3]),
                        (mark.replace(" =", ":") + points, [-1, -2, 3]),
                        (mark + "# units: mm\n" + points + mark, [-1, -2, 3])):
        found = brainshift.read_points(written("walk.fcsv", text))
        assert found.positions.tolist() == [right] and found.labels == ["a"], text
    assert "contradicts" in refusal("walk.fcsv", head + mark.replace("LPS", "RAS"))
    assert "must be mm" in refusal("walk.fcsv", head + "# unit: cm\n")
    for old, new, words in (("LPS", "LP", "coordinate system LP"), ("id,x", "id,u", "no columns x"),
                            ("# columns", "# coordinateUnits = cm\n# columns", "must be mm"),
                            ("# columns", "# Coordinate System = RAS\n# columns",
                             "contradicts itself"),
                            ("# columns", "# columns = id,y,x,z\n# columns",
                             "has the line # columns twice")):
        assert words in refusal("walk.fcsv", head.replace(old, new)), new
    tag = "MNI Tag Point File\nVolumes = 1;\nPoints =\n 1 2 3;\n"
    assert brainshift.read_points(written("walk.tag", tag)).positions.tolist() == [[1, 2, 3]]
    assert "3 volumes" in refusal("walk.tag", tag.replace("= 1", "= 3"))
    assert "2 numbers" in refusal("walk.tag", tag.replace("1 2 3", "1 2"))
    return {"CoordinateSystem .fcsv", "coordinateUnits .fcsv", "columns .fcsv", "Volumes .tag",
            "Points .tag"}


def walked_tables():
    """Each list of names, and where the position 1 2 3 of such columns lies."""
    seen = {"columns table", "several table", "n/a table", "x,y,z,, table", "time table",
            "deviation table", "# x,y,z table"}
    for entry, names, right in (
            ("x y z", "x,y,z", (1, 2, 3)), ("x y z", " X , Y [mm], z(mm)", (1, 2, 3)),
            ("r a s", "R,A,S", (1, 2, 3)), ("r a s", "right,anterior,superior", (1, 2, 3)),
            ("l p s", "l,p,s", (-1, -2, 3)), ("l p s", "Left,Posterior,Superior", (-1, -2, 3)),
            ("Points:0", "Points:0,Points:1,Points:2", (1, 2, 3)),
            ("x_ras", "x_ras_mm,y_ras_mm,z_ras_mm", (1, 2, 3)),
            ("x_ras", "RAS x,RAS y,RAS z", (1, 2, 3)), ("x_ras", "x_lps,y_lps,z_lps", (-1, -2, 3)),
            ("x_ras", "z (LPS),y (LPS),x (LPS)", (-3, -2, 1)),
            ("x_mni", "X_mni,Y_mni,Z_mni", (1, 2, 3)),
            ("x_mni", "MNI152.x,MNI152.y,MNI152.z", (1, 2, 3)),
            ("x_cm", "x_cm,y_cm,z_cm", (10, 20, 30)),
            ("x_cm", "R (m),A (m),S (m)", (1000, 2000, 3000)),
            ("x_cm", "x [µm],y [µm],z [µm]", (1e-3, 2e-3, 3e-3)),
            ("x_cm", "x_in,y_in,z_in", (25.4, 50.8, 76.2)),
            ("x_cm", "x in mm,y in mm,z in mm", (1, 2, 3)),
            ("-x", "-x,-y,z", (-1, -2, 3)), ("-x", "−x_lps,-y_lps,z_lps", (1, 2, 3)),
            ("x_coord", "x_coord,y_coord,z_coord", (1, 2, 3)),
            ("x_coord", "pos_x,pos_y,pos_z", (1, 2, 3))):
        with messages() as said:
            found = brainshift.read_points(table_of(names)).positions
        assert numpy.allclose(found[0], right, rtol=0, atol=1e-12), (names, found)
        assert ("template" in said.text) == (entry == "x_mni"), (names, said.text)
        seen.add(f"{entry} table")
    with messages() as said:
        found = brainshift.read_points(table_of("x,y,z", "n/a,N/A,n/a"))
    assert_says(said.text, "1 point without a position")
    assert found.labels == ["LA2"]
    return seen


def walked_units_and_frames():
    """In columns and comments, where the position 1 2 3 lies, and what is said."""
    seen = set()
    table = "name,x,y,z\na,1,2,3\n"
    cases = [("unit", f"name,x,y,z,{key}\na,1,2,3,{word}\n", right, "")
             for key, word, right in (
                 ("unit", "cm", (10, 20, 30)), ("Units", "m", (1000, 2000, 3000)),
                 ("coordinate_units", "Inch", (25.4, 50.8, 76.2)), ("unit", "", (1, 2, 3)),
                 ("unit", "n/a", (1, 2, 3)))]
    cases += [("coordinateSystem", f"name,x,y,z,{key}\na,1,2,3,{word}\n", right, words)
              for key, word, right, words in (
                  ("coordinateSystem", "LPS", (-1, -2, 3), ""),
                  ("coordinate system", "1", (-1, -2, 3), ""), ("space", "RAS", (1, 2, 3), ""),
                  ("space", "MNI152NLin6Asym", (1, 2, 3), "template, not of the scanner"),
                  ("space", "native", (1, 2, 3), "system native, which is not known"),
                  ("frame", "1", (1, 2, 3), ""))]
    cases += [("# units", text, right, words) for text, right, words in (
        ("# CoordinateSystem = LPS\n" + table, (-1, -2, 3), ""),
        ("# CoordinateSystem = LPS,,, ,\n" + table, (-1, -2, 3), ""),  # of a spreadsheet
        ("#space: lps\n" + table, (-1, -2, 3), ""), ("# units: cm\n" + table, (10, 20, 30), ""),
        ("# unit = mm, as in the scan\n" + table, (1, 2, 3), ""),
        (table + "# coordinate units: cm\n", (10, 20, 30), ""),
        ("# units: cm, CoordinateSystem: LPS\n" + table, (-10, -20, 30), ""),
        ("# CoordinateSystem: LPS, units: cm\n" + table, (-10, -20, 30), ""),
        ("# axes = LPS (cm)\n" + table, (-10, -20, 30), ""),
        ("# units: LPS cm\n" + table, (-10, -20, 30), ""),
        ("# orientation: LPS\n" + table, (-1, -2, 3), ""),
        ("# space: fsaverage\n" + table, (1, 2, 3), "fsaverage, which is that of a template"),
        ("# Coordinate System = 1\n# made by hand: yes\n" + table, (-1, -2, 3), ""))]
    for entry, text, right, words in cases:
        with messages() as said:
            found = brainshift.read_points(written("said.csv", text))
        assert numpy.allclose(found.positions, [right], rtol=0, atol=1e-12), (text, found)
        assert found.labels == ["a"] and words in said.text and (words or not said.text), (
            text, said.text)
        seen.add(f"{entry} table")
    with messages() as said:
        found = brainshift.read_points(written("said.csv", "name,x,y,z,units\na,1,2,3,kOhm\n"))
    assert found.positions.tolist() == [[1, 2, 3]]
    assert_says(said.text, "the unit kOhm, which is no length")
    two = brainshift.read_points(written("said.csv", "x,y,z,unit\n1,2,3,mm\n1,2,3,cm\n"))
    assert two.positions.tolist() == [[1, 2, 3], [10, 20, 30]], "each point has its own"
    for text, words in (("x,y,z,space\n1,2,3,voxel\n", "the positions are voxel"),
                        ("x,y,z,unit\n1,2,3,px\n", "the unit px"),
                        ("x,y,z,coordinateUnits\n1,2,3,kOhm\n", "the unit kOhm"),
                        ("# units: pixels\nx,y,z\n1,2,3\n", "the unit pixels"),
                        ("x,y,z,space\n1,2,3,CTF\n", "CTF, whose x points to the front"),
                        ("x_cm,y_cm,z_cm,unit\n1,2,3,mm\n", "two units"),
                        ("# units: cm\nx,y,z,unit\n1,2,3,mm\n", "two units"),
                        ("r,a,s,space\n1,2,3,LPS\n", "two kinds of axes"),
                        ("# axes: RAS\nx,y,z\n1,2,3\n# axes: LPS\n", "two kinds of axes")):
        assert words in refusal("said.csv", text), text
    return seen


def walked_names():
    """Tables, their names, and the column that the remark names; none for label and name."""
    for text, labels, column in (
            ("name,x,y,z\na,1,2,3\nb,4,5,6\n", ["a", "b"], None),
            ("x,y,z,LABEL,electrode\n1,2,3,a,c\n4,5,6,b,d\n", ["a", "b"], None),
            ("electrode,x,y,z\nA1,1,2,3\nA2,4,5,6\n", ["A1", "A2"], "electrode"),
            ("contact\tx\ty\tz\nA1\t1\t2\t3\n", ["A1"], "contact"),
            ("Landmark,R,A,S\nAC,1,2,3\n", ["AC"], "Landmark"),
            ("Nom;X;Y;Z\nA1;1;2;3\n", ["A1"], "Nom"),
            ("Punkt;X;Y;Z\n1;1;2;3\n2;1;2;3\n", ["1", "2"], "Punkt"),
            ("id,x,y,z\n7,1,2,3\n8,4,5,6\n", ["7", "8"], "id"),
            ("point id,x,y,z\n7,1,2,3\n", ["7"], "point id"),
            ("id,title,x,y,z\n7,AC,1,2,3\n8,PC,4,5,6\n", ["AC", "PC"], "title"),
            ("label,electrode,x,y,z\n,A1,1,2,3\n,A2,4,5,6\n", ["A1", "A2"], "electrode"),
            ("side,wo,x,y,z\nL,AC,1,2,3\nL,PC,4,5,6\n", ["AC", "PC"], "column 2 (wo)"),
            (',x,y,z\n"A1",1,2,3\n"A2",4,5,6\n', ["A1", "A2"], "column 1"),
            ("名前,x,y,z\nA1,1,2,3\n", ["A1"], "column 1"),
            ("channel,x,y,z\nA,1,2,3\nA,4,5,6\n", ["A", "A"], "channel"),
            # What these hold are no names.
            ("side,x,y,z\nL,1,2,3\nL,4,5,6\n", ["", ""], None),
            ("size,x,y,z\n7,1,2,3\n8,4,5,6\n", ["", ""], None),
            ("comment,x,y,z\ngood,1,2,3\nbad,4,5,6\n", ["", ""], None),
            ("subject_id,x,y,z\nsub-01,1,2,3\n", [""], None),
            ("label,number,x,y,z\n,7,1,2,3\n", [""], None)):
        with messages() as said:
            found = brainshift.read_points(written("names.csv", text))
        assert found.labels == labels, (text, found.labels)
        if column is None:
            assert "takes the names" not in said.text, (text, said.text)
        else:
            assert_says(said.text, "takes the names of its points from", column)
    return {"label name table", "electrode table", "words table"}


def refused_tables():
    for names, words in (("x,y,x", "names the columns x, y and z"),
                         ("x_tkr,y_tkr,z_tkr", "x_tkr, y_tkr, z_tkr; name three"),
                         ("i,j,k", "Position Columns"), ("l_ras,p_ras,s_ras", "Position Columns"),
                         ("x_cm,y_mm,z_mm", "Position Columns"), ("L,A,S", "Position Columns"),
                         ("x-,y-,z", "Position Columns"),
                         ("native_x,native_y,native_z", "Position Columns")):
        assert words in refusal("walk.csv", f"name,{names}\nLA1,1,2,3\n"), names
    several = "x_ras,y_ras,z_ras,x_mni,y_mni,z_mni\n1,2,3,4,5,6\n"
    assert_says(refusal("walk.csv", several), "several positions: ", "x_ras y_ras z_ras",
                "x_mni y_mni z_mni")
    assert "names the column x twice" in refusal("walk.csv", "x,x,y,z\n1,1,2,3\n")
    assert "several positions" in refusal("walk.csv", "x,y,z,r,a,s\n1,2,3,4,5,6\n")
    name = written("walk.csv", several)
    for columns, right in ((("x_mni", "y_mni", "z_mni"), (4, 5, 6)),
                           (("X_RAS", "y_ras", "z_ras"), (1, 2, 3))):
        with messages():
            found = brainshift.read_points(name, columns=columns)
        assert found.positions.tolist() == [list(right)]
    name = written("walk.csv", "i;j;k\n1;2;3\n")
    found = brainshift.read_points(name, columns=["i", "j", "k"], table_axes="LPS")
    assert found.positions.tolist() == [[-1, -2, 3]]
    for columns, words in ((["i", "j", "l"], "the column l 0 times"),
                           (["i", "j"], "by 2 position")):
        assert words in refusal("walk.csv", "i;j;k\n1;2;3\n", columns=columns)


def test_words_of_the_columns_that_a_caller_names_count():
    for names, right, unknown in (
            ("native_x_cm,native_y_cm,native_z_cm", (10, 20, 30), "native"),
            ("native_x_lps,native_y_lps,native_z_lps", (-1, -2, 3), "native"),
            ("y_cm,x_cm,z_cm", (10, 20, 30), None), ("L,A,S", (-1, 2, 3), None),
            ("R,P,S", (1, -2, 3), None), ("L,P,I", (-1, -2, -3), None),
            ("P,L,S", (-2, -1, 3), None), ("S,A,R", (3, 2, 1), None),
            ("x (L+),y (P+),z (S+)", (-1, -2, 3), None),
            ("x (left),y (posterior),z (superior)", (-1, -2, 3), None),
            ("x_mm,y_mm,z_cm", (1, 2, 30), None), ("x,y_mm,z", (1, 2, 3), None),
            ("x (inch),y (inch),z (inch)", (25.4, 50.8, 76.2), None),
            ("-a_x,-a_y,a_z", (-1, -2, 3), None), ("i,j,k", (1, 2, 3), None),
            ("b_mni_x,b_mni_y,b_mni_z", (1, 2, 3), "template")):
        with messages() as said:
            found = brainshift.read_points(table_of(names), columns=names.split(","))
        assert numpy.allclose(found.positions[0], right, rtol=0, atol=1e-12), (names, found)
        assert (unknown or "") in said.text, (names, said.text)
        assert unknown or not said.text, (names, said.text)
    for names, words in (("vox_x,vox_y,vox_z", "counted in vox"),
                         ("x_lps,y_ras,z_ras", "some are RAS and some LPS"),
                         ("L_ras,P_ras,S_ras", "contradict"), ("r_lps,a_lps,s_lps", "contradict"),
                         ("x_cm,y,z", "a unit for some"), ("R,L,S", "no three axes"),
                         ("R,P,z", "no three axes")):
        text = f"name,{names}\nLA1,1,2,3\n"
        assert words in refusal("walk.csv", text, columns=names.split(",")), names


def test_a_coordsystem_above_its_table_counts_in_a_data_set():
    table = "data/sub-01/ieeg/sub-01_electrodes.tsv"
    shutil.rmtree(scratch("data"), ignore_errors=True)
    os.makedirs(scratch("data/sub-01/ieeg"))
    written(table, "name\tx\ty\tz\nLA1\t1\t2\t3\n")
    written("data/sub-01_coordsystem.json", json.dumps({
        "EMGCoordinateSystem": "ScanRAS", "EMGCoordinateUnits": "cm"}))
    with messages() as said:
        assert brainshift.read_points(scratch(table)).positions.tolist() == [[1, 2, 3]]
    assert "no coordsystem.json beside it" in said.text  # the folders are no data set
    written("data/dataset_description.json", "{}")
    with messages() as said:
        assert brainshift.read_points(scratch(table)).positions.tolist() == [[10, 20, 30]]
    assert not said.text, said.text
    assert scratch("data/sub-01_coordsystem.json") in rolefiles.files_of(scratch(table))
    written("data/sub-01_coordsystem.json", json.dumps({
        "EMGCoordinateSystem": "Other", "EMGCoordinateUnits": "percent"}))
    assert "says the unit percent" in refusal(table, "name\tx\ty\tz\nLA1\t1\t2\t3\n")


def test_a_head_of_less_than_a_millimetre_is_doubted():
    for count, words in ((3, "has 3 points within"), (2, "")):
        rows = [f"e{i},{0.01 * i},{0.02 * i},0.1" for i in range(count)]
        with messages() as said:
            brainshift.read_points(written("small.csv", "\n".join(["name,x,y,z", *rows])))
        assert words in said.text and ("in metres" in said.text) == bool(words), said.text


def notes_of(name):
    with messages() as said:
        brainshift.read_points(scratch(name))
    return said.text


def walked_electrodes():
    table = "sub-01_ses-1_space-X_electrodes.tsv"
    text = "name\tx\ty\tz\tsize\nLA1\t1\t2\t3\t5\nLA2\tn/a\tn/a\tn/a\tn/a\n"
    for name in os.listdir(scratch(".")):
        if name.endswith("_coordsystem.json"):
            os.remove(scratch(name))
    with messages() as said:
        assert brainshift.read_points(written(table, text)).positions.tolist() == [[1, 2, 3]]
    assert_says(said.text, "no coordsystem.json", "1 point without a position")
    written("sub-02_coordsystem.json", '{"iEEGCoordinateUnits": "um"}')  # of another
    assert "sub-02_coordsystem.json is about other positions" in notes_of(table)
    written("sub-01_coordsystem.json", '{"iEEGCoordinateUnits": "cm"}')
    beside = "sub-01_space-X_coordsystem.json"
    for unit, mm in (("mm", 1), ("cm", 10), ("m", 1000), ("um", 1e-3)):
        written(beside, json.dumps({"iEEGCoordinateSystem": "ScanRAS",
                                    "iEEGCoordinateUnits": unit}))
        with messages() as said:
            found = brainshift.read_points(scratch(table)).positions
        assert numpy.allclose(found, mm * numpy.array([[1, 2, 3]]), rtol=1e-12), (unit, found)
        assert "coordinate system" not in said.text
    lps = numpy.array([[-1, -2, 3]])
    for system, words, named in (
            ("MNI152NLin2009cAsym", "template", {}), ("fsaverage", "template", {}),
            ("IXI549Space", "template", {}), ("ICBM452AirSpace", "template", {}),
            ("CapTrak", "between the ears", {}), ("ElektaNeuromag", "between the ears", {}),
            ("ChietiItab", "between the ears", {}), ("BESA", "between the ears", {}),
            ("ACPC", "anterior commissure", {}), ("Other", "not known", {}),
            ("T1w", "not known", {}), ("LPS", "", {}), ("Other", "not known", {"mirror": True})):
        written(beside, json.dumps({
            "EEGCoordinateSystem": system, "EEGCoordinateUnits": "mm",
            "EEGCoordinateSystemDescription": "x to the left"}))
        options = {"table_axes": "LPS"} if named else {}
        with messages() as said:
            found = brainshift.read_points(scratch(table), **options).positions
        assert numpy.array_equal(found, lps if named or system == "LPS" else -lps * (1, 1, -1))
        assert words in said.text, (system, said.text)
        assert (f"coordinate system {system}" in said.text) == bool(words), (system, said.text)
        assert ("x to the left" in said.text) == (words == "not known"), (system, said.text)
    for system, unit, words in (("ScanRAS", "pixels", "pixels"), ("Pixels", "mm", "are Pixels"),
                                ("CTF", "cm", "CTF, whose x points to the front"),
                                ("CTF ", "mm", "x points to the front"),
                                ("4D BTi", "mm", "4D BTi, whose x points to the front"),
                                ("KIT/Yokogawa", "mm", "x points to the front"),
                                ("EEGLAB-HJ", "mm", "x points to the front"),
                                ("ScanRAS", "inch", "unit inch"),
                                ("ScanRAS", "", "does not say CoordinateUnits")):
        written(beside, json.dumps({"EEGCoordinateSystem": system, "EEGCoordinateUnits": unit}))
        assert words in refusal(table, text), (system, unit)
    written(beside, '{"iEEGCoordinateUnits": "mm", "iEEGCoordinateUnits": "cm"}')
    assert "has the key iEEGCoordinateUnits twice" in refusal(table, text)
    written(beside, json.dumps({"EEGCoordinateUnits": "mm"}))
    assert "does not say CoordinateSystem" in notes_of(table)
    written(beside, "{")
    assert "is not good JSON" in refusal(table, text)
    os.remove(scratch(beside))
    with messages():
        assert brainshift.read_points(scratch(table)).positions.tolist() == [[10, 20, 30]]
    return {"CoordinateUnits BIDS", "CoordinateSystem BIDS", "coordsystem.json BIDS"}


def test_entries_of_the_page_are_honoured_or_refused():
    refused_tables()
    walked = (walked_markups() | walked_fiducials_and_tags() | walked_tables() | walked_names()
              | walked_units_and_frames()
              | walked_electrodes())
    assert sorted(walked) == sorted(entries_of_page()), walked ^ set(entries_of_page())


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
        ("a.mrk.json", markups({"coordinateUnits": ["cm", "UCUM", "mm"]}), "other than mm"),
        ("a.mrk.json", markups({"coordinateUnits": ["mm", "DCM"]}), "scheme other than UCUM"),
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
        ("a.txt", "x,y,z\n1,2,3\n", "must be .mrk.json, .json, .fcsv, .csv, .tsv or .tag"),
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


def test_text_that_is_no_utf8_is_latin_1_and_that_is_said():
    head = "# CoordinateSystem = RAS\n1,1,2,3,0,0,0,1,1,1,0,"
    for name, text in (("latin.csv", "label,x,y,z\nStraße,1,2,3\n"),
                       ("latin.fcsv", head + "Straße,,\n"),
                       ("latin.tag", 'MNI Tag Point File\nVolumes = 1;\nPoints = 1 2 3 "Straße";')):
        for coding in ("latin-1", "utf-8"):
            with messages() as said:
                points = brainshift.read_points(written(name, text.encode(coding)))
            assert points.labels == ["Straße"], (name, coding, points.labels)
            assert points.positions.tolist() == [[1, 2, 3]]
            assert ("read as Latin-1" in said.text) == (coding == "latin-1"), said.text
    with messages():
        found = brainshift.read_points(written("latin.csv", "x [µm],y [µm],z [µm]\n1,2,3\n".encode(
            "latin-1")))
    assert numpy.allclose(found.positions, [[1e-3, 2e-3, 3e-3]])


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
