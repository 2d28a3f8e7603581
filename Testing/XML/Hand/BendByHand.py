# SPDX-License-Identifier: BSD-3-Clause
"""Proves that Stamp, Soft and Move bend a volume by hand in ParaView's window with mouse, wheel and
keys. Each stroke is one step of undo, and nothing is lost when things disappear under the hand.
Then a script gets the same strokes and the same picture by properties alone.

ParaView's window runs this file as a script, and then pvpython, which judges."""
import json
import math
import os
import traceback

import brainshift
import test_hand as hand
from brainshift_testing import mean_difference, structural_similarity
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader
from window_testing import deformation, edit, redo_labels, strokes, undo_labels

MAJOR = 10  # number of a stroke: its major radius
SIZE = (300, 300)  # of pictures, pixels


def scratch(name):
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "BendByHand-" + name)


# In the window ------------------------------------------------------------------------------------

told = {"failures": []}


def amount(stroke):
    """mm, pull positive: a stamp's vector against its axis."""
    return -sum(a * b for a, b in zip(stroke[4:7], stroke[7:10]))


def middle():
    return [side // 2 for side in simple.GetActiveView().ViewSize]


def on_tissue(x, y):
    """A pixel of the head, from the picture's middle in shares of the view's height."""
    height = simple.GetActiveView().ViewSize[1]
    return [middle()[0] + round(x * height), middle()[1] + round(y * height)]


def away():
    return [10, simple.GetActiveView().ViewSize[1] - 10]


def place_camera(view):
    view.CameraFocalPoint = (-309, 22, 477)
    view.CameraPosition = (-500, 500, 580)
    view.CameraViewUp = (0, 0, 1)
    view.CameraViewAngle = 25


def settle():
    """Waits until a burst of wheel clicks is over: a step more to undo."""
    before = undo_labels()
    for _ in range(200):
        if undo_labels() != before:
            break
        hand.wait(50)
    hand.wait(200)
    assert one_more(before, "Stamp: pull"), undo_labels()


def one_more(before, label):
    """Whether there is one step more to undo than before. The stack holds ten."""
    return undo_labels() == ([label] + before)[:10]


def open_head():
    head = simple.NIFTIVolumeReader(FileName=head_file())
    bent = simple.FreeFormDeformation(registrationName="bent", Input=head)
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    assert display.Representation == "Deformed Volume", display.Representation
    look_plain(view, bent)
    simple.Render(view)
    hand.wait(100)
    told["view"] = list(view.ViewSize)
    told["middle"] = middle()


def without_a_tool():
    # Nothing is in hand: wheel and drag are the camera's.
    view = simple.GetActiveView()
    hand.drag(middle(), on_tissue(0.1, 0.1), steps=2)
    hand.wheel(middle(), 1)
    hand.wait(100)
    assert strokes() == [], strokes()
    assert list(view.CameraPosition) != [-500, 500, 580], view.CameraPosition
    place_camera(view)
    simple.Render(view)


def take(tool):
    """Takes a tool in hand, named as in test_hand."""
    hand.take(getattr(hand, tool))


def has(*tools):
    assert [stroke[0] for stroke in strokes()] == list(tools), strokes()


def first_is(millimetres):
    assert math.isclose(amount(strokes()[0]), millimetres, rel_tol=1e-9), strokes()


def stamp():
    # Clicks at one place are one stroke; a drag is another.
    take("STAMP")
    hand.hover(middle())
    told["tissue"] = brainshift.pick(
        simple.GetDisplayProperties(deformation()), simple.GetActiveView(), *middle())
    hand.wheel(middle(), 3)
    settle()
    first_is(3.0)
    has(brainshift.STAMP)
    beside = [middle()[0] + 2, middle()[1] + 1]  # a resting hand trembles
    hand.hover(beside)
    hand.wheel(beside, 2)
    settle()
    first_is(5.0)
    has(brainshift.STAMP)
    undo = undo_labels()
    hand.drag(on_tissue(-0.1, 0), on_tissue(-0.1, 0.1))
    has(brainshift.STAMP, brainshift.STAMP)
    assert one_more(undo, "Stamp: pull"), undo_labels()
    edit("Undo", brainshift.STAMP)
    first_is(5.0)
    edit("Undo", brainshift.STAMP)
    first_is(3.0)
    edit("Undo")
    edit("Redo", brainshift.STAMP)
    edit("Redo", brainshift.STAMP)
    edit("Redo", brainshift.STAMP, brainshift.STAMP)
    first_is(5.0)
    undo_at_once()
    another_radius_is_another_stroke()


def undo_at_once():
    # Before the burst of clicks has ended by itself. Python would send strokes that it reads then.
    had = [brainshift.STAMP, brainshift.STAMP]
    undo = undo_labels()
    hand.hover(middle())
    hand.wheel(middle(), 2)
    hand.shortcut("z", hand.CONTROL)
    hand.wait()
    has(*had)
    assert undo_labels() == undo[:9] and redo_labels()[:1] == ["Stamp: pull"], undo_labels()
    edit("Redo", *had, brainshift.STAMP)
    assert math.isclose(amount(strokes()[-1]), 2.0, rel_tol=1e-9), strokes()
    edit("Undo", *had)


def another_radius_is_another_stroke():
    had = [brainshift.STAMP, brainshift.STAMP]
    hand.hover(middle())
    hand.wheel(middle(), 1)
    settle()
    has(*had, brainshift.STAMP)
    hand.wheel(middle(), 1, hand.SHIFT)
    hand.wheel(middle(), 1)
    settle()
    has(*had, brainshift.STAMP, brainshift.STAMP)
    narrow, wide = (stroke[MAJOR] for stroke in strokes()[-2:])
    assert math.isclose(wide, 1.1 * narrow, rel_tol=1e-9), (narrow, wide)
    hand.wheel(middle(), -1, hand.SHIFT)
    hand.wait(100)
    edit("Undo", *had, brainshift.STAMP)
    edit("Undo", *had)


def soft():
    take("SOFT")
    undo = undo_labels()
    hand.drag(on_tissue(0.1, 0), on_tissue(0.2, 0.1))
    has(brainshift.STAMP, brainshift.STAMP, brainshift.SOFT)
    assert one_more(undo, "Soft stroke"), undo_labels()
    edit("Undo", brainshift.STAMP, brainshift.STAMP)
    edit("Redo", brainshift.STAMP, brainshift.STAMP, brainshift.SOFT)


def zoom_away_from_tissue():
    view = simple.GetActiveView()
    before, position = strokes(), list(view.CameraPosition)
    hand.hover(away())
    hand.wheel(away(), 2)
    hand.wait(100)
    hand.drag(away(), [away()[0] + 60, away()[1] - 20], steps=2)
    assert strokes() == before, strokes()
    assert list(view.CameraPosition) != position, view.CameraPosition
    place_camera(view)
    simple.Render(view)
    hand.wait(100)


def shows_selections():
    display = simple.GetDisplayProperties(deformation()).SMProxy
    return display.GetProperty("SelectionVisibility").GetElement(0) == 1


def keep_a_selection():
    # What is selected stays visible under the hand.
    before = len(strokes())
    simple.SelectIDs(IDs=[0, 5], FieldType="POINT", Source=deformation())
    hand.hover(middle())
    hand.press(middle())
    hand.drag_to([middle()[0], middle()[1] + 5])
    hand.wait()
    assert len(strokes()) == before + 1 and shows_selections(), strokes()
    hand.tap(hand.ESCAPE)
    hand.release([middle()[0], middle()[1] + 5])
    simple.ClearSelection(deformation())
    hand.wait(100)


def drag_quietly():
    # Panels and menus hear of new data once the hand lets go, and not with each picture before;
    # and what would show a selection of nothing is brought up to date then.
    heard = []
    proxy = deformation().SMProxy
    watch = proxy.AddObserver("UpdateDataEvent", lambda *_: heard.append(True))
    hand.hover(middle())
    hand.press(middle())
    for step in range(1, 4):
        hand.drag_to([middle()[0], middle()[1] + 5 * step])
        hand.wait()
    assert not heard, "heard under the hand"
    assert not shows_selections(), "an empty selection is kept up to date"
    hand.release([middle()[0], middle()[1] + 15])
    hand.wait(300)
    proxy.RemoveObserver(watch)
    assert heard, "not heard at the end"
    assert shows_selections(), "selections stay hidden"
    assert hand.action("actionEditUndo")
    hand.wait()


def escape_a_drag():
    before, undo = strokes(), undo_labels()
    hand.hover(middle())
    hand.press(middle())
    hand.drag_to(on_tissue(0.1, 0.05))
    hand.wait()
    assert len(strokes()) == len(before) + 1, strokes()
    hand.tap(hand.ESCAPE)
    hand.drag_to(on_tissue(0.2, 0.05))
    hand.release(on_tissue(0.2, 0.05))
    hand.wait(100)
    assert strokes() == before, strokes()
    assert undo_labels() == undo, undo_labels()


def widen_with_shift():
    name = {brainshift.SOFT: "radius", brainshift.STAMP: "majorRadius"}[strokes()[-1][0]]
    before, were = hand.setting(name), strokes()
    hand.hover(middle())
    hand.wheel(middle(), 2, hand.SHIFT)
    hand.wait(100)
    after = hand.setting(name)
    assert math.isclose(after, before * 1.21, rel_tol=1e-9), (before, after)
    assert strokes() == were, strokes()


def pixel_of(position):
    renderer = simple.GetActiveView().GetRenderer()
    renderer.SetWorldPoint(*position, 1.0)
    renderer.WorldToDisplay()
    return [round(number) for number in renderer.GetDisplayPoint()[:2]]


def control_point(pixel):
    """The one nearest to the tissue at a pixel, rest frame, and the spacing."""
    bounds = deformation().GetDataInformation().GetBounds()
    dimensions = deformation().LatticeDimensions
    spacing = [(bounds[2 * a + 1] - bounds[2 * a]) / (dimensions[a] - 1) for a in range(3)]
    tissue = brainshift.pick(
        simple.GetDisplayProperties(deformation()), simple.GetActiveView(), *pixel)
    index = [round((tissue[a] - bounds[2 * a]) / spacing[a]) for a in range(3)]
    return [bounds[2 * a] + index[a] * spacing[a] for a in range(3)], spacing


def move_a_control_point():
    # Along the screen first, then held to the x axis by its key.
    before = len(strokes())
    point, spacing = control_point(on_tissue(0.05, -0.1))
    start = pixel_of(point)
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 20, start[1] + 10])
    hand.wait()
    free = strokes()[-1]
    hand.tap("x")
    hand.wait()
    held = strokes()[-1]
    hand.release([start[0] + 20, start[1] + 10])
    hand.wait(100)
    assert len(strokes()) == before + 1, strokes()
    assert free[0] == brainshift.MOVE and strokes()[-1] == held, (free, held)
    assert all(math.isclose(a, b, abs_tol=1e-4) for a, b in zip(held[1:4], point)), (held, point)
    assert all(math.isclose(a, b, rel_tol=1e-6) for a, b in zip(held[7:10], spacing)), held
    assert free[4] and free[5] and free[6] and held[4], (free, held)
    assert held[5] == held[6] == 0.0, held
    assert undo_labels()[0] == "Move control point", undo_labels()
    told["point"], told["moved"] = point, held[4:7]


