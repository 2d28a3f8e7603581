# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by Comparison.xml, compares two volumes in slices by its
panel, and that the key K shows the reference in all views at once and then both again, without a
step to undo. The window imports this file to make the volumes, to type, and to write down what it
sees; it lets no event be played while it does, for the player would go on with the next."""
import json
import os

import brainshift
import numpy
import test_hand as hand
from brainshift_testing import picture
from paraview import simple

MOVED = (-4.0, 0.0, 0.0)
PLACE = (0.5, 0.5, 0.5)


def seen_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "Comparison.json")


def open_volumes():
    """A bent volume, compared with itself as it was, in two views."""
    if os.path.exists(seen_file()):
        os.remove(seen_file())
    wavelet = simple.Wavelet()
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=wavelet,
        Strokes=brainshift.soft((0, 0, 0), (2, 0, 0), 8))
    compare = simple.CompareVolumes(registrationName="compared", Input=bent, Reference=wavelet,
                                    ReferenceTranslation=MOVED)
    first = simple.GetActiveViewOrCreate("RenderView")
    simple.Show(compare, first)
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
        simple.ColorBy(display, ("POINTS", "RTData"))
        display.SlicePosition = PLACE
        view.ResetActiveCameraToNegativeZ()
        view.UseFXAA = 0


def look(name):
    """Writes down what the filter and the views show now."""
    compare = simple.FindSource("compared")
    shown = {"show": str(compare.Show.GetData()), "flickers": hand.is_checked("actionBrainShiftFlicker"),
             "ways": [], "pictures": []}
    for view in simple.GetRenderViews():
        display = simple.GetDisplayProperties(compare, view)
        shown["ways"].append(str(display.SliceComparison.GetData()))
        shown["pictures"].append((255 * picture(view)[::4, ::4]).astype(int).tolist())
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
                    "flickering": ("Reference", True), "after": ("Both", False),
                    "undone": ("Both", False)}, told
    pictures = {name: [numpy.array(p) for p in shown["pictures"]] for name, shown in seen.items()}
    assert sorted(seen["compared"]["ways"]) == ["None", "Red and green"], seen["compared"]["ways"]
    compared = seen["compared"]["ways"].index("Red and green")
    both = pictures["compared"][compared]
    assert both[:, :, 0].max() > 200 and both[:, :, 1].max() > 200
    assert (numpy.abs(both[:, :, 0] - both[:, :, 1]) > 25).mean() > 0.1, "they differ"
    assert (pictures["plain"][compared] != both).any()
    for view in (0, 1):
        flickered = pictures["flickering"][view] != pictures["compared"][view]
        assert flickered.any(axis=2).mean() > 0.1, "the reference in all views"
        assert (pictures["after"][view] == pictures["compared"][view]).all(), "as it was"
    reference = pictures["flickering"]
    sizes = {p.shape for p in reference}
    assert len(sizes) == 1, sizes
    assert (reference[0] == reference[1]).mean() > 0.95, "one reference in both views"


if __name__ == "__main__":
    main()
