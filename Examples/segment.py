# SPDX-License-Identifier: BSD-3-Clause
"""Draws one picture of three: a head, its brain alone by Draw Segment, and the brain pulled out by
a stamp.

    pvpython segment.py FILE.png

BRAINSHIFT_PLUGIN gives the path of the plugin, as for demo.py. Research software, not a medical
device.
"""

import sys

import demo
from paraview import simple

SIDE = 400  # pixels of one picture
ANCHOR = (-285.0, 62.0, 515.0)  # on the frontal cortex
INTEREST = (-309.0, 22.0, 477.0)
PULL_MM = 16.0


def bent_head(strokes=()):
    """The head of the test data; the brain mask tells what can be drawn alone."""
    head = demo.open_volume("Head", "seg3d_mr_t1.nii.gz")
    mask = demo.open_volume("Brain mask", "seg3d_brainmask.nii.gz")
    return simple.FreeFormDeformation(Input=head, Segmentation=mask, Strokes=strokes)


def show(deformed, view, alone):
    demo.look_like_tissue("Intensity", demo.CORTEX_COLORS, demo.CORTEX_OPACITIES)
    demo.show(deformed, "Intensity", view)
    simple.GetDisplayProperties(deformed, view).DrawSegment = int(alone)
    demo.frame(view, (-306, 24, 479), (-250, 480, 150), 18)


def draw(file):
    import brainshift
    pull = brainshift.stamp(ANCHOR, INTEREST, PULL_MM, major=60.0, minor=30.0)
    first = simple.CreateView("RenderView")
    layout = simple.CreateLayout("Pictures")
    simple.AssignViewToLayout(first, layout, 0)
    views = [first]
    for share in (1 / 3, 1 / 2):
        place = layout.SplitHorizontal(layout.GetViewLocation(views[-1]), share)
        views.append(simple.CreateView("RenderView"))
        layout.AssignView(place + 1, views[-1])
    layout.SetSize(3 * SIDE, SIDE)
    for view, strokes, alone in zip(views, ((), (), pull), (False, True, True)):
        show(bent_head(strokes), view, alone)
    simple.SaveScreenshot(file, layout, ImageResolution=(3 * SIDE, SIDE), SeparatorWidth=0,
                          SeparatorColor=demo.BACKGROUND)
    print(file)


if __name__ == "__main__":
    demo.load_plugin()
    draw(sys.argv[1])
