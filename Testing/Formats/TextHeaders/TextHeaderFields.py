# SPDX-License-Identifier: BSD-3-Clause
# Proves that each field of a NRRD and of a MetaImage header does what the lists of fields in
# README.md say of it.
import zlib

import fields_walk
from brainshift_testing import load_plugin, run_tests, scratch

load_plugin()

NRRD = {"type": "uchar", "dimension": "4", "space": "left-posterior-superior", "sizes": "3 2 2 3",
        "space directions": "(1,0,0) (0,1,0) (0,0,1) none", "kinds": "domain domain domain time",
        "encoding": "raw", "space origin": "(0,0,0)", "spacings": "nan nan nan 2"}
BARE = {"type": "uchar", "dimension": "3", "sizes": "3 2 2", "encoding": "raw"}
FIELD = {"type": "float", "dimension": "4", "space": "left-posterior-superior", "sizes": "3 2 2 2",
         "space directions": "none (1,0,0) (0,1,0) (0,0,1)", "endian": "little", "encoding": "raw",
         "space origin": "(0,0,0)"}
META = {"ObjectType": "Image", "NDims": "3", "BinaryData": "True",
        "TransformMatrix": "-1 0 0 0 -1 0 0 0 1", "Offset": "0 0 0", "ElementSpacing": "1 1 1",
        "DimSize": "3 2 2", "ElementType": "MET_SHORT", "ElementDataFile": "LOCAL"}
NUMBERS = bytes(range(1, 200))


def nrrd(fields, keys=None):
    lines = ["NRRD0005", *(f"{name}: {value}" for name, value in fields.items()),
             *(f"{name}:={value}" for name, value in (keys or {}).items()), "", ""]
    return "\n".join(lines).encode() + NUMBERS


def meta(fields, header=()):
    """`ElementDataFile` comes last, whatever was changed."""
    fields = dict(fields)
    last = fields.pop("ElementDataFile")
    lines = [*header, *(f"{name} = {value}" for name, value in fields.items()),
             f"ElementDataFile = {last}", ""]
    return "\n".join(lines).encode() + NUMBERS


def by(make, base, name, *values):
    """A good file, and one for each other value of a field."""
    return [make(base), *(make({**base, name: value}) for value in values)]


def other_file(name, content):
    with open(scratch(name), "wb") as file:
        file.write(content)
    return name


def nrrd_changes():
    bare = {**BARE, "spacings": "1 1 1"}
    first = {**NRRD, "space directions": "none (1,0,0) (0,1,0) (0,0,1)", "sizes": "3 3 2 2",
             "spacings": "2 nan nan nan"}
    short = {**NRRD, "type": "short", "endian": "little", "sizes": "3 2 2 2"}
    apart = {**BARE, "data file": other_file("walk_numbers.raw", b"\n\n" + NUMBERS)}
    found = {
        "type": by(nrrd, {**BARE, "endian": "little"}, "type", "short", "Int8"),
        "block size": [nrrd(BARE), nrrd({**BARE, "type": "block", "block size": "2"})],
        "dimension": by(nrrd, BARE, "dimension", "2"),
        "sizes": by(nrrd, BARE, "sizes", "2 2 2"),
        "space": by(nrrd, NRRD, "space", "RAS", "left-anterior-superior", "scanner-xyz"),
        "space dimension": by(nrrd, NRRD, "space dimension", "2"),
        "space directions": by(nrrd, NRRD, "space directions", "(2,0,0) (0,1,0) (0,0,1) none"),
        "space origin": by(nrrd, NRRD, "space origin", "(1,0,0)"),
        "space units": by(nrrd, NRRD, "space units", '"um" "um" "um"', '"m" "m" "m"'),
        "measurement frame": by(nrrd, NRRD, "measurement frame", "(0,1,0) (1,0,0) (0,0,1)"),
        "spacings": [*by(nrrd, NRRD, "spacings", "nan nan nan 3"),
                     nrrd({**BARE, "spacings": "2 1 1"})],
        "units": [nrrd(NRRD), nrrd({**NRRD, "units": '"" "" "" "ms"'}),
                  nrrd({**BARE, "units": '"um" "um" "um"'})],
        "axis mins": [nrrd(bare), nrrd({**bare, "axis mins": "5 0 0"}),
                      nrrd({**bare, "axismins": "5 0 0"})],
        "axis maxs": [nrrd(bare), nrrd({**bare, "axis maxs": "9 9 9"})],
        "centers": [nrrd({**bare, "axis mins": "5 0 0"}),
                    nrrd({**bare, "axis mins": "5 0 0", "centers": "node node node"}),
                    nrrd({**bare, "axis mins": "5 0 0", "centerings": "node node node"})],
        "kinds": [nrrd({**first, "kinds": f"{kind} domain domain domain"})
                  for kind in ("vector", "list", "Time")],
        "labels": by(nrrd, bare, "labels", '"t" "x" "y"', '"z" "y" "x"'),
        "thicknesses": by(nrrd, NRRD, "thicknesses", "nan nan 5 nan"),
        "encoding": by(nrrd, BARE, "encoding", "bzip2", "hex"),
        "endian": by(nrrd, short, "endian", "big"),
        "line skip": by(nrrd, apart, "line skip", "1", "2"),
        "byte skip": by(nrrd, apart, "byte skip", "1", "-1"),
        "data file": by(nrrd, apart, "data file", other_file("walk_more.raw", NUMBERS[9:])),
        "old min": by(nrrd, BARE, "old min", "-5"), "old max": by(nrrd, BARE, "old max", "5"),
        "axis N index values": [nrrd(NRRD), nrrd(NRRD, {"axis 3 index values": "0 1 5"})],
        "axis N index type": [nrrd(NRRD, {"axis 3 index values": "0 1 5"}),
                              nrrd(NRRD, {"axis 3 index values": "0 1 5",
                                          "axis 3 index type": "text"})],
        "displacement field type": [nrrd(FIELD),
                                    nrrd(FIELD, {"displacement field type": "modeling"})]}
    for name, value in (("content", "head"), ("number", "12"), ("min", "0"), ("max", "9"),
                        ("sample units", "HU")):
        found[name] = by(nrrd, BARE, name, value)
    return found


