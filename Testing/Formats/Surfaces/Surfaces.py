# SPDX-License-Identifier: BSD-3-Clause
# Proves that surfaces of FreeSurfer and GIFTI lie where nibabel's matrices put them, with their
# numbers, that Deform Geometry moves them as the map says, and that nothing is placed or left out
# without a word.
import os

import nibabel
import numpy
from brainshift_testing import (assert_says, ball, load_plugin, output, run_tests,
                                scratch, volume)
from nibabel import gifti
from surface_files import (POINTS, TRIANGLES, data_array, geometry, gifti_arrays, moved,
                           points_of, read_by, refusal_by, scanner_from_surface, triangles_of,
                           volumes, write_gifti, write_surface)
from vtkmodules.util.numpy_support import vtk_to_numpy

load_plugin()
import brainshift  # noqa: E402 after the plugin
from paraview import servermanager, simple  # noqa: E402

LARGEST_MM = 1e-3
SCANNER, ALIGNED = "NIFTI_XFORM_SCANNER_ANAT", "NIFTI_XFORM_ALIGNED_ANAT"
UNKNOWN, TALAIRACH = "NIFTI_XFORM_UNKNOWN", "NIFTI_XFORM_TALAIRACH"


def read(name, words=(), **named):
    return read_by(simple.SurfaceReader, name, words, **named)


def refusal(name, **named):
    return refusal_by(simple.SurfaceReader, name, **named)


def axes_of(data):
    found = data.GetFieldData().GetAbstractArray("WorldAxes")
    return found.GetValue(0) if found else None


def assert_at(data, expected, axes="RAS"):
    assert numpy.abs(points_of(data) - expected).max() < LARGEST_MM, (points_of(data), expected)
    assert axes_of(data) == axes, axes_of(data)


