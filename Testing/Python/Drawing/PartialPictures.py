# SPDX-License-Identifier: BSD-3-Clause
# Proves that a stroke casts only the pixels that show moved tissue, and that the picture and the
# picks equal those of a picture that is cast as a whole.
import numpy
import brainshift_testing as testing

testing.load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import FreeFormDeformation, Show, Sphere  # noqa: E402

SIZE = 300  # edge of a picture, pixels
DISTANCE = 50.0
MIDDLE = (16.0, 16.0, 16.0)
CORNER = (12.0, 13.0, 9.0)  # on the ball
BEHIND = (20.0, 19.0, 23.0)
COLORS = [0, 0.2, 0.3, 1, 100, 1, 0.8, 0.4]
SURFACE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
FOG = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.1, 0.5, 0]
VIEWS = ((0, 0, 1), (1, 0.4, 0.7), (-0.4, -0.7, 0.6))


def still_picture(view):
    view.SMProxy.StillRender()
    return testing.on_screen(view)


class Scene:
    def __init__(self, opacities, lit=True):
        strokes = brainshift.soft(BEHIND, (0, 0, 1), 4.0)
        self.filter = FreeFormDeformation(Input=testing.volume(testing.ball()), Strokes=strokes)
        self.filter.LatticeDimensions = (25, 25, 25)
        self.view = testing.view_along((0, 0, 1), MIDDLE, DISTANCE, size=SIZE)
        self.display = testing.show_volume(
            self.filter, self.view, "Deformed Volume", COLORS, opacities, shade=lit)
        still_picture(self.view)

    def cast(self):
        """Pixels cast since the last call."""
        now = brainshift.counters(self.display)["pixelsCast"]
        before, self.before = getattr(self, "before", 0), now
        return now - before

    def seen(self):
        """The picture as it is, and pixels cast for it."""
        self.cast()
        return still_picture(self.view), self.cast()

    def whole(self):
        """The picture that is cast as a whole: samples are counted of whole pictures only."""
        self.display.CountSamples = 1
        picture = still_picture(self.view)
        self.display.CountSamples = 0
        return picture


def small(amount, place=CORNER):
    return brainshift.soft(place, (0, 0, -amount), 4.0)


def differing(one, other):
    return (numpy.abs(one - other).max(axis=-1) > 0).sum()


def check_strokes(scene, draw):
    first = scene.filter.Strokes.GetData()[:]
    for direction in VIEWS:
        testing.look(scene.view, direction, MIDDLE, DISTANCE)
        scene.filter.Strokes = first
        before, all_pixels = scene.seen()
        for amount in (0.5, 1.5, 1.0):
            scene.filter.Strokes = list(first) + list(small(amount))
            draw()
            after, pixels = scene.seen()
            moved = differing(after, before)
            print(f"  along {direction}, {amount} mm: {pixels} of {all_pixels} pixels cast, "
                  f"{moved} other than before", flush=True)
            assert moved > 50
            assert pixels < 0.8 * all_pixels
            assert differing(after, scene.whole()) == 0
            before = scene.seen()[0]


def test_a_stroke_casts_what_it_moves():
    for opacities, lit, factors in ((SURFACE, True, []), (FOG, False, []),
                                    (FOG, True, [0, 0, 4, 0, 12, 1])):
        scene = Scene(opacities, lit)
        scene.display.GradientOpacity = factors
        check_strokes(scene, lambda: None)


def test_a_drag_leaves_nothing_rough_behind():
    # The steps are so short that a moving picture cannot have all pixels.
    for opacities, lit in ((SURFACE, True), (FOG, False)):
        scene = Scene(opacities, lit)
        scene.display.SampleDistance = 0.02
        scene.display.KeepPicture = 1

        def drag():
            scene.view.SMProxy.InteractiveRender()
            scale = brainshift.counters(scene.display)["imageScale"]
            print(f"  {scale} screen pixels a side for one", flush=True)

        check_strokes(scene, drag)


