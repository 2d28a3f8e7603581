# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.pick finds the tissue of Deformed Slices under a pixel. It takes the
# nearest plane that is seen there, also when the volume is bent, moved as an actor or has a
# direction matrix. It finds nothing where the picture shows nothing.
import numpy
from brainshift_testing import (load_plugin, look, picture, run_tests, view_along, volume)
from slices_testing import PLANES, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    ColorBy, Delete, FreeFormDeformation, GetColorTransferFunction, GetOpacityTransferFunction)

SIZE = 120
MIDDLE = numpy.array((16.0, 16.0, 16.0))
VIEWS = ((0, 0, -1), (0.6, 0.3, -0.7), (-0.5, 0.8, 0.4))
PIXELS = [(column, row) for row in range(4, SIZE, 13) for column in range(4, SIZE, 13)]
TURNED = (0.8, -0.6, 0, 0.6, 0.8, 0, 0, 0, 1)


def bright(nan=None):
    """33 voxels a side, all of them white; without a value in the box `nan`."""
    voxels = numpy.full((33, 33, 33), 100.0, numpy.float32)
    if nan:
        voxels[nan] = numpy.nan
    return voxels


def project(view, position):
    renderer = view.GetClientSideObject().GetRenderer()
    renderer.SetWorldPoint(*position, 1.0)
    renderer.WorldToDisplay()
    return numpy.array(renderer.GetDisplayPoint())


def check(view, display, on_plane, least):
    """A pixel is picked where something is drawn; it is where it says, and of all planes there it
    is the one in front."""
    shown = picture(view)
    found = 0
    for column, row in PIXELS:
        tissue = brainshift.pick(display, view, column, row)
        around = shown[row - 1:row + 2, column - 1:column + 2].max(axis=2) > 0.02
        if around.all() != around.any():
            continue  # an edge
        assert (tissue is not None) == bool(around.all()), (column, row, tissue)
        if tissue is not None:
            found += 1
            pixel = project(view, tissue)
            assert numpy.abs(pixel[:2] - (column + 0.5, row + 0.5)).max() < 0.01, (tissue, pixel)
            assert on_plane(numpy.array(tissue)), tissue
    assert found >= least, found


def both_projections(view, focus=MIDDLE):
    for parallel in (0, 1):
        view.CameraParallelProjection = parallel
        view.CameraParallelScale = 30.0
        for direction in VIEWS:
            look(view, direction, focus, 100.0, (0.1, 1.0, 0.2))
            yield


def test_the_plane_in_front():
    view = view_along((0, 0, -1), MIDDLE, 100.0, size=SIZE)
    place = numpy.array((13.0, 18.5, 16.0))
    display = show_slices(volume(bright()), view, tuple(PLANES), place)
    for _ in both_projections(view):
        def nearest(tissue):
            eye = numpy.array(view.CameraPosition)
            ahead = numpy.array(view.CameraFocalPoint) - eye
            ray = ahead if view.CameraParallelProjection else tissue - eye
            ray = ray / numpy.linalg.norm(ray)
            on = numpy.abs(tissue - place) < 1e-5
            # The ray meets no other plane inside the volume before it.
            for axis in numpy.flatnonzero(~on):
                if abs(ray[axis]) < 1e-6:
                    continue
                along = (tissue - place)[axis] / ray[axis]
                met = tissue - along * ray
                if along > 1e-6 and ((met > 1e-3) & (met < 32 - 1e-3)).all():
                    return False
            return on.any()
        check(view, display, nearest, 15)
    Delete(view)


