# SPDX-License-Identifier: BSD-3-Clause
# Proves that ShowCrosshair draws, in each slice, where the other two slices cut it: at
# SlicePosition, within a pixel, in the colours of those slices, also beside the tissue, alike on
# both sides. A view is named for its slice in the slice's colour, and the colour-blind can tell
# the colours apart.
import itertools

import numpy
from brainshift_testing import ball, load_plugin, look, picture, run_tests, view_along, volume
from slices_testing import PLANES, flat_view, show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import Delete, FreeFormDeformation, Show, Sphere  # noqa: E402
from vtkmodules.vtkCommonCore import vtkCollection  # noqa: E402

SIZE = 200
HALF = 20.0  # mm, half a view's height
NEAR = 1.0 + 1e-6  # pixel: a middle at the edge of a line counts or not, by the driver
MIDDLE = (16.0, 16.0, 16.0)
POSITION = (12.3, 19.1, 14.6)
NAMES = ("Sagittal", "Coronal", "Axial")  # across x, y, z
STROKE = brainshift.soft(MIDDLE, (2, 1, 0), 12)

#: What people without red, green or blue cones see of linear red, green and blue: Vienot, Brettel
#: and Mollon (1999) for the first two, Machado, Oliveira and Fernandes (2009) for the third.
BLIND = {
    "protan": [[0.11238, 0.88762, 0.0], [0.11238, 0.88762, 0.0], [0.00401, -0.00401, 1.0]],
    "deutan": [[0.29275, 0.70725, 0.0], [0.29275, 0.70725, 0.0], [-0.02234, 0.02234, 1.0]],
    "tritan": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
               [0.004733, 0.691367, 0.303900]],
}


def marked_lines(axis, source, position=POSITION):
    """Pixels that the crosshair colours in a flat view across an axis, and their colours."""
    view = flat_view(axis, MIDDLE, HALF, size=SIZE)
    display = show_slices(source, view, (NAMES[axis],), position)
    plain = picture(view)
    display.ShowCrosshair = 1
    drawn = picture(view)
    Delete(view)
    changed = (drawn != plain).any(axis=2)
    changed[SIZE - 30:, :90] = False  # the name
    return changed, drawn, plain


def colors():
    """Of the planes, seen where a line is drawn: by axis (x, y, z)."""
    found = {}
    for axis in range(3):
        right, up = (other for other in range(3) if other != axis)
        changed, drawn, _ = marked_lines(axis, volume(ball()))
        columns, rows = changed.sum(axis=0), changed.sum(axis=1)
        upright = drawn[changed[:, int(columns.argmax())], int(columns.argmax())]
        level = drawn[int(rows.argmax()), changed[int(rows.argmax())]]
        for other, pixels in ((right, upright), (up, level)):
            color = numpy.median(pixels, axis=0)
            assert numpy.allclose(found.setdefault(other, color), color, atol=0.02), (axis, other)
    return [found[axis] for axis in range(3)]


def test_lines_lie_at_the_position():
    # To the right in a view across x is y (or -y), and so on; a row counts upwards.
    for axis in range(3):
        view = flat_view(axis, MIDDLE, HALF, size=SIZE)
        camera = view.GetActiveCamera()
        up = numpy.array(camera.GetViewUp())
        right = numpy.cross(camera.GetDirectionOfProjection(), up)
        Delete(view)
        for source in (volume(ball()), FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)):
            changed, _, _ = marked_lines(axis, source)
            offset = numpy.subtract(POSITION, MIDDLE)
            column = SIZE / 2 + offset @ right / (2 * HALF) * SIZE
            row = SIZE / 2 + offset @ up / (2 * HALF) * SIZE
            columns, rows = changed.sum(axis=0), changed.sum(axis=1)
            assert abs(columns.argmax() + 0.5 - column) <= NEAR, (axis, columns.argmax(), column)
            assert abs(rows.argmax() + 0.5 - row) <= NEAR, (axis, rows.argmax(), row)
            assert columns.max() > 0.6 * SIZE and rows.max() > 0.6 * SIZE, "beside the tissue too"
            assert (columns > SIZE / 4).sum() <= 2, "a line is thin"
            near = changed[int(row) - 5:int(row) + 6, int(column) - 5:int(column) + 6]
            assert not near.any(), "the tissue where the lines meet is seen"


