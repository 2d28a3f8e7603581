# SPDX-License-Identifier: BSD-3-Clause
# Proves that the renderer does only what a change needs. It counts uploads, bytes, refined
# samples of the field and compiled programs.
import numpy
from brainshift_testing import (ball, load_plugin, look, picture, run_tests, show_volume,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from counters_testing import Counted  # noqa: E402
from paraview.simple import (CreatePiecewiseFunction, FreeFormDeformation,  # noqa: E402
                             GetOpacityTransferFunction, Show, Sphere)

MIDDLE = (16.0, 16.0, 16.0)
SURFACE = (7.0, 16.0, 16.0)  # pulled from here, the ball fills bricks that were empty
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
OPACITIES = [0, 0, 0.5, 0, 50, 0, 0.5, 0, 100, 1, 0.5, 0]
LATTICE_BYTES = 19 ** 3 * 3 * 4  # 82 kB
FIELD_TEXELS = 91 ** 3  # nodes over the lattice


class Drawn(Counted):
    """A bent ball on the screen."""

    def __init__(self):
        self.filter = FreeFormDeformation(
            Input=volume(ball()), Strokes=brainshift.soft(MIDDLE, (2, 0, 0), 12))
        view = view_along((0, 0, -1), MIDDLE, 100)
        super().__init__(view, show_volume(
            self.filter, view, "Deformed Volume", COLORS, OPACITIES, shade=True))


def test_a_first_picture_uploads_everything_once():
    drawn = Drawn()
    assert drawn.before["volumeUploads"] == 1, drawn.before
    assert drawn.before["latticeUploads"] == 1, drawn.before
    assert drawn.before["transferUploads"] >= 1, drawn.before
    assert 0 < drawn.before["texelsRefined"] < FIELD_TEXELS, drawn.before  # only what may move
    assert drawn.before["bytesUploaded"] > LATTICE_BYTES + 33 ** 3 * 4, drawn.before


def test_a_camera_move_uploads_nothing():
    drawn = Drawn()
    look(drawn.view, (1, -0.3, -1), MIDDLE, 90)
    assert drawn.did() == {}


def test_a_stroke_uploads_the_lattice_only():
    drawn = Drawn()
    drawn.filter.Strokes = brainshift.soft(SURFACE, (-3, 0, 0), 12)
    done = drawn.did()
    assert done.pop("latticeUploads") == 1, done
    assert done.pop("bytesUploaded") == LATTICE_BYTES, done
    assert done.pop("texelsRefined") > 0, done
    assert done.pop("presenceUpdates") == 1, done
    assert 0 < done.pop("skippingBytes") < LATTICE_BYTES, done
    assert done == {}, done


def test_a_stroke_that_fills_no_brick_sends_no_faces():
    drawn = Drawn()
    drawn.filter.Strokes = brainshift.soft(MIDDLE, (2.0001, 0, 0), 12)
    done = drawn.did()
    assert done.pop("presenceUpdates") == 1 and done.pop("texelsRefined") > 0, done
    assert "skippingBytes" not in done, done


def test_rays_are_cast_where_something_can_be_seen():
    # A rod from corner to corner, seen along its length. Its box fills two thirds of the picture.
    places = numpy.indices((33,) * 3) - 16.0
    aside = (places ** 2).sum(axis=0) - places.sum(axis=0) ** 2 / 3.0  # squared, from the diagonal
    rod = volume(numpy.where(aside < 9.0, 100.0, 0.0))
    view = view_along((-1, -1, -1), MIDDLE, 100, up=(0, 0, 1), half_height=30)
    display = show_volume(rod, view, "Deformed Volume", COLORS, OPACITIES)
    picture(view)
    before = brainshift.counters(display)["pixelsCast"]
    look(view, (-1, -1.01, -1), MIDDLE, 100, up=(0, 0, 1))
    picture(view)
    cast = brainshift.counters(display)["pixelsCast"] - before
    pixels = view.ViewSize[0] * view.ViewSize[1]
    print(f"  {cast} of {pixels} pixels", flush=True)
    assert 0 < cast < 0.4 * pixels, (cast, pixels)


def test_a_stroke_refines_what_it_can_reach():
    # The lattice has 19 points over 32 mm. A radius of 4 mm reaches 5 points along each axis. The
    # kernel adds two cells on either side: 9 of 18 cells along each axis, with 5 nodes each.
    drawn = Drawn()
    everything = FIELD_TEXELS
    there = brainshift.soft(MIDDLE, (2, 0, 0), 12)
    for number, amount in enumerate((0.5, 1.0, 0.2)):
        drawn.filter.Strokes = there + brainshift.soft((10, 12, 14), (0, amount, 0), 4.0)
        refined = drawn.did()["texelsRefined"]
        print(f"  stroke {number}: {refined} texels of {everything}", flush=True)
        assert 0 < refined < everything / 4, (refined, everything)


def test_dragging_compiles_and_uploads_nothing_else():
    # Strokes and camera in turn, drawn at interactive rates as under a hand.
    drawn = Drawn()
    drawn.view.SMProxy.InteractiveRender()
    drawn.did()
    for step in range(1, 6):
        drawn.filter.Strokes = brainshift.soft(SURFACE, (-0.8 * step, 0, 0), 12)
        look(drawn.view, (0.1 * step, -0.3, -1), MIDDLE, 90)
        drawn.view.SMProxy.InteractiveRender()
    moved = brainshift.counters(drawn.display)
    assert moved["presenceUpdates"] - drawn.before["presenceUpdates"] == 5, moved
    assert moved["correctionBytes"] == drawn.before["correctionBytes"], moved
    done = drawn.did()  # draws a still picture, which is exact
    assert done.pop("latticeUploads") == 5, done
    assert done.pop("bytesUploaded") == 5 * LATTICE_BYTES, done
    assert done.pop("texelsRefined") > 0, done
    assert done.pop("presenceUpdates") == 6, done
    assert done.pop("correctionBytes") > 0, done
    assert 0 < done.pop("skippingBytes") < 5 * LATTICE_BYTES, done
    done.pop("imageScale", 0)
    assert done == {}, done


def test_a_kept_picture_casts_no_rays_until_something_changes():
    # A hovering tool relies on this. Each change must be seen, and the picture must equal the one
    # that is cast without keeping.
    drawn = Drawn()
    drawn.display.KeepPicture = 1
    kept = picture(drawn.view)
    drawn.before = brainshift.counters(drawn.display)
    for change in (lambda: None,
                   lambda: look(drawn.view, (1, -0.3, -1), MIDDLE, 90),
                   lambda: setattr(drawn.filter, "Strokes", brainshift.soft(MIDDLE, (3, 0, 0), 12)),
                   lambda: setattr(drawn.display, "SampleDistance", 0.8),
                   lambda: setattr(drawn.display, "Shade", 0),
                   lambda: setattr(drawn.display, "Visibility", 1),
                   lambda: Show(Sphere(Center=MIDDLE, Radius=4.0), drawn.view),
                   lambda: drawn.view.SMProxy.InteractiveRender()):
        change()
        seen = picture(drawn.view)
        now = brainshift.counters(drawn.display)["frames"]
        again = picture(drawn.view)
        assert brainshift.counters(drawn.display)["frames"] == now  # nothing changed since
        drawn.display.KeepPicture = 0
        cast = picture(drawn.view)
        drawn.display.KeepPicture = 1
        picture(drawn.view)
        assert (seen == cast).all() and (again == cast).all()
    assert kept.shape == seen.shape and (kept != seen).any()


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
    opacity.Points = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 100, 1, 0.5, 0]
    done = drawn.did()
    assert done.pop("transferUploads") == 1, done
    # 4096 colours for each of three steps, and the visible bricks of 2 voxels, summed.
    assert done.pop("bytesUploaded") == 3 * 4096 * 4 * 4 + 18 ** 3 * 4, done
    assert done.pop("presenceUpdates") == 1, done
    assert done == {}, "no brick is filled or emptied, so no faces are sent"
    opacity.Points = [0, 0.1, 0.5, 0, 100, 1, 0.5, 0]
    assert 0 < drawn.did()["skippingBytes"] < LATTICE_BYTES, "all are filled"