def test_picks_are_those_of_a_whole_picture():
    # Points far away come and go, and move the camera's clipping planes between two pictures.
    scene = Scene(SURFACE)
    first = scene.filter.Strokes.GetData()[:]
    far = Sphere(Center=(60, 0, -60), Radius=0.5)
    Show(far, scene.view).SetRepresentationType("Trace Points")
    pixels = [(x, y) for x in range(60, 240, 12) for y in range(60, 240, 12)]

    def picks():
        return [brainshift.pick(scene.display, scene.view, *pixel) for pixel in pixels]

    for amount, away in ((0.5, -60), (1.5, 300)):
        still_picture(scene.view)
        _, behind = scene.view.GetActiveCamera().GetClippingRange()
        far.Center = (60, 0, away)
        scene.filter.Strokes = list(first) + list(small(amount))
        _, cast = scene.seen()
        assert 0 < cast < 0.8 * SIZE * SIZE
        found, moved = picks(), scene.view.GetActiveCamera().GetClippingRange()[1] - behind
        scene.whole()
        expected = picks()
        assert [f is None for f in found] == [e is None for e in expected]
        apart = [numpy.abs(numpy.subtract(f, e)).max()
                 for f, e in zip(found, expected) if f is not None]
        print(f"  {len(apart)} picks, at most {max(apart):.6f} mm apart; far plane moved by "
              f"{moved:.2f} mm", flush=True)
        # Other planes round otherwise: a sample then takes the next entry of the colour map, and a
        # pick moves by up to 0.003 mm (one in a thousand of all pixels).
        assert len(apart) > 40 and numpy.median(apart) < 1e-4 and max(apart) < 0.01
    assert abs(moved) > 50.0


def test_parts_at_the_edge_of_the_picture():
    # The eye is so near that moving tissue covers corners and edges of the window.
    scene = Scene(SURFACE)
    scene.display.SampleDistance = 0.02
    scene.display.KeepPicture = 1
    first = scene.filter.Strokes.GetData()[:]
    for focus in ((18, 19, 9), (6, 13, 9), (17, 8, 9), (12, 24, 9)):
        testing.look(scene.view, (0.1, 0.2, 1), focus, 30)
        for amount in (0.0, 1.5, 0.7):
            scene.filter.Strokes = list(first) + list(small(amount))
            scene.view.SMProxy.InteractiveRender()
            assert differing(scene.seen()[0], scene.whole()) == 0, (focus, amount)


def test_tissue_leaves_nothing_where_it_was():
    # In one drag, tissue is pulled far out of the volume's box and then let back.
    scene = Scene(SURFACE)
    scene.display.KeepPicture = 1
    first = scene.filter.Strokes.GetData()[:]
    testing.look(scene.view, (1, 0.1, 0.2), MIDDLE, 100)
    scene.filter.GuardFolding = 0
    pulled = brainshift.soft((16, 16, 7), (0, 0, -25), 14.0)
    still_picture(scene.view)
    shown = []
    for strokes in ((), pulled, ()):
        scene.filter.Strokes = list(first) + list(strokes)
        scene.view.SMProxy.InteractiveRender()
        shown.append(testing.on_screen(scene.view))
    empty, pulled_out, left = ((picture.max(axis=-1) == 0) for picture in shown)
    ghosts, seen = (empty & ~left).sum(), (empty & ~pulled_out).sum()
    print(f"  {seen} pixels of pulled tissue, {ghosts} left when it is back", flush=True)
    assert seen > 200
    assert ghosts < 0.15 * seen  # rough edges


def test_other_strokes_elsewhere_are_kept():
    # A second place is bent, then the first one again. Both look as in a whole picture.
    scene = Scene(SURFACE)
    first = scene.filter.Strokes.GetData()[:]
    other = (23.0, 22.0, 10.0)
    for strokes in (small(2.0), small(2.0) + small(3.0, other), small(1.0) + small(3.0, other)):
        scene.filter.Strokes = list(first) + list(strokes)
        scene.view.SMProxy.InteractiveRender()
        assert differing(scene.seen()[0], scene.whole()) == 0


if __name__ == "__main__":
    testing.run_tests(globals())
