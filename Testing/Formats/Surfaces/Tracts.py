# SPDX-License-Identifier: BSD-3-Clause
# Proves that streamlines of TrackVis and MRtrix lie where nibabel puts them, with their numbers,
# that Deform Geometry moves them as the map says, that reading can be stopped, and that damaged
# files end in one sentence.
import struct

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, messages, output, run_tests,
                                scratch, volume)
from surface_files import (lines_of, points_of, read_by, refusal_by, volumes,
                           write_tracts)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402

LARGEST_MM = 1e-3
RANDOM = numpy.random.default_rng(7)
LINES = [RANDOM.uniform(-80, 80, (count, 3)).astype(numpy.float32) for count in (5, 1, 12, 2)]


def read(name, words=(), **named):
    return read_by(simple.TractReader, name, words, **named)


def refusal(name, **named):
    return refusal_by(simple.TractReader, name, **named)


def bytes_of(name):
    with open(name, "rb") as file:
        return bytearray(file.read())


def written(name, data):
    with open(scratch(name), "wb") as file:
        file.write(data)
    return scratch(name)


def assert_lines(data, expected, axes="RAS"):
    found = lines_of(data)
    assert [len(line) for line in found] == [len(line) for line in expected]
    for ours, theirs in zip(found, expected):
        assert numpy.abs(ours - theirs).max() < LARGEST_MM, (ours, theirs)
    word = data.GetFieldData().GetAbstractArray("WorldAxes")
    assert (word.GetValue(0) if word else None) == axes


def judged(name):
    return list(nibabel.streamlines.load(name).streamlines)


def swapped(data, sizes):
    """A .trk file in the other order of bytes."""
    turned = bytearray(data)
    for kind, places in sizes.items():
        for place in places:
            turned[place:place + kind] = turned[place:place + kind][::-1]
    return turned


def test_trackvis_lies_where_nibabel_puts_it():
    for image in volumes():
        name = write_tracts(scratch("a.trk"), LINES, image)
        assert numpy.abs(numpy.concatenate(judged(name)) - numpy.concatenate(LINES)).max() < 1e-3
        assert_lines(read(name), judged(name))
        # Axes that the letters turn around.
        data = bytes_of(name)
        order = bytes(data[948:951])
        for axis in range(3):
            for letters in ("RL", "AP", "SI"):
                if chr(order[axis]) in letters:
                    data[948 + axis] = ord(letters.replace(chr(order[axis]), ""))
            other = written("b.trk", data)
            assert_lines(read(other), judged(other))


def test_trackvis_in_the_other_order_of_bytes():
    name = write_tracts(scratch("little.trk"), LINES, list(volumes())[3])
    data = bytes_of(name)
    shorts = [*range(6, 12, 2), 36, 238]
    words = [*range(12, 36, 4), *range(440, 504, 4), *range(956, 980, 4),
             *range(988, len(data), 4)]
    other = written("big.trk", swapped(data, {2: shorts, 4: words}))
    assert_lines(read(other), judged(name))


def test_trackvis_keeps_numbers_under_their_names():
    count = sum(map(len, LINES))
    fa = numpy.arange(count, dtype=numpy.float32)
    color = RANDOM.uniform(size=(count, 3)).astype(numpy.float32)
    ends = numpy.cumsum([len(line) for line in LINES])[:-1]
    length = numpy.array([[5.5], [1.5], [12.5], [2.5]], numpy.float32)
    name = write_tracts(
        scratch("numbers.trk"), LINES, next(volumes()), data_per_streamline={"length": length},
        data_per_point={"fa": numpy.split(fa[:, None], ends), "color": numpy.split(color, ends)})
    data = read(name)
    assert_lines(data, judged(name))
    points, cells = data.GetPointData(), data.GetCellData()
    assert points.GetNumberOfArrays() == 2 and cells.GetNumberOfArrays() == 1
    assert numpy.array_equal(vtk_to_numpy(points.GetArray("fa")), fa)
    assert numpy.array_equal(vtk_to_numpy(points.GetArray("color")), color)
    assert numpy.array_equal(vtk_to_numpy(cells.GetArray("length")), length[:, 0])


def test_trackvis_without_a_matrix_takes_that_of_a_volume():
    for image in volumes():
        name = write_tracts(scratch("old.trk"), LINES, image)
        expected = judged(name)
        data = bytes_of(name)
        data[440:504] = bytes(64)
        old = written("old.trk", data)
        nibabel.save(image, scratch("made_in.mgz"))
        assert_lines(read(old, Volume=scratch("made_in.mgz")), expected)
        stored = [numpy.frombuffer(data, "<f4", 3 * len(line), place).reshape(-1, 3)
                  for line, place in zip(LINES, 1004 + 4 * numpy.cumsum(
                      [0] + [1 + 3 * len(line) for line in LINES]))]
        corner = numpy.frombuffer(data, "<f4", 3, 12) / 2
        assert_lines(read(old, ["no vox_to_ras", "Set Volume"]),
                     [line - corner for line in stored], None)
        nibabel.save(nibabel.MGHImage(numpy.zeros((2, 3, 4), numpy.uint8), numpy.eye(4)),
                     scratch("wrong.mgz"))
        assert_says(refusal(old, Volume=scratch("wrong.mgz")), "wrong.mgz has 2 x 3 x 4")


