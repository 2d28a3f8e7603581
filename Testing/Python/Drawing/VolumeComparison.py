# SPDX-License-Identifier: BSD-3-Clause
# Proves that "Deformed Volume" shows a reference that Compare Volumes attached: the volume red,
# the reference green, and surfaces that agree yellow, each as bright as it is alone, wherever the
# reference lies. Skipping changes no bit of the picture. A stroke uploads only the lattice.
import itertools
import re

import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, object_pixels,
                                picture, run_tests, show_volume, use_headlight, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (BakeDeformation, CompareVolumes, Delete,  # noqa: E402
                             FreeFormDeformation, NIFTIVolumeReader)
from skipping_testing import OBLIQUE, assert_same, bent, curves, scattered  # noqa: E402

WHITE = [0, 1, 1, 1, 100, 1, 1, 1]
OPAQUE = [0, 0, 0.5, 0, 40, 0, 0.5, 0, 60, 1, 0.5, 0, 100, 1, 0.5, 0]
FOG = [0, 0, 0.5, 0, 20, 0, 0.5, 0, 100, 0.1, 0.5, 0]
LEVEL = 1.0 / 255.0
MIDDLE = (16.0, 16.0, 16.0)
STROKE = brainshift.soft((16, 16, 22), (0, 0, 5), 14)
LATTICE_BYTES = 19 ** 3 * 3 * 4


def new_view(direction=(0.3, 0.2, -1), focus=MIDDLE, half_height=20.0, size=150):
    view = view_along(direction, focus, 90.0, half_height=half_height, size=size)
    use_headlight(view)
    return view


def shown(source, view, opacities=OPAQUE, colors=WHITE, shade=True, **named):
    display = show_volume(source, view, "Deformed Volume", colors, opacities, shade=shade)
    for name, value in named.items():
        setattr(display, name, value)
    return display


def drawn(source, opacities=OPAQUE, colors=WHITE, shade=True, view=None, **named):
    """A picture of a volume in white, or of what it carries in red and green."""
    own = view or new_view()
    display = shown(source, own, opacities, colors, shade, **named)
    image = picture(own)
    (Delete(own) if view is None else Delete(display))
    return image


def test_a_volume_agrees_with_itself():
    # All of it is yellow, and each colour is as bright as the volume alone in white.
    voxels = ball(radius=10.0)
    bent_ball = FreeFormDeformation(Input=volume(voxels), Strokes=STROKE, Strength=0.0)
    compare = CompareVolumes(Input=bent_ball, Reference=volume(voxels))
    for opacities, shade in itertools.product((OPAQUE, FOG), (True, False)):
        alone = drawn(bent_ball, opacities, shade=shade)
        both = drawn(compare, opacities, shade=shade)
        assert not both[:, :, 2].any()
        apart = [numpy.abs(both[:, :, color] - alone[:, :, color]).max() for color in (0, 1)]
        print(f"  red and green differ from the volume alone by at most {apart}", flush=True)
        assert max(apart) < 2.5 * LEVEL, (shade, apart)
    off = drawn(compare, VolumeComparison="Off")
    assert (off == drawn(bent_ball)).all(), "off is the volume alone"
    bent_ball.Strength = 1.0
    differ = numpy.abs(drawn(compare)[:, :, 0] - drawn(compare)[:, :, 1])
    assert differ.max() > 0.5, "a bent one does not agree"


def test_colours_tell_what_is_where():
    # Two balls, one beside the other. The reference lies beyond the volume's box on its own grid.
    # Red covers what the volume alone covers, and green what the reference alone covers.
    own = volume(ball(radius=7.0))
    other = volume(ball(side=23, radius=6.0), origin=(28.0, 4.0, 3.0), spacing=(0.9, 1.0, 1.1))
    compare = CompareVolumes(Input=own, Reference=other)
    view = new_view(focus=(27.0, 16.0, 16.0), half_height=22.0)
    alone = [drawn(source, view=view) for source in (own, other)]
    both = drawn(compare, view=view)
    overlap = (object_pixels(alone[0]) & object_pixels(alone[1])).sum()
    assert overlap == 0 and min(object_pixels(image).sum() for image in alone) > 700
    for color in (0, 1):
        apart = numpy.abs(both[:, :, color] - alone[color][:, :, color])
        wrong = int((apart > 6 * LEVEL).sum())  # samples fall elsewhere on the edge
        assert wrong <= 0.01 * object_pixels(alone[color]).sum(), (color, wrong, apart.max())
    assert not both[:, :, 2].any()
    Delete(view)


