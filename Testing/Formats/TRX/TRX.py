# SPDX-License-Identifier: BSD-3-Clause
# Proves that streamlines of TRX open as numpy wrote them, stored, deflated and as a folder, that
# tracts are written, bent, as nibabel and zipfile read them, with their numbers and groups, and
# that damaged files end in one sentence.
import gzip
import io
import json
import os
import shutil
import struct
import zipfile

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, data, load_plugin, messages, output, run_tests,
                                scratch, volume)
from surface_files import lines_of, points_of, read_by, refusal_by, volumes, write_tracts
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import simple  # noqa: E402

RANDOM = numpy.random.default_rng(7)
LINES = [RANDOM.uniform(-80, 80, (count, 3)).astype(numpy.float32) for count in (5, 1, 12, 2)]
POINTS = numpy.concatenate(LINES)
FIRSTS = numpy.array([0, 5, 6, 18, 20])
FA = RANDOM.uniform(size=20).astype(numpy.float16)
COLOR = RANDOM.integers(0, 255, (20, 3)).astype(numpy.uint8)
CODES = numpy.array((2 ** 53 + 1, -7, 8, 9), numpy.int64)


def parts(**changes):
    """The files of a TRX as bytes by their paths; None leaves one out."""
    header = {"DIMENSIONS": [10, 20, 30], "VOXEL_TO_RASMM": numpy.eye(4).tolist(),
              "NB_VERTICES": 20, "NB_STREAMLINES": 4}
    found = {"header.json": json.dumps(header).encode(),
             "positions.3.float32": POINTS.tobytes(),
             "offsets.uint64": FIRSTS.astype("<u8").tobytes(),
             "dpv/fa.float16": FA.tobytes(), "dpv/color.3.uint8": COLOR.tobytes(),
             "dps/code.int64": CODES.tobytes(),
             "groups/CST_left.uint32": numpy.array((0, 2), "<u4").tobytes()}
    found.update(changes)
    return {name: bytes_ for name, bytes_ in found.items() if bytes_ is not None}


def write_zip(name, files, method=zipfile.ZIP_STORED):
    with zipfile.ZipFile(scratch(name), "w", method) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
    return scratch(name)


def write_folder(name, files):
    shutil.rmtree(scratch(name), ignore_errors=True)
    for path, content in files.items():
        os.makedirs(os.path.dirname(os.path.join(scratch(name), path)), exist_ok=True)
        with open(os.path.join(scratch(name), path), "wb") as file:
            file.write(content)
    return scratch(name)


def read(name, words=()):
    return read_by(simple.TractReader, name, words)


def refusal(name):
    return refusal_by(simple.TractReader, name)


def assert_lines(found, expected, most=0.0):
    lines = lines_of(found)
    assert [len(line) for line in lines] == [len(line) for line in expected]
    for ours, theirs in zip(lines, expected):
        assert numpy.abs(ours - theirs).max() <= most, (ours, theirs)


def array(found, name, of_points=True):
    return vtk_to_numpy((found.GetPointData() if of_points else found.GetCellData()).GetArray(name))


def test_all_forms_of_a_trx_open_alike():
    older = {"offsets.uint64": None, "offsets.uint32": FIRSTS[:4].astype("<u4").tobytes()}
    for name in (write_zip("a.trx", parts()), write_zip("b.trx", parts(), zipfile.ZIP_DEFLATED),
                 write_folder("c.trx", parts()), write_zip("d.trx", parts(**older)),
                 write_zip("e.trx", parts(**{"positions.3.float32": None, "positions.3.float64":
                                             POINTS.astype(float).tobytes()}))):
        found = read(name)
        assert_lines(found, LINES)
        assert found.GetFieldData().GetAbstractArray("WorldAxes").GetValue(0) == "RAS"
        assert numpy.array_equal(array(found, "fa"), FA.astype(numpy.float32))
        assert numpy.array_equal(array(found, "color"), COLOR)
        assert numpy.array_equal(array(found, "code", False), CODES)
        assert list(array(found, "groups/CST_left", False)) == [1, 0, 1, 0]
    halves = POINTS.astype(numpy.float16)
    found = read(write_zip("f.trx", parts(**{"positions.3.float32": None,
                                             "positions.3.float16": halves.tobytes()})))
    assert_lines(found, numpy.split(halves.astype(numpy.float32), FIRSTS[1:-1]))


def test_streamlines_without_points_leave_their_numbers_too():
    firsts = numpy.array([0, 5, 5, 18, 20]).astype("<u8").tobytes()
    found = read(write_zip("empty.trx", parts(**{"offsets.uint64": firsts})),
                 ["1 streamline without points"])
    assert [len(line) for line in lines_of(found)] == [5, 13, 2]
    assert list(array(found, "code", False)) == list(CODES[[0, 2, 3]])
    assert list(array(found, "groups/CST_left", False)) == [1, 1, 0]
    read(write_zip("dpg.trx", parts(**{"dpg/CST_left/mean.float32": bytes(4)})),
         ["1 array of whole groups"])


