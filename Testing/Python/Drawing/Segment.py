# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Volume draws chosen labels of a segmentation alone, as ParaView's "Volume"
# draws a baked volume whose other voxels have the lowest value. The labels may lie on any grid,
# and every blend mode and picks work. What cannot be drawn gives a message.
import numpy
from brainshift_testing import (assert_says, load_plugin, mean_difference, messages, object_pixels,
                                picture, run_tests, use_headlight, view_along, volume, voxels)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import BakeDeformation, Delete, FreeFormDeformation  # noqa: E402
from segment_testing import (BRAIN, MIDDLE, SKULL, STROKES, VESSEL, bent,  # noqa: E402
                             labels_at, oblique_labels, places, show, tissue)

DIRECTION = (-0.6, 0.5, -1.0)
LABELS = labels_at(places())


def new_view():
    view = view_along(DIRECTION, MIDDLE, 110.0, size=140)
    use_headlight(view)
    return view


def picture_of(source, labels=None, kind="Deformed Volume", configure=lambda display: None,
               **named):
    view = new_view()
    configure(show(source, view, labels, kind, **named))
    image = picture(view)
    Delete(view)
    return image


def alone(labels):
    """The tissue without what has other labels, bent and baked."""
    return BakeDeformation(Input=bent(numpy.where(numpy.isin(LABELS, labels), tissue(), 0)),
                           Interpolation="Cubic")


def assert_drawn_alone(what, filter, labels, limit, **named):
    """That a picture of labels differs from that by the other road by less than `limit`, and a
    picture of all tissue by a multiple."""
    drawn = picture_of(filter, labels, **named)
    expected = picture_of(alone(labels), kind="Volume", **named)
    whole = picture_of(filter, **named)
    difference, other = mean_difference(drawn, expected), mean_difference(whole, expected)
    share = object_pixels(expected).mean()
    print(f"  {what}: differs by {100 * difference:.2f} %, all of it by {100 * other:.2f} %, "
          f"object on {100 * share:.0f} %", flush=True)
    assert share > 0.1, (what, share)
    assert difference < limit, (what, difference)
    assert other > 4 * difference, (what, other)


def test_labels_are_drawn_alone():
    # The edge of Volume runs through voxels in steps, and ours does not. That is most of the
    # difference. Light shows the steps even more.
    filter = bent(Segmentation=volume(LABELS))
    for labels in ([BRAIN], [SKULL], [BRAIN, VESSEL]):
        assert_drawn_alone(labels, filter, labels, 0.04)
    assert_drawn_alone("under light", filter, [BRAIN], 0.07, shade=True)


def test_labels_lie_on_any_grid():
    own = picture_of(bent(Segmentation=volume(LABELS)), [BRAIN])
    oblique = picture_of(bent(Segmentation=oblique_labels()), [BRAIN])
    moved = picture_of(bent(Segmentation=volume(LABELS, origin=(4, 0, 0))), [BRAIN])
    cells = numpy.zeros((48,) * 3, numpy.uint8)
    cells[...] = labels_at(places(origin=(0.5,) * 3, side=48))
    in_cells = picture_of(bent(Segmentation=volume(cells, cells=True)), [BRAIN])
    print(f"  oblique {100 * mean_difference(own, oblique):.2f} %, in cells "
          f"{100 * mean_difference(own, in_cells):.2f} %, moved "
          f"{100 * mean_difference(own, moved):.2f} %", flush=True)
    assert mean_difference(own, oblique) < 0.03
    assert mean_difference(own, in_cells) < 0.03
    assert mean_difference(own, moved) > 0.08


def test_scalars_may_lie_in_cells():
    x, y, z = numpy.moveaxis(places(origin=(0.5,) * 3, side=48), -1, 0)
    values = (70 + 25 * numpy.sin(x / 3.0) * numpy.cos(y / 4.0 + z / 5.0)).astype(numpy.float32)
    in_cells = FreeFormDeformation(Input=volume(values, cells=True), Segmentation=volume(LABELS),
                                   Strokes=STROKES)
    images = [picture_of(in_cells, [BRAIN], association="CELLS"),
              picture_of(bent(Segmentation=volume(LABELS)), [BRAIN])]
    print(f"  differ by {100 * mean_difference(*images):.2f} %", flush=True)
    assert mean_difference(*images) < 0.03


