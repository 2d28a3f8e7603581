# SPDX-License-Identifier: BSD-3-Clause
"""Proves that Four Views survives undo, redo, closed views, a second layout and a state that is
opened again, one by one and shuffled under a fixed seed: no crash, no message, no empty cell, and
the button shows four views each time.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import os
import random

import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import on_screen, picture
from paraview import simple

SEED = 5
ACTIONS = 40
BUTTON = "actionBrainShiftFourViews"
STATE = os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "four.pvsm")


def begin():
    """A bent block, made as a user does, in the window's first view."""
    with window.unrecorded():
        simple.Wavelet(WholeExtent=[0, 20, 0, 24, 0, 28])
    window.bend()
    simple.GetDisplayProperties().SetRepresentationType("Deformed Volume")
    hand.wait(300)


def four_views():
    bent = window.deformation()
    simple.SetActiveSource(bent)
    assert hand.action(BUTTON)
    hand.wait(200)


def empty_cells(layout, cell=0):
    if layout.IsSplitCell(cell):
        return sum(empty_cells(layout, 2 * cell + side) for side in (1, 2))
    return int(layout.GetView(cell) is None)


def active_view():
    """The active view; undo can leave none for a while, until a view is clicked."""
    return simple.GetActiveView() or simple.GetRenderViews()[0]


def four_are_shown():
    """Whether the active view's layout has four views and no empty cell."""
    layout = simple.GetLayout(active_view())
    views = simple.GetViewsInLayout(layout)
    assert len(views) == 4, len(views)
    assert empty_cells(layout) == 0, "no cell is empty"
    shown = [str(display.Representation.GetData()) for view in views
             for display in view.Representations
             if getattr(display, "Representation", None) and display.Visibility]
    assert sorted(shown) == ["Deformed Slices"] * 3 + ["Deformed Volume"], shown


def flat(view):
    return view.InteractionMode == "2D"


