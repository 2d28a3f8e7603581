# SPDX-License-Identifier: BSD-3-Clause
"""Proves that pairs of landmarks are picked by clicks in the four views of a head and its moved
reference, first the tissue and then its place in the reference, not in the volume as loaded;
that a half pair never reaches the fit, and a drag while picking is the camera's; that the table
shows the filter's residuals and errors of pairs left out, marks the pair that fits worst, and
lets a pair count or not by its tick; that each edit is one step to undo; that marks stand in the
views, with letters that are as large to the eye at 200 %; that two lists without a common name
are paired by their order on request; and that a state keeps the pairs.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import math

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift.reports import numbers
from brainshift_testing import data, picture, scratch
from paraview import simple

TABLE = "BrainShiftLandmarks"
SHIFT = numpy.array((3.0, -4.0, 2.0))  # mm, of the reference
SPOILED, ERROR = 2, numpy.array((0.0, 9.0, 0.0))  # a pair, and what is wrong with it (mm)
# From the middle of the head, mm.
PLACES = numpy.array(((30.0, 10, 12), (-28, 20, -6), (5, -35, 8), (-15, -18, 30), (22, 32, -14),
                      (2, 4, 2)))

scene = {}


def set_up():
    head, reference = (simple.OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
                       for _ in range(2))
    view = simple.GetActiveViewOrCreate("RenderView")
    simple.SetActiveSource(head)
    simple.Show(head, view)
    bent = window.bend()
    compare = simple.CompareVolumes(registrationName="compare", Input=bent, Reference=reference,
                                    ReferenceTranslation=SHIFT.tolist())
    compare.UpdatePipeline()
    simple.SetActiveView(view)
    scene["views"] = brainshift.four_views(compare)
    scene["bent"], scene["compare"] = bent, compare
    bounds = bent.GetDataInformation().GetBounds()
    scene["middle"] = numpy.array([sum(bounds[i:i + 2]) / 2 for i in (0, 2, 4)])
    simple.SetActiveSource(bent)
    hand.resize_window(1280, 900)
    wait_for(lambda: hand.is_visible("BrainShiftPickPairs"), "the button")
    hand.wait(300)


def wait_for(happened, what):
    for _ in range(200):
        if happened():
            return
        hand.wait(50)
    raise AssertionError(f"{what} never came")


def fit():
    lattice = scene["bent"].Lattice
    return lattice if lattice and lattice.SMProxy.GetXMLName() == "FitDeformation" else None


def pairs():
    return numpy.reshape(list(fit().LandmarkPairs), (-1, 7)) if fit() else numpy.empty((0, 7))


def told(name):
    fit().SMProxy.UpdatePropertyInformation(fit().SMProxy.GetProperty(name))
    return numpy.array(list(numbers(fit().SMProxy, name)))


def rows():
    """Of the table: ticked, bold, sign of the last column; text of all three."""
    found = []
    while True:
        cells = [hand.cell(TABLE, len(found), column) for column in range(3)]
        if cells[0] is None:
            return found
        found.append((cells[0][0], cells[0][1], cells[2][2], [cell[3] for cell in cells]))


def request():
    return hand.label("BrainShiftStatus")


def slice_position():
    display = simple.GetDisplayProperties(scene["compare"], scene["views"]["axial"])
    return numpy.array(display.SlicePosition)


def click(view, pixel):
    hand.over(view)
    hand.hover(pixel)
    hand.press(pixel)
    hand.release(pixel)
    hand.wait(20)
    hand.over()


def click_at(name, position):
    """Brings the slices to a position (mm) and clicks it; returns half a pixel (mm)."""
    view = scene["views"][name]
    display = simple.GetDisplayProperties(scene["compare"], view)
    display.SlicePosition = list(position)
    for other in scene["views"].values():
        simple.Render(other)
    click(view, window.pixel_of(view, position))
    return view.GetActiveCamera().GetParallelScale() / view.ViewSize[1]


def cameras():
    return [tuple(view.GetActiveCamera().GetPosition()) for view in scene["views"].values()]


def half_a_pair_never_reaches_the_fit():
    assert hand.label("BrainShiftLandmarkRequest") == "" and not rows()
    hand.take(hand.STAMP)
    assert hand.click("BrainShiftPickPairs")
    hand.wait(50)
    assert hand.setting("tool") == hand.NONE, "the tool is put down"
    assert "Landmark 1: click it in the bent volume bent" in request(), request()
    before = cameras()
    click_at("axial", scene["middle"] + PLACES[0])
    assert "Landmark 1: click the same position in the reference" in request(), request()
    assert fit() is None and cameras() == before and not scene["bent"].Strokes
    hand.tap(hand.ESCAPE)
    hand.wait(50)
    assert "Landmark" not in request(), request()
    assert not hand.is_visible("BrainShiftLandmarkRequest") and fit() is None
    click_at("axial", scene["middle"] + PLACES[1])
    click_at("axial", scene["middle"] + PLACES[1] + SHIFT)
    assert fit() is None, "clicks pick nothing any more"


def drags_are_the_cameras_while_picking():
    hand.click("BrainShiftPickPairs")
    view = scene["views"]["volume"]
    hand.over(view)
    width, height = view.ViewSize
    before = view.GetActiveCamera().GetPosition()
    hand.drag([width // 2, height // 2], [width // 2 + 60, height // 2])
    assert view.GetActiveCamera().GetPosition() != before, "the drag turned the volume"
    assert "click it in the bent volume" in request(), "and it picked nothing"
    hand.over()
    # A tool that is taken ends it.
    hand.take(hand.SOFT)
    assert not hand.is_visible("BrainShiftLandmarkRequest")
    hand.take(hand.NONE)


def as_loaded_is_no_reference():
    refuse_a_click_on(scene["bent"].Input)


def before_align_is_no_reference():
    """A comparison moves the reference, which another view shows where its file has it."""
    refuse_a_click_on(scene["compare"].Reference)


def refuse_a_click_on(head):
    """A volume is shown alone: no landmark may be measured in it."""
    view = scene["views"]["volume"]
    compared = simple.GetDisplayProperties(scene["compare"], view)
    hand.click("BrainShiftPickPairs")
    click_at("axial", scene["middle"] + PLACES[0])
    others = [other for other in (scene["compare"], scene["bent"])
              if simple.GetDisplayProperties(other, view).Visibility]
    with window.unrecorded():
        for other in others:
            simple.Hide(other, view)
        shown = simple.Show(head, view)
        shown.SetRepresentationType("Deformed Volume")
        simple.ColorBy(shown, tuple(compared.ColorArrayName))
        simple.Render(view)
    hand.wait(300)
    simple.Render(view)
    middle = [side // 2 for side in view.ViewSize]
    assert brainshift.pick(shown, view, *middle), "the head is in the middle"
    click(view, middle)
    assert "is no reference" in request() and fit() is None, request()
    with window.unrecorded():
        simple.Hide(head, view)
        for other in others:
            simple.Show(other, view)
        simple.SetActiveSource(scene["bent"])
        simple.Render(view)
    hand.wait(300)
    hand.tap(hand.ESCAPE)
    hand.wait(50)


def place_under_a_click_in_3d():
    """The first hit under a pixel of the 3D view, and the crosshair goes there."""
    hand.click("BrainShiftPickPairs")
    view = scene["views"]["volume"]
    simple.Render(view)
    width, height = view.ViewSize
    display = simple.GetDisplayProperties(scene["compare"], view)
    hit = brainshift.pick(display, view, width // 2, height // 2)
    assert hit, "the head is in the middle"
    click(view, [width // 2, height // 2])
    assert "click the same position" in request(), request()
    assert numpy.allclose(slice_position(), hit, atol=0.1), (slice_position(), hit)
    click_at("sagittal", numpy.array(hit) + SHIFT)
    wait_for(lambda: len(pairs()) == 1, "the pair")
    assert numpy.allclose(pairs()[0, :3], hit, atol=0.1)
    assert window.undo_labels()[0] == "Add Landmark Pair", window.undo_labels()
    window.action("Undo")
    hand.wait(200)
    assert fit() is None and not rows(), "undo takes the fit away, too"


def clicks_make_pairs():
    for i, place in enumerate(PLACES):
        rest = scene["middle"] + place
        measured = rest + SHIFT + (ERROR if i == SPOILED else 0.0)
        name = ("axial", "coronal", "sagittal")[i % 3]
        before = pairs()
        half = click_at(name, rest)
        assert len(pairs()) == len(before)
        click_at(name, measured)
        wait_for(lambda: len(pairs()) == i + 1, f"pair {i + 1}")
        found = pairs()[i]
        # A click means its pixel's middle. The lattice bends by less than a millimetre.
        assert numpy.abs(found[3:6] - measured).max() <= 2.2 * half, (found, measured, half)
        assert numpy.abs(found[:3] - rest).max() <= 2.2 * half + 1.0, (found, rest, half)
        assert found[6] == 1.0
        assert window.undo_labels()[0] == "Add Landmark Pair"
    hand.click("BrainShiftPickPairs")
    assert "Landmark" not in request()
    wait_for(lambda: len(rows()) == len(PLACES), "the rows")
    assert not hand.is_visible("BrainShiftPulls"), "a list without pulls and pins"


def text_of(value):
    return f"{value:.2f}" if math.isfinite(value) else "\u2013"


def table_shows_the_filters_numbers():
    hand.wait(200)
    residuals, left_out, shown = told("LandmarkResiduals"), told("LeaveOneOut"), rows()
    assert len(shown) == len(residuals) == len(left_out) == len(pairs()), (shown, residuals)
    for i, row in enumerate(shown):
        texts = [str(i + 1), text_of(residuals[i]), text_of(left_out[i])]
        assert row[3] == texts, (row, texts)
    on = [i for i, row in enumerate(shown) if row[0]]
    figures = hand.label("BrainShiftLandmarkFigures")
    assert f"<b>{left_out[on].mean():.2f} mm</b>" in figures, (figures, left_out)
    matrix = told("Rigid").reshape(4, 4)
    turn = numpy.degrees(numpy.arccos(numpy.clip((numpy.trace(matrix[:3, :3]) - 1) / 2, -1, 1)))
    middle = pairs()[on][:, :3].mean(axis=0)
    shift = numpy.linalg.norm(matrix[:3, :3] @ middle + matrix[:3, 3] - middle)
    assert f"<b>{shift:.1f} mm, {turn:.1f}\u00b0</b>" in figures, (figures, shift, turn)
    worst = max(on, key=lambda i: left_out[i])
    assert [row[1] for row in shown] == [i == worst for i in range(len(shown))], "one is bold"
    assert [row[2] for row in shown] == [i == worst for i in range(len(shown))], "with a sign"
    assert f"Landmark <b>{worst + 1}</b> fits worst" in figures, figures
    return worst, left_out


def worst_is_the_spoiled_one_and_a_tick_disables_it():
    worst, before = table_shows_the_filters_numbers()
    assert worst == SPOILED and before[SPOILED] > 5.0, before
    assert hand.click_cell(TABLE, SPOILED, check=True)
    wait_for(lambda: pairs()[SPOILED, 6] == 0.0, "the switch")
    wait_for(lambda: rows()[SPOILED][0] is False, "the tick")
    worst, after = table_shows_the_filters_numbers()
    assert worst != SPOILED and math.isnan(told("LandmarkResiduals")[SPOILED])
    others = [i for i in range(len(PLACES)) if i != SPOILED]
    assert after[others].mean() < 0.5 * before[others].mean(), (before, after)
    assert abs(after[SPOILED] - numpy.linalg.norm(ERROR)) < 2.0, "it is missed by its error"
    assert window.undo_labels()[0] == "Disable Landmarks", window.undo_labels()
    window.action("Undo")
    wait_for(lambda: rows()[SPOILED][0] is True, "the tick after undo")
    assert table_shows_the_filters_numbers()[0] == SPOILED
    window.action("Redo")
    wait_for(lambda: rows()[SPOILED][0] is False, "the tick after redo")
    table_shows_the_filters_numbers()


def marks_in(name):
    shown = scene["views"][name].SMProxy.GetClientSideObject().GetNonCompositedRenderer()
    for prop in shown.GetViewProps():
        if prop.GetClassName() == "vtkLandmarkMarks":
            return [line.split(": ")[1] for line in str(prop).splitlines()
                    if line.strip().startswith("Mark ")]
    return []


def marks_stand_in_the_views():
    assert hand.click_cell(TABLE, 3, column=1)
    hand.wait(50)
    assert hand.click("BrainShiftGoTo")
    drawn = brainshift.deformed_from_rest(scene["bent"], pairs()[[3], :3])[0]
    wait_for(lambda: numpy.allclose(slice_position(), drawn, atol=0.01), "the crosshair")
    for view in scene["views"].values():
        simple.Render(view)
    everywhere = marks_in("volume")
    assert [mark.split()[0] for mark in everywhere] == [str(i + 1) for i in range(6)], everywhere
    assert all("ring" in mark and "cross" in mark for mark in everywhere), everywhere
    assert "off" in everywhere[SPOILED] and sum("worst" in mark for mark in everywhere) == 1
    near = marks_in("axial")
    for i, mark in enumerate(near):
        place = brainshift.deformed_from_rest(scene["bent"], pairs()[[i], :3])[0]
        assert ("ring" in mark) == (abs(place[2] - drawn[2]) <= 2.5), (mark, place, drawn)
        assert ("cross" in mark) == (abs(pairs()[i, 5] - drawn[2]) <= 2.5), (mark, pairs()[i])
    assert hand.click("BrainShiftLandmarkMarks")
    wait_for(lambda: not marks_in("volume"), "no marks")
    assert hand.click("BrainShiftLandmarkMarks")
    wait_for(lambda: len(marks_in("volume")) == 6, "the marks again")


def white_of_marks(view):
    """How much the marks' letters brighten the picture, in white pixels."""
    shown = []
    for _ in range(2):
        shown.append(picture(view).min(axis=2))  # rings and crosses lack a colour
        assert hand.click("BrainShiftLandmarkMarks")
        hand.wait(300)
    return (shown[0] - shown[1]).clip(0.0).sum()


