# SPDX-License-Identifier: BSD-3-Clause
# Proves that the module brainshift writes strokes as documented, says what is wrong with its
# arguments, and that the renderer does again only what changed.
import math

from brainshift_testing import (ball, load_plugin, look, picture, run_tests, show_volume,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (CreatePiecewiseFunction, FreeFormDeformation,  # noqa: E402
                             GetOpacityTransferFunction)

MIDDLE = (16.0, 16.0, 16.0)
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
OPACITIES = [0, 0, 0.5, 0, 50, 0, 0.5, 0, 100, 1, 0.5, 0]


def expect_refused(words, function, *arguments, **named):
    try:
        function(*arguments, **named)
    except ValueError as error:
        for word in words:
            assert word in str(error), (word, str(error))
    else:
        raise AssertionError(f"{function.__name__} accepts {arguments} {named}")


def test_strokes_are_fourteen_numbers():
    assert brainshift.move((1, 2, 3), (4, 5, 6)) == (
        0, 1, 2, 3, 4, 5, 6, 0, 0, 0, 0, 0, 0.5, 1)
    assert brainshift.move((1, 2, 3), (4, 5, 6), spacing=(7, 8, 9)) == (
        0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 0, 0.5, 1)
    assert brainshift.soft((1, 2, 3), (4, 5, 6), 20, sigma=0.3) == (
        1, 1, 2, 3, 4, 5, 6, 0, 0, 0, 20, 0, 0.3, 1)
    assert brainshift.NUMBERS_PER_STROKE == 14


def test_stamp_pulls_away_from_the_point_of_interest():
    stroke = brainshift.stamp((0, 0, 10), (0, 0, 0), 5, major=40, minor=20, sigma=0.4)
    assert stroke == (2, 0, 0, 10, 0, 0, 5, 0, 0, -1, 40, 20, 0.4, 1)
    push = brainshift.stamp((0, 0, 10), (0, 0, 0), -5)
    assert push[4:7] == (0, 0, -5)
    slanted = brainshift.stamp((3, 4, 0), (0, 0, 0), 10)
    assert all(math.isclose(a, b, abs_tol=1e-12) for a, b in zip(slanted[4:7], (6, 8, 0)))


def test_bad_arguments_are_named():
    expect_refused(["anchor", "2 numbers", "3"], brainshift.move, (1, 2), (0, 0, 1))
    expect_refused(["vector", "finite"], brainshift.move, (1, 2, 3), (0, 0, math.nan))
    expect_refused(["radius", "-5", "above 0 mm"], brainshift.soft, (1, 2, 3), (0, 0, 1), -5)
    expect_refused(["sigma", "0.0", "above 0"], brainshift.soft, (1, 2, 3), (0, 0, 1), 5, sigma=0)
    expect_refused(["major", "inf"], brainshift.stamp, (1, 2, 3), (0, 0, 0), 5, major=math.inf)
    expect_refused(["minor", "0.0"], brainshift.stamp, (1, 2, 3), (0, 0, 0), 5, minor=0)
    expect_refused(["toward", "differ"], brainshift.stamp, (1, 2, 3), (1, 2, 3), 5)
    expect_refused(["amount"], brainshift.stamp, (1, 2, 3), (0, 0, 0), math.nan)


class Drawn:
    """A bent ball on the screen, and what the renderer did since the last look."""

    def __init__(self):
        self.filter = FreeFormDeformation(
            Input=volume(ball()), Strokes=brainshift.soft(MIDDLE, (2, 0, 0), 12))
        self.view = view_along((0, 0, -1), MIDDLE, 100)
        self.display = show_volume(
            self.filter, self.view, "Deformed Volume", COLORS, OPACITIES, shade=True)
        picture(self.view)
        self.before = brainshift.counters(self.display)

    def did(self):
        """What a new picture took, without the frame itself."""
        picture(self.view)
        now = brainshift.counters(self.display)
        done = {name: now[name] - self.before[name] for name in now}
        self.before = now
        assert done.pop("frames") > 0
        return {name: count for name, count in done.items() if count}


def test_a_first_picture_uploads_everything_once():
    drawn = Drawn()
    assert drawn.before["volumeUploads"] == 1, drawn.before
    assert drawn.before["latticeUploads"] == 1, drawn.before
    assert drawn.before["transferUploads"] >= 1, drawn.before
    assert drawn.before["texelsRefined"] >= 91 ** 3, drawn.before


def test_a_camera_move_uploads_nothing():
    drawn = Drawn()
    look(drawn.view, (1, -0.3, -1), MIDDLE, 90)
    assert drawn.did() == {}


def test_a_stroke_uploads_the_lattice_only():
    drawn = Drawn()
    drawn.filter.Strokes = brainshift.soft(MIDDLE, (3, 0, 0), 12)
    done = drawn.did()
    assert done.pop("latticeUploads") == 1, done
    assert done.pop("bytesUploaded") == 19 ** 3 * 3 * 4, done
    assert done.pop("texelsRefined") > 0, done
    assert done.pop("presenceUpdates") == 1, done
    assert done == {}, done


def test_another_opacity_map_is_noticed_even_if_it_is_older():
    drawn = Drawn()
    older = CreatePiecewiseFunction(Points=[0, 0, 0.5, 0, 30, 0, 0.5, 0, 100, 0.5, 0.5, 0])
    drawn.display.LookupTable.RGBPoints = [0, 0, 0, 1, 100, 1, 0, 0]  # now the newest of all
    drawn.did()
    drawn.display.ScalarOpacityFunction = older
    assert drawn.did().get("transferUploads") == 1


def test_an_opacity_edit_uploads_the_map_only():
    drawn = Drawn()
    opacity = GetOpacityTransferFunction("Intensity", drawn.display, separate=True)
    opacity.Points = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 100, 0.5, 0.5, 0]
    done = drawn.did()
    assert done.pop("transferUploads") == 1, done
    assert done.pop("bytesUploaded") > 0, done
    assert done.pop("presenceUpdates") == 1, done
    assert done == {}, done


run_tests(globals())