def outward(points, triangles):
    """Whether the triangles of a tetrahedron look away from its middle."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    normals = numpy.cross(b - a, c - a)
    return (numpy.sum(normals * (a - points.mean(axis=0)), axis=1) > 0).all()


def test_freesurfer_lies_in_the_scanner():
    assert outward(POINTS, TRIANGLES)
    for image in volumes():
        name = write_surface(scratch("lh.pial"), geometry(image))
        stored, triangles, info = nibabel.freesurfer.read_geometry(name, read_metadata=True)
        assert info["valid"].startswith("1")
        matrix = scanner_from_surface(image)
        data = read(name)
        assert_at(data, moved(matrix, stored))
        assert outward(points_of(data), triangles_of(data)), "the outside stays outside"
        if numpy.linalg.det(matrix[:3, :3]) > 0:
            assert numpy.array_equal(triangles_of(data), triangles)


def test_freesurfer_without_a_geometry_takes_that_of_a_volume():
    for i, image in enumerate(volumes()):
        invalid = geometry(image, valid="0  # volume info invalid")
        name = write_surface(scratch("lh.white"), invalid if i % 2 else None)
        expected = moved(scanner_from_surface(image), POINTS)
        for ending in (".mgz", ".mgh", ".nii.gz"):
            saved = nibabel.Nifti1Image(numpy.zeros(image.shape, numpy.uint8), image.affine)
            saved = saved if ending == ".nii.gz" else image
            nibabel.save(saved, scratch("orig" + ending))
            words = [] if i == 0 else ["orig.mgz or T1.mgz", "not the scan"]
            assert_at(read(name, words, Volume=scratch("orig" + ending)), expected)
        assert_at(read(name, ["has no position of its volume", "Set Volume"]), POINTS, None)
        center = read(name, VolumeCenter=[1.5, -20.0, 7.25])
        assert_at(center, POINTS + [1.5, -20.0, 7.25])


def test_the_geometry_in_the_file_counts():
    first, second = list(volumes())[:2]
    name = write_surface(scratch("rh.pial"), geometry(first))
    expected = moved(scanner_from_surface(first), POINTS)
    for image, words in ((first, ()), (second, ["geometry of its volume, which is used"])):
        nibabel.save(image, scratch("other.mgz"))
        assert_at(read(name, words, Volume=scratch("other.mgz")), expected)
    # A surface in scanner RAS says so.
    real = write_surface(scratch("rh.real"), {**geometry(first), "head": [2, 0, 20]})
    with open(real, "rb") as file:
        parts = file.read().split(b"\0\0\0\2\0\0\0\0\0\0\0\x14")
    with open(real, "wb") as file:
        file.write(b"\0\0\0\2\0\0\0\1\0\0\0\x14".join(parts))
    assert_at(read(real), POINTS)
    # Other tags may stand before the geometry.
    with open(real, "wb") as file:
        file.write((b"\0\0\0\3" + b"\0" * 7 + b"\4abcd" + b"\0\0\0\x14").join(parts))
    assert_at(read(real), expected)


def test_maps_of_values_come_along():
    name = write_surface(scratch("lh.pial"), geometry(next(volumes())))
    thickness = numpy.array([2.5, 3.0, 1.25, 4.0], numpy.float32)
    nibabel.freesurfer.write_morph_data(scratch("lh.thickness"), thickness)
    shape = data_array(thickness + 1, "NIFTI_INTENT_SHAPE", meta={"Name": "depth"})
    times = [data_array(thickness * i, "NIFTI_INTENT_TIME_SERIES") for i in range(3)]
    short = data_array(thickness[:3], "NIFTI_INTENT_SHAPE")
    write_gifti(scratch("lh.func.gii"), [shape, *times, short])
    files = [scratch("lh.thickness"), scratch("lh.func.gii")]
    data = read(name, ["1 array with other than 4 rows"], ValueFileNames=files)
    found = {data.GetPointData().GetArrayName(i): vtk_to_numpy(data.GetPointData().GetArray(i))
             for i in range(data.GetPointData().GetNumberOfArrays())}
    expected = {"thickness": thickness, "depth": thickness + 1, "TIME_SERIES": 0 * thickness,
                "TIME_SERIES 2": thickness, "TIME_SERIES 3": 2 * thickness}
    assert found.keys() == expected.keys(), found.keys()
    assert all(numpy.array_equal(found[name], expected[name]) for name in expected)
    nibabel.freesurfer.write_morph_data(scratch("lh.short"), thickness[:3])
    data = read(name, ["values of 3 points; the surface has 4"],
                ValueFileNames=[scratch("lh.short")])
    assert data.GetPointData().GetNumberOfArrays() == 0
    assert_says(refusal(name, ValueFileNames=[scratch("none")]), "none does not exist")
    assert_says(refusal(name, ValueFileNames=[name]), "no map of values")


def test_values_of_the_other_hemisphere_are_told():
    values = numpy.array([2.5, 3.0, 1.25, 4.0], numpy.float32)
    shape = data_array(values, "NIFTI_INTENT_SHAPE", meta={"Name": "curv"})
    for name in ("lh.curv", "rh.curv", "L.curv"):
        nibabel.freesurfer.write_morph_data(scratch(name), values)
    for name in ("a_hemi-L_curv.gii", "a_hemi-R_curv.gii", "100.R.curv.gii"):
        write_gifti(scratch(name), [shape])
    sided = {side: gifti.GiftiMetaData({"AnatomicalStructurePrimary": "Cortex" + side})
             for side in ("Left", "Right")}
    write_gifti(scratch("said_left.gii"), [shape], meta=sided["Left"])
    write_gifti(scratch("L.said.gii"), [shape], meta=sided["Right"])
    write_surface(scratch("lh.pial"), geometry(next(volumes())))
    write_surface(scratch("both.lh.rh.pial"), geometry(next(volumes())))
    arrays = gifti_arrays(system(SCANNER, SCANNER))
    arrays[0].meta = sided["Right"]
    write_gifti(scratch("said.surf.gii"), arrays)
    right = ("rh.curv", "a_hemi-R_curv.gii", "100.R.curv.gii", "L.said.gii")
    left = ("lh.curv", "L.curv", "a_hemi-L_curv.gii", "said_left.gii")
    for surface, bad, good in (("lh.pial", right, left), ("said.surf.gii", left, right),
                               ("both.lh.rh.pial", (), left + right)):
        for name in bad + good:
            words = [scratch(name), "hemisphere, but the surface " + scratch(surface),
                     "fsaverage_sym", "Otherwise name the file of the"] if name in bad else ()
            data = read(scratch(surface), words, ValueFileNames=[scratch(name)])
            assert numpy.array_equal(vtk_to_numpy(data.GetPointData().GetArray("curv")
                                                  or data.GetPointData().GetArray(0)), values)


def system(start, end, matrix=numpy.eye(4)):
    return gifti.GiftiCoordSystem(start, end, matrix)


def test_gifti_in_every_encoding():
    for encoding in ("ASCII", "B64BIN", "B64GZ"):
        for endian in ("little", "big"):
            for order in ("RowMajorOrder", "ColumnMajorOrder"):
                if encoding == "ASCII" and order == "ColumnMajorOrder":
                    continue  # nibabel writes rows all the same
                arrays = gifti_arrays(system(SCANNER, SCANNER), f"GIFTI_ENCODING_{encoding}",
                                      ordering="C" if order[0] == "R" else "F")
                name = write_gifti(scratch("a.surf.gii"), arrays)
                with open(name, "rb") as file:
                    text = file.read()
                with open(name, "wb") as file:
                    file.write(swapped(text, encoding, endian))
                assert order.encode() in text
                judged = nibabel.load(name).agg_data(("pointset", "triangle"))
                data = read(name)
                assert_at(data, judged[0])
                assert numpy.array_equal(triangles_of(data), judged[1])
    wide = gifti_arrays(system(SCANNER, SCANNER))
    wide[0] = data_array(POINTS / 3, "NIFTI_INTENT_POINTSET", datatype="NIFTI_TYPE_FLOAT64",
                         coordsys=system(SCANNER, SCANNER))
    assert numpy.array_equal(points_of(read(write_gifti(scratch("b.gii"), wide))), POINTS / 3)


def swapped(text, encoding, endian):
    """A file with its numbers in one of the orders. nibabel writes those of this machine."""
    import base64
    import re
    import sys
    import zlib
    if encoding == "ASCII" or endian == sys.byteorder:
        return text
    text = text.replace(*((b"LittleEndian", b"BigEndian") if endian == "big" else
                          (b"BigEndian", b"LittleEndian")))
    packs = encoding == "B64GZ"

    def turn(found):
        numbers = base64.b64decode(found[1])
        numbers = zlib.decompress(numbers) if packs else numbers
        numbers = numpy.frombuffer(numbers, "i4").byteswap().tobytes()
        packed = base64.b64encode(zlib.compress(numbers) if packs else numbers)
        return b"<Data>" + packed + b"</Data>"
    return re.sub(rb"<Data>(.*?)</Data>", turn, text, flags=re.DOTALL)


def test_gifti_lies_where_its_matrix_leads():
    for image in volumes():
        matrix = scanner_from_surface(image)
        for start, end in ((UNKNOWN, SCANNER), (UNKNOWN, ALIGNED), (ALIGNED, SCANNER),
                           (TALAIRACH, SCANNER)):
            name = write_gifti(scratch("m.surf.gii"), gifti_arrays(system(start, end, matrix)))
            data = read(name)
            assert_at(data, moved(matrix, POINTS))
            assert outward(points_of(data), triangles_of(data))
        # Points that are there already stay.
        for start, end in ((SCANNER, TALAIRACH), (TALAIRACH, TALAIRACH), (ALIGNED, TALAIRACH)):
            name = write_gifti(scratch("s.surf.gii"), gifti_arrays(system(start, end, matrix)))
            assert_at(read(name), POINTS)
        # A matrix that leads elsewhere is told.
        name = write_gifti(scratch("t.surf.gii"), gifti_arrays(system(UNKNOWN, TALAIRACH, matrix)))
        assert_at(read(name, ["does not name the space", TALAIRACH]), POINTS, None)


def test_all_doubts_about_a_gifti_file_are_told():
    arrays = gifti_arrays(system(SCANNER, SCANNER))
    name = write_gifti(scratch("doubtful.surf.gii"), [arrays[0], *arrays])
    with open(name, "rb") as file:
        text = file.read()
    count = f'NumberOfDataArrays="{len(arrays) + 1}"'.encode()
    assert count in text, text[:400]
    with open(name, "wb") as file:
        file.write(text.replace(count, b'NumberOfDataArrays="9"'))
    read(name, ["NIFTI_INTENT_POINTSET; the first is shown", "NumberOfDataArrays announces 9"])


def test_gifti_of_freesurfer_keeps_its_volume():
    for image in volumes():
        kept = {f"VolGeom{letter}_{side}": str(vector[i])
                for letter, vector in zip("XYZC", [*image.header["Mdc"], image.header["Pxyz_c"]])
                for i, side in enumerate("RAS")}
        for found in (system(UNKNOWN, UNKNOWN), system(UNKNOWN, TALAIRACH)):
            arrays = gifti_arrays(found)
            arrays[0].meta = gifti.GiftiMetaData(kept)
            name = write_gifti(scratch("lh.pial.surf.gii"), arrays)
            assert_at(read(name), moved(scanner_from_surface(image), POINTS))


def test_gifti_keeps_numbers_and_labels():
    matrix = scanner_from_surface(list(volumes())[2])
    table = gifti.GiftiLabelTable()
    for key, name, color in ((0, "???", (0, 0, 0)), (35, "Straße", (1.0, 0.5, 0.0))):
        label = gifti.GiftiLabel(key, *color, 1.0)
        label.label = name
        table.labels.append(label)
    keys = numpy.array([0, 35, 35, 0], numpy.int32)
    normals = POINTS.astype(numpy.float32) / 50
    arrays = gifti_arrays(system(UNKNOWN, SCANNER, matrix))
    arrays += [data_array(keys, "NIFTI_INTENT_LABEL", meta={"Name": "areas"}),
               data_array(normals, "NIFTI_INTENT_VECTOR"),
               data_array((POINTS + 60).astype(numpy.uint8), "NIFTI_INTENT_RGB_VECTOR",
                          datatype="NIFTI_TYPE_UINT8")]
    data = read(write_gifti(scratch("lh.label.gii"), arrays, labeltable=table))
    points = data.GetPointData()
    assert numpy.array_equal(vtk_to_numpy(points.GetArray("areas")), keys)
    assert numpy.array_equal(vtk_to_numpy(points.GetArray("RGB_VECTOR")), POINTS.astype(int) + 60)
    turned = normals @ matrix[:3, :3].T
    assert numpy.allclose(vtk_to_numpy(points.GetArray("VECTOR")), turned, atol=1e-6)
    fields = data.GetFieldData()
    names = fields.GetAbstractArray("LabelNames")
    assert [names.GetValue(i) for i in range(2)] == ["???", "Straße"]
    assert vtk_to_numpy(fields.GetArray("LabelValues")).tolist() == [0, 35]
    assert vtk_to_numpy(fields.GetArray("LabelColors")).tolist() == [[0, 0, 0], [255, 128, 0]]


def labelled(name, rows, **names):
    """A file of values: `rows` of them, and names of the labels k0, k1, ..."""
    table = gifti.GiftiLabelTable()
    for key, word in names.items():
        label = gifti.GiftiLabel(int(key[1:]), 1.0, 0.0, 0.0, 1.0)
        label.label = word
        table.labels.append(label)
    arrays = [data_array(numpy.zeros(rows, numpy.int32), "NIFTI_INTENT_LABEL")]
    return write_gifti(scratch(name), arrays, labeltable=table)


def test_names_of_labels_of_several_files_do_not_mix():
    name = write_surface(scratch("lh.pial"), geometry(next(volumes())))
    one = labelled("one.gii", 4, k1="left", k2="right")
    same = labelled("same.gii", 4, k2="right", k3="middle")
    other = labelled("other.gii", 4, k2="up", k4="down")
    short = labelled("short.gii", 3, k5="none")

    def known(data):
        fields = data.GetFieldData()
        names = fields.GetAbstractArray("LabelNames")
        return dict(zip(vtk_to_numpy(fields.GetArray("LabelValues")).tolist(),
                        [names.GetValue(i) for i in range(names.GetNumberOfValues())]))
    right = {1: "left", 2: "right", 3: "middle"}
    assert known(read(name, ValueFileNames=[one, same])) == right
    data = read(name, ["names the label 2", "up", "right", "left out"],
                ValueFileNames=[one, same, other])
    assert known(data) == right
    assert data.GetPointData().GetNumberOfArrays() == 3
    assert known(read(name, ["with other than 4 rows"], ValueFileNames=[one, short])) == \
        {1: "left", 2: "right"}


def test_vectors_of_doubles_turn_too():
    matrix = scanner_from_surface(list(volumes())[2])
    arrays = gifti_arrays(system(UNKNOWN, SCANNER, matrix))
    arrays.append(data_array(POINTS / 50, "NIFTI_INTENT_VECTOR", datatype="NIFTI_TYPE_FLOAT64"))
    points = read(write_gifti(scratch("wide.gii"), arrays)).GetPointData()
    assert numpy.allclose(vtk_to_numpy(points.GetArray("VECTOR")), POINTS / 50 @ matrix[:3, :3].T)


def test_deform_geometry_moves_a_surface():
    image = list(volumes())[1]
    points = numpy.random.default_rng(3).uniform(4.0, 28.0, (60, 3))
    stored = moved(numpy.linalg.inv(scanner_from_surface(image)), points)
    name = write_surface(scratch("lh.small"), geometry(image), stored,
                         numpy.arange(60).reshape(-1, 3))
    stroke = brainshift.stamp((16, 16, 16), (16, 16, 0), 3.0, major=14.0, minor=10.0)
    bent = simple.FreeFormDeformation(Input=volume(ball()), Strokes=stroke)
    source = simple.SurfaceReader(FileName=name)
    deformed = output(simple.DeformGeometry(Input=source, Deformation=bent))
    expected = brainshift.deformed_from_rest(bent, points_of(output(source)))
    assert numpy.abs(points_of(deformed) - expected).max() < LARGEST_MM
    assert numpy.abs(expected - points).max() > 1.0, "the stroke moves some of it"
    assert axes_of(deformed) == "RAS"


def spoiled(name, change):
    with open(name, "rb") as file:
        data = bytearray(file.read())
    with open(scratch("spoiled"), "wb") as file:
        file.write(change(data))
    return refusal(scratch("spoiled"))


def put(data, place, number):
    data[place:place + 4] = int(number).to_bytes(4, "big", signed=True)
    return data


def test_damaged_surfaces_end_in_one_sentence():
    name = write_surface(scratch("lh.pial"), geometry(next(volumes())))
    head = 3 + len("created by a test\n\n")
    triangles = head + 8 + 4 * POINTS.size
    end = triangles + 4 * TRIANGLES.size
    huge = numpy.float32(2e6).view(numpy.int32)
    cases = [
        (lambda data: b"", "does not begin like a FreeSurfer surface"),
        (lambda data: b"\xff\xff\xfd" + data[3:], "quadrangles"),
        (lambda data: b"\xff\xff\xff\xff" + data[4:], "flat patch of FreeSurfer"),
        (lambda data: b"\xff\xff\xff\0" + data[4:], "as one of its Value File Names"),
        (lambda data: b"\x1f\x8b" + data[2:], "is packed by gzip; unpack it"),
        (lambda data: data[:head + 4], "ends within its header"),
        (lambda data: data[:end - 1], "announces 4 points and 4 triangles, and has only 95 bytes"),
        (lambda data: put(data, head, 2**31 - 1), "announces 2147483647 points"),
        (lambda data: put(data, head, -1), "announces -1 points"),
        (lambda data: put(data, head, 0), "announces 0 points"),
        (lambda data: put(data, triangles, 4), "point 4 in triangle 0; it has the points 0 to 3"),
        (lambda data: put(data, triangles + 4, -1), "point -1 in triangle 0"),
        (lambda data: put(data, head + 8, 0x7FC00000), "point 0 at a coordinate of nan mm"),
        (lambda data: put(data, head + 12, huge), "2e+06 mm; the limit is 1e+06 mm"),
        (lambda data: data[:-60], "ends within its volume geometry"),
        (lambda data: data.replace(b"xras", b"yras"), "damaged volume geometry"),
        (lambda data: data.replace(b"valid = 1", b"valid = 7"), "damaged volume geometry"),
        (lambda data: data[:data.find(b"xras")] + b"xras = 0 0 0\n" +
         data[data.find(b"yras"):], "cannot be placed: its volume geometry is wrong"),
        (lambda data: data[:end] + b"\0\0\0\3" + b"\x7f" * 8, "damaged tag 3"),
    ]
    for change, words in cases:
        assert_says(spoiled(name, change), words)
    for missing, words in ((scratch("none"), "does not exist"), (scratch("."), "is a folder"),
                           ("", "FileName is empty")):
        assert_says(refusal(missing), words)
    plain = write_surface(scratch("lh.plain"))
    assert_says(refusal(plain, Volume=name), "no FreeSurfer volume")
    assert_says(refusal(plain, Volume=scratch("none")), "no FreeSurfer volume")


def test_damaged_gifti_ends_in_one_sentence():
    ascii = "GIFTI_ENCODING_ASCII"
    name = write_gifti(scratch("ascii.gii"), gifti_arrays(system(SCANNER, SCANNER), ascii))
    packed = write_gifti(scratch("packed.gii"), gifti_arrays(system(SCANNER, SCANNER)))
    matrix = write_gifti(scratch("matrix.gii"), gifti_arrays(system(UNKNOWN, SCANNER), ascii))
    bomb = b'<!DOCTYPE GIFTI [<!ENTITY a "aaaa">]><GIFTI>&a;</GIFTI>'
    cases = [
        (name, lambda data: data[:-20], "is not good XML in line"),
        (name, lambda data: b"<GIFTI", "is not good XML"),
        (name, lambda data: b"<svg><GIFTI/></svg>", "its first element is svg"),
        (name, lambda data: bomb, "declares an entity"),
        (name, lambda data: b"<GIFTI>" * 40, "deeper than 16"),
        (name, lambda data: b"<GIFTI></GIFTI>", "has no array NIFTI_INTENT_POINTSET"),
        (name, lambda data: data.replace(b"INTENT_TRIANGLE", b"INTENT_SHAPE"),
         "has no array NIFTI_INTENT_TRIANGLE"),
        (name, lambda data: data.replace(b"FLOAT32", b"COMPLEX64"), "NIFTI_TYPE_COMPLEX64"),
        (name, lambda data: data.replace(b"INT32", b"UINT8"), "3 columns of NIFTI_TYPE_INT32"),
        (name, lambda data: data.replace(b'Dim0="4"', b'Dim0="5"'), "dimensions announce 15"),
        (name, lambda data: data.replace(b'Dim0="4"', b'Dim0="999999999"'), "letters of numbers"),
        (name, lambda data: data.replace(b'Dim0="4"', b'Dim0="0"'), "1 to 2147483647"),
        (name, lambda data: data.replace(b'Dim1="3"', b'Dim1="2.5"'), 'Dim1 "2.5"'),
        (name, lambda data: data.replace(b'ality="2"', b'ality="9"'), "must be 1 to 6"),
        (name, lambda data: data.replace(b'"ASCII"', b'"External"'), 'Encoding "External"'),
        (name, lambda data: data.replace(b"RowMajorOrder", b"x"), "ArrayIndexingOrder"),
        (name, lambda data: data.replace(b"40.5", b"4o.5"), "in place of a number"),
        (packed, lambda data: data.replace(b"LittleEndian", b"Middle"), 'Endian "Middle"'),
        (packed, lambda data: data.replace(b"<Data>eJ", b"<Data>eK"), "packed numbers that are"),
        (packed, lambda data: data.replace(b"<Data>e", b"<Data>!"), "no base64 in array 1"),
        (packed, lambda data: data.replace(b'Dim0="4"', b'Dim0="3"'), "too few or too many"),
        (packed, lambda data: data.replace(b'Dim0="4"', b'Dim0="5"'), "has 48 bytes"),
        (matrix, lambda data: data.replace(b"<MatrixData>", b"<MatrixData>x "), "16 numbers"),
        (matrix, lambda data: data.replace(b" 1.000000", b" 0.000000"), "last row"),
        (matrix, lambda data: data.replace(b"<MatrixData>", b"<MatrixData>" + b"1 " * 4096),
         "4096 letters or fewer"),
    ]
    for source, change, words in cases:
        with open(source, "rb") as file:
            data = file.read()
        assert change(bytes(data)) != data, words
        with open(scratch("spoiled.gii"), "wb") as file:
            file.write(change(bytes(data)))
        assert_says(refusal(scratch("spoiled.gii")), words)


def readers_of(name):
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    found = factory.GetReaders(name, servermanager.ActiveConnection.Session)
    return [found.GetString(i) for i in range(1, found.GetLength(), 3)]


def test_file_open_offers_the_reader_for_its_files():
    image = next(volumes())
    good = [write_surface(scratch(name), geometry(image))
            for name in ("lh.pial", "rh.white", "lh.pial.T1", "sub-01.inflated", "lh.sphere.reg")]
    good.append(write_gifti(scratch("x.surf.gii"), gifti_arrays(system(SCANNER, SCANNER))))
    for name in good:
        assert readers_of(name) == ["SurfaceReader"], (name, readers_of(name))
        source = simple.OpenDataFile(name)
        assert source.GetXMLName() == "SurfaceReader", source.GetXMLName()
        simple.Delete(source)
    nibabel.freesurfer.write_morph_data(scratch("lh.curv"), numpy.zeros(4, numpy.float32))
    assert "SurfaceReader" not in readers_of(scratch("lh.curv"))
    other = scratch("lh.vtk")
    with open(other, "w", encoding="utf-8") as file:
        file.write("# vtk DataFile Version 3.0\n")
    assert "SurfaceReader" not in readers_of(other)
    os.remove(other)


run_tests(globals())
