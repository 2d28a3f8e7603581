# SPDX-License-Identifier: BSD-3-Clause
# Proves that written OME-Zarr images hold what was given: numbers as zarr-python reads them, levels
# as numpy makes them, places, directions, labels, least and greatest values, and that a store that
# was not finished is recognised and continued.
import json
import os
import shutil

import numpy
import zarr
import zarr_files
from brainshift_testing import load_plugin, messages, output, run_tests, scratch, volume
from zarr_files import fresh, numbers_of

load_plugin()
import brainshift  # noqa: E402 after the plugin
from brainshift import pyramids  # noqa: E402
from brainshift.roles import reader_of  # noqa: E402
from paraview import servermanager, simple  # noqa: E402

ODD = (70, 65, 131)  # z, y, x: chunks at all ends are cut
TURNED = (0.8, -0.6, 0.0, 0.6, 0.8, 0.0, 0.0, 0.0, 1.0)
KINDS = ("uint8", "int8", "uint16", "int16", "uint32", "int32", "float32", "float64")


def target(name="written.ome.zarr"):
    path = scratch(name)
    shutil.rmtree(path, ignore_errors=True)
    return path


def named(source, *axes):
    """The same source with its world's axes."""
    from vtkmodules.vtkCommonCore import vtkStringArray
    array = vtkStringArray()
    array.SetName("WorldAxes")
    array.InsertNextValue(axes[0])
    source.GetClientSideObject().GetOutputDataObject(0).GetFieldData().AddArray(array)
    return source


def written(source, path=None, **properties):
    """Writes, and returns the path and what was said."""
    path = path or target()
    writer = servermanager.writers.OMEZarrWriter(Input=source, FileName=path, **properties)
    with messages() as said:
        writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    return path, writer.GetPropertyValue("Problem"), said.text


def good(source, path=None, **properties):
    path, problem, _ = written(source, path, **properties)
    assert problem == "", problem
    return path


def array_of(path, name):
    return zarr.open_array(os.path.join(path, name), mode="r")[...]


