# SPDX-License-Identifier: BSD-3-Clause
# Proves that a table of landmarks whose columns name two positions, or that contradicts the
# coordsystem.json beside it, is refused or told by sentences that are true; and that what comments
# and columns of known programs say of axes and units counts or is told.
import json

from brainshift_testing import load_plugin, messages, run_tests

load_plugin()
import brainshift  # noqa: E402 after the plugin
from landmark_testing import refusal, written  # noqa: E402 after the plugin


def test_two_names_of_one_axis_are_no_name_that_is_there_twice():
    row = ",1,2,3,4,5,6\n"
    for names, words in (
            ("x,y,z,x_mm,y_mm,z_mm", "has several positions: x y z, and x_mm y_mm z_mm; name the"),
            ("x_mm,y_mm,z_mm,x,y,z", "has several positions: x_mm y_mm z_mm, and x y z; name the"),
            ("x,x_mm,y,z,a,b", "has two columns for one axis of its positions, x and x_mm; name"),
            ("x,y,z,Y,a,b", "names the column y twice")):
        assert words in refusal("twins.csv", f"name,{names}\np{row}"), names
    text = f"name,x,y,z,x_mm,y_mm,z_mm\np{row}"
    found = brainshift.read_points(written("twins.csv", text), columns=["x_mm", "y_mm", "z_mm"])
    assert found.positions.tolist() == [[4, 5, 6]]


def test_a_coordsystem_that_contradicts_its_table_is_said():
    table = "sub-09_electrodes.tsv"
    counts = "what the table says counts"
    for head, unit, system, words in (
            ("x_cm\ty_cm\tz_cm", "m", "ScanRAS",
             "units of 10 mm by its own words, and of 1000 mm by its coordsystem.json"),
            ("x_cm\ty_cm\tz_cm", "cm", "ScanRAS", ""), ("x\ty\tz", "m", "ScanRAS", ""),
            ("l\tp\ts", "mm", "ScanRAS", "along LPS by its own words, and along RAS"),
            ("l\tp\ts", "mm", "ScanLPS", ""), ("l\tp\ts", "mm", "Other", "")):
        written("sub-09_coordsystem.json", json.dumps({
            "iEEGCoordinateSystem": system, "iEEGCoordinateUnits": unit}))
        with messages() as said:
            brainshift.read_points(written(table, f"name\t{head}\nA\t1\t2\t3\nB\t4\t5\t6\n"))
        assert said.text.count(counts) == bool(words) and words in said.text, (head, said.text)
    written("sub-09_coordsystem.json", json.dumps({
        "iEEGCoordinateSystem": "ScanRAS", "iEEGCoordinateUnits": "mm"}))
    with messages() as said:
        brainshift.read_points(written(table, "name\tx\ty\tz\tunits\nA\t1\t2\t3\tm\n"))
    assert "units of 1000 mm by its own words, and of 1 mm" in said.text, said.text


def test_a_coordsystem_of_another_space_than_the_name_of_its_table_is_said():
    for space, system, words in (
            ("MNI152Lin", "ScanRAS", "the space MNI152Lin by its name, and in ScanRAS by"),
            ("ScanRAS", "fsaverage", "the space ScanRAS by its name, and in fsaverage by"),
            ("CTF", "ScanRAS", "the space CTF by its name, and in ScanRAS by"),
            ("MNI152Lin", "MNI152Lin", ""), ("Mine", "ScanRAS", ""), ("Mine", "Other", "")):
        written(f"sub-66_space-{space}_coordsystem.json", json.dumps({
            "iEEGCoordinateSystem": system, "iEEGCoordinateUnits": "mm"}))
        said = read(f"sub-66_space-{space}_electrodes.tsv", "name\tx\ty\tz\nA\t1\t2\t3\n")[1]
        assert words in said and ("by its name" in said) == bool(words), (space, system, said)


def read(name, text, **named):
    """The first position of a table, and what is said."""
    with messages() as said:
        found = brainshift.read_points(written(name, text), **named)
    return found.positions[0].tolist(), said.text