def test_opaque_tissue_and_fog_have_a_program_each_compiled_once():
    drawn = Drawn()
    opacity = GetOpacityTransferFunction("Intensity", drawn.display, separate=True)
    for largest, compiled in ((0.5, 1), (1.0, 0), (0.3, 0)):
        opacity.Points = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 100, largest, 0.5, 0]
        assert drawn.did().get("programsCompiled", 0) == compiled, largest


def test_the_panel_of_a_shown_volume_uploads_nothing():
    # Light, step on and off again, a second look: all of that is there already.
    drawn = Drawn()
    drawn.display.Specular = 0.7
    assert drawn.did() == {}
    drawn.display.EmptySpaceSkipping = 0
    assert drawn.did() == {}


def test_samples_are_counted():
    # Rays have one length with and without skipping, and without it all of the ray is sampled. With
    # skipping, only rays that can show something are cast.
    drawn = Drawn()
    assert "samplesTaken" not in drawn.did()
    drawn.display.CountSamples = 1
    drawn.display.EmptySpaceSkipping = 0
    every = drawn.did()
    drawn.display.EmptySpaceSkipping = 1
    some = drawn.did()
    print(f"  taken {every['samplesTaken']}, with skipping {some['samplesTaken']}, skipped "
          f"{some['samplesSkipped']}", flush=True)
    assert every.get("samplesSkipped", 0) == 0, every
    assert 0 < some["samplesTaken"] < every["samplesTaken"] / 2, (some, every)
    assert some["samplesSkipped"] > 0, some
    assert some["samplesTaken"] + some["samplesSkipped"] <= every["samplesTaken"], (some, every)
    drawn.display.CountSamples = 0
    assert "samplesTaken" not in drawn.did()


def test_other_light_is_compiled_once():
    drawn = Drawn()
    for shade, compiled in ((0, 1), (1, 0), (0, 0)):
        drawn.display.Shade = shade
        assert drawn.did().get("programsCompiled", 0) == compiled, shade


run_tests(globals())
