# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Volume follows its source when it is deleted while it is shown, made
# larger, smaller and as it was, exchanged for another, or stepped through time. Each picture
# equals that of a new view.
import os
import struct

import numpy
from brainshift_testing import (ball, load_plugin, picture, run_tests, scratch, show_volume,
                                view_along, volume)

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    Delete, FreeFormDeformation, GetAnimationScene, NIFTIVolumeReader, Wavelet)

COLORS = [0, 0, 0, 1, 150, 0, 1, 0, 300, 1, 0, 0]
OPACITIES = [0, 0, 0.5, 0, 120, 0.0, 0.5, 0, 300, 0.3, 0.5, 0]
STROKE = brainshift.soft((2, 1, 3), (3, 2, 1), 9.0)
EXTENTS = ((-10, 10, -10, 10, -10, 10), (-16, 12, -7, 9, -4, 11), (-4, 4, -4, 4, -4, 4))


def shown(source, array="RTData"):
    view = view_along((-0.5, 0.3, -1), (0, 0, 0), 70.0, size=120)
    return view, show_volume(
        source, view, "Deformed Volume", COLORS, OPACITIES, array=array, shade=True)


def in_a_new_view(source, array="RTData"):
    view, _ = shown(source, array)
    image = picture(view)
    assert (image.max(axis=2) > 0.02).mean() > 0.02, "nothing is drawn"
    Delete(view)
    return image


def assert_same(image, expected, what):
    differing = int((image != expected).any(axis=2).sum())
    assert differing == 0, (what, differing, float(numpy.abs(image - expected).max()))


def test_deleted_while_shown():
    wavelet = Wavelet(WholeExtent=list(EXTENTS[0]))
    bent = FreeFormDeformation(Input=wavelet, Strokes=STROKE)
    view, _ = shown(bent)
    assert picture(view).any()
    Delete(bent)
    assert not picture(view).any(), "it is still seen"
    again = FreeFormDeformation(Input=wavelet, Strokes=STROKE)
    show_volume(again, view, "Deformed Volume", COLORS, OPACITIES, array="RTData", shade=True)
    assert_same(picture(view), in_a_new_view(again), "made anew")
    Delete(view)


def test_another_size_and_back():
    # With a lattice, and drawn as it is.
    for bend in (lambda source: FreeFormDeformation(Input=source, Strokes=STROKE),
                 lambda source: source):
        wavelet = Wavelet(WholeExtent=list(EXTENTS[0]))
        view, _ = shown(bend(wavelet))
        pictures = []
        for extent in (*EXTENTS, EXTENTS[0]):
            wavelet.WholeExtent = list(extent)
            pictures.append(picture(view))
            expected = in_a_new_view(bend(Wavelet(WholeExtent=list(extent))))
            assert_same(pictures[-1], expected, extent)
        assert_same(pictures[-1], pictures[0], "as it was")
        assert all((image != pictures[0]).any() for image in pictures[1:-1])
        Delete(view)


def test_another_input():
    # Other voxels, another type, another place, another array name.
    wavelet = Wavelet(WholeExtent=list(EXTENTS[0]))
    other = volume((2 * ball(side=25, radius=8.0)).astype(numpy.uint8), origin=(-9, -12, -14),
                   spacing=(1.0, 0.8, 1.1))
    bent = FreeFormDeformation(Input=wavelet, Strokes=STROKE)
    view, display = shown(bent)
    first = picture(view)
    bent.Input = other
    display.ColorArrayName = ("POINTS", "Intensity")
    expected = in_a_new_view(FreeFormDeformation(Input=other, Strokes=STROKE), "Intensity")
    assert_same(picture(view), expected, "the other")
    bent.Input = wavelet
    display.ColorArrayName = ("POINTS", "RTData")
    assert_same(picture(view), first, "the first again")
    Delete(view)


def write_nifti(name, steps):
    """A time series of volumes [step, z, y, x], 16 bits, with steps of 1 mm and 2 s, about 0."""
    times, depth, height, width = steps.shape
    header = struct.pack(
        "<i36x8h14x2h2x8f3f2x2B", 348, 4, width, height, depth, times, 1, 1, 1, 4, 16,
        1.0, 1.0, 1.0, 1.0, 2.0, 0.0, 0.0, 0.0, 352.0, 1.0, 0.0, 0, 10)
    # The rest is an sform that puts the middle at the origin.
    shifts = [-(side - 1) / 2 for side in (width, height, depth)]
    rows = [1.0, 0.0, 0.0, shifts[0], 0.0, 1.0, 0.0, shifts[1], 0.0, 0.0, 1.0, shifts[2]]
    header += bytes(252 - len(header)) + struct.pack("<2h24x12f16x4s4x", 0, 1, *rows, b"n+1\0")
    with open(name, "wb") as file:
        file.write(header + steps.astype("<i2").tobytes())


def test_a_time_series():
    steps = numpy.stack([3 * ball(side=25, radius=radius, center=(12, 12, 12 + shift))
                         for radius, shift in ((9.0, 0), (6.0, 2), (4.0, -3))])
    name = scratch("time-series.nii")
    write_nifti(name, steps)
    expected = []
    for step in steps:
        still = volume(step.astype(numpy.int16), origin=(-12, -12, -12))
        expected.append(
            in_a_new_view(FreeFormDeformation(Input=still, Strokes=STROKE), "Intensity"))
    series = NIFTIVolumeReader(FileName=name)
    series.UpdatePipelineInformation()
    times = list(series.TimestepValues)
    assert times == [0.0, 2.0, 4.0], times
    view, display = shown(FreeFormDeformation(Input=series, Strokes=STROKE), "Intensity")
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    for index in (0, 1, 2, 1, 0):
        scene.AnimationTime = times[index]
        assert_same(picture(view), expected[index], f"step {index}")
    counts = brainshift.counters(display)
    assert counts["latticeUploads"] == 1, counts  # the strokes are the same at all times
    assert counts["volumeUploads"] == 5, counts
    Delete(view)
    os.remove(name)


run_tests(globals())
