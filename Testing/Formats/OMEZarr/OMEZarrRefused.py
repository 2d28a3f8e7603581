# SPDX-License-Identifier: BSD-3-Clause
# Proves that spoiled OME-Zarr stores are refused with a sentence that names what is wrong, at once
# and without much memory; none leads out of its folder.
import json
import os
import resource
import shutil
import struct
import time
import zipfile

import crc32c
import numcodecs
import numpy
import zarr
import zarr_files
from brainshift_testing import load_plugin, run_tests, scratch
from zarr_files import fresh, level, made, put, refused, values_of

load_plugin()

SHAPE = (6, 5, 7)
MOST_SECONDS, MOST_KB = 5.0, 400000


def remade(path, name, *changes):
    """A file of metadata with other values: (keys, value) each."""
    with open(os.path.join(path, name), encoding="utf-8") as file:
        content = json.load(file)
    for keys, value in changes:
        inner = content
        for key in keys[:-1]:
            inner = inner[key]
        inner[keys[-1]] = value
    put(path, name, content)
    return path


def says(path, *words, **properties):
    """The reader refuses the store with these words, soon, and takes little memory."""
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    start = time.process_time()
    text = refused(path, **properties)
    assert time.process_time() - start < MOST_SECONDS, (words, text)
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < MOST_KB, (words, grown)
    for word in (os.path.basename(path), *words):
        assert word in text, (word, text)


def array_says(word, *changes, version=2):
    name = ".zarray" if version == 2 else "zarr.json"
    path = made(values_of(SHAPE, "uint16"), version=version, codecs=None if version == 2 else ())
    remade(path, "0/" + name, *changes)
    says(path, word)


def test_sizes():
    for value in (0, -1, 2 ** 54, 2 ** 70, 1.5, "4", None, [4]):
        array_says("has the chunks", (("chunks",), [4, value, 4]))
        array_says("has the shape", (("shape",), [4, value, 4]))
        array_says("has the chunk_shape", (("chunk_grid", "configuration", "chunk_shape"),
                                           [4, value, 4]), version=3)
    for value in ([], [4], [4, 4], [4] * 4, [4] * 40, "444", None, {}):
        array_says("has the chunks", (("chunks",), value))
    array_says("of 2 axes; the image has 3", (("shape",), [4, 4]), (("chunks",), [4, 4]))
    array_says("has chunks of", (("chunks",), [4, 2 ** 40, 4]))
    array_says("has chunks of", (("chunks",), [2 ** 20] * 3))
    array_says("numbers along an axis", (("shape",), [4, 2 ** 31, 4]))
    array_says("memory", (("shape",), [2 ** 31 - 1] * 3))
    array_says("chunks where it is read", (("shape",), [400, 400, 400]), (("chunks",), [1, 1, 1]))


def test_types():
    for kind in ("<c8", "<f2", "|S4", "<M8[ns]", "u2", "<u3", [["a", "<u2"]], None, 3, ""):
        array_says("data type", (("dtype",), kind))
    array_says("order of bytes", (("dtype",), "|u2"))
    for kind in ("complex64", "float16", "r16", None, {"name": "uint16"}):
        array_says("data type", (("data_type",), kind), version=3)
    for fill in (70000, -1, 0.5, "NaN", [1], {}, 2 ** 64, "0x0000"):
        array_says("fill_value", (("fill_value",), fill))
    array_says("has no fill_value", (("fill_value",), None), version=3)
    array_says("it must have 160", (("dtype",), "<u4"), (("chunks",), [4, 5, 2]))