def test_labels_asked_for_or_meant():
    def drawn(labels=(), **named):
        return picture_of(bent(**named), list(labels))

    segmentation = volume(LABELS)
    brain, skull = (drawn([label], Segmentation=segmentation) for label in (BRAIN, SKULL))
    every = drawn(Segmentation=segmentation)
    assert mean_difference(brain, skull) > 0.1 and mean_difference(brain, every) > 0.1
    assert numpy.array_equal(every, drawn([BRAIN, SKULL, VESSEL], Segmentation=segmentation))
    # A mask is a segmentation too. Its labels are drawn, unless other labels are asked for or
    # another segmentation is given.
    masked = {"Mask": segmentation, "MaskLabels": [BRAIN]}
    own = drawn(**masked)
    assert numpy.array_equal(own, drawn([BRAIN], **masked))
    assert not numpy.array_equal(own, drawn([SKULL], **masked))
    assert numpy.array_equal(drawn(**masked, Segmentation=volume(LABELS)),
                             drawn([BRAIN, SKULL, VESSEL], **masked))


def test_a_segmentation_keeps_nothing_from_moving():
    free, with_labels = bent(), bent(Segmentation=volume(LABELS))
    assert numpy.array_equal(voxels(BakeDeformation(Input=free)),
                             voxels(BakeDeformation(Input=with_labels)))
    assert numpy.array_equal(picture_of(free), picture_of(with_labels))


def test_other_blend_modes():
    filter = bent(Segmentation=volume(LABELS))
    brain = object_pixels(picture_of(filter, [BRAIN]))
    for name, mode in (("isosurface", 5), ("maximum", 1), ("minimum", 2), ("average", 3),
                       ("sum", 4), ("slice", 6)):
        def configure(display, mode=mode):
            display.BlendMode = mode
            display.IsosurfaceValues = [60.0, 80.0]
            display.SliceFunction.Origin = MIDDLE
            display.SliceFunction.Normal = (0.5, 0.0, 1.0)
        drawn, all_tissue = (object_pixels(picture_of(filter, labels, configure=configure))
                             for labels in ([BRAIN], None))
        beyond = (drawn & ~brain).sum() / brain.sum()
        print(f"  {name}: on {100 * (drawn & brain).sum() / brain.sum():.0f} % of the brain, "
              f"{100 * beyond:.2f} % beyond", flush=True)
        assert (drawn & brain).sum() > 0.3 * brain.sum(), name
        assert beyond < 0.01, (name, beyond)
        assert (all_tissue & ~brain).sum() > 0.5 * brain.sum(), name


def test_picks_follow_what_is_drawn():
    view = new_view()
    display = show(bent(Segmentation=volume(LABELS)), view)
    picture(view)
    middle, corner = (70, 70), (19, 70)
    outer = brainshift.pick(display, view, *middle)
    assert brainshift.pick(display, view, *corner) is not None
    display.DrawSegment = 1
    display.DrawnLabels = [BRAIN]
    picture(view)
    inner = brainshift.pick(display, view, *middle)
    assert brainshift.pick(display, view, *corner) is None
    eye = numpy.array(view.CameraPosition)
    behind = numpy.linalg.norm(eye - inner) - numpy.linalg.norm(eye - outer)
    assert 5.0 < behind < 30.0, (inner, outer)
    Delete(view)


def test_what_cannot_be_drawn_is_told():
    whole = picture_of(bent())
    with messages() as said:
        assert numpy.array_equal(picture_of(bent(), [BRAIN]), whole)
    assert_says(said.text, "Draw Segment is on", "carries no segmentation", "All tissue is drawn")
    with messages() as said:
        nothing = picture_of(bent(Segmentation=volume(LABELS)), [1, 2])
    assert not nothing.any()
    assert_says(said.text, "no voxel of the segmentation is of label 1 or 2", "nothing is drawn")
    assert "OpenGL" not in said.text, said.text
    filter = bent(Segmentation=volume(LABELS))
    good = picture_of(filter, [BRAIN])
    for wrong, words in ((volume(LABELS, origin=(500, 0, 0)), "The segmentation (x 499.5 to"),
                         (volume(numpy.ones((4, 4, 4, 3), numpy.uint8)), "one component")):
        with messages() as said:
            filter.Segmentation = wrong
            filter.UpdatePipeline()
        assert_says(said.text, words, "stays as it was")
        assert numpy.array_equal(picture_of(filter, [BRAIN]), good)


run_tests(globals())