def test_the_one_before_hides_the_other():
    for height, color in ((26.0, 1), (6.0, 0)):
        other = volume(ball(center=(16, 16, height), radius=5.0))
        compare = CompareVolumes(Input=volume(ball(radius=5.0)), Reference=other)
        image = drawn(compare, view=new_view(direction=(0, 0, -1)))
        middle = image[75, 75]
        assert middle[color] > 0.8 and middle[1 - color] < 2 * LEVEL, (height, middle)


def test_agreement_is_a_distance_between_surfaces():
    # One ball inside the other. Surfaces are yellow up to half the distance, and red or green above
    # one and a half of it, on the flanks too, where rays meet the surfaces far apart.
    inner = volume(ball(side=41, radius=14.0))
    middle = (20.0, 20.0, 20.0)
    for apart, distance, yellow in ((1.0, 0.0, True), (3.3, 0.0, False), (2.0, 1.0, False),
                                    (2.0, 6.0, True)):
        outer = volume(ball(side=41, radius=14.0 + apart))
        for compare, front in ((CompareVolumes(Input=outer, Reference=inner), 0),
                               (CompareVolumes(Input=inner, Reference=outer), 1)):
            image = drawn(compare, view=new_view(focus=middle, half_height=20.0),
                          AgreementDistance=distance)
            row, column = numpy.mgrid[0:150, 0:150]
            radius = numpy.hypot(row - 74.5, column - 74.5) * 40.0 / 150
            within = radius < 0.9 * 14.0
            behind = image[:, :, 1 - front][within] / image[:, :, front][within]
            wanted = (behind > 0.65) if yellow else (behind < 0.1)  # light differs, too
            print(f"  {apart} mm at {distance} mm: {100 * wanted.mean():.1f} % right", flush=True)
            assert wanted.mean() > 0.98, (apart, distance, front, wanted.mean())


def yellow_share(compare, view):
    """Of the pixels that show anything, those that are closer to yellow than to red or green."""
    image = drawn(compare, view=view)
    red, green = image[:, :, 0], image[:, :, 1]
    pixels = object_pixels(image)
    return (numpy.minimum(red, green)[pixels] > 0.5 * numpy.maximum(red, green)[pixels]).mean()


def test_a_bent_volume_agrees_with_its_bake():
    x, y, z = numpy.meshgrid(*[numpy.arange(49.0)] * 3, indexing="ij")
    waves = 3.0 * numpy.sin(x / 3.0) * numpy.sin(y / 4.0) * numpy.sin(z / 3.5)
    folds = numpy.clip(50.0 + 12.0 * (18.0 + waves - numpy.linalg.norm(
        [x - 24.0, y - 24.0, z - 24.0], axis=0)), 0, 100).astype(numpy.float32)
    source = volume(folds)
    bent_folds = FreeFormDeformation(Input=source, Strokes=brainshift.stamp(
        (24, 24, 40), (24, 24, 24), -7.0, 26.0, 20.0))
    baked = BakeDeformation(Input=bent_folds, Interpolation="Cubic")
    view = new_view((0.2, 0.1, -1), (24.0, 24.0, 24.0), 26.0)
    agreed = yellow_share(CompareVolumes(Input=bent_folds, Reference=baked), view)
    control = yellow_share(CompareVolumes(Input=source, Reference=baked), view)
    print(f"  yellow: {100 * agreed:.1f} %, unbent {100 * control:.1f} %", flush=True)
    assert agreed > 0.98, agreed
    assert control < 0.85, control
    Delete(view)