def test_what_is_not_known():
    array_says("'bz2'", (("compressor",), {"id": "bz2"}))
    array_says("codec", (("compressor",), {"id": 4}))
    array_says("has the filters", (("filters",), [{"id": "delta"}]))
    array_says("has the order", (("order",), "K"))
    array_says("dimension_separator", (("dimension_separator",), "-"))
    array_says("zarr_format", (("zarr_format",), 1))
    third = (("chunk_grid", {"name": "rectilinear"}, "rectilinear"),
             ("chunk_key_encoding", {"name": "fanout"}, "fanout"),
             ("codecs", [], "one of them must be bytes"), ("codecs", None, "must be bytes"),
             ("codecs", ["bytes", "zfp"], "endian"),
             ("codecs", [{"name": "vlen-utf8"}], "vlen-utf8"),
             ("codecs", [{"name": "bytes", "configuration": {"endian": "middle"}}], "endian"),
             ("node_type", "tree", "node_type"), ("storage_transformers", ["x"], "transformers"),
             ("new_feature", {"name": "x"}, "new_feature"))
    for key, value, word in third:
        array_says(word, ((key,), value), version=3)
    little = {"name": "bytes", "configuration": {"endian": "little"}}
    for codecs, word in (([little, "zstd", "gzip"], "once more"), ([little, "zfp"], "zfp"),
                         ([{"name": "transpose", "configuration": {"order": [0, 1, 1]}}, little],
                          "each axis once"),
                         ([{"name": "transpose", "configuration": {"order": [0, 1, 3]}}, little],
                          "each axis once"),
                         ([{"name": "transpose", "configuration": {"order": "F"}}, little],
                          "transpose order"),
                         ([little, {"name": "gzip", "configuration": "big"}], "must be an object")):
        array_says(word, (("codecs",), codecs), version=3)
    array_says("must be an object", (("chunk_key_encoding", "configuration"), 3), version=3)


def group_says(word, *changes):
    path = remade(made(values_of(SHAPE, "uint16"), version=2), ".zattrs", *(
        (("multiscales", 0, *keys), value) for keys, value in changes))
    says(path, word)


def test_metadata_of_ome():
    scale = ("datasets", 0, "coordinateTransformations")
    for value in ([], None, [{"type": "translation", "translation": [1, 2, 3]}]):
        group_says("has no scale", (scale, value))
    for step in ([1, 2], [1, 2, 3, 4], [1, 2, "3"], [1, 2, None], [1, 2, 1e400], "123", None):
        group_says("finite numbers", (scale, [{"type": "scale", "scale": step}]))
    for step in ([1, 0, 1], [1, 1e-12, 1], [1, 1, 1e12]):
        group_says("cannot be placed", (scale, [{"type": "scale", "scale": step}]))
    for kind in ("rotation", "affine", "", None):
        group_says("scale, translation and identity", (scale, [{"type": kind}]))
    for other in ("../other", {}, 3, False):
        group_says("must be a list", (scale, other))
        group_says("must be a list", (("coordinateTransformations",), other))
    group_says("may have 16", (scale, [{"type": "identity"}] * 17))
    for version in ("0.3", "0.5", "0.6", 4, ""):
        group_says("OME-Zarr version", (("version",), version))
    for axes in (None, [], {}, "zyx", [{"name": "x"}], [{"name": n} for n in "abcdef"]):
        group_says("2 to 5", (("axes",), axes))
    group_says("must have a name", (("axes",), ["z", "y", "x"]))
    space = zarr_files.SPACE
    group_says("must have 2 or 3", (("axes",), [zarr_files.TIME, zarr_files.CHANNEL, space[0]]))
    group_says("two axes of time", (("axes",), [zarr_files.TIME, zarr_files.TIME, *space[:2]]))
    group_says("numbers along the axis", (("axes",), [{"name": "q", "type": "angle"}, *space[:2]]))
    for datasets in (None, [], {}, [{"path": "0"}] * 65):
        group_says("datasets", (("datasets",), datasets))


