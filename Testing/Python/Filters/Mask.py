# SPDX-License-Identifier: BSD-3-Clause
# Proves that with a mask only tissue inside it moves, in the picture, in slices, in geometry and
# in exported fields, as in the baked volume. It uses the brain of a real head, whose skull stays,
# and a ball whose picture is compared with that of the baked ball.
import numpy
from brainshift_testing import (assert_says, ball, data, field, load_plugin, mean_difference,
                                messages, object_pixels, output, picture, run_tests, scratch,
                                show_volume, view_along, voxels, volume)
from slices_testing import flat_view, show_slices
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, DeformationField, Delete,  # noqa: E402
                             FreeFormDeformation, OpenDataFile)

MIDDLE = (32.0, 32.0, 32.0)
BRAIN, SKULL = 1, 2
# The plane z = 32 divides the ball. Only tissue below it may move.
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
    """A ball bent across the edge of the mask, which holds the tissue there."""
    strokes = brainshift.soft((32, 32, 24), (7, -5, -4), 30.0) + brainshift.stamp(
        (32, 32, 32), (32, 32, 0), 6.0, major=26.0, minor=20.0)
    return FreeFormDeformation(Input=volume(ball(side=65, radius=20.0, edge=16.0)),
                               **{"Strokes": strokes, "MaskGrowth": 0.0, **properties})


def test_a_stroke_at_the_edge_says_how_little_it_reached():
    anchor, asked = (32.0, 32.0, 31.0), 8.0
    stamp = brainshift.stamp(anchor, (32, 32, 0), -asked, major=26.0, minor=20.0)
    reached = {}
    for name, properties in (("masked", {"Mask": lower_half(), "MaskLabels": [1]}), ("free", {})):
        filter = bent_ball(Strokes=stamp, **properties)
        filter.UpdatePipeline()
        filter.UpdatePropertyInformation()
        went = brainshift.deformed_from_rest(filter, [anchor])[0] - numpy.array(anchor)
        reached[name] = float(numpy.atleast_1d(filter.StrokeReaches)[0])  # one is no list
        assert abs(reached[name] + went[2]) < 0.01, (name, reached, went)
    assert reached["masked"] < 0.1 * asked < 0.9 * asked < reached["free"], reached


def test_by_default_the_edge_moves_all_the_way_and_tissue_far_beyond_does_not():
    asked = 8.0
    strokes = brainshift.stamp((32, 32, 31), (32, 32, 0), -asked, major=26.0, minor=20.0)
    filter = FreeFormDeformation(Input=volume(ball(side=65, radius=20.0, edge=16.0)),
                                 Strokes=strokes, Mask=lower_half(), MaskLabels=[1])
    with messages() as said:
        filter.UpdatePipeline()
    assert said.text == "", said.text
    for feather in (10.0, 14.0):  # the growth follows it
        filter.Feather = feather
        filter.UpdatePipeline()
        filter.UpdatePropertyInformation()
        reached = float(numpy.atleast_1d(filter.StrokeReaches)[0])
        assert reached > 0.9 * asked, (feather, reached)
        before, after = voxels(filter.Input), voxels(BakeDeformation(Input=filter))
        assert (after == before)[EDGE + int(feather) + 14:].all(), "12 mm more, and voxels"
        assert (after != before)[EDGE:EDGE + 6].any(), feather


def test_growth_lets_the_edge_move_and_the_filter_names_it():
    asked = 8.0
    stamp = brainshift.stamp((32, 32, 31), (32, 32, 0), -asked, major=26.0, minor=20.0)
    with messages() as said:
        filter = bent_ball(Strokes=stamp, Mask=lower_half(), MaskLabels=[1], Feather=6.0)
        filter.UpdatePipeline()
        filter.Strength = 0.5
        filter.UpdatePipeline()
        filter.Strokes = 2 * stamp  # one more does not interrupt again
        filter.UpdatePipeline()
        filter.Strokes = stamp
    words = "The mask holds back the tissue at the anchor of stroke 1"
    assert said.text.count(words) == 1, said.text
    with messages() as said:
        filter.MaskGrowth = 12.0
        filter.UpdatePipeline()
    assert said.text == "", said.text
    filter.UpdatePropertyInformation()
    reached = float(numpy.atleast_1d(filter.StrokeReaches)[0])
    assert reached > 0.9 * asked, reached
    filter.Strength = 1.0
    before, after = voxels(filter.Input), voxels(BakeDeformation(Input=filter))
    # The mask lies on voxels of 2 mm: it may end a voxel above the plane.
    assert (after == before)[EDGE + 14:].all(), "12 mm above the plane nothing moves"
    assert (after != before)[EDGE:EDGE + 6].any(), "below that the edge does"


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


