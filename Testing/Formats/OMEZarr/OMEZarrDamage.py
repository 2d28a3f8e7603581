# SPDX-License-Identifier: BSD-3-Clause
# Proves that chunks that are cut off or damaged are read from the coarser level, which is said
# once for each of them, that one that is missing has the fill value where a writer may leave it
# out, and that nothing else changes.
import os
import shutil

import numpy
import zarr
import zarr_files
from brainshift_testing import load_plugin, messages, output, run_tests, volume
from zarr_files import CHANNEL, SPACE, TIME, describe, fresh, level, numbers_of, write_array

load_plugin()
from paraview import servermanager, simple  # noqa: E402 after the plugin

FINE = (12, 8, 10)
SPOILED = {"cut off": lambda content: content[:-3], "empty": lambda content: b"",
           "other bytes": lambda content: b"\xff" * len(content)}


def linear(shape, step, kind="float32"):
    """Values that are linear in the world, so that interpolation is exact."""
    z, y, x = (numpy.arange(side) * step + (step - 1) / 2 for side in shape)
    values = 3 * x[None, None, :] - 2 * y[None, :, None] + 5 * z[:, None, None] + 100
    return values.astype(kind)


def store(levels, chunks=(4, 4, 4), version=2, axes=None, steps=None, **words):
    """A store of some levels, each of voxels twice as long."""
    path = fresh("damaged.zarr")
    more = len(axes or SPACE) - 3
    datasets = []
    for i, values in enumerate(levels):
        step = (steps or [2 ** k for k in range(len(levels))])[i]
        write_array(path, str(i), values, version, (1,) * more + chunks, **words)
        datasets.append(level(str(i), [1] * more + [step] * 3,
                              [0] * more + [(step - 1) / 2] * 3))
    return describe(path, datasets, axes, version)


def spoil(path, key, change):
    with open(os.path.join(path, key), "rb") as file:
        content = file.read()
    with open(os.path.join(path, key), "wb") as file:
        file.write(change(content))


def read(path, **properties):
    with messages() as said:
        source = simple.OMEZarrReader(FileName=path, Level=0, **properties)
        image = output(source)
    return image, said.text.replace("\n", " "), source


def test_interpolated():
    """In the middle of the volume to the last digit; at its ends the last voxels are repeated."""
    values = linear(FINE, 1)
    for change in SPOILED.values():
        path = store([values, linear((6, 4, 5), 2)], codecs=zarr_files.OF_VERSION_2["zstd"])
        spoil(path, "0/1.1.1", change)
        image, said, _ = read(path)
        found = numbers_of(image)
        assert numpy.allclose(found[4:8, 4:7, 4:8], values[4:8, 4:7, 4:8], atol=1e-4)
        whole = numpy.ones(FINE, bool)
        whole[4:8, 4:8, 4:8] = False
        assert (found[whole] == values[whole]).all()
        assert said.count("cannot be read everywhere") == 1, said
        for word in ("chunk '0/1.1.1'", "level 1"):
            assert word in said, said
        assert "ERROR" not in said, said


def test_parts_of_the_extent():
    values = linear(FINE, 1)
    path = store([values, linear((6, 4, 5), 2)])
    spoil(path, "0/1.1.1", SPOILED["empty"])
    reader = simple.OMEZarrReader(FileName=path, Level=0).GetClientSideObject()
    with messages() as said:
        reader.UpdateInformation()
        reader.UpdateExtent([5, 6, 3, 6, 2, 6])
        found = numbers_of(reader.GetOutput())
        assert numpy.allclose(found, values[2:7, 3:7, 5:7], atol=1e-4)
        reader.UpdateExtent([5, 8, 2, 6, 2, 6])
    assert said.text.count("cannot be read everywhere") == 1, said.text


