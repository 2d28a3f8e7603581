# SPDX-License-Identifier: BSD-3-Clause
# Proves that a store that is read coarsely is drawn as finely as it is stored where rays meet it:
# as the finest level is, read and drawn directly, also bent, clipped to a small memory, with a
# chunk that is damaged, while it is bent again and in two views. Skipping changes no bit of it.
# A volume that is too large is drawn so from an image of it, and keeps its strokes.
import os
import re
import shutil

import nibabel
import numpy
from brainshift_testing import (assert_says, load_plugin, messages, output, picture, run_tests,
                                scratch, show_volume, use_headlight, view_along, volume)
from brainshift_testing import voxels as values_of
from streamed_store import (MIDDLE, TURNED, bent, blurred, coarse, compare, differences, reader,
                            save, store, voxels)
from zarr_files import fresh, write_array

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402
from stock_testing import prop_of  # noqa: E402
from vtkmodules.vtkCommonCore import vtkStringArray  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPlane  # noqa: E402

COLORS = [0, 0.1, 0.1, 0.5, 500, 1, 0.6, 0.2, 1000, 1, 1, 0.8]
TRANSLUCENT = [0, 0, 0.5, 0, 300, 0, 0.5, 0, 700, 0.1, 0.5, 0, 1000, 0.4, 0.5, 0]
OPAQUE = [0, 0, 0.5, 0, 440, 0, 0.5, 0, 460, 1, 0.5, 0, 1000, 1, 0.5, 0]
STEP = 0.4  # mm
COMPOSITE, MAXIMUM = 0, 1  # BlendMode


class Shown:
    """A volume in a view of its own, cut by a plane so that samples have the same places."""

    def __init__(self, source, opacities=TRANSLUCENT, shade=True, size=200, away=190.0, **named):
        self.view = view_along((-0.2, 0.3, -1), MIDDLE, away, size=size)
        use_headlight(self.view)
        self.display = show_volume(source, self.view, "Deformed Volume", COLORS, opacities,
                                   named.pop("array", "Intensity"), shade)
        self.display.VolumeNormalTexture = "On the fly"
        self.display.SampleDistance = STEP
        self.display.AmbientOcclusion = 0.0
        for name, value in named.items():
            setattr(self.display, name, value)
        with messages():  # unknown sides
            self.view.SMProxy.StillRender()
        plane = vtkPlane()
        plane.SetOrigin(48.0, 56.0, 66.0)
        plane.SetNormal(-0.05, 0.1, -1.0)
        prop_of(self.view).GetMapper().AddClippingPlane(plane)

    def detail(self, **named):
        state = brainshift.draw_detail(self.view, self.display, **named)
        return picture(self.view), state

    def close(self):
        simple.Delete(self.view)


def test_as_drawn_directly():
    path = store()
    for opacities in (TRANSLUCENT, OPAQUE):
        for shade in (False, True):
            direct = Shown(reader(path, Level=0), opacities, shade)
            blurry = Shown(blurred(), opacities, shade)
            streamed = Shown(coarse(path), opacities, shade)
            image, state = streamed.detail()
            assert state["gpuLevel"] == 0 and state["gpuBricks"] > 8, state
            assert state["gpuBricksLackRoom"] == 0, state
            name = "opaque" if opacities is OPAQUE else "translucent"
            compare(f"{name}, {'lit' if shade else 'not lit'}", image, picture(direct.view),
                    picture(blurry.view), TURNED if shade else 0)
            for one in (direct, blurry, streamed):
                one.close()


def test_bent():
    path = store()
    direct = Shown(bent(reader(path, Level=0)))
    blurry = Shown(bent(blurred()))
    rest = Shown(reader(path, Level=0))
    streamed = Shown(bent(coarse(path)))
    image, _ = streamed.detail()
    # Each level resamples the lattice on its own box, which is a little smaller if it is coarser.
    compare("bent", image, picture(direct.view), picture(blurry.view), 330)
    assert differences(image, picture(rest.view))[1] > 1000, "it must be bent"
    for one in (direct, blurry, rest, streamed):
        one.close()


def test_skipping_changes_nothing():
    path = store()
    for source in (coarse(path), bent(coarse(path))):
        for opacities in (TRANSLUCENT, OPAQUE):
            shown = Shown(source, opacities, size=120)
            image, _ = shown.detail()
            shown.display.EmptySpaceSkipping = 0
            assert numpy.array_equal(picture(shown.view), image)
            shown.close()


