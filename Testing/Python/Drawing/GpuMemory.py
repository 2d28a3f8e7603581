# SPDX-License-Identifier: BSD-3-Clause
# Proves that a volume that is too large for the memory of the GPU gives a message with the memory
# it needs and the memory there is. It is drawn coarser then, bent and in its place. Where not even
# the deformation fits, VTK's software mapper draws it, and our mapper draws it again when there is
# more memory. Images take memory only for the part of the picture that shows the volume.
import re

import numpy
from brainshift_testing import (assert_says, load_plugin, mean_difference, messages, object_pixels,
                                picture, run_tests, show_volume, use_headlight, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import FreeFormDeformation  # noqa: E402
from stock_testing import COLORS, MIDDLE, OPACITIES, bend, smooth  # noqa: E402


def shown(view_size=200, **named):
    view = view_along((0, 0, -1), MIDDLE, 140.0, size=view_size)
    return view, show_volume(bend(volume(smooth())), view, "Deformed Volume", COLORS, OPACITIES,
                             **named)


def parts(text):
    """What a message says is needed, MiB: all, and each part by name."""
    total, each = re.search(r"needs ([\d.]+) MiB \((.*?)\)", text).groups()
    return float(total), {name: float(size)
                          for name, size in re.findall(r"([a-z ]+?) ([\d.]+)(?:, |$)", each)}


def test_a_limit_is_told_and_kept():
    view, display = shown(shade=True)
    deformed = picture(view)
    frames = brainshift.counters(display)["frames"]
    display.MemoryLimit = 2.5
    with messages() as said:
        undeformed = picture(view)
    assert_says(said.text, "Memory Limit allows 2.5 MiB", "software mapper", "undeformed")
    total, each = parts(said.text)
    expected = {"scalars": 49 ** 3 * 4 / 2 ** 20, "gradients": 49 ** 3 * 4 / 2 ** 20, "colours": 0,
                "images": 200 * 200 * 24 / 2 ** 20}
    for name, size in expected.items():
        assert abs(each[name] - size) < 0.06, (name, each, size)
    assert each["offset field"] >= 2 * 91 ** 3 * 16 / 2 ** 20 - 1, each
    assert abs(total - sum(each.values())) < 1.0, (total, each)
    assert brainshift.counters(display)["frames"] == frames, "the ray caster must not be tried"
    assert undeformed.any() and not numpy.array_equal(undeformed, deformed)
    with messages() as said:
        picture(view)
    assert "MiB" not in said.text, "told once"
    display.MemoryLimit = total + 1.0
    with messages() as said:
        again = picture(view)
    assert "MiB" not in said.text, said.text
    assert numpy.array_equal(again, deformed)
    # Corrections are left out first.
    display.MemoryLimit = total - 1.0
    with messages() as said:
        rough = picture(view)
    assert_says(said.text, "drawn less exactly")
    off = [numpy.abs(image - deformed).mean() for image in (rough, undeformed)]
    print(f"  mean difference: without corrections {off[0]:.5f}, undeformed {off[1]:.5f}")
    assert off[0] < 0.1 * off[1], off
    display.MemoryLimit = total + 1.0
    assert numpy.array_equal(picture(view), deformed)


OBLIQUE = [0.0, -0.8, 0.6, 1.0, 0.0, 0.0, 0.0, 0.6, 0.8]
SPACING = (0.6, 0.5, 1.1)  # so that thick slices are joined last
ORIGIN = (3.0, -4.0, 5.0)


def large(cells, kind=numpy.float32):
    """Smooth values in 90 x 90 x 64 voxels, unlike on every axis, 0 at the border."""
    z, y, x = numpy.mgrid[0:64, 0:90, 0:90].astype(float)
    values = numpy.zeros(x.shape)
    for i, j, k, width, height in ((40, 50, 30, 10.0, 100.0), (60, 34, 36, 7.0, 130.0)):
        squared = ((x - i) ** 2 + (y - j) ** 2) / width ** 2 + (z - k) ** 2 / (0.5 * width) ** 2
        values = numpy.maximum(values, height * numpy.exp(-squared / 2))
    return volume(values.astype(kind), ORIGIN, SPACING, OBLIQUE, cells=cells), values


def joined(voxels, cells):
    """The means of 2 x 2 x 1 voxels, on the points or in the cells of a grid of their own. Those of
    whole numbers are rounded."""
    means = voxels.reshape(64, 45, 2, 45, 2).mean(axis=(2, 4))
    means = numpy.floor(means + 0.5) if voxels.dtype.kind == "i" else means
    means = means.astype(voxels.dtype)
    axes = numpy.reshape(OBLIQUE, (3, 3))
    first = numpy.asarray(ORIGIN)
    if not cells:
        first = first + axes @ (0.5 * numpy.asarray(SPACING) * (1, 1, 0))
    return volume(means, first, (2 * SPACING[0], 2 * SPACING[1], SPACING[2]), OBLIQUE, cells=cells)


def bent_and_shown(source, cells, bends):
    middle = numpy.asarray(ORIGIN) + numpy.reshape(OBLIQUE, (3, 3)) @ (
        numpy.asarray(SPACING) * (45, 45, 32))
    strokes = brainshift.soft(middle, (0.0, 5.0, -4.0), 22.0) if bends else []
    bent = FreeFormDeformation(Input=source, LatticeDimensions=[6, 6, 6], Samples=4,
                               Strokes=strokes)
    view = view_along((-0.6, 0.3, -1.0), middle, 60.0, size=200)
    use_headlight(view)
    display = show_volume(bent, view, "Deformed Volume", COLORS, OPACITIES,
                          association="CELLS" if cells else "POINTS", shade=True)
    display.SampleDistance = 0.3
    return view, display


def need_of(view, display):
    """MiB that the volume needs, and its parts, as a limit that allows nothing says."""
    display.MemoryLimit = 0.01
    with messages() as said:
        picture(view)
    display.MemoryLimit = 0.0
    return parts(said.text)


def test_a_large_volume_is_drawn_coarser_and_in_its_place():
    """As the means of its voxels, which are drawn in full. On points these fill a smaller box, and
    so does their lattice; so these are not bent."""
    for cells, kind, bends in ((True, numpy.float32, True),
                               (False, numpy.float32, False),
                               (False, numpy.int16, False)):
        source, values = large(cells, kind)
        view, display = bent_and_shown(source, cells, bends)
        fine = picture(view)
        total, each = need_of(view, display)
        display.MemoryLimit = total - each["corrections of it"] - 0.5  # 3/4 of the voxels are more
        with messages() as said:
            coarse = picture(view)
        assert_says(said.text, "drawn coarser: one value for 2 x 2 x 1 voxels")
        # An OME-Zarr image has its numbers on points.
        assert ("brainshift.draw_from_pyramid" in said.text) is not cells, said.text
        assert "software" not in said.text and "less exactly" not in said.text, said.text
        assert brainshift.gpu(display)["gpuVoxelsPerTexel"] == 4
        view, _ = bent_and_shown(joined(values.astype(kind), cells), cells, bends)
        expected = picture(view)
        off = [mean_difference(image, expected) for image in (coarse, fine)]
        print(f"  cells {cells}, {kind.__name__}, bends {bends}: {off[0]:.7f}, whole {off[1]:.7f}; "
              f"object {object_pixels(fine).mean():.2f}")
        assert object_pixels(fine).mean() > 0.1
        assert off[0] < 1e-5 and off[1] > 1e-3, off


def test_the_next_pictures_under_a_limit_repeat_nothing():
    source, _ = large(False)
    view, display = bent_and_shown(source, False, True)
    total, each = need_of(view, display)
    display.MemoryLimit = total - each["corrections of it"] - 0.5
    first = picture(view)
    before = brainshift.counters(display)
    assert numpy.array_equal(picture(view), first)
    after = brainshift.counters(display)
    for name in ("volumeUploads", "presenceUpdates", "correctionBytes", "bytesUploaded"):
        assert after[name] == before[name], (name, before[name], after[name])
    display.MemoryLimit = 0.0  # as soon as there is memory again
    picture(view)
    assert brainshift.gpu(display)["gpuVoxelsPerTexel"] == 1


def test_images_hold_what_can_be_seen():
    """Where the volume is a small part of the picture: same picture, same picks, less memory."""
    size = 400
    view, display = shown(view_size=size)
    picture(view)
    near = brainshift.gpu(display)["gpuOtherBytes"]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 200.0
    small = picture(view)
    far = brainshift.gpu(display)["gpuOtherBytes"]
    assert near - far > 0.4 * 12 * size ** 2, (near, far)
    assert brainshift.gpu(display)["gpuOtherBytes"] == far
    places = [(column, row) for column in range(160, 240, 4) for row in range(160, 240, 4)]
    picked = [brainshift.pick(display, view, *place) for place in places]
    assert sum(hit is not None for hit in picked) > 10, picked
    assert brainshift.pick(display, view, 5, 5) is None
    display.EmptySpaceSkipping = 0  # all of the picture is cast
    assert numpy.array_equal(picture(view), small)
    assert brainshift.gpu(display)["gpuOtherBytes"] > far + 0.7 * 12 * size ** 2
    for place, hit in zip(places, picked):
        again = brainshift.pick(display, view, *place)
        assert (hit is None) == (again is None), place
        assert hit is None or numpy.array_equal(hit, again), (place, hit, again)


def test_what_is_not_kept_is_not_counted():
    view, display = shown(shade=True)
    display.MemoryLimit = 0.1
    needs = {}
    for normals in ("Full resolution", "Half resolution", "On the fly"):
        display.VolumeNormalTexture = normals
        with messages() as said:
            picture(view)
        needs[normals] = parts(said.text)[1]["gradients"]
    assert needs["On the fly"] == 0.0, needs
    assert 0.0 < needs["Half resolution"] < 0.3 * needs["Full resolution"], needs


def test_a_lattice_too_fine_for_the_textures_is_told():
    """4353 nodes along one axis; software drawing and many GPUs take 2048. Others draw them."""
    bent = bend(volume(smooth()))
    view = view_along((0, 0, -1), MIDDLE, 140.0, size=200)
    show_volume(bent, view, "Deformed Volume", COLORS, OPACITIES)
    before, settings = picture(view), (list(bent.LatticeDimensions), bent.Samples)
    bent.LatticeDimensions, bent.Samples = [257, 4, 4], 16
    with messages() as said:
        fine = picture(view)
    limit = re.search(r"takes 4353 nodes along one axis; the GPU takes at most (\d+)", said.text)
    assert bool(limit) == ("software mapper" in said.text), said.text
    assert fine.any()
    assert not limit or "Decrease Samples or Lattice Dimensions" in said.text, said.text
    bent.LatticeDimensions, bent.Samples = settings
    with messages() as said:
        assert numpy.array_equal(picture(view), before)
    assert not said.text, said.text


run_tests(globals())