def move_two_control_points():
    # One more with Shift; both go together, in one step.
    before, undo = len(strokes()), undo_labels()
    point, spacing = control_point(on_tissue(-0.15, -0.05))
    other = [point[0], point[1], point[2] + 2 * spacing[2]]
    for position, modifiers in ((point, 0), (other, hand.SHIFT)):
        hand.hover(pixel_of(position))
        hand.press(pixel_of(position), modifiers)
        hand.release(pixel_of(position), modifiers)
    end = [number + 15 for number in pixel_of(other)]
    hand.drag(pixel_of(other), end)
    assert len(strokes()) == before + 2, strokes()
    first, second = strokes()[-2:]
    assert first[4:7] == second[4:7] and first[1:4] != second[1:4], (first, second)
    assert one_more(undo, "Move control points"), undo_labels()


def show_before():
    undo = undo_labels()
    hand.hover(middle())
    hand.key_down("o")
    hand.wait(100)
    during, before = deformation().Strength, strokes()
    hand.drag(middle(), on_tissue(0.1, 0.1), steps=2)
    assert strokes() == before, strokes()
    hand.key_up("o")
    hand.wait(100)
    assert (during, deformation().Strength) == (0.0, 1.0), (during, deformation().Strength)
    assert undo_labels() == undo, undo_labels()
    place_camera(simple.GetActiveView())  # the drag was the camera's
    simple.Render(simple.GetActiveView())
    hand.wait(100)