def test_a_file_of_another_type():
    """Floats are stored as they are; int8 is spread over sixteen bits."""
    for kind in (numpy.float32, numpy.int16):
        path = store(kind=kind)
        direct = Shown(reader(path, Level=0), size=120)
        streamed = Shown(reader(path, MemoryLimit=0.5 if kind == numpy.float32 else 0.3), size=120)
        image, state = streamed.detail()
        assert state["gpuLevel"] == 0, state
        largest, pixels, _ = differences(image, picture(direct.view))
        assert pixels <= TURNED, (kind, pixels, largest)
        direct.close()
        streamed.close()


def test_a_view_from_afar_needs_no_bricks():
    shown = Shown(coarse(store()))
    shown.view.CameraPosition = [48.0, 56.0, 1300.0]
    image, state = shown.detail()
    assert state["gpuLevel"] == -1 and state["gpuBricks"] == 0, state
    assert image.any()
    shown.close()


def test_little_memory():
    """What does not fit stays as coarse as it was, and nothing goes round and round."""
    path = store()
    shown = Shown(bent(coarse(path)))
    full, state = shown.detail()
    need = sum(state[name] for name in ("gpuScalarBytes", "gpuOtherBytes")) / 2 ** 20
    all_bricks = state["gpuBricks"]
    shown.display.MemoryLimit = need - 0.4 * all_bricks * 36 ** 3 * 4 / 2 ** 20
    with messages() as said:
        part, state = shown.detail()
    assert_says(said.text, "saved", "no memory", "Memory Limit")
    with messages() as said:
        save("part.png", shown.view, 120)
        save("part.png", shown.view, 120)
    assert said.text.count("no memory") == 2, said.text  # each picture that is saved
    assert 8 <= state["gpuBricks"] < all_bricks, (state, all_bricks)
    assert state["gpuBricksLackRoom"] == 1, state
    assert 0 < differences(part, full)[1], "some of it is coarse"
    assert numpy.array_equal(picture(shown.view), part)
    shown.display.EmptySpaceSkipping = 0
    assert numpy.array_equal(picture(shown.view), part)
    shown.close()


def test_damaged():
    path = store()
    with open(os.path.join(path, "0", "1.2.1"), "wb") as file:
        file.write(b"spoiled")
    direct = Shown(reader(path, Level=0))  # which says it, too
    shown = Shown(coarse(path))
    with messages() as said:
        image, _ = shown.detail()
        picture(shown.view)
    assert_says(said.text, "'0/1.2.1'", "level 1")
    assert said.text.count("cannot be read everywhere") == 1, said.text
    assert differences(image, picture(direct.view))[1] <= TURNED
    direct.close()
    shown.close()