def letters_are_as_large_to_the_eye_at_200_percent():
    view = scene["views"]["volume"]
    dots, found = view.GetRenderWindow().GetDPI(), []
    for factor in (1, 2):
        view.GetRenderWindow().SetDPI(factor * dots)
        found.append(white_of_marks(view))
    view.GetRenderWindow().SetDPI(dots)
    assert 2.5 < found[1] / found[0] < 6.0, found  # 4: twice as high and wide


def delete_is_one_step():
    assert hand.click_cell(TABLE, 5, column=1)
    hand.wait(50)
    assert hand.click("BrainShiftLandmarkDelete")
    wait_for(lambda: len(rows()) == 5 and len(pairs()) == 5, "the row to go")
    assert window.undo_labels()[0] == "Delete Landmark Pairs"
    table_shows_the_filters_numbers()
    window.action("Undo")
    wait_for(lambda: len(rows()) == 6, "the row to come back")
    table_shows_the_filters_numbers()


def listed(name, positions, labels):
    """A file of landmarks, opened."""
    with open(scratch(name), "w", encoding="utf-8") as file:
        file.write("x,y,z,label\n")
        for position, label in zip(positions, labels):
            file.write(",".join([*map(repr, map(float, position)), label]) + "\n")
    return simple.LandmarkReader(FileName=scratch(name))