def test_the_next_level_that_can_be_read():
    values = linear(FINE, 1)
    path = store([values, linear((6, 4, 5), 2), linear((3, 2, 3), 4)])
    spoil(path, "0/1.0.1", SPOILED["empty"])
    for key in ("1/0.0.0", "1/0.0.1", "1/1.0.0", "1/1.0.1"):
        spoil(path, key, SPOILED["cut off"])
    image, said, _ = read(path)
    assert "level 2" in said and "level 1 are" not in said, said
    found = numbers_of(image)
    assert numpy.allclose(found[4:8, 2:4, 4:8], values[4:8, 2:4, 4:8], atol=1e-4)


def test_no_coarser_level():
    path = store([linear(FINE, 1), linear((6, 4, 5), 2)])
    spoil(path, "1/0.0.0", SPOILED["empty"])
    text = zarr_files.refused(path, Level=1)
    assert "chunk '1/0.0.0'" in text and "no coarser level" in text, text
    # a level of other channels does not count
    path = store([linear(FINE, 1)[None], linear((6, 4, 5), 2)[None].repeat(2, 0)],
                 axes=[CHANNEL, *SPACE])
    spoil(path, "0/0.1.1.1", SPOILED["empty"])
    assert "no coarser level" in zarr_files.refused(path, Level=0)


def test_a_missing_chunk_has_the_fill_value():
    values = linear(FINE, 1)
    path = store([values, linear((6, 4, 5), 2)], fill_value=7)
    os.remove(os.path.join(path, "0/1.1.1"))
    image, said, _ = read(path)
    assert (numbers_of(image)[4:8, 4:8, 4:8] == 7).all() and "everywhere" not in said


def test_labels_are_never_blended():
    random = numpy.random.default_rng(5)
    coarse = random.choice(numpy.array([0, 40, 90], "uint8"), (6, 4, 5))
    fine = coarse.repeat(2, 0).repeat(2, 1).repeat(2, 2)
    path = store([fine, coarse])
    zarr_files.describe(path, [level("0", [1] * 3, [0] * 3), level("1", [2] * 3, [0.5] * 3)],
                        None, 2, **{"image-label": {"colors": []}})
    spoil(path, "0/1.1.1", SPOILED["empty"])
    image, _, _ = read(path)
    assert (numbers_of(image) == fine).all()


def test_channels_and_shards():
    fine, coarse = linear(FINE, 1), linear((6, 4, 5), 2)
    path = store([numpy.stack([fine, fine + 1000]), numpy.stack([coarse, coarse + 1000])],
                 axes=[CHANNEL, *SPACE])
    spoil(path, "0/1.1.1.1", SPOILED["cut off"])
    image, _, _ = read(path)
    found = numbers_of(image)
    assert (found[..., 0] == fine).all()
    assert numpy.allclose(found[4:8, 4:7, 4:8, 1], fine[4:8, 4:7, 4:8] + 1000, atol=1e-3)
    path = store([fine, coarse], version=3, shards=(4, 4, 4), chunks=(2, 2, 2))
    spoil(path, "0/c/1/1/1", SPOILED["empty"])
    image, said, _ = read(path)
    assert numpy.allclose(numbers_of(image)[4:8, 4:7, 4:8], fine[4:8, 4:7, 4:8], atol=1e-4)
    assert "shard '0/c/1/1/1'" in said, said


def test_whole_numbers_are_rounded():
    fine, coarse = linear(FINE, 1, "int16"), linear((6, 4, 5), 2, "int16")
    path = store([fine, coarse])
    spoil(path, "0/1.1.1", SPOILED["empty"])
    found = numbers_of(read(path)[0])
    assert (abs(found[4:8, 4:7, 4:8] - linear(FINE, 1)[4:8, 4:7, 4:8]) <= 1.0).all()


