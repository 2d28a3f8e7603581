# SPDX-License-Identifier: BSD-3-Clause
# Proves that measured points bend a volume: landmarks rigidly and a little, pulls and pins at once,
# traces under a craniotomy with the rest of the cortex held; that the fold guard says what it left;
# that figures, errors and states are those of the fit.
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, output, run_tests,
                                scratch, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift.casesources import name_of  # noqa: E402
from paraview import simple  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402

SIDE = 61
SPACING = 2.5  # mm
MIDDLE = (SIDE - 1) / 2 * SPACING
RADIUS = 60.0  # mm, of a brain of 12 cm
TOP = numpy.array((MIDDLE, MIDDLE, MIDDLE + RADIUS))
OPENING = 30.0  # mm, radius of the craniotomy
SAG = 8.0  # mm


def deformation(**properties):
    voxels = ball(side=SIDE, radius=RADIUS / SPACING)
    return simple.FreeFormDeformation(
        Input=volume(voxels, spacing=(SPACING,) * 3), **properties)


def scattered(count, seed=1, size=40.0):
    return MIDDLE + numpy.random.default_rng(seed).uniform(-size, size, (count, 3))


def turned(points):
    """A rigid motion of 7 degrees around z with a shift, as a tracker that was placed badly."""
    c, s = numpy.cos(numpy.radians(7)), numpy.sin(numpy.radians(7))
    matrix = numpy.array(((c, -s, 0, 3.0), (s, c, 0, -5.0), (0, 0, 1, 2.0), (0, 0, 0, 1)))
    return points @ matrix[:3, :3].T + matrix[:3, 3], matrix


def on_ball(count):
    """Points all over the brain."""
    z = 1 - (2 * numpy.arange(count) + 1) / count
    turn = 2.399963229728653 * numpy.arange(count)
    flat = numpy.sqrt(1 - z * z)
    normals = numpy.stack((flat * numpy.cos(turn), flat * numpy.sin(turn), z), axis=1)
    return MIDDLE + RADIUS * normals


def sunk(points):
    """Where the brain sags to: most under the middle of the opening, and nothing beyond 45 mm."""
    away = numpy.minimum(1.0, numpy.linalg.norm(points - TOP, axis=1) / 45.0)
    return points - SAG * ((1 - away ** 2) ** 2)[:, None] * (0, 0, 1)


def normal_miss(bent, points):
    """How far (mm) the bent cortex lies from the sunk one, along the normal."""
    normals = (points - MIDDLE) / RADIUS
    off = brainshift.deformed_from_rest(bent, points) - sunk(points)
    return numpy.abs((off * normals).sum(axis=1))


def test_landmarks_give_the_rigid_part_and_leave_the_volume():
    bent = deformation()
    simple.RenameSource("T1", bent.Input)
    rest = scattered(12)
    measured, matrix = turned(rest)
    fit = brainshift.fit(bent, rest=rest, measured=measured)
    assert name_of(fit.filter) == "T1 fit", "as in the window"
    fit = brainshift.fit(bent, rest=rest, measured=measured)
    assert name_of(fit.filter) == "T1 fit", "a second fit takes the place of the first"
    assert numpy.allclose(fit.rigid, matrix, atol=1e-4), fit.rigid
    probe = scattered(5, seed=2)
    assert numpy.allclose(fit.measured_from_rest(probe), turned(probe)[0], atol=1e-3)
    assert numpy.allclose(brainshift.deformed_from_rest(bent, probe), probe, atol=1e-3)
    assert fit.residuals.shape == (12,) and fit.residuals.max() < 1e-3, fit.residuals
    assert fit.leave_one_out.shape == (12,) and fit.leave_one_out.max() < 1e-2
    assert fit.share == 1.0 and bent.Lattice == fit.filter


def test_deviations_grow_away_from_what_was_measured():
    rest = scattered(12)
    wrong = numpy.random.default_rng(3).normal(0, 1.0, rest.shape)
    fit = brainshift.fit(deformation(), rest=rest, measured=rest + wrong)
    near, far = fit.deviation([rest.mean(axis=0), rest.mean(axis=0) + (0, 0, 300.0)])
    assert 0.1 < near < far, (near, far)
    assert 0.3 < numpy.mean(fit.residuals) < numpy.mean(fit.leave_one_out)