def test_packed_tracts_open():
    for ending in (".trk", ".tck"):
        name = write_tracts(scratch("plain" + ending), LINES, next(volumes()))
        with open(name, "rb") as file, gzip.open(scratch("packed" + ending + ".gz"), "wb") as to:
            to.write(file.read())
        packed = scratch("packed" + ending + ".gz")
        assert_lines(read(packed), lines_of(read(name)))
        assert simple.OpenDataFile(packed).GetXMLName() == "TractReader"
        with open(packed, "rb") as file:
            short = file.read()[:-20]
        with open(packed, "wb") as file:
            file.write(short)
        assert_says(refusal(packed), "cannot be unpacked to its end")


def written(source, name, words=(), **options):
    writer = simple.servermanager.writers.TractWriter(Input=source, FileName=name, **options)
    with messages() as heard:
        writer.UpdatePipeline()
    problem = writer.SMProxy.GetProperty("Problem")
    writer.SMProxy.UpdatePropertyInformation()
    assert problem.GetElement(0) == "", problem.GetElement(0)
    for word in words:
        assert word in heard.text, (word, heard.text)
    return name


def test_written_tracts_are_read_outside():
    source = simple.TractReader(FileName=write_zip("out.trx", parts()))
    image = list(volumes())[1]
    nibabel.save(image, scratch("made_in.mgz"))
    for options in ({}, {"Volume": scratch("made_in.mgz")}):
        name = written(source, scratch("out.trk"), ["float32, which rounds some"], **options)
        judged = nibabel.streamlines.load(name)
        assert numpy.abs(numpy.concatenate(list(judged.streamlines)) - POINTS).max() < 1e-3
        assert [len(line) for line in judged.streamlines] == [len(line) for line in LINES]
        tractogram = judged.tractogram
        fa = numpy.concatenate(list(tractogram.data_per_point["fa"]))[:, 0]
        color = numpy.concatenate(list(tractogram.data_per_point["color"]))
        assert numpy.array_equal(fa, FA.astype(numpy.float32)) and numpy.array_equal(color, COLOR)
        assert list(tractogram.data_per_streamline["groups/CST_left"][:, 0]) == [1, 0, 1, 0]
        assert_lines(read(name), LINES, 1e-3)
    if_named = nibabel.streamlines.load(name).header
    assert numpy.abs(if_named["voxel_to_rasmm"] - image.affine).max() < 1e-4
    assert tuple(if_named["dimensions"]) == image.shape
    name = written(source, scratch("out.tck"), ["leaves out color, fa, code, groups/CST_left"])
    judged = list(nibabel.streamlines.load(name).streamlines)
    assert all(numpy.array_equal(one, other) for one, other in zip(judged, LINES, strict=True))
    name = written(source, scratch("again.trx"))
    with zipfile.ZipFile(name) as archive:
        assert archive.testzip() is None
        found = {path: archive.read(path) for path in archive.namelist()}
    header = json.loads(found.pop("header.json"))
    assert header["NB_VERTICES"] == 20 and header["NB_STREAMLINES"] == 4
    expected = parts()
    del expected["header.json"], expected["dpv/fa.float16"]
    expected["dpv/fa.float32"] = FA.astype("<f4").tobytes()
    assert found == expected, found.keys()


def test_bent_tracts_are_written_bent():
    lines = [RANDOM.uniform(4, 28, (20, 3)) for _ in range(5)]
    bent = simple.FreeFormDeformation(Input=volume(ball()), Strokes=brainshift.stamp(
        (16, 16, 16), (16, 16, 0), 3.0, major=14.0, minor=10.0))
    source = simple.TractReader(
        FileName=write_tracts(scratch("rest.trk"), lines, list(volumes())[1]))
    moved = simple.DeformGeometry(Input=source, Deformation=bent)
    expected = brainshift.deformed_from_rest(bent, points_of(output(source)))
    assert numpy.abs(expected - numpy.concatenate(lines)).max() > 1.0
    for ending in (".trk", ".tck", ".trx"):
        found = read(written(moved, scratch("moved" + ending)))
        assert numpy.abs(points_of(found) - expected).max() < 1e-3, ending


def test_real_tracts_survive_each_format():
    """300 streamlines of DIPY, and nibabel's in LPS."""
    for name in ("tracks300.trk", "standard.LPS.trk"):
        source = simple.TractReader(FileName=data("tracts", name))
        right = list(nibabel.streamlines.load(data("tracts", name)).streamlines)
        for ending in (".trk", ".tck", ".trx"):
            found = read(written(source, scratch("real" + ending)))
            assert_lines(found, right, 1e-3)


def test_writers_say_what_cannot_be():
    source = simple.TractReader(FileName=write_zip("out.trx", parts()))
    for name, input_, words in ((scratch("no.vtk"), source, "must be one of"),
                                (scratch("no.trk"), simple.Sphere(), "all must be lines"),
                                (scratch("none/no.trk"), source, "cannot be written")):
        writer = simple.servermanager.writers.TractWriter(Input=input_, FileName=name)
        with messages() as heard:
            writer.UpdatePipeline()
        assert words in heard.text, (words, heard.text)
        assert not os.path.exists(name)
    # A reader that failed has nothing to write: what is there stays.
    unread = simple.TractReader(FileName=write_zip("unread.trx", parts(**{"header.json": b"{"})))
    unread.UpdatePipeline()
    name = write_zip("kept.trx", parts())
    with open(name, "rb") as file:
        kept = file.read()
    writer = simple.servermanager.writers.TractWriter(Input=unread, FileName=name)
    with messages() as heard:
        writer.UpdatePipeline()
    assert_says(heard.text, "its input has no streamlines")
    with open(name, "rb") as file:
        assert file.read() == kept


