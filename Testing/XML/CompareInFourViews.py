# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by CompareInFourViews.xml, shows a comparison in slices and
in 3D at once when Compare Volumes is applied while four views are shown, with the look of the
volume.

The window imports this file to lay out the views and to write down what they show."""
import json
import os

import brainshift
import test_hand as hand
from brainshift_testing import picture
from paraview import simple

SLICES = ("axial", "coronal", "sagittal")


def seen_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "CompareInFourViews.json")


def lay_out():
    if os.path.exists(seen_file()):
        os.remove(seen_file())
    wavelet = simple.Wavelet(registrationName="before surgery")
    bent = simple.FreeFormDeformation(registrationName="bent", Input=wavelet,
                                      Strokes=brainshift.soft((0, 0, 0), (3, 0, 0), 8))
    simple.GetActiveViewOrCreate("RenderView")
    simple.SetActiveSource(bent)
    views = brainshift.four_views(bent)
    display = simple.GetDisplayProperties(bent, views["volume"])
    display.Ambient = 0.35
    display.DrawSegment = 0
    simple.SetActiveSource(bent)
    simple.RenderAllViews()


def write(name, found):
    seen = {}
    if os.path.exists(seen_file()):
        with open(seen_file(), encoding="utf-8") as file:
            seen = json.load(file)
    with open(seen_file(), "w", encoding="utf-8") as file:
        json.dump({**seen, name: found}, file)


def what_views_show():
    found = []
    for view in simple.GetRenderViews():
        shown = [display for display in view.Representations
                 if getattr(display, "Visibility", 0) and hasattr(display, "Input")]
        image = picture(view)
        found.append({
            "kinds": [str(display.Representation.GetData()) for display in shown],
            "sources": [display.Input.GetXMLName() for display in shown],
            "ways": [str(display.SliceComparison.GetData()) for display in shown],
            "ambient": [float(display.Ambient) for display in shown],
            "red": float((image[:, :, 0] > image[:, :, 2] + 0.2).mean())})
    return found


def look(name):
    hand.wait(200)
    write(name, {"views": what_views_show(), "layouts": len(simple.GetLayouts())})


def main():
    with open(seen_file(), encoding="utf-8") as file:
        seen = json.load(file)
    print(json.dumps(seen, indent=1))
    applied = seen["applied"]
    assert applied["layouts"] == 1 and len(applied["views"]) == 4, "no second layout"
    for view in applied["views"]:
        assert view["sources"] == ["CompareVolumes"], "the comparison alone, in each view"
        assert view["red"] > 0.02, view
    kinds = sorted(view["kinds"][0] for view in applied["views"])
    assert kinds == ["Deformed Slices"] * 3 + ["Deformed Volume"], kinds
    for view in applied["views"]:
        if view["kinds"] == ["Deformed Slices"]:
            assert view["ways"] == ["Red and green"], view
        else:
            assert view["ambient"] == [0.35], "the look of the volume"


if __name__ == "__main__":
    main()
