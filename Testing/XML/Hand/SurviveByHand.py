# SPDX-License-Identifier: BSD-3-Clause
"""Proves that nothing crashes and no stroke is lost when things change under the hand in ParaView's
window: no data yet, a hidden volume, data replaced or gone, one of the four views closed, undo
past the filter's creation, a display with a transform, two filters at once, a large lattice;
and, last, the window closed in mid-drag. And that O shows the volume as loaded without a tool.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import brainshift
import test_hand as hand
import window_testing as window
from paraview import simple
from window_testing import deformation, strokes, undo_labels


def head(side=40):
    return simple.Wavelet(WholeExtent=[0, side, 0, side, 0, side], Center=[side / 2] * 3)


def show(bent, view):
    """As Deformed Volume, opaque enough to take hold of."""
    display = simple.Show(bent, view)
    display.SetRepresentationType("Deformed Volume")
    simple.ColorBy(display, ("POINTS", "RTData"))
    opacity = simple.GetOpacityTransferFunction("RTData")
    opacity.Points = [0, 1, 0.5, 0, 300, 1, 0.5, 0]
    simple.SetActiveSource(bent)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(100)
    return display


def begin(**named):
    """A bent block alone in a view."""
    finish()
    bent = simple.FreeFormDeformation(registrationName="bent", Input=head(), **named)
    view = simple.GetActiveViewOrCreate("RenderView")
    show(bent, view)
    return bent, view


def finish():
    hand.take(hand.NONE)
    hand.over()
    for source in list(simple.GetSources().values()):
        simple.Delete(source)
    hand.wait(100)


def middle(view, right=0, up=0):
    width, height = view.ViewSize
    return [width // 2 + right, height // 2 + up]


def take_hold(view, right=0, up=0):
    hand.hover(middle(view, right, up))
    hand.press(middle(view, right, up))
    hand.drag_to(middle(view, right + 15, up + 10))
    hand.wait()


def go_on(view):
    """The hand knows nothing of what happened."""
    hand.drag_to(middle(view, 30, 20))
    hand.wait(100)
    hand.release(middle(view, 30, 20))
    hand.hover(middle(view, 5, 5))
    hand.wheel(middle(view, 5, 5), 1)
    hand.wait(700)


def deformations():
    return [source for source in simple.GetSources().values()
            if source.GetXMLName() == "FreeFormDeformation"]


def each_tool(work, view):
    for tool in (hand.MOVE, hand.SOFT, hand.STAMP):
        hand.take(tool)
        work(view)


def without_data():
    # Sources that have not been read, and a filter that was not applied.
    finish()
    view = simple.GetActiveViewOrCreate("RenderView")
    empty = simple.PVTrivialProducer()
    bent = simple.FreeFormDeformation(registrationName="bent", Input=empty)
    simple.SetActiveSource(bent)

    def work(over):
        take_hold(over)
        go_on(over)
    each_tool(work, view)
    assert strokes() == [], strokes()


def hidden():
    bent, view = begin()
    simple.Hide(bent, view)
    simple.Render(view)

    def work(over):
        take_hold(over)
        go_on(over)
    each_tool(work, view)
    assert strokes() == [], "nothing is seen to take hold of"
    # Hidden while something is under the hand: the stroke stays until it is let go.
    show(bent, view)
    hand.take(hand.SOFT)
    take_hold(view)
    simple.Hide(bent, view)
    hand.drag_to(middle(view, 20, 20))
    hand.wait(100)
    hand.release(middle(view, 20, 20))
    hand.wait(100)
    assert len(strokes()) == 1 and undo_labels()[0] == "Soft stroke", (strokes(), undo_labels())


def data_replaced():
    bent, view = begin(Strokes=brainshift.soft((20, 20, 20), (1, 0, 0), 10.0))

    def work(over):
        before = strokes()
        take_hold(over)
        bent.Input = head(30)
        hand.wait(50)
        bent.Input.WholeExtent = [0, 20, 0, 30, 0, 25]
        simple.Render(over)
        go_on(over)
        assert strokes()[:len(before)] == before, (before, strokes())
        bent.Input = head()
        simple.ResetCamera(over)
        simple.Render(over)
        hand.wait(50)
    each_tool(work, view)
    bent.Input.WholeExtent = [0, 40, 0, 40, 0, 0]  # flat: an error, and nothing to bend
    simple.Render(view)
    each_tool(lambda over: (take_hold(over), go_on(over)), view)
    bent.Input.WholeExtent = [0, 40, 0, 40, 0, 40]
    simple.Render(view)


def source_deleted():
    # What the filter is made of, with it, in mid-drag.
    for tool in (hand.MOVE, hand.SOFT, hand.STAMP):
        bent, view = begin()
        source = bent.Input
        hand.take(tool)
        take_hold(view)
        simple.Delete(bent)
        simple.Delete(source)
        del bent, source
        go_on(view)
        assert deformation() is None


def representation_changed():
    bent, view = begin()
    display = simple.GetDisplayProperties(bent, view)
    hand.take(hand.SOFT)
    for kind in ("Deformed Slices", "Outline", "Deformed Volume"):
        take_hold(view)
        display.SetRepresentationType(kind)
        simple.Render(view)
        go_on(view)
    assert strokes(), "strokes were made"


def one_of_four_views_closed():
    bent, _ = begin()
    views = brainshift.four_views(bent)
    for name, in_mid_drag in (("coronal", False), ("axial", True)):
        view = views.pop(name)
        before = strokes()
        hand.take(hand.SOFT)
        hand.over(view)
        hand.hover(middle(view))
        hand.wait(50)
        if in_mid_drag:
            take_hold(view)
            assert len(strokes()) == len(before) + 1
        hand.over()
        simple.Delete(view)
        hand.wait(200)
        assert strokes() == before, "as before the drag"
        # The others go on.
        for other in (views["sagittal"], views["volume"]):
            count = len(strokes())
            hand.over(other)
            hand.drag(middle(other), middle(other, 12, 9))
            assert len(strokes()) == count + 1, (name, strokes())
    hand.over()
    for view in (views["sagittal"],):
        simple.Delete(view)
    hand.wait(100)


def undo_past_creation():
    finish()
    source = head()
    source.UpdatePipeline()
    simple.SetActiveSource(source)
    hand.wait(200)
    view = simple.GetActiveViewOrCreate("RenderView")
    hand.create_filter("FreeFormDeformation")
    hand.wait(100)
    bent, = deformations()
    hand.click("Accept")
    hand.wait(100)
    show(bent, view)
    hand.take(hand.SOFT)
    hand.drag(middle(view), middle(view, 15, 10))
    assert len(bent.Strokes) == window.NUMBERS
    take_hold(view)
    del bent
    while hand.action("actionEditUndo"):
        hand.wait()
    go_on(view)
    assert deformations() == [], deformations()
    while hand.action("actionEditRedo"):
        hand.wait()
    assert [len(found.Strokes) for found in deformations()] == [window.NUMBERS], deformations()
    go_on(view)


def around_the_middle(view):
    """Pixels 12 apart, row by row: the camera may stand anywhere after the steps before."""
    width, height = (side // 24 for side in view.ViewSize)
    for up in sorted(range(-height, height + 1), key=abs):
        for right in range(-width, width + 1):
            yield middle(view, 12 * right, 12 * up)


def moved_display():
    # What it draws is not where its tissue is.
    bent, view = begin()
    display = simple.GetDisplayProperties(bent, view)
    for name, value in (("Translation", [10, 0, 0]), ("Orientation", [0, 0, 20]),
                        ("Scale", [2, 1, 1])):
        usual = list(getattr(display, name))
        every = (hand.MOVE, hand.SOFT, hand.STAMP, hand.PULL)
        for tool in every if name == "Translation" else (hand.SOFT,):
            setattr(display, name, value)
            simple.ResetCamera(view)
            simple.Render(view)
            hand.take(tool)
            take_hold(view)
            go_on(view)
            assert strokes() == [] and not bent.Lattice, (name, tool, strokes())
            said = hand.label("BrainShiftStatus")
            assert "Set Translation and Orientation to 0 and Scale to 1." in said, said
            setattr(display, name, usual)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.take(hand.SOFT)
    hand.drag(middle(view), middle(view, 15, 10))
    assert len(strokes()) == 1 and "Scale" not in hand.label("BrainShiftStatus"), strokes()


def two_filters():
    # The tools act on the active one, and O on the same.
    bent, view = begin()
    beside = simple.Wavelet(WholeExtent=[60, 100, 0, 40, 0, 40], Center=[80, 20, 20])
    other = simple.FreeFormDeformation(registrationName="other", Input=beside)
    show(other, view)
    simple.ResetCamera(view)
    simple.Render(view)
    hand.wait(100)
    for active, resting in ((bent, other), (other, bent)):
        simple.SetActiveSource(active)
        hand.take(hand.MOVE)
        display = simple.GetDisplayProperties(active, view)
        pixel = next(pixel for pixel in around_the_middle(view)
                     if brainshift.pick(display, view, *pixel))
        hand.take(hand.SOFT)
        kept = list(resting.Strokes)
        hand.drag(pixel, [pixel[0] + 10, pixel[1] + 10])
        assert len(active.Strokes) == window.NUMBERS, active.Strokes
        assert list(resting.Strokes) == kept
        hand.key_down("o")
        hand.wait(50)
        assert (active.Strength, resting.Strength) == (0.0, 1.0)
        hand.key_up("o")
        hand.wait(50)
        assert (active.Strength, resting.Strength) == (1.0, 1.0)
    # Bent twice: what is seen is the second's; it is the one that is taken hold of.
    simple.Hide(other, view)
    twice = simple.FreeFormDeformation(registrationName="twice", Input=bent)
    simple.Hide(bent, view)
    show(twice, view)
    hand.take(hand.SOFT)
    kept = list(bent.Strokes)
    hand.drag(middle(view), middle(view, 10, 10))
    assert len(twice.Strokes) == window.NUMBERS and list(bent.Strokes) == kept
    simple.SetActiveSource(bent)
    hand.drag(middle(view), middle(view, 10, 10))
    assert list(bent.Strokes) == kept, "it is not shown: its tissue lies elsewhere"


def before_without_a_tool():
    bent, view = begin()
    assert hand.action("actionBrainShiftCompare"), "also without strokes, for a base lattice bends"
    bent, view = begin(Strokes=brainshift.soft((20, 20, 20), (3, 0, 0), 15.0))
    undo = undo_labels()
    hand.hover(middle(view))
    hand.key_down("o")
    hand.wait(200)
    assert bent.Strength == 0.0, bent.Strength
    hand.key_up("o")
    hand.wait(100)
    assert bent.Strength == 1.0 and undo_labels() == undo, (bent.Strength, undo_labels())
    simple.SetActiveSource(bent.Input)  # the only deformation there is
    hand.key_down("o")
    hand.wait(100)
    assert bent.Strength == 0.0, bent.Strength
    hand.key_up("o")
    assert bent.Strength == 1.0, bent.Strength


def large_lattice():
    # 65 control points a side: few of them are shown, and the one taken hold of moves.
    bent, view = begin(LatticeDimensions=[65, 65, 65], Samples=0)
    hand.take(hand.STAMP)
    hand.hover(middle(view))
    hand.wheel(middle(view), 3)
    window.settle("Stamp: pull")
    hand.take(hand.MOVE)
    hand.hover(middle(view, 3, 3))
    hand.wait()
    assert 5 < window.shown(view, "ControlPoints") < 50, window.shown(view, "ControlPoints")
    assert 5 < window.shown(view, "Faint") < 250, window.shown(view, "Faint")
    hand.drag(middle(view, 3, 3), middle(view, 20, 12))
    tools = [stroke[0] for stroke in strokes()]
    assert tools == [brainshift.STAMP, brainshift.MOVE], tools


def selection_of_another_lattice():
    # What was selected is no control point any more.
    bent, view = begin(LatticeDimensions=[33, 33, 33], Samples=0)
    hand.take(hand.MOVE)
    for dimensions, pixel in ((33, middle(view, 60, 40)), (41, middle(view))):
        bent.LatticeDimensions = [dimensions] * 3
        simple.Render(view)
        hand.wait(100)
        hand.hover(pixel)
        hand.press(pixel, hand.SHIFT)
        hand.release(pixel, hand.SHIFT)
        hand.wait()
        assert window.shown(view, "Highlights") == 1, window.shown(view, "Highlights")
    hand.drag(middle(view), middle(view, 15, 10))
    assert len(strokes()) == 1, strokes()


def leave_in_mid_drag():
    """The window closes while the hand holds tissue."""
    _, view = begin()
    hand.take(hand.SOFT)
    take_hold(view)
    assert len(strokes()) == 1, strokes()


STEPS = (without_data, hidden, data_replaced, source_deleted, representation_changed,
         one_of_four_views_closed, undo_past_creation, moved_display, two_filters,
         before_without_a_tool, large_lattice, selection_of_another_lattice, leave_in_mid_drag)

if __name__ == "__main__":
    window.main("SurviveByHand", ((step,) for step in STEPS))
