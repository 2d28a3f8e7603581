# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by CompareInFourViews.xml, shows a comparison in slices and
in 3D at once when Compare Volumes is applied while four views are shown, with the look of the
volume; that a text in each view says which volume has which colour, by the names of the pipeline,
and goes with the comparison; and that each step of it can be undone and done again.

The window imports this file to lay out the views and to write down what they show."""
import json
import os

import brainshift
import test_hand as hand
import window_testing as window
from brainshift_testing import picture
from paraview import simple

SLICES = ("axial", "coronal", "sagittal")
LONG = "20240611_T1_MPRAGE_sagittal_0.8mm_postop.nii"  # a legend has room for 32 letters


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


def legend_of(display):
    """The text that is drawn in the view, by what its representation shows."""
    name = {"Deformed Slices": "SliceLegend", "Deformed Volume": "VolumeLegend"}
    kind = str(display.Representation.GetData())
    return str(getattr(display, name[kind])) if kind in name else ""


def letters_of(view):
    """The visible texts of the view, as they are drawn."""
    props = view.GetClientSideObject().GetNonCompositedRenderer().GetViewProps()
    actors = [props.GetItemAsObject(i) for i in range(props.GetNumberOfItems())]
    return [actor.GetInput() for actor in actors
            if actor.IsA("vtkTextActor") and actor.GetVisibility() and actor.GetInput()]


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
            "legends": [legend_of(display) for display in shown],
            "letters": letters_of(view),
            "red": float((image[:, :, 0] > image[:, :, 2] + 0.2).mean())})
    return found


def look(name):
    hand.wait(200)
    write(name, {"views": what_views_show(), "layouts": len(simple.GetLayouts()),
                 "labels": window.undo_labels(),
                 "comparisons": len([source for source in simple.GetSources().values()
                                     if source.GetXMLName() == "CompareVolumes"])})


def comparison():
    return next(source for source in simple.GetSources().values()
                if source.GetXMLName() == "CompareVolumes")


def rename():
    simple.RenameSource("US.nii", simple.FindSource("before surgery"))
    simple.RenameSource("FreeFormDeformation7", simple.FindSource("bent"))  # says nothing


def show_reference():
    simple.RenameSource("bent", simple.FindSource("FreeFormDeformation7"))
    simple.RenameSource(LONG, simple.FindSource("US.nii"))
    comparison().Show = "Reference"
    simple.RenderAllViews()


def compare_no_more():
    comparison().Show = "Both"
    for view in simple.GetRenderViews():
        display = simple.GetDisplayProperties(comparison(), view)
        display.SliceComparison, display.VolumeComparison = "None", "Off"
    simple.RenderAllViews()


def take_away():
    """Deletes the comparison; the four views show the bent volume again."""
    bent = simple.FindSource("bent")
    brainshift.four_views(bent)
    for source in list(simple.GetSources().values()):
        if source.GetXMLName() == "CompareVolumes":
            simple.Delete(source)
    simple.SetActiveSource(bent)
    simple.RenderAllViews()


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
            assert view["ways"] == ["Two colours"], view
        else:
            assert view["ambient"] == [0.35], "the look of the volume"
    check_legends(seen)
    check_undo(seen)


def check_legends(seen):
    texts = {
        "applied": "red: bent (bent)\ngreen: before surgery (reference)\nyellow: both",
        "renamed": "red: US.nii (bent)\ngreen: US.nii (reference)\nyellow: both",
        "reference": f"{LONG[:16]}\u2026{LONG[-15:]} (reference)"}
    for name, text in texts.items():
        for view in seen[name]["views"]:
            assert view["legends"] == [text], (name, view)
            assert text in view["letters"], (name, view)
    for view in seen["off"]["views"]:
        assert view["legends"] == [""], view
        assert not any("(reference)" in text for text in view["letters"]), view


def check_undo(seen):
    undone = seen["undone"]["views"]
    assert seen["undone"]["labels"][0] == "Apply", seen["undone"]["labels"]
    for view in undone:
        if view["kinds"] == ["Deformed Slices"]:
            assert view["sources"] == ["FreeFormDeformation"], "as it was before"
            assert view["ways"] == ["None"] and view["red"] < 0.1, view
    assert sum(view["kinds"] == ["Deformed Slices"] for view in undone) == 3, undone
    redone = seen["redone"]["views"]
    assert [view["sources"] for view in redone] == 4 * [["CompareVolumes"]], redone
    assert seen["gone"]["comparisons"] == 0, "the filter is undone, too"
    for view in seen["gone"]["views"]:
        assert view["sources"] == ["FreeFormDeformation"], "the volume is seen again"


if __name__ == "__main__":
    main()