def test_own_metadata():
    for own, word in (({"world": "LPS"}, "the world"), ({"world": 3}, "the world"),
                      ({"direction": 3}, "three rows"), ({"direction": [[1, 0, 0]]}, "three rows"),
                      ({"direction": [[1, 0, 0], [0, 1, 0], [0, 0]]}, "finite numbers"),
                      ({"direction": [[1, 0, 0], [0, 1, 0], [0, 0, None]]}, "finite numbers"),
                      ({"direction": [[1, 0, 0], [0, 1, 0], [0, 0, 2]]}, "no rotation"),
                      ({"direction": [[0, 0, 0]] * 3}, "no rotation")):
        path = made(values_of(SHAPE, "uint16"), version=2)
        remade(path, ".zattrs", (("brainshift",), own))
        says(path, word)
    path = made(values_of(SHAPE, "uint16"), version=2)
    put(path, "brainshift-unfinished.json", {})
    says(path, "not written to its end")


def test_paths_stay_in_the_store():
    outside = fresh("outside.zarr")
    zarr_files.write_array(outside, "0", values_of(SHAPE, "uint16"), 2)
    for path in ("../outside.zarr/0", "0/../../outside.zarr/0", outside + "/0", "", "/0", "0/",
                 "./0", "0//", "0\0", None, 7):
        group_says("stay in the store", (("datasets", 0, "path"), path))
    group_says("has no array", (("datasets", 0, "path"), "nothing"))
    path = made(values_of(SHAPE, "uint16"), version=2)
    put(path, "labels/.zattrs", {"labels": ["../../outside.zarr"]})
    says(path, "stay in the store")


def test_files_that_are_no_metadata():
    for text in ("", "{", "[]", "3", '{"a": }', "\0", '{"a": "\xff"}', '{"zarr_format": 1e999}',
                 "[" * 10000, '{"a":' * 10000, "[" * 10000 + "]" * 10000):
        path = fresh()
        put(path, ".zattrs", text)
        says(path)
        path = made(values_of(SHAPE, "uint16"), version=2)
        put(path, "0/.zarray", text)
        says(path)
    says(fresh(), "no metadata of zarr")
    says(scratch("is_not_there.zarr"), "neither a folder")
    path = made(values_of(SHAPE, "uint16"), version=2)
    says(path + "/0", "is an array")
    for key in ("plate", "well"):
        put(path, ".zattrs", {key: {}})
        says(path, "open one of its images")


def spoil(path, change):
    """Changes the bytes of the first chunk."""
    with open(path, "rb") as file:
        content = file.read()
    with open(path, "wb") as file:
        file.write(change(content))


