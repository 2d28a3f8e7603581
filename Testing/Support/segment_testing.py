# SPDX-License-Identifier: BSD-3-Clause
"""What tests of a segment that is drawn alone share: tissue everywhere, divided by labels."""

import brainshift
import numpy
from brainshift_testing import show_volume, volume
from paraview.simple import FreeFormDeformation

SIDE = 49  # voxels, 1 mm
MIDDLE = ((SIDE - 1) / 2,) * 3
BRAIN, SKULL, VESSEL = 3, 7, 9
# There is one colour, because interpolation to voxels of 0 passes through all lower colours.
COLORS = [0, 1, 0.7, 0.4, 100, 1, 0.7, 0.4]
OPACITIES = [0, 0, 0.5, 0, 25, 0, 0.5, 0, 40, 0.9, 0.5, 0, 100, 0.9, 0.5, 0]
STROKES = brainshift.soft((24, 26, 30), (5, -4, -5), 16.0)


def places(origin=(0, 0, 0), spacing=1.0, side=SIDE, direction=None):
    """Positions (mm) of the points of a grid, indexed [z, y, x, xyz]."""
    z, y, x = numpy.mgrid[0:side, 0:side, 0:side].astype(float)
    turn = numpy.eye(3) if direction is None else numpy.reshape(direction, (3, 3))
    return numpy.asarray(origin) + numpy.stack([x, y, z], -1) * spacing @ turn.T


def labels_at(world):
    """A brain that is an ellipsoid, a skull around it, and a vessel of one voxel across both."""
    away = numpy.linalg.norm((world - MIDDLE) / (1.1, 0.9, 1.0), axis=-1)
    labels = numpy.where(away < 13.0, BRAIN, numpy.where(away < 20.0, SKULL, 0))
    vessel = (numpy.abs(world[..., 1] - 24) < 0.5) & (numpy.abs(world[..., 2] - 24) < 0.5)
    return numpy.where(vessel & (away < 22.0), VESSEL, labels).astype(numpy.uint8)


def tissue():
    """Scalars that tell nothing of the labels: visible everywhere."""
    x, y, z = numpy.moveaxis(places(), -1, 0)
    return (70 + 25 * numpy.sin(x / 3.0) * numpy.cos(y / 4.0 + z / 5.0)).astype(numpy.float32)


def oblique_labels():
    """The labels on a finer grid that shares no axis with the volume."""
    turn = numpy.radians(25.0)
    direction = [numpy.cos(turn), -numpy.sin(turn), 0, numpy.sin(turn), numpy.cos(turn), 0, 0, 0, 1]
    side, spacing = 96, 0.7
    origin = MIDDLE - numpy.reshape(direction, (3, 3)) @ (numpy.ones(3) * (side - 1) / 2 * spacing)
    return volume(labels_at(places(origin, spacing, side, direction)), origin=origin,
                  spacing=(spacing,) * 3, direction=direction)


def bent(voxels=None, **named):
    """The tissue, bent; without a mask all of it."""
    return FreeFormDeformation(Input=volume(tissue() if voxels is None else voxels),
                               Strokes=STROKES, **named)


def show(source, view, labels=None, kind="Deformed Volume", **named):
    """Shows tissue; with `labels`, only those."""
    display = show_volume(source, view, kind, COLORS, OPACITIES, **named)
    if labels is not None:
        display.DrawSegment = 1
        display.DrawnLabels = labels
    return display
