# SPDX-License-Identifier: BSD-3-Clause
# Proves that align finds a known motion and refine a known bend, from what the hand made; that a
# callback stops them; that a state file and later strokes follow; that errors leave all as it was.
import warnings

import numpy
from brainshift_testing import (
    assert_says, data, load_plugin, messages, output, run_tests, scratch, volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.casesources import name_of  # noqa: E402
from paraview import simple  # noqa: E402

SIDE = 48
SPACING = (2.0, 2.0, 2.2)
MIDDLE = 0.5 * (SIDE - 1) * numpy.array(SPACING)


def tissue(x, y, z):
    """Folds within an ellipsoid, and one bright ball, so that no turn looks like another."""
    folds = (numpy.sin(0.31 * x + 0.1 * y) + numpy.sin(0.27 * y - 0.12 * z)
             + numpy.sin(0.29 * z + 0.08 * x) + numpy.sin(0.11 * (x + y + z)))
    away = numpy.sqrt(((x - MIDDLE[0]) / 38) ** 2 + ((y - MIDDLE[1]) / 42) ** 2
                      + ((z - MIDDLE[2]) / 40) ** 2)
    ball = (x - 60) ** 2 + (y - 40) ** 2 + (z - 50) ** 2 < 144
    return (100 + 20 * folds + 60 * ball) * numpy.clip(8 * (1 - away), 0, 1)


def places():
    k, j, i = numpy.indices((SIDE, SIDE, SIDE))
    return [step * index for step, index in zip(SPACING, (i, j, k))]


def rest_volume():
    return volume(tissue(*places()).astype(numpy.float32), spacing=SPACING)


def known_bend(rest, name="Known"):
    strokes = brainshift.soft(MIDDLE, (3.0, -2.5, 3.0), 50.0)
    return simple.FreeFormDeformation(Input=rest, Strokes=strokes, registrationName=name)


def bent_reference(rest):
    """The volume as it is bent, inverted."""
    baked = simple.BakeDeformation(Input=known_bend(rest), Interpolation="Cubic")
    baked.UpdatePipeline()
    name = baked.PointData.GetArray(0).Name
    return simple.Calculator(Input=baked, Function=f'200 - "{name}"', ResultArrayName="Inverted")


def error(bent, rest):
    """Mean distance (mm) from the known bend around the middle."""
    points = MIDDLE + numpy.random.default_rng(3).uniform(-20, 20, (100, 3))
    truth = known_bend(rest, "Truth")
    apart = (brainshift.deformed_from_rest(bent, points)
             - brainshift.deformed_from_rest(truth, points))
    simple.Delete(truth)
    return numpy.linalg.norm(apart, axis=1).mean()


def refuses(call, words):
    try:
        call()
    except ValueError as said:
        assert words in str(said), said
    else:
        raise AssertionError(f"no error: {words}")


def test_align_finds_a_known_motion():
    rest = rest_volume()
    moved = volume((200 - tissue(*places())).astype(numpy.float32), spacing=SPACING)
    compare = simple.CompareVolumes(Input=rest, Reference=moved, ReferenceRotation=(5, -4, 3),
                                    ReferenceTranslation=(6, -3, 2))
    seen = []
    found = brainshift.align(compare, callback=lambda progress: seen.append(progress.steps))
    assert seen == list(range(1, found.steps + 1)), seen
    assert numpy.abs(compare.ReferenceRotation).max() < 0.3, compare.ReferenceRotation
    assert numpy.abs(compare.ReferenceTranslation).max() < 0.2, compare.ReferenceTranslation
    assert found.finished and found.information > 1.5 * found.information_before
    assert 5 < found.turn < 10 and 5 < found.shift < 9 and found.compared > 0.8
    assert numpy.allclose(found.rotation, compare.ReferenceRotation)


def test_several_starts_find_what_is_farther():
    rest = rest_volume()
    moved = volume((200 - tissue(*places())).astype(numpy.float32), spacing=SPACING)
    apart = []
    for starts in (1, 32):
        compare = simple.CompareVolumes(Input=rest, Reference=moved, ReferenceRotation=(0, 0, 60),
                                        ReferenceTranslation=(20, -16, 8))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it is farther than Align was tested for
            found = brainshift.align(compare, starts=starts, keep_failed=True)
        assert found.trust != "good", found
        apart.append(numpy.abs([*compare.ReferenceRotation, *compare.ReferenceTranslation]).max())
    assert apart[0] > 3.0 and apart[1] < 0.3, apart
    for wrong in (0, 65, 1.5, True):
        refuses(lambda of=wrong: brainshift.align(compare, starts=of),
                f"starts is {wrong!r}; it must be a whole number from 1 to 64")


def test_align_warns_beyond_what_was_tested():
    rest = rest_volume()
    compare = simple.CompareVolumes(Input=rest, Reference=rest, ReferenceTranslation=(22, -12, 8))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = brainshift.align(compare)
    assert found.shift > 24, found.shift
    assert any("Align was tested only for" in str(one.message) for one in said), said
    compare = simple.CompareVolumes(Input=rest, Reference=rest, ReferenceTranslation=(6, 0, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        brainshift.align(compare)


def test_a_callback_stops_align():
    rest = rest_volume()
    compare = simple.CompareVolumes(Input=rest, Reference=rest, ReferenceTranslation=(6, -3, 2))
    found = brainshift.align(compare, callback=lambda progress: progress.steps < 2)
    assert found.steps == 2 and not found.finished
    assert numpy.linalg.norm(compare.ReferenceTranslation) < 7.0


def test_names_of_similarities_come_from_the_server():
    known = brainshift.similarities()
    assert list(known)[:3] == ["auto", "same contrast", "ultrasound"], known
    assert all(text.endswith(".") for text in known.values()), known


def test_refine_finds_a_known_bend():
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest)
    before = error(bent, rest)
    found = brainshift.refine(bent, bent_reference(rest))
    assert before > 1.5 and error(bent, rest) < 0.4, (before, error(bent, rest))
    assert bent.Lattice is not None and found.filter.SMProxy is bent.Lattice.SMProxy
    assert found.disagreement < 0.5 * found.disagreement_before
    assert found.largest_change > 3.0 > found.mean_change > 0.0
    assert found.smallest_determinant > 0.1 and found.share == 1.0 and found.compared > 0.8
    assert found.finished and found.level == 2


def test_it_begins_with_the_hand_and_strokes_follow():
    simple.ResetSession()
    load_plugin()
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest)
    bent.Strokes = brainshift.soft(MIDDLE, (1.5, -1.0, 1.5), 50.0)
    hand = tuple(bent.Strokes)
    half = error(bent, rest)
    reference = bent_reference(rest)
    found = brainshift.refine(bent, reference, callback=lambda progress: False)
    assert found.steps == 1 and not found.finished and found.strokes == hand
    assert len(bent.Strokes) == 0 and error(bent, rest) < half
    again = brainshift.refine(bent, reference)
    assert error(bent, rest) < 0.4
    made = [name for name, _ in simple.GetSources() if "refined" in name.lower()]
    assert made == [f"{name_of(bent.Input)} refined"], made
    point = numpy.array([MIDDLE])
    refined = brainshift.deformed_from_rest(bent, point)
    bent.Strokes = brainshift.soft(refined[0], (0, 0, 2.0), 30.0)
    moved = brainshift.deformed_from_rest(bent, point) - refined
    assert numpy.allclose(moved, (0, 0, 2.0), atol=0.1), moved
    assert again.filter.SMProxy is bent.Lattice.SMProxy


def test_pulls_and_fits_follow_a_refinement():
    simple.ResetSession()
    load_plugin()
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest)
    reference = bent_reference(rest)
    refined = brainshift.refine(bent, reference).filter
    near = error(bent, rest)
    asked, still = numpy.array(MIDDLE), numpy.array(MIDDLE) + (0, 0, 40.0)
    was = brainshift.deformed_from_rest(bent, [asked, still])
    found = brainshift.fit(bent, pulls=[(asked, was[0] + (0, 3.0, 0))], pins=[still])
    assert bent.Lattice == found.filter and found.filter.Base == refined, found.filter.Base
    assert refined in simple.GetSources().values()
    now = brainshift.deformed_from_rest(bent, [asked, still])
    assert numpy.allclose(now - was, [(0, 3.0, 0), (0, 0, 0)], atol=0.2), now - was
    assert numpy.allclose(found.measured_from_rest([asked, still]), now, atol=1e-3)
    # A later fit has the same base, not the former fit; landmarks alone take no motion out.
    places = numpy.random.default_rng(8).normal(MIDDLE, 15.0, (12, 3))
    shifted = brainshift.fit(bent, rest=places, measured=refined_places(bent, refined, places)
                             + (2.0, 0, 0))
    assert shifted.filter.Base == refined and numpy.allclose(shifted.rigid, numpy.eye(4))
    assert shifted.residuals.max() < 0.2, shifted.residuals
    # Another refinement begins with both.
    again = brainshift.refine(bent, reference)
    assert bent.Lattice == again.filter and again.disagreement <= again.disagreement_before
    assert error(bent, rest) < near + 0.1, (near, error(bent, rest))


