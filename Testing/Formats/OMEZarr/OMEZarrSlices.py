# SPDX-License-Identifier: BSD-3-Clause
# Proves that Deformed Slices of a store that is read coarsely are drawn as finely as it is stored:
# as slices of the finest level, read and drawn directly, in each way to interpolate, bent and not,
# also with little memory, a chunk that is damaged, slices that move, and in two views. The value
# under the cursor is that of the voxel that is drawn.
import os

import numpy
import zarr_files
from brainshift_testing import (
    assert_says, load_plugin, messages, picture, run_tests, view_along, volume)
from ranks_slices_testing import facts
from slices_testing import flat_view, show_slices
from streamed_store import (MIDDLE, bent, blurred, coarse, compare, differences, halved, lattice,
                            reader, save, store, voxels)
from zarr_files import describe, fresh, level, write_array

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

PLANES = ("Sagittal", "Coronal", "Axial")
OBLIQUE = (-0.5, 0.7, -0.6)
SIZE = 200
BORDERS = 100  # pixels, where a plane ends before another: either may be seen


class Shown:
    """Slices in a view of their own: from the front if there is one, else obliquely."""

    def __init__(self, source, planes=PLANES, position=MIDDLE, half=44.0, size=SIZE, **named):
        if len(planes) == 1:
            self.view = flat_view(PLANES.index(planes[0]), MIDDLE, half, size)
        else:
            self.view = view_along(OBLIQUE, MIDDLE, 190.0, (0, 0, 1), size=size)
        self.display = show_slices(source, self.view, planes, position, high=1000.0)
        for name, value in named.items():
            setattr(self.display, name, value)

    def detail(self, **named):
        self.view.UseFXAA = 0  # a new view turns it on, for all
        with messages():  # unknown sides
            state = brainshift.draw_detail(self.view, self.display, **named)
        return picture(self.view), state

    def image(self):
        self.view.UseFXAA = 0
        with messages():
            return picture(self.view)

    def close(self):
        simple.Delete(self.view)


def compare_slices(what, sources, most_pixels=0, **named):
    """Of the finest level, of the coarser one, and of what is streamed."""
    direct, blurry, streamed = (Shown(source, **named) for source in sources)
    image, state = streamed.detail()
    assert state["gpuLevel"] == 0 and state["gpuBricks"] > 8, state
    assert state["gpuBricksLackRoom"] == 0, state
    compare(what, image, direct.image(), blurry.image(), most_pixels)
    for one in (direct, blurry, streamed):
        one.close()


def test_as_drawn_directly():
    path = store()
    for interpolation in ("Linear", "Cubic"):
        for planes in (("Sagittal",), ("Coronal",), ("Axial",), PLANES):
            compare_slices(f"{interpolation}, {' '.join(planes)}",
                           (reader(path, Level=0), blurred(), coarse(path)),
                           BORDERS if planes == PLANES else 0,
                           planes=planes, SliceInterpolation=interpolation)


def test_through_translucent_slices():
    """What lies behind is seen, and asked for."""
    path = store()
    compare_slices("translucent", (reader(path, Level=0), blurred(), coarse(path)), BORDERS,
                   Opacity=0.6)


def sampled_store():
    """The coarser levels have every second voxel, and so the same box."""
    path = fresh("sampled.zarr")
    values = numpy.pad(voxels(), ((0, 1),) * 3)
    datasets = []
    for i in range(3):
        write_array(path, str(i), values, 2, (20, 24, 28), codecs=zarr_files.OF_VERSION_2["zstd"])
        datasets.append(level(str(i), [2 ** i] * 3, [0] * 3))
        values = values[::2, ::2, ::2]
    return describe(path, datasets, version=2)


def test_bent():
    path = sampled_store()
    values = numpy.pad(voxels(), ((0, 1),) * 3)[::2, ::2, ::2]
    sources = [bent(source) for source in (
        reader(path, Level=0), volume(values, spacing=(2.0,) * 3), reader(path, Level=1))]
    for planes in (("Axial",), PLANES):
        compare_slices(f"bent, {' '.join(planes)}", sources, BORDERS if planes == PLANES else 0,
                       planes=planes)
    rest = Shown(reader(path, Level=0))
    assert differences(Shown(sources[2]).detail()[0], rest.image())[1] > 1000, "it must be bent"


def test_bent_on_a_box_of_its_own():
    """Each level resamples the lattice on its own box, which is a little smaller if coarser."""
    path = store()
    compare_slices("bent otherwise", [bent(source) for source in (
        reader(path, Level=0), blurred(), coarse(path))], 400)


