# SPDX-License-Identifier: BSD-3-Clause
"""What tests of comparisons share: a bent volume, a reference, and slices of both as numbers.

Import it after the plugin is loaded.
"""

import math

import brainshift
import numpy
from brainshift_testing import picture, volume, voxels
from paraview.simple import BakeDeformation, CompareVolumes, Delete, FreeFormDeformation
from slices_testing import flat_view, pixel_positions, show_slices, trilinear

MIDDLE = (16.0, 16.0, 16.3)
HALF = 15.0  # mm, of the views
STROKE = brainshift.soft((16, 16, 16), (4, 2, 0), 14)


def smooth(seed, side=33):
    """Random waves, 0 to 100, without an edge."""
    random = numpy.random.default_rng(seed)
    z, y, x = numpy.mgrid[0:side, 0:side, 0:side] / (side - 1)
    values = sum(numpy.sin(random.uniform(6, 22, 3) @ numpy.stack([x, y, z]).reshape(3, -1)
                           + random.uniform(0, 6)) for _ in range(6)).reshape((side,) * 3)
    low, high = values.min(), values.max()
    return (100 * (values - low) / (high - low)).astype(numpy.float32)


def compared_picture(source, comparison, window=(0.0, 100.0), **named):
    view = flat_view(2, MIDDLE, HALF)
    display = show_slices(source, view, ("Axial",), MIDDLE, *window)
    display.SliceComparison = comparison
    for name, value in named.items():
        setattr(display, name, value)
    image = picture(view)
    Delete(view)
    return image


class Pair:
    """A bent volume and a reference of another type, grid and range, turned and moved."""

    turn, move = 25.0, (2.0, -1.5, 0.5)

    def __init__(self):
        self.own = smooth(2)
        self.bent = FreeFormDeformation(Input=volume(self.own), Strokes=STROKE)
        self.voxels = (10 * smooth(3, side=41) + 500).astype(numpy.uint16)
        self.origin, self.spacing = numpy.array((-2.0, 1.0, -4.0)), numpy.array((0.9, 0.8, 1.0))
        self.reference = volume(self.voxels, self.origin, self.spacing)
        self.compare = CompareVolumes(Input=self.bent, Reference=self.reference,
                                      ReferenceRotation=[0, 0, self.turn],
                                      ReferenceTranslation=self.move)

    def unturned(self, places=None):
        """Where places, or the pixels, lie to the reference, had it not been moved: mm."""
        if places is None:
            places = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF)
        angle = math.radians(self.turn)
        turned = numpy.array([[math.cos(angle), -math.sin(angle), 0],
                              [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
        middle = self.origin + self.spacing * 20
        return (places - middle - self.move) @ turned + middle

    def baked_share(self):
        """The bent volume's share of 0 to 100 where each pixel lies, from the baked one."""
        baked = BakeDeformation(Input=self.bent)
        value, _ = trilinear(voxels(baked), pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, HALF))
        Delete(baked)
        return numpy.clip(value / 100.0, 0.0, 1.0)

    def expected(self):
        """The reference's share of its range where each pixel lies, and where there is one."""
        value, inside = trilinear(self.voxels, (self.unturned() - self.origin) / self.spacing)
        low, high = self.voxels.min(), self.voxels.max()
        return (value - low) / (float(high) - low), inside
