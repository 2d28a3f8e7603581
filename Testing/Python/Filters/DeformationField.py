# SPDX-License-Identifier: BSD-3-Clause
# Proves that ParaView's own filters make glyphs, a bent grid and maps in mm from Deformation
# Field, and that they lie where Deform Geometry and the stroke put them; and that by default it
# leads in the direction that programs resample images with.
import os
import tempfile

import numpy
from brainshift_testing import ball, load_plugin, output, run_tests, volume, voxels
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, Calculator, Contour, DeformationField, DeformGeometry, Delete,
    FreeFormDeformation, GetSources, Glyph, LoadState, SaveState, WarpByVector, Wavelet)

MIDDLE = (16.0, 16.0, 16.0)
PULL = 3.0
STAMP = brainshift.stamp(MIDDLE, (16.0, 16.0, 0.0), PULL, major=14.0, minor=10.0)
#: A quarter turn about z and some more: no axis of the volume is one of the world.
TURNED = (0.6, -0.8, 0.0, 0.8, 0.6, 0.0, 0.0, 0.0, 1.0)


def field(**properties):
    return DeformationField(
        Input=FreeFormDeformation(Input=volume(ball()), Strokes=STAMP), **properties)


def points_of(proxy):
    return vtk_to_numpy(output(proxy).GetPoints().GetData()).astype(float)


def test_names_and_values():
    forward = field(Direction="Forward")
    displacement = voxels(forward, "Displacement")
    assert displacement.dtype == numpy.float32
    assert numpy.allclose(displacement[16, 16, 16], (0, 0, PULL), atol=0.02)
    assert not displacement[0, 0, 0].any()
    determinant = voxels(forward, "JacobianDeterminant")
    assert 0.3 < determinant.min() < 0.9 and 1.1 < determinant.max() < 2.0
    backward = voxels(field(Direction="Backward"), "Displacement")
    assert numpy.allclose(backward[19, 16, 16], (0, 0, -PULL), atol=0.02)


def test_grids():
    dense = output(field(SampleGrid="Given Dimensions", Dimensions=[17, 9, 5]))
    assert dense.GetDimensions() == (17, 9, 5) and dense.GetSpacing() == (2.0, 4.0, 8.0)
    spaced = output(field(SampleGrid="Given Spacing", Spacing=[3.0, 4.0, 5.0]))
    assert spaced.GetDimensions() == (11, 9, 7) and spaced.GetSpacing() == (3.0, 4.0, 5.0)


def test_direction_matrices_are_honoured():
    turned = volume(ball(), direction=TURNED)
    centre = numpy.array(TURNED).reshape(3, 3) @ MIDDLE
    pulled = brainshift.soft(centre, (PULL, 0, 0), 10.0)
    filter = FreeFormDeformation(Input=turned, Strokes=pulled)
    bent = DeformationField(Input=filter, Direction="Forward")
    image = output(bent)
    assert numpy.allclose([image.GetDirectionMatrix().GetElement(i, j)
                           for i in range(3) for j in range(3)], TURNED)
    middle = voxels(bent, "Displacement")[16, 16, 16]
    assert numpy.allclose(middle, (PULL, 0, 0), atol=0.02), middle


def resampled(voxels_at_rest, displacement):
    """As ITK resamples by a displacement field: linear, 0 outside. Spacing 1 mm, origin 0."""
    sides = voxels_at_rest.shape
    grid = numpy.stack(numpy.meshgrid(*map(numpy.arange, sides), indexing="ij"), axis=-1)
    at = grid + displacement[..., ::-1]  # components are x y z, indices z y x
    low = numpy.floor(at).astype(int)
    share = at - low
    padded = numpy.pad(voxels_at_rest.astype(float), 1)
    sum_ = numpy.zeros(sides)
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.prod(numpy.where(corner, share, 1.0 - share), axis=-1)
        index = numpy.clip(low + corner + 1, 0, numpy.array(sides) + 1)
        sum_ += weight * padded[tuple(numpy.moveaxis(index, -1, 0))]
    return sum_


