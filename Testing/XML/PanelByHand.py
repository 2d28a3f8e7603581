# SPDX-License-Identifier: BSD-3-Clause
"""Proves that the panel of a Free-Form Deformation is not cut off at the right in windows of usual
sizes, with each tool; that the filter stays selected when its mask comes and goes; that Reset All
leaves the keyboard where it was; and that the status line tells when a view shows another volume
than the one that the tool in hand works on.

ParaView's window runs this file as a script; what did not hold is written down for the pvpython
that runs it afterwards."""
import brainshift
import test_hand as hand
import window_testing as window
from paraview import servermanager, simple

CENTRE = (0.0, 0.0, 0.0)
STROKES = (brainshift.stamp((8.0, 0.0, 0.0), CENTRE, -123.4, major=80.0, minor=40.0) +
           brainshift.soft((0.0, 4.0, 0.0), (0.0, 1.0, 0.0), 60.0))


def begin():
    simple.Wavelet()
    hand.create_filter("FreeFormDeformation")
    hand.wait(100)
    assert hand.click("Accept")
    hand.wait(500)
    simple.RenameSource("bent", simple.GetActiveSource())


def fits(width, height):
    """In a window of this size."""
    hand.resize_window(width, height)
    window.deformation().Strokes = STROKES
    for tool in (hand.NONE, hand.MOVE, hand.SOFT, hand.STAMP):
        hand.take(tool)
        hand.wait(300)
        assert hand.cut_off() == 0, (width, height, tool, hand.cut_off())


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


def tells_another_volume():
    """The status line, while the view shows another volume than the one that is selected."""
    bent, view = window.deformation(), simple.GetActiveView()
    other = simple.FreeFormDeformation(registrationName="other", Input=simple.Wavelet())
    simple.Show(other, view)
    simple.Hide(bent, view)
    simple.Render(view)
    hand.take(hand.STAMP)
    for source, told in ((bent, True), (other, False)):
        simple.SetActiveSource(source)
        hand.wait(200)
        hand.hover([side // 2 for side in view.ViewSize])
        hand.wait(200)
        line = hand.label("BrainShiftStatus")
        assert line.startswith("Stamp"), line
        assert ("To work on other" in line) == told, line
    simple.Show(bent, view)
    simple.SetActiveSource(bent)
    hand.wait(200)
    hand.hover([side // 2 for side in view.ViewSize])
    hand.wait(200)
    assert "To work on" not in hand.label("BrainShiftStatus"), "both are shown"


def play():
    yield (begin,)
    yield (fits, 1280, 800)
    yield (fits, 1600, 1000)
    yield (stays_selected,)
    yield (other_stays_selected,)
    yield (keeps_the_keyboard,)
    yield (tells_another_volume,)


if __name__ == "__main__":
    window.main("PanelByHand", play())
