# SPDX-License-Identifier: BSD-3-Clause
"""What tests of empty-space skipping share: volumes with much to skip, lattices that fold, and a
comparison of pictures to the bit."""

import itertools

import brainshift
import numpy
from brainshift_testing import object_pixels, picture, volume
from paraview.simple import FreeFormDeformation

SIDE = 21  # voxels
MIDDLE = ((SIDE - 1) / 2,) * 3
OBLIQUE = (-0.5, -0.3, -0.8)
# Pairs of a fraction of the scalar range and its opacity for 1 mm. No voxel of `scattered` lies in
# the band; only interpolation between neighbours passes through it.
OPACITIES = {
    "opaque": ((0.0, 0.0), (0.4, 0.0), (0.5, 1.0), (1.0, 1.0)),
    "translucent": ((0.0, 0.0), (0.2, 0.0), (0.3, 0.1), (1.0, 0.3)),
    "band": ((0.0, 0.0), (0.45, 0.0), (0.5, 0.9), (0.55, 0.0), (1.0, 0.0)),
}


def scattered(side=SIDE, seed=1):
    """Single voxels of 1 and small blocks in empty space: much to skip, and much to miss."""
    random = numpy.random.default_rng(seed)
    voxels = numpy.zeros((side,) * 3, numpy.float32)
    for extent, count in ((1, 40), (2, 20), (4, 6)):
        for corner in random.integers(1, side - extent - 1, (count, 3)):
            voxels[tuple(slice(low, low + extent) for low in corner)] = 1.0
    return voxels


def random_lattice(amplitude, side=7, seed=2):
    """A source of displacements up to `amplitude` mm, of no pattern: neighbours fold over."""
    random = numpy.random.default_rng(seed)
    displacements = random.uniform(-amplitude, amplitude, (side, side, side, 3))
    step = (SIDE - 1) / (side - 1)
    return volume(displacements.astype(numpy.float32), spacing=(step,) * 3)


def curves(name, low=0.0, high=1.0):
    """Colour map and opacity curve over a scalar range."""
    at = [low + share * (high - low) for share in (0.0, 0.5, 1.0)]
    colors = [at[0], 1, 0.2, 0, at[1], 0.2, 1, 0.2, at[2], 0, 0.4, 1]
    opacities = []
    for share, opacity in OPACITIES[name]:
        opacities += [low + share * (high - low), opacity, 0.5, 0]
    return colors, opacities


def bent(source, amplitude, **lattice):
    return FreeFormDeformation(Input=source, Lattice=random_lattice(amplitude, **lattice),
                               LatticeDimensions=[7, 7, 7], Samples=2)


def assert_same(view, display, what, least_share=0.01):
    """Pictures with skipping and without, and the positions of what they show, are the same.

    Returns the share of pixels that show the object.
    """
    images, positions = [], []
    for skipping in (0, 1):
        display.EmptySpaceSkipping = skipping
        images.append(picture(view))
        pixels = itertools.product(range(5, view.ViewSize[0], 18), repeat=2)
        positions.append([brainshift.pick(display, view, x, y) for x, y in pixels])
    share = object_pixels(images[0]).mean()
    differing = int((images[0] != images[1]).any(axis=2).sum())
    print(f"  {what}: {differing} differ, object on {100 * share:.0f} %", flush=True)
    assert share >= least_share, (what, share)
    assert differing == 0, (what, differing)
    assert positions[0] == positions[1], what
    return share