def test_slices_are_those_of_the_baked_volume():
    masked = bent_ball(Mask=lower_half(), MaskLabels=[1], Feather=6.0)
    images = []
    for shown in (masked, BakeDeformation(Input=masked, Interpolation="Cubic"), bent_ball()):
        view = flat_view(0, MIDDLE, 32.0)
        show_slices(shown, view, ("Sagittal",), MIDDLE)
        images.append(picture(view))
        Delete(view)
    drawn, baked, free = images
    print(f"  differs by {100 * mean_difference(drawn, baked):.3f} %, without the mask by "
          f"{100 * mean_difference(free, baked):.2f} %", flush=True)
    assert mean_difference(drawn, baked) < 0.001
    assert mean_difference(free, baked) > 0.005
    half = drawn.shape[0] // 2 + 3  # rows above the edge
    unbent = bent_ball(Strokes=())
    view = flat_view(0, MIDDLE, 32.0)
    show_slices(unbent, view, ("Sagittal",), MIDDLE)
    above = numpy.abs(picture(view) - drawn)[half:]
    assert above.max() < 1.5 / 255.0, "above the edge nothing moves"  # programs may round apart
    Delete(view)


def test_geometry_and_exported_fields_are_those_of_the_mask():
    """The same map everywhere: outside it is none, inside it is the one that bakes."""
    masked = bent_ball(Mask=lower_half(), MaskLabels=[1], Feather=6.0)
    random = numpy.random.default_rng(8)
    above = random.uniform((2, 2, EDGE), (62, 62, 62), (2000, 3))
    below = random.uniform((8, 8, 8), (56, 56, 26), (2000, 3))
    assert numpy.array_equal(brainshift.deformed_from_rest(masked, above), above)
    assert numpy.array_equal(brainshift.rest_from_deformed(masked, above), above)
    there = brainshift.deformed_from_rest(masked, below)
    assert numpy.abs(there - below).max() > 3.0
    assert numpy.abs(brainshift.rest_from_deformed(masked, there) - below).max() < 0.01
    free = brainshift.deformed_from_rest(bent_ball(), above)
    assert numpy.abs(free - above).max() > 3.0, "without the mask both halves move"

    forward = DeformationField(Input=masked, Direction="Forward")
    file = scratch("Mask-field.nii.gz")
    brainshift.save_field(masked, file)
    backward = OpenDataFile(file)
    for field_image, towards in ((forward, brainshift.deformed_from_rest),
                                 (backward, brainshift.rest_from_deformed)):
        field_image.UpdatePipeline()
        image = output(field_image)
        vectors = next(image.GetPointData().GetArray(i)
                       for i in range(image.GetPointData().GetNumberOfArrays())
                       if image.GetPointData().GetArray(i).GetNumberOfComponents() == 3)
        sides = image.GetDimensions()
        displacements = vtk_to_numpy(vectors).reshape(sides[2], sides[1], sides[0], 3)
        assert image.GetSpacing()[2] == 1.0 and abs(image.GetOrigin()[2]) < 1e-6
        assert not displacements[EDGE:].any(), "above the edge nothing moves"
        points = random.integers((8, 8, 8), (56, 56, 26), (500, 3))
        moved = points + displacements[points[:, 2], points[:, 1], points[:, 0]]
        assert numpy.abs(moved - towards(masked, points)).max() < 0.02, towards
        assert numpy.abs(moved - points).max() > 3.0, towards


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
    # A stroke redoes only a part of the fields. A new filter computes all of them.
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
    filter = FreeFormDeformation(Input=labels, Mask=mask, Feather=8.0, MaskGrowth=0.0,
                                 Strokes=strokes)
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
