# SPDX-License-Identifier: BSD-3-Clause
# Proves that Moments makes bent volumes the time steps of a surgery: at a moment each is as it is,
# between two of them tissue is on its way, and what cannot be interpolated is refused by name.
import numpy
from brainshift_testing import (assert_says, ball, field, load_plugin, messages, output, run_tests,
                                volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, FreeFormDeformation, GetAnimationScene,  # noqa: E402
                             GetTimeKeeper, Moments)

MIDDLE = (16.0, 16.0, 16.0)
UP = brainshift.stamp(MIDDLE, (16, 16, 0), 4.0, major=14.0, minor=12.0)
DOWN = brainshift.stamp((20.0, 16.0, 16.0), (16, 16, 0), -3.0, major=12.0, minor=12.0)


def bent(source, strokes, **settings):
    return FreeFormDeformation(Input=source, Strokes=strokes, **settings)


def displacements(source, time):
    source.UpdatePipeline(time)
    return field(source, "FFDDisplacements") * float(field(source, "FFDStrength")[0])


def refusal(source, time):
    with messages() as said:
        source.UpdatePipeline(time)
    return said.text


def test_a_moment_is_its_input():
    source = volume(ball())
    first, second = bent(source, UP), bent(source, DOWN, Strength=0.5)
    moments = Moments(Input=[first, second], Times=[10.0, 70.0])
    moments.UpdatePipeline(10.0)
    assert list(moments.TimestepValues) == [10.0, 70.0], moments.TimestepValues
    for filter, time in ((first, 10.0), (second, 70.0), (first, -5.0), (second, 500.0)):
        filter.UpdatePipeline()
        moments.UpdatePipeline(time)
        for name in ("FFDDisplacements", "FFDStrength", "FFDDimensions"):
            assert numpy.array_equal(field(moments, name), field(filter, name)), (time, name)
        assert numpy.shares_memory(voxels(moments), voxels(source)), "no voxel is copied"


def test_between_moments_displacements_are_linear_in_time():
    source = volume(ball())
    moments = Moments(
        Input=[bent(source, DOWN, Strength=0.5), bent(source, UP)], Times=[70.0, 10.0])
    late, early = displacements(moments, 70.0), displacements(moments, 10.0)
    assert numpy.abs(late).max() > 1.0 and numpy.abs(early).max() > 3.0
    for time, share in ((25.0, 0.25), (40.0, 0.5), (69.0, 59 / 60)):
        expected = (1.0 - share) * early + share * late
        apart = numpy.abs(displacements(moments, time) - expected).max()
        assert apart < 1e-5, (time, apart)
    moments.Interpolate = 0
    assert numpy.array_equal(displacements(moments, 69.0), early), "it stays until the next"


def test_on_the_way_from_rest_voxels_are_those_of_half_the_strength():
    # Strength is another road to the same picture, with a mask, too.
    source, mask = volume(ball()), volume(ball(radius=12.0))
    for settings in ({}, {"Mask": mask, "Feather": 3.0}, {"Kernel": "B-Spline"}):
        moved = bent(source, UP, **settings)
        bake = BakeDeformation(Input=Moments(Input=[source, moved], Times=[0.0, 8.0]))
        bake.UpdatePipeline(4.0)
        found = voxels(bake).copy()
        half = BakeDeformation(Input=bent(source, UP, Strength=0.5, **settings))
        half.UpdatePipeline()
        assert numpy.abs(found - voxels(half)).max() < 1e-3, settings
        bake.UpdatePipeline(0.0)
        assert numpy.array_equal(voxels(bake), voxels(source)), "at rest nothing is bent"


def test_what_was_not_measured_has_no_deviation():
    source = volume(ball())
    rest = [(10, 16, 16), (22, 16, 16), (16, 10, 16), (16, 22, 16), (16, 16, 22)]
    fits = []
    for shift in (1.0, 2.0):
        filter = bent(source, [])
        measured = [*rest[:-1], (16, 16, 22 + shift)]
        brainshift.fit(filter, rest=rest, measured=measured).filter.Evidence = 1
        fits.append(filter)
    moments = Moments(Input=fits)
    for time, known in ((0.0, True), (0.5, False), (1.0, True)):
        moments.UpdatePipeline(time)
        assert (output(moments).GetFieldData().GetArray("FFDDeviations") is not None) == known, time


def test_between_moments_no_strokes_are_named():
    """A figure between two moments would be noted as one of the strokes of the first."""
    source = volume(ball())
    moments = Moments(Input=[bent(source, UP), bent(source, DOWN), source])
    for time, known in ((0.0, True), (0.5, False), (1.0, True), (1.5, False), (2.0, False)):
        moments.UpdatePipeline(time)
        marks = output(moments).GetFieldData().GetAbstractArray("FFDStrokeMarks")
        assert (marks is not None) == known, time


def test_strokes_at_a_moment_are_followed():
    source = volume(ball())
    first, second = bent(source, UP), bent(source, DOWN)
    moments = Moments(Input=[first, second])
    before = displacements(moments, 0.5)
    second.Strokes = UP
    after = displacements(moments, 0.5)
    assert numpy.abs(after - displacements(moments, 0.0)).max() < 1e-5
    assert numpy.abs(after - before).max() > 1.0


def test_playing_goes_through_the_moments():
    source = volume(ball())
    Moments(Input=[bent(source, UP), bent(source, DOWN), source], Times=[0.0, 45.0, 95.0])
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.PlayMode = "Snap To TimeSteps"
    keeper = GetTimeKeeper()
    scene.GoToFirst()
    met = [keeper.Time]
    while keeper.Time < 95.0:
        scene.GoToNext()
        assert keeper.Time > met[-1], met
        met.append(keeper.Time)
    assert {0.0, 45.0, 95.0} <= set(met), met


def test_wrong_times_are_refused():
    source = volume(ball())
    pair = [bent(source, UP), bent(source, DOWN)]
    for times, words in (([5.0], ("2 inputs", "1 Times")), ([5.0, 5.0], ("Two moments", "5")),
                         ([5.0, float("nan")], ("not a finite number",))):
        assert_says(refusal(Moments(Input=pair, Times=times), 5.0), *words)


def test_moments_that_differ_are_refused_by_name():
    source, mask = volume(ball()), volume(ball(radius=12.0))
    first = bent(source, UP)
    for name, settings in (("LatticeDimensions", {"LatticeDimensions": [9, 9, 9]}),
                           ("Kernel", {"Kernel": "B-Spline"}),
                           ("Samples", {"Samples": 2}), ("Inverse", {"Inverse": "Negated"}),
                           ("Mask", {"Mask": mask})):
        moments = Moments(Input=[first, bent(source, UP, **settings)])
        assert not refusal(moments, 1.0), "at a moment nothing is interpolated"
        assert_says(refusal(moments, 0.5), name, "Interpolate")
        moments.Interpolate = 0
        assert not refusal(moments, 0.5)
    other = volume(ball(), spacing=(1.0, 1.0, 2.0))
    assert_says(refusal(Moments(Input=[first, bent(other, UP)]), 0.0), "other points")


def test_a_fold_on_the_way_is_said():
    # Two halves of the volume change places: half way all tissue is in one plane.
    source = volume(ball())
    far = brainshift.stamp(MIDDLE, (16, 16, 0), 14.0, major=9.0, minor=9.0)
    folded = bent(source, far, GuardFolding=0)
    moments = Moments(Input=[source, folded])
    assert_says(refusal(moments, 0.9), "folds tissue", "add a moment")


run_tests(globals())
