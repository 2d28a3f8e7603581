# SPDX-License-Identifier: BSD-3-Clause
# Proves that brainshift.pick finds where the tissue under a pixel is. It differs by less than
# half a voxel from the answer of the CPU, finds nothing on the background, and draws nothing.
import numpy
from brainshift_testing import (ball, load_plugin, look, picture, run_tests, show_volume,
                                view_along, volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import BakeDeformation, FreeFormDeformation  # noqa: E402

SIZE = 150  # edge of a picture, pixels
SIDE = 33
RADIUS = 9.0
MIDDLE = numpy.array((16.0, 16.0, 16.0))
VIEWS = ((0, 0, -1), (1, 0.2, -0.3), (-0.4, -0.7, 0.6))
UP = (0.1, 1.0, 0.2)
DISTANCE = 90.0
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
SURFACE = [0, 0, 0.5, 0, 49.9, 0, 0.5, 0, 50, 1, 0.5, 0, 100, 1, 0.5, 0]
HALF_A_VOXEL = 0.5
STEEPEST = 0.2  # cosine between ray and surface; below it a ray's hit means little


def ray(view, column, row):
    """Where the ray through the middle of a pixel starts (mm), and its direction."""
    eye, focus = numpy.array(view.CameraPosition), numpy.array(view.CameraFocalPoint)
    ahead = (focus - eye) / numpy.linalg.norm(focus - eye)
    right = numpy.cross(ahead, view.CameraViewUp)
    right /= numpy.linalg.norm(right)
    across, upwards = (2 * (index + 0.5) / SIZE - 1 for index in (column, row))
    aside = across * right + upwards * numpy.cross(right, ahead)
    if view.CameraParallelProjection:
        return eye + view.CameraParallelScale * aside, ahead
    direction = ahead + numpy.tan(numpy.radians(view.CameraViewAngle / 2)) * aside
    return eye, direction / numpy.linalg.norm(direction)


def sphere_hit(start, direction, center):
    """Where a ray enters the ball; None if it misses it or only grazes it."""
    along = (center - start) @ direction
    half_squared = RADIUS ** 2 - ((center - start) ** 2).sum() + along ** 2
    if half_squared < (STEEPEST * RADIUS) ** 2:
        return None
    return start + (along - numpy.sqrt(half_squared)) * direction


def pixels(apart):
    return [(column, row) for row in range(3, SIZE, apart) for column in range(3, SIZE, apart)]


def both_projections(view):
    view.CameraParallelScale = 20.0
    for parallel in (0, 1):
        view.CameraParallelProjection = parallel
        for direction in VIEWS:
            look(view, direction, MIDDLE, DISTANCE, UP)
            picture(view)
            yield f"{'parallel' if parallel else 'perspective'} along {direction}"


def shown(strokes, edge=2.0):
    filter = FreeFormDeformation(Input=volume(ball(SIDE, RADIUS, edge=edge)), Strokes=strokes)
    view = view_along((0, 0, -1), MIDDLE, DISTANCE, UP, size=SIZE)
    display = show_volume(filter, view, "Deformed Volume", COLORS, SURFACE)
    picture(view)
    return filter, view, display


def test_a_moved_ball():
    shift = numpy.array((3.3, -2.1, 1.7))
    # The stroke is so wide that all of the lattice moves alike.
    _, view, display = shown(brainshift.soft(MIDDLE, shift, 4000.0, sigma=100.0))
    for what in both_projections(view):
        misses = []
        for column, row in pixels(8):
            expected = sphere_hit(*ray(view, column, row), MIDDLE + shift)
            if expected is not None:
                found = brainshift.pick(display, view, column, row)
                assert found is not None, (what, column, row)
                misses.append(numpy.linalg.norm(expected - found))
        print(f"  {what}: at most {max(misses):.3f} voxels, mean {numpy.mean(misses):.3f}; "
              f"{len(misses)} pixels", flush=True)
        assert len(misses) > 30 and max(misses) < HALF_A_VOXEL, (what, max(misses))


def test_a_camera_that_moved_on():
    """A pick is of the picture that is seen, not of the one that the camera would see now."""
    _, view, display = shown(())
    asked = [pixel for pixel in pixels(8) if brainshift.pick(display, view, *pixel) is not None]
    seen = [brainshift.pick(display, view, *pixel) for pixel in asked]
    camera = view.GetActiveCamera()
    camera.Azimuth(40)
    camera.Zoom(1.5)
    camera.SetClippingRange(1, 500)
    assert len(asked) > 30
    assert numpy.array_equal(seen, [brainshift.pick(display, view, *pixel) for pixel in asked])


def marched(intensity, start, direction):
    """Where the intensity (voxels [z, y, x], linear between them) first reaches 50; or None."""
    t = numpy.arange(DISTANCE - 30, DISTANCE + 30, 0.02)
    positions = start + t[:, None] * direction
    positions = positions[((positions >= 0) & (positions < SIDE - 1)).all(axis=1)]
    low = numpy.floor(positions).astype(int)
    within = positions - low
    values = numpy.zeros(len(positions))
    for corner in numpy.ndindex(2, 2, 2):
        x, y, z = (low + corner).T
        values += numpy.prod(numpy.where(corner, within, 1 - within), axis=1) * intensity[z, y, x]
    hits = numpy.flatnonzero(values >= 50)
    return positions[hits[0]] if len(hits) else None


def test_a_bent_ball_right_after_strokes():
    filter, view, display = shown((), edge=8.0)  # so wide that baking does not blur it
    strokes = ()
    for anchor, amount in (((16, 16, 24), -5.0), ((25, 18, 14), 4.0), ((10, 12, 18), -4.0)):
        strokes += brainshift.stamp(anchor, MIDDLE, amount, major=20.0, minor=16.0)
        filter.Strokes = strokes
        look(view, VIEWS[1], MIDDLE, DISTANCE, UP)
        picture(view)
        baked = voxels(BakeDeformation(Input=filter, Interpolation="Cubic"))
        misses, disagreed = [], 0  # they may disagree where a ray touches the silhouette
        for column, row in pixels(7):
            expected = marched(baked, *ray(view, column, row))
            found = brainshift.pick(display, view, column, row)
            if expected is not None and found is not None:
                misses.append(numpy.linalg.norm(expected - found))
            disagreed += (expected is None) != (found is None)
        print(f"  {len(strokes) // 14} strokes: at most {max(misses):.3f} voxels, mean "
              f"{numpy.mean(misses):.3f}; {len(misses)} pixels, {disagreed} disagree", flush=True)
        assert len(misses) > 30 and disagreed <= 1, disagreed
        assert max(misses) < HALF_A_VOXEL, max(misses)


def test_background_is_nothing():
    _, view, display = shown(())
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 20.0
    picture(view)
    for column, row in ((0, 0), (SIZE - 1, 0), (SIZE // 2, SIZE - 1), (5, SIZE // 2)):
        assert brainshift.pick(display, view, column, row) is None, (column, row)
    for column, row in ((-1, 5), (SIZE, 5), (5, -1), (5, SIZE), (10 ** 6, 10 ** 6)):
        assert brainshift.pick(display, view, column, row) is None, "beyond the view"
    assert brainshift.pick(display, view, SIZE // 2, SIZE // 2) is not None


def test_picking_draws_nothing():
    _, view, display = shown(())
    before = brainshift.counters(display)
    for column, row in pixels(20):
        brainshift.pick(display, view, column, row)
    assert brainshift.counters(display) == before


def test_a_view_that_does_not_show_it():
    _, _, display = shown(())
    other = view_along((0, 0, -1), MIDDLE, DISTANCE, size=SIZE)
    try:
        brainshift.pick(display, other, 5, 5)
    except ValueError as error:
        assert "not shown in this view" in str(error), error
    else:
        raise AssertionError("a view without the representation is accepted")


run_tests(globals())
