# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by Comparison.xml, compares two volumes in slices by its
panel, and that the key K shows the reference in all views at once and then both again, without a
step to undo and without a trace in a state file.

The window imports this file to make the volumes, to type, and to write down what it sees. The file
lets no event be played while it works, because the player would go on with the next event.
"""
import json
import os
import xml.etree.ElementTree

import brainshift
import numpy
import test_hand as hand
from brainshift_testing import on_screen
from paraview import simple

MOVED = (-4.0, 0.0, 0.0)
PLACE = (0.5, 0.5, 0.5)


def seen_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "Comparison.json")


def state_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "Comparison.pvsm")


def open_volumes():
    """A bent volume, compared with itself as it was, in two views."""
    for file in (seen_file(), state_file()):
        if os.path.exists(file):
            os.remove(file)
    wavelet = simple.Wavelet()
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=wavelet,
        Strokes=brainshift.soft((0, 0, 0), (2, 0, 0), 8))
    compare = simple.CompareVolumes(registrationName="compared", Input=bent, Reference=wavelet,
                                    ReferenceTranslation=MOVED)
    first = simple.GetActiveViewOrCreate("RenderView")
    shown = simple.Show(compare, first)
    shown.SetRepresentationType("Outline")  # the panel chooses another one
    simple.ColorBy(shown, None)
    second = simple.CreateView("RenderView")
    simple.GetLayout(first).AssignView(simple.GetLayout(first).SplitHorizontal(0, 0.5) + 1, second)
    display = simple.Show(compare, second, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.SetActiveSource(compare)
    simple.SetActiveView(first)
    simple.RenderAllViews()


def place_slices():
    """What the panel leaves as it was; the picture is looked at from one side."""
    for view in simple.GetRenderViews():
        display = simple.GetDisplayProperties(simple.FindSource("compared"), view)
        display.SlicePosition = PLACE
        view.ResetActiveCameraToNegativeZ()
        view.UseFXAA = 0
        simple.Render(view)


def look(name):
    """Writes down what the filter says and what the views show now, drawing nothing."""
    compare = simple.FindSource("compared")
    shown = {"show": str(compare.Show.GetData()),
             "flickers": hand.is_checked("actionBrainShiftFlicker"),
             "ways": [], "colors": [], "pictures": []}
    for view in simple.GetRenderViews():
        display = simple.GetDisplayProperties(compare, view)
        shown["ways"].append(str(display.SliceComparison.GetData()))
        shown["colors"].append(str(display.ComparisonColors.GetData()))
        shown["pictures"].append(on_screen(view)[::4, ::4].tolist())
    seen = {}
    if os.path.exists(seen_file()):
        with open(seen_file(), encoding="utf-8") as file:
            seen = json.load(file)
    with open(seen_file(), "w", encoding="utf-8") as file:
        json.dump({**seen, name: shown}, file)


def main():
    with open(seen_file(), encoding="utf-8") as file:
        seen = json.load(file)
    told = {name: (shown["show"], shown["flickers"]) for name, shown in seen.items()}
    assert told == {"plain": ("Both", False), "compared": ("Both", False),
                    "blue and orange": ("Both", False), "red and green": ("Both", False),
                    "flickering": ("Reference", True), "after": ("Both", False),
                    "undone": ("Both", False)}, told
    pictures = {name: [numpy.array(p) for p in shown["pictures"]] for name, shown in seen.items()}
    assert sorted(seen["compared"]["ways"]) == ["None", "Two colours"], seen["compared"]["ways"]
    compared = seen["compared"]["ways"].index("Two colours")
    both = pictures["compared"][compared]
    assert both[:, :, 0].max() > 200 and both[:, :, 1].max() > 200
    assert (numpy.abs(both[:, :, 0] - both[:, :, 1]) > 25).mean() > 0.1, "they differ"
    assert (pictures["plain"][compared] != both).any()
    other = pictures["blue and orange"][compared]
    colors = {name: shown["colors"][compared] for name, shown in seen.items()}
    assert colors["blue and orange"] == "Blue and orange", colors
    assert colors["red and green"] == "Red and green", colors
    blue = [(image[:, :, 2] > image[:, :, 0].astype(float) + 25).mean() for image in (both, other)]
    assert blue[1] > blue[0] + 0.05, blue
    assert (pictures["red and green"][compared] == both).all()
    for view in (0, 1):
        flickered = pictures["flickering"][view] != pictures["compared"][view]
        assert flickered.any(axis=2).mean() > 0.1, "the reference in all views"
        assert (pictures["after"][view] == pictures["compared"][view]).all(), "as it was"
    reference = pictures["flickering"]
    sizes = {p.shape for p in reference}
    assert len(sizes) == 1, sizes
    assert (reference[0] == reference[1]).mean() > 0.95, "one reference in both views"
    state = xml.etree.ElementTree.parse(state_file()).getroot()
    saved = [element.get("value") for element in state.findall(
        ".//Proxy[@type='CompareVolumes']/Property[@name='Show']/Element")]
    assert saved == ["0"], f"both, as chosen, not {saved}"


if __name__ == "__main__":
    main()
