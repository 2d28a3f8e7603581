# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel of a Free-Form Deformation is not cut off at the right in windows of usual
sizes, with each tool; that Strength, the numbers of the tool in hand and its drawing are seen
without scrolling; that labels say units; that the filter stays selected when its mask comes and
goes; that Reset All leaves the keyboard where it was; that the status line tells when a view shows
another volume than the one that the tool in hand works on, and one click switches to it without a
stroke; that warnings stand in the status line and errors open Output Messages; and that a
Deformation Field leaves the volume visible.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import test_hand as hand
import window_testing as window
from paraview import servermanager, simple

CENTRE = (0.0, 0.0, 0.0)
STROKES = (brainshift.stamp((8.0, 0.0, 0.0), CENTRE, -123.4, major=80.0, minor=40.0) +
           brainshift.soft((0.0, 4.0, 0.0), (0.0, 1.0, 0.0), 60.0))


def begin():
    simple.Wavelet()
    window.bend()


def fits(width, height):
    """In a window of this size."""
    hand.resize_window(width, height)
    window.deformation().Strokes = STROKES
    for tool in (hand.NONE, hand.MOVE, hand.SOFT, hand.STAMP):
        hand.take(tool)
        hand.wait(300)
        assert hand.cut_off() == 0, (width, height, tool, hand.cut_off())


def is_seen_at_once(width, height):
    """The tools' numbers and what they draw, and Strength, in a window of this size."""
    hand.resize_window(width, height)
    for tool, numbers in ((hand.SOFT, ("Radius", "Sigma")),
                          (hand.STAMP, ("MajorRadius", "MinorRadius", "Sigma",
                                        "MillimetresPerClick"))):
        hand.take(tool)
        hand.wait(300)
        for part in ("Strength", *numbers):
            assert hand.in_sight(f"BrainShift{part}Row"), (width, height, tool, part)
        assert hand.in_sight("BrainShiftReach"), (width, height, tool)
    hand.take(hand.NONE)


def labels_say_units():
    assert hand.label("FeatherLabel") == "<p>Feather (mm)</p>", hand.label("FeatherLabel")
    assert "(points)" in hand.label("LatticeDimensionsLabel")
    assert "Feather" in window.deformation().ListProperties(), "Python's names are as they were"


def selected():
    model = servermanager.ProxyManager().SMProxyManager.GetSelectionModel("ActiveSources")
    proxies = [model.GetSelectedProxy(i) for i in range(model.GetNumberOfSelectedProxies())]
    return [proxy.GetXMLName() for proxy in proxies]


def stays_selected():
    bent = window.deformation()
    mask = simple.Wavelet(registrationName="mask")
    simple.SetActiveSource(bent)
    hand.wait()
    for masked_by in (mask, None, mask):
        bent.Mask = masked_by
        hand.wait()
        assert selected() == ["FreeFormDeformation"], (masked_by, selected())


def other_stays_selected():
    """What else is selected when the mask changes is left alone."""
    simple.SetActiveSource(simple.FindSource("mask"))
    window.deformation().Mask = None
    hand.wait()
    assert selected() == ["RTAnalyticSource"], selected()
    simple.SetActiveSource(window.deformation())
    hand.wait(100)


def keeps_the_keyboard():
    window.deformation().Strokes = STROKES
    hand.wait(300)
    assert hand.keeps_focus("BrainShiftReset")
    assert not window.strokes()


