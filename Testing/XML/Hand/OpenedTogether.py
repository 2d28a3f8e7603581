# SPDX-License-Identifier: BSD-3-Clause
"""Proves what the window shows of a head and its brain mask that were opened together, the mask
first: the camera turns to the head, and no scale of colours is shown. A filter keeps the head's
colours. One click on Brain shows the brain by the open mask. One undo takes that back. Of three
heads that are opened at once, beside each other, the camera sees all.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""

import os

import head_files
import nibabel
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import picture, scratch
from paraview import simple

HEAD = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_mr_t1.nii.gz")
MASK = os.path.join(os.environ["BRAINSHIFT_TEST_DATA"], "seg3d-utah", "seg3d_brainmask.nii.gz")


MOST_WAITS = 200  # of 100 ms; what takes longer never comes


def comes(condition):
    """Whether a condition comes true."""
    for _ in range(MOST_WAITS):
        if condition():
            return True
        hand.wait(100)
    return False


def scales_of_colours():
    return [part for part in Opened.view.Representations
            if part.GetXMLName() == "ScalarBarWidgetRepresentation" and part.Visibility]


class Opened:
    """What the steps share."""


def an_empty_view():
    hand.take(hand.NONE)
    for source in list(simple.GetSources().values())[::-1]:
        simple.Delete(source)
    view = Opened.view = simple.GetActiveViewOrCreate("RenderView")
    view.CameraPosition, view.CameraFocalPoint = [0, 0, 1], [0, 0, 0]
    view.CameraViewUp = [0, 1, 0]
    return view


def opens_both():
    view = an_empty_view()
    hand.open_file(MASK)
    Opened.mask = simple.GetActiveSource()
    hand.open_file(HEAD)
    Opened.head = simple.GetActiveSource()
    hand.wait(300)
    assert hand.click("Accept")
    hand.wait(500)
    Opened.of_mask = simple.GetDisplayProperties(Opened.mask, view)
    Opened.of_head = simple.GetDisplayProperties(Opened.head, view)


def the_camera_turns_to_the_head():
    opens_both()
    assert Opened.of_mask.Representation == "Outline"
    assert Opened.of_head.Representation == "Deformed Volume"
    assert comes(lambda: list(Opened.view.CameraViewUp) == [0, 0, 1])
    assert not scales_of_colours(), "skin needs none"


def a_filter_keeps_the_heads_colours():
    hand.create_filter("FreeFormDeformation")
    hand.wait(300)
    assert hand.click("Accept")
    assert comes(lambda: simple.GetActiveSource() != Opened.head)
    hand.wait(500)
    Opened.bent = simple.GetActiveSource()
    display = Opened.of_bent = simple.GetDisplayProperties(Opened.bent, Opened.view)
    assert Opened.bent.Input == Opened.head
    assert Opened.of_head.LookupTable != Opened.of_mask.LookupTable
    assert comes(lambda: display.LookupTable == Opened.of_head.LookupTable)
    assert display.ScalarOpacityFunction == Opened.of_head.ScalarOpacityFunction
    assert not display.IsScalarBarVisible(Opened.view.SMProxy)
    assert Opened.of_mask.Visibility == 1


def one_click_shows_the_brain():
    assert comes(lambda: hand.click("Brain"))
    hand.wait(300)
    assert Opened.bent.Segmentation == Opened.mask
    assert Opened.of_bent.DrawSegment == 1
    assert Opened.of_mask.Visibility == 0, "its outline is in the way"
    assert window.undo_labels()[0] == "Look: Brain", window.undo_labels()


def one_undo_takes_it_back():
    window.action("Undo")
    hand.wait(300)
    assert Opened.bent.Segmentation is None
    assert Opened.of_bent.DrawSegment == 0
    assert Opened.of_mask.Visibility == 1
    assert hand.click("Skin")  # for the next start


def three_at_once_are_seen():
    view = an_empty_view()
    view.OrientationAxesVisibility = 0
    voxels, affine = head_files.head()
    for number, right in enumerate((0.0, 350.0, -350.0)):
        moved = affine.copy()
        moved[0, 3] += right
        name = scratch(f"head{number}.nii")
        nibabel.save(nibabel.Nifti1Image(voxels, moved), name)
        hand.open_file(name)
    hand.wait(300)
    assert hand.click("Accept")
    heads = list(simple.GetSources().values())
    assert len(heads) == 3, heads
    window.until(lambda: list(view.CameraViewUp) == [0, 0, 1], "the camera turns")
    hand.wait(1000)
    pixels = picture(view)
    tissue = numpy.abs(pixels - pixels[:, :2].mean(axis=1, keepdims=True)).sum(axis=2) > 0.1
    assert not tissue[[0, -1]].any() and not tissue[:, [0, -1]].any(), "an edge cuts a head"
    size = (tissue.any(axis=0).mean(), tissue.any(axis=1).mean())
    hand.save_picture(scratch("three.png"))
    assert 0.6 < max(size) < 0.97, size  # far points of three heads are seldom at the edges
    for head in heads:
        bounds = head.GetDataInformation().GetBounds()
        x, y = window.pixel_of(view, [sum(bounds[i:i + 2]) / 2 for i in (0, 2, 4)])
        assert tissue[y, x], (list(bounds), x, y, list(view.CameraPosition))


def play():
    yield (the_camera_turns_to_the_head,)
    yield (a_filter_keeps_the_heads_colours,)
    yield (one_click_shows_the_brain,)
    yield (one_undo_takes_it_back,)
    yield (three_at_once_are_seen,)


if __name__ == "__main__":
    window.main("OpenedTogether", play())
