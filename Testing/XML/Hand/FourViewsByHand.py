# SPDX-License-Identifier: BSD-3-Clause
"""Proves that in the slices of Four Views the right button changes window and level of all three,
as one step to undo, and zooms with Ctrl; that all three slices zoom together; that a double-click
makes a view large and small again; and that four views asked for again make no second layout.

ParaView's window runs this file as a script; play_window.py reports what did not hold."""
import brainshift
import numpy
import test_hand as hand
import window_testing as window
from brainshift_testing import on_screen
from paraview import simple

SLICES = ("axial", "coronal", "sagittal")
MOST_WAITS = 50  # of 0.1 s; on a busy machine a picture takes long


scenes = []


class Scene:
    """A block with a pattern, in four views."""

    def __init__(self):
        source = simple.Wavelet(WholeExtent=[0, 40, 0, 60, 0, 48])
        self.bent = simple.FreeFormDeformation(registrationName="bent", Input=source)
        view = simple.GetActiveViewOrCreate("RenderView")
        simple.Show(self.bent, view)
        simple.Render(view)
        simple.SetActiveSource(self.bent)
        hand.wait(100)
        self.views = brainshift.four_views(self.bent)  # as the button does
        hand.wait(100)

    def display(self, name):
        return simple.GetDisplayProperties(self.bent, self.views[name])

    def ends(self, name="axial"):
        """Of the range of grey values."""
        points = list(self.display(name).LookupTable.RGBPoints)
        return numpy.array([points[0], points[-4]])

    def zooms(self):
        return [self.views[name].GetActiveCamera().GetParallelScale() for name in SLICES]

    def middle(self, name, right=0, up=0):
        width, height = self.views[name].ViewSize
        return [width // 2 + right, height // 2 + up]

    def on_screen(self):
        return {name: on_screen(self.views[name]) for name in SLICES}


def one_layout():
    scenes.append(Scene())
    scene = scenes[0]
    assert len(simple.GetLayouts()) == 1, "the window's own layout is used"
    for name in ("axial", "volume"):
        simple.SetActiveView(scene.views[name])
        brainshift.four_views(scene.bent)
        hand.wait(100)
        assert len(simple.GetLayouts()) == 1 and len(simple.GetRenderViews()) == 4


def right_button_changes_grey_values():
    scene = scenes[0]
    for name in SLICES:
        before, seen, zooms = scene.ends(), scene.on_screen(), scene.zooms()
        hand.over(scene.views[name])
        hand.right_drag(scene.middle(name), scene.middle(name, 50, 0))
        wider = scene.ends()
        assert numpy.diff(wider) > 1.1 * numpy.diff(before), (name, before, wider)
        assert numpy.isclose(wider.mean(), before.mean()), "the level stays"
        hand.right_drag(scene.middle(name), scene.middle(name, 0, 40))
        higher = scene.ends()
        assert numpy.isclose(numpy.diff(higher), numpy.diff(wider)), "the window stays"
        assert higher.mean() > wider.mean() + 0.05 * numpy.diff(wider), (name, higher, wider)
        assert scene.zooms() == zooms, "the right button does not zoom"
        for _ in range(MOST_WAITS):
            hand.wait(100)
            changed = {other: (picture != seen[other]).mean()
                       for other, picture in scene.on_screen().items()}
            if min(changed.values()) > 0.05:
                break
        assert min(changed.values()) > 0.05, (name, changed, "all three follow")
        labels = window.undo_labels()
        assert labels.count("Window and level") == 2, ("each drag is one step", labels)
        window.action("Undo")
        assert numpy.allclose(scene.ends(), wider)
        window.action("Undo")
        assert numpy.allclose(scene.ends(), before)
        hand.wait(100)
        for other, picture in scene.on_screen().items():
            differing = numpy.abs(picture.astype(int) - seen[other]) > 2
            assert differing.mean() < 0.001, (name, other, "undone on the screen, too")
    hand.right_drag(scene.middle("sagittal"), scene.middle("sagittal"))
    assert "Window and level" not in window.undo_labels(), "a click is no edit"
    hand.over()


def slices_zoom_together():
    scene = scenes[0]
    for name in SLICES:
        hand.over(scene.views[name])
        before, ends, seen = scene.zooms(), scene.ends(), scene.on_screen()
        hand.right_drag(scene.middle(name), scene.middle(name, 0, 30), modifiers=hand.CONTROL)
        hand.wait(100)
        zooms = scene.zooms()
        assert len(set(zooms)) == 1 and zooms[0] != before[0], (name, zooms, before)
        assert (scene.ends() == ends).all()
        for other, picture in scene.on_screen().items():
            assert (picture != seen[other]).mean() > 0.02, (name, other, "drawn anew")
        ahead = scene.views[name].GetActiveCamera().GetDirectionOfProjection()
        assert max(abs(part) for part in ahead) > 0.999, "it still looks across its slice"
        scene.views[name].CameraParallelScale = before[0]
        hand.wait(100)
        assert scene.zooms() == before
    hand.over()


def double_click_makes_large():
    scene = scenes[0]
    for name in ("coronal", "volume"):
        small = list(scene.views[name].ViewSize)
        hand.over(scene.views[name])
        hand.double_click(scene.middle(name))
        hand.wait(200)
        large = list(scene.views[name].ViewSize)
        assert large[0] > 1.8 * small[0] and large[1] > 1.8 * small[1], (name, small, large)
        hand.double_click(scene.middle(name))
        hand.wait(200)
        assert list(scene.views[name].ViewSize) == small, name
    hand.take(hand.SOFT)
    hand.over(scene.views["coronal"])
    small = list(scene.views["coronal"].ViewSize)
    hand.double_click(scene.middle("coronal"))
    assert list(scene.views["coronal"].ViewSize) == small, "not under a tool"
    hand.take(hand.NONE)
    hand.over()


window.main("FourViewsByHand", [
    (one_layout,), (right_button_changes_grey_values,), (slices_zoom_together,),
    (double_click_makes_large,)])
