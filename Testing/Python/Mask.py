# SPDX-License-Identifier: BSD-3-Clause
# Proves that with a mask only tissue inside it moves, in the picture as in the baked volume: the
# brain of a real head, whose skull stays, and a ball whose picture is compared with the baked one.
import numpy
from brainshift_testing import (assert_says, ball, data, field, load_plugin, mean_difference,
                                messages, object_pixels, output, picture, run_tests, show_volume,
                                view_along, voxels, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, Delete, FreeFormDeformation,  # noqa: E402
                             OpenDataFile)

MIDDLE = (32.0, 32.0, 32.0)
BRAIN, SKULL = 1, 2
# The plane z = 32 parts the ball; only what is below it may move.
EDGE = 32
COLORS = [0, 0, 0, 0, 100, 1, 1, 1]
OPACITIES = [0, 0, 0.5, 0, 30, 0, 0.5, 0, 50, 0.5, 0.5, 0, 100, 0.8, 0.5, 0]


def lower_half():
    """A mask on a coarser grid that shares no axis with the volume: 1 below the plane, 0 above it,
    and 5 far away."""
    turn = numpy.radians(30.0)
    direction = numpy.array([[numpy.cos(turn), -numpy.sin(turn), 0.0],
                             [numpy.sin(turn), numpy.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    side, spacing = 60, 2.0
    origin = numpy.array(MIDDLE) - direction @ numpy.array([side - 1, side - 1, 41]) * spacing / 2
    z = origin[2] + spacing * numpy.arange(42)
    labels = numpy.where(z < EDGE, 1, 0)[:, None, None] * numpy.ones((42, side, side))
    labels[:, 0, 0] = 5
    return volume(labels.astype(numpy.uint8), origin=origin, spacing=(spacing,) * 3,
                  direction=direction.ravel())


def bent_ball(**properties):
    strokes = brainshift.soft((32, 32, 24), (7, -5, -4), 30.0) + brainshift.stamp(
        (32, 32, 32), (32, 32, 0), 6.0, major=26.0, minor=20.0)
    return FreeFormDeformation(
        Input=volume(ball(side=65, radius=20.0, edge=16.0)), Strokes=strokes, **properties)


def test_only_what_is_inside_moves():
    filter = bent_ball(Mask=lower_half(), MaskLabels=[1], Feather=6.0)
    before = voxels(filter.Input)
    after = voxels(BakeDeformation(Input=filter))
    still = after == before
    assert still[EDGE:].all(), "above the plane nothing moves"
    assert (~still[:EDGE]).sum() > 5000, "below it does"
    free = voxels(BakeDeformation(Input=bent_ball()))
    assert (free != before)[EDGE:].sum() > 5000, "without the mask both do"
    weights = field(filter, "FFDMaskWeights")
    assert weights.size == 91 ** 3 and weights.min() == 0.0 and weights.max() == 1.0
    filter.UpdatePropertyInformation()
    assert filter.MinimumJacobian > 0.0999, filter.MinimumJacobian


def test_the_picture_is_that_of_the_baked_volume():
    masked = bent_ball(Mask=lower_half(), MaskLabels=[1], Feather=6.0)
    images = []
    for shown, kind in ((masked, "Deformed Volume"),
                        (BakeDeformation(Input=masked, Interpolation="Cubic"), "Volume"),
                        (bent_ball(), "Deformed Volume")):
        view = view_along((-1.0, 0.4, -0.2), MIDDLE, 180.0, up=(0, 0, 1))
        show_volume(shown, view, kind, COLORS, OPACITIES)
        images.append(picture(view))
        Delete(view)
    drawn, baked, free = images
    difference = mean_difference(drawn, baked)
    print(f"  differs by {100 * difference:.3f} %, without the mask by "
          f"{100 * mean_difference(free, baked):.2f} %", flush=True)
    assert object_pixels(baked).mean() > 0.05
    assert difference < 0.001, difference
    assert mean_difference(free, baked) > 0.003


def test_the_picture_follows_the_mask():
    filter = bent_ball(Mask=lower_half(), Feather=6.0)
    view = view_along((-1.0, 0.4, -0.2), MIDDLE, 180.0, up=(0, 0, 1))
    show_volume(filter, view, "Deformed Volume", COLORS, OPACITIES)
    soft = picture(view)
    filter.Feather = 20.0
    softer = picture(view)
    filter.Mask = None
    free = picture(view)
    filter.Feather = 6.0
    filter.Mask = lower_half()
    again = picture(view)
    print(f"  feather {100 * mean_difference(soft, softer):.2f} %, no mask "
          f"{100 * mean_difference(soft, free):.2f} %", flush=True)
    assert mean_difference(soft, softer) > 0.0005
    assert mean_difference(soft, free) > 0.003
    assert numpy.array_equal(soft, again)
    # A stroke redoes a part of the fields only; what a new filter does is all of them.
    strokes = tuple(filter.Strokes) + brainshift.soft((40, 40, 22), (-4, -3, 2), 16.0)
    filter.Strokes = strokes
    bent = picture(view)
    Delete(view)
    view = view_along((-1.0, 0.4, -0.2), MIDDLE, 180.0, up=(0, 0, 1))
    fresh = bent_ball(Mask=filter.Mask, Feather=6.0)
    fresh.Strokes = strokes
    show_volume(fresh, view, "Deformed Volume", COLORS, OPACITIES)
    assert mean_difference(bent, again) > 0.0005
    assert numpy.abs(bent - picture(view)).max() < 0.02
    Delete(view)


def test_no_skull_appears_in_a_brain():
    mask = OpenDataFile(data("seg3d-utah", "seg3d_brainmask.nii.gz"))
    inside = voxels(mask, output(mask).GetPointData().GetArrayName(0)) > 0
    image = output(mask)
    labels = volume(numpy.where(inside, BRAIN, SKULL).astype(numpy.uint8),
                    origin=image.GetOrigin(), spacing=image.GetSpacing())
    strokes = ()
    for anchor, amount in (((-342, 36, 534), -14), ((-270, 30, 530), 12), ((-309, 80, 500), -12)):
        strokes += brainshift.stamp(anchor, (-309, 22, 477), amount)
    filter = FreeFormDeformation(Input=labels, Mask=mask, Feather=8.0, Strokes=strokes)
    baked = BakeDeformation(Input=filter, Interpolation="Nearest")
    after = voxels(baked)
    assert numpy.array_equal(after[~inside], numpy.full((~inside).sum(), SKULL))
    assert (after[inside] != BRAIN).sum() == 0
    filter.UpdatePropertyInformation()
    assert filter.MaximumDisplacement > 4.0, filter.MaximumDisplacement
    assert filter.MinimumJacobian > 0.0999, filter.MinimumJacobian
    filter.Mask = None
    assert (voxels(baked)[inside] != BRAIN).sum() > 1000, "without the mask skull comes in"


def test_what_is_no_mask_is_told():
    filter = bent_ball()
    good = field(filter, "FFDDisplacements")
    for mask, labels, words in (
            (volume(ball(), origin=(500, 0, 0)), [], ("does not overlap the volume", "x 499.5 to")),
            (lower_half(), [1, 9], ()),
            (lower_half(), [9], ("no voxel of label 9",)),
            (volume(numpy.ones((4, 4, 4, 3), numpy.float32)), [], ("one component",))):
        filter.MaskLabels = labels
        filter.Mask = mask
        with messages() as said:
            filter.UpdatePipeline()
        assert_says(said.text, *words, *(["stays as it was"] if words else []))
        if words:
            assert numpy.array_equal(field(filter, "FFDDisplacements"), good)
        filter.Mask = None


run_tests(globals())