def refined_places(bent, refined, places):
    """Where the refinement alone puts tissue."""
    alone = simple.FreeFormDeformation(Input=bent.Input, Lattice=refined)
    return brainshift.deformed_from_rest(alone, places)


def test_a_state_brings_it_back():
    simple.ResetSession()
    load_plugin()
    rest = simple.Wavelet(WholeExtent=[0, 40] * 3)
    strokes = brainshift.soft((20, 20, 20), (2, 1, -1), 25.0)
    reference = simple.BakeDeformation(
        Input=simple.FreeFormDeformation(Input=rest, Strokes=strokes))
    bent = simple.FreeFormDeformation(Input=rest, registrationName="Bent")
    brainshift.refine(bent, reference, callback=lambda progress: progress.steps < 4)
    points = numpy.random.default_rng(4).uniform(5, 35, (20, 3))
    pulled = brainshift.deformed_from_rest(bent, [(20, 20, 20)])[0] + (0, 0, 2.0)
    brainshift.fit(bent, pulls=[((20, 20, 20), pulled)])
    expected = brainshift.deformed_from_rest(bent, points)
    assert numpy.abs(expected - points).max() > 0.3
    state = scratch("refined.pvsm")
    simple.SaveState(state)
    with open(state, encoding="utf-8") as file:
        assert "RegistrationRun" not in file.read(), "a run is no part of a state"
    simple.ResetSession()
    load_plugin()
    simple.LoadState(state)
    again = simple.FindSource("Bent")
    assert again.Lattice.SMProxy.GetXMLName() == "FitDeformation"
    assert again.Lattice.Base.SMProxy.GetXMLName() == "RefinedLattice"
    assert numpy.allclose(brainshift.deformed_from_rest(again, points), expected, atol=1e-5)


