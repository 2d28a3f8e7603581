# SPDX-License-Identifier: BSD-3-Clause
"""Proves that one click shows how far a fit can be believed: the fit's evidence is switched on, the
picture has its tints, the legend is there in slices and in 3D, and the status line says the number
under the cursor; that another click takes tints and legend away; and that undo takes back the click
and what it switched on; and that Four Views shows it in all views.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import re

import brainshift
import evidence_testing
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import picture
from paraview import simple

MIDDLE = evidence_testing.MIDDLE
scene = {}


def set_up():
    bent, fit = evidence_testing.pulled()
    fit.filter.Evidence = 0
    view = simple.GetActiveViewOrCreate("RenderView")
    display = simple.Show(bent, view, "UniformGridRepresentation")
    display.SetRepresentationType("Deformed Slices")
    simple.ColorBy(display, ("POINTS", "Intensity"))
    display.ShowSagittal = display.ShowCoronal = 0
    simple.GetColorTransferFunction("Intensity").RGBPoints = [0, 0, 0, 0, 50, 1, 1, 1]
    display.SetScalarBarVisibility(view, False)
    view.ResetActiveCameraToNegativeZ()
    simple.ResetCamera(view)
    simple.SetActiveSource(bent)
    simple.Render(view)
    hand.wait(500)
    scene.update(bent=bent, fit=fit, view=view, display=display)


def corner(shown):
    """Where the legend is."""
    height, width, _ = shown.shape
    return shown[-110:, -200:]


def tinted(shown):
    """How many pixels have a colour, outside the legend."""
    low = shown[:shown.shape[0] // 2]
    return int((low.max(axis=2) - low.min(axis=2) > 0.1).sum())


def one_click():
    before = picture(scene["view"])
    assert scene["fit"].filter.Evidence == 0
    assert hand.click("ShowEvidence")
    hand.wait(300)
    assert scene["display"].ShowEvidence == 1 and scene["fit"].filter.Evidence == 1
    shown = picture(scene["view"])
    assert tinted(shown) > tinted(before) + 1000, (tinted(shown), tinted(before))
    assert (corner(shown) != corner(before)).any(), "no legend"
    scene.update(before=before, shown=shown)


def words_under_the_cursor():
    width, height = scene["view"].ViewSize
    pixel = [width // 2 - 11, height // 2 - 13]
    for _ in range(20):
        hand.hover([pixel[0] + 1, pixel[1]])
        hand.wait(100)
        hand.hover(pixel)
        hand.wait(250)
        text = hand.label("BrainShiftCursor")
        if "uncertainty" in text:
            break
    place = brainshift.pick(scene["display"], scene["view"], *pixel)
    rest = brainshift.rest_from_deformed(scene["bent"], numpy.array([place]))
    asked = evidence_testing.deviation_by_hand(scene["bent"], scene["fit"], rest)[0]
    if asked >= 4.0:
        assert "uncertainty: 4 mm or more" in text, (text, asked)
        return
    one, ball = map(float, re.search(r"\u00b1 ([\d.]+) mm \(95 %: ([\d.]+) mm\)", text).groups())
    assert abs(one - asked) < 0.06 and abs(ball - 2.795 * asked) < 0.06, (text, asked)


def another_click():
    assert hand.click("ShowEvidence")
    hand.wait(300)
    off = picture(scene["view"])
    assert scene["display"].ShowEvidence == 0
    assert (off == scene["before"]).all(), "tints or legend are left"
    scene["display"].ShowEvidence = 1


def both():
    return int(scene["display"].ShowEvidence), int(scene["fit"].filter.Evidence)


def undo_of_both():
    window.action("Undo")
    hand.wait(200)
    assert both() == (0, 0), (both(), window.undo_labels())
    window.action("Redo")
    hand.wait(200)
    assert both() == (1, 1), both()


def legend_in_3d():
    scene["display"].SetRepresentationType("Deformed Volume")
    simple.Render(scene["view"])
    shown = corner(picture(scene["view"]))
    scene["display"].ShowEvidence = 0
    assert (corner(picture(scene["view"])) != shown).any()


def four_views_show_it():
    """Four Views takes over the evidence that the view shows."""
    scene["display"].ShowEvidence = 1
    simple.SetActiveSource(scene["bent"])
    hand.wait(100)
    assert hand.action("actionBrainShiftFourViews")
    hand.wait(500)
    views = simple.GetRenderViews()
    assert len(views) == 4
    for view in views:
        display = simple.GetDisplayProperties(scene["bent"], view)
        assert display.ShowEvidence == 1, view
        with window.unrecorded():
            display.LookupTable.RGBPoints = [0, 0, 0, 0, 50, 1, 1, 1]  # tints need some light
            shown = picture(view)
            display.ShowEvidence = 0
            without = picture(view)
        assert (corner(shown) != corner(without)).any(), "no legend"
        flat = view.InteractionMode == "2D"
        assert not flat or tinted(shown) > tinted(without) + 300, (tinted(shown), tinted(without))


window.main("EvidenceByHand", [(set_up,), (one_click,), (undo_of_both,),
                               (words_under_the_cursor,), (another_click,), (legend_in_3d,),
                               (four_views_show_it,)])