def test_trackvis_letters_in_another_order_are_refused():
    angle = numpy.deg2rad(20)
    affine = numpy.eye(4)
    affine[:3, :3] = ((numpy.cos(angle), -numpy.sin(angle), 0.2),
                      (numpy.sin(angle), numpy.cos(angle), 0.2), (-0.2, -0.2, 1))
    image = nibabel.MGHImage(numpy.zeros((8, 8, 8), numpy.uint8), affine)
    data = bytes_of(write_tracts(scratch("tilted.trk"), LINES, image))
    assert data[948:951] == b"RAS"
    for order in (b"ARS", b"ASR", b"RRS"):
        data[948:951] = order
        assert_says(refusal(written("order.trk", data)), "in another order" if order != b"RRS"
                    else "voxel order RRS")


def test_trackvis_axes_that_are_not_perpendicular_are_told():
    """Programs differ on which letters such axes run along."""
    name = write_tracts(scratch("sheared.trk"), LINES, nibabel.MGHImage(
        numpy.zeros((8, 8, 8), numpy.uint8), numpy.diag((1.0, 1.0, 1.0, 1.0))))
    data = bytes_of(name)
    struct.pack_into("<f", data, 444, 0.4)  # the second axis leads to the right, too
    read(written("sheared.trk", data), ("sheared: the cosine between two axes", "0.371"))


def test_trackvis_sizes_of_voxels_that_differ_are_told():
    """Where nibabel puts them: voxel_size takes points to voxels, before the matrix."""
    image = nibabel.MGHImage(numpy.zeros((8, 8, 8), numpy.uint8), numpy.diag((2, 2, 2, 1)))
    data = bytes_of(write_tracts(scratch("sizes.trk"), LINES, image))
    for size, words in ((2.001, ()), (1.0, ("voxel_size 1 mm along axis 1", "vox_to_ras are 2 mm",
                                            "stretched by 2"))):
        struct.pack_into("<f", data, 16, size)
        name = written("sizes.trk", data)
        assert_lines(read(name, words), judged(name))
    data[440:504] = bytes(64)
    nibabel.save(image, scratch("sizes.mgz"))
    read(written("sizes.trk", data), ["voxels of its Volume are 2 mm"], Volume=scratch("sizes.mgz"))


def test_trackvis_axes_turn_around_within_a_volume():
    name = write_tracts(scratch("turned.trk"), LINES, next(volumes()))
    data = bytes_of(name)
    data[948:949] = b"R" if data[948:949] == b"L" else b"L"
    data[6:8] = bytes(2)
    assert_says(refusal(written("turned.trk", data)), "0 voxels along axis 0")


def test_trackvis_has_a_matrix_since_version_2():
    data = bytes_of(write_tracts(scratch("first.trk"), LINES, next(volumes())))
    data[992:996] = struct.pack("<i", 1)
    read(written("first.trk", data), ["no vox_to_ras", "Set Volume"])


def test_mrtrix_in_every_type():
    image = next(volumes())
    name = write_tracts(scratch("a.tck"), LINES, image)
    assert_lines(read(name), judged(name))
    assert_lines(read(name), LINES)
    for kind, code in (("Float32LE", "<f4"), ("Float32BE", ">f4"), ("Float64LE", "<f8"),
                       ("Float64BE", ">f8")):
        name = written("types.tck", track_bytes(LINES, kind, code))
        assert_lines(read(name), LINES)


def track_bytes(lines, kind="Float32LE", code="<f4", end=(numpy.inf,) * 3, count=None):
    head = "mrtrix tracks\r\n" if kind == "Float64BE" else "mrtrix tracks\n"
    head += f"timestamp: 1\ncount: {len(lines) if count is None else count:06}\n"
    head += f"datatype: {kind}\nfile: . 120\nEND\n"
    triples = [row for line in lines for row in [*line, (numpy.nan,) * 3]] + [end]
    return head.encode().ljust(120, b"\0") + numpy.array(triples, code).tobytes()


def test_streamlines_without_points_are_told():
    lines = [LINES[0], numpy.zeros((0, 3)), LINES[2]]
    name = written("empty.tck", track_bytes(lines))
    assert_lines(read(name, ["1 streamline without points"]), [LINES[0], LINES[2]])
    name = written("count.tck", track_bytes(LINES, count=9))
    assert_lines(read(name, ["announces 9 streamlines and has 4"]), LINES)
    data = bytes_of(write_tracts(scratch("a.trk"), LINES, next(volumes())))
    data[988:992] = struct.pack("<i", 5)
    name = written("empty.trk", data + bytes(4))
    assert_lines(read(name, ["1 streamline without points"]), LINES)
    name = written("more.trk", bytes_of(scratch("a.trk")) + bytes(7))
    assert_lines(read(name, ["7 bytes after its 4 streamlines"]), LINES)
    data[988:992] = bytes(4)  # unknown: up to the end of the file
    assert_lines(read(written("unknown.trk", data)), LINES)
    nothing = read(written("none.tck", track_bytes([])))
    assert nothing.GetNumberOfPoints() == 0 and nothing.GetNumberOfCells() == 0