def test_damaged_trx_files_end_in_one_sentence():
    short = {"header.json": json.dumps({"NB_VERTICES": 20}).encode()}
    far = POINTS.copy()
    far[3, 1] = numpy.nan

    def offsets(*numbers):
        return {"offsets.uint64": numpy.array(numbers, "<u8").tobytes()}
    for change, words in (
            ({"header.json": None}, "has no header.json"),
            ({"header.json": b"{"}, "no JSON"), (short, "NB_STREAMLINES"),
            ({"positions.3.float32": None}, "has no positions"),
            ({"positions.3.float32": POINTS[:-1].tobytes()}, "has 19 positions"),
            ({"positions.3.float32": POINTS.tobytes()[:-1]}, "no multiple of 12"),
            ({"positions.3.float32": far.tobytes()}, "a coordinate of nan mm"),
            (offsets(0, 5, 6), "has 3 offsets"), (offsets(0, 5, 4, 18, 20), "from point 5 to 4"),
            (offsets(0, 5, 6, 18, 21), "to 21 of 20"), (offsets(1, 5, 6, 18, 20), "from point 1"),
            (offsets(0, 5, 6, 18, 19), "to 19 of 20"),
            ({"dpv/fa.float16": FA[:-1].tobytes()}, "has 19 tuples in dpv/fa"),
            ({"dps/code.int64": CODES[:-1].tobytes()}, "has 3 tuples in dps/code"),
            ({"groups/CST_left.uint32": numpy.array((4,), "<u4").tobytes()}, "the streamline 4"),
            ({"dpv/odd.complex64": bytes(8)}, "of the type complex64")):
        assert_says(refusal(write_zip("bad.trx", parts(**change))), words)
    with open(write_zip("bad.trx", parts(), zipfile.ZIP_DEFLATED), "rb") as file:
        good = file.read()

    def put(place, kind, number, content=good):
        changed = bytearray(content)
        struct.pack_into(kind, changed, place, number)
        return bytes(changed)
    entry = good.index(b"PK\1\2")
    for content, words in ((good[:-30], "no directory at its end"),
                           (good[:200], "no directory at its end"),
                           (put(entry + 8, "<H", 1), "encrypted"),
                           (put(entry + 10, "<H", 12), "packed by the method 12"),
                           (put(entry + 24, "<I", 2 ** 31), "which cannot be"),
                           (put(entry + 16, "<I", 1), "its checksum in the zip file is another"),
                           (put(entry + 42, "<I", 7), "not where the zip file says"),
                           (put(entry, "<I", 0), "something else than entries")):
        with open(scratch("bad.trx"), "wb") as file:
            file.write(content)
        assert_says(refusal(scratch("bad.trx")), words)
    again = io.BytesIO()
    with zipfile.ZipFile(again, "w") as archive:
        for path, content in parts().items():
            archive.writestr(path, content)
        archive.writestr("offsets.uint32", bytes(20))
    with open(scratch("bad.trx"), "wb") as file:
        file.write(again.getvalue())
    assert_says(refusal(scratch("bad.trx")), "array offsets twice")


def test_files_of_trx_python_open():
    """Stored and deflated, offsets of 4 bytes, and positions of float16, which hold 1/512 mm."""
    random = numpy.random.default_rng(43)
    counts = (3, 1, 5, 2)
    lines = [(0, 0, 5) + numpy.cumsum(random.normal(0, 1.5, (n, 3)), 0) for n in counts]
    fa = numpy.concatenate([random.uniform(0, 1, (count, 1)) for count in counts]).ravel()
    weight = random.uniform(0, 1, (4, 1)).ravel()
    color = random.integers(0, 255, (4, 3))
    for kind, most in (("float32", 1e-6), ("float16", 1 / 512)):
        shown = read_by(simple.TractReader, data("other-writers", f"trx_python_{kind}.trx"),
                        ["1 array of whole groups (dpg); left out"])
        away = numpy.abs(points_of(shown) - numpy.concatenate(lines)).max()
        assert away <= most and [len(line) for line in lines_of(shown)] == list(counts), away
        cells = {name: vtk_to_numpy(shown.GetCellData().GetArray(name))
                 for name in ("weight", "color", "groups/CST_left", "groups/all")}
        assert numpy.abs(cells["weight"] - weight).max() < 1e-7
        assert (cells["color"] == color).all()
        assert list(cells["groups/CST_left"]) == [1, 0, 1, 0] and cells["groups/all"].all()
        found = vtk_to_numpy(shown.GetPointData().GetArray("fa"))
        assert (found == fa.astype(numpy.float16)).all()


run_tests(globals())