def test_arms_are_alike():
    """Wherever the middle is in its pixel: two pixels wide, and as far from the middle."""
    for part in numpy.arange(0.0, 1.0, 0.125):
        position = numpy.add(MIDDLE, (part * 0.2, (part + 0.2) * 0.2, 0.0))
        changed, _, _ = marked_lines(2, volume(ball()), position)
        changed = changed[40:160, 40:160]
        ends = []
        for count, lines in ((changed.sum(axis=0), changed), (changed.sum(axis=1), changed.T)):
            wide = numpy.flatnonzero(count > 60)
            assert len(wide) == 2 and wide[1] == wide[0] + 1, (part, wide)
            arm = numpy.flatnonzero(lines[:, wide[0]])
            ends.append((wide.sum(), arm[:-1][numpy.diff(arm) > 1][0] + arm[1:][
                numpy.diff(arm) > 1][0]))
        (column, rows), (row, columns) = ends
        assert rows == row and columns == column, (part, ends, "the gap is in the middle")


def test_lines_are_as_wide_on_any_screen():
    """A screen at 200 % has twice the pixels in the same place."""
    widths = {}
    for dots in (72, 144):
        view = flat_view(2, MIDDLE, HALF, size=SIZE)
        view.PPI = dots
        display = show_slices(volume(numpy.zeros((33, 33, 33))), view, ("Axial",), POSITION)
        assert not picture(view).any()
        display.ShowCrosshair = 1
        lines = picture(view).any(axis=2)[SIZE // 4:SIZE // 2, :SIZE // 3]  # the level one
        upright = picture(view).any(axis=2)[SIZE // 4 - 20:SIZE // 4, SIZE // 4:3 * SIZE // 4]
        widths[dots] = (lines.sum(axis=0).max(), upright.sum(axis=1).max())
        Delete(view)
    assert max(widths[72]) == 2 and max(widths[144]) == 4, widths


def test_the_colour_blind_can_tell_the_planes():
    planes = numpy.array(colors())
    linear = numpy.where(planes <= 0.04045, planes / 12.92, ((planes + 0.055) / 1.055) ** 2.4)
    for name, matrix in {"all": numpy.eye(3), **BLIND}.items():
        seen = lab(numpy.clip(linear @ numpy.array(matrix).T, 0, 1))
        for first, second in itertools.combinations(range(3), 2):
            difference = numpy.linalg.norm(seen[first] - seen[second])
            assert difference > 30, (name, NAMES[first], NAMES[second], difference)


def lab(linear):
    """CIELAB of linear sRGB; a difference of 2 is just seen."""
    xyz = linear @ numpy.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722],
                                [0.0193, 0.1192, 0.9505]]).T / (0.9505, 1.0, 1.089)
    root = numpy.where(xyz > 0.008856, numpy.cbrt(xyz), 7.787 * xyz + 16 / 116)
    x, y, z = root.T
    return numpy.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=1)


def test_a_view_is_named_in_the_colour_of_its_plane():
    planes = colors()
    source = volume(numpy.zeros((33, 33, 33), numpy.float32))
    for name, axis in PLANES.items():
        view = flat_view(axis, MIDDLE, HALF, size=SIZE)
        display = show_slices(source, view, (name,), POSITION)
        assert not picture(view).any()
        display.ShowCrosshair = 1
        corner = picture(view)[SIZE - 30:, :90]
        close = numpy.abs(corner - planes[axis]).max(axis=2) < 0.1
        assert close.sum() > 30, (name, close.sum())
        setattr(display, f"Show{name}", 0)
        assert not picture(view)[SIZE - 30:, :90].any(), "no plane, no name"
        Delete(view)


def test_an_oblique_view_shows_lines_on_all_planes():
    source = volume(numpy.zeros((33, 33, 33), numpy.float32))
    view = view_along((-1, -1, -1), MIDDLE, 200.0, half_height=HALF, size=SIZE)
    display = show_slices(source, view, NAMES, MIDDLE)
    assert not picture(view).any()
    display.ShowCrosshair = 1
    for opacity in (1.0, 0.5):
        display.Opacity = opacity
        seen = picture(view)
        for color in colors():
            assert (numpy.abs(seen - color).max(axis=2) < 0.1).sum() > 20, (opacity, color)
    look(view, (0, 0, -1), MIDDLE, 200.0)
    Delete(view)


def test_lines_are_no_number_to_a_selection():
    view = flat_view(2, MIDDLE, HALF, size=60)
    display = show_slices(volume(ball()), view, ("Axial",), MIDDLE)
    display.ShowCrosshair = 1
    Show(Sphere(Center=(16.0, 16.0, 8.0), Radius=5.0), view)
    picture(view)
    representations, sources = vtkCollection(), vtkCollection()
    view.SMProxy.SelectSurfaceCells([0, 0, 59, 59], representations, sources, 0)
    assert sources.GetNumberOfItems() == 0
    Delete(view)


run_tests(globals())
