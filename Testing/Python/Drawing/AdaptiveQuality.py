# SPDX-License-Identifier: BSD-3-Clause
# Proves that drawing fewer pixels while the view moves changes neither the brightness nor the
# still picture.
import brainshift_testing as testing

testing.load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import FreeFormDeformation  # noqa: E402

MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 1, 0, 100, 0, 1, 0]
TRANSLUCENT = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.1, 0.5, 0]


def drawn():
    filter = FreeFormDeformation(Input=testing.volume(testing.ball()))
    filter.Strokes = brainshift.soft(MIDDLE, (3, 0, 0), 12)
    view = testing.view_along((0, 0, -1), MIDDLE, 100.0, half_height=16.0)
    display = testing.show_volume(filter, view, "Deformed Volume", COLORS, TRANSLUCENT)
    return display, view, still_picture(view)


def still_picture(view):
    view.SMProxy.StillRender()
    return testing.on_screen(view)


def moving(view):
    """The picture while the camera moves: the second one, which knows what the first one cost."""
    for _ in range(2):
        view.SMProxy.GetClientSideObject().InteractiveRender()
    return testing.on_screen(view)


def test_the_still_picture_is_whole_again():
    display, view, still = drawn()
    moving(view)
    assert (still_picture(view) == still).all()
    assert brainshift.counters(display)["imageScale"] == 1


def test_a_stroke_is_seen_while_moving_above_the_lod_threshold():
    # There ParaView delivers only stand-ins of the data, and a volume has none.
    display, view, _ = drawn()
    view.LODThreshold = 0
    view.SMProxy.StillRender()
    display.Input.Strokes = brainshift.soft(MIDDLE, (0, 3, 0), 12)
    view.SMProxy.InteractiveRender()
    moving_picture = testing.on_screen(view)
    assert brainshift.counters(display)["latticeUploads"] == 2
    assert abs(moving_picture.mean() - still_picture(view).mean()) < 0.05 * moving_picture.mean()
    assert moving_picture.max() > 50


def test_moving_keeps_the_brightness():
    display, view, still = drawn()
    seen = moving(view)
    scale = brainshift.counters(display)["imageScale"]
    print(f"{scale} screen pixels a side for one; mean {seen.mean():.3f}, still {still.mean():.3f}")
    assert abs(seen.mean() - still.mean()) < 0.02 * still.mean()


def test_switched_off_all_pixels_are_drawn_always():
    display, view, still = drawn()
    display.AdaptiveQuality = 0
    assert (moving(view) == still).all()


if __name__ == "__main__":
    testing.run_tests(globals())