def lists_are_paired_by_order_on_request():
    """Two lists without a common name are refused; the panel says why and offers their order."""
    places = scene["middle"] + PLACES
    names = [[f"{letter}{i}" for i in range(len(places))] for letter in "ab"]
    before = scene["bent"].Lattice
    with window.unrecorded():
        by_lists = simple.FitDeformation(
            Input=simple.FindSource("seg3d_mr_t1.nii.gz") or scene["bent"].Input,
            RestLandmarks=listed("rest.csv", places, names[0]),
            MeasuredLandmarks=listed("measured.csv", places + SHIFT, names[1]))
        scene["bent"].Lattice = by_lists
    simple.SetActiveSource(by_lists)
    wait_for(lambda: "No name" in hand.label("BrainShiftLandmarkProblem"), "the reason")
    reason = hand.label("BrainShiftLandmarkProblem")
    assert "No name is on both lists" in reason and "Pair By Order" in reason, reason
    assert not rows(), rows()
    assert hand.click("PairByOrder")
    hand.wait(100)
    assert hand.click("Accept")
    wait_for(lambda: len(rows()) == len(places), "the pairs")
    assert not hand.label("BrainShiftLandmarkProblem")
    assert by_lists.PairByOrder == 1
    assert told("LandmarkResiduals").max() < 1.0, told("LandmarkResiduals")
    with window.unrecorded():
        scene["bent"].Lattice = before
        simple.Delete(by_lists)
    simple.SetActiveSource(scene["bent"])
    wait_for(lambda: hand.is_visible("BrainShiftPickPairs") and not rows(), "none")
    hand.close_messages()


