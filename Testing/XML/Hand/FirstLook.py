# SPDX-License-Identifier: BSD-3-Clause
"""Proves what the window shows of a volume at once: no background, tissue that fills the view,
natural colours. Filters of a volume share its colours, a stranger with an array of the same name
does not, and a user's colours stay. A second volume is in sight. Buttons of looks act at once and
can be undone. They follow the array that colours the volume, and a stroke reads no volume for them.
A mask covers nothing. A constant volume is no mask.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import os

import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift.reports import report_on
from brainshift_testing import picture, volume
from paraview import simple

HEAD = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")
MASK = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_brainmask.nii.gz")


def begin():
    """A lone view at ParaView's own place, and nothing in it."""
    hand.take(hand.NONE)
    for source in list(simple.GetSources().values()):
        simple.Delete(source)
    view = simple.GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 0
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 1], [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    hand.wait(100)
    return view


def open_file(path, view):
    """As Apply does: ParaView shows it in the way that the reader asks for."""
    reader = simple.OpenDataFile(path)
    display = simple.Show(reader, view)
    simple.SetActiveSource(reader)
    simple.ResetCamera(view)
    hand.wait(300)
    return reader, display


def opacities(display):
    points = display.ScalarOpacityFunction.Points
    return dict(zip(points[0::4], points[1::4]))


def seen(view):
    """Which pixels show tissue: those that differ from the picture's left edge in their row."""
    pixels = picture(view)
    background = pixels[:, :2].mean(axis=1, keepdims=True)
    return numpy.abs(pixels - background).sum(axis=2) > 0.1


def a_head_is_seen_at_once():
    view = begin()
    reader, display = open_file(HEAD, view)
    assert display.Representation == "Deformed Volume", display.Representation
    assert display.Shade == 1
    values = opacities(display)
    assert values[min(values)] == 0.0 and values[max(values)] == 1.0, values
    tissue = seen(view)
    height, width = tissue.shape
    rows, columns = tissue.any(axis=1).sum() / height, tissue.any(axis=0).sum() / width
    assert 0.85 < max(rows, columns) < 0.97, (
        rows, columns, list(view.CameraPosition), list(view.CameraFocalPoint), tissue.shape)
    assert not tissue[[0, -1]].any() and not tissue[:, [0, -1]].any(), "an edge cuts the head"
    assert tissue[height // 2 - 5:height // 2 + 5, width // 2 - 5:width // 2 + 5].all()
    red, green, blue = picture(view)[tissue].mean(axis=0)
    assert red > green > blue, "skin is warm"
    return view, reader, display


def ball_at(x):
    """A volume of 20 mm like a CT, at a distance along x (mm)."""
    k, j, i = numpy.mgrid[:20, :20, :20]
    radius = numpy.sqrt((i - 9.5) ** 2 + (j - 9.5) ** 2 + (k - 9.5) ** 2)
    noise = numpy.random.default_rng(2).normal(0.0, 10.0, radius.shape)
    ct = numpy.where(radius < 8, numpy.where(radius < 6, 40.0, 800.0), -1000.0) + noise
    return volume(ct, origin=(x, 0.0, 500.0))


def show(source, view):
    display = simple.Show(source, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Volume")
    hand.wait(500)
    return display


def in_sight(view, source):
    """Whether all corners of a volume are in the picture."""
    bounds = source.GetDataInformation().GetBounds()
    width, height = view.ViewSize
    corners = [(x, y, z) for x in bounds[:2] for y in bounds[2:4] for z in bounds[4:]]
    pixels = [window.pixel_of(view, corner) for corner in corners]
    return all(0 <= x < width and 0 <= y < height for x, y in pixels)


def camera(view):
    return [list(view.CameraPosition), list(view.CameraFocalPoint), list(view.CameraViewUp)]


def a_second_volume_is_in_sight():
    """The camera takes in a second volume; if the user moved it, only where it would not be seen,
    and then it keeps its direction."""
    view, reader, _ = a_head_is_seen_at_once()
    first = camera(view)
    far = ball_at(800.0)
    show(far, view)
    window.until(lambda: camera(view) != first, "the camera takes in a second volume")
    assert in_sight(view, far), camera(view)
    tissue = seen(view)
    assert not tissue[[0, -1]].any() and not tissue[:, [0, -1]].any(), "an edge cuts a volume"
    hand.drag([50, 50], [90, 60])  # the user turns it
    hand.wait(200)
    turned = camera(view)
    middle = sum(reader.GetDataInformation().GetBounds()[:2]) / 2
    near = ball_at(middle)
    show(near, view)
    assert camera(view) == turned, "it is in sight already"
    farther = ball_at(4000.0)
    show(farther, view)
    window.until(lambda: camera(view) != turned, "the camera takes in a third volume")
    assert in_sight(view, farther)
    ahead = [numpy.subtract(focus, eye) for eye, focus, _ in (turned, camera(view))]
    cosine = ahead[0] @ ahead[1] / numpy.linalg.norm(ahead[0]) / numpy.linalg.norm(ahead[1])
    assert cosine > 0.9999, (turned, camera(view))
    for source in (far, near, farther):
        simple.Delete(source)


def a_filter_shares_the_look():
    view, reader, display = a_head_is_seen_at_once()
    camera = list(view.CameraPosition)
    bent = simple.FreeFormDeformation(registrationName="bent", Input=reader)
    simple.Hide(reader, view)
    of_bent = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    hand.wait(300)
    assert of_bent.Representation == "Deformed Volume"
    assert of_bent.LookupTable == display.LookupTable
    assert list(view.CameraPosition) == camera
    assert 0.0 in opacities(of_bent).values()


def a_users_colours_stay():
    view, _, display = a_head_is_seen_at_once()
    display.LookupTable.ApplyPreset("Black-Body Radiation", True)
    chosen = list(display.LookupTable.RGBPoints)
    display.SetRepresentationType("Outline")
    hand.wait(100)
    display.SetRepresentationType("Deformed Volume")
    hand.wait(100)
    assert list(display.LookupTable.RGBPoints) == chosen
    view.CameraPosition = [300.0, 0.0, 0.0]
    turned = list(view.CameraPosition)
    simple.Show(simple.FreeFormDeformation(Input=display.Input), view)
    hand.wait(300)
    assert list(view.CameraPosition) == turned, "the camera was turned by hand"


def a_stranger_gets_colours_of_its_own():
    view, _, display = a_head_is_seen_at_once()
    before = list(display.LookupTable.RGBPoints)
    other = simple.Show(simple.FreeFormDeformation(Input=ball_at(0.0)), view)
    hand.wait(300)
    assert other.LookupTable != display.LookupTable
    assert list(display.LookupTable.RGBPoints) == before
    assert {0.0, 1.0} <= set(opacities(other).values())
    assert opacities(other).get(300.0) == 1.0, "bone"


def a_mask_covers_nothing():
    view, _, display = a_head_is_seen_at_once()
    before = list(display.LookupTable.RGBPoints)
    mask, of_mask = open_file(MASK, view)
    assert of_mask.Representation == "Outline", of_mask.Representation
    assert list(display.LookupTable.RGBPoints) == before
    simple.Delete(mask)


def a_constant_volume_is_shown():
    """It is no label map, so it does not become an outline beside another volume."""
    view, _, display = a_head_is_seen_at_once()
    before = list(display.LookupTable.RGBPoints)
    flat = volume(numpy.full((20, 20, 20), 7.0))
    of_flat = simple.Show(flat, view)
    of_flat.SetRepresentationType("Deformed Volume")
    hand.wait(300)
    assert of_flat.Representation == "Deformed Volume", of_flat.Representation
    assert list(display.LookupTable.RGBPoints) == before
    simple.Delete(flat)


def buttons_choose_a_look():
    view, reader, _ = a_head_is_seen_at_once()
    mask = simple.OpenDataFile(MASK)
    bent = simple.FreeFormDeformation(registrationName="bent", Input=reader, Segmentation=mask)
    simple.Hide(reader, view)
    display = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    hand.wait(300)
    skin, whole = list(display.LookupTable.RGBPoints), seen(view).sum()
    assert hand.click("Brain")
    hand.wait(100)
    assert display.DrawSegment == 1
    assert list(display.LookupTable.RGBPoints) != skin
    assert seen(view).sum() < 0.8 * whole, "the brain is smaller than the head"
    assert window.undo_labels()[0] == "Look: Brain", window.undo_labels()
    window.action("Undo")
    assert display.DrawSegment == 0
    assert list(display.LookupTable.RGBPoints) == skin
    window.action("Redo")
    assert display.DrawSegment == 1
    assert hand.click("See-through")
    hand.wait(100)
    assert display.DrawSegment == 0 and 1.0 not in opacities(display).values()


def the_next_volume_looks_as_the_last_choice():
    view = begin()
    _, display = open_file(HEAD, view)
    assert 1.0 not in opacities(display).values(), "See-through was chosen"
    assert hand.click("Skin")  # for the other steps


def buttons_follow_the_array():
    """A volume with two arrays has the looks of the one that colours it."""
    view = begin()
    both = simple.Calculator(Input=ball_at(0.0), ResultArrayName="MR",
                             Function="abs(Intensity - 300) + 50")
    bent = simple.FreeFormDeformation(registrationName="bent", Input=both)
    display = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    for array, has, lacks in (("Intensity", "Bone", "See-through"),
                              ("MR", "See-through", "Bone"), ("Intensity", "Bone", "See-through")):
        simple.ColorBy(display, ("POINTS", array))
        hand.wait(300)
        assert hand.label(has) and not hand.label(lacks), (array, hand.label(has))


def readings(source):
    """How often a volume was read for a look so far."""
    report = report_on(source.SMProxy, 0, 0, "")
    report.UpdatePropertyInformation()
    return report.GetProperty("Readings").GetElement(0)


def a_stroke_reads_nothing():
    view, reader, _ = a_head_is_seen_at_once()
    bent = simple.FreeFormDeformation(registrationName="bent", Input=reader)
    simple.Hide(reader, view)
    display = simple.Show(bent, view)
    simple.SetActiveSource(bent)
    hand.wait(300)
    assert hand.click("Skin"), "the panel offers looks"
    hand.wait(100)
    before = readings(bent)
    assert before > 0
    hand.take(hand.STAMP)
    for strokes in (1, 2, 3):
        hand.wheel([side // 2 for side in view.ViewSize], 2)
        window.settle("Stamp: pull")
        assert len(window.strokes()) == 2 * strokes - 1
        corner = display.Input.GetDataInformation().GetBounds()[::2]
        bent.Strokes = [*bent.Strokes, *brainshift.soft(corner, (0.0, 1.0, 0.0), 20.0)]
        simple.Render(view)
        hand.wait(300)
    hand.take(hand.NONE)
    assert readings(bent) == before, (before, readings(bent))
    assert hand.click("Skin")
    assert readings(bent) == before + 1, "what reads is counted"


def play():
    yield (a_head_is_seen_at_once,)
    yield (a_second_volume_is_in_sight,)
    yield (a_filter_shares_the_look,)
    yield (a_stranger_gets_colours_of_its_own,)
    yield (a_mask_covers_nothing,)
    yield (a_constant_volume_is_shown,)
    yield (buttons_follow_the_array,)
    yield (a_stroke_reads_nothing,)
    yield (buttons_choose_a_look,)
    yield (the_next_volume_looks_as_the_last_choice,)
    yield (a_users_colours_stay,)  # for good


if __name__ == "__main__":
    window.main("FirstLook", play())