def numbers_that_are_no_strokes():
    kept = list(deformation().Strokes)
    for tool in ("STAMP", "SOFT", "MOVE"):
        take(tool)
        deformation().Strokes = kept + [1.0]
        hand.drag(middle(), on_tissue(0.1, 0.1), steps=2)
        assert list(deformation().Strokes) == kept + [1.0], deformation().Strokes
    deformation().Strokes = kept
    place_camera(simple.GetActiveView())
    simple.Render(simple.GetActiveView())
    hand.wait(100)


def save_result():
    take("NONE")  # what it shows is no part of the picture
    told["strokes"] = strokes()
    save_picture(simple.GetActiveView(), "window")


def delete_in_mid_drag():
    hand.hover(middle())
    hand.press(middle())
    hand.drag_to(on_tissue(0.05, 0.05))
    hand.wait()
    simple.Delete(deformation())
    hand.drag_to(on_tissue(0.1, 0.1))
    hand.wait(100)
    hand.release(on_tissue(0.1, 0.1))
    hand.wheel(middle(), 1)
    hand.wait(100)
    assert deformation() is None


def close_view_in_mid_drag():
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=simple.FindSource("NIFTIVolumeReader1"))
    view = simple.GetActiveView()
    simple.Show(bent, view)
    simple.SetActiveSource(bent)
    simple.Render(view)
    hand.wait(200)
    hand.hover(middle())
    hand.press(middle())
    hand.drag_to(on_tissue(0.05, 0.05))
    hand.wait()
    simple.Delete(view)
    hand.wait(200)
    hand.take(hand.NONE)
    hand.wait(100)
    assert strokes() == [], strokes()


