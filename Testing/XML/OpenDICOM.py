# SPDX-License-Identifier: BSD-3-Clause
"""Proves that what the window opened, played by OpenDICOM.xml, is the series that was asked for.
The window imports this file to write down what it shows."""
import json
import os

from paraview import simple


def record_file(name):
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], f"OpenDICOM-{name}.json")


def record(name):
    """Writes down the active source of the window."""
    source = simple.GetActiveSource()
    information = source.GetDataInformation()
    told = {"class": source.GetClientSideObject().GetClassName(),
            "series": list(source.GetProperty("Series"))[0],
            "bounds": information.GetBounds(),
            "range": source.PointData["Intensity"].GetRange()}
    with open(record_file(name), "w", encoding="utf-8") as file:
        json.dump(told, file)


def main():
    bounds = (-124.7601, 127.2434, -132.2234, 119.7766, -38.3548, 85.6522)
    for name, series, lowest in (("folder", "MAGNITUDE", 0.0), ("field", "REAL", -495.6),
                                 ("file", "MAGNITUDE", 0.0)):
        with open(record_file(name), encoding="utf-8") as file:
            told = json.load(file)
        os.remove(record_file(name))
        assert told["class"] == "vtkVolumeFileReader", told
        assert told["series"].endswith(series), told
        assert abs(told["range"][0] - lowest) < 0.1, told
        assert max(abs(a - b) for a, b in zip(told["bounds"], bounds)) < 0.02, told


if __name__ == "__main__":
    main()