def test_pulls_and_pins_are_solved_together():
    bent = deformation()
    start, held = MIDDLE + numpy.array((0.0, 0, 20)), MIDDLE - numpy.array((0.0, 0, 30))
    end = start + (0, 3.0, -6.0)
    other = MIDDLE + numpy.array((20.0, 0, 0))
    pulls = [(start, end), (other, other + (0, 2.0, 0))]
    fit = brainshift.fit(bent, pulls=pulls, pins=[held])
    assert numpy.allclose(fit.rigid, numpy.eye(4))
    moved, stayed = brainshift.deformed_from_rest(bent, [start, held])
    assert numpy.linalg.norm(moved - end) < 0.5 and numpy.linalg.norm(stayed - held) < 0.2
    assert numpy.allclose(fit.pull_residuals[0], numpy.linalg.norm(moved - end), atol=1e-3)
    again = brainshift.fit(deformation(), pulls=pulls[::-1], pins=[held])
    probe = scattered(20)
    assert numpy.allclose(again.measured_from_rest(probe), fit.measured_from_rest(probe), atol=1e-4)


def test_traces_under_a_craniotomy():
    """300 traces with two bands left out: the cortex in the bands and beyond the opening."""
    bent = deformation()
    points = on_ball(12000)
    under = numpy.linalg.norm(points - TOP, axis=1) < OPENING
    band = numpy.abs(numpy.abs(points[:, 0] - MIDDLE) - 9.0) < 4.0
    traced, left_out = points[under & ~band], points[under & band]
    traced = traced[numpy.linspace(0, len(traced) - 1, 300).astype(int)]
    fit = brainshift.fit(bent, traces=sunk(traced), threshold=50.0, opening=(TOP, OPENING))
    assert fit.trace_residuals.shape == (300,)
    rms = numpy.sqrt(numpy.mean(fit.trace_residuals ** 2))
    before = numpy.sqrt(numpy.mean((sunk(traced)[:, 2] - traced[:, 2]) ** 2))
    assert rms < 0.4 < 3.0 < before, (rms, before)
    assert normal_miss(bent, left_out).mean() < 0.9, normal_miss(bent, left_out).mean()
    far = points[numpy.linalg.norm(points - TOP, axis=1) > 60.0]
    assert normal_miss(bent, far).max() < 0.5, normal_miss(bent, far).max()
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    assert bent.MinimumJacobian > 0.5, bent.MinimumJacobian
    assert fit.filter.GetPropertyValue("AnchorCount") > 100
    # Without anchors the cortex elsewhere moves.
    fit.filter.Anchors = 0
    assert normal_miss(bent, far).max() > 0.7, normal_miss(bent, far).max()


def test_a_bend_that_folds_is_shortened_and_said():
    bent = deformation()
    start = numpy.array((MIDDLE,) * 3)
    pulls = [(start, start + (0, 0, 30.0)), (start + (0, 0, 8.0), start - (0, 0, 30.0))]
    with messages() as said:
        fit = brainshift.fit(bent, pulls=pulls)
    assert_says(said.text, "The fold guard applied")
    assert 0.0 < fit.share < 1.0 and fit.relaxation == 1.5, (fit.share, fit.relaxation)
    assert fit.residuals.max() > 5.0
    # What the guard took away is part of the deviation.
    end = numpy.array((pulls[0][1],))
    miss = numpy.linalg.norm(fit.measured_from_rest([start]) - end)
    assert fit.deviation([start])[0] > 0.5 * miss / numpy.sqrt(3), (fit.deviation([start]), miss)
    bent.UpdatePipeline()
    bent.SMProxy.UpdatePropertyInformation()
    assert bent.MinimumJacobian > 0.09, bent.MinimumJacobian


