# SPDX-License-Identifier: BSD-3-Clause
# Proves that a table of landmarks whose columns name two positions, or that contradicts the
# coordsystem.json beside it, is refused or told by sentences that are true.
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


run_tests(globals())