def test_the_columns_of_ants_and_rave_and_eeglab_are_told():
    """No header names its axes: those of ANTs are LPS, those of RAVE are FreeSurfer's, and those of
    EEGLAB go to the front and the left."""
    ants = "begins with the columns x, y, z, t of points of ANTs, which are LPS"
    rows = "\n1,2,3,0,1,0\n4,5,6,0,2,0\n"
    for head, named, right, words in (
            ("x,y,z,t,label,comment", {}, [1, 2, 3], ants),
            ("# x,y,z,t,label,comment", {}, [1, 2, 3], ants),  # as numpy.savetxt writes it
            ("X,Y,Z,T,label,mass", {}, [1, 2, 3], ants),
            ("x,y,z,t,label,comment", {"columns": ["x", "y", "z"]}, [1, 2, 3], ants),
            ("x,y,z,t,label,comment", {"table_axes": "LPS"}, [-1, -2, 3], ""),
            ("# axes: RAS\nx,y,z,t,label,comment", {}, [1, 2, 3], ""),
            ("# axes: LPS\nx,y,z,t,label,comment", {}, [-1, -2, 3], ""),
            ("r,a,s,t,label,comment", {}, [1, 2, 3], ""),
            ("x,y,z,time,label,comment", {}, [1, 2, 3], "")):
        found, said = read("ants.csv", head + rows, **named)
        assert found == right and words in said and (words or not said), (head, named, said)
    assert "LPS (Table Axes)" in read("ants.csv", "x,y,z,t\n1,2,3,0\n")[1]
    rave = "those of a surface of FreeSurfer, not of the scanner"
    for head, words in (("Electrode,Coord_x,Coord_y,Coord_z,Label", rave),
                        ("# space: RAS\nElectrode,Coord_x,Coord_y,Coord_z,Label", ""),
                        ("Site,Coord_x,Coord_y,Coord_z,Label", "")):
        found, said = read("electrodes.csv", head + "\n13,1,2,3,G1\n14,4,5,6,G2\n")
        assert found == [1, 2, 3] and words in said and (words or not said), (head, said)
    channels = "labels,theta,radius,{},sph_theta,sph_phi\nFp1,-18,0.5,80,26,-4,18,-2\n"
    assert "to the front and y to the left" in read("eeglab.csv", channels.format("X,Y,Z"))[1]
    turned = read("eeglab.csv", channels.format("A,L,S"), columns=["A", "L", "S"])
    assert turned[0] == [-26, 80, -4] and "front" not in turned[1], turned


def test_the_space_in_the_name_of_electrodes_counts_without_a_coordsystem():
    rows = "name\tx\ty\tz\nA\t1\t2\t3\n"
    for space, words in (("MNI152Lin", "that of a template"), ("ScanRAS", ""),
                         ("Mine", "not known"), ("CapTrak", "between the ears")):
        said = read(f"sub-77_space-{space}_electrodes.tsv", rows)[1]
        assert words in said and ("coordinate system" in said) == bool(words), (space, said)
    assert "x points to the front" in refusal("sub-77_space-CTF_electrodes.tsv", rows)


def test_comments_in_plain_words_count():
    table = "name,x,y,z\na,1,2,3\n"
    for comment, right in (
            ("# coordinates: LPS", [-1, -2, 3]), ("# LPS, cm", [-10, -20, 30]),
            ("# coordinates units: cm", [10, 20, 30]), ("# LPS", [-1, -2, 3]),
            ("# All positions are in LPS (mm).", [-1, -2, 3]), ("# units cm", [10, 20, 30]),
            ("# x, y, z in LPS", [-1, -2, 3]), ("# RAS mm", [1, 2, 3]),
            ("# coordinates: RAS, units: cm", [10, 20, 30]), ("# in metres", [1000, 2000, 3000])):
        assert read("plain.csv", f"{comment}\n{table}") == (right, ""), comment
    below = read("plain.csv", f"{table}# coordinates: LPS\n")
    assert below == ([-1, -2, 3], ""), below
    for text, words in (("# LPS\n# RAS\n" + table, "two kinds of axes"),
                        ("# coordinates in cm\n" + table.replace("x,y,z", "x_mm,y_mm,z_mm"),
                         "two units"),
                        ("# coordinates units: furlongs\n" + table, "the unit furlongs")):
        assert words in refusal("plain.csv", text), text


