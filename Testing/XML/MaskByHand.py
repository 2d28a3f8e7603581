# SPDX-License-Identifier: BSD-3-Clause
"""Proves that in ParaView's window, played by MaskByHand.xml, a mask chosen in the panel keeps what
is beyond its feather still under a stamp that is pressed in the view, and leaves the filter
selected; that one tick then draws the brain alone, where the next stamp finds the cortex; and that
the Python trace holds the tick. The window imports this file to look from a fixed place and to
write down what it sees."""
import json
import os

import brainshift
import numpy
from brainshift_testing import object_pixels, picture, voxels
from paraview import servermanager, simple, smtrace
from slices_testing import trilinear

ANCHOR = slice(1, 4)  # of a stroke's numbers


def seen_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "MaskByHand.json")


def start():
    """Looks at the head, and forgets what an earlier run saw."""
    write({})
    view = simple.GetActiveView()
    view.UseColorPaletteForBackground = 0
    view.Background = (0, 0, 0)
    view.OrientationAxesVisibility = 0
    view.CenterAxesVisibility = 0
    simple.GetDisplayProperties().SetScalarBarVisibility(view, False)
    view.CameraFocalPoint = (-309, 22, 477)
    view.CameraPosition = (-500, 500, 580)
    view.CameraViewUp = (0, 0, 1)
    simple.Render(view)


def write(seen):
    with open(seen_file(), "w", encoding="utf-8") as file:
        json.dump(seen, file)


def read():
    with open(seen_file(), encoding="utf-8") as file:
        return json.load(file)


def inside(mask, positions):
    """How much of the mask lies at positions (mm)."""
    image = mask.GetClientSideObject().GetOutputDataObject(0)
    name = image.GetPointData().GetArrayName(0)
    grid = (numpy.asarray(positions) - image.GetOrigin()) / image.GetSpacing()
    return trilinear(voxels(mask, name) > 0, grid)[0]


def grown(brain, bent):
    """The brain and what is around it that the mask grows by, at most: the feather and 12 mm;
    somewhat more at its corners. A list of bent's own voxels, as those of the brain."""
    spacing = bent.GetClientSideObject().GetOutputDataObject(0).GetSpacing()
    for axis, mm in enumerate(reversed(spacing)):
        before = numpy.moveaxis(brain, axis, 0)
        wider = before.copy()
        for voxel in range(1, int((bent.Feather + 12.0) / mm) + 3):
            wider[voxel:] |= before[:-voxel]
            wider[:-voxel] |= before[voxel:]
        brain = numpy.moveaxis(wider, 0, axis)
    return brain


def tissue_of_last(bent):
    """Where the tissue was at rest that the last stroke takes: strokes before it may have moved
    it."""
    strokes = list(bent.Strokes)
    before = simple.FreeFormDeformation(Input=bent.Input, Mask=bent.Mask, Strokes=strokes[:-14])
    before.UpdatePipeline()
    rest = brainshift.rest_from_deformed(before, [strokes[-14:][ANCHOR]])[0]
    simple.Delete(before)
    simple.SetActiveSource(bent)
    return rest


def selected():
    """Names of what is selected in the pipeline browser."""
    manager = servermanager.ProxyManager().SMProxyManager
    model = manager.GetSelectionModel("ActiveSources")
    proxies = [model.GetSelectedProxy(i) for i in range(model.GetNumberOfSelectedProxies())]
    return [proxy.GetXMLName() for proxy in proxies]


def look(step):
    """Writes down the strokes, what of the picture shows something, and what moved where."""
    bent, view = simple.GetActiveSource(), simple.GetActiveView()
    seen = {"strokes": list(bent.Strokes), "shown": float(object_pixels(picture(view)).mean()),
            "selected": selected(), "masked": bent.Mask is not None,
            "labels": list(simple.GetDisplayProperties(bent, view).DrawnLabels)}
    if bent.Mask is not None and len(bent.Strokes):
        baked = simple.BakeDeformation(Input=bent)
        moved = voxels(baked) != voxels(bent)
        brain = voxels(bent.Mask, "Intensity") > 0
        seen["moved beyond"] = int(moved[~grown(brain, bent)].sum())
        seen["moved inside"] = int(moved[brain].sum())
        simple.Delete(baked)
        simple.SetActiveSource(bent)
        seen["anchor inside"] = float(inside(bent.Mask, tissue_of_last(bent)))
    write({**read(), step: seen})


def trace(on):
    if on:
        smtrace.start_trace()
    else:
        write({**read(), "trace": smtrace.stop_trace()})


def main():
    seen = read()
    for step in ("whole", "stamped", "alone", "stamped again"):
        print(step, {name: value for name, value in seen[step].items() if name != "strokes"})
    whole, stamped, alone, again = (seen[step] for step in
                                    ("whole", "stamped", "alone", "stamped again"))
    assert whole["selected"] == ["FreeFormDeformation"], whole["selected"]
    assert whole["masked"] and not whole["strokes"]
    assert len(stamped["strokes"]) == 14, stamped["strokes"]
    assert stamped["moved beyond"] == 0, stamped
    assert stamped["moved inside"] > 1000, stamped
    assert stamped["anchor inside"] < 0.1, "the first stamp lies on the scalp"
    assert abs(stamped["shown"] - whole["shown"]) < 0.01
    assert 0.1 * whole["shown"] < alone["shown"] < 0.8 * whole["shown"], (whole, alone)
    assert alone["strokes"] == stamped["strokes"]
    assert len(again["strokes"]) == 28, again["strokes"]
    assert again["anchor inside"] > 0.25, "the next one lies on the cortex, to a quarter voxel"
    assert again["moved beyond"] == 0, again
    assert seen["others"]["labels"] == [7, 9], seen["others"]["labels"]
    assert seen["others"]["shown"] < 0.3 * alone["shown"], "the mask's outline alone"
    assert "DrawSegment = 1" in seen["trace"], seen["trace"]


if __name__ == "__main__":
    main()
