# SPDX-License-Identifier: BSD-3-Clause
"""Makes the volumes that floors.py measures, from the sample MRI and the mask of its brain.

A speed depends on how much of a volume is visible, how noisy it is, and how fine. So there are
four, by the size and the noise of real ones, and one of them by another map:

bench head: the reference case, 256x256x150.
noisy MR: 256x256x160. Rician noise of 9 % of bright tissue, the most that BrainWeb simulates
    (Collins et al., IEEE Transactions on Medical Imaging 17(3), 1998). The map begins above the
    noise of air, as the look Skin does.
speckled air: the same, by a map that begins within that noise, so that nothing can be skipped.
CT: 512x512x160 voxels of 0.45x0.45x0.9 mm, 16 bits, Hounsfield units. Bone is a shell of 6 mm
    around the brain, soft tissue has 40 HU. Noise of 26 HU, as in the most even twentieth of the
    patches of 7x7 voxels in GE's CT of a liver, of dcmqi's data. Rays see bone, through skin of no
    opacity.
high-resolution head: voxels of 0.6 mm, 12 bits, as of a research scanner. Noise of 2 %, that of the
    sample itself: 5 of 255 in its most even patches of bright tissue.

Files of real volumes are measured the same way; their opacities come from their percentiles.
"""

import numpy
from paraview import simple
from scene import (AIR, COLORS, OPACITIES, Volume, image_of, reference_volume, sample_voxels,
                   voxels_of)
from vtkmodules.vtkImagingCore import vtkImageReslice

RICE = 0.09          # noise of the noisy MR, fraction of bright tissue
FINE_NOISE = 0.02    # of the high-resolution head
TISSUE, BONE, CT_NOISE = 40.0, 900.0, 26.0  # Hounsfield units
SKULL = 6            # mm of bone around the inner skull
CT_OPACITIES = {"opaque": (-1000, 0, 150, 0, 300, 1, 2000, 1),
                "translucent": (-1000, 0, -300, 0, -250, 0.02, 2000, 0.02)}
CT_COLORS = (-1000, 0.2, 0.1, 0.1, 40, 0.9, 0.6, 0.5, 300, 1.0, 0.95, 0.85, 2000, 1.0, 1.0, 1.0)


def _on_grid(voxels, spacing, dimensions, fine, cubic=False):
    """Voxels [z, y, x] of a spacing, on a grid around the same middle. Outside: 0."""
    reslice = vtkImageReslice()
    reslice.SetInputData(image_of(voxels, spacing))
    old = (numpy.array(voxels.shape[::-1]) - 1) * spacing / 2
    new = (numpy.array(dimensions) - 1) * fine / 2
    reslice.SetOutputExtent(0, dimensions[0] - 1, 0, dimensions[1] - 1, 0, dimensions[2] - 1)
    reslice.SetOutputOrigin(*(old - new))
    reslice.SetOutputSpacing(*fine)
    reslice.SetInterpolationMode(3 if cubic else 1)
    reslice.Update()
    return voxels_of(reslice.GetOutput())


def _noise(shape, sd, seed):
    return numpy.random.default_rng(seed).standard_normal(shape, numpy.float32) * sd


def noisy_mr(scale=1.0, begins=4.0):
    """`begins`: where the map does, times the parameter of the Rayleigh distribution of air."""
    head, spacing = sample_voxels("seg3d_mr_t1")
    grid = numpy.array([0.75, 0.85, 0.9]) / scale
    clean = _on_grid(head, spacing, [int(n * scale) for n in (256, 256, 160)], grid)
    sd = 255.0 * RICE
    noisy = numpy.hypot(clean + _noise(clean.shape, sd, 1), _noise(clean.shape, sd, 2))
    air = begins * sd
    opacities = {"opaque": (0, 0, air, 0, air + 2 * AIR, 1, 255, 1),
                 "translucent": (0, 0, air, 0, air + 5, 0.02, 255, 0.02)}
    return Volume(image_of(numpy.clip(noisy.round(), 0, 255).astype(numpy.uint8), grid), opacities,
                  COLORS, air + 2 * AIR)


def _grown(mask, steps):
    """A mask with one voxel more on each side, so many times; by turns over 6 and 18 neighbours,
    which is rounder than either."""
    for step in range(steps):
        wider = mask.copy()
        for axis in range(3):
            source = wider.copy() if step % 2 else mask
            wider |= numpy.roll(source, 1, axis) | numpy.roll(source, -1, axis)
        mask = wider
    return mask


def ct(scale=1.0):
    head, spacing = sample_voxels("seg3d_mr_t1")
    inner = sample_voxels("seg3d_brainmask")[0] > 0.5
    bone = _grown(inner, SKULL) & ~inner
    skin = _grown(inner, SKULL + 3) | (head > 2 * AIR)
    hounsfield = numpy.where(bone, BONE, numpy.where(skin, TISSUE, -1000.0)).astype(numpy.float32)
    hounsfield[inner] += (head[inner] - 128.0) / 16.0
    grid = numpy.array([0.45, 0.45, 0.9]) / scale
    hounsfield = _on_grid(hounsfield + 1000.0, spacing, [int(n * scale) for n in (512, 512, 160)],
                          grid) - 1000.0
    hounsfield += _noise(hounsfield.shape, CT_NOISE, 3)
    return Volume(image_of(hounsfield.round().astype(numpy.int16), grid), CT_OPACITIES, CT_COLORS,
                  300.0)


def fine_head(scale=1.0):
    head, spacing = sample_voxels("seg3d_mr_t1")
    grid = numpy.array([0.6] * 3) / scale
    size = [int(n * side / mm) for n, side, mm in zip(head.shape[::-1], spacing, grid)]
    fine = 16.0 * _on_grid(head, spacing, size, grid, cubic=True)
    fine += _noise(fine.shape, 4080 * FINE_NOISE, 4)
    opacities = {name: tuple(16.0 * value if even % 2 == 0 else value
                             for even, value in enumerate(points))
                 for name, points in OPACITIES.items()}
    colors = tuple(16.0 * value if even % 4 == 0 else value for even, value in enumerate(COLORS))
    return Volume(image_of(numpy.clip(fine.round(), 0, 4095).astype(numpy.uint16), grid), opacities,
                  colors, 32.0 * AIR)


def from_file(file):
    """A real volume. The darkest half counts as air if it is dark, as of heads."""
    reader = simple.OpenDataFile(file)
    reader.UpdatePipeline()
    image = reader.GetClientSideObject().GetOutputDataObject(0)
    voxels, spacing = voxels_of(image), image.GetSpacing()
    low, high = (float(value) for value in numpy.percentile(voxels, (0.1, 99.9)))
    factor = (high - low) / 255.0

    def mapped(points, every):
        return tuple(low + factor * value if number % every == 0 else value
                     for number, value in enumerate(points))

    volume = Volume(image_of(voxels.copy(), spacing),
                    {name: mapped(points, 2) for name, points in OPACITIES.items()},
                    mapped(COLORS, 4), low + factor * 2 * AIR)
    simple.Delete(reader)
    return volume


def all_volumes(scale, files):
    """{name: function that makes the volume}. `scale`: 1, or less for a short run."""
    made = {"bench head": lambda: reference_volume(tuple(int(n * scale) for n in (256, 256, 150))),
            "noisy MR": lambda: noisy_mr(scale), "CT": lambda: ct(scale),
            "high-resolution head": lambda: fine_head(scale),
            "speckled air": lambda: noisy_mr(scale, 2.5)}
    return {**made, **{file: lambda file=file: from_file(file) for file in files}}