def smooth_blobs(grid_points):
    """Blobs without an edge at positions (mm), shaped as the positions."""
    values = numpy.zeros(grid_points.shape[:-1])
    for middle, width, height in (((14, 15, 17), 6.0, 100.0), ((22, 20, 14), 4.0, 90.0)):
        squared = ((grid_points - middle) ** 2).sum(axis=-1)
        values = numpy.maximum(values, height * numpy.exp(-squared / (2 * width ** 2)))
    return values.astype(numpy.float32)


def positions(dimensions, origin=(0, 0, 0), spacing=(1, 1, 1)):
    """World positions of a grid's points, indexed [z, y, x, axis]."""
    z, y, x = numpy.mgrid[[slice(0, n) for n in reversed(dimensions)]].astype(float)
    return numpy.stack([x, y, z], axis=-1) * spacing + origin


def test_a_moved_reference_on_another_grid():
    # A reference on a grid of its own, brought into place by rotation and translation, gives the
    # picture of the same reference resampled to the volume's grid.
    own = FreeFormDeformation(Input=volume(smooth_blobs(positions((33, 33, 33)))), Strokes=STROKE)
    dimensions, origin, spacing = (35, 29, 41), (1.0, -2.0, -3.0), (0.9, 1.1, 0.8)
    turn, move = numpy.radians(30.0), numpy.array((2.5, -1.0, 1.5))
    turned = numpy.array([[numpy.cos(turn), -numpy.sin(turn), 0],
                          [numpy.sin(turn), numpy.cos(turn), 0], [0, 0, 1]])
    placed = positions(dimensions, origin, spacing)
    middle = numpy.array(origin) + (numpy.array(dimensions) - 1) * spacing / 2
    in_place = (placed - middle) @ turned.T + middle + move
    reference = volume(smooth_blobs(in_place), origin, spacing)
    moved = CompareVolumes(Input=own, Reference=reference, ReferenceRotation=[0, 0, 30.0],
                           ReferenceTranslation=move)
    unmoved = CompareVolumes(Input=own, Reference=reference)
    resampled = CompareVolumes(Input=own,
                               Reference=volume(smooth_blobs(positions((33, 33, 33)))))
    for opacities in (OPAQUE, FOG):
        images = [drawn(compare, opacities) for compare in (moved, resampled, unmoved)]
        pixels = object_pixels(*images[:2])
        differ, control = (numpy.abs(image - images[1])[pixels].mean()
                           for image in (images[0], images[2]))
        print(f"  moved: {100 * differ:.2f} %, not moved: {100 * control:.2f} %", flush=True)
        assert differ < 0.01 and control > 8 * differ, (differ, control)


def test_skipping_is_exact():
    # Pictures and first hits are equal to the bit, with lattices that fold, with a turned reference
    # on another grid that stands out of the volume's box, and with the eye inside both.
    source = volume(scattered())
    other = volume(scattered(seed=5)[:, 2:17, :], (6.0, -3.0, 4.0), (1.3, 0.8, 1.1))
    for amplitude, opacities in itertools.product((0.0, 20.0), ("opaque", "translucent", "band")):
        compare = CompareVolumes(Input=bent(source, amplitude), Reference=other,
                                 ReferenceRotation=[20.0, -35.0, 50.0],
                                 ReferenceTranslation=[3.0, 1.0, -2.0])
        view = view_along(OBLIQUE, (13.0, 10.0, 10.0), 80.0, size=100)
        display = show_volume(compare, view, "Deformed Volume", *curves(opacities), shade=True)
        assert_same(view, display, f"{amplitude:.0f} voxels, {opacities}")
        for distance in (12.0, 5.0):
            view.CameraPosition = [13.0 + distance / 2, 10.0, 10.0 + distance / 2]
            assert_same(view, display, f"the same from {distance} mm")
        Delete(view)


def test_skipping_is_exact_inside_the_reference():
    own = volume(ball(inside=1.0, radius=4.0, center=(13, 12, 6)))
    compare = CompareVolumes(Input=own, Reference=volume(ball(inside=1.0), (3.0, 0.0, 0.0)))
    view = view_along(OBLIQUE, (19.0, 16.0, 16.0), 0.5, size=100)
    display = show_volume(compare, view, "Deformed Volume", *curves("translucent"), shade=True)
    assert_same(view, display, "the eye inside the reference", 0.9)
    Delete(view)


