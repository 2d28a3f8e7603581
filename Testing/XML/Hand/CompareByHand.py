# SPDX-License-Identifier: BSD-3-Clause
"""Proves that in ParaView's window the key K shows the deformed volume and the reference in turn
until it is pressed again, of what the active view shows, and lets go of what is deleted or chosen
meanwhile; that the mouse drags the line of a wipe in a 2D view, and nothing else then; and that
Four Views goes on with the comparison of a view, and shows its volume once it is deleted.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import test_hand as hand
import window_testing as window
from brainshift_testing import picture
from paraview import simple

SIZE = 300
HALF = 12.0  # mm, half a view's height
WIPE_X = 2.0
FLICKER = "actionBrainShiftFlicker"
MOST_WAITS = 200  # of 50 ms; what takes longer never comes


def compared(name, move):
    """A bent cube of 20 mm and itself, moved."""
    wavelet = simple.Wavelet()
    bent = simple.FreeFormDeformation(
        Input=wavelet, Strokes=brainshift.soft((0, 0, 0), (2, 0, 0), 8))
    return simple.CompareVolumes(registrationName=name, Input=bent, Reference=wavelet,
                                 ReferenceTranslation=[move, 0, 0])


def show(compare, view):
    """An axial slice, radiological: the patient's right, greater x, at the left."""
    display = simple.Show(compare, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, ("POINTS", "RTData"))
    display.ShowSagittal = display.ShowCoronal = 0
    display.SlicePosition = [0.5, 0.5, 0.5]
    simple.Render(view)
    view.InteractionMode = "2D"
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [0, 0, 0.5]
    view.CameraPosition = [0, 0, -99.5]
    view.CameraViewUp = [0, 1, 0]
    view.CameraParallelScale = HALF
    simple.Render(view)
    return display


def shown(compare):
    return str(compare.Show.GetData())


def wait_for(happened, what):
    for _ in range(MOST_WAITS):
        if happened():
            return
        hand.wait(50)
    raise AssertionError(f"{what} never came")


def flicker_in_turn(first, second, view):
    pictures = {"Both": picture(view)}
    hand.shortcut("K")
    assert hand.is_checked(FLICKER)
    for expected in ("Reference", "Deformed", "Reference", "Deformed"):
        wait_for(lambda: shown(first) == expected, expected)
        seen = picture(view)
        assert (pictures.setdefault(expected, seen) == seen).all(), expected
        assert shown(second) == "Both", "the active view does not show it"
    assert (pictures["Reference"] != pictures["Deformed"]).mean() > 0.1
    hand.shortcut("K")
    assert not hand.is_checked(FLICKER)
    assert shown(first) == "Both" and (picture(view) == pictures["Both"]).all()


def keep_what_was_chosen(compare):
    """Who chooses while it flickers is not overruled in the end; what was shown before is kept."""
    compare.Show = "Deformed"
    hand.shortcut("K")
    wait_for(lambda: shown(compare) == "Reference", "the reference")
    hand.shortcut("K")
    assert shown(compare) == "Deformed", shown(compare)
    hand.shortcut("K")
    wait_for(lambda: shown(compare) == "Reference", "the reference")
    compare.Show = "Both"
    hand.shortcut("K")
    assert shown(compare) == "Both", shown(compare)


def pixel_at(view, x):
    """In the middle row: x counts to the left."""
    width, height = view.ViewSize
    return [width / 2 - x / (2 * HALF) * height, height / 2]


