# SPDX-License-Identifier: BSD-3-Clause
# Proves that each element and attribute of a GIFTI file does what the list of fields in README.md
# says of it.
import base64

import fields_walk
import numpy
from brainshift_testing import load_plugin, run_tests

load_plugin()

POINTS = numpy.array([[1, 2, 3], [4, 2, 3], [1, 7, 3], [1, 2, 9]], numpy.float32)
TRIANGLES = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3]], numpy.int32)
VALUES = numpy.array([1, 2, 3, 4], numpy.float32)
SHIFT = "1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1"
SPACES = ("NIFTI_XFORM_TALAIRACH", "NIFTI_XFORM_SCANNER_ANAT")


def array(numbers, intent, inside="", meta=(), **changed):
    """An element DataArray; `changed` are other attributes."""
    kind = "NIFTI_TYPE_" + numbers.dtype.name.upper()
    attributes = {"Intent": intent, "DataType": kind, "ArrayIndexingOrder": "RowMajorOrder",
                  "Dimensionality": numbers.ndim, "Encoding": "Base64Binary",
                  "Endian": "LittleEndian", "ExternalFileName": "", "ExternalFileOffset": ""}
    attributes.update({f"Dim{i}": side for i, side in enumerate(numbers.shape)})
    attributes.update(changed)
    words = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    pairs = "".join(f"<MD><Name>{name}</Name><Value>{value}</Value></MD>" for name, value in meta)
    data = base64.b64encode(numbers.tobytes()).decode()
    return (f"<DataArray {words}><MetaData>{pairs}</MetaData>{inside}"
            f"<Data>{data}</Data></DataArray>")


def system(spaces=SPACES, matrix=SHIFT):
    return ("<CoordinateSystemTransformMatrix>"
            f"<DataSpace>{spaces[0]}</DataSpace><TransformedSpace>{spaces[1]}</TransformedSpace>"
            f"<MatrixData>{matrix}</MatrixData></CoordinateSystemTransformMatrix>")


def gifti(inside="", meta=(), labels="", values=None, root="", version="1.0", count="3",
          triangles=None, **changed):
    points = array(POINTS, "NIFTI_INTENT_POINTSET", inside, meta, **changed)
    triangles = triangles or array(TRIANGLES, "NIFTI_INTENT_TRIANGLE")
    values = values or array(VALUES, "NIFTI_INTENT_SHAPE", meta=[("Name", "thickness")])
    return (f'<?xml version="1.0"?><GIFTI Version="{version}" NumberOfDataArrays="{count}">'
            f"<MetaData>{root}</MetaData>{labels}{points}{triangles}{values}</GIFTI>").encode()


def table(key="1", red="1"):
    return (f'<LabelTable><Label Key="{key}" Red="{red}" Green="0" Blue="0" Alpha="1">one</Label>'
            "</LabelTable>")


def changes():
    good = gifti(inside=system())
    scalars = array(VALUES, "NIFTI_INTENT_SHAPE", meta=[("Name", "curvature")])
    geometry = [(f"VolGeom{letter}_{axis}", "1" if letter + axis in ("XR", "YA", "ZS") else "0")
                for letter in "XYZC" for axis in "RAS"]
    return {
        "Version": [good, gifti(version="2.0")],
        "NumberOfDataArrays": [good, gifti(count="4")],
        "Intent": [good, gifti(inside=system(), values=array(VALUES, "NIFTI_INTENT_LABEL",
                                                             meta=[("Name", "area")]))],
        "DataType": [good, gifti(DataType="NIFTI_TYPE_INT16")],
        "ArrayIndexingOrder": [good, gifti(inside=system(), ArrayIndexingOrder="ColumnMajorOrder")],
        "Dimensionality": [good, gifti(Dimensionality="7")],
        "Dim0": [good, gifti(inside=system(), triangles=array(TRIANGLES[:2],
                                                              "NIFTI_INTENT_TRIANGLE"))],
        "Encoding": [good, gifti(Encoding="ExternalFileBinary")],
        "Endian": [good, gifti(inside=system(), Endian="BigEndian")],
        "ExternalFileName": [good, gifti(inside=system(), ExternalFileName="other.dat")],
        "ExternalFileOffset": [good, gifti(inside=system(), ExternalFileOffset="9")],
        "DataSpace": [good, gifti(inside=system((SPACES[1], SPACES[1]))),
                      gifti(inside=system(("HOME", "HOME")))],
        "TransformedSpace": [good, gifti(inside=system((SPACES[0], SPACES[0])))],
        "MatrixData": [good, gifti(inside=system(matrix=SHIFT.replace("5", "6")))],
        "MetaData Name": [good, gifti(inside=system(), values=scalars)],
        "MetaData VolGeom": [gifti(), gifti(meta=geometry)],
        "MetaData AnatomicalStructurePrimary": [
            good, gifti(inside=system(), meta=[("AnatomicalStructurePrimary", "CortexLeft")])],
        "MetaData GeometricType": [
            good, gifti(inside=system(), meta=[("GeometricType", "Spherical")])],
        "MetaData of the file": [good, gifti(
            inside=system(), root="<MD><Name>UserName</Name><Value>me</Value></MD>")],
        "Label Key": [gifti(inside=system(), labels=table()),
                      gifti(inside=system(), labels=table(key="2"))],
        "Label Red": [gifti(inside=system(), labels=table()),
                      gifti(inside=system(), labels=table(red="0"))],
        "Label Alpha": [gifti(inside=system(), labels=table()), gifti(
            inside=system(), labels=table().replace('Alpha="1"', 'Alpha="0"'))]}