def test_strokes_replay_on_top_and_a_later_fit_takes_the_place():
    start = numpy.array((MIDDLE,) * 3)
    bent = deformation(Strokes=brainshift.soft(start, (0, 0, 4.0), 40.0))
    sources = len(simple.GetSources())
    first = brainshift.fit(bent, pulls=[(start, start + (5.0, 0, 0))])
    moved, = brainshift.deformed_from_rest(bent, [start])
    assert numpy.allclose(moved - start, (5.0, 0, 4.0), atol=0.5), moved - start
    brainshift.fit(bent, rest=scattered(8), measured=scattered(8))
    assert len(simple.GetSources()) == sources + 3, simple.GetSources()
    again = brainshift.fit(bent, pulls=[(start, start + (5.0, 0, 0))])
    assert len(simple.GetSources()) == sources + 1 and again.share == first.share == 1.0


def test_a_deformation_unlike_the_one_that_was_fitted_says_so():
    bent = deformation()
    start = numpy.array((MIDDLE,) * 3)
    fit = brainshift.fit(bent, pulls=[(start, start + (0, 0, 5.0))])
    with messages() as said:
        bent.UpdatePipeline()
    assert "fitted for" not in said.text, said.text
    mask = volume(ball(side=SIDE, radius=40.0 / SPACING), spacing=(SPACING,) * 3)
    for change, fitted, here in (
            ({"Kernel": "B-Spline"}, "Kernel Catmull-Rom", "Kernel B-Spline"),
            ({"Kernel": "Catmull-Rom", "LatticeDimensions": [17, 19, 19]},
             "Lattice Dimensions 19 x 19 x 19", "Lattice Dimensions 17 x 19 x 19"),
            ({"LatticeDimensions": [19, 19, 19], "Mask": mask}, "no mask", "a mask that lets"),
            ({"Mask": None, "Samples": 6}, "Samples 4", "Samples 6")):
        with messages() as said:
            for name, value in change.items():
                setattr(bent, name, value)
            bent.UpdatePipeline()
        assert_says(said.text, f"was fitted for {fitted}. This deformation has {here}")
    fit.filter.Samples = 6
    with messages() as said:
        bent.UpdatePipeline()
    assert "fitted for" not in said.text, said.text


def test_a_mask_of_equal_size_is_another_mask():
    z, y, x = numpy.mgrid[0:SIDE, 0:SIDE, 0:SIDE]
    left, right = (volume((side & (z > 4)).astype(numpy.float32), spacing=(SPACING,) * 3)
                   for side in (x < 20, x > SIDE - 1 - 20))
    bent = deformation(Mask=left)
    brainshift.fit(bent, pulls=[((10.0, MIDDLE, MIDDLE), (12.0, MIDDLE, MIDDLE))])
    with messages() as said:
        bent.UpdatePipeline()
    assert "fitted for" not in said.text, said.text
    with messages() as said:
        bent.Mask = right
        bent.UpdatePipeline()
    assert_says(said.text, "This deformation has another mask that lets")


def test_labels_match_and_those_without_a_partner_are_named():
    rest = scattered(8)
    names = [f"{x},{y},{z},mark {i}" for i, (x, y, z) in enumerate(rest)]

    def file_of(name, rows):
        with open(scratch(name), "w", encoding="utf-8") as file:
            file.write("\n".join(["x,y,z,label", *rows]) + "\n")
        return simple.LandmarkReader(FileName=scratch(name))
    fit = simple.FitDeformation(
        Input=deformation().Input, RestLandmarks=file_of("rest.csv", names),
        MeasuredLandmarks=file_of("measured.csv", [*names[::-1][:-1], "1,2,3,stray"]))
    with messages() as said:
        output(fit)
    assert_says(said.text, "Without a partner: landmark mark 0 at rest, measured landmark stray")
    residuals = brainshift.Fit(fit).landmark_residuals
    assert len(residuals) == 7 and residuals.max() < 1e-3, residuals


def fails(*words, **arguments):
    with messages():
        try:
            brainshift.fit(deformation(), **arguments)
        except ValueError as error:
            assert all(word in str(error) for word in words), error
        else:
            raise AssertionError(f"no error for {arguments}")