def test_chunks():
    """Cut off, too long, of other sizes; the sentence names the chunk."""
    codecs = {"none": None, "zstd": numcodecs.Zstd(), "zlib": numcodecs.Zlib(),
              "gzip": numcodecs.GZip(), "lz4": numcodecs.LZ4(), "blosc": numcodecs.Blosc("lz4")}
    for name, codec in codecs.items():
        changes = [lambda c: c[:-1], lambda c: c[:len(c) // 2], lambda c: c[:3], lambda c: b"",
                   lambda c: c + b"\0", lambda c: b"\xff" * len(c), lambda c: c + c]
        for change in changes[:-2] if name == "none" else changes:
            path = made(values_of(SHAPE, "uint16"), version=2, codecs=codec)
            spoil(os.path.join(path, "0", "0.0.0"), change)
            says(path, "chunk '0/0.0.0'")
        path = made(values_of(SHAPE, "uint16"), version=2, codecs=codec)
        large = numpy.zeros(10 ** 8, "uint8")
        with open(os.path.join(path, "0", "0.0.0"), "wb") as file:
            file.write(large.tobytes()[:10 ** 7] if codec is None else codec.encode(large))
        says(path, "chunk '0/0.0.0'")
    for size in (0, 2 ** 31 - 1, 2 ** 32 - 1):
        path = made(values_of(SHAPE, "uint16"), version=2, codecs=codecs["blosc"])
        spoil(os.path.join(path, "0", "0.0.0"),
              lambda c, size=size: c[:4] + struct.pack("<I", size) + c[8:])
        says(path, "chunk '0/0.0.0'")
    words = {"version": 3, "codecs": (zarr.codecs.ZstdCodec(), zarr.codecs.Crc32cCodec())}
    path = made(values_of(SHAPE, "uint16"), **words)
    spoil(os.path.join(path, "0", "c/0/0/0"), lambda c: c[:-1] + bytes([c[-1] ^ 1]))
    says(path, "chunk '0/c/0/0/0'", "crc32c")


def test_no_pipes_and_no_folders():
    for name in (".zattrs", "0/.zarray", "0/0.0.0"):
        for make in (os.mkfifo, os.mkdir):
            path = made(values_of(SHAPE, "uint16"), version=2)
            os.remove(os.path.join(path, name))
            make(os.path.join(path, name))
            says(path, "plain file")


def test_shards():
    def shard():
        path = made(values_of(SHAPE, "uint16"), chunks=(2, 2, 2), shards=(4, 4, 4), codecs=())
        return path, os.path.join(path, "0", "c/0/0/0")
    for change in (lambda c: c[:100], lambda c: b"", lambda c: c + b"\0",
                   lambda c: c[:-5] + bytes([c[-5] ^ 1]) + c[-4:]):
        path, file = shard()
        spoil(file, change)
        says(path, "shard '0/c/0/0/0'")
    for entry in ((2 ** 63, 16), (0, 2 ** 63), (0, 2 ** 64 - 1), (2 ** 64 - 1, 16), (0, 15),
                  (0, 17)):
        path, file = shard()
        index = struct.pack("<QQ", *entry)

        def change(content, index=index):
            table = index + content[-132 + 16:-4]
            return content[:-132] + table + struct.pack("<I", crc32c.crc32c(table))
        spoil(file, change)
        says(path, "chunk '0/c/0/0/0' (0, 0, 0)")
    path, _ = shard()
    for value, word in (([3, 2, 2], "multiple"), ([0, 2, 2], "chunk_shape"), (None, "chunk_shape")):
        remade(path, "0/zarr.json", (("codecs", 0, "configuration", "chunk_shape"), value))
        says(path, word)


def test_zip_files():
    path = made(values_of(SHAPE, "uint16"), version=2)
    for method in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        with open(zarr_files.zipped(path, "whole.zip", method), "rb") as file:
            whole = file.read()
        end = whole.rfind(b"PK\5\6")
        first = whole.find(b"PK\1\2")
        changed = [b"PK", whole[:50], whole[:end], whole[:-10], whole[:end + 12] + b"\xff" * 8,
                   whole[:end + 16] + b"\0" * 6, whole[:first] + b"PK\1\3" + whole[first + 4:]]
        for i in range(first, end):  # each byte of the directory
            changed.append(whole[:i] + bytes([whole[i] ^ 0x55]) + whole[i + 1:])
        kept = 0
        for content in changed:
            with open(scratch("spoiled.zip"), "wb") as file:
                file.write(content)
            start = time.process_time()
            kept += not outcome(scratch("spoiled.zip"))
            assert time.process_time() - start < MOST_SECONDS
        print(f"{len(changed)} spoiled zip files, {kept} read as before")


def outcome(path):
    """Whether the store is refused; what is read must be right."""
    from brainshift_testing import messages, output
    from paraview import simple
    with messages() as said:
        source = simple.OMEZarrReader(FileName=path)
        image = output(source)
    if image.GetNumberOfPoints() == 0:
        assert "ERROR" in said.text, path
    else:
        # A chunk whose name is another is a chunk that is not there.
        found, good = zarr_files.numbers_of(image), values_of(SHAPE, "uint16")
        assert found.shape == good.shape and ((found == good) | (found == 0)).all()
    simple.Delete(source)
    return image.GetNumberOfPoints() == 0


def test_times():
    path = fresh()
    zarr_files.write_array(path, "0", numpy.zeros((1, 2, 2, 2), "uint8"), 2)
    remade(path, "0/.zarray", (("shape",), [70000, 2, 2, 2]))
    zarr_files.describe(path, [level("0", [1] * 4)], [zarr_files.TIME, *zarr_files.SPACE], 2)
    says(path, "may have up to 65536")


run_tests(globals())
shutil.rmtree(scratch("image.zarr"))
