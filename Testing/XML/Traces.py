# SPDX-License-Identifier: BSD-3-Clause
"""What Traces.xml asks ParaView's window, and afterwards whether the trace was measured, shown and
followed a stamp. The trace lies 2 mm outside a ball, in front of it and behind."""
import csv
import json
import os
import shutil

import numpy
from brainshift_testing import ball, object_pixels, picture, show_volume, volume
from paraview import simple

MIDDLE, RADIUS, OUTSIDE = numpy.array((16.0, 16.0, 16.0)), 9.0, 2.0
POINTS = 200
FIGURES = ("Count", "Mean", "RMS", "Percentile95")
GREY = [0, 0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5]
OPAQUE = [0, 0, 0.5, 0, 0.4, 0, 0.5, 0, 0.6, 1, 0.5, 0, 1, 1, 0.5, 0]


def scratch(name):
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], name)


def write_trace():
    """Points with times, the time in the first column, as a pointer may tell them. Not named .csv,
    for which ParaView may ask whether it is geography."""
    aside = numpy.random.default_rng(3).normal(size=(POINTS, 3))
    aside /= numpy.linalg.norm(aside, axis=1)[:, None]
    with open(scratch("Traces.txt"), "w", encoding="utf-8") as file:
        file.write("time,x,y,z\n")
        for time, point in enumerate(MIDDLE + (RADIUS + OUTSIDE) * aside):
            file.write(",".join(repr(float(number)) for number in (0.1 * time, *point)) + "\n")


def start():
    """The file, and a bent ball in the view, looked at along -z."""
    write_trace()
    with open(scratch("Traces.json"), "w", encoding="utf-8") as file:
        json.dump({}, file)
    source = volume(ball(inside=1.0, edge=2.0, radius=RADIUS))
    bent = simple.FreeFormDeformation(registrationName="bent", Input=source)
    view = simple.GetActiveViewOrCreate("RenderView")
    show_volume(bent, view, "Deformed Volume", GREY, OPAQUE)
    simple.SetActiveSource(bent)
    simple.Render(view)
    view.CameraFocalPoint = MIDDLE
    view.CameraPosition = MIDDLE + (0, 0, 80)
    view.CameraViewUp = (0, 1, 0)
    simple.Render(view)


def render_view():
    return next(view for view in simple.GetRenderViews())


def click_3d_view():
    """ParaView opens a spreadsheet for the file, and shows what comes next in the active view."""
    simple.SetActiveView(render_view())


