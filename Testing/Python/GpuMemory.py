# SPDX-License-Identifier: BSD-3-Clause
# Proves that a volume for which the GPU's memory does not suffice is told, with what it needs and
# what there is, and drawn by VTK's software mapper; and is drawn by ours again when there is more.
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
                "images": 200 * 200 * 16 / 2 ** 20}
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


run_tests(globals())
