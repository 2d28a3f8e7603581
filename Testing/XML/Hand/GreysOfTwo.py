# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the slices of Four Views are grey where two volumes are open, whose arrays have one
name: a head and its brain mask, and two heads. The 3D view keeps its natural colours. After
Apply, colours and camera are steps of their own to undo, few of them, and redo brings them back. A
choice of the representation is one step, which takes the colours with it.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import os
import shutil

import brainshift
import brainshift.windows
import test_hand as hand
import window_testing as window
from brainshift_testing import scratch
from paraview import simple

FOLDER = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah")
HEAD = os.path.join(FOLDER, "seg3d_mr_t1.nii.gz")
MASK = os.path.join(FOLDER, "seg3d_brainmask.nii.gz")
OTHER = os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "other.nii.gz")


def colors(display):
    points = list(display.LookupTable.RGBPoints)
    return [points[i + 1:i + 4] for i in range(0, len(points), 4)]


def is_grey(display):
    return all(red == green == blue for red, green, blue in colors(display))


def looks():
    """Of all displays: how, and in which colours.

    Python's first look at a map sends what ParaView has set in it and not sent yet, which would be
    a step to undo."""
    with window.unrecorded():
        return [(str(display.Representation.GetData()), colors(display))
                for display in simple.GetActiveView().Representations if hasattr(display, "Input")]


def first_looks_are_undone_and_redone():
    labels, before = window.undo_labels(), looks()
    assert "Apply" in labels and set(labels[:labels.index("Apply")]) <= {"First look"}, labels
    steps = labels.index("Apply") + 1
    for action in ("Undo", "Redo"):
        for _ in range(steps):
            window.action(action)
            hand.wait(200)
    assert looks() == before, (looks(), before)
    assert window.undo_labels() == labels, (window.undo_labels(), labels)


def greys_of(first, second):
    shutil.copy(HEAD, OTHER)
    for source in list(simple.GetSources().values())[::-1]:
        simple.Delete(source)
    hand.open_file(first)
    hand.open_file(second)
    hand.wait(300)
    assert hand.click("Accept")
    hand.wait(1000)
    first_looks_are_undone_and_redone()
    hand.create_filter("FreeFormDeformation")
    hand.wait(200)
    assert hand.click("Accept")
    hand.wait(1000)
    bent = simple.GetActiveSource()
    assert hand.action("actionBrainShiftFourViews")
    hand.wait(1000)
    displays = [display for view in simple.GetRenderViews() for display in view.Representations
                if getattr(display, "Input", None) == bent and display.Visibility]
    kinds = {"Deformed Slices": 0, "Deformed Volume": 0}
    for display in displays:
        kind = str(display.Representation.GetData())
        kinds[kind] += 1
        assert is_grey(display) == (kind == "Deformed Slices"), (kind, colors(display))
    assert kinds["Deformed Slices"] == 3 and kinds["Deformed Volume"] >= 1, kinds
    a_slice_view_shows_the_volume(displays)
    in_a_new_layout(bent)
    in_a_new_layout(bent.Input)


def a_slice_view_shows_the_volume(displays):
    """A view of Four Views that is switched to the volume shows it in natural colours."""
    display = next(display for display in displays
                   if str(display.Representation.GetData()) == "Deformed Slices")
    kinds = {"Deformed Volume": False, "Deformed Slices": True}
    for kind, grey in kinds.items():
        shown_as(display, kind)
        assert is_grey(display) == grey, (kind, colors(display))


def in_a_new_layout(source):
    """Another 3D display has natural colours, not the greys of slices that were there before."""
    hand.new_layout()
    hand.fill_frame()
    hand.wait(300)
    view = simple.GetActiveView()
    hand.click_eye(source)
    hand.wait(1000)
    display = simple.GetDisplayProperties(source, view)
    assert display.Visibility and str(display.Representation.GetData()) == "Deformed Volume"
    assert not is_grey(display), colors(display)


def shown_as(display, kind):
    """Chosen in the list of representations."""
    display.SetRepresentationType(kind)
    hand.wait(500)


def slices_by_hand():
    """A Deformed Volume that is switched to slices has greys of its own, which span its tissue, and
    gets its colours back. Slices of one volume share their greys; an array that is chosen again
    brings no colours of the look."""
    for source in list(simple.GetSources().values())[::-1]:
        simple.Delete(source)
    view = simple.GetActiveViewOrCreate("RenderView")
    hand.open_file(HEAD)
    hand.wait(200)
    assert hand.click("Accept")
    hand.wait(1000)
    head = simple.GetActiveSource()
    display = simple.GetDisplayProperties(head, view)
    look = list(display.LookupTable.RGBPoints)
    assert not is_grey(display), look
    shown_as(display, "Deformed Slices")
    assert is_grey(display), colors(display)
    points = list(display.LookupTable.RGBPoints)
    low, high = brainshift.windows.percentile_window(head, "POINTS", display.ColorArrayName[1])
    assert points[0] == low and points[-4] == high, (points, low, high)
    hand.save_picture(scratch("slices.png"))
    simple.ColorBy(display, ("POINTS", display.ColorArrayName[1]),  # as the list of arrays does
                   separate=bool(display.UseSeparateColorMap))
    hand.wait(500)
    assert is_grey(display) and list(display.LookupTable.RGBPoints) == points
    shown_as(display, "Deformed Volume")
    assert list(display.LookupTable.RGBPoints) == look
    shown_as(display, "Deformed Slices")
    bent = simple.FreeFormDeformation(Input=head)
    of_bent = simple.Show(bent, view, "UniformGridRepresentation")
    hand.wait(500)
    assert list(of_bent.LookupTable.RGBPoints) == look, "the 3D display keeps the look"
    shown_as(of_bent, "Deformed Slices")
    assert of_bent.LookupTable == display.LookupTable, "window and level of the volume"