def test_errors_name_what_is_wrong():
    fails("rest has 2 points and measured 1", rest=scattered(2), measured=scattered(1))
    fails("traces has the shape", traces=[1.0, 2.0])
    fails("not finite", pins=[(1.0, numpy.nan, 0.0)])
    fails("Threshold is 1000", "gives no cortex", traces=scattered(4), threshold=1000.0)
    fails("threshold and label", traces=scattered(4), threshold=1.0, label=1)
    fails("pulls has the shape", pulls=[(1.0, 2.0, 3.0)])
    fails("The volume has no point array missing", traces=scattered(4), array="missing")
    broken = simple.FitDeformation(Input=deformation().Input, Threshold=1000.0,
                                   Traces=simple.PolyPointSource(Points=[MIDDLE] * 3))
    fails("The fit has not run", traces=scattered(4), opening=broken)


def test_a_fit_that_fails_leaves_the_former_one_and_nothing_of_its_own():
    bent = deformation()
    start = numpy.array((MIDDLE,) * 3)
    first = brainshift.fit(bent, pulls=[(start, start + (5.0, 0, 0))])
    with messages():
        try:
            brainshift.fit(bent, traces=scattered(4), threshold=1000.0)
        except ValueError:
            pass
    assert bent.Lattice == first.filter
    sources = len(simple.GetSources())
    # What a person made, or what something else takes, is not deleted.
    taker = simple.ImageClip(Input=first.filter) if hasattr(simple, "ImageClip") else \
        simple.Calculator(Input=first.filter)
    second = brainshift.fit(bent, rest=scattered(8), measured=scattered(8))
    assert len(simple.GetSources()) == sources + 4 and taker.Input == first.filter
    points = simple.PolyPointSource(Points=scattered(2).ravel().tolist())
    second.filter.Traces = points
    brainshift.fit(bent, pulls=[(start, start)])
    assert points in simple.GetSources().values() and bent.Lattice != second.filter
    own = simple.FitDeformation(Input=bent.Input)
    bent.Lattice = own
    brainshift.fit(bent, pulls=[(start, start)])
    assert own in simple.GetSources().values()


def test_a_fit_that_was_spoiled_has_no_result():
    fit = brainshift.fit(deformation(), traces=on_ball(50), threshold=50.0)
    assert len(fit.measured_from_rest(scattered(2))) == 2
    fit.filter.Threshold = 1000.0
    with messages():
        fit.filter.UpdatePipeline()
    try:
        fit.deviation(scattered(2))
    except RuntimeError as error:
        assert "has no result" in str(error), error
    else:
        raise AssertionError("a fit that failed answers")
    assert len(brainshift.Fit(fit.filter).trace_residuals) == 0


def test_a_pull_that_is_switched_off_does_not_count():
    rest = scattered(12)
    measured, matrix = turned(rest)
    off = [MIDDLE] * 3 + [MIDDLE + 20.0] * 3 + [0.0]
    fit = brainshift.fit(deformation(), rest=rest, measured=measured)
    fit.filter.Pulls = off
    fit.filter.UpdatePipeline()
    again = brainshift.Fit(fit.filter)
    assert numpy.allclose(again.rigid, matrix, atol=1e-4), again.rigid
    assert len(again.pull_residuals) == 1 and numpy.isnan(again.pull_residuals).all()
    # The opening found from traces does not reach to it.
    under = on_ball(3000)
    under = under[numpy.linalg.norm(under - TOP, axis=1) < 15.0]
    fit = brainshift.fit(deformation(), traces=under, threshold=50.0)
    count = fit.filter.GetPropertyValue("AnchorCount")
    fit.filter.Pulls = off[:2] + [MIDDLE - RADIUS] + off[3:]
    fit.filter.UpdatePipeline()
    fit.filter.SMProxy.UpdatePropertyInformation()
    assert fit.filter.GetPropertyValue("AnchorCount") == count > 0


def test_traces_that_all_lie_in_the_cavity_are_said():
    everything = volume(numpy.ones((SIDE,) * 3, numpy.uint8), spacing=(SPACING,) * 3)
    with messages() as said:
        brainshift.fit(deformation(), traces=on_ball(20), cavity=everything, threshold=50.0)
    assert_says(said.text, "All traced points are in the cavity")
    # Of a segmentation after surgery, one label is the cavity and others are tissue.
    labels = numpy.ones((SIDE,) * 3, numpy.uint8)
    labels[0, 0, 0] = 7
    with messages() as said:
        fit = brainshift.fit(deformation(), traces=on_ball(20), threshold=50.0)
        fit.filter.CavityLabels = [7]
        fit.filter.Cavity = volume(labels, spacing=(SPACING,) * 3)
        fit.filter.UpdatePipeline()
    assert "cavity" not in said.text, said.text


