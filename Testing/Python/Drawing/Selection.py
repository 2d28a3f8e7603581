# SPDX-License-Identifier: BSD-3-Clause
# Proves that a selection takes the cells and points of surfaces that are seen beside a Deformed
# Volume. It takes all of them in front of the volume, beside it, and behind tissue that is less
# than half opaque. It takes none behind tissue that is more opaque.
import numpy
from brainshift_testing import (SIZE, ball, load_plugin, look, output, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    ClearSelection, Delete, FreeFormDeformation, Hide, Render, SelectSurfaceCells,
    SelectSurfacePoints, Show, Sphere)
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 1, 0.3, 100, 0, 1, 0.3]
OPAQUE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
FAINT = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 0.01, 0.5, 0, 100, 0.01, 0.5, 0]
FRONT, BEHIND, BESIDE = (16, 16, 30), (16, 16, 2), (16, 29, 2)


class Scene:
    """A ball seen along -z, and a small sphere."""

    def __init__(self, opacities, strokes=()):
        self.source = FreeFormDeformation(Input=volume(ball()), Strokes=list(strokes))
        self.view = view_along((0, 0, -1), MIDDLE, 100.0, half_height=18.0)
        self.display = show_volume(self.source, self.view, "Deformed Volume", COLORS, opacities)
        self.sphere = Sphere(Radius=2.0, ThetaResolution=16, PhiResolution=16)
        Show(self.sphere, self.view)
        Render(self.view)  # selecting calls it, and the first one of a session moves the camera
        look(self.view, (0, 0, -1), MIDDLE, 100.0)
        self.view.CameraParallelScale = 18.0

    def selected(self, select, place):
        """Numbers of what is selected of the sphere, put at a place, in all of the view."""
        self.sphere.Center = list(place)
        before = picture(self.view)
        select(Rectangle=[0, 0, SIZE - 1, SIZE - 1], View=self.view)
        assert self.source.GetSelectionInput(0) is None, "the volume is selected"
        numbers = identifiers(self.sphere.GetSelectionInput(0))
        ClearSelection(self.sphere)
        # One level: other clipping planes may round otherwise.
        changes = 255 * numpy.abs(picture(self.view) - before).max()
        assert changes < 1.5, f"selecting changed the picture by {changes} levels"
        return numbers

    def selected_without_volume(self, select, place):
        Hide(self.source, self.view)
        numbers = self.selected(select, place)
        Show(self.source, self.view)
        return numbers


def identifiers(selection):
    """The second of each pair (process, number) in what was selected; sorted."""
    if selection is None or selection.GetProperty("Input").GetNumberOfProxies() == 0:
        return []
    pairs = selection.GetProperty("Input").GetProxy(0).GetProperty("IDs")
    return sorted(pairs.GetElement(i) for i in range(1, pairs.GetNumberOfElements(), 2))


def check(scene, seen_at, hidden_at, selections=(SelectSurfaceCells, SelectSurfacePoints)):
    for select in selections:
        for place in (*seen_at, *hidden_at):
            all_of_it = scene.selected_without_volume(select, place)
            assert len(all_of_it) > 40, (select.__name__, place, all_of_it)
            found = scene.selected(select, place)
            expected = all_of_it if place in seen_at else []
            assert found == expected, (select.__name__, place, len(found), len(all_of_it))
    Delete(scene.view)


def test_opaque_tissue_hides():
    check(Scene(OPAQUE), (FRONT, BESIDE), (BEHIND,), [SelectSurfaceCells])


def test_opaque_tissue_hides_points():
    # In ParaView's selection a point on a silhouette has no depth, so later drawing may hide it. So
    # only points that face the eye are counted.
    scene = Scene(OPAQUE)
    for place in (FRONT, BESIDE, BEHIND):
        found = scene.selected(SelectSurfacePoints, place)
        heights = vtk_to_numpy(output(scene.sphere).GetPoints().GetData())[:, 2] - place[2]
        facing = set(numpy.flatnonzero(heights > 0.5).tolist())
        expected = set() if place == BEHIND else facing
        assert expected <= set(found), (place, expected - set(found))
        assert len(found) < 2 * len(expected) + 1, (place, len(found), len(expected))


def test_faint_tissue_does_not():
    check(Scene(FAINT), seen_at=(FRONT, BESIDE, BEHIND), hidden_at=())


def test_moved_tissue_hides_where_it_is_seen():
    up = brainshift.soft(MIDDLE, (0, 13, 0), 500.0, sigma=50.0)
    check(Scene(OPAQUE, up), seen_at=(FRONT, (16, 14, 2)), hidden_at=(BESIDE,),
          selections=[SelectSurfaceCells])


def test_a_part_that_sticks_out():
    # Half of a sphere stands out behind the ball. Only that half is selected.
    scene = Scene(OPAQUE)
    place = (16, 25, 2)
    whole = scene.selected_without_volume(SelectSurfaceCells, place)
    part = scene.selected(SelectSurfaceCells, place)
    assert 0.2 * len(whole) < len(part) < 0.8 * len(whole), (len(part), len(whole))
    assert set(part) <= set(whole)


run_tests(globals())