def test_the_default_resamples_images():
    made = field()
    expected = voxels(BakeDeformation(Input=made.Input))
    by_default = numpy.abs(resampled(ball(), voxels(made, "Displacement")) - expected).mean()
    made.Direction = "Forward"
    forward = numpy.abs(resampled(ball(), voxels(made, "Displacement")) - expected).mean()
    untouched = numpy.abs(ball() - expected).mean()
    print("mean difference: default", by_default, "forward", forward, "untouched", untouched)
    assert by_default < 0.02 * untouched and forward > untouched


def test_the_panel_says_what_each_direction_is_for():
    domain = field().GetProperty("Direction").SMProperty.FindDomain("vtkSMEnumerationDomain")
    said = {domain.GetEntryText(i): domain.GetInfoText(i)
            for i in range(domain.GetNumberOfEntries())}
    assert said == {"Forward": "to move points", "Backward": "to resample images"}, said


def test_states_keep_the_direction_that_they_stored():
    """Also one that was the default when they were saved."""
    for source in list(GetSources().values()):
        Delete(source)  # what lies in memory alone is no part of a state
    made = DeformationField(Input=FreeFormDeformation(Input=Wavelet()), Direction="Forward")
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "forward.pvsm")
        SaveState(name)
        for source in list(GetSources().values()):
            Delete(source)
        del made
        LoadState(name)
    loaded, = (source for source in GetSources().values()
               if source.GetXMLName() == "DeformationField")
    assert loaded.Direction == "Forward", loaded.Direction


def test_a_warped_grid_is_the_deformed_grid():
    grid = field(Direction="Forward", SampleGrid="Given Dimensions", Dimensions=[9, 9, 9])
    warped = WarpByVector(Input=grid, Vectors=["POINTS", "Displacement"])
    still = WarpByVector(Input=grid, Vectors=["POINTS", "Displacement"], ScaleFactor=0.0)
    moved = DeformGeometry(Input=still, Deformation=grid.Input)
    assert numpy.allclose(points_of(warped), points_of(moved), atol=1e-4)
    assert numpy.abs(points_of(warped) - points_of(still)).max() > 2.5


def test_glyphs_are_as_long_as_tissue_goes_far():
    grid = field(Direction="Forward", SampleGrid="Given Dimensions", Dimensions=[9, 9, 9])
    arrows = Glyph(Input=grid, GlyphType="Line", OrientationArray=["POINTS", "Displacement"],
                   ScaleArray=["POINTS", "Displacement"], ScaleFactor=1.0,
                   GlyphMode="All Points")
    arrows.UpdatePipeline()
    drawn = points_of(arrows).reshape(9 ** 3, -1, 3)
    lengths = numpy.linalg.norm(drawn.max(axis=1) - drawn.min(axis=1), axis=1)
    shifts = numpy.linalg.norm(voxels(grid, "Displacement").reshape(-1, 3), axis=1)
    assert lengths.argmax() == 4 * 81 + 4 * 9 + 4, "the middle of the grid is pulled furthest"
    straight = shifts > 0.1
    assert straight.sum() > 20
    assert numpy.ptp(lengths[straight] / shifts[straight]) < 1e-3


def test_a_contour_of_millimetres():
    """Displacement of half the pull: inside the ellipsoid, around its middle."""
    magnitude = Calculator(Input=field(Direction="Forward"), Function="mag(Displacement)",
                           ResultArrayName="mm")
    surface = points_of(Contour(Input=magnitude, ContourBy=["POINTS", "mm"],
                                Isosurfaces=[PULL / 2]))
    assert len(surface) > 100
    away = (surface - MIDDLE) / (10.0, 10.0, 14.0)
    assert numpy.linalg.norm(away, axis=1).max() < 1.0
    assert numpy.allclose(surface.mean(axis=0), MIDDLE, atol=0.3)


def test_fields_follow_strokes():
    bent = field()
    before = voxels(bent, "Displacement").copy()
    bent.Input.Strokes = STAMP + STAMP
    assert numpy.abs(voxels(bent, "Displacement") - before).max() > 1.0


run_tests(globals())
