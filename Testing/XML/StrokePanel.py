# SPDX-License-Identifier: BSD-3-Clause
"""Proves that panel and toolbar, played by StrokePanel.xml, edit the property Strokes, each edit in
one undo step, and follow it when a script sets it. The window imports this file to make the scene
and to write down the property after each act; the test then reads what was written."""
import json
import os

import brainshift
from paraview import simple

ANCHORS = ((4.0, 0.0, 0.0), (0.0, 4.0, 0.0), (0.0, 0.0, 4.0))
CENTRE = (0.0, 0.0, 0.0)
STROKES = (brainshift.stamp(ANCHORS[0], CENTRE, -3.0, major=8.0, minor=5.0) +
           brainshift.soft(ANCHORS[1], (0.0, 1.0, 0.0), 6.0) +
           brainshift.move(ANCHORS[2], (0.0, 0.0, 0.5)))
POINT = (1.23456789012345, 2.0, -3.0)  # mm
VECTOR_X, MAJOR, ENABLED = 4, 10, 13  # places among a stroke's numbers


def record_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "StrokePanel.json")


def start():
    """A cube of 20 mm, bent by three strokes, in the window's view."""
    with open(record_file(), "w") as file:
        json.dump([], file)
    deformation = simple.FreeFormDeformation(Input=simple.Wavelet())
    simple.Show(deformation)
    simple.SetActiveSource(deformation)
    simple.Render()


def set_strokes():
    simple.GetActiveSource().Strokes = STROKES


def set_nonsense():
    simple.GetActiveSource().Strokes = (1.0, 2.0, 3.0)


def record(act):
    """Writes down what the property holds after `act`."""
    deformation = simple.GetActiveSource()
    with open(record_file()) as file:
        records = json.load(file)
    records.append((act, list(deformation.Strokes), deformation.Strength))
    with open(record_file(), "w") as file:
        json.dump(records, file)


def set_point():
    simple.GetActiveSource().PointOfInterest = POINT


def record_point(act):
    """Writes down the point of interest after `act`."""
    deformation = simple.GetActiveSource()
    with open(record_file()) as file:
        records = json.load(file)
    records.append((act, list(deformation.PointOfInterest), deformation.Strength))
    with open(record_file(), "w") as file:
        json.dump(records, file)


def changed(numbers, stroke, *places):
    """`numbers` with another value at each (place, value) of one stroke."""
    result = list(numbers)
    first = stroke * brainshift.NUMBERS_PER_STROKE
    for place, value in places:
        result[first + place] = value
    return result


def expected():
    whole = list(STROKES)
    disabled = changed(whole, 1, (ENABLED, 0))
    # Along x, for the stamp at (4, 0, 0) points at the centre.
    pushed = changed(disabled, 0, (VECTOR_X, -4.5))
    widened = changed(pushed, 1, (MAJOR, 7.5))
    return [
        ("script", whole, 1.0),
        ("disable", disabled, 1.0),
        ("change amount", pushed, 1.0),
        ("change radius", widened, 1.0),
        ("refuse", widened, 1.0),
        ("undo delete", widened, 1.0),
        ("undo change", widened, 1.0),
        ("space", changed(widened, 1, (ENABLED, 1)), 1.0),
        ("space again", widened, 1.0),
        ("undo list reset", widened, 1.0),
        ("undo toolbar reset", widened, 1.0),
        ("strength", widened, 0.5),
        ("undo strength", widened, 0.5),
        ("whole strength", widened, 1.0),
        ("before", widened, 0.0),
        ("after", widened, 1.0),
        ("undo after", widened, 1.0),
        ("reset of nonsense", [], 1.0),
        ("point typed", [POINT[0], 4.5, POINT[2]], 1.0),
        ("centre", list(CENTRE), 1.0),
    ]


def main():
    with open(record_file()) as file:
        records = [tuple(record) for record in json.load(file)]
    for (act, strokes, strength), wanted in zip(records, expected()):
        print(act, len(strokes) // brainshift.NUMBERS_PER_STROKE, "strokes, strength", strength)
        assert act == wanted[0], (act, wanted[0])
        assert strength == wanted[2], (act, strength, wanted[2])
        assert len(strokes) == len(wanted[1]), (act, len(strokes), len(wanted[1]))
        for number, value in zip(strokes, wanted[1]):
            assert abs(number - value) < 1e-12, (act, strokes, wanted[1])
    assert len(records) == len(expected()), (len(records), len(expected()))


if __name__ == "__main__":
    main()
