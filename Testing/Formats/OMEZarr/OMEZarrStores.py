# SPDX-License-Identifier: BSD-3-Clause
# Proves that the numbers of OME-Zarr stores are those that zarr-python reads: every codec, type,
# order of bytes and axes, shards, missing chunks, parts of an extent, folders and zip files.
import itertools
import os
import zipfile

import numpy
import zarr
import zarr_files
from brainshift_testing import load_plugin, messages, run_tests
from zarr_files import OF_VERSION_2, OF_VERSION_3, TYPES, made, read, refused, values_of

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

SHAPE = (7, 6, 9)  # not a multiple of the chunks


def assert_same(path, **properties):
    """The numbers of a store are those that zarr-python reads, to the bit."""
    expected = zarr.open_array(os.path.join(path, "0"), mode="r")[...]
    found, _, source = read(path, **properties)
    assert found.shape == expected.shape, (found.shape, expected.shape)
    assert (found == expected).all(), path
    if expected.dtype != bool:
        assert found.dtype == expected.dtype.newbyteorder("="), (found.dtype, expected.dtype)
    simple.Delete(source)
    return expected


def test_codecs():
    for version, codecs in ((2, OF_VERSION_2), (3, OF_VERSION_3)):
        for codec in codecs.values():
            assert_same(made(values_of(SHAPE, "uint16"), version=version, codecs=codec))
        print(f"version {version}: {len(codecs)} codecs")


def test_types_and_orders():
    count = 0
    for kind, version, order, endian in itertools.product(TYPES, (2, 3), "CF", "<>"):
        values = values_of(SHAPE, kind)
        path = made(values.astype(values.dtype.newbyteorder(endian)), version=version, order=order)
        assert_same(path)
        count += 1
    print(f"{count} types, orders of axes and of bytes")


def test_keys_of_chunks():
    for version, name, separator in ((2, "v2", "."), (2, "v2", "/"), (3, "v2", "."),
                                     (3, "v2", "/"), (3, "default", "."), (3, "default", "/")):
        assert_same(made(values_of(SHAPE, "int16"), version=version,
                         chunk_key_encoding={"name": name, "separator": separator}))


def test_shards():
    for codecs in OF_VERSION_3.values():
        assert_same(made(values_of(SHAPE, "int16"), chunks=(2, 3, 2), shards=(4, 6, 6),
                         codecs=codecs))
    turned = [zarr.codecs.TransposeCodec(order=(2, 0, 1))]
    assert_same(made(values_of(SHAPE, "int16"), chunks=(2, 3, 2), shards=(4, 6, 6),
                     filters=turned))
    sharding = zarr.codecs.ShardingCodec(
        chunk_shape=(2, 3, 2), index_location="start", codecs=[zarr.codecs.BytesCodec()],
        index_codecs=[zarr.codecs.BytesCodec(endian="big")])
    assert_same(made(values_of(SHAPE, "int16"), chunks=(4, 6, 6), serializer=sharding))


def test_missing_chunks_have_the_fill_value():
    fills = {"uint8": 7, "int64": -2 ** 63, "uint64": 2 ** 64 - 1, "float32": 0.1,
             "float64": -numpy.inf, "bool": True}
    for (kind, fill), version in itertools.product(fills.items(), (2, 3)):
        values = numpy.full(SHAPE, fill, kind)
        values[0, 0, 0] = 1
        path = made(values, version=version, fill_value=fill)
        files = sum(len(names) for _, _, names in os.walk(os.path.join(path, "0")))
        assert files < 4, "zarr-python writes chunks of nothing but the fill value"
        assert_same(path)
    for version, shards in ((2, None), (3, None), (3, (8, 8, 8))):
        words = {"shards": shards} if shards else {}
        values = numpy.full(SHAPE, numpy.nan, "float32")
        values[0, 0, 0] = 1
        path = made(values, version=version, fill_value=numpy.nan, **words)
        found, _, _ = read(path)
        assert numpy.isnan(found).sum() == found.size - 1 and found[0, 0, 0] == 1


def test_parts_of_an_extent():
    """Any part is the crop of the whole, and only its chunks are read: all others are damaged."""
    values = values_of((17, 13, 19), "uint16")
    dice = numpy.random.default_rng(8)
    for version, shards in ((2, None), (3, None), (3, (8, 8, 8))):
        words = {"shards": shards} if shards else {}
        path = made(values, version=version, chunks=(4, 4, 4), **words)
        whole = read(path)[0]
        assert (whole == values).all()
        for _ in range(40):
            first = [int(dice.integers(0, side)) for side in reversed(values.shape)]
            last = [int(dice.integers(begin, side))
                    for begin, side in zip(first, reversed(values.shape))]
            extent = [number for pair in zip(first, last) for number in pair]
            _, _, source = read(path)
            reader = source.GetClientSideObject()
            reader.Modified()
            reader.UpdateExtent(extent)
            image = reader.GetOutputDataObject(0)
            assert list(image.GetExtent()) == extent, (image.GetExtent(), extent)
            crop = tuple(slice(begin, end + 1) for begin, end in
                         zip(reversed(first), reversed(last)))
            assert (zarr_files.numbers_of(image) == values[crop]).all(), extent
            simple.Delete(source)