def test_the_value_under_the_cursor_is_that_of_the_drawn_voxel():
    path = sampled_store()
    for source in (reader(path, Level=1), bent(reader(path, Level=1))):
        shown = Shown(source, ("Axial",))
        shown.detail()
        found = []
        for x in range(20, SIZE, 13):
            for y in range(20, SIZE, 13):
                fact = facts(shown.display, shown.view, x, y)[7:]
                place, known, value = numpy.array(fact[4:7]), fact[9], fact[10]
                index = numpy.round(place).astype(int)
                near = numpy.abs(place - index).max() > 0.49  # rounding may choose the next one
                if known and not near:
                    found.append((value, voxels()[tuple(index[::-1])]))
        values, expected = numpy.transpose(found)
        print(f"  {len(found)} places, off by at most {numpy.abs(values - expected).max():.4f}",
              flush=True)
        assert len(found) > 30 and numpy.array_equal(values, expected), found
        assert len(set(values)) > 10
        shown.close()


def test_a_view_from_afar_needs_no_bricks():
    shown = Shown(coarse(store()), ("Axial",), half=44.0)
    shown.view.CameraParallelScale = 300.0
    image, state = shown.detail()
    assert state["gpuLevel"] == -1 and state["gpuBricks"] == 0, state
    assert image.any()
    shown.close()


def test_only_bricks_of_what_is_seen_come():
    """An axial slice meets one layer of the three, and hidden parts of slices ask for nothing."""
    source = coarse(store())
    axial = Shown(source, ("Axial",), half=60.0)
    state = axial.detail()[1]
    assert state["gpuBricks"] == 12, state  # 3 x 4 in a layer
    axial.view.CameraParallelScale = 10.0
    axial.view.CameraFocalPoint = [80.0, 80.0, 36.0]
    axial.view.CameraPosition = [80.0, 80.0, 336.0]
    axial.close()
    near = Shown(source, ("Axial",), half=10.0)  # x from 38 to 58, y from 46 to 66
    state = near.detail()[1]
    assert state["gpuBricks"] == 2, state  # x from 32 to 64, y from 32 to 96
    near.close()


def test_voxels_of_unequal_sides():
    """Only along z are they longer than a pixel is wide, so a slice shows very many bricks."""
    path = fresh("wide.zarr")
    values = numpy.random.default_rng(4).integers(0, 900, (8, 800, 800)).astype("uint16")
    datasets = []
    for i, steps in enumerate(((1, 1, 1), (2, 4, 4))):
        write_array(path, str(i), values[::steps[0], ::steps[1], ::steps[2]], 2, (4, 100, 100),
                    codecs=zarr_files.OF_VERSION_2["zstd"])
        datasets.append(level(str(i), [8 * steps[0], *steps[1:]], [0] * 3))
    source = reader(describe(path, datasets, version=2), Level=1)
    shown = Shown(source, ("Axial",), (400, 400, 8), 402.0)
    shown.view.CameraFocalPoint, shown.view.CameraPosition = [400, 400, 8], [400, 400, 900]
    state = shown.detail()[1]
    assert state["gpuBricks"] == 25 * 25 and state["gpuBricksLackRoom"] == 0, state
    shown.close()


def test_a_slice_that_moves_asks_for_other_bricks():
    path = store()
    direct = Shown(reader(path, Level=0), ("Axial",))
    blurry = Shown(blurred(), ("Axial",))
    moved = Shown(coarse(path), ("Axial",))
    before = moved.detail()[1]["gpuBricks"]
    uploads = brainshift.counters(moved.display)["volumeUploads"]
    for one in (direct, blurry, moved):
        one.display.SlicePosition = [48.0, 56.0, 20.0]
    image, state = moved.detail()
    assert state["gpuBricks"] > before, (state, before)
    assert brainshift.counters(moved.display)["volumeUploads"] == uploads
    compare("moved", image, direct.image(), blurry.image(), 0)
    for one in (direct, blurry, moved):
        one.close()


def test_while_it_moves():
    """Few pixels ask, and a still picture asks for the rest."""
    path = store()
    direct = Shown(reader(path, Level=0))
    shown = Shown(coarse(path))
    shown.detail()
    for z in (30.0, 20.0, 14.0):
        shown.display.SlicePosition = direct.display.SlicePosition = [40.0, 60.0, z]
        shown.view.SMProxy.InteractiveRender()
        assert brainshift.gpu(shown.display)["gpuBricksWanted"] > 0 or z < 30.0
    image, _ = shown.detail()
    assert differences(image, direct.image())[1] <= BORDERS
    direct.close()
    shown.close()


