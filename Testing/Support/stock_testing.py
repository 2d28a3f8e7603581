# SPDX-License-Identifier: BSD-3-Clause
"""Compares a smooth bent volume with ParaView's own "Volume" of the same volume, bent and baked."""

import brainshift
import numpy
from brainshift_testing import (mean_difference, object_pixels, output, picture, show_volume,
                                use_headlight, view_along, volume)
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation
from vtkmodules.vtkRenderingCore import vtkVolume
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper

SIDE = 49  # voxels
MIDDLE = ((SIDE - 1) / 2,) * 3
DIRECTION = (-0.6, 0.2, -1.0)
COLORS = [0, 0, 0.2, 1, 50, 1, 0.6, 0, 100, 1, 1, 0.8]
OPACITIES = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.7, 0.5, 0]
MAPPER_STEP = 0.05  # mm, of mapper_picture
# Baking blurs the volume, and VTK's steps are twice as long.
LARGEST_DIFFERENCE = 0.005  # mean, of full scale, over the object's pixels


def smooth(middles=((22, 26, 24, 10.0, 70.0), (32, 18, 28, 6.0, 90.0))):
    """Gaussian blobs (x, y, z, width, height) in voxels [z, y, x]; no plateau, no edge: nothing
    that baking or gradients would find differently."""
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE].astype(float)
    values = numpy.zeros((SIDE,) * 3)
    for i, j, k, width, height in middles:
        squared = (x - i) ** 2 + (y - j) ** 2 + (z - k) ** 2
        values = numpy.maximum(values, height * numpy.exp(-squared / (2 * width ** 2)))
    return values.astype(numpy.float32)


def bend(source):
    """Moves what is inside and leaves the box as it is: beyond, a baked volume is filled with 0."""
    return FreeFormDeformation(Input=source, Strokes=(
        brainshift.soft((22, 26, 26), (-5, 4, -4), 20.0)
        + brainshift.soft((32, 20, 28), (-3, -6, 2), 14.0)))


class Bent:
    """A volume, the same bent, and the same bent and baked."""

    def __init__(self, voxels, **named):
        self.source = volume(voxels, **named)
        self.filter = bend(self.source)
        self.baked = BakeDeformation(Input=self.filter, Interpolation="Cubic")


def prop_of(view):
    """The vtkVolume that a view shows."""
    volumes = view.GetClientSideObject().GetRenderer().GetVolumes()
    shown = [volumes.GetItemAsObject(i) for i in range(volumes.GetNumberOfItems())]
    return next(prop for prop in shown if prop.GetVisibility())


def shown_picture(source, kind, configure, direction=DIRECTION, opacities=OPACITIES,
                  colors=COLORS, **named):
    """A picture of a volume in a view of its own, after configure(display, view)."""
    view = view_along(direction, MIDDLE, 140.0, size=200)
    use_headlight(view)
    display = show_volume(source, view, kind, colors, opacities, **named)
    configure(display, view)
    image = picture(view)
    Delete(view)
    return image


def mapper_picture(source, configure, direction=DIRECTION, opacities=OPACITIES, colors=COLORS):
    """A picture by VTK's own volume mapper without ParaView's representation, which hands some of
    its choices to nobody: after configure(mapper, volume)."""
    view = view_along(direction, MIDDLE, 140.0, size=200)
    use_headlight(view)
    display = show_volume(source, view, "Volume", colors, opacities)
    picture(view)
    prop = vtkVolume()
    prop.SetProperty(prop_of(view).GetProperty())
    display.SetRepresentationType("Outline")  # tells the view how far it must see
    display.Opacity = 0.0
    mapper = vtkGPUVolumeRayCastMapper()
    mapper.SetInputData(output(source))
    mapper.AutoAdjustSampleDistancesOff()
    mapper.SetSampleDistance(MAPPER_STEP)
    prop.SetMapper(mapper)
    configure(mapper, prop)
    view.GetClientSideObject().GetRenderer().AddVolume(prop)
    image = picture(view)
    view.GetClientSideObject().GetRenderer().RemoveVolume(prop)
    Delete(view)
    return image


def assert_like_stock(what, bent, configure, limit=LARGEST_DIFFERENCE, control=4.0, **named):
    """Deformed Volume of the bent volume looks like Volume of the baked one; Volume of the unbent
    one differs by more than `control` times as much."""
    return assert_alike(
        what, shown_picture(bent.filter, "Deformed Volume", configure, **named),
        shown_picture(bent.baked, "Volume", configure, **named),
        shown_picture(bent.source, "Volume", configure, **named), limit, control)


def assert_alike(what, deformed, baked, unbent, limit=LARGEST_DIFFERENCE, control=4.0):
    """Three pictures, of which the first two are alike and the third is not."""
    difference = mean_difference(deformed, baked)
    other = mean_difference(unbent, baked)
    share = object_pixels(baked).mean()
    print(f"  {what}: differs by {100 * difference:.2f} %, unbent by {100 * other:.2f} %, object "
          f"on {100 * share:.0f} %", flush=True)
    assert share > 0.03, (what, share)
    assert difference < limit, (what, difference)
    assert other > control * difference, (what, "the unbent volume must be told apart", other)