def eights(fine, steps=(2, 2, 2)):
    """The finer voxels of each voxel, in the order z, y, x, and whether they are there."""
    sizes = [-(-side // step) for side, step in zip(fine.shape, steps)]
    ends = [size * step - side for size, step, side in zip(sizes, steps, fine.shape)]
    padded = numpy.pad(fine, [(0, end) for end in ends])
    there = numpy.pad(numpy.ones(fine.shape, bool), [(0, end) for end in ends])

    def split(values):
        parts = values.reshape([part for pair in zip(sizes, steps) for part in pair])
        return parts.transpose(0, 2, 4, 1, 3, 5).reshape(*sizes, -1)
    return split(padded), split(there)


def mean_of(fine, steps=(2, 2, 2)):
    values, there = eights(fine, steps)
    mean = (values.astype("float64") * there).sum(-1) / there.sum(-1)
    if fine.dtype.kind == "f":
        return mean.astype(fine.dtype)
    return numpy.trunc(mean + numpy.copysign(0.5, mean)).astype(fine.dtype)


def test_numbers_and_means():
    for version, kind in [(v, k) for k in KINDS for v in (0, 1)]:
        values = zarr_files.values_of(ODD, kind)
        if kind.startswith("float"):
            values = numpy.clip(values, -1e30, 1e30).astype(kind)
        path = good(volume(values), Version=version)
        found = array_of(path, "0")
        assert found.dtype == values.dtype and (found == values).all(), kind
        expected = mean_of(values)
        level = array_of(path, "1")
        assert level.shape == expected.shape, (level.shape, expected.shape)
        if kind.startswith("float"):
            assert numpy.allclose(level, expected, rtol=1e-5, atol=1e22), kind
        else:
            assert (level == expected).all(), kind
        assert (array_of(path, "2") == mean_of(level)).all() or kind.startswith("float")
        assert not os.path.exists(os.path.join(path, "3")), "one chunk is the coarsest"
        read, _, _ = zarr_files.read(path)
        assert (read == values).all()


def test_places():
    """The middle of each voxel lies between those that it is made of."""
    values = zarr_files.values_of((70, 8, 130), "uint8")
    source = named(volume(values, (1.5, -20, 7), (0.5, 2.0, 0.5)), "RAS")
    path = good(source)
    with open(os.path.join(path, ".zattrs"), encoding="utf-8") as file:
        image = json.load(file)["multiscales"][0]
    assert [axis["unit"] for axis in image["axes"]] == ["millimeter"] * 3
    # y is four times as long, so it is halved two levels later
    assert [array_of(path, str(i)).shape for i in range(3)] == [
        (70, 8, 130), (35, 8, 65), (18, 8, 33)]
    for i, step in enumerate((1, 2, 4)):
        said = image["datasets"][i]["coordinateTransformations"]
        assert said[0]["scale"] == [0.5 * step, 2.0, 0.5 * step]
        assert said[1]["translation"] == [7 + 0.25 * (step - 1), -20, 1.5 + 0.25 * (step - 1)]
        with messages() as text:
            found = output(simple.OMEZarrReader(FileName=path, Level=i))
        assert text.text == "", text.text
        assert found.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
        assert found.GetSpacing() == (0.5 * step, 2.0, 0.5 * step)


def test_direction():
    """All levels are turned about the first voxel, and its world is kept."""
    values = zarr_files.values_of(ODD, "int16")
    for version in (0, 1):
        source = named(volume(values, (10, 20, 30), (1, 2, 3), TURNED), "RAS")
        path = good(source, Version=version)
        for i, step in enumerate(((1, 1, 1), (2, 1, 1))):
            found = output(simple.OMEZarrReader(FileName=path, Level=i))
            matrix = found.GetDirectionMatrix()
            assert numpy.allclose([matrix.GetElement(r, c) for r in range(3) for c in range(3)],
                                  TURNED)
            expected = numpy.array((10, 20, 30)) + numpy.reshape(TURNED, (3, 3)) @ (
                0.5 * (numpy.array(step) - 1) * (1, 2, 3))
            assert numpy.allclose(found.GetOrigin(), expected), (found.GetOrigin(), expected)
            assert numpy.allclose(found.GetSpacing(), numpy.array(step) * (1, 2, 3))


def test_left_is_right():
    values = zarr_files.values_of((3, 4, 5), "int16")
    path = good(named(volume(values, (10, 20, 30)), "LPS"))
    found = output(simple.OMEZarrReader(FileName=path))
    assert found.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
    assert (numbers_of(found) == values[:, ::-1, ::-1]).all()
    assert numpy.allclose(found.GetOrigin(), (-10 - 4, -20 - 3, 30))


def test_sides_that_are_not_known():
    path, problem, said = written(volume(zarr_files.values_of((3, 4, 5), "int16")))
    assert problem == "" and "unknown" in said
    zarr_files.read(path)  # which warns of it


def test_labels():
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
    random = numpy.random.default_rng(3)
    values = random.integers(0, 3, (66, 40, 129)).astype("uint8")
    source = volume(values)
    mark = vtkUnsignedCharArray()
    mark.SetName("IsLabelMap")
    mark.InsertNextValue(1)
    source.GetClientSideObject().GetOutputDataObject(0).GetFieldData().AddArray(mark)
    path = good(source)
    few, there = eights(values)
    counts = numpy.stack([((few == label) & there).sum(-1) for label in range(3)], -1)
    level = array_of(path, "1")
    chosen = numpy.take_along_axis(counts, level[..., None].astype(int), -1)[..., 0]
    assert (chosen == counts.max(-1)).all()
    first = numpy.stack([numpy.where((few == label) & there, numpy.arange(8), 9).min(-1)
                         for label in range(3)], -1)
    first = numpy.where(counts == counts.max(-1)[..., None], first, 9)
    assert (level == first.argmin(-1)).all(), "of as frequent ones the first"
    found = output(simple.OMEZarrReader(FileName=path))
    assert found.GetFieldData().GetArray("IsLabelMap").GetValue(0) == 1


def test_labels_that_the_volume_does_not_name():
    values = numpy.random.default_rng(4).choice(numpy.array([0, 17, 53], "int16"), ODD)
    file = scratch("aseg.nii.gz")
    brainshift.save_volume(named(volume(values), "RAS"), file)
    for labels in (True, None):
        path = brainshift.pyramid(file, target(), labels=labels)
        assert (set(array_of(path, "1").flat) == {0, 17, 53}) is bool(labels)
    path = brainshift.pyramid(volume(values), target(), labels=True)
    assert brainshift.pyramid(path, target("other.ome.zarr"), labels=False)
    assert (array_of(scratch("other.ome.zarr"), "1") == mean_of(values)).all()
    _, problem, _ = written(volume(values.astype("float32")), target(), Labels="Yes")
    assert "whole numbers" in problem, problem


def test_one_of_several_times():
    import nibabel
    values = zarr_files.values_of((3, 5, 6, 7), "int16")
    file = scratch("times.nii")
    nibabel.save(nibabel.Nifti1Image(values.T, numpy.eye(4)), file)
    path, problem, said = written(reader_of(file))
    assert problem == "" and "has 3 times; the store has one of them" in said, said
    assert (array_of(path, "0") == values[0]).all()


def test_channels():
    values = zarr_files.values_of((66, 5, 7, 3), "uint8")
    for version in (0, 1):
        path = good(volume(values), Version=version)
        assert (array_of(path, "0") == numpy.moveaxis(values, -1, 0)).all()
        assert (array_of(path, "1")[1] == mean_of(values[..., 1])).all()
        assert (zarr_files.read(path)[0] == values).all()


def test_least_and_greatest():
    values = zarr_files.values_of(ODD, "float32")
    values[:64, :64, :64] = numpy.nan
    for version in (0, 1):
        path = good(volume(values), Version=version)
        for name in ("0", "1"):
            level, bricks = array_of(path, name), array_of(path, "bricks/" + name)
            for at in numpy.ndindex(bricks.shape[:3]):
                z, y, x = (slice(64 * i, 64 * i + 64) for i in at)
                brick = level[z, y, x]
                expected = ([numpy.nanmin(brick), numpy.nanmax(brick)]
                            if not numpy.isnan(brick).all() else [numpy.nan] * 2)
                assert numpy.array_equal(bricks[at], expected, equal_nan=True), (name, at)


def test_pieces():
    """A store that is written by pieces equals one that is written at once."""
    values = zarr_files.values_of((200, 130, 70), "uint16")
    whole = good(volume(values), target("whole.ome.zarr"))
    for limit in (0.0, 2.0, 3.5):
        parts = good(volume(values), target("parts.ome.zarr"), MemoryLimit=limit)
        for name in ("0", "1", "2", "bricks/0", "bricks/1"):
            assert (array_of(whole, name) == array_of(parts, name)).all(), (limit, name)


def nifti(name="source.nii.gz", shift=0):
    values = zarr_files.values_of((200, 70, 66), "int16") // 4 + shift
    brainshift.save_volume(named(volume(values), "RAS"), scratch(name))
    return scratch(name), values


def stopped(source, path, after):
    """Writes, and stops after some reports of progress, once voxels come. Returns the reason."""
    seen = []

    def progress(fraction):
        seen.extend([fraction] if fraction > 0.0 else [])
        return len(seen) <= after
    try:
        brainshift.pyramid(source, path, progress=progress)
    except OSError as error:
        return str(error)
    return ""


def kept(path):
    """Times of all chunks of the finest level."""
    return {file: os.stat(file).st_mtime_ns for folder, _, names in os.walk(path + "/0")
            for file in [os.path.join(folder, name) for name in names if name[0] != "."]}


def test_from_a_file():
    file, values = nifti()
    path = brainshift.pyramid(file, target("source.ome.zarr"))
    assert (array_of(path, "0") == values).all()
    shutil.rmtree(path)
    assert brainshift.pyramid(file) == scratch("source.ome.zarr")
    again = brainshift.pyramid(path, target("again.ome.zarr"), version="0.5")
    assert (array_of(again, "0") == values).all()
    for words in ({"version": "0.3"}, {"out": "x.nii"}, {"world": "XYZ"}):
        try:
            brainshift.pyramid(file, **words)
            raise AssertionError(words)
        except ValueError:
            pass
    os.makedirs(scratch("folder.v1"), exist_ok=True)
    whole = scratch("folder.v1")
    for name, right in (("a.ome.zarr", "a"), ("a.zarr/", "a"), ("a.nii.gz", "a"),
                        ("a.b.mha", "a.b"), ("scan.2024", "scan.2024"), (whole, whole)):
        assert pyramids._stem(name) == right, name


def test_parts_of_a_nifti_file():
    """Read piece by piece, whichever way its voxels lie."""
    import nibabel
    values = zarr_files.values_of((66, 70, 130), "int16")
    turned = numpy.array([[0, 0, 2.0, -5], [-3.0, 0, 0, 7], [0, 1.0, 0, 9], [0, 0, 0, 1]])
    for affine in (numpy.diag((1.0, 2, 3, 1)), numpy.diag((-1.0, 2, 3, 1)),
                   numpy.diag((1.0, 2, -3, 1)), turned):
        for ending in (".nii", ".nii.gz"):
            file = scratch("parts" + ending)
            nibabel.save(nibabel.Nifti1Image(values, affine), file)
            canonical = nibabel.as_closest_canonical(nibabel.load(file))
            path = good(simple.NIFTIVolumeReader(FileName=file), MemoryLimit=0.0)
            assert (array_of(path, "0") == numpy.asarray(canonical.dataobj).T).all(), affine
            shown = output(simple.OMEZarrReader(FileName=path))
            assert numpy.allclose(shown.GetOrigin(), canonical.affine[:3, 3]), affine


def test_an_input_that_fails():
    file = scratch("missing.nii")
    reader = simple.NIFTIVolumeReader(FileName=file)
    _, problem, _ = written(reader, target("none.ome.zarr"))
    assert "gave no voxels" in problem, problem


def test_stopped_and_continued():
    file, values = nifti()
    path = target("stopped.ome.zarr")
    reason = stopped(file, path, 2)
    assert "stopped" in reason, reason
    assert os.path.exists(path + "/brainshift-unfinished.json")
    assert "not written to its end" in zarr_files.refused(path)
    before = kept(path)
    assert 0 < len(before) <= 16, before
    victim = sorted(before)[0]
    with open(victim, "wb") as chunk:
        chunk.write(b"half")
    brainshift.pyramid(file, path)
    after = kept(path)
    assert all(after[name] == time for name, time in before.items() if name != victim)
    assert (array_of(path, "0") == values).all()
    assert not os.path.exists(path + "/brainshift-unfinished.json")
    assert not [name for _, _, names in os.walk(path) for name in names if name.endswith(".part")]


def test_stopped_while_the_input_is_read():
    """Of a file that takes long, before the first chunk and within a later piece. The input is read
    again when somebody else asks for it."""
    import nibabel
    values = zarr_files.values_of((66, 70, 130), "int16")
    file = scratch("long.nii")
    nibabel.save(nibabel.Nifti1Image(values.T, numpy.diag((-1.0, -1.0, 1.0, 1))), file)
    path = target("reading.ome.zarr")
    calls = []
    try:
        brainshift.pyramid(file, path, progress=lambda _: calls.append(1) or False)
        raise AssertionError("not stopped")
    except OSError as error:
        assert "was stopped" in str(error), error
    assert len(calls) < 6 and not os.path.exists(path), calls  # VTK adds an end
    reader = simple.NIFTIVolumeReader(FileName=file)
    writer = servermanager.writers.OMEZarrWriter(Input=reader, FileName=path, MemoryLimit=0.0)
    own, fractions = writer.GetClientSideObject(), []

    def stop(*_):
        fractions.append(own.GetProgress())
        if fractions[0] < fractions[-1] == fractions[-2]:  # the next piece is read
            own.SetAbortExecute(1)
    own.AddObserver("ProgressEvent", stop)
    with messages():
        writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    assert "was stopped" in writer.GetPropertyValue("Problem"), writer.GetPropertyValue("Problem")
    assert fractions[-2] == fractions[-3] < 0.9, fractions  # VTK adds an end
    own_reader = reader.GetClientSideObject()
    own_reader.UpdateWholeExtent()
    image = own_reader.GetOutputDataObject(0)
    assert image.GetDimensions() == (130, 70, 66), image.GetDimensions()
    found = zarr_files.numbers_of(image)
    assert (numpy.sort(found, axis=None) == numpy.sort(values, axis=None)).all()


def test_another_source_begins_anew():
    """Of the same name and size but with other voxels: nothing of it is kept."""
    file, _ = nifti()
    path = target("stopped.ome.zarr")
    assert "stopped" in stopped(file, path, 2)
    before = kept(path)
    file, values = nifti(shift=5)
    brainshift.pyramid(file, path)
    assert (array_of(path, "0") == values).all()
    assert all(kept(path)[name] != time for name, time in before.items())


def halted(source, path, fraction, **properties):
    """Writes until a fraction is done."""
    writer = servermanager.writers.OMEZarrWriter(Input=source, FileName=path, **properties)
    own = writer.GetClientSideObject()
    own.AddObserver("ProgressEvent", lambda *_: own.SetAbortExecute(own.GetProgress() >= fraction))
    with messages():
        writer.UpdatePipeline()
    writer.SMProxy.UpdatePropertyInformation()
    assert "was stopped" in writer.GetPropertyValue("Problem")


def test_other_voxels_are_never_kept():
    """The file that is named is unchanged, another one has its numbers."""
    values = zarr_files.values_of((200, 70, 66), "int16")
    with open(scratch("detached.mhd"), "w", encoding="utf-8") as file:
        file.write("ObjectType = Image\nNDims = 3\nDimSize = 66 70 200\nElementType = MET_SHORT\n"
                   "ElementDataFile = detached.raw\n")
    path = target("detached.ome.zarr")
    for change in (0, 1):
        values[:60] ^= change
        values.tofile(scratch("detached.raw"))
        reader = reader_of(scratch("detached.mhd"))
        if change == 0:
            halted(reader, path, 0.4, MemoryLimit=0.0)
            before = kept(path)
    writer = servermanager.writers.OMEZarrWriter(Input=reader, FileName=path, MemoryLimit=0.0)
    with messages():
        writer.UpdatePipeline()
    given = numbers_of(output(reader_of(scratch("detached.mhd"))))  # which is turned to RAS
    assert (numpy.sort(given, axis=None) == numpy.sort(values, axis=None)).all()
    assert (array_of(path, "0") == given).all()
    assert (array_of(path, "1") == mean_of(given)).all()
    writer.SMProxy.UpdatePropertyInformation()
    assert writer.GetPropertyValue("PiecesKept") > 0
    assert any(kept(path)[name] == time for name, time in before.items())


def test_no_stale_coarser_level():
    """Also where an earlier run was killed while it removed the levels of another volume."""
    values = zarr_files.values_of(ODD, "int16")
    for spacing, removed in [(s, r) for s in (1, 2) for r in (True, False)]:
        path = target("stale.ome.zarr")
        halted(volume(values), path, 0.9)
        assert os.path.exists(path + "/1/0/0/0")
        if removed:
            shutil.rmtree(path + "/0")
        good(volume(values[::-1], spacing=(spacing,) * 3), path)
        assert (array_of(path, "0") == values[::-1]).all()
        assert (array_of(path, "1") == mean_of(values[::-1])).all(), (spacing, removed)


def test_two_writers_of_one_store():
    """The second begins while the first writes: the store has the voxels of the second alone."""
    values = zarr_files.values_of((200, 70, 66), "int16")
    other = values[::-1]
    for fraction, spacing in [(f, s) for f in (0.3, 0.9) for s in (1, 2)]:
        path, second = target("two.ome.zarr"), []
        writer = servermanager.writers.OMEZarrWriter(
            Input=volume(values), FileName=path, MemoryLimit=0.0)
        own = writer.GetClientSideObject()

        def begin_second(*_):
            if own.GetProgress() >= fraction and not second:
                second.append(written(volume(other, spacing=(spacing,) * 3), path, MemoryLimit=0.0))
        own.AddObserver("ProgressEvent", begin_second)
        with messages():
            writer.UpdatePipeline()
        writer.SMProxy.UpdatePropertyInformation()
        problem = writer.GetPropertyValue("Problem")
        assert "is being written by another program" in problem, (fraction, spacing, problem)
        assert second[0][1] == "", second
        assert (array_of(path, "0") == other).all()
        assert (array_of(path, "1") == mean_of(other)).all()


def test_what_is_refused():
    source = volume(zarr_files.values_of((3, 4, 5), "int16"))
    path = fresh("taken.ome.zarr")
    with open(path + "/mine.txt", "w", encoding="utf-8") as file:
        file.write("mine")
    _, problem, _ = written(source, path)
    assert "not empty" in problem and os.listdir(path) == ["mine.txt"], problem
    path = good(source)
    _, problem, _ = written(source, path)
    assert "not empty" in problem, problem
    _, problem, _ = written(source, "/proc/no/such.zarr")
    assert "cannot be written" in problem, problem
    _, problem, _ = written(source, target(), PointArray="Other")
    assert "Other" in problem, problem


def test_save_data():
    values = zarr_files.values_of((5, 6, 7), "uint8")
    path = target("saved.ome.zarr")
    simple.SaveData(path, proxy=volume(values))
    assert (array_of(path, "0") == values).all()


run_tests(globals())
