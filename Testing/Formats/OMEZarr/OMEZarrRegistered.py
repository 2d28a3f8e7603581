# SPDX-License-Identifier: BSD-3-Clause
# Proves that align and refine compare the level of a store that they need, whichever was read, and
# say so where a part of it is lost.
import os

import numpy
import zarr_files
from brainshift_testing import load_plugin, run_tests, volume
from streamed_store import halved, reader
from vtkmodules.util.numpy_support import vtk_to_numpy
from zarr_files import describe, fresh, level, write_array

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

SIDE = 96   # voxels of 1 mm
CHUNK = 24  # so several slabs are read
MIDDLE = numpy.full(3, 0.5 * (SIDE - 1))
MOTION = (2.0, -1.5, 1.0)  # mm


def tissue(shift=(0.0, 0.0, 0.0)):
    """Folds of 5 mm within an ellipsoid, which voxels of 4 mm do not show: uint16 [z, y, x]."""
    z, y, x = (numpy.indices((SIDE,) * 3) - numpy.reshape(shift[::-1], (3, 1, 1, 1)))
    folds = sum(numpy.sin(1.2 * a + 0.3 * b) for a, b in ((x, y), (y, z), (z, x)))
    wide = numpy.sin(0.13 * x + 0.05 * y) + numpy.sin(0.11 * y - 0.06 * z)
    away = numpy.sqrt(((x - MIDDLE[0]) / 38) ** 2 + ((y - MIDDLE[1]) / 42) ** 2
                      + ((z - MIDDLE[2]) / 40) ** 2)
    values = (1000 + 150 * folds + 100 * wide) * numpy.clip(8 * (1 - away), 0, 1)
    return values.clip(0).astype(numpy.uint16)


def store(name):
    """Three levels, of 1, 2 and 4 mm."""
    path = fresh(name)
    values, datasets = tissue(), []
    for i in range(3):
        write_array(path, str(i), values, 2, (CHUNK,) * 3, codecs=zarr_files.OF_VERSION_2["zstd"])
        datasets.append(level(str(i), [2 ** i] * 3, [(2 ** i - 1) / 2] * 3))
        values = halved(values)
    axes = [{"name": name, "type": "space", "unit": "millimeter"} for name in "zyx"]
    return describe(path, datasets, axes, version=2)


def coarse(path):
    source = reader(path, MemoryLimit=0.1)
    source.UpdatePipeline()
    assert source.GetClientSideObject().GetOutput().GetDimensions() == (24, 24, 24)
    return source


def copied(source):
    """The same numbers in memory of their own: nobody knows that a file has finer ones."""
    image = source.GetClientSideObject().GetOutput()
    values = vtk_to_numpy(image.GetPointData().GetScalars()).copy()
    return volume(values.reshape(image.GetDimensions()[::-1]).astype(numpy.uint16),
                  image.GetOrigin(), image.GetSpacing())


def aligned(source):
    compare = simple.CompareVolumes(Input=source, Reference=volume(tissue(MOTION)))
    found = brainshift.align(compare)
    return numpy.array([*compare.ReferenceRotation, *compare.ReferenceTranslation]), found


def refined(source):
    """The mean distance (mm) of bent points from where the reference has them."""
    bent = simple.FreeFormDeformation(Input=source, LatticeDimensions=[6, 6, 6])
    found = brainshift.refine(bent, volume(tissue(MOTION)), keep_failed=True)
    points = MIDDLE + numpy.random.default_rng(3).uniform(-20, 20, (100, 3))
    apart = brainshift.deformed_from_rest(bent, points) - points - MOTION
    return numpy.linalg.norm(apart, axis=1).mean(), found


def test_align_compares_the_level_that_it_needs():
    path = store("aligned.ome.zarr")
    finest, found = aligned(reader(path, Level=0))
    assert not any("Coarser" in warning for warning in found.warnings), found.warnings
    assert numpy.allclose(finest[3:], numpy.negative(MOTION), atol=0.1), finest
    again, found = aligned(coarse(path))
    assert numpy.array_equal(again, finest), again - finest
    assert not any("Coarser" in warning for warning in found.warnings), found.warnings
    other, _ = aligned(copied(coarse(path)))
    assert not numpy.array_equal(other, finest), "the test cannot tell"


def test_refine_compares_the_level_that_it_needs():
    path = store("refined.ome.zarr")
    all_found = [refined(source)
                 for source in (reader(path, Level=0), coarse(path), copied(coarse(path)))]
    errors = [error for error, _ in all_found]
    assert "failed" not in [found.trust for _, found in all_found[:2]], all_found
    print("mean errors of the finest level, of the coarsest, of a copy", errors, flush=True)
    assert errors[1] < errors[0] + 0.03, errors
    assert errors[2] > 2.0 * errors[1], errors


def test_lost_voxels_are_warned_of():
    path = store("lost.ome.zarr")
    source = coarse(path)
    with open(os.path.join(path, "0", "1.1.1"), "wb") as file:
        file.write(b"spoiled")
    _, found = aligned(source)
    assert any("Coarser voxels" in warning and "1.1.1" in warning
               for warning in found.warnings), found.warnings


run_tests(globals())