def drag_the_wipe(view, display):
    display.SliceComparison = "Wipe"
    display.WipePosition = [WIPE_X, 1.0, -1.0]
    before = picture(view)
    position, focus = list(display.SlicePosition), list(view.CameraFocalPoint)
    hand.drag(pixel_at(view, WIPE_X), pixel_at(view, -5.0))
    x, y, z = display.WipePosition
    pixel_mm = 2 * HALF / view.ViewSize[1]
    assert abs(x + 5.0) < 1.5 * pixel_mm and (y, z) == (1.0, -1.0), (x, y, z)
    assert (picture(view) != before).mean() > 0.05, "the picture follows"
    assert list(display.SlicePosition) == position
    assert list(view.GetActiveCamera().GetFocalPoint()) == focus, "the camera has not the mouse"
    # Away from the line the mouse is the camera's, as ever; and with another comparison too.
    hand.drag(pixel_at(view, 5.0), pixel_at(view, 4.0))
    assert list(display.WipePosition) == [x, y, z]
    assert list(view.GetActiveCamera().GetFocalPoint()) != focus
    view.CameraFocalPoint, view.CameraPosition = focus, [0, 0, -99.5]
    simple.Render(view)
    display.SliceComparison = "Difference"
    hand.drag(pixel_at(view, x), pixel_at(view, 0.0))
    assert list(display.WipePosition) == [x, y, z]


def delete_while_it_flickers(first, second):
    hand.shortcut("K")
    assert hand.is_checked(FLICKER)
    simple.Delete(first)
    hand.wait(100)
    assert not hand.is_checked(FLICKER), "nothing is left to flicker"
    assert hand.action(FLICKER), "there is another one"
    assert hand.is_checked(FLICKER) and shown(second) == "Reference"
    assert hand.action(FLICKER) and shown(second) == "Both"


def four_views_show_it(compare, view):
    """Four Views takes over the comparison that the view shows, and names its colours."""
    display = simple.GetDisplayProperties(compare, view)
    display.SetRepresentationType("Deformed Volume")
    simple.SetActiveSource(compare)
    hand.wait(200)
    assert hand.action("actionBrainShiftFourViews")
    hand.wait(500)
    for shown in simple.GetRenderViews():
        display = simple.GetDisplayProperties(compare, shown)
        slices = display.Representation == "Deformed Slices"
        assert display.SliceComparison == "Two colours" or not slices, display.SliceComparison
        text = str(display.SliceLegend if slices else display.VolumeLegend)
        assert text.startswith("red: "), (slices, text)
        image = picture(shown)
        assert (image[:, :, 0] > image[:, :, 2] + 0.2).mean() > 0.02, slices
    assert len(simple.GetRenderViews()) == 4
    simple.GetDisplayProperties(compare, simple.GetActiveView()).SlicePosition = [1.5, 0.5, 2.5]


def shown_in_views():
    """What the four views show, how, at which position, and whether slices have two colours."""
    found = set()
    for view in simple.GetRenderViews():
        for display in view.Representations:
            if getattr(display, "Representation", None) and display.Visibility:
                image = picture(view)
                assert image.max() > 0.2, "it is black"
                kind = str(display.Representation.GetData())
                red = (image[:, :, 0] > image[:, :, 2] + 0.2).mean() > 0.1  # not the lines alone
                found.add((display.Input.GetXMLName(), kind, tuple(display.SlicePosition),
                           bool(red) and kind == "Deformed Slices"))
    return found


def the_volume_stays():
    """Where a comparison is deleted that Four Views was opened on; undo brings it back."""
    before, place = shown_in_views(), (1.5, 0.5, 2.5)
    assert before == {("CompareVolumes", "Deformed Slices", place, True),
                      ("CompareVolumes", "Deformed Volume", place, False)}, before
    assert hand.select(simple.FindSource("second"))
    hand.delete_selected()
    hand.wait(300)
    found = shown_in_views()
    assert found == {("FreeFormDeformation", "Deformed Slices", place, False),
                     ("FreeFormDeformation", "Deformed Volume", place, False)}, found
    window.action("Undo")
    hand.wait(300)
    assert shown_in_views() == before, shown_in_views()
    window.action("Redo")
    hand.wait(300)
    assert shown_in_views() == found, shown_in_views()


def play():
    view = simple.GetActiveViewOrCreate("RenderView")
    hand.resize(SIZE, SIZE)
    first, second = compared("first", -4.0), compared("second", 4.0)
    display = show(first, view)
    hand.wait(100)
    flicker_in_turn(first, second, view)
    keep_what_was_chosen(first)
    drag_the_wipe(view, display)
    del display
    delete_while_it_flickers(first, second)
    four_views_show_it(second, view)
    del first, second
    the_volume_stays()


window.main("CompareByHand", [(play,)])