def test_each_field_does_what_the_list_says():
    right = fields_walk.scratch("walk_hemi-R.gii")
    with open(right, "wb") as file:
        file.write(gifti(values=array(VALUES, "NIFTI_INTENT_SHAPE", meta=[("Name", "right")])))
    fields_walk.walk("GIFTI", "Fields of the file", changes(),
                     lambda content: fields_walk.outcome("SurfaceReader", "walk.gii", content,
                                                         ValueFileNames=[right]))


def test_what_occurs_twice_is_refused_by_its_name():
    good = gifti(inside=system(), labels=table(), meta=[("VolGeomC_R", "1")]).decode()
    for old, new, words in (
            ('Dimensionality="2"', 'Dimensionality="2" Dim0="4"',
             "has the attribute Dim0 twice in an element in line 1"),
            ('Key="1"', 'Key="1" Key="2"', "has the attribute Key twice in an element in line 1"),
            ("</MD></MetaData>", "</MD><MD><Name>VolGeomC_R</Name><Value>2</Value></MD></MetaData>",
             "has the metadata VolGeomC_R twice, with different values"),
            ("<TransformedSpace>", "<DataSpace>HOME</DataSpace><TransformedSpace>",
             "has the element DataSpace twice"),
            ("<MatrixData>", f"<MatrixData>{SHIFT}</MatrixData><MatrixData>",
             "has the element MatrixData twice"),
            ("</LabelTable>", '<Label Key="1">two</Label></LabelTable>',
             "has the label 1 twice, with different names")):
        assert old in good, old
        error, _ = fields_walk.outcome(
            "SurfaceReader", "twice.gii", good.replace(old, new, 1).encode())
        assert error and words in error, (error, words)
    for old, new in (("</MD></MetaData>", "</MD><MD><Name>VolGeomC_R</Name><Value>1</Value></MD>"
                      "</MetaData>"),
                     ("</LabelTable>", '<Label Key="1">one</Label></LabelTable>')):
        error, _ = fields_walk.outcome(
            "SurfaceReader", "twice.gii", good.replace(old, new, 1).encode())
        assert not error, error


def said_of(content, name="said.gii", **properties):
    error, facts = fields_walk.outcome("SurfaceReader", name, content, **properties)
    return error or facts[0]


def test_what_is_not_used_is_said():
    nowhere = ("NIFTI_XFORM_UNKNOWN",) * 2
    assert "and the file's matrix to NIFTI_XFORM_UNKNOWN is not used" in said_of(
        gifti(inside=system(nowhere)))
    still = system(nowhere, matrix=SHIFT.replace("5", "0"))
    assert "matrix" not in said_of(gifti(inside=still))
    empty = array(VALUES, "NIFTI_INTENT_SHAPE", meta=[("Name", "thickness")]).split("<Data>")[0]
    assert "the array thickness without an element Data" in said_of(
        gifti(inside=system(), values=empty + "</DataArray>"))
    surface = gifti(inside=system(), values=" ", count="2")
    assert not said_of(surface, "values.gii")
    assert "has no array of values" in said_of(
        surface, ValueFileNames=[fields_walk.scratch("values.gii")])


def test_points_that_workbench_may_have_moved_are_doubted():
    geometry = [(f"VolGeom{letter}_{axis}", "1" if letter + axis in ("XR", "YA", "ZS") else
                 "5" if letter == "C" else "0") for letter in "XYZC" for axis in "RAS"]
    words = "<MD><Name>Provenance</Name><Value>wb_command -surface-apply-affine</Value></MD>"
    assert "-surface-apply-affine" in said_of(gifti(meta=geometry, root=words))
    assert not said_of(gifti(meta=geometry))
    assert not said_of(gifti(meta=geometry, inside=system((SPACES[1],) * 2), root=words))


def indexed(index, numbers, kind="NIFTI_INTENT_SHAPE"):
    """A surface of 4 points whose numbers belong to some points, and what is shown or said."""
    both = (array(numpy.array(index, numpy.int32), "NIFTI_INTENT_NODE_INDEX")
            + array(numpy.asarray(numbers), kind, meta=[("Name", "thickness")]))
    error, found = fields_walk.outcome(
        "SurfaceReader", "walk.gii", gifti(inside=system(), values=both, count="4"))
    return error or found[1]["thickness"]


def test_an_index_of_points_says_whose_numbers_they_are():
    assert indexed([3, 2, 1, 0], VALUES) == [4, 3, 2, 1]
    assert indexed([3, 2, 1, 0], numpy.array([1, 2, 3, 4], numpy.int32)) == [4, 3, 2, 1]
    numpy.testing.assert_array_equal(indexed([3, 0], VALUES[:2]), [2, numpy.nan, numpy.nan, 1])
    numpy.testing.assert_array_equal(
        indexed([1], VALUES[:1].astype(float)), [numpy.nan, 1, numpy.nan, numpy.nan])
    for index, numbers, words in (
            ([4, 0], VALUES[:2], "with the point 4; it must have each point once, from 0 to 3"),
            ([1, 1], VALUES[:2], "with the point 1; it must have each point once"),
            ([1, 0], VALUES, "has an array of 4 rows beside NIFTI_INTENT_NODE_INDEX of 2"),
            ([1, 0], numpy.array([1, 2], numpy.int32), "for an array of whole numbers")):
        assert words in indexed(index, numbers), (words, indexed(index, numbers))


run_tests(globals())
