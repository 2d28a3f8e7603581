# SPDX-License-Identifier: BSD-3-Clause
# Proves that a volume that is too large for the memory of the GPU gives a message with the memory
# it needs and the memory there is. VTK's software mapper draws it then, and our mapper draws it
# again when there is more memory. Images take memory only for the part of the picture that shows
# the volume.
import re

import numpy
from brainshift_testing import (assert_says, load_plugin, messages, picture, run_tests,
                                show_volume, view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
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