def kinds_are_undone_and_redone():
    """Each choice in the list of representations is one step, which takes the colours with it."""
    hand.reset_session()
    simple.GetActiveViewOrCreate("RenderView")
    hand.open_file(HEAD)
    hand.wait(200)
    assert hand.click("Accept")
    hand.wait(1000)
    natural = looks()[0][1]
    for kind in ("Deformed Slices", "Slice", "Deformed Slices", "Outline", "Deformed Volume"):
        before = looks()
        assert hand.choose("Representation", kind)
        hand.wait(300)
        assert looks()[0][0] == kind
        assert (looks()[0][1] == natural) == (kind != "Deformed Slices"), looks()
        after = looks()
        for action, expected in (("Undo", before), ("Redo", after)):
            window.action(action)
            hand.wait(300)
            assert looks() == expected, (action, kind, looks(), expected)


def a_state_keeps_looks_and_greys():
    """Who opens a state file and chooses another representation sees what he saw without it."""
    path = scratch("greys.pvsm")
    for saved, chosen in (("Deformed Slices", "Deformed Volume"),
                          ("Deformed Volume", "Deformed Slices")):
        assert hand.choose("Representation", saved)
        hand.wait(300)
        hand.save_state(path)
        hand.reset_session()
        hand.load_state(path)
        hand.wait(300)
        simple.SetActiveSource(list(simple.GetSources().values())[0])
        hand.wait(300)
        assert hand.choose("Representation", chosen)
        hand.wait(500)
        (kind, _), = looks()
        display = simple.GetDisplayProperties()
        assert kind == chosen and is_grey(display) == (kind == "Deformed Slices"), looks()


def open_two():
    """In a new session; the second volume has colours of its own."""
    hand.reset_session()
    simple.GetActiveViewOrCreate("RenderView")
    shutil.copy(HEAD, OTHER)
    opened = []
    for name in (HEAD, OTHER):
        hand.open_file(name)
        hand.wait(200)
        assert hand.click("Accept")
        hand.wait(1000)
        opened.append(simple.GetActiveSource())
    return opened


def maps(source):
    """The proxies of the colours and of the opacities of a volume."""
    display = simple.GetDisplayProperties(source)
    return [display.SMProxy.GetProperty(name).GetProxy(0)
            for name in ("LookupTable", "ScalarOpacityFunction")]


def a_bent_volume_joins_the_look():
    """Both maps of a bent volume are those of its input, also after redo."""
    opened = open_two()
    assert maps(opened[0])[0] != maps(opened[1])[0]
    hand.create_filter("FreeFormDeformation")
    assert hand.click("Accept")
    hand.wait(1000)
    steps = window.undo_labels().index("Apply") + 2
    for action in (None, "Undo", "Redo"):
        for _ in range(steps if action else 0):
            window.action(action)
            hand.wait(200)
        hand.wait(500)
        if action != "Undo":
            assert maps(window.deformation()) == maps(opened[1]), action


def a_second_view_joins_the_look():
    """A volume that has colours of its own has them in another view, too, also after redo."""
    opened = open_two()
    view = simple.GetActiveView()
    simple.SetActiveSource(opened[0])
    hand.wait(300)
    assert hand.click("See-through"), "a look that the next volumes would get"
    hand.wait(300)
    hand.new_layout()
    hand.fill_frame()
    hand.wait(300)
    hand.click_eye(opened[1])
    hand.wait(1000)
    steps = 1 + [label.startswith("Show ") for label in window.undo_labels()].index(True)
    for action in (None, "Undo", "Redo"):
        for _ in range(steps if action else 0):
            window.action(action)
            hand.wait(200)
        if action != "Undo":
            hand.wait(500)
            tables = [simple.GetDisplayProperties(opened[1], shown).LookupTable
                      for shown in (view, simple.GetActiveView())]
            assert tables[0] == tables[1], (action, [list(table.RGBPoints) for table in tables])


window.main("GreysOfTwo", [(greys_of, MASK, HEAD), (greys_of, HEAD, OTHER), (slices_by_hand,),
                           (kinds_are_undone_and_redone,), (a_state_keeps_looks_and_greys,),
                           (a_bent_volume_joins_the_look,), (a_second_view_joins_the_look,)])
