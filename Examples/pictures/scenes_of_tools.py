# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the documentation that show what the tools do. A scene takes the width of its picture
in pixels and returns the picture."""

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import demo
import stage

# From the front, with the place that is worked on against the background.
CLOSE = ((-322.0, 26.0, 497.0), (-170.0, 480.0, 90.0), 13)
PULL_MM = 12.0
SOFT_BY = (-8.0, 0.0, 12.0)  # mm
SOFT_RADIUS = 35.0
COARSE = [10, 10, 10]  # control points: with 19 a side, one of them moves little
NEAR_MM = 24.0  # control points farther from the hand are not shown
MOVE_BY = (-5.0, 0.0, 11.0)


def _close(strokes, side, **properties):
    made = stage.brain_view(stage.bend(stage.brain(), strokes, **properties), side)
    demo.frame(made, *CLOSE)
    return made


def _show_stamp(made):
    towards = numpy.subtract(stage.CENTRE, stage.CORTEX)
    stage.show_outline(stage.rings(numpy.array(stage.CORTEX), towards, 45.0, 32.0), made,
                       stage.YELLOW)
    away = -towards / numpy.linalg.norm(towards)
    stage.show_outline([stage.line([stage.CORTEX, stage.CORTEX + 45.0 * away])], made, stage.CYAN)
    stage.show_balls([stage.CORTEX], made, stage.ORANGE, 2.0)


def stamp(width):
    """The ellipsoid on the cortex; tissue pushed in; tissue pulled out."""
    side = width // 3
    views = [_close(strokes, side) for strokes in (
        (), stage.push(-PULL_MM), stage.push(PULL_MM))]
    _show_stamp(views[0])
    return stage.side_by_side(views)


def soft(width):
    """The sphere on the cortex, and what a drag moved."""
    import brainshift
    side = width // 2
    stroke = brainshift.soft(stage.CORTEX, SOFT_BY, SOFT_RADIUS, sigma=0.6)
    views = [_close(strokes, side) for strokes in ((), stroke)]
    stage.show_outline(stage.rings(numpy.array(stage.CORTEX), (0, 0, 1), SOFT_RADIUS, SOFT_RADIUS),
                       views[0], stage.YELLOW)
    stage.show_balls([stage.CORTEX], views[0], stage.ORANGE, 2.0)
    return stage.side_by_side(views)


def control_points(bent):
    """Positions (mm) of the control points as bent."""
    lattice = stage.as_bent(simple.DeformationLattice(Input=bent))
    points = servermanager.Fetch(lattice).GetPoints().GetData()
    return vtk_to_numpy(points).astype(float)


def _show_control_points(bent, made, taken, near):
    points = control_points(bent)
    stage.show_balls(points[near], made, stage.YELLOW, 1.5)
    stage.show_balls(points[taken:taken + 1], made, stage.ORANGE, 2.5)


def move(width):
    """Control points near the cortex, and one of them dragged outwards."""
    import brainshift
    side = width // 2
    points = control_points(stage.bend(stage.brain(), LatticeDimensions=COARSE))
    taken = int(numpy.argmin(numpy.linalg.norm(points - stage.CORTEX, axis=1)))
    near = numpy.linalg.norm(points - points[taken], axis=1) < NEAR_MM
    near[taken] = False
    views = []
    for strokes in ((), brainshift.move(points[taken], MOVE_BY)):
        views.append(_close(strokes, side, LatticeDimensions=COARSE))
        bent = views[-1].Representations[0].Input
        _show_control_points(bent, views[-1], taken, near)
    return stage.side_by_side(views)


def four_views(width):
    """A head with a dent in the layout of the button Four Views."""
    import brainshift
    bent = stage.bend(stage.head(), stage.push(-12.0))
    views = brainshift.four_views(bent)
    stage.show_head(bent, views["volume"])
    views["volume"].Background = (0.0, 0.0, 0.0)
    layout = simple.GetLayout(views["volume"])
    size = (width, width * 3 // 4)
    layout.SetSize(*size)
    simple.GetDisplayProperties(bent, views["axial"]).SlicePosition = stage.CORTEX
    simple.RenderAllViews()
    return stage.pixels_of_layout(layout, size)


TOOL_SCENES = {"tool-stamp": stamp, "tool-soft": soft, "tool-move": move,
               "tool-four-views": four_views}