def test_each_time_is_reported():
    """The first time and the third are damaged, the third in two chunks."""
    values = numpy.stack([linear(FINE, 1) + i for i in range(3)])
    coarse = numpy.stack([linear((6, 4, 5), 2) + i for i in range(3)])
    path = store([values, coarse], axes=[TIME, *SPACE])
    for key in ("0/0.1.1.1", "0/2.1.1.1", "0/2.0.0.0"):
        spoil(path, key, SPOILED["empty"])
    reader = simple.OMEZarrReader(FileName=path, Level=0)
    for time, key, count in ((0, "0/0.1.1.1", ""), (1, "", ""), (2, "0/2.0.0.0", "of 2 chunks"),
                             (0, "", "")):
        with messages() as said:
            reader.UpdatePipeline(time)
        assert said.text.count("everywhere") == bool(key), (time, said.text)
        assert key in said.text and count in said.text.replace("\n", " "), said.text


def test_levels_without_translation():
    path = store([linear(FINE, 1), linear((6, 4, 5), 2)])
    describe(path, [level("0", [1] * 3), level("1", [2] * 3)], None, 2)
    spoil(path, "0/1.1.1", SPOILED["empty"])
    said = read(path)[1]
    assert "level 1 has no translation" in said and "up to 0.5 mm" in said, said


def test_labels_of_64_bits():
    coarse = 2 ** 60 + numpy.arange(6 * 4 * 5).reshape(6, 4, 5)
    fine = coarse.repeat(2, 0).repeat(2, 1).repeat(2, 2)
    path = store([fine, coarse])
    spoil(path, "0/1.1.1", SPOILED["empty"])
    assert (numbers_of(read(path)[0]) == fine).all()


def test_a_missing_chunk_of_our_own_store():
    """The writer leaves out none. A copy by zarr-python has none of the fill value."""
    values = numpy.full((70, 70, 70), 8, "int16")
    values[:64, :64, 64:] = 0
    for version in ("0.4 (zarr 2)", "0.5 (zarr 3)"):
        path = fresh("own.zarr")
        servermanager.writers.OMEZarrWriter(Input=volume(values), FileName=path,
                                            Version=version).UpdatePipeline()
        first = "0/0/0/" if "zarr 2" in version else "0/c/0/0/"
        os.remove(os.path.join(path, first + "1"))
        image, said, _ = read(path)
        assert (numbers_of(image) == values).all() and "everywhere" not in said, said
        os.remove(os.path.join(path, first + "0"))
        image, said, _ = read(path)
        assert (numbers_of(image)[:60, :60, :60] == 8).all()
        assert f"chunk '{first}0' is missing" in said and "level 1 are shown" in said, said
        inside = "bricks/0/" + ("" if "zarr 2" in version else "c/") + "0/0/0/0"
        os.remove(os.path.join(path, inside))  # with the bricks it is not known what was there
        image, said, _ = read(path)
        assert (numbers_of(image)[:60, :60, :60] == 8).all() and "level 1 are shown" in said, said


def test_a_copy_of_our_own_store_that_is_zero():
    """zarr-python leaves out its chunks, and copies its bricks."""
    for version in (2, 3):
        path, copy = fresh("zero.zarr"), fresh("copy of zero.zarr")
        servermanager.writers.OMEZarrWriter(
            Input=volume(numpy.zeros((70, 70, 70), "int16")), FileName=path,
            Version=["0.4 (zarr 2)", "0.5 (zarr 3)"][version - 2]).UpdatePipeline()
        for name in (".zattrs", ".zgroup") if version == 2 else ("zarr.json",):
            shutil.copy(os.path.join(path, name), os.path.join(copy, name))
        for name in ("0", "1", "bricks/0", "bricks/1"):
            array = zarr.open_array(os.path.join(path, name), mode="r")
            write_array(copy, name, array[...], version, array.chunks, fill_value=array.fill_value)
        assert all(each in (".zarray", ".zattrs", "zarr.json")
                   for each in os.listdir(os.path.join(copy, "0"))), "all chunks are left out"
        image, said, _ = read(copy)
        assert (numbers_of(image) == 0).all() and image.GetNumberOfPoints() == 70 ** 3
        assert "everywhere" not in said, said


run_tests(globals())