def stamp():
    import test_hand as hand
    click_3d_view()
    hand.take(hand.STAMP)
    width, height = render_view().ViewSize
    hand.wheel([width // 2, height // 2], -3)
    hand.wait(300)
    hand.take(hand.NONE)


def make_folder():
    """The dialog takes a folder that is there."""
    shutil.rmtree(scratch("TracesFigures"), ignore_errors=True)
    os.makedirs(scratch("TracesFigures"))


def look(when):
    """Writes down what panel, filter and view show."""
    import test_hand as hand
    hand.wait(300)
    measure, view = simple.GetActiveSource(), render_view()
    measure.SMProxy.UpdatePropertyInformation()
    colors = simple.GetColorTransferFunction("DistanceToCortex")
    shown = picture(view)
    with open(scratch("Traces.json"), encoding="utf-8") as file:
        seen = json.load(file)
    seen[when] = {
        "panel": {name: hand.label(name) for name in FIGURES},
        "filter": {name: getattr(measure, name) for name in FIGURES},
        "histogram": [hand.label("BrainShiftHistogram"), *measure.Histogram],
        "colors": list(colors.RGBPoints),
        "strength": simple.FindSource("bent").Strength,
        "strokes": len(simple.FindSource("bent").Strokes) // 14,
        "range": [colors.RGBPoints[0], colors.RGBPoints[-4]],
        "title": simple.GetScalarBar(colors, view).Title,
        "bar": simple.GetScalarBar(colors, view).Visibility,
        "colored": int((numpy.ptp(shown, axis=2) > 0.3).sum()),
        "drawn": int(object_pixels(shown).sum())}
    with open(scratch("Traces.json"), "w", encoding="utf-8") as file:
        json.dump(seen, file)


def main():
    with open(scratch("Traces.json"), encoding="utf-8") as file:
        seen = json.load(file)
    print(json.dumps(seen, indent=1))
    opened, stamped = seen["opened"], seen["stamped"]
    for now in (opened, stamped):
        assert now["panel"]["Count"] == f"<b>{POINTS}</b>", now["panel"]
        for name in FIGURES[1:]:
            assert now["panel"][name] == f"<b>{now['filter'][name]:.2f} mm</b>", (name, now)
    assert abs(opened["filter"]["Mean"] - OUTSIDE) < 0.1, opened
    assert abs(opened["filter"]["RMS"] - OUTSIDE) < 0.1, opened
    assert (opened["strokes"], stamped["strokes"]) == (0, 1)
    assert stamped["filter"]["Mean"] > opened["filter"]["Mean"] + 0.05, "the cortex was pushed in"
    assert opened["range"] == [-3.0, 3.0], opened["range"]
    assert opened["title"] == "Distance to the cortex (mm)" and opened["bar"] == 1, opened
    assert opened["colored"] > 100, "points and scale are coloured, the ball is grey"
    check_histogram(seen)
    check_colors(opened["colors"])
    check_saved_figures(seen)


def check_histogram(seen):
    """The panel draws the filter's histogram, and follows the stamp."""
    told = {when: seen[when]["histogram"] for when in ("opened", "stamped")}
    for said, width, *counts in told.values():
        tallest = counts.index(max(counts))
        edges = [width * (bin - 16) for bin in (tallest, tallest + 1)]
        words = f"Bins of {width:g} mm. The tallest bin: {edges[0]:g} mm to {edges[1]:g} mm: "
        assert said.startswith(words + f"{max(counts):g} point"), (said, words)
        assert sum(counts) == POINTS
    assert told["opened"] != told["stamped"]


def seen_by(kind, colors):
    """Colours as an eye without red or without green cones takes them (Vienot et al., 1999)."""
    matrix = numpy.array({"protanope": ((0.11238, 0.88762, 0), (0.11238, 0.88762, 0),
                                        (0.00401, -0.00401, 1)),
                          "deuteranope": ((0.29275, 0.70725, 0), (0.29275, 0.70725, 0),
                                          (-0.02234, 0.02234, 1)),
                          "anyone": numpy.eye(3)}[kind])
    return numpy.clip(colors, 0, 1) ** 2.2 @ matrix.T


def check_colors(points):
    """Inside, cortex and outside differ for every eye, and neither side looks like tissue."""
    inside, pale_inside, cortex, pale_outside, outside = numpy.reshape(points, (-1, 4))[:, 1:]
    tissue = numpy.array(((0.85, 0.65, 0.52), (0.9, 0.75, 0.7), (0.6, 0.6, 0.6), (0.95, 0.9, 0.8),
                          (0.23, 0.3, 0.75), (0.7, 0.02, 0.15)))  # skin, cortex, grey, bone, a map
    for kind in ("anyone", "protanope", "deuteranope"):
        for left, right in ((inside, outside), (pale_inside, pale_outside), (inside, cortex),
                            (outside, cortex)):
            apart = numpy.linalg.norm(seen_by(kind, left) - seen_by(kind, right))
            assert apart > 0.25, (kind, left, right, apart)
    for side in (inside, pale_inside, pale_outside, outside):
        assert numpy.abs(tissue - side).max(axis=1).min() > 0.25, side
        assert numpy.ptp(side) > 0.4, "saturated"


def check_saved_figures(seen):
    with open(scratch("TracesFigures/numbers.csv"), encoding="utf-8", newline="") as file:
        saved = {row["name"]: row["value"] for row in csv.DictReader(file)}
    assert float(saved["Trace RMS before"]) == seen["opened"]["filter"]["RMS"], saved
    assert float(saved["Trace RMS after"]) == seen["stamped"]["filter"]["RMS"], saved
    assert seen["saved"]["filter"] == seen["stamped"]["filter"] and seen["saved"]["strength"] == 1
    files = sorted(os.listdir(scratch("TracesFigures")))
    assert files == ["after.png", "before.png", "difference.png", "histogram.svg", "numbers.csv"]


if __name__ == "__main__":
    main()