def middle():
    return [side // 2 for side in simple.GetActiveView().ViewSize]


def show_another_volume():
    """The view shows "other", while "bent" is selected."""
    bent, view = window.deformation(), simple.GetActiveView()
    other = simple.FreeFormDeformation(registrationName="other", Input=simple.Wavelet())
    simple.SetActiveSource(bent)
    simple.Show(other, view)
    simple.Hide(bent, view)
    simple.Render(view)
    hand.wait(200)


def assert_works_on(name):
    """The tool in hand, under the cursor."""
    assert simple.GetActiveSource() == simple.FindSource(name)
    line = hand.label("BrainShiftStatus")
    assert line.startswith("Stamp"), line
    assert ("work on other" in line) == (name == "bent"), line


def select_bent():
    simple.SetActiveSource(window.deformation())
    hand.wait(200)
    hand.hover(middle())
    hand.wait(200)
    assert_works_on("bent")


def switches_by_button():
    hand.take(hand.STAMP)
    select_bent()
    assert hand.is_visible("BrainShiftSwitchVolume")
    assert hand.click("BrainShiftSwitchVolume")
    hand.wait(200)
    assert_works_on("other")
    assert not hand.is_visible("BrainShiftSwitchVolume")


def all_strokes():
    return [list(simple.FindSource(name).Strokes) for name in ("bent", "other")]


def switches_by_click():
    """A click only: a drag is the camera's, and neither makes a stroke."""
    view, before = simple.GetActiveView(), all_strokes()
    for tool in (hand.STAMP, hand.SOFT, hand.MOVE):
        hand.take(hand.STAMP)
        select_bent()
        hand.take(tool)
        camera = list(view.GetActiveCamera().GetPosition())
        hand.drag(middle(), [side + 40 for side in middle()])
        assert list(view.GetActiveCamera().GetPosition()) != camera, "the drag is the camera's"
        assert simple.GetActiveSource() == window.deformation(), tool
        hand.press(middle())
        hand.release([middle()[0] + 1, middle()[1]])
        hand.wait(200)
        assert simple.GetActiveSource() == simple.FindSource("other"), tool
        hand.take(hand.STAMP)
        hand.wait(100)
        assert_works_on("other")
        assert all_strokes() == before, tool
    # Now the wheel bends what is seen, and a click there switches nothing.
    hand.wheel(middle(), 1)
    window.settle("Stamp: pull")
    assert all_strokes()[0] == before[0] and len(all_strokes()[1]) == window.NUMBERS
    hand.press(middle())
    hand.release(middle())
    hand.wait(200)
    assert_works_on("other")


def both_are_shown():
    bent, view = window.deformation(), simple.GetActiveView()
    simple.Show(bent, view)
    simple.SetActiveSource(bent)
    hand.wait(200)
    hand.hover(middle())
    hand.wait(200)
    assert "work on other" not in hand.label("BrainShiftStatus"), "both are shown"


def field_leaves_the_volume():
    """At Apply, as in the window."""
    simple.Delete(simple.FindSource("other"))
    hand.take(hand.NONE)
    bent, view = window.deformation(), simple.GetActiveView()
    simple.SetActiveSource(bent)
    hand.create_filter("DeformationField")
    hand.wait(100)
    field = simple.GetActiveSource()
    assert field.Direction == "Backward", field.Direction
    assert hand.cut_off() == 0, "what the direction is for fits the panel"
    assert hand.click("Accept")
    hand.wait(300)
    assert simple.GetDisplayProperties(bent, view).Visibility == 1
    assert view.SMProxy.FindRepresentation(field.SMProxy, 0) is None
    assert field.PointData["Displacement"] is not None, "it was applied"
    simple.Show(field, view)  # whoever wants to see it, sees it


def warnings_stand_in_the_status_line():
    """They open nothing over the views, count strokes as the list does, and use its words."""
    hand.forget_messages()
    window.deformation().Strokes = brainshift.soft(CENTRE, (0.0, 0.5, 0.0), 0.7)
    window.deformation().UpdatePipeline()
    window.until(lambda: "stroke 1 (0.7 mm)" in hand.label("BrainShiftStatusWarning"),
                 "the warning")
    words = hand.label("BrainShiftStatusWarning")
    assert words.startswith("The lattice is too coarse"), words
    assert words.endswith("Make Lattice Dimensions larger."), words
    told, shown = hand.messages()
    assert not shown, "Output Messages stays closed"
    assert any("stroke 1 (0.7 mm)" in line for line in told), told
    assert hand.is_visible("BrainShiftStatusWarning")
    assert hand.click("BrainShiftMessages")
    hand.wait(100)
    assert hand.messages()[1] and not hand.is_visible("BrainShiftStatusWarning")


def errors_open_the_messages():
    hand.close_messages()
    assert not hand.messages()[1]
    window.deformation().Strokes = STROKES[:-1]
    window.deformation().UpdatePipeline()
    window.until(lambda: hand.messages()[1], "Output Messages opens")
    assert any("must hold 14 for each stroke" in line for line in hand.messages()[0])
    window.deformation().Strokes = []
    hand.close_messages()
    hand.forget_messages()


def play():
    yield (begin,)
    yield (fits, 1280, 800)
    yield (fits, 1600, 1000)
    yield (is_seen_at_once, 1280, 800)
    yield (is_seen_at_once, 1600, 1000)
    yield (labels_say_units,)
    yield (stays_selected,)
    yield (other_stays_selected,)
    yield (keeps_the_keyboard,)
    yield (warnings_stand_in_the_status_line,)
    yield (errors_open_the_messages,)
    yield (show_another_volume,)
    yield (switches_by_button,)
    yield (switches_by_click,)
    yield (both_are_shown,)
    yield (field_leaves_the_volume,)


if __name__ == "__main__":
    window.main("PanelByHand", play())