def a_state_keeps_the_pairs():
    before, left_out = pairs(), told("LeaveOneOut")
    simple.SaveState(scratch("LandmarksByHand.pvsm"))
    for name in ("compare", "bent"):
        lattice = scene["bent"].Lattice if name == "bent" else None
        simple.Delete(scene[name])
        if lattice:
            simple.Delete(lattice)
    hand.wait(200)
    simple.LoadState(scratch("LandmarksByHand.pvsm"))
    hand.wait(500)
    scene["bent"], scene["compare"] = simple.FindSource("bent"), simple.FindSource("compare")
    simple.SetActiveSource(scene["bent"])
    simple.Render()
    wait_for(lambda: len(rows()) == 6, "the rows")
    assert numpy.allclose(pairs(), before)
    assert numpy.allclose(told("LeaveOneOut"), left_out, atol=1e-6)
    assert rows()[SPOILED][0] is False
    table_shows_the_filters_numbers()


window.main("LandmarksByHand", [
    (set_up,), (lists_are_paired_by_order_on_request,), (half_a_pair_never_reaches_the_fit,),
    (drags_are_the_cameras_while_picking,), (as_loaded_is_no_reference,),
    (before_align_is_no_reference,), (place_under_a_click_in_3d,), (clicks_make_pairs,),
    (table_shows_the_filters_numbers,), (worst_is_the_spoiled_one_and_a_tick_disables_it,),
    (marks_stand_in_the_views,), (letters_are_as_large_to_the_eye_at_200_percent,),
    (delete_is_one_step,), (a_state_keeps_the_pairs,)])
