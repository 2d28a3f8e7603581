# SPDX-License-Identifier: BSD-3-Clause
# Proves that a server that draws sends the picture of the built-in session, pixel by pixel, and
# that brainshift.pick, counters and gpu answer for what the server drew. This holds for Deformed
# Slices too. A server survives requests that no memory holds, and writes volumes.
import os

import numpy
from brainshift_testing import (assert_says, data, load_plugin, look, messages, on_server, picture,
                                run_tests, scratch, server_finds_plugin, show_volume, view_along)
from slices_testing import show_slices

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview.simple import (  # noqa: E402
    BakeDeformation, DeformationField, FreeFormDeformation, LoadPlugin, OpenDataFile, Wavelet)

PLUGIN = os.environ["BRAINSHIFT_PLUGIN"]
HEAD = data("seg3d-utah", "seg3d_mr_t1.nii.gz")
SIZE = 200
MIDDLE = (0.0, 0.0, 0.0)
STROKE = brainshift.soft(MIDDLE, (4, 2, 1), 12.0)
COLORS = [0, 0, 0, 1, 150, 0, 1, 0, 300, 1, 0, 0]
OPACITIES = [0, 0, 0.5, 0, 150, 0.02, 0.5, 0, 300, 0.3, 0.5, 0]
PIXELS = [(SIZE // 2, SIZE // 2), (70, 110), (120, 90), (2, 2)]

NOT_COUNTED = {"frames": 0, "pixelsCast": 0}


class Shown:
    """A bent wavelet, in the session that is connected. Its view draws without FXAA, which ParaView
    applies on the server and once more on the client, to "Volume" as to all else."""

    def __init__(self):
        self.filter = FreeFormDeformation(
            Input=Wavelet(WholeExtent=[-15, 15, -15, 15, -15, 15]), Strokes=STROKE)
        self.view = view_along((-0.5, 0.3, -1), MIDDLE, 80.0, size=SIZE)
        self.display = show_volume(self.filter, self.view, "Deformed Volume", COLORS, OPACITIES,
                                   array="RTData", shade=True)

    def answers(self):
        """The picture, the tissue at some pixels, and the counters."""
        drawn = picture(self.view)
        return (drawn, [brainshift.pick(self.display, self.view, *pixel) for pixel in PIXELS],
                {**brainshift.counters(self.display), **self.memory()})

    def memory(self):
        return {name: number for name, number in brainshift.gpu(self.display).items()
                if name.endswith("Bytes")}

    def all_answers(self):
        """First drawn; then after another stroke."""
        first = self.answers()
        self.filter.Strokes = STROKE + brainshift.soft((4, -2, 7), (0, -3, 1), 10.0)
        return first, self.answers()


def slices():
    """Pictures of Deformed Slices before and after they are moved, how they lie, the counters."""
    bent = FreeFormDeformation(
        Input=Wavelet(WholeExtent=[-15, 15, -15, 15, -15, 15]), Strokes=STROKE)
    view = view_along((-0.5, 0.3, -1), MIDDLE, 80.0, size=SIZE)
    display = show_slices(bent, view, ("Sagittal", "Coronal", "Axial"), MIDDLE, high=300.0,
                          array="RTData")
    display.OrientationMarks = 1
    drawn = [picture(view)]
    display.SlicePosition = [3.0, -2.0, 5.0]
    drawn.append(picture(view))
    display.ShowSagittal = display.ShowCoronal = 0
    look(view, (0, 0, -1), MIDDLE, 80.0)
    drawn.append(picture(view))  # with letters, which the client draws
    head = OpenDataFile(HEAD)
    head.UpdatePipeline()
    low_x, high_x, low_y, high_y, low_z, high_z = head.GetDataInformation().GetBounds()
    middle = [(low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2]
    flat = view_along((0, 0, 1), middle, 500.0, half_height=110.0, size=SIZE)
    of_head = show_slices(head, flat, ("Axial",), middle, high=300.0)
    of_head.OrientationMarks = 1
    drawn.append(picture(flat))  # letters of a file that says where the sides are
    return drawn, brainshift.slice_axes(display), brainshift.counters(display)


def written(name):
    """Writes a bake, here or on the server. Returns why it cannot, where it cannot."""
    bent = FreeFormDeformation(
        Input=Wavelet(WholeExtent=[-15, 15, -15, 15, -15, 15]), Strokes=STROKE)
    baked = BakeDeformation(Input=bent)
    brainshift.save_volume(baked, scratch(name), world="RAS")
    try:
        brainshift.save_volume(baked, scratch("no_folder/" + name), world="RAS")
    except OSError as error:
        return str(error)
    return ""


SERVER_FINDS_PLUGIN = server_finds_plugin()
EXPECTED = Shown().all_answers()
EXPECTED_SLICES = slices()  # while there is a session
with messages():
    EXPECTED_REASON = written("of_session.nii")


def assert_same(found):
    for (drawn, tissue, counts), wanted in zip(found, EXPECTED):
        expected, expected_tissue, expected_counts = wanted
        differing = int((drawn != expected).any(axis=2).sum())
        assert differing == 0, f"{differing} pixels differ, by {numpy.abs(drawn - expected).max()}"
        assert tissue == expected_tissue, (tissue, expected_tissue)
        assert counts == expected_counts, (counts, expected_counts)


def test_the_built_in_session_has_something_to_compare():
    (first, tissue, counts), (second, moved_tissue, moved_counts) = EXPECTED
    assert (first.max(axis=2) > 0.02).mean() > 0.2
    assert (first != second).any(axis=2).mean() > 0.05
    assert [found is not None for found in tissue] == [True, True, True, False], tissue
    assert moved_tissue != tissue
    assert counts["latticeUploads"] == 1 and moved_counts["latticeUploads"] == 2, moved_counts
    assert counts["volumeUploads"] == moved_counts["volumeUploads"] == 1, moved_counts
    assert counts["gpuScalarBytes"] > 0 and counts["gpuOtherBytes"] > 0, counts


def test_a_server_that_finds_the_plugin_by_itself():
    assert_same(on_server(lambda: Shown().all_answers(), **SERVER_FINDS_PLUGIN))


def test_a_server_that_is_told_to_load_the_plugin():
    def load_and_show():
        LoadPlugin(PLUGIN, remote=True)
        return Shown().all_answers()
    assert_same(on_server(load_and_show))


def test_volumes_are_drawn_on_the_server_whatever_their_size():
    def show(threshold):
        shown = Shown()
        shown.view.RemoteRenderThreshold = threshold  # MB; smaller surfaces go to the client
        return shown.all_answers()
    for threshold in (0.0, 1e6):
        assert_same(on_server(lambda: show(threshold), **SERVER_FINDS_PLUGIN))


def test_slices_are_drawn_on_the_server():
    pictures, axes, counts = on_server(slices, **SERVER_FINDS_PLUGIN)
    expected, expected_axes, expected_counts = EXPECTED_SLICES
    for image, local in zip(pictures, expected):
        differing = int((image != local).any(axis=2).sum())
        assert image.any() and differing == 0, differing
    assert (pictures[0] != pictures[1]).any(), "the slices were moved"
    amber = [((image[:, :, 0] > 0.7) & (image[:, :, 2] < 0.4)).any() for image in pictures[2:]]
    assert amber == [True, False], "a warning where the axes are unknown, and there alone"
    assert axes == expected_axes, axes
    assert {**counts, **NOT_COUNTED} == {**expected_counts, **NOT_COUNTED}, counts
    assert counts["volumeUploads"] == counts["latticeUploads"] == 1, counts


def refused_and_made():
    """Points of a field that no memory holds, of one that it holds, and of a bake beyond memory."""
    bent = FreeFormDeformation(
        Input=Wavelet(WholeExtent=[-15, 15, -15, 15, -15, 15]), Strokes=STROKE)
    field = DeformationField(Input=bent, SampleGrid="Given Dimensions", Dimensions=[4096] * 3)
    baked = BakeDeformation(Input=bent)
    points = []
    for dimensions, sides, samples in (([4096] * 3, [129] * 3, 16), ([5, 6, 7], [9] * 3, 4)):
        field.Dimensions = dimensions
        field.UpdatePipeline()
        points.append(field.GetDataInformation().GetNumberOfPoints())
        bent.LatticeDimensions, bent.Samples = sides, samples
        baked.UpdatePipeline()
        points.append(baked.GetDataInformation().GetNumberOfPoints())
    return points


def test_a_server_survives_what_no_memory_holds():
    refused, first_bake, made, bake = on_server(refused_and_made, **SERVER_FINDS_PLUGIN)
    assert (refused, made, bake) == (0, 5 * 6 * 7, 31 ** 3), (refused, made, bake)
    assert first_bake in (0, 31 ** 3), first_bake  # as much as the machine has memory


def test_a_server_writes_volumes_and_says_why_it_does_not():
    said = on_server(lambda: written("of_server.nii"), **SERVER_FINDS_PLUGIN)
    assert_says(said, "no_folder/of_server.nii cannot be written", "No such file")
    assert said == EXPECTED_REASON.replace("of_session", "of_server"), said
    files = []
    for name in ("of_server.nii", "of_session.nii"):
        with open(scratch(name), "rb") as file:
            files.append(file.read())
    assert len(files[0]) == 352 + 4 * 31 ** 3 and files[0] == files[1]


run_tests(globals())
