# SPDX-License-Identifier: BSD-3-Clause
# Proves what happens to a segment that is drawn alone. Skipping changes no bit of the picture,
# with lattices that fold and in every blend mode, and leaps over what is not drawn. Uploads and
# memory are counted. State files and servers give the same picture.
import numpy
from brainshift_testing import (ball, load_plugin, on_server, picture, run_tests, scratch,
                                server_finds_plugin, show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from counters_testing import Counted  # noqa: E402
from paraview import simple, smstate  # noqa: E402
from segment_testing import (BRAIN, COLORS, MIDDLE, OPACITIES, SIDE, SKULL,  # noqa: E402
                             STROKES, bent, labels_at, places, show, tissue)
import skipping_testing as skipping  # noqa: E402

LATTICE_BYTES = 19 ** 3 * 3 * 4
DIRECTION = (-0.6, 0.5, -1.0)


def scattered_labels(seed=7):
    """Blobs of three labels that know nothing of the scattered tissue."""
    random = numpy.random.default_rng(seed)
    labels = numpy.zeros((skipping.SIDE,) * 3, numpy.uint8)
    for label in (1, 2, 3):
        for corner in random.integers(0, skipping.SIDE - 6, (6, 3)):
            labels[tuple(slice(low, low + 6) for low in corner)] = label
    return volume(labels)


def test_skipping_is_exact():
    source, labels = volume(skipping.scattered()), scattered_labels()
    for amplitude in (0.0, 6.0, 20.0):
        filter = skipping.bent(source, amplitude)
        filter.Segmentation = labels
        view = view_along(skipping.OBLIQUE, skipping.MIDDLE, 70.0, size=100)
        for name in skipping.OPACITIES:
            display = show_volume(filter, view, "Deformed Volume", *skipping.curves(name),
                                  shade=True)
            display.DrawSegment = 1
            for drawn in ([1], [2, 3]):
                display.DrawnLabels = drawn
                skipping.assert_same(
                    view, display, f"{amplitude:.0f} voxels, {name}, labels {drawn}", 0.003)
        simple.Delete(view)
        simple.Delete(filter)


def test_skipping_is_exact_in_other_blend_modes():
    filter = skipping.bent(volume(skipping.scattered()), 6.0)
    filter.Segmentation = scattered_labels()
    view = view_along(skipping.OBLIQUE, skipping.MIDDLE, 70.0, size=100)
    display = show_volume(filter, view, "Deformed Volume", *skipping.curves("opaque"))
    display.DrawSegment = 1
    display.DrawnLabels = [1, 3]
    display.IsosurfaceValues = [0.3, 0.6]
    for name, mode in (("isosurface", 5), ("maximum", 1), ("minimum", 2), ("average", 3)):
        display.BlendMode = mode
        skipping.assert_same(view, display, name, 0.0 if name == "minimum" else 0.01)
    simple.Delete(view)


class Drawn(Counted):
    """The brain alone on the screen."""

    def __init__(self, labels=None):
        self.segmentation = volume(labels_at(places()))
        self.filter = bent(Segmentation=self.segmentation)
        view = view_along(DIRECTION, MIDDLE, 110.0, size=200)
        super().__init__(view, show(self.filter, view, labels, shade=True))


def test_only_what_changed_is_uploaded():
    drawn = Drawn()
    assert drawn.before["segmentUploads"] == 0, drawn.before
    drawn.display.DrawSegment = 1
    done = drawn.did()
    shares, summed = SIDE ** 3, 26 ** 3 * 4
    assert done.pop("segmentUploads") == done.pop("programsCompiled") == 1, done
    assert done.pop("bytesUploaded") == shares + summed, done
    assert done.pop("presenceUpdates") == 1 and done.pop("skippingBytes") > 0, done
    assert done == {}, done
    drawn.display.DrawnLabels = [BRAIN]
    done = drawn.did()
    assert done["segmentUploads"] == 1 and "programsCompiled" not in done, done
    drawn.filter.Strokes = STROKES + brainshift.soft((20, 24, 20), (2, 1, 0), 9.0)
    done = drawn.did()
    assert done.pop("latticeUploads") == 1 and done.pop("bytesUploaded") == LATTICE_BYTES, done
    assert "segmentUploads" not in done and "programsCompiled" not in done, done
    drawn.view.CameraPosition = [0, 0, 150]
    assert drawn.did() == {}
    drawn.display.DrawSegment = 0
    done = drawn.did()
    assert "segmentUploads" not in done and "programsCompiled" not in done, done


def test_changed_labels_are_seen():
    drawn = Drawn([BRAIN])
    brain = picture(drawn.view)
    image = drawn.segmentation.GetClientSideObject().GetOutputDataObject(0)
    scalars = image.GetPointData().GetScalars()
    for i in range(scalars.GetNumberOfTuples()):
        if scalars.GetTuple1(i) == SKULL:
            scalars.SetTuple1(i, BRAIN)
    scalars.Modified()
    image.Modified()
    drawn.segmentation.GetClientSideObject().Modified()
    drawn.segmentation.MarkModified(drawn.segmentation.SMProxy)
    drawn.filter.UpdatePipeline()
    assert drawn.did()["segmentUploads"] == 1
    assert (picture(drawn.view) != brain).any(axis=2).mean() > 0.1


def test_memory_is_counted():
    drawn = Drawn()
    without = brainshift.gpu(drawn.display)
    drawn.display.DrawSegment = 1
    drawn.did()
    # They are bytes, or floats if the driver draws in software.
    grown = brainshift.gpu(drawn.display)["gpuOtherBytes"] - without["gpuOtherBytes"]
    assert SIDE ** 3 * 0.9 < grown < SIDE ** 3 * 4.2, grown
    drawn.display.DrawSegment = 0
    drawn.did()
    assert brainshift.gpu(drawn.display)["gpuOtherBytes"] < without["gpuOtherBytes"] + SIDE ** 3 / 2


def test_less_is_sampled():
    # A ball in a cloud. If the ball is drawn alone, its rays leap over the cloud.
    labels = (ball(side=SIDE, radius=8.0) > 50).astype(numpy.uint8)
    filter = bent(Segmentation=volume(labels))
    view = view_along(DIRECTION, MIDDLE, 110.0, size=150)
    display = show_volume(filter, view, "Deformed Volume", COLORS,
                          [0, 0.02, 0.5, 0, 100, 0.02, 0.5, 0])
    display.CountSamples = 1
    taken = []
    for segment in (0, 1):
        display.DrawSegment = segment
        picture(view)
        before = brainshift.counters(display)["samplesTaken"]
        picture(view)
        taken.append(brainshift.counters(display)["samplesTaken"] - before)
    print(f"  {taken[0]} samples, alone {taken[1]}", flush=True)
    assert taken[1] < taken[0] / 5, taken


def make_scene():
    wavelet = simple.Wavelet()
    parts = simple.Calculator(Input=wavelet, ResultArrayName="Parts", Function="1 + (coordsX > 0)")
    parts.ResultArrayType = "Int"
    labels = simple.PassArrays(Input=parts, PointDataArrays=["Parts"])
    filter = simple.FreeFormDeformation(registrationName="Bent", Input=wavelet,
                                        Segmentation=labels,
                                        Strokes=brainshift.soft((0, 0, 2), (3, 1, 2), 9.0))
    view = simple.CreateView(
        "RenderView", ViewSize=[200, 200], UseColorPaletteForBackground=0,
        Background=[0.0, 0.0, 0.0], OrientationAxesVisibility=0, UseFXAA=0)
    display = simple.Show(filter, view)
    simple.ColorBy(display, ("POINTS", "RTData"))
    display.SetScalarBarVisibility(view, False)
    simple.ResetCamera(view)
    whole = picture(view)
    display.DrawSegment = 1
    display.DrawnLabels = [2]
    return view, whole


def drawn_scene():
    simple.ResetSession()
    load_plugin()
    view, whole = make_scene()
    half = picture(view)
    assert (half != whole).any(axis=2).mean() > 0.1
    assert half.any(axis=2).mean() > 0.1
    return half


def assert_brought_back(before, load):
    simple.ResetSession()
    load_plugin()
    load()
    view = simple.GetActiveViewOrCreate("RenderView")
    after = picture(view)
    display = simple.GetDisplayProperties(simple.FindSource("Bent"), view)
    assert display.DrawSegment == 1 and list(display.DrawnLabels) == [2]
    differing = int((after != before).any(axis=2).sum())
    assert differing == 0, differing


def test_states_hold_it():
    before = drawn_scene()
    name = scratch("Segment.pvsm")
    simple.SaveState(name)
    assert_brought_back(before, lambda: simple.LoadState(name))
    before = drawn_scene()
    script = compile(smstate.get_state(), "state", "exec")
    assert_brought_back(before, lambda: exec(script, {"__name__": "state"}))


def test_a_server_draws_the_same():
    simple.ResetSession()
    load_plugin()

    def answers():
        view, whole = make_scene()
        half = picture(view)
        display = simple.GetDisplayProperties(simple.FindSource("Bent"), view)
        return whole, half, brainshift.counters(display)["segmentUploads"]

    expected = answers()
    found = on_server(answers, **server_finds_plugin())
    for local, remote in zip(expected[:2], found[:2]):
        differing = int((local != remote).any(axis=2).sum())
        assert differing == 0, differing
    assert expected[2] == found[2] == 1, (expected[2], found[2])


run_tests(globals())
