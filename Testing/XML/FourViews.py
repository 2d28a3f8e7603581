# SPDX-License-Identifier: BSD-3-Clause
"""Proves that ParaView's window, played by FourViews.xml, lays out four views with one slice
position, and that wheel and Shift-drag move it: by a voxel, to the cursor. The window imports this
file to bend the volume, to use the mouse, and to write down what it sees."""
import json
import os

import brainshift
import numpy
from brainshift_testing import picture
from paraview import simple

SLICES = ("axial", "coronal", "sagittal")


def seen_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "FourViews.json")


def bend():
    """Pulls the scalp out, and forgets what an earlier run saw."""
    if os.path.exists(seen_file()):
        os.remove(seen_file())
    bent = simple.GetActiveSource()
    bounds = numpy.reshape(bent.GetDataInformation().GetBounds(), (3, 2))
    middle = bounds.mean(axis=1)
    bent.Strokes = brainshift.stamp((middle[0], middle[1], bounds[2, 1] - 8), middle, 15.0)
    simple.Render()


def _views():
    """By what each view shows: the name of its plane, or volume."""
    found = {}
    for view in simple.GetRenderViews():
        display = simple.GetDisplayProperties(simple.GetActiveSource(), view)
        shown = [plane for plane in SLICES if getattr(display, f"Show{plane.capitalize()}")]
        flat = view.InteractionMode == "2D"
        found[shown[0] if flat and len(shown) == 1 else "volume"] = (view, display)
    return found


def _mouse(view, x, y, event, shift=0, control=0):
    interactor = view.GetInteractor()
    interactor.SetEventInformation(int(x), int(y), control, shift)
    interactor.InvokeEvent(event)


def _positions(views):
    return {name: list(display.SlicePosition) for name, (_, display) in views.items()}


def play_mouse():
    """Turns the wheel and drags in the slices; writes down positions, zooms and brightness."""
    views = _views()
    axial, coronal = views["axial"][0], views["coronal"][0]
    width, height = axial.ViewSize
    seen = {"views": sorted(views), "first": _positions(views),
            "steps": brainshift.slice_axes(views["axial"][1])[1]}
    before = picture(axial)
    for _ in range(3):
        _mouse(axial, width / 2, height / 2, "MouseWheelForwardEvent")
    seen["wheel"] = _positions(views)
    seen["another slice"] = bool((picture(axial) != before).any())
    _mouse(coronal, width / 2, height / 2, "MouseWheelBackwardEvent")
    seen["wheel back"] = _positions(views)
    zoom = axial.CameraParallelScale
    _mouse(axial, width / 2, height / 2, "MouseWheelForwardEvent", control=1)
    seen["zoomed"] = axial.GetActiveCamera().GetParallelScale() / zoom
    seen["wheel with control"] = _positions(views)
    axial.CameraParallelScale = zoom
    picture(axial)
    at = (width / 2 + 40, height / 2 + 25)
    _mouse(axial, width / 2, height / 2, "LeftButtonPressEvent", shift=1)
    _mouse(axial, *at, "MouseMoveEvent", shift=1)
    _mouse(axial, *at, "LeftButtonReleaseEvent", shift=1)
    _mouse(axial, width / 2, height / 2, "MouseMoveEvent")
    seen["drag"] = _positions(views)
    focus = axial.GetActiveCamera().GetFocalPoint()
    mm = 2 * zoom / height  # a pixel
    # Radiological: the picture's right is the patient's left.
    seen["drag to"] = [focus[0] - 40 * mm, focus[1] + 25 * mm, seen["wheel back"]["axial"][2]]
    seen["camera kept"] = list(axial.GetActiveCamera().GetFocalPoint()) == list(focus)
    seen["bright"] = {name: float((picture(view) > 0.3).mean())
                      for name, (view, _) in views.items()}
    with open(seen_file(), "w", encoding="utf-8") as file:
        json.dump(seen, file)


def all_equal(positions, expected, tolerance=1e-6):
    return all(numpy.allclose(position, expected, atol=tolerance)
               for position in positions.values())


def main():
    with open(seen_file(), encoding="utf-8") as file:
        seen = json.load(file)
    print(json.dumps(seen, indent=1))
    assert seen["views"] == ["axial", "coronal", "sagittal", "volume"], seen["views"]
    expected = numpy.array(seen["first"]["axial"])
    assert all_equal(seen["first"], expected)
    assert all_equal(seen["wheel"], expected + (0, 0, 3 * seen["steps"][2]))
    assert seen["another slice"], "the picture follows the wheel"
    expected += (0, -seen["steps"][1], 3 * seen["steps"][2])
    assert all_equal(seen["wheel back"], expected)
    assert all_equal(seen["wheel with control"], expected)
    assert seen["zoomed"] != 1.0, "with Ctrl the wheel zooms"
    assert all_equal(seen["drag"], seen["drag to"], 1.0), "one pixel"
    assert not numpy.allclose(seen["drag to"], expected, atol=5)
    assert seen["camera kept"], "Shift-drag must not move the camera"
    for name, share in seen["bright"].items():
        assert share > 0.01, (name, share)


if __name__ == "__main__":
    main()
