# SPDX-License-Identifier: BSD-3-Clause
# Proves that an animation of Strength bends the volume step by step, in the numbers that the
# filter reports and in the bent voxels.
import math

import numpy
from brainshift_testing import ball, load_plugin, run_tests, volume, voxels

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, CompositeKeyFrame,  # noqa: E402
                             FreeFormDeformation, GetAnimationScene, GetAnimationTrack)

MIDDLE = (16.0, 16.0, 16.0)
AMOUNT = 4.0
FRAMES = 5


def height(bake):
    """Height (mm) of a bent ball's centre of mass."""
    mass = voxels(bake).sum(axis=(1, 2))
    return (mass * numpy.arange(mass.size)).sum() / mass.sum()


def test_strength_is_animated():
    filter = FreeFormDeformation(Input=volume(ball(radius=6.0)), Strokes=brainshift.stamp(
        MIDDLE, (16, 16, 0), AMOUNT, major=14.0, minor=12.0))
    bake = BakeDeformation(Input=filter)
    expected = []
    for frame in range(FRAMES):
        filter.Strength = frame / (FRAMES - 1)
        expected.append(height(bake))
    assert math.isclose(expected[0], MIDDLE[2], abs_tol=1e-3), expected
    assert expected[-1] > MIDDLE[2] + 0.3 * AMOUNT, expected

    scene = GetAnimationScene()
    scene.PlayMode = "Sequence"
    scene.NumberOfFrames = FRAMES
    cue = GetAnimationTrack("Strength", proxy=filter)
    cue.KeyFrames = [CompositeKeyFrame(KeyTime=0.0, KeyValues=[0.0]),
                     CompositeKeyFrame(KeyTime=1.0, KeyValues=[1.0])]
    scene.GoToFirst()
    for frame in range(FRAMES):
        strength = frame / (FRAMES - 1)
        bake.UpdatePipeline()
        filter.UpdatePropertyInformation()
        moved = filter.MaximumDisplacement
        assert math.isclose(moved, AMOUNT * strength, abs_tol=1e-5), (frame, moved)
        assert math.isclose(height(bake), expected[frame], abs_tol=1e-5), frame
        scene.GoToNext()


run_tests(globals())
