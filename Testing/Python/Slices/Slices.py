# SPDX-License-Identifier: BSD-3-Clause
# Proves that "Deformed Slices" shows what ParaView's filter Slice shows of the baked volume, for
# strong bends, turned volumes and tissue that left the box. It is flat where a view looks along
# an axis, and filters as its property says.
import math

import numpy
from brainshift_testing import (SIZE, ball, data, load_plugin, mean_difference, object_pixels,
                                picture, run_tests, volume, voxels)
from slices_testing import (PLANES, cubic_spline, flat_view, pixel_positions, show_sliced,
                            show_slices, trilinear)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, Delete, FreeFormDeformation, OpenDataFile)

LARGEST_DIFFERENCE = 0.01  # mean, of full scale, over the object's pixels
BRIGHTEST = 512.0  # of the head
MIDDLE = (16.0, 16.0, 16.0)
LEVEL = 1.0 / 255.0


def random_voxels(side=13, seed=5):
    return numpy.random.default_rng(seed).uniform(0.0, 100.0, (side,) * 3).astype(numpy.float32)


def slice_picture(source, axis, half_height, middle=MIDDLE, **named):
    view = flat_view(axis, middle, half_height)
    plane = next(name for name, across in PLANES.items() if across == axis)
    display = show_slices(source, view, (plane,), middle)
    for name, value in named.items():
        setattr(display, name, value)
    image = picture(view)
    Delete(view)
    return image


def test_looks_like_slices_of_the_baked_volume():
    head = OpenDataFile(data("seg3d-utah", "seg3d_mr_t1.nii.gz"))
    head.UpdatePipeline()
    bounds = numpy.array(head.GetDataInformation().GetBounds()).reshape(3, 2)
    middle = bounds.mean(axis=1)
    strokes = (brainshift.soft(middle + (20, 10, 5), (-14, 9, 6), 60.0)
               + brainshift.stamp(middle + (0, 0, 60), middle, -15.0, major=70.0, minor=60.0)
               + brainshift.soft(middle - (25, 20, 0), (6, -12, 9), 50.0))
    bent = FreeFormDeformation(Input=head, Strokes=strokes)
    baked = BakeDeformation(Input=bent)
    bent.UpdatePipeline()
    bent.UpdatePropertyInformation()
    print(f"  moved by up to {bent.MaximumDisplacement:.1f} mm, least Jacobian determinant "
          f"{bent.MinimumJacobian:.2f}")
    for plane, axis in PLANES.items():
        images = []
        for shown in (bent, baked, head):
            view = flat_view(axis, middle, 110.0)
            if shown is bent:
                show_slices(shown, view, (plane,), middle, high=BRIGHTEST)
            else:
                show_sliced(shown, view, axis, middle, 0.0, BRIGHTEST)
            images.append(picture(view))
            Delete(view)
        deformed, expected, unbent = images
        difference = mean_difference(deformed, expected)
        control = mean_difference(unbent, expected)
        print(f"  {plane}: differs by {100 * difference:.2f} %, unbent by {100 * control:.2f} %, "
              f"object on {100 * object_pixels(expected).mean():.0f} %", flush=True)
        assert object_pixels(expected).mean() > 0.2
        assert difference < LARGEST_DIFFERENCE, (plane, difference)
        assert control > 4 * LARGEST_DIFFERENCE, (plane, control)


def rotation(axis, angle):
    """Row by row, as vtkImageData holds it."""
    x, y, z = numpy.asarray(axis) / numpy.linalg.norm(axis)
    skew = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew


def test_a_turned_volume_is_cut_across_its_own_axes():
    direction = rotation((1, -2, 0.5), 0.5)
    spacing, origin = numpy.array((1.0, 1.3, 0.8)), numpy.array((5.0, -4.0, 9.0))
    source = volume(ball(side=41, radius=14, edge=10), origin, spacing, direction.ravel())
    middle = origin + direction @ (spacing * 20)
    bent = FreeFormDeformation(Input=source, Strokes=brainshift.soft(middle, (6, 3, -4), 18.0))
    baked = voxels(BakeDeformation(Input=bent, Interpolation="Cubic"))
    position = middle + direction @ (spacing * (0.3, -2.6, 1.4))
    for plane, axis in PLANES.items():
        normal, up = direction[:, axis], direction[:, (axis + 1) % 3]
        view = flat_view(axis, position, 24.0)
        view.CameraPosition = list(position + 300 * normal)
        view.CameraViewUp = list(up)
        show_slices(bent, view, (plane,), position)
        deformed = picture(view)[:, :, 0]
        Delete(view)
        pixels = pixel_positions(numpy.cross(up, normal), up, position, 24.0)
        grid = (pixels - origin) @ direction / spacing
        expected, inside = trilinear(baked, grid)
        difference = numpy.abs(deformed - expected / 100)[inside].mean()
        unbent, _ = trilinear(ball(side=41, radius=14, edge=10), grid)
        control = numpy.abs(unbent - expected)[inside].mean() / 100
        print(f"  {plane}: differs by {100 * difference:.2f} %, unbent by {100 * control:.2f} %",
              flush=True)
        assert inside.mean() > 0.2
        assert difference < LARGEST_DIFFERENCE, (plane, difference)
        assert control > 4 * difference, (plane, control)


def test_axes_are_named_by_the_world():
    # The columns of the matrix: the volume's x runs along -z, y along x, z along -y.
    direction = (0, 1, 0, 0, 0, -1, -1, 0, 0)
    source = volume(ball(side=21), spacing=(1.0, 2.0, 3.0), direction=direction)
    view = flat_view(2, (20, -30, -10), 60.0, size=100)
    display = show_slices(source, view)
    picture(view)
    normals, steps = brainshift.slice_axes(display)
    assert numpy.allclose(normals, numpy.eye(3)), normals
    assert steps == (2.0, 3.0, 1.0), steps
    assert object_pixels(picture(view)).mean() > 0.05, "the axial plane faces an axial view"
    display.ShowAxial, display.ShowSagittal = 0, 1
    assert not picture(view).any(), "the sagittal plane is seen from the edge"
    Delete(view)


def test_tissue_that_left_the_box_is_drawn():
    # All control points move by (7, 0, -5) mm, so the picture moves and stays as it is otherwise.
    source = volume(random_voxels(side=33))
    moved = numpy.zeros((5, 5, 5, 3), numpy.float32)
    moved[...] = (7.0, 0.0, -5.0)
    lattice = volume(moved, spacing=(8.0,) * 3)
    bent = FreeFormDeformation(Input=source, Lattice=lattice, LatticeDimensions=[5, 5, 5])
    for axis in PLANES.values():
        expected = slice_picture(source, axis, 26.0)
        there = tuple(numpy.add(MIDDLE, (7.0, 0.0, -5.0)))
        image = slice_picture(bent, axis, 26.0, middle=there)
        beyond = slice_picture(bent, axis, 26.0)
        assert object_pixels(expected).mean() > 0.2
        differing = numpy.abs(image - expected).max()
        print(f"  across {axis}: at most {255 * differing:.1f} levels", flush=True)
        assert differing <= 2.5 * LEVEL, (axis, differing)
        assert mean_difference(beyond, expected) > 0.1


def test_nothing_outside_tissue():
    # The volume is white everywhere, so the picture shows the volume's box.
    source = volume(numpy.full((33, 33, 33), 100.0, numpy.float32))
    image = slice_picture(source, 2, 32.0)
    lit = object_pixels(image)
    assert abs(lit.sum() - (SIZE / 2) ** 2) <= 2 * SIZE, lit.sum()
    assert (image[lit] == 1.0).all()
    bent = FreeFormDeformation(Input=source, Strokes=brainshift.soft((16, 30, 16), (0, 7, 0), 9.0))
    pulled = object_pixels(slice_picture(bent, 2, 32.0))
    assert (pulled | ~lit).all(), "no hole where it was"
    x, y, _ = pixel_positions((1, 0, 0), (0, 1, 0), MIDDLE, 32.0).transpose(2, 0, 1)
    above, near = y > 33.0, numpy.abs(x - 16) < 9.0
    assert pulled[above & near].sum() > 500, "tissue pulled out of the box is drawn"
    assert not pulled[above & ~near].any(), "and nothing beside it"