def test_each_alone_and_nothing_else():
    # If nothing of one of them is visible, the other one is still shown.
    nothing = volume(numpy.zeros((33, 33, 33), numpy.float32))
    full = volume(ball(radius=8.0))
    for own, other, color in ((nothing, full, 1), (full, nothing, 0)):
        image = drawn(CompareVolumes(Input=own, Reference=other), VolumeReferenceRange=[0, 100])
        seen = object_pixels(image)
        assert seen.mean() > 0.1 and not image[:, :, 1 - color].any(), color


def test_a_stroke_uploads_the_lattice_only():
    own = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    compare = CompareVolumes(Input=own, Reference=volume(ball(side=27)))
    view = new_view()
    display = shown(compare, view)
    first = picture(view)
    before = brainshift.counters(display)
    assert before["volumeUploads"] == 2, before
    own.Strokes = brainshift.soft((16, 16, 22), (0, 4, 3), 12)
    second = picture(view)
    after = brainshift.counters(display)
    assert after["bytesUploaded"] - before["bytesUploaded"] == LATTICE_BYTES, (before, after)
    assert after["programsCompiled"] == before["programsCompiled"], (before, after)
    assert (second != first).any()
    compare.ReferenceTranslation = (0.0, 4.0, 0.0)
    third = picture(view)
    moved = brainshift.counters(display)
    for name in ("bytesUploaded", "presenceUpdates", "programsCompiled"):
        assert moved[name] == after[name], (name, after, moved)
    assert (third != second).any()
    Delete(view)


def test_a_volume_with_colours_of_its_own():
    # Only its opacity counts, which is the last of four numbers. The reference has its own map.
    opacity = 2.55 * ball(center=(12, 16, 16), radius=5.0)
    colored = numpy.stack([0 * opacity, 0 * opacity, 255 + 0 * opacity, opacity], axis=-1)
    own = volume(colored.astype(numpy.uint8))
    reference = volume((2.55 * ball(center=(24, 16, 16), radius=5.0)).astype(numpy.uint8))
    view = new_view(direction=(0, 0, -1))
    display = shown(CompareVolumes(Input=own, Reference=reference), view,
                    [0, 0, 0.5, 0, 100, 0, 0.5, 0, 150, 1, 0.5, 0],
                    colors=[-300, 1, 1, 1, 600, 1, 1, 1])
    display.MapScalars = 0
    image = picture(view)
    for color in (0, 1):
        area = (image[:, :, color] > 0.3).sum() * (40.0 / 150) ** 2
        assert 0.85 < area / (numpy.pi * 5.0 ** 2) < 1.1, (color, area)
    assert not image[:, :, 2].any()
    display.EmptySpaceSkipping = 0
    assert (picture(view) == image).all()
    Delete(view)


def test_without_a_reference_nothing_is_added():
    counted = {}
    own = volume(ball())
    for name, source in (("alone", own), ("off", CompareVolumes(Input=own, Reference=own))):
        view = new_view()
        display = shown(source, view)
        display.VolumeComparison = "Two colours" if name == "alone" else "Off"
        picture(view)
        counted[name] = {**brainshift.counters(display), **brainshift.gpu(display)}
        counted[name].pop("gpuFieldMicroseconds")
        Delete(view)
    assert counted["alone"] == counted["off"], counted
    assert counted["alone"]["volumeUploads"] == 1, counted


def test_picks_find_the_bent_tissue():
    # This holds behind the reference too, because a tool must take hold of what it moves.
    own = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    before = volume(ball(radius=7.0), origin=(0.0, 0.0, 22.0))
    view = new_view(direction=(0, 0, -1))
    places = {}
    for name, source in (("alone", own), ("compared", CompareVolumes(Input=own, Reference=before))):
        display = shown(source, view)
        image = picture(view)
        places[name] = [brainshift.pick(display, view, x, 75) for x in range(0, 150, 5)]
        Delete(display)
    assert image[75, 75, 1] > 0.8 and image[75, 75, 0] < 0.1, "the reference is seen"
    found = [(one, two) for one, two in zip(places["alone"], places["compared"])]
    assert sum(one is not None for one, _ in found) > 8
    for one, two in found:
        assert (one is None) == (two is None), (one, two)
        assert one is None or numpy.abs(numpy.subtract(one, two)).max() < 0.6, (one, two)
    Delete(view)