def test_a_store_that_changed_after_it_was_opened():
    """Chunks that are gone would count as empty, and those of a new store are of another volume:
    the coarse picture stays. Later pictures tell it, too."""
    def rewritten(path):
        write_array(path, "0", voxels() // 2, 2, (20, 24, 28))
    for change in (lambda path: os.rename(path, path + ".moved"), rewritten):
        shutil.rmtree(fresh("bricks.zarr") + ".moved", ignore_errors=True)
        path = store()
        shown = Shown(coarse(path), away=1900.0)
        shown.detail()  # now the finer levels are known, and no brick was asked for
        change(path)
        shown.view.CameraPosition = [
            middle + (far - middle) / 10 for middle, far in zip(MIDDLE, shown.view.CameraPosition)]
        with messages() as said:
            image, state = shown.detail()
            save("changed.png", shown.view, 120)
        assert state["gpuBricks"] == 0, state
        assert_says(said.text, "written anew, moved or deleted", "reload it", "coarser in places",
                    "cannot be read")
        before = Shown(blurred())
        assert differences(image, picture(before.view))[1] == 0
        before.close()
        shown.close()


def test_counted_samples_bring_no_bricks():
    """Which is reported, for the picture is coarser than it may be."""
    shown = Shown(coarse(store()))
    shown.detail()  # now the finer levels are known
    shown.view.CameraPosition = [48.0, 56.0, -80.0]
    shown.display.CountSamples = 1
    with messages() as said:
        _, state = shown.detail()
    assert state["gpuBricksWanted"] == 0, state
    assert_says(said.text, "Count Samples")
    shown.close()


def test_a_little_more_memory_counts():
    """A message asks for it."""
    shown = Shown(bent(coarse(store())))
    _, state = shown.detail()
    need = sum(state[name] for name in ("gpuScalarBytes", "gpuOtherBytes")) / 2 ** 20
    brick = 36 ** 3 * 4 / 2 ** 20
    drawn = []
    for share in (0.45, 0.25):  # of less than half as much again
        shown.display.MemoryLimit = need - share * state["gpuBricks"] * brick
        drawn.append(shown.detail()[1]["gpuBricks"])
    assert drawn[1] > drawn[0], drawn
    shown.close()


def test_bent_while_it_loads():
    path = store()
    filter = simple.FreeFormDeformation(Input=coarse(path))
    shown = Shown(filter)
    strokes = []
    for i in range(4):
        strokes += list(brainshift.soft((30.0 + 10 * i, 56.0, 40.0), (0, 0, 3), 14.0))
        filter.Strokes = strokes
        shown.view.SMProxy.StillRender()
    image, state = shown.detail()
    uploads = brainshift.counters(shown.display)["volumeUploads"]
    again = Shown(simple.FreeFormDeformation(Input=coarse(path), Strokes=strokes))
    other, _ = again.detail()
    assert numpy.array_equal(image, other)
    bricks = state["gpuBricks"]
    filter.Strokes = strokes[:-14] + list(
        brainshift.soft((60.0, 56.0, 40.0), (0, 0, 2), 14.0))
    _, state = shown.detail()
    assert brainshift.counters(shown.display)["volumeUploads"] == uploads
    assert state["gpuBricks"] >= bricks
    shown.close()
    again.close()


def test_a_stroke_casts_what_it_changed():
    """Also where bricks come for it, and when its rays ask once more."""
    path = store()
    filter = simple.FreeFormDeformation(Input=coarse(path), LatticeDimensions=[19] * 3)
    shown = Shown(filter)
    _, before = shown.detail()

    def cast(change):
        former = brainshift.counters(shown.display)["pixelsCast"]
        change()
        shown.view.SMProxy.StillRender()
        return brainshift.counters(shown.display)["pixelsCast"] - former

    def turn():
        shown.view.CameraPosition = [place + 0.01 for place in shown.view.CameraPosition]

    def stroke(mm):
        filter.Strokes = brainshift.soft((48.0, 56.0, 60.0), (mm, 0, 0), 9.0)
    stroke(1.0)  # now there is a field
    whole = cast(turn)
    shown.detail()
    parts = [cast(lambda mm=mm: stroke(mm)) for mm in (2.0, 3.0, 4.0)]
    print("pixels of the picture, of strokes", whole, parts, flush=True)
    image, state = shown.detail()
    assert max(parts) < 0.6 * whole, (parts, whole)
    again = Shown(simple.FreeFormDeformation(
        Input=coarse(path), LatticeDimensions=[19] * 3, Strokes=filter.Strokes))
    again.view.CameraPosition = shown.view.CameraPosition
    other, fresh = again.detail()
    assert fresh["gpuBricks"] > 8 and state["gpuBricks"] >= before["gpuBricks"]
    assert numpy.array_equal(image, other)
    shown.close()
    again.close()


def test_another_level_while_bricks_arrive():
    source = reader(store(), MemoryLimit=0.05)
    with messages():  # unknown sides
        source.UpdatePipeline()
    assert source.GetClientSideObject().GetOutput().GetDimensions() == (24, 28, 18)
    pictures = []
    for former in (8, 0):
        shown = Shown(source)
        for _ in range(former):
            shown.view.SMProxy.StillRender()  # bricks of the finest level are on their way
        away = numpy.array(shown.view.CameraPosition) - MIDDLE
        shown.view.CameraPosition = list(MIDDLE + 4.6 * away)
        image, state = shown.detail()
        assert state["gpuLevel"] == 1 and state["gpuBricks"] > 4, state
        pictures.append(image)
        shown.close()
    assert numpy.array_equal(*pictures)


def test_two_views():
    source = coarse(store())
    one = Shown(source, size=120)
    other = Shown(source, OPAQUE, size=120)
    first, _ = one.detail()
    other.detail()
    assert numpy.array_equal(picture(one.view), first)
    one.close()
    assert other.detail()[1]["gpuLevel"] == 0
    other.close()


def test_pictures_that_ask_for_nothing_are_complete():
    shown = Shown(coarse(store()), size=120, CountSamples=1)
    assert shown.detail()[1]["gpuBricks"] == 0
    shown.display.CountSamples = 0
    image, state = shown.detail()
    assert state["gpuBricks"] > 8, state
    shown.display.CountSamples = 1
    assert numpy.array_equal(picture(shown.view), image)
    shown.close()


def test_a_saved_picture_is_complete():
    """Of any size, although nobody waited for the bricks."""
    path = store()
    shown = Shown(coarse(path), size=120)
    image = picture(shown.view)
    state = brainshift.gpu(shown.display)
    assert state["gpuBricksWanted"] == 0 and state["gpuBricks"] > 8, state
    assert numpy.array_equal(shown.detail()[0], image)
    larger = [save(name, shown.view, 260) for name in ("first.png", "again.png")]
    assert larger[0] == larger[1], "the first one waited for its bricks"
    shown.close()


def test_a_saved_picture_of_both_eyes_comes_to_an_end():
    """Each eye waits for its own bricks alone: it would wait for a minute, and warn."""
    shown = Shown(coarse(store()), size=120)
    shown.view.StereoType = "Red-Blue"
    shown.view.StereoRender = 1
    files = []
    for name in ("first-eyes.png", "again-eyes.png"):
        with messages() as said:
            files.append(save(name, shown.view, 260))
        assert "coarser" not in said.text, said.text
    assert files[0] == files[1], "the first one waited for its bricks"
    shown.close()


def test_one_eye_alone_comes_to_an_end():
    shown = Shown(coarse(store()), size=120)
    shown.view.StereoType = "Left"
    shown.view.StereoRender = 1
    _, state = shown.detail(seconds=30)
    assert state["gpuBricksWanted"] == 0 and state["gpuBricks"] > 8, state
    shown.close()


def test_tissue_that_a_cut_or_a_mesh_uncovers_is_complete():
    """The camera does not move, and all bricks of the view before are there."""
    path = store()
    both = Shown(reader(path, Level=0), OPAQUE), Shown(coarse(path), OPAQUE)
    direct, streamed = both
    cover = simple.Plane(Origin=[-60, -60, 110], Point1=[50, -60, 110], Point2=[-60, 180, 110])
    covers = [simple.Show(cover, shown.view) for shown in both]
    before = streamed.detail()[1]["gpuBricks"]
    for one in covers:
        one.Visibility = 0
    image, state = streamed.detail()
    assert state["gpuBricks"] > before, (state, before)
    assert differences(image, picture(direct.view))[1] <= TURNED
    before = state["gpuBricks"]
    for shown in both:
        plane = vtkPlane()
        plane.SetOrigin(48.0, 56.0, 24.0)
        plane.SetNormal(-0.1, 0.2, -1.0)
        prop_of(shown.view).GetMapper().AddClippingPlane(plane)
    image, state = streamed.detail()
    assert state["gpuBricks"] > before, (state, before)
    assert differences(image, picture(direct.view))[1] <= TURNED
    for shown in both:
        shown.close()


def test_shadows_are_those_of_the_finer_level():
    path = store()
    named = {"AmbientOcclusion": 1.0, "OcclusionRadius": 8.0}
    direct = Shown(reader(path, Level=0), OPAQUE, **named)
    blurry = Shown(blurred(), OPAQUE, **named)
    streamed = Shown(coarse(path), OPAQUE, **named)
    image, _ = streamed.detail()
    compare("with shadows", image, picture(direct.view), picture(blurry.view), TURNED)
    for one in (direct, blurry, streamed):
        one.close()


def test_finer_levels_that_cannot_be_read():
    """Also the first picture warns of it."""
    path = store()
    source = coarse(path)
    os.remove(os.path.join(path, "0", ".zarray"))
    view = view_along((-0.2, 0.3, -1), MIDDLE, 190.0, size=120)
    with messages() as said:
        show_volume(source, view, "Deformed Volume", COLORS, TRANSLUCENT)
        save("unread.png", view, 120)
    assert_says(said.text, path, "no array '0'")
    simple.Delete(view)


def test_stereo_comes_to_an_end():
    """Each eye asks for its own bricks, and both keep them."""
    shown = Shown(coarse(store()), size=120)
    flat, _ = shown.detail()
    shown.view.StereoType = "Red-Blue"
    shown.view.StereoRender = 1
    image, state = shown.detail(seconds=30)
    assert state["gpuBricksWanted"] == 0 and state["gpuBricksLackRoom"] == 0, state
    assert not numpy.array_equal(image, flat)
    frames = brainshift.counters(shown.display)["frames"]
    assert brainshift.draw_detail(shown.view, shown.display)["gpuBricksWanted"] == 0
    assert brainshift.counters(shown.display)["frames"] <= frames + 2, "one picture of each eye"
    shown.close()


def test_bricks_come_in_few_pictures():
    """A picture of each few bricks took most of the time."""
    shown = Shown(coarse(store()), size=120)
    frames = brainshift.counters(shown.display)["frames"]
    _, state = shown.detail()
    drawn = brainshift.counters(shown.display)["frames"] - frames
    assert state["gpuBricks"] > 8 and drawn <= 9, (state, drawn)
    shown.close()


def test_what_a_filter_made_is_drawn_as_it_is():
    """Its numbers are not those of the file."""
    smooth = simple.Calculator(Input=coarse(store()), Function="2*Intensity",
                               ResultArrayName="Intensity")
    shown = Shown(smooth)
    _, state = shown.detail()
    assert state["gpuLevel"] == -1 and state["gpuBricksWanted"] == 0, state
    shown.close()


STROKE = list(brainshift.soft((30.0, 56.0, 40.0), (0, 0, 3), 14.0))


def limit_of(shown, lacking):
    """A limit below what a volume needs, MiB."""
    shown.display.MemoryLimit = 0.01
    with messages() as said:
        picture(shown.view)
    total, corrections = (float(re.search(words, said.text).group(1)) for words in (
        r"needs ([\d.]+) MiB", r"corrections of it ([\d.]+)"))
    return total - corrections - lacking


def too_large():
    """A bent volume of another array than that of readers, which does not fit into the memory."""
    source = volume(voxels().repeat(2, 0).repeat(2, 1).repeat(2, 2), (-0.25,) * 3, (0.5,) * 3)
    image = source.GetClientSideObject().GetOutputDataObject(0)
    image.GetPointData().GetScalars().SetName("RTData")
    filter = simple.FreeFormDeformation(Input=source, Strokes=STROKE)
    shown = Shown(filter, OPAQUE, array="RTData", size=120)
    shown.fine = picture(shown.view)
    shown.display.MemoryLimit = limit_of(shown, 1.0)
    with messages() as said:
        shown.coarse = picture(shown.view)
    shown.said = said.text
    return source, filter, shown


def new_store(name="all-voxels.ome.zarr"):
    path = fresh(name)
    os.rmdir(path)
    return path


def test_a_volume_that_is_too_large_is_drawn_from_its_image():
    source, filter, shown = too_large()
    assert_says(shown.said, "drawn coarser", "OME-Zarr image", "Draw All Voxels",
                "brainshift.draw_from_pyramid")
    other = simple.FreeFormDeformation(Input=source)
    compared = simple.CompareVolumes(Input=filter, Reference=source)
    simple.SetActiveSource(compared)
    told = []
    reader = brainshift.draw_from_pyramid(filter, new_store(), progress=told.append)
    assert told == sorted(told) and told[-1] == 1.0, told
    assert filter.Input == reader and list(filter.Strokes) == STROKE
    assert other.Input == source and compared.Reference == source
    assert simple.GetActiveSource() == compared
    assert source in simple.GetSources().values()
    with messages() as said:
        image, state = shown.detail()
    assert "coarser:" not in said.text, said.text
    assert state["gpuVoxelsPerTexel"] == 1 and state["gpuNeedsPyramid"] == 0, state
    assert state["gpuLevel"] == 0 and state["gpuBricks"] > 8, state
    assert state["gpuBricksLackRoom"] == 0, state
    assert shown.display.ColorArrayName[1] == "RTData"
    off = [differences(one, shown.fine)[1] for one in (image, shown.coarse)]
    print(f"  {off[0]} pixels differ, drawn coarser {off[1]}")
    assert off[0] < 0.1 * off[1], off
    reader.Level = 0
    assert (values_of(reader, "RTData") == values_of(source, "RTData")).all()
    for place in ("GetOrigin", "GetSpacing"):
        assert getattr(output(reader), place)() == getattr(output(source), place)(), place
    shown.close()


def test_what_is_not_written_changes_nothing():
    source, filter, shown = too_large()
    sources = set(simple.GetSources())
    full = fresh("full.ome.zarr")
    with open(os.path.join(full, "file"), "w", encoding="utf-8"):
        pass
    for error, words, arguments in (
            (OSError, "stopped", {"out": new_store(), "progress": lambda _: False}),
            (OSError, "full.ome.zarr", {"out": full}),
            (ValueError, "out is missing", {}),
            (ValueError, "must end in .zarr", {"out": "somewhere"})):
        with messages():
            try:
                brainshift.draw_from_pyramid(filter, **arguments)
                raise AssertionError(words)
            except error as problem:
                assert words in str(problem), problem
        assert filter.Input == source and set(simple.GetSources()) == sources, words
        assert numpy.array_equal(picture(shown.view), shown.coarse), words
    shown.close()


def test_volumes_that_no_image_can_replace_are_refused():
    bent = simple.FreeFormDeformation(Input=volume(voxels()[::8, ::8, ::8].copy()))
    left = volume(voxels()[::8, ::8, ::8].copy())
    sides = vtkStringArray()
    sides.SetName("WorldAxes")
    sides.InsertNextValue("LPS")
    left.GetClientSideObject().GetOutputDataObject(0).GetFieldData().AddArray(sides)
    left.MarkModified(left.SMProxy)
    file = scratch("times.nii")
    nibabel.save(nibabel.Nifti1Image(numpy.zeros((7, 6, 5, 3), "int16"), numpy.eye(4)), file)
    times = simple.NIFTIVolumeReader(FileName=file)
    for source, words in ((simple.FreeFormDeformation(Input=bent), "bent already"),
                          (simple.FreeFormDeformation(Input=times), "3 times"),
                          (simple.FreeFormDeformation(Input=coarse(store())), "already"),
                          (left, "LPS"), (simple.Sphere(), "no volume")):
        try:
            brainshift.draw_from_pyramid(source, new_store())
            raise AssertionError(words)
        except ValueError as problem:
            assert words in str(problem), problem


def test_no_image_is_offered_where_it_would_bring_no_voxels():
    _, _, shown = too_large()
    assert brainshift.gpu(shown.display)["gpuNeedsPyramid"] == 1
    for blend, needs in ((MAXIMUM, 0), (COMPOSITE, 1)):
        shown.display.BlendMode = blend
        picture(shown.view)
        held = brainshift.gpu(shown.display)
        assert held["gpuVoxelsPerTexel"] > 1 and held["gpuNeedsPyramid"] == needs, (blend, held)
    shown.display.SetRepresentationType("Deformed Slices")
    with messages() as said:
        picture(shown.view)
    assert_says(said.text, "drawn coarser", "Draw All Voxels")
    assert brainshift.gpu(shown.display)["gpuNeedsPyramid"] == 1
    shown.close()
    path = brainshift.pyramid(volume(voxels()), new_store())
    shown = Shown(simple.FreeFormDeformation(Input=reader(path), Strokes=STROKE), OPAQUE, size=120)
    shown.display.MemoryLimit = limit_of(shown, 0.5)
    with messages() as said:
        picture(shown.view)
    assert_says(said.text, "drawn coarser", "a lower Memory Limit of its OME-Zarr Reader")
    assert "draw_from_pyramid" not in said.text, said.text
    shown.close()


def test_a_volume_that_nothing_bends():
    """Its display shows the reader."""
    source, filter, bent = too_large()
    bent.close()
    shown = Shown(source, OPAQUE, array="RTData", size=120)
    fine = picture(shown.view)
    shown.display.MemoryLimit = limit_of(shown, 1.0)
    with messages():
        picture(shown.view)
        reader = brainshift.draw_from_pyramid(source, new_store())
    assert filter.Input == source and shown.display.Input == reader
    image, state = shown.detail()
    assert state["gpuVoxelsPerTexel"] == 1 and state["gpuBricks"] > 8, state
    off = differences(image, fine)[1]
    print(f"  {off} pixels differ")
    assert off < 100, off
    shown.close()


run_tests(globals())