def test_bent_tissue():
    # Tissue that was pulled out of the volume's box is picked there, nothing where it came from.
    bent = FreeFormDeformation(Input=volume(bright()), GuardFolding=0, Strokes=(
        brainshift.soft((32, 16, 16), (6, 0, 0), 14.0)
        + brainshift.soft((0, 16, 16), (5, 1, 0), 12.0)))
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=30.0, size=SIZE)
    display = show_slices(bent, view, ("Axial",), (16, 16, 15.2))
    check(view, display, lambda tissue: abs(tissue[2] - 15.2) < 1e-5, 20)
    scale = 60.0 / SIZE
    at = [round(SIZE / 2 + (x - 16) / scale) for x in (35.0, 1.5)]
    outside, emptied = (brainshift.pick(display, view, column, SIZE // 2) for column in at)
    assert outside is not None and outside[0] > 32.5, outside
    assert emptied is None, emptied
    Delete(view)


def test_a_turned_volume_and_a_moved_actor():
    source = volume(bright(), direction=TURNED)
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=40.0, size=SIZE)
    middle = numpy.array(TURNED).reshape(3, 3) @ MIDDLE
    display = show_slices(source, view, ("Sagittal",), middle)
    picture(view)
    normal = numpy.array(brainshift.slice_axes(display)[0][0])
    look(view, (-1, 0.1, 0), middle, 100.0, (0, 0, 1))
    check(view, display, lambda tissue: abs((tissue - middle) @ normal) < 1e-4, 10)
    display.Translation = [3.0, -2.0, 4.0]
    moved = middle + (3, -2, 4)
    check(view, display, lambda tissue: abs((tissue - moved) @ normal) < 1e-4, 10)
    Delete(view)


def test_what_cannot_be_seen_is_not_picked():
    # What lies behind is picked where a voxel has no value or no opacity.
    hole = (slice(8, 24), slice(8, 24), slice(0, 33))
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=30.0, size=SIZE)
    display = show_slices(volume(bright(hole)), view, ("Axial",), MIDDLE)
    check(view, display, lambda tissue: abs(tissue[2] - 16) < 1e-5, 10)
    assert brainshift.pick(display, view, SIZE // 2, SIZE // 2) is None
    voxels = bright()
    voxels[hole] = 0.0  # see-through
    display.Visibility = 0
    display = show_slices(volume(voxels), view, ("Axial",), MIDDLE)
    picture(view)
    assert brainshift.pick(display, view, SIZE // 2, SIZE // 2) is not None
    display.MapSliceOpacity = 1
    picture(view)
    assert brainshift.pick(display, view, SIZE // 2, SIZE // 2) is None
    assert brainshift.pick(display, view, SIZE // 2, SIZE // 2 - 30) is not None
    assert brainshift.pick(display, view, -1, 5) is None
    assert brainshift.pick(display, view, SIZE, 5) is None
    Delete(view)


def test_the_drawn_component_is_what_can_be_seen():
    """A colour map by the second component, or by the length of both, says what is transparent."""
    view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=30.0, size=SIZE)
    voxels = numpy.zeros((33, 33, 33, 2), numpy.float32)
    voxels[..., 1] = 100.0
    voxels[8:24, 8:24, 8:24, 1] = 0.0
    voxels[8:24, 8:24, 10:14, 0] = 100.0
    display = show_slices(volume(voxels), view, ("Axial",), MIDDLE)
    display.MapSliceOpacity = 1
    for name in ("1", "Magnitude"):
        ColorBy(display, ("POINTS", "Intensity", name), separate=True)
        color = GetColorTransferFunction("Intensity", display, separate=True)
        color.RGBPoints = [0, 1, 1, 1, 100, 1, 1, 1]
        opacity = GetOpacityTransferFunction("Intensity", display, separate=True)
        opacity.Points = [0, 0, 0.5, 0, 50, 0, 0.5, 0, 51, 1, 0.5, 0, 100, 1, 0.5, 0]
        check(view, display, lambda tissue: abs(tissue[2] - 16) < 1e-5, 10)
        seen = {x: brainshift.pick(display, view, SIZE // 2 + 2 * (x - 16), SIZE // 2) is not None
                for x in (4, 12, 20)}
        assert seen == {4: True, 12: name == "Magnitude", 20: False}, (name, seen)
    Delete(view)


run_tests(globals())