def test_ranges():
    # Numbers of another scale are compared by their whole ranges, unless a range is given.
    voxels = ball(radius=9.0)
    alike = drawn(CompareVolumes(Input=volume(voxels), Reference=volume(voxels)))
    scaled = volume((30.0 * voxels + 500.0).astype(numpy.uint16))
    compare = CompareVolumes(Input=volume(voxels), Reference=scaled)
    assert numpy.abs(drawn(compare) - alike).max() <= 3 * LEVEL
    higher = drawn(compare, VolumeReferenceRange=[2000.0, 6000.0])  # no voxel is 4000
    assert not higher[:, :, 1].any() and higher[:, :, 0].max() > 0.8
    given = drawn(compare, VolumeReferenceRange=[500.0, 3500.0])
    assert numpy.abs(given - alike).max() <= 3 * LEVEL
    # Ranges that nearly agree mean equal numbers, so a darker volume must not be stretched.
    darker = drawn(CompareVolumes(Input=volume(voxels), Reference=volume(0.8 * voxels)),
                   [0, 0, 0.5, 0, 85, 0, 0.5, 0, 95, 1, 0.5, 0])
    assert not darker[:, :, 1].any() and darker[:, :, 0].max() > 0.8


def test_one_of_them_alone():
    # Show of Compare Volumes draws one in ordinary colours, as if the other was not there.
    colors = [0, 0.2, 0.4, 1.0, 100, 0.9, 0.8, 0.3]
    own = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    reference = volume(ball(side=27), origin=(2.0, 3.0, 4.0))
    compare = CompareVolumes(Input=own, Reference=reference)
    view = new_view()
    display = shown(compare, view, colors=colors)
    both = picture(view)
    for choice, source in (("Deformed", own), ("Reference", reference)):
        compare.Show = choice
        expected = drawn(source, colors=colors)
        for setting in ("Two colours", "Off"):
            display.VolumeComparison = setting
            apart = numpy.abs(picture(view) - expected).max()
            assert apart <= 1.01 * LEVEL, (choice, setting, apart)
    uploads = brainshift.counters(display)["volumeUploads"]
    compare.Show, display.VolumeComparison = "Both", "Two colours"
    assert (picture(view) == both).all()
    assert brainshift.counters(display)["volumeUploads"] == uploads == 2, "flicker sends nothing"
    Delete(view)


def test_a_cavity_is_grey():
    own = volume(ball(radius=10.0))
    hollow = ball(radius=10.0) * (ball(center=(16, 16, 24), radius=5.0) < 50)
    z, y, x = numpy.mgrid[0:33, 0:33, 0:33]
    mask = volume(((x - 16) ** 2 + (y - 16) ** 2 + (z - 24) ** 2 < 36).astype(numpy.uint8))
    for cavity in (None, mask):
        compare = CompareVolumes(Input=own, Reference=volume(hollow), Cavity=cavity)
        image = drawn(compare, view=new_view(direction=(0, 0, -1)))
        middle = image[75, 75]
        if cavity is None:
            assert middle[0] > 0.8 and middle[1:].max() < 0.1, middle
        else:
            assert numpy.ptp(middle) <= LEVEL and 0.4 < middle[0] < 0.51, middle
            grey = (numpy.ptp(image, axis=2) <= LEVEL) & object_pixels(image)
            row, column = numpy.mgrid[0:150, 0:150] - 74.5
            from_middle = numpy.hypot(row, column) * 40.0 / 150
            assert grey[from_middle < 4.5].all(), "the cavity is grey"
            assert image[grey].max() < 0.51, "once, although both volumes end in it"
            assert not grey[(from_middle > 7.0) & (from_middle < 9.0)].any(), "nothing else"
            assert not (image[:, :, 0] > image[:, :, 1] + 0.4)[from_middle < 9.0].any()