def test_comments_that_may_be_about_something_else_are_told():
    table = "name,x,y,z\na,1,2,3\n"
    told = "which does not count; if it is about the positions, write it as"
    for comment in ("# made from LPS points", "# voxel coordinates", "# MNI space",
                    "# cm on the scalp", "# tkRAS, mm"):
        found, said = read("plain.csv", f"{comment}\n{table}")
        assert found == [1, 2, 3] and said.count(told) == 1 and comment[2:] in said, (comment, said)
    assert told in read("plain.csv", f"{table}# LPS\nb,4,5,6\n")[1]  # perhaps a group of contacts
    for comment in ("# made by hand: yes", "# contacts of 0.2 cm", "# made by M", "# I'm here",
                    "# RAS of the scan", "# one row for each", "# time in ms", "# 5 mm apart", "#"):
        assert read("plain.csv", f"{comment}\n{table}") == ([1, 2, 3], ""), comment


def test_comments_of_fiducials_count_as_those_of_tables():
    row = "F1,1,2,3\n"
    for comment, right in (("# coordinates: LPS", [-1, -2, 3]), ("# space = LPS", [-1, -2, 3]),
                           ("# RAS, mm", [1, 2, 3]), ("# name = F", [1, 2, 3])):
        found, said = read("words.fcsv", f"# Markups fiducial file\n{comment}\n{row}")
        assert found == right and not said, (comment, said)
    assert "does not count" in read("words.fcsv", f"# made of LPS points\n{row}")[1]
    for comment, words in (("# coordinates in cm", "its units must be mm"),
                           ("# LPS\n# CoordinateSystem = RAS", "contradicts itself")):
        assert words in refusal("words.fcsv", f"{comment}\n{row}"), comment


def test_rows_with_more_values_than_columns_are_no_points():
    """Decimals after a comma make values of their own: 1,5 is read as 1 in its column, 5 beside."""
    slicer = "# CoordinateSystem = RAS\n"
    few = "# columns = id,x,y,z,label\n"
    for text, count in (
            (f"{slicer}F1,1,2,3\nF2,1,5,2,5,3,5\n", "line 3 that has 7 values for 14 columns"),
            (f"{slicer}F1,1,5,2,3\n", "5 values for 14 columns"),
            (f"{slicer}F1,1,5,2,5,3,5,0,0,0,1,1,1,0,a,,\n", "17 values for 14 columns"),
            (f"{slicer}F1,1,5,2,3,0,0,0,1,1,1,0,a,,\n", "15 values for 14 columns"),
            (f"{slicer}F1,1,5,2,5,3,0,0,0,1,1,1,0,a,,\n", "16 values for 14 columns"),
            (f"{slicer}F1,1,5,2,3,0,0,0,1,1,1,0,a,,,2,0\n", "17 values for 14 columns"),
            (f"{few}F1,1,5,2,5,3,5,a\n", "8 values for 5 columns")):
        assert count in refusal("comma.fcsv", text), text
    for text in (f"{slicer}F1,1,2,3\n", f"{few}F1,1,2,3,a\n", f"{slicer}F1,1,2,3,0,0,0,1\n",
                 f"{slicer}F1,1,2,3,0,0,0,1,1,1,0,a,,\n",
                 f"{slicer}F1,1,2,3,0,0,0,1,1,1,0,a,,,2,0\n"):
        assert read("comma.fcsv", text) == ([1, 2, 3], ""), text
    told = "has numbers in columns without a name"
    for text, words in (("x,y,z,,,\n1,5,2,5,3,5\n", told), ("x,y,z,\n1,2,3,\n", ""),
                        ("x,y,z,\n1,2,3,a\n", "takes the names"), (",x,y,z\n7,1,2,3\n", "")):
        said = read("comma.csv", text)[1]
        assert words in said and (words == told) == (told in said) and (words or not said), said


run_tests(globals())