def test_little_memory():
    """What does not fit stays as coarse as it was, and nothing goes round and round."""
    shown = Shown(bent(coarse(store())))
    full, state = shown.detail()
    need = sum(state[name] for name in ("gpuScalarBytes", "gpuOtherBytes")) / 2 ** 20
    all_bricks = state["gpuBricks"]
    shown.display.MemoryLimit = need - 0.5 * all_bricks * 36 ** 3 * 4 / 2 ** 20
    with messages() as said:
        part, state = shown.detail()
        save("part-of-slices.png", shown.view, 120)
    assert_says(said.text, "saved", "no memory", "Memory Limit")
    assert 8 <= state["gpuBricks"] < all_bricks, (state, all_bricks)
    assert state["gpuBricksLackRoom"] == 1, state
    assert 0 < differences(part, full)[1], "some of it is coarse"
    assert numpy.array_equal(shown.image(), part)
    shown.close()


def test_damaged():
    path = store()
    with open(os.path.join(path, "0", "1.2.1"), "wb") as file:
        file.write(b"spoiled")
    direct = Shown(reader(path, Level=0))  # which says it, too
    shown = Shown(coarse(path))
    direct.image()
    with messages() as said:
        brainshift.draw_detail(shown.view, shown.display)
        image = picture(shown.view)
    assert_says(said.text, "'0/1.2.1'", "level 1")
    assert said.text.count("cannot be read everywhere") == 1, said.text
    assert differences(image, direct.image())[1] <= BORDERS
    direct.close()
    shown.close()


def test_two_views():
    """Each has bricks of its own slices, and keeps them while the other one moves."""
    source = coarse(store())
    one = Shown(source, ("Axial",))
    other = Shown(source, ("Coronal",))
    first, state = one.detail()
    other.detail()
    other.display.SlicePosition = [48.0, 30.0, 36.0]
    assert other.detail()[1]["gpuLevel"] == 0
    assert numpy.array_equal(one.image(), first)
    other.close()
    assert one.detail()[1]["gpuBricks"] == state["gpuBricks"]
    one.close()


def test_a_saved_picture_is_complete():
    """Of any size, although nobody waited for the bricks."""
    shown = Shown(coarse(store()), size=120)
    image = shown.image()
    state = brainshift.gpu(shown.display)
    assert state["gpuBricksWanted"] == 0 and state["gpuBricks"] > 8, state
    assert numpy.array_equal(shown.detail()[0], image)
    larger = [save(name, shown.view, 260) for name in ("first-slices.png", "again-slices.png")]
    assert larger[0] == larger[1], "the first one waited for its bricks"
    shown.close()


def test_stereo_comes_to_an_end():
    shown = Shown(coarse(store()), size=120)
    flat, _ = shown.detail()
    shown.view.StereoType = "Red-Blue"
    shown.view.StereoRender = 1
    image, state = shown.detail(seconds=30)
    assert state["gpuBricksWanted"] == 0 and state["gpuBricksLackRoom"] == 0, state
    assert not numpy.array_equal(image, flat)
    shown.close()


def test_all_detail_takes_few_pictures():
    shown = Shown(coarse(store()))
    frames = brainshift.counters(shown.display)["frames"]
    shown.detail()
    drawn = brainshift.counters(shown.display)["frames"] - frames
    assert drawn <= 6, drawn
    shown.detail()
    shown.close()


def test_what_is_drawn_as_it_was_read():
    """Comparisons, categories, and what a filter made: nothing comes, and nothing is waited for."""
    path = store()
    compared = simple.CompareVolumes(Input=coarse(path), Reference=blurred())
    made = simple.Calculator(Input=coarse(path), Function="2*Intensity",
                             ResultArrayName="Intensity")
    nearest = coarse(path)
    shown = Shown(nearest)  # finer voxels are on their way when it is chosen
    shown.image()
    shown.display.SliceInterpolation = "Nearest"
    assert shown.detail()[1]["gpuLevel"] == -1
    shown.close()
    for source, named in ((compared, {"SliceComparison": "Two colours"}), (made, {}),
                          (nearest, {"SliceInterpolation": "Nearest"})):
        shown = Shown(source, **named)
        _, state = shown.detail()
        assert state["gpuLevel"] == -1 and state["gpuBricksWanted"] == 0, state
        shown.close()


def test_a_selection_leaves_the_bricks_alone():
    source = coarse(store())
    shown = Shown(source, ("Axial",))
    scale = shown.view.CameraParallelScale
    simple.Render(shown.view)  # which resets the camera of a new view
    shown.view.CameraParallelScale = scale
    image, state = shown.detail()
    simple.SelectSurfacePoints(Rectangle=[0, 0, SIZE - 1, SIZE - 1], View=shown.view)
    simple.ClearSelection(source)
    again, after = shown.detail()
    assert after["gpuBricks"] == state["gpuBricks"], (state, after)
    assert numpy.array_equal(again, image)
    shown.close()


run_tests(globals())