def test_deform_geometry_moves_tracts():
    lines = [RANDOM.uniform(4, 28, (20, 3)) for _ in range(5)]
    stroke = brainshift.stamp((16, 16, 16), (16, 16, 0), 3.0, major=14.0, minor=10.0)
    bent = simple.FreeFormDeformation(Input=volume(ball()), Strokes=stroke)
    for ending in (".trk", ".tck"):
        name = write_tracts(scratch("bent" + ending), lines, list(volumes())[1])
        source = simple.TractReader(FileName=name)
        deformed = output(simple.DeformGeometry(Input=source, Deformation=bent))
        expected = brainshift.deformed_from_rest(bent, points_of(output(source)))
        assert numpy.abs(points_of(deformed) - expected).max() < LARGEST_MM
        assert numpy.abs(expected - numpy.concatenate(lines)).max() > 1.0
        assert deformed.GetNumberOfLines() == 5


def test_reading_can_be_stopped():
    many = [LINES[2]] * 40000
    for ending in (".trk", ".tck"):
        name = write_tracts(scratch("many" + ending), many, next(volumes()))
        reader = simple.TractReader(FileName=name)
        source, heard = reader.GetClientSideObject(), []

        def stop(*_, source=source, heard=heard):
            heard.append(source.GetProgress())
            source.SetAbortExecute(int(heard[-1] > 0.5))
        watching = source.AddObserver("ProgressEvent", stop)
        with messages():
            source.Update()
        assert source.GetOutput().GetNumberOfPoints() == 0
        assert max(heard) > 0.5 and heard[-1] <= 1.0, heard
        source.RemoveObserver(watching)
        source.SetAbortExecute(0)
        source.Modified()
        source.Update()
        assert source.GetOutput().GetNumberOfLines() == len(many)


def test_damaged_tracts_end_in_one_sentence():
    trk = bytes(bytes_of(write_tracts(scratch("good.trk"), LINES, next(volumes()))))
    tck = track_bytes(LINES)

    def put(place, number, kind="<i"):
        data = bytearray(trk)
        struct.pack_into(kind, data, place, number)
        return data
    cases = [
        (b"TRACK", "no whole header"), (trk[:999], "no whole header"),
        (put(996, 999), "header size 999"), (put(992, 4), "the version 4"),
        (put(36, -1, "<h"), "has -1 numbers"), (put(988, -1), "announces -1 streamlines"),
        (put(988, 5), "announces 5 streamlines and has 4"),
        (trk[:-1], "damaged streamline 3 of 2 points: 27 bytes follow"),
        (trk[:-26], "damaged streamline 3 of an unknown number of points"),
        (put(1000, 2**31 - 1), "damaged streamline 0 of 2147483647 points"),
        (put(1000, -1), "damaged streamline 0 of -1 points"),
        (put(12, 0.0, "<f"), "voxels of 0 mm along axis 0"),
        (put(440, float("nan"), "<f"), "cannot be placed"),
        (put(948, ord("X"), "<B"), "voxel order XIA; it must be 3 of the letters"),
        (put(949, ord("P"), "<B"), "does not run along P"),
        (put(1004, float("nan"), "<f"), "point 0 at a coordinate of nan mm"),
        (put(1004, 1e30, "<f"), "the limit is 1e+06 mm"),
        (b"mrtrix", "begins neither with TRACK"), (tck[:60], "no line END"),
        (tck.replace(b". 120", b"x 120"), "has the line"),
        (tck.replace(b". 120", b". 999999"), 'has the line "file: . 999999"'),
        (tck.replace(b"Float32LE", b"Int16"), "has the datatype Int16"),
        (tck[:-12], "ends before the three infinite numbers"),
        (tck[:-5], "ends before the three infinite numbers"),
        (track_bytes([[(1, 2, numpy.nan)]]), "point 0 at a coordinate of nan mm"),
        (track_bytes([[(1, 2e6, 3)]]), "a coordinate of 2e+06 mm; the limit is 1e+06 mm"),
        (b"", "begins neither with TRACK"),
    ]
    for data, words in cases:
        assert_says(refusal(written("spoiled", data)), words)
    for missing, words in ((scratch("none"), "does not exist"), (scratch("."), "is a folder"),
                           ("", "FileName is empty")):
        assert_says(refusal(missing), words)


def readers_of(name):
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    found = factory.GetReaders(name, servermanager.ActiveConnection.Session)
    return [found.GetString(i) for i in range(1, found.GetLength(), 3)]


def test_file_open_offers_the_reader_for_its_files():
    for ending in (".trk", ".tck"):
        name = write_tracts(scratch("open" + ending), LINES, next(volumes()))
        assert readers_of(name) == ["TractReader"], readers_of(name)
        source = simple.OpenDataFile(name)
        assert source.GetXMLName() == "TractReader", source.GetXMLName()
        simple.Delete(source)
        assert readers_of(written("other" + ending, b"other")) == []


run_tests(globals())