def play():
    try:
        open_head()
        without_a_tool()
        for tool in (stamp, soft):
            tool()
            escape_a_drag()
            widen_with_shift()
            zoom_away_from_tissue()
        take("MOVE")
        move_a_control_point()
        move_two_control_points()
        edit("Undo", 2, 2, 1, 0)
        edit("Redo", 2, 2, 1, 0, 0, 0)
        drag_quietly()
        keep_a_selection()
        show_before()
        numbers_that_are_no_strokes()
        save_result()
        take("SOFT")
        delete_in_mid_drag()
        close_view_in_mid_drag()
        told["done"] = True
    except BaseException:
        told["failures"].append(traceback.format_exc())
    with open(scratch("told.json"), "w", encoding="utf-8") as file:
        json.dump(told, file)
    hand.quit()


# In the window and in the script ------------------------------------------------------------------


def head_file():
    return os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")


def look_plain(view, bent):
    view.UseColorPaletteForBackground = 0
    view.Background = (0, 0, 0)
    view.OrientationAxesVisibility = 0
    display = simple.GetDisplayProperties(bent, view)
    simple.ColorBy(display, ("POINTS", "Intensity"))
    brainshift.look(display)
    display.SetScalarBarVisibility(view, False)
    place_camera(view)


def save_picture(view, name):
    look_plain(view, deformation())
    simple.SaveScreenshot(scratch(name + ".png"), view, ImageResolution=SIZE)


# The script ---------------------------------------------------------------------------------------


def read_picture(name):
    """Indexed [row from below, column, colour], 0 to 1."""
    reader = vtkPNGReader()
    reader.SetFileName(scratch(name + ".png"))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, -1)[:, :, :3] / 255.0


def close(left, right):
    return all(math.isclose(a, b, rel_tol=1e-6, abs_tol=1e-3) for a, b in zip(left, right))


def main():
    with open(scratch("told.json"), encoding="utf-8") as file:
        window = json.load(file)
    assert not window["failures"], "\n".join(window["failures"])
    assert window["done"]

    simple.LoadPlugin(os.environ["BRAINSHIFT_PLUGIN"], remote=False, ns=vars(simple))
    bent = simple.FreeFormDeformation(
        registrationName="bent", Input=simple.NIFTIVolumeReader(FileName=head_file()))
    view = simple.CreateView("RenderView")
    view.ViewSize = window["view"]
    display = simple.Show(bent, view)
    simple.Render(view)  # a view's first picture finds a camera of its own
    look_plain(view, bent)
    simple.Render(view)

    # The same pixel shows the same tissue, and the same words make the same strokes.
    tissue = brainshift.pick(display, view, *window["middle"])
    assert close(tissue, window["tissue"]), (tissue, window["tissue"])
    bounds = bent.GetDataInformation().GetBounds()
    interest = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    stamped = brainshift.stamp(tissue, interest, 5.0)
    assert close(stamped, window["strokes"][0]), (stamped, window["strokes"][0])
    moved = brainshift.move(window["point"], window["moved"], window["strokes"][-3][7:10])
    assert close(moved, window["strokes"][-3]), (moved, window["strokes"][-3])

    save_picture(view, "unbent")
    bent.Strokes = sum(window["strokes"], [])
    save_picture(view, "script")
    drawn, script, unbent = (read_picture(name) for name in ("window", "script", "unbent"))
    same = structural_similarity(drawn, script)
    bend = mean_difference(unbent, script)
    print("window and script", same, "unbent and script", bend)
    assert same > 0.999, same
    assert bend > 0.005, bend


if __name__ == "__main__":
    if hand.is_there():
        play()
    else:
        main()