def click(view):
    simple.SetActiveView(view)
    width, height = view.ViewSize
    hand.over(view)
    hand.drag([width // 2, height // 2], [width // 2, height // 2])
    hand.over()


def undo(times):
    for _ in range(times):
        hand.action("actionEditUndo")
        hand.wait(50)


def redo(times):
    for _ in range(times):
        hand.action("actionEditRedo")
        hand.wait(50)


def undone_split():
    """A change of a layout after an undo is taken back to what the undo left."""
    view = simple.GetActiveViewOrCreate("RenderView")
    assert hand.press_frame(view, "Split Vertical Axis") and hand.fill_frame()
    undo(2)
    assert hand.press_frame(view, "Split Horizontal Axis")
    undo(1)
    layout = simple.GetLayout(view)
    assert simple.GetViewsInLayout(layout) == [view] and not layout.IsSplitCell(0)
    simple.SetActiveView(view)  # the one that was active is gone


def close_and_undo():
    """What was clicked and closed comes back, and Four Views is a step to undo and redo."""
    begin()
    four_views()
    four_are_shown()
    before = cameras()
    view = next(view for view in simple.GetRenderViews() if flat(view))
    click(view)
    assert hand.close_view(view)
    del view
    undo(1)
    hand.wait(200)
    assert cameras() == before, (cameras(), before)
    undo(1)
    assert len(simple.GetRenderViews()) == 1 and empty_cells(simple.GetLayout()) == 0
    undo(5)
    redo(6)
    hand.wait(200)
    four_are_shown()
    assert cameras() == before, (cameras(), before)
    moves_together()


def flats():
    """The slice views of the active layout."""
    return [view for view in simple.GetViewsInLayout(simple.GetLayout(active_view()))
            if flat(view)]


def zooms():
    """Of the slice views: by their cameras, and by the properties that are linked."""
    return {round(zoom, 6) for view in flats() for zoom in (
        view.SMProxy.GetActiveCamera().GetParallelScale(), view.CameraParallelScale)}


def comes_back_zoomed():
    """A closed slice view that comes back has the zoom of those that stayed, each time."""
    four_views()
    for clicks in (2, -3):
        first, second = flats()[:2]
        hand.close_view(first)
        hand.wait(100)
        before = zooms()
        hand.over(second)
        hand.wheel([side // 2 for side in second.ViewSize], clicks, hand.CONTROL)
        hand.over()
        hand.wait(300)
        zoomed = zooms()
        assert len(zoomed) == 1 and zoomed != before, (zoomed, before)
        del first, second
        undo(1)
        hand.wait(300)
        four_are_shown()
        assert zooms() == zoomed, (zooms(), zoomed)


def reset_forgets():
    """After Reset Session a state looks as it was saved, not as the views looked that have gone."""
    four_views()
    saved = zooms()
    hand.save_state(STATE)
    chosen = flats()[0]
    hand.over(chosen)
    hand.wheel([side // 2 for side in chosen.ViewSize], 3, hand.CONTROL)
    hand.over()
    hand.wait(300)
    del chosen
    assert zooms() != saved
    hand.reset_session()
    hand.load_state(STATE)
    hand.wait(500)
    assert zooms() == saved, (zooms(), saved)


def one_slice_is_left():
    """Of which the button makes the 3D view."""
    four_views()
    layout = simple.GetLayout(active_view())
    for view in sorted(simple.GetViewsInLayout(layout), key=flat)[:-1]:
        hand.close_view(view)
    del view
    simple.SetActiveView(simple.GetViewsInLayout(layout)[0])
    four_views()
    four_are_shown()
    assert sum(not flat(view) for view in simple.GetViewsInLayout(layout)) == 1


def zoomed_together():
    """A slice view that was switched to the volume is drawn when another slice view zooms."""
    four_views()
    views = flats()
    simple.GetDisplayProperties(window.deformation(), views[0]).SetRepresentationType(
        "Deformed Volume")
    for chosen, way in ((views[1], (0, -20)), (views[0], (0, 20))):
        middle = [side // 2 for side in chosen.ViewSize]
        hand.over(chosen)
        hand.right_drag(middle, [at + by for at, by in zip(middle, way)], steps=2)
        hand.over()
        hand.wait(1000)  # pictures become still
        assert len(zooms()) == 1
        for number, view in enumerate(views):
            shown = on_screen(view) / 255.0
            off = numpy.abs(shown - picture(view)).max(axis=2) > 0.1
            assert off.mean() < 0.01, (number, off.mean())


def cameras():
    return sorted((str(view.InteractionMode), [round(part, 3) for part in view.CameraPosition],
                   round(view.CameraParallelScale, 3)) for view in simple.GetRenderViews())


def moves_together():
    """The slices of all views of the active layout have one position."""
    views = simple.GetViewsInLayout(simple.GetLayout(active_view()))
    displays = [simple.GetDisplayProperties(window.deformation(), view) for view in views]
    with window.unrecorded():
        displays[0].SlicePosition = [9.0, 11.0, 13.0]
    positions = {tuple(display.SlicePosition) for display in displays}
    assert positions == {(9.0, 11.0, 13.0)}, positions


def second_layout():
    """The button lays out where the user is, and a closed layout comes back."""
    hand.new_layout()
    four_views()
    four_are_shown()
    assert hand.shown_layout() == 1 and len(simple.GetLayouts()) == 2, "it stays in its layout"
    hand.close_layout(1)
    assert len(simple.GetRenderViews()) == 4
    undo(1)
    redo(1)
    hand.show_layout(0)
    four_views()
    four_are_shown()


def state_again():
    """A state shows its four views, and a view of it can be closed."""
    hand.save_state(STATE)
    with window.unrecorded():
        for source in list(simple.GetSources().values()):
            simple.Delete(source)
        for view in simple.GetViews():
            simple.Delete(view)
    hand.wait(200)
    hand.load_state(STATE)
    hand.wait(300)
    view = simple.GetActiveView()
    assert view is not None, "a view is active"
    four_are_shown()
    moves_together()
    hand.close_view(next(view for view in simple.GetRenderViews() if flat(view)))
    hand.wait(100)
    hand.save_state(STATE)
    four_views()
    four_are_shown()


def close_one():
    views = simple.GetRenderViews()
    if len(views) > 1:
        hand.close_view(chance.choice(views))


def click_one():
    views = flats()
    if views:
        click(chance.choice(views))


def shuffled():
    actions = (four_views, close_one, click_one, lambda: undo(chance.randint(1, 4)),
               lambda: redo(chance.randint(1, 4)), hand.new_layout,
               lambda: hand.show_layout(0), lambda: hand.save_state(STATE))
    for _ in range(ACTIONS):
        action = chance.choice(actions)
        if window.deformation() is None:
            redo(20)
        action()
    redo(20)
    four_views()
    four_are_shown()
    moves_together()


def no_message():
    told, shown = hand.messages()
    bad = [line for line in told  # the window also shows what a script prints
           if any(word in line.lower() for word in ("error", "warn", "traceback"))]
    assert not bad and not shown, bad


chance = random.Random(SEED)
window.main("FourViewsSurvive", [
    (undone_split,), (close_and_undo,), (second_layout,), (state_again,), (shuffled,),
    (comes_back_zoomed,), (one_slice_is_left,), (zoomed_together,), (reset_forgets,),
    (no_message,)])
