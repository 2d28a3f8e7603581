# SPDX-License-Identifier: BSD-3-Clause
"""Proves that an installed BrainShift is found by its name and bends a volume: the module
brainshift is on Python's path, ParaView lists the plugin, and voxels go where the stroke says."""
import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import brainshift

simple.LoadDistributedPlugin("BrainShift", remote=False, ns=simple.__dict__)

AMOUNT = 4.0  # mm along +z, where the stroke is anchored
AMPLITUDE = 255.0  # of the wavelet's middle


def voxels(source):
    """Indexed [z, y, x]."""
    image = servermanager.Fetch(source)
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])


# 41 voxels of 1 mm on a side; the middle one lies at 0 0 0.
wavelet = simple.Wavelet(WholeExtent=[-20, 20] * 3, Maximum=AMPLITUDE)
bent = simple.FreeFormDeformation(
    Input=wavelet,
    Strokes=brainshift.stamp((0, 0, 0), (0, 0, -20), AMOUNT, major=30.0, minor=30.0, sigma=2.0))
moved = brainshift.deformed_from_rest(bent, [(0, 0, 0)])[0]
assert numpy.allclose(moved, (0, 0, AMOUNT), atol=0.2), moved

before, after = voxels(wavelet), voxels(simple.BakeDeformation(Input=bent))
assert before.shape == after.shape
seen = [(0.0, 0.0, z) for z in (-6.0, 0.0, 4.0, 9.0)]  # mm
for position, rest in zip(seen, brainshift.rest_from_deformed(bent, seen)):
    value = after[int(position[2]) + 20, 20, 20]
    expected = numpy.interp(rest[2], range(-20, 21), before[:, 20, 20])
    assert abs(value - expected) < 0.01 * AMPLITUDE, (position, rest, value, expected)
changed = numpy.abs(after - before).max()
assert changed > 0.1 * AMPLITUDE, changed
print(f"A stamp of {AMOUNT:g} mm moved its anchor by {moved[2]:.2f} mm.",
      f"No voxel changed by more than {changed:.1f}.")