def read_nrrd(content):
    is_field = b"type: float" in content
    return fields_walk.outcome("DisplacementFieldReader" if is_field else "NRRDVolumeReader",
                               "walk.nrrd", content)


def test_each_field_of_nrrd_does_what_the_list_says():
    fields_walk.walk("TextHeaders", "Fields of NRRD", nrrd_changes(), read_nrrd)


def meta_changes():
    apart = {**META, "ElementDataFile": other_file("walk_numbers.raw", b"\n\n" + NUMBERS)}
    plain = {name: value for name, value in META.items() if name not in (
        "TransformMatrix", "Offset", "ElementSpacing")}
    series = {**META, "NDims": "4", "DimSize": "3 2 2 3", "ElementSpacing": "1 1 1 2",
              "Offset": "0 0 0 0", "TransformMatrix": "-1 0 0 0 0 -1 0 0 0 0 1 0 0 0 0 1"}
    text = meta({**META, "BinaryData": "False"}).replace(NUMBERS, b"1 2 3 4 5 6 7 8 9 10 11 12")
    packed = meta({**META, "CompressedData": "True"})
    packed = packed[:-len(NUMBERS)] + zlib.compress(NUMBERS[5:])
    found = {
        "NDims": [meta(META), meta(series)],
        "ObjectType": by(meta, META, "ObjectType", "Tube"),
        "DimSize": by(meta, META, "DimSize", "2 2 2"),
        "ElementSpacing": [*by(meta, META, "ElementSpacing", "2 1 1"), meta(series),
                           meta({**series, "ElementSpacing": "1 1 1 3"})],
        "ElementSize": by(meta, plain, "ElementSize", "2 1 1"),
        "Offset": by(meta, META, "Offset", "1 0 0"),
        "Position": by(meta, plain, "Position", "1 0 0"),
        "Origin": by(meta, plain, "Origin", "1 0 0"),
        "TransformMatrix": by(meta, META, "TransformMatrix", "1 0 0 0 1 0 0 0 1"),
        "Rotation": by(meta, plain, "Rotation", "1 0 0 0 1 0 0 0 1"),
        "Orientation": by(meta, plain, "Orientation", "1 0 0 0 1 0 0 0 1"),
        "CenterOfRotation": by(meta, META, "CenterOfRotation", "1 2 3"),
        "AnatomicalOrientation": by(meta, META, "AnatomicalOrientation", "???", "SRP"),
        "DistanceUnits": by(meta, META, "DistanceUnits", "um", "cm"),
        "ElementType": by(meta, META, "ElementType", "MET_USHORT", "MET_UCHAR"),
        "ElementNumberOfChannels": by(meta, META, "ElementNumberOfChannels", "2"),
        "ElementToIntensityFunctionSlope": by(meta, META, "ElementToIntensityFunctionSlope", "2"),
        "ElementToIntensityFunctionOffset": by(meta, META, "ElementToIntensityFunctionOffset", "2"),
        "BinaryData": [meta(META), text],
        "BinaryDataByteOrderMSB": by(meta, META, "BinaryDataByteOrderMSB", "True"),
        "ElementByteOrderMSB": by(meta, META, "ElementByteOrderMSB", "True"),
        "CompressedData": [meta(META), packed],
        "HeaderSize": by(meta, apart, "HeaderSize", "2", "-1"),
        "ElementDataFile": by(meta, apart, "ElementDataFile",
                              other_file("walk_more.raw", NUMBERS[9:])),
        "Comment": by(meta, META, "Comment", "sides of the patient not known")}
    for name, value in (("ObjectSubType", "a"), ("ID", "7"), ("ParentID", "7"), ("Name", "head"),
                        ("Color", "1 0 0 1"), ("Modality", "MET_MOD_CT"), ("ElementMin", "0"),
                        ("ElementMax", "9"), ("CompressedDataSize", "9"), ("SequenceID", "1 1 1"),
                        ("CompressionLevel", "2"), ("TransformType", "Rigid"),
                        ("AcquisitionDate", "2026")):
        found[name] = by(meta, META, name, value)
    return found


def read_meta(content):
    return fields_walk.outcome("MetaImageVolumeReader", "walk.mha", content)


def test_each_field_of_meta_image_does_what_the_list_says():
    fields_walk.walk("TextHeaders", "Fields of MetaImage", meta_changes(), read_meta)


run_tests(globals())
