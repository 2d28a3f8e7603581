# SPDX-License-Identifier: BSD-3-Clause
"""Proves that Pull bends a head by hand in ParaView's window: tissue follows the hand, pins hold,
the order does not matter, strokes stay on top, and each edit is one step of undo, the first one
together with the fit that it makes. The list in the panel and a state file keep all of it.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import contextlib
import os

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from window_testing import deformation, undo_labels

NEAR = 1.5  # mm, from the hand
FIRST, SECOND, PINNED = (0.05, 0.1), (-0.12, 0.02), (0.12, -0.12)


def head():
    return os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")


def scratch(name):
    return os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], "PullByHand-" + name)


def open_head():
    simple.NIFTIVolumeReader(FileName=head())
    bent, view = window.bend(), simple.GetActiveView()
    display = simple.Show(bent, view)
    assert display.Representation == "Deformed Volume", display.Representation
    simple.ColorBy(display, ("POINTS", "Intensity"))
    brainshift.look(display)
    place_camera()


def place_camera():
    view = simple.GetActiveView()
    view.CameraFocalPoint = (-309, 22, 477)
    view.CameraPosition = (-500, 500, 580)
    view.CameraViewUp = (0, 0, 1)
    view.CameraViewAngle = 25
    simple.Render(view)
    hand.wait(100)


def on_tissue(place):
    """A pixel of the head, from the picture's middle in shares of the view's height."""
    width, height = simple.GetActiveView().ViewSize
    return [width // 2 + round(place[0] * height), height // 2 + round(place[1] * height)]


def tissue_at(pixel):
    return numpy.array(brainshift.pick(simple.GetDisplayProperties(deformation()),
                                       simple.GetActiveView(), *pixel))


def fit():
    return deformation().Lattice


def listed(name, numbers):
    if not fit():
        return numpy.empty((0, numbers))
    return numpy.array(list(fit().GetPropertyValue(name)), float).reshape(-1, numbers)


def pulls():
    return listed("Pulls", 7)


def pins():
    return listed("Pins", 4)


@contextlib.contextmanager
def unrecorded():
    """What a script measures is nothing to undo."""
    builder = servermanager.vtkSMProxyManager.GetProxyManager().GetUndoStackBuilder()
    before = builder.GetIgnoreAllChanges()
    builder.SetIgnoreAllChanges(True)
    try:
        yield
    finally:
        builder.SetIgnoreAllChanges(before)


def lattice():
    with unrecorded():
        fit().UpdatePipeline()
        field = servermanager.Fetch(fit()).GetPointData().GetArray("Displacement")
        return vtk_to_numpy(field).copy()


def drawn(rest):
    """Where tissue at rest is drawn."""
    with unrecorded():
        deformation().UpdatePipeline()
        return numpy.array(brainshift.deformed_from_rest(deformation(), [list(rest)]))[0]


def pull(place, right, up):
    """Drags tissue; returns where the hand took it and where it should lie now."""
    start = on_tissue(place)
    end = [start[0] + right, start[1] + up]
    before = tissue_at(start)
    hand.drag(start, end)
    hand.wait(200)
    return before, end


def sees(pixel, place):
    """How far a place lies beside a pixel, mm."""
    view = simple.GetActiveView()
    at = window.pixel_of(view, place)
    eye, focus = numpy.array(view.CameraPosition), numpy.array(view.CameraFocalPoint)
    forward = (focus - eye) / numpy.linalg.norm(focus - eye)
    depth = (numpy.array(place) - eye) @ forward
    pixel_mm = 2 * depth * numpy.tan(numpy.radians(view.CameraViewAngle) / 2) / view.ViewSize[1]
    return pixel_mm * numpy.linalg.norm(numpy.array(at) - pixel)


def tissue_follows_the_hand():
    assert not hand.is_visible("BrainShiftPulls")
    # No Apply, no other active source, nothing but the edit to undo.
    hand.take(hand.PULL)
    undo, sources = undo_labels(), len(simple.GetSources())
    before, end = pull(FIRST, 25, 20)
    assert len(pulls()) == 1 and not len(pins()), (pulls(), pins())
    rest, target, weight = pulls()[0, :3], pulls()[0, 3:6], pulls()[0, 6]
    assert weight == 1.0 and numpy.linalg.norm(rest - before) < 0.01, (rest, before)
    assert numpy.linalg.norm(target - rest) > 5, (rest, target)
    assert sees(end, target) < 1, sees(end, target)
    assert numpy.linalg.norm(drawn(rest) - target) < NEAR, (drawn(rest), target)
    assert simple.GetActiveSource() == deformation()
    assert not hand.click("Accept"), "there is something to apply"
    assert len(simple.GetSources()) == sources + 1, simple.GetSources()
    assert undo_labels() == (["Pull tissue"] + undo)[:10], undo_labels()


def the_first_pull_is_one_step():
    was, bends = pulls(), lattice()
    window.action("Undo")
    assert not fit() and deformation(), fit()
    assert not [name for name, _ in simple.GetSources() if name.endswith(" fit")]
    window.action("Redo")
    hand.wait(200)
    assert (pulls() == was).all() and numpy.allclose(lattice(), bends), pulls()
    assert not hand.click("Accept"), "there is something to apply"


def a_second_drag_moves_the_pull():
    rest = pulls()[0, :3]
    start = window.pixel_of(simple.GetActiveView(), drawn(rest))
    target = pulls()[0, 3:6]
    hand.drag(start, [start[0] - 6, start[1] - 4])
    hand.wait(200)
    assert len(pulls()) == 1 and (pulls()[0, :3] == rest).all(), pulls()
    assert numpy.linalg.norm(pulls()[0, 3:6] - target) > 1, pulls()
    assert numpy.linalg.norm(drawn(rest) - pulls()[0, 3:6]) < NEAR
    window.action("Undo")
    assert (pulls()[0, 3:6] == target).all(), pulls()


def a_parallel_view_takes_it_from_nearby():
    # Pixels are as many mm at any depth; a pull is taken from 12 of them away.
    view = simple.GetActiveView()
    view.CameraParallelProjection, view.CameraParallelScale = 1, 116.0
    simple.Render(view)
    hand.wait(200)
    rest, target = pulls()[0, :3], pulls()[0, 3:6]
    at = window.pixel_of(view, drawn(rest))
    for away, is_near in (((4, 3), True), ((20, 20), False)):
        start = [at[0] + away[0], at[1] + away[1]]
        hand.drag(start, [start[0] - 6, start[1] - 4])
        hand.wait(200)
        assert len(pulls()) == (1 if is_near else 2), (away, pulls())
        assert (pulls()[0, :3] == rest).all(), (away, pulls())
        assert (pulls()[0, 3:6] != target).any() == is_near, (away, pulls())
        window.action("Undo")
        assert len(pulls()) == 1 and (pulls()[0, 3:6] == target).all(), (away, pulls())
    view.CameraParallelProjection = 0
    simple.Render(view)
    hand.wait(100)


def escape_drops_it():
    was, undo = pulls(), undo_labels()
    start = on_tissue(SECOND)
    hand.hover(start)
    hand.press(start)
    hand.drag_to([start[0] + 30, start[1]])
    hand.wait()
    assert len(pulls()) == 2, pulls()
    hand.tap(hand.ESCAPE)
    hand.release([start[0] + 30, start[1]])
    hand.wait(100)
    assert (pulls() == was).all() and undo_labels() == undo, (pulls(), undo_labels())


def a_pin_holds():
    moved = numpy.array([drawn(tissue) - tissue for tissue in [tissue_at(on_tissue(PINNED))]])[0]
    start = on_tissue(PINNED)
    hand.hover(start, hand.SHIFT)
    hand.press(start, hand.SHIFT)
    hand.release(start, hand.SHIFT)
    hand.wait(200)
    assert len(pins()) == 1 and pins()[0, 3] == 1, pins()
    assert undo_labels()[0] == "Pin tissue", undo_labels()
    pinned = pins()[0, :3]
    assert numpy.linalg.norm(moved) > 1.5, moved  # or the pin would have nothing to hold
    assert numpy.linalg.norm(drawn(pinned) - pinned) < 1, drawn(pinned) - pinned
    window.until(lambda: window.shown(simple.GetActiveView(), "Held") == 1, "the pin is drawn")
    at = window.pixel_of(simple.GetActiveView(), drawn(pinned))
    hand.press(at, hand.SHIFT)
    hand.release(at, hand.SHIFT)
    hand.wait(200)
    assert not len(pins()) and undo_labels()[0] == "Remove pin", (pins(), undo_labels())
    window.action("Undo")
    assert (pins()[:, :3] == pinned).all(), pins()


def the_order_does_not_matter():
    pull(SECOND, -15, 25)
    assert len(pulls()) == 2, pulls()
    bends, numbers = lattice(), pulls()
    for rest, target in zip(numbers[:, :3], numbers[:, 3:6]):
        assert numpy.linalg.norm(drawn(rest) - target) < NEAR, (drawn(rest), target)
    fit().Pulls = numbers[::-1].ravel().tolist()
    assert numpy.abs(lattice() - bends).max() < 1e-4, numpy.abs(lattice() - bends).max()
    fit().Pulls = numbers.ravel().tolist()
    simple.Render()
    hand.wait(200)


def a_stroke_stays_on_top():
    hand.take(hand.SOFT)
    start = on_tissue(FIRST)
    hand.drag(start, [start[0], start[1] + 25])
    hand.wait(200)
    stroke = window.strokes()
    assert len(stroke) == 1, stroke
    hand.take(hand.PULL)
    before, target = tissue_at(start), pulls()
    pull(FIRST, 15, 0)
    assert window.strokes() == stroke, window.strokes()
    changed = pulls()[: len(target)] != target
    assert len(pulls()) == 3 or changed.any(), pulls()
    number = 2 if len(pulls()) == 3 else int(numpy.argmax(changed.any(axis=1)))
    now = drawn(pulls()[number, :3])
    assert sees([start[0] + 15, start[1]], now) < 2 * NEAR, (now, before)
    window.action("Undo")
    assert len(pulls()) == 2, pulls()


def the_list_edits():
    # The mouse and the keys of the list itself are those of the list of strokes.
    assert hand.is_visible("BrainShiftPulls") and not hand.label("BrainShiftProblem")
    was, held = pulls(), pins()
    assert len(was) == 2 and len(held) == 1, (was, held)
    assert hand.click("BrainShiftClearPulls")
    hand.wait(200)
    assert not len(pulls()) and not len(pins()), (pulls(), pins())
    assert not lattice().any(), numpy.abs(lattice()).max()
    assert undo_labels()[0] == "Clear All Pulls", undo_labels()
    window.action("Undo")
    assert (pulls() == was).all() and (pins() == held).all(), (pulls(), pins())


def settings_are_shared():
    # As Apply in the panel does: one step, which takes the fit along.
    simple.SetActiveSource(deformation())
    deformation().LatticeDimensions = [15, 15, 15]
    hand.wait(200)
    assert list(fit().LatticeDimensions) == [15, 15, 15], fit().LatticeDimensions
    deformation().LatticeDimensions = [19, 19, 19]
    hand.wait(200)
    assert list(fit().LatticeDimensions) == [19, 19, 19], fit().LatticeDimensions


def slices_are_pulled_within():
    # In a slice, the pull lies in the slice's plane.
    display = simple.GetDisplayProperties(deformation())
    display.SetRepresentationType("Deformed Slices")
    simple.Render()
    hand.wait(200)
    before = len(pulls())
    pull((0.02, 0.06), 20, 10)
    assert len(pulls()) == before + 1, pulls()
    moved = pulls()[-1, 3:6] - drawn_by_fit(pulls()[-1, :3])
    assert numpy.linalg.norm(moved) < NEAR, moved
    window.action("Undo")
    display.SetRepresentationType("Deformed Volume")
    simple.Render()
    hand.wait(200)
    assert len(pulls()) == before, pulls()


def drawn_by_fit(rest):
    """Where the fit takes tissue at rest, without strokes."""
    kept = list(deformation().Strokes)
    with unrecorded():
        deformation().Strokes = []
        place = drawn(rest)
        deformation().Strokes = kept
    return place


def a_state_keeps_it():
    was, held, bends = pulls(), pins(), lattice()
    file = scratch("state.pvsm")
    simple.SaveState(file)
    hand.take(hand.NONE)
    simple.ResetSession()
    hand.wait(200)
    simple.LoadState(file)
    os.remove(file)
    hand.wait(500)
    assert (pulls() == was).all() and (pins() == held).all(), (pulls(), pins())
    assert numpy.allclose(lattice(), bends, atol=1e-5)
    deformation().LatticeDimensions = [17, 17, 17]
    hand.wait(200)
    assert list(fit().LatticeDimensions) == [17, 17, 17], "the fit no longer follows"


def nothing_measured_bends_nothing():
    fit().Pulls, fit().Pins = [], []
    assert not lattice().any(), numpy.abs(lattice()).max()
    fit().SMProxy.UpdatePropertyInformation()
    assert not fit().GetPropertyValue("Problem"), fit().GetPropertyValue("Problem")


def another_lattice_is_followed():
    """A field that is the Lattice becomes the base of the fit that the first pull makes."""
    simple.SetActiveSource(deformation())
    deformation().Strokes = []
    grid = simple.DeformationLattice(registrationName="theirs", Input=deformation())
    other = simple.FreeFormDeformation(registrationName="bent", Input=deformation().Input,
                                       Lattice=grid)
    simple.RenameSource("first", simple.FindSource("bent"))
    simple.RenameSource("bent", other)
    simple.Hide(simple.FindSource("first"))
    simple.Show(other)
    simple.SetActiveSource(other)
    simple.Render()
    hand.take(hand.PULL)
    hand.hover(on_tissue(FIRST))
    hand.wait(200)
    pull(FIRST, 25, 20)
    assert fit() and fit().Base == grid, deformation().Lattice
    assert len(pulls()) == 1 and lattice().any(), pulls()
    window.action("Undo")
    assert deformation().Lattice == grid, deformation().Lattice
    window.action("Redo")
    assert fit() and fit().Base == grid, deformation().Lattice


window.main("PullByHand", [
    (open_head,), (tissue_follows_the_hand,), (the_first_pull_is_one_step,),
    (a_second_drag_moves_the_pull,), (a_parallel_view_takes_it_from_nearby,), (escape_drops_it,),
    (a_pin_holds,), (the_order_does_not_matter,), (a_stroke_stays_on_top,), (the_list_edits,),
    (settings_are_shared,), (slices_are_pulled_within,), (a_state_keeps_it,),
    (nothing_measured_bends_nothing,), (another_lattice_is_followed,)])