def test_a_flat_view_shows_a_flat_slice():
    source = FreeFormDeformation(Input=volume(random_voxels(side=33)),
                                 Strokes=brainshift.soft(MIDDLE, (3, 2, 1), 14.0))
    alone = slice_picture(source, 2, 20.0)
    view = flat_view(2, MIDDLE, 20.0)
    view.InteractionMode = "2D"
    display = show_slices(source, view, ("Axial",), MIDDLE)
    assert (picture(view) == alone).all(), "interaction in 2D"
    view.CameraPosition = [16.0, 16.0, 900.0]
    assert numpy.abs(picture(view) - alone).max() <= LEVEL, "from farther away"
    display.ShowSagittal = display.ShowCoronal = 1
    lines = (numpy.abs(picture(view) - alone).max(axis=2) > LEVEL).mean()
    assert lines < 0.02, f"planes seen from the edge cover {lines} of the picture"
    Delete(view)


def zoomed(interpolation):
    """A few random voxels, 20 pixels each, and the grid coordinates of the pixels."""
    voxel = random_voxels()
    middle = (6.0, 6.0, 6.3)
    image = slice_picture(volume(voxel), 2, 7.5, middle, SliceInterpolation=interpolation)
    grid = pixel_positions((1, 0, 0), (0, 1, 0), middle, 7.5)
    inside = ((grid >= 1) & (grid <= 11)).all(axis=-1)
    return voxel, image[:, :, 0] * 100, grid, inside


def test_linear_interpolation_at_the_pixel():
    voxel, image, grid, inside = zoomed("Linear")
    expected, _ = trilinear(voxel, grid)
    assert numpy.abs(image - expected)[inside].max() < 0.8, "of 100; a filter has 8 bits of share"


def test_cubic_interpolation_is_the_spline():
    voxel, image, grid, inside = zoomed("Cubic")
    expected = cubic_spline(voxel, grid)
    linear, _ = trilinear(voxel, grid)
    assert numpy.abs(image - expected)[inside].max() < 0.8
    assert numpy.abs(linear - expected)[inside].max() > 10, "cubic must be told from linear"
    # Without jagged edges, the slope changes little from pixel to pixel.
    bend = [numpy.abs(numpy.diff(values, 2, axis=1))[:, 40:260].max() for values in (image, linear)]
    assert bend[0] < 0.3 * bend[1], bend


def test_nearest_interpolation_shows_voxels():
    voxel, image, grid, inside = zoomed("Nearest")
    x, y, z = numpy.rint(grid).astype(int).clip(0, 12).transpose(2, 0, 1)
    off_edges = (numpy.abs(grid - numpy.floor(grid) - 0.5)[..., :2] > 0.05).all(axis=-1)
    assert numpy.abs(image - voxel[z, y, x])[inside & off_edges].max() < 0.5


def test_cells_are_cut_too():
    voxel = random_voxels()
    view = flat_view(2, (6.5, 6.5, 6.5), 7.0)
    show_slices(volume(voxel, cells=True), view, ("Axial",), (6.5, 6.5, 6.5), association="CELLS")
    image = picture(view)[:, :, 0] * 100
    Delete(view)
    grid = pixel_positions((1, 0, 0), (0, 1, 0), (6.5, 6.5, 6.5), 7.0) - 0.5
    expected, inside = trilinear(voxel, grid)
    assert numpy.abs(image - expected)[inside].max() < 0.8


run_tests(globals())
