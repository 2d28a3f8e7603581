# SPDX-License-Identifier: BSD-3-Clause
# Proves that several volumes in one view, ours and those of ParaView, are drawn from back to
# front in whatever order they were added.
import numpy
from brainshift_testing import (ball, load_plugin, mean_difference, picture, run_tests, show_volume,
                                view_along, volume)

load_plugin()
from paraview.simple import Delete, Hide, Show  # noqa: E402 after the plugin

RED = [0, 1, 0, 0, 100, 1, 0, 0]
GREEN = [0, 0, 1, 0, 100, 0, 1, 0]
CURVES = {"opaque": [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0],
          "translucent": [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 0.05, 0.5, 0, 100, 0.05, 0.5, 0]}
BETWEEN = (19.0, 16.0, 31.0)
DIRECTIONS = {"opaque": (0, 0, -1), "translucent": (0.3, -0.2, 1)}
STOCK, OURS = "Volume", "Deformed Volume"


def two_balls(kinds, order, curve, direction):
    """A red ball, and a green one 30 mm above it and 6 mm aside, of the kinds given."""
    view = view_along(direction, BETWEEN, 150.0, half_height=20.0, size=80)
    shown = {}
    for i in order:
        shown[i] = volume(ball(), origin=((0, 0, 0), (6, 0, 30))[i])
        show_volume(shown[i], view, kinds[i], (RED, GREEN)[i], curve)
    return view, shown


def far_and_near(direction):
    return (0, 1) if direction[2] < 0 else (1, 0)


def test_two_volumes():
    for name, direction in DIRECTIONS.items():
        curve = CURVES[name]
        # ParaView's own volumes are right if added from back to front.
        view, _ = two_balls((STOCK, STOCK), far_and_near(direction), curve, direction)
        expected = picture(view)
        Delete(view)
        view, _ = two_balls((STOCK, STOCK), far_and_near(direction)[::-1], curve, direction)
        wrong = mean_difference(picture(view), expected)
        Delete(view)
        assert wrong > 0.03, "the order must matter"
        for kinds in ((OURS, OURS), (OURS, STOCK), (STOCK, OURS)):
            for order in ((0, 1), (1, 0)):
                view, _ = two_balls(kinds, order, curve, direction)
                difference = mean_difference(picture(view), expected)
                assert difference < 0.002, (name, direction, kinds, order, difference)
                Delete(view)


def test_turned_half_around():
    view, _ = two_balls((OURS, OURS), (0, 1), CURVES["opaque"], (0, 0, 1))
    assert numpy.array_equal(picture(view)[40, 40], (1, 0, 0)), "red is in front"
    camera = view.CameraPosition
    view.CameraPosition = [camera[0], camera[1], 2 * BETWEEN[2] - camera[2]]
    assert numpy.array_equal(picture(view)[40, 40], (0, 1, 0)), "green is in front"
    Delete(view)


def test_one_hidden():
    view, shown = two_balls((OURS, OURS), (0, 1), CURVES["opaque"], (0, 0, -1))
    assert numpy.array_equal(picture(view)[40, 40], (0, 1, 0))
    Hide(shown[1], view)
    assert numpy.array_equal(picture(view)[40, 40], (1, 0, 0))
    Show(shown[1], view)
    assert numpy.array_equal(picture(view)[40, 40], (0, 1, 0))
    Delete(view)


def test_views_without_ours_stay_as_paraview_draws_them():
    # They were added from front to back and stay in that order.
    view, _ = two_balls((STOCK, STOCK), (1, 0), CURVES["opaque"], (0, 0, -1))
    assert numpy.array_equal(picture(view)[40, 40], (1, 0, 0))


run_tests(globals())