def test_too_little_memory_leaves_the_volume():
    own = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    compare = CompareVolumes(Input=own, Reference=volume(ball(side=65)))
    view = new_view()
    display = shown(compare, view)
    both = picture(view)
    display.VolumeComparison = "Off"
    alone = picture(view)
    display.VolumeComparison = "Two colours"
    display.MemoryLimit = 0.1
    with messages() as said:
        picture(view)
    need = re.search(r"needs ([\d.]+) MiB \(.*corrections of it ([\d.]+).*reference ([\d.]+)\)",
                     said.text)
    total, corrections, reference = (float(number) for number in need.groups())
    assert abs(reference - 65 ** 3 * 8 / 2 ** 20) < 0.2 * reference, "scalars and gradients"
    display.MemoryLimit = total - 0.5 * corrections
    with messages() as said:
        image = picture(view)
    assert_says(said.text, "Memory Limit allows", "drawn less exactly")
    assert "reference is not drawn" not in said.text, said.text
    assert numpy.abs(image - both).mean() < 0.1 * numpy.abs(alone - both).mean()
    display.MemoryLimit = total - corrections - 0.5 * reference
    with messages() as said:
        image = picture(view)
    assert_says(said.text, "Memory Limit allows", "reference is not drawn")
    assert numpy.abs(image - alone).mean() < 0.1 * numpy.abs(alone - both).mean()
    assert "software" not in said.text
    with messages() as said:
        picture(view)
    assert not said.text, "told once"
    display.MemoryLimit = 0.0
    assert (picture(view) == both).all()
    Delete(view)


def test_the_camera_sees_all_of_the_reference():
    compare = CompareVolumes(Input=volume(ball()), Reference=volume(ball(), (100.0, 0.0, 0.0)))
    view = new_view()
    shown(compare, view)
    picture(view)
    view.ResetCamera()
    image = picture(view)
    red, green = image[:, :, 0] > 0.5, image[:, :, 1] > 0.5
    assert red.sum() > 50 and green.sum() > 50, (red.sum(), green.sum())
    Delete(view)


def test_cropping_cuts_both():
    compare = CompareVolumes(Input=volume(ball(center=(8, 16, 16), radius=6.0)),
                             Reference=volume(ball(center=(24, 16, 16), radius=6.0)))
    view = new_view(direction=(0, 0, -1))
    display = shown(compare, view)
    picture(view)
    display.UseCropping = 1
    display.CroppingOrigin = [0, 0, 0]
    display.CroppingScale = [1.0, 0.5, 1.0]
    for choice, color in (("Both", 0), ("Both", 1), ("Deformed", 0), ("Reference", 1)):
        compare.Show = choice
        rows = numpy.flatnonzero((picture(view)[:, :, color] > 0.3).any(axis=1))
        height = 16.0 + (rows - 74.5) * 40.0 / 150
        assert 9.0 < height.min() < 11.0 and 15.0 < height.max() < 17.0, (choice, color, height)
    Delete(view)


def test_a_reference_that_the_card_refuses_is_left_out():
    """A long one: cards take 2048 to 16384 values along an axis. The volume stays bent and whole,
    also once the reference is one that fits again."""
    own = FreeFormDeformation(Input=volume(ball()), Strokes=STROKE)
    long = volume(numpy.ones((2, 2, 40000), numpy.float32), spacing=(0.001, 1.0, 1.0))
    compare = CompareVolumes(Input=own, Reference=long)
    view = new_view()
    alone = drawn(own)
    with messages() as said:
        for choice in ("Both", "Reference", "Both"):
            compare.Show = choice
            assert numpy.array_equal(drawn(compare, view=view), alone), choice
    assert_says(said.text, "40000 voxels along one axis", "The reference is not drawn")
    assert "software" not in said.text, said.text
    compare.Reference = volume(ball())
    with messages() as said:
        assert not numpy.array_equal(drawn(compare, view=view), alone)
    assert "MiB" not in said.text and "refused" not in said.text, said.text


run_tests(globals())