def test_only_the_chunks_of_a_part_are_read():
    path = made(values_of((8, 8, 8), "uint16"), chunks=(4, 4, 4), version=2)
    for folder, _, names in os.walk(os.path.join(path, "0")):
        for name in names:
            if name not in (".zarray", ".zattrs", "0.0.0"):
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(b"no chunk")
    reader = simple.OMEZarrReader(FileName=path).GetClientSideObject()
    reader.UpdateInformation()
    reader.UpdateExtent([0, 3, 0, 3, 0, 3])
    assert reader.GetOutput().GetNumberOfPoints() == 64
    assert "chunk '0/" in refused(path)


def test_reading_can_be_stopped():
    path = made(values_of((24, 24, 24), "uint16"), chunks=(2, 2, 2))
    reader = simple.OMEZarrReader(FileName=path).GetClientSideObject()
    reader.UpdateInformation()
    seen = []

    def stop(caller, _):
        seen.append(caller.GetProgress())
        if seen[-1] > 0.3:
            caller.SetAbortExecute(1)
    reader.AddObserver("ProgressEvent", stop)
    with messages() as said:
        reader.Update()
    assert "was stopped" in said.text, said.text
    assert reader.GetOutput().GetNumberOfPoints() == 0
    assert seen == sorted(seen) and 0.3 < seen[-2] < 0.4, seen  # VTK adds an end


def test_times_and_channels():
    values = values_of((3, 2, 5, 6, 7), "int16")
    axes = [zarr_files.TIME, zarr_files.CHANNEL, *zarr_files.SPACE]
    for version, chunks in ((2, (1, 1, 4, 4, 4)), (3, (2, 2, 4, 4, 4))):
        path = made(values, axes=axes, version=version, chunks=chunks,
                    scale=[2.5, 1.0, 1.0, 1.0, 1.0])
        _, _, source = read(path)
        assert list(source.TimestepValues) == [0.0, 2.5, 5.0]
        for channel in (-1, 0, 1):
            source.Channel = channel
            for step in range(3):
                source.UpdatePipeline(2.5 * step)
                found = zarr_files.numbers_of(source.GetClientSideObject().GetOutputDataObject(0))
                expected = (values[step].transpose(1, 2, 3, 0) if channel < 0 else
                            values[step, channel])
                assert (found == expected).all(), (version, channel, step)
        simple.Delete(source)
    assert "Channel is 2" in refused(path, Channel=2)


def test_axes_in_other_orders():
    """Space is found by the names of its axes, wherever they are."""
    values = values_of((5, 2, 6, 7), "uint8")
    axes = [zarr_files.SPACE[2], zarr_files.CHANNEL, zarr_files.SPACE[0], zarr_files.SPACE[1]]
    found, _, _ = read(made(values, axes=axes))
    assert (found == values.transpose(2, 3, 0, 1)).all()


def test_zip_files():
    values = values_of(SHAPE, "uint16")
    for version, method, top in itertools.product(
            (2, 3), (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED), ("", "folder/image.zarr/")):
        path = made(values, version=version)
        found, _, _ = read(zarr_files.zipped(path, "image.zip", method, top))
        assert (found == values).all(), (version, method, top)
    path = made(values, chunks=(2, 3, 3), shards=(4, 6, 6))
    found, _, _ = read(zarr_files.zipped(path))
    assert (found == values).all()
    text = refused(zarr_files.zipped(path, "packed.ozx", zipfile.ZIP_DEFLATED))
    assert "without packing" in text, text


def test_file_open():
    """A folder, its metadata, and zip files open by File > Open."""
    values = values_of(SHAPE, "uint16")
    for version, metadata in ((2, ".zattrs"), (2, ".zgroup"), (3, "zarr.json")):
        path = made(values, version=version)
        for name in (path, os.path.join(path, metadata), zarr_files.zipped(path),
                     zarr_files.zipped(path, "image.zip")):
            source = simple.OpenDataFile(name)
            assert source is not None and source.GetXMLName() == "OMEZarrReader", (name, source)
            assert (zarr_files.numbers_of(zarr_files.output(source)) == values).all(), name
            simple.Delete(source)


run_tests(globals())
