# SPDX-License-Identifier: BSD-3-Clause
"""What tests of finer levels share: a store whose coarser levels blur what is drawn, readers of it,
a bend, and comparisons of pictures."""
import os

import numpy
import zarr_files
from brainshift_testing import object_pixels, volume
from paraview import simple
from zarr_files import describe, fresh, level, write_array

SHAPE = (72, 112, 96)  # z, y, x: the last bricks are cut
MIDDLE = (48.0, 56.0, 36.0)


def voxels():
    """A ball with waves of 5 voxels on it: the coarser levels blur them."""
    z, y, x = numpy.mgrid[0:SHAPE[0], 0:SHAPE[1], 0:SHAPE[2]].astype(float)
    away = numpy.sqrt((x - 48) ** 2 + (y - 56) ** 2 + 1.6 * (z - 36) ** 2)
    waves = 1.5 * (numpy.sin(x * 1.25) + numpy.sin(y * 1.25) + numpy.sin(z * 1.25))
    return (1000 * numpy.clip((34 + waves - away) / 6 + 0.5, 0, 1)).astype(numpy.uint16)


def halved(values):
    z, y, x = (side // 2 for side in values.shape)
    return values.reshape(z, 2, y, 2, x, 2).mean((1, 3, 5)).round().astype(values.dtype)


def store(name="bricks.zarr", kind=numpy.uint16, chunks=(20, 24, 28)):
    """Three levels. Chunks and bricks have no faces in common."""
    path = fresh(name)
    values = voxels().astype(kind)
    datasets = []
    for i in range(3):
        write_array(path, str(i), values, 2, chunks, codecs=zarr_files.OF_VERSION_2["zstd"])
        datasets.append(level(str(i), [2 ** i] * 3, [(2 ** i - 1) / 2] * 3))
        values = halved(values)
    return describe(path, datasets, version=2)


def reader(path, **properties):
    return simple.OMEZarrReader(FileName=path, **properties)


def coarse(path):
    source = reader(path, MemoryLimit=0.3)
    source.UpdatePipeline()
    assert source.GetClientSideObject().GetOutput().GetDimensions() == (48, 56, 36)
    return source


def blurred():
    """The level beside the finest, in no file."""
    return volume(halved(voxels()), (0.5,) * 3, (2.0,) * 3)


def lattice():
    """Displacements on a grid of its own, so that the bend does not depend on the level."""
    z, y, x = numpy.mgrid[0:7, 0:7, 0:7] / 6.0 - 0.5
    away = numpy.exp(-6 * (x * x + y * y + z * z))
    displacements = numpy.stack((9 * away, -7 * away * y, 6 * away * (1 + x)), -1)
    return volume(displacements.astype(numpy.float32), (-8.0, -8.0, -8.0), (19.0, 21.0, 15.0))


def bent(source):
    return simple.FreeFormDeformation(Input=source, Lattice=lattice(), LatticeDimensions=[19] * 3)


def save(name, view, size):
    """The bytes of a picture that is saved with nothing drawn before."""
    file = os.path.join(os.environ["BRAINSHIFT_TEST_TEMP"], name)
    assert simple.SaveScreenshot(file, view, ImageResolution=[size, size])
    with open(file, "rb") as stream:
        return stream.read()


# Pixels of a lit picture that may differ from the volume drawn directly: where values hardly
# change, rounding turns the light. At four of twelve steps along rays there was one, or two.
TURNED = 3


def differences(left, right):
    off = numpy.abs(left - right).max(axis=2)
    return off.max(), (off > 1.5 / 255).sum(), object_pixels(left, right).sum()


def compare(what, left, right, other, most_pixels):
    """The first two pictures are alike, the third differs."""
    largest, pixels, all_pixels = differences(left, right)
    _, others, _ = differences(other, right)
    print(f"  {what}: {pixels} of {all_pixels} pixels differ by more than 1/255, the largest by "
          f"{largest:.3f}; of the coarser level {others}", flush=True)
    assert all_pixels > 3000, all_pixels
    assert pixels <= most_pixels, (what, pixels)
    assert others > 20 * (pixels + 5), (what, others)
    return largest