def test_errors_leave_all_as_it_was():
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest, Strength=0.5)
    bent.Strokes = brainshift.soft(MIDDLE, (1.5, -1.0, 1.5), 50.0)
    hand = tuple(bent.Strokes)
    compare = simple.CompareVolumes(Input=rest, Reference=rest)
    for call, words in (
            (lambda: brainshift.refine(bent, rest), "Strength is 0.5"),
            (lambda: brainshift.refine(bent, compare), "does not show this deformation"),
            (lambda: brainshift.refine(bent, rest, similarity="best"), "similarity is 'best'"),
            (lambda: brainshift.refine(bent, rest, stiffness=0.0), "Stiffness is 0"),
            (lambda: brainshift.refine(bent, rest, starts=0), "starts is 0"),
            (lambda: brainshift.refine(bent, compare, cavity=rest), "has its own"),
            (lambda: brainshift.align(rest), "carries no reference")):
        refuses(call, words)
    assert tuple(bent.Strokes) == hand and bent.Lattice is None


def test_nothing_to_compare_is_an_error():
    voxels = tissue(*places()).astype(numpy.float32)
    rest = rest_volume()
    constant = volume(numpy.full_like(voxels, 7.0), spacing=SPACING)
    unknown = volume(numpy.full_like(voxels, numpy.nan), spacing=SPACING)
    everywhere = volume(numpy.ones_like(voxels), spacing=SPACING)
    middle = numpy.zeros_like(voxels)
    middle[10:-10, 10:-10, 10:-10] = 1
    flat_outside = volume(numpy.where(middle > 0, voxels, 9.0).astype(numpy.float32),
                          spacing=SPACING)
    for volumes, words in (
            ({"rest": rest, "reference": constant}, "All voxels of the reference that count have "
                                                    "the value 7, so there is nothing to compare"),
            ({"rest": constant, "reference": rest}, "All voxels of the volume that count have"),
            ({"rest": rest, "reference": unknown}, "No voxel of the reference is a finite number"),
            ({"rest": unknown, "reference": rest}, "No voxel of the volume is a finite number"),
            ({"rest": rest, "reference": rest, "cavity": everywhere},
             "The cavity covers all of the reference"),
            ({"rest": rest, "reference": flat_outside,
              "cavity": volume(middle, spacing=SPACING)},
             "All voxels of the reference that count have the value 9")):
        strokes = tuple(brainshift.soft(MIDDLE, (2, 0, 0), 30.0))
        bent = simple.FreeFormDeformation(Input=volumes["rest"], Strokes=strokes)
        compare = simple.CompareVolumes(Input=bent, Reference=volumes["reference"],
                                        ReferenceTranslation=(1, 2, 3))
        if "cavity" in volumes:
            compare.Cavity = volumes["cavity"]
        refuses(lambda of=compare: brainshift.align(of), words)
        refuses(lambda of=compare, lattice=bent: brainshift.refine(lattice, of), words)
        assert tuple(bent.Strokes) == strokes and not bent.Lattice, bent.Lattice
        assert list(compare.ReferenceTranslation) == [1.0, 2.0, 3.0], compare.ReferenceTranslation