def test_few_landmarks_that_turned_far_are_said():
    rest = scattered(5)
    with messages() as said:
        brainshift.fit(deformation(), rest=rest, measured=2 * MIDDLE - rest * (1, 1, -1))
    assert_says(said.text, "The fit rotated the volume by", "check that the pairs match")


def test_an_opening_that_is_cropped_has_its_margin():
    top = int(MIDDLE / SPACING + RADIUS / SPACING)

    box = (slice(top - 4, top + 4), slice(26, 35), slice(26, 35))
    whole = numpy.zeros((SIDE,) * 3, numpy.uint8)
    whole[box] = 1

    def anchors(voxels, first=(0, 0, 0)):
        mask = volume(voxels, origin=[SPACING * i for i in first], spacing=(SPACING,) * 3)
        fit = brainshift.fit(deformation(), traces=[TOP], threshold=50.0, opening=mask)
        return fit.filter.GetPropertyValue("AnchorCount")
    counts = anchors(whole[box], (26, 26, top - 4)), anchors(whole)
    assert counts[0] == counts[1] > 100, counts


def test_anchors_follow_cortex_and_opening():
    """A filter that was changed has the lattice of one that never had other settings."""
    mask = numpy.zeros((SIDE,) * 3, numpy.uint8)
    mask[44:54, 20:40, 20:40] = 1
    first = volume(mask, spacing=(SPACING,) * 3)
    other = volume(numpy.roll(mask, 10, axis=1), spacing=(SPACING,) * 3)
    under = on_ball(3000)
    under = under[numpy.linalg.norm(under - TOP, axis=1) < OPENING]
    voxels = ball(side=SIDE, radius=RADIUS / SPACING) + 0.2 * ball(side=SIDE, radius=20.0)
    bent = simple.FreeFormDeformation(Input=volume(voxels, spacing=(SPACING,) * 3))

    def fitted():
        return brainshift.fit(bent, traces=sunk(under), threshold=50.0).filter

    def lattice(of):
        of.UpdatePipeline()
        return vtk_to_numpy(output(of).GetPointData().GetArray(0)).copy()
    changed, seen = fitted(), []
    settings = {}
    for more in ({}, {"OpeningCentre": list(TOP), "OpeningRadius": 50.0}, {"OpeningRadius": 35.0},
                 {"OpeningCentre": list(TOP + 20.0)}, {"Opening": first}, {"Opening": other},
                 {"Threshold": 110.0}):
        settings.update(more)
        fresh = fitted()
        for name, value in more.items():
            setattr(changed, name, value)
        for name, value in settings.items():
            setattr(fresh, name, value)
        seen.append(lattice(changed))
        assert numpy.array_equal(seen[-1], lattice(fresh)), more
    for before, after in zip(seen, seen[1:]):
        assert abs(after - before).max() > 0.001, "a setting of this test changes nothing"


def test_voxels_that_are_no_number_hold_no_cortex():
    voxels = ball(side=SIDE, radius=RADIUS / SPACING)
    voxels[:20] = numpy.nan
    bent = simple.FreeFormDeformation(Input=volume(voxels, spacing=(SPACING,) * 3))
    fit = brainshift.fit(bent, traces=sunk(on_ball(300)[:10]), threshold=50.0)
    assert numpy.isfinite(fit.trace_residuals).all(), fit.trace_residuals
    assert numpy.isfinite(fit.measured_from_rest(scattered(5))).all()


def test_nothing_measured_bends_nothing():
    fit = brainshift.fit(deformation())
    probe = scattered(3)
    assert numpy.allclose(fit.measured_from_rest(probe), probe, atol=1e-6)
    assert numpy.allclose(fit.rigid, numpy.eye(4)) and len(fit.residuals) == 0
    assert numpy.isposinf(fit.deviation(probe)).all(), fit.deviation(probe)


run_tests(globals())