def test_voxels_without_a_value_do_not_count():
    rest = rest_volume()
    voxels = tissue(*places()).astype(numpy.float32)
    half = voxels.copy()
    half[:, :SIDE // 2 + 2] = numpy.nan
    for volumes in ((rest, volume(half, spacing=SPACING)), (volume(half, spacing=SPACING), rest)):
        bent = simple.FreeFormDeformation(Input=volumes[0])
        compare = simple.CompareVolumes(Input=bent, Reference=volumes[1])
        found = brainshift.refine(bent, compare)
        assert found.mean_change < 0.2 and found.largest_change < 1.0, found
        aligned = brainshift.align(compare)
        assert aligned.shift < 0.5 and aligned.turn < 0.5, aligned
        if volumes[0] is rest:
            assert found.compared < 0.5 and aligned.compared < 0.5, (found, aligned)


def test_a_fill_value_does_not_count():
    voxels = tissue(*places()).astype(numpy.float32)
    voxels[20:23, 20:23, 20:23] = 9.96921e36  # that of netCDF, finite
    bent = simple.FreeFormDeformation(Input=rest_volume())
    compare = simple.CompareVolumes(Input=bent, Reference=volume(voxels, spacing=SPACING))
    found = brainshift.refine(bent, compare)
    assert numpy.isfinite(found.disagreement) and found.disagreement_before < 0.05, found
    assert found.mean_change < 0.2 and found.trust == "good", found
    aligned = brainshift.align(compare)
    assert aligned.shift < 0.5 and aligned.turn < 0.5, aligned


def test_what_the_cavity_covers_is_no_overlap():
    rest = rest_volume()
    left = numpy.ones((SIDE,) * 3, numpy.uint8)
    left[:8] = 0
    compare = simple.CompareVolumes(Input=rest, Reference=rest,
                                    Cavity=volume(left, spacing=SPACING))
    refuses(lambda: brainshift.align(compare),
            "has a partner in the reference outside the cavity; at least 25 % must")


def noise_volume():
    """A volume that has nothing in common with `rest_volume`."""
    values = numpy.random.default_rng(1).normal(0, 1, (SIDE,) * 3)
    return volume(values.astype(numpy.float32), spacing=SPACING)


def test_a_failed_result_changes_nothing():
    rest = rest_volume()
    strokes = tuple(brainshift.soft(MIDDLE, (2, 0, 0), 30.0))
    bent = simple.FreeFormDeformation(Input=rest, Strokes=strokes)
    compare = simple.CompareVolumes(Input=bent, Reference=noise_volume())
    for call, kind in ((lambda **how: brainshift.refine(bent, compare, **how),
                        brainshift.Refinement),
                       (lambda **how: brainshift.align(compare, **how), brainshift.Alignment)):
        try:
            call()
        except brainshift.RegistrationFailed as failed:
            found, reason = failed.found, str(failed)
        else:
            raise AssertionError("no error")
        assert isinstance(found, kind) and found.trust == "failed" and found.finished, found
        assert "failed its checks" in reason and "keep_failed=True" in reason, reason
        assert found.warnings and all(one.endswith(".") for one in found.warnings), found.warnings
        assert tuple(bent.Strokes) == strokes and not bent.Lattice, bent.Lattice
        assert list(compare.ReferenceTranslation) == [0.0, 0.0, 0.0], compare.ReferenceTranslation
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            kept = call(keep_failed=True)
        assert kept.trust == "failed" and kept.warnings == found.warnings, kept
        assert any(kept.warnings[0] in str(one.message) for one in said), said
        bent.Lattice, bent.Strokes = None, strokes


def test_a_right_result_is_trusted():
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = brainshift.refine(bent, bent_reference(rest))
        assert found.trust == "good" and found.warnings == [] and "good" in repr(found), found
        compare = simple.CompareVolumes(Input=rest, Reference=rest, ReferenceTranslation=(3, 2, 0))
        found = brainshift.align(compare)
        assert found.trust == "good" and found.warnings == [], found
    stopped = brainshift.refine(bent, rest, callback=lambda progress: False)
    assert stopped.trust == "unchecked" and "stopped, unchecked" in repr(stopped), stopped


def test_a_mirrored_reference_is_named():
    rest = rest_volume()
    mirrored = volume(tissue(*places())[:, :, ::-1].astype(numpy.float32), spacing=SPACING)
    compare = simple.CompareVolumes(Input=rest, Reference=mirrored)
    refuses(lambda: brainshift.align(compare), "if it is mirrored from left to right")
    refuses(lambda: brainshift.refine(simple.FreeFormDeformation(Input=rest), mirrored),
            "if it is mirrored from left to right")


def test_without_overlap_nothing_changes():
    rest = rest_volume()
    away = volume(tissue(*places()).astype(numpy.float32), origin=(500.0, 0.0, 0.0),
                  spacing=SPACING)
    strokes = tuple(brainshift.soft(MIDDLE, (2, 0, 0), 30.0))
    bent = simple.FreeFormDeformation(Input=rest, Strokes=strokes)
    before = sorted(simple.GetSources())
    refuses(lambda: brainshift.refine(bent, away), "do not overlap")
    assert tuple(bent.Strokes) == strokes and not bent.Lattice, bent.Lattice
    assert sorted(simple.GetSources()) == before, simple.GetSources()
    compare = simple.CompareVolumes(Input=bent, Reference=away)
    refuses(lambda: brainshift.align(compare), "at least 25 % must")
    assert list(compare.ReferenceTranslation) == [0.0, 0.0, 0.0], compare.ReferenceTranslation


def test_little_overlap_is_warned_of():
    rest = rest_volume()
    aside = volume(tissue(*places()).astype(numpy.float32), spacing=SPACING,
                   origin=(0.55 * SIDE * SPACING[0], 0.0, 0.55 * SIDE * SPACING[2]))
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = brainshift.refine(simple.FreeFormDeformation(Input=rest), aside,
                                  callback=lambda progress: False)
    assert 0.0 < found.compared < 0.25, found.compared
    expected = f"Only {100 * found.compared:.0f} % of the volume has a partner"
    assert any(expected in str(one.message) for one in said), [str(one.message) for one in said]


def sunk_head(head, mask, strokes):
    """The head after its brain sank by strokes, as another scanner sees it: fluid is bright, bone
    is dark and stays where it is, and fluid fills the gap."""
    sunk, brain = (
        voxels(simple.BakeDeformation(Input=simple.FreeFormDeformation(
            Input=source, Strokes=strokes))) for source in (head, mask))
    before, was = voxels(head), voxels(mask)
    fraction = brain / was.max()
    near = fraction + (was > 0) > 0
    seen = numpy.where(near, fraction * sunk + (1 - fraction) * 60.0, before)
    bright = numpy.interp(seen, (0, 40, 60, 150, 250, 330, 500), (0, 60, 255, 190, 150, 110, 90))
    noise = numpy.random.default_rng(6).normal(0.0, 6.0, seen.shape)
    scan = numpy.where(near, bright, 0.3 * before) + noise
    image = output(head)
    return volume(scan.astype(numpy.float32), image.GetOrigin(), image.GetSpacing(),
                  [image.GetDirectionMatrix().GetElement(i, j) for i in range(3) for j in range(3)])


class SunkBrain:
    """The head of the tests, a reference of it sunk by up to 8.5 mm, and places that moved by more
    than 4 mm."""

    def __init__(self):
        self.head, self.mask = (simple.OpenDataFile(data("seg3d-utah", f"seg3d_{name}.nii.gz"))
                                for name in ("mr_t1", "brainmask"))
        strokes = brainshift.soft((-340.0, 30.0, 520.0), (2.0, 1.0, -8.5), 45.0)
        truth = simple.FreeFormDeformation(Input=self.head, Strokes=strokes)
        self.reference = sunk_head(self.head, self.mask, strokes)
        points = numpy.random.default_rng(7).uniform((-370, 0, 490), (-310, 60, 525), (20000, 3))
        inside = brainshift.images.Labels(output(self.mask)).fractions(points) > 0.99
        expected = brainshift.deformed_from_rest(truth, points)
        moves = inside & (numpy.linalg.norm(expected - points, axis=1) > 4.0)
        assert moves.sum() > 500
        self.points, self.expected = points[moves], expected[moves]

    def refined(self, name, callback=None, **inputs):
        """How far off (mm, mean and largest) a refinement ends, and what it found."""
        bent = simple.FreeFormDeformation(Input=self.head, **inputs)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = brainshift.refine(bent, self.reference, callback=callback)
        moved = brainshift.deformed_from_rest(bent, self.points)
        off = numpy.linalg.norm(moved - self.expected, axis=1)
        print(f"{name}: off by {off.mean():.2f} mm in the mean, {off.max():.2f} mm at most, "
              f"{found.trust}: {found.warnings}", flush=True)
        return off.mean(), off.max(), found


def test_bone_does_not_hold_a_brain_that_sank():
    sunk = SunkBrain()
    mean, largest, _ = sunk.refined("mask", Mask=sunk.mask)
    assert mean < 0.8 and largest < 3.0
    # The mask counts beside other labels, too.
    again = sunk.refined("mask beside others", Mask=sunk.mask, Segmentation=sunk.head)
    assert numpy.allclose(again[:2], (mean, largest), atol=1e-6), again


def test_what_bone_holds_without_a_mask_is_brought_and_said():
    seen = []
    mean, largest, found = SunkBrain().refined(
        "no mask", lambda at: seen.append((at.steps, at.done)))
    steps, done = zip(*seen)
    assert steps == tuple(range(1, found.steps + 1)), steps
    assert all(earlier < later <= 1.0 for earlier, later in zip(done, done[1:])), done
    assert mean < 1.6 and found.trust == "doubtful", (mean, largest, found.trust)
    assert any("matched better elsewhere" in reason for reason in found.warnings), found.warnings


def test_a_stop_after_the_checks_keeps_what_they_checked():
    sunk, seen = SunkBrain(), []

    def refined(callback):
        bent = simple.FreeFormDeformation(Input=sunk.head)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = brainshift.refine(bent, sunk.reference, callback=callback, keep_failed=True)
        return found, numpy.array(found.filter.ControlPoints)

    def three_steps_on(at):
        seen.append((at.steps, at.done))
        return sum(done > 0.8 for _, done in seen) < 3  # where the first checks end
    found, points = refined(three_steps_on)
    last = max(steps for steps, done in seen if done < 0.8)
    at_last, expected = refined(lambda at: at.steps < last)
    assert found.steps == last + 3 and at_last.steps == last, (found, at_last)
    assert numpy.array_equal(points, expected), numpy.abs(points - expected).max()
    assert found.disagreement == at_last.disagreement, (found, at_last)
    assert found.finished and found.trust in ("doubtful", "failed"), found
    assert any("match better elsewhere" in reason for reason in found.warnings), found.warnings
    assert at_last.trust == "unchecked" and not at_last.finished, at_last


def test_landmarks_judge_a_refinement():
    rest = rest_volume()
    bent, truth = simple.FreeFormDeformation(Input=rest), known_bend(rest)
    places = MIDDLE + numpy.random.default_rng(5).uniform(-20, 20, (30, 3))
    targets = brainshift.deformed_from_rest(truth, places)
    before = brainshift.tre(bent, places, targets)
    assert numpy.allclose(before.errors, numpy.linalg.norm(targets - places, axis=1), atol=1e-4)
    brainshift.refine(bent, bent_reference(rest))
    after = brainshift.tre(bent, places, targets)
    assert numpy.allclose(after.before, before.errors, atol=1e-4)
    assert after.mean < 0.4 < before.mean and after.largest == after.errors.max(), after
    assert after.median <= after.largest and after.mean <= after.rms, after
    assert "of 30 landmarks" in repr(after), after


def test_landmarks_pair_by_name():
    rest = rest_volume()
    bent = simple.FreeFormDeformation(Input=rest)
    unused = numpy.full(3, numpy.nan)

    def points(positions, labels):
        return brainshift.points.Points(numpy.array(positions, float), labels, *[unused] * 3)
    places = points([(10, 10, 10), (20, 20, 20), (30, 30, 30)], ["a", "b", "c"])
    targets = points([(30, 30, 34), (10, 13, 10), (0, 0, 0)], ["c", "a", "d"])
    found = brainshift.tre(bent, places, targets)
    assert found.names == ["a", "c"] and found.unpaired == ["b", "d"], found.names
    assert numpy.allclose(found.errors, (3, 4)), found.errors
    assert "2 without a partner" in repr(found), found
    some = brainshift.tre(bent, places._replace(labels=["a", "", "c"]),
                          targets._replace(labels=["c", "a", ""]))
    assert some.names == ["a", "c"] and some.unpaired == ["point 2 of rest", "point 3 of measured"]
    assert "2 without a partner" in repr(some), some
    by_order = brainshift.tre(bent, places, targets, by_order=True)
    assert len(by_order.errors) == 3 and by_order.errors[1] > 10, by_order
    for measured, words in ((targets._replace(labels=["x", "y", "z"]), "no name is both in rest"),
                            (targets._replace(labels=["a", "a", "c"]), "'a' twice"),
                            (targets.positions[:2], "rest has 3 points and measured 2"),
                            (numpy.zeros((3, 2)), "must be N x 3")):
        refuses(lambda of=measured: brainshift.tre(bent, places, of), words)
    refuses(lambda: brainshift.tre(bent, [], []), "there is no landmark")


def test_a_lattice_of_the_wrong_size_is_an_error():
    rest = rest_volume()
    lattice = simple.RefinedLattice(Input=rest, ControlPoints=[1.0, 2.0, 3.0])
    with messages() as said:
        lattice.UpdatePipeline()
    assert_says(said.text, "ControlPoints has 3 numbers")


run_tests(globals())
