# SPDX-License-Identifier: BSD-3-Clause
# Proves that each field of a NIfTI header does what the list of fields in README.md says of it.
import struct

import fields_walk
import numpy
from brainshift_testing import load_plugin, run_tests

load_plugin()

SHAPE = (4, 3, 2)
LABELS = (b'<CaretExtension><LabelTable><Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">'
          b'<![CDATA[one]]></Label></LabelTable></CaretExtension>')
FLOAT = 16
VECTOR = {"dim": (5, *SHAPE, 1, 3, 1, 1), "datatype": (FLOAT,), "bitpix": (32,)}

#: Offset and kind of each field, and its value in the good file.
FIELDS = {
    "sizeof_hdr": (0, "i", 348), "data_type": (4, "10s", b""), "db_name": (14, "18s", b""),
    "extents": (32, "i", 0), "session_error": (36, "h", 0), "regular": (38, "c", b"r"),
    "dim_info": (39, "B", 0), "dim": (40, "8h", 4, *SHAPE, 3, 1, 1, 1), "intent_p1": (56, "f", 0),
    "intent_p2": (60, "f", 0), "intent_p3": (64, "f", 0), "intent_code": (68, "h", 0),
    "datatype": (70, "h", 4), "bitpix": (72, "h", 16), "slice_start": (74, "h", 0),
    "pixdim": (76, "8f", 1, 1, 1, 1, 2, 0, 0, 0), "vox_offset": (108, "f", 352),
    "scl_slope": (112, "f", 1), "scl_inter": (116, "f", 0), "slice_end": (120, "h", 0),
    "slice_code": (122, "B", 0), "xyzt_units": (123, "B", 10), "cal_max": (124, "f", 0),
    "cal_min": (128, "f", 0), "slice_duration": (132, "f", 0), "toffset": (136, "f", 0),
    "glmax": (140, "i", 0), "glmin": (144, "i", 0), "descrip": (148, "80s", b""),
    "aux_file": (228, "24s", b""), "qform_code": (252, "h", 0), "sform_code": (254, "h", 1),
    "quatern_b": (256, "f", 0), "quatern_c": (260, "f", 0), "quatern_d": (264, "f", 0),
    "qoffset_x": (268, "f", 0), "qoffset_y": (272, "f", 0), "qoffset_z": (276, "f", 0),
    "srow_x": (280, "4f", 1, 0, 0, 0), "srow_y": (296, "4f", 0, 1, 0, 0),
    "srow_z": (312, "4f", 0, 0, 1, 0), "intent_name": (328, "16s", b""),
    "magic": (344, "4s", b"n+1"),
    "extension": (348, "4s", b"")}


def nifti(skip=0, **values):
    """The bytes of a file. `skip`: bytes between header and voxels, which may be an extension."""
    extra = skip if isinstance(skip, bytes) else bytes(skip)
    header = bytearray(352) + extra
    for name, (offset, kind, *value) in FIELDS.items():
        struct.pack_into("<" + kind, header, offset, *values.get(name, value))
    return bytes(header) + numpy.arange(1, 145, dtype="<i2").tobytes() + bytes(512)


def by(base, **changed):
    """A good file, and one with other values of one field."""
    (name, others), = changed.items()
    return [nifti(**base), *(nifti(**{**base, name: other}) for other in others)]


def changes():
    qform = {"sform_code": (0,), "qform_code": (1,)}
    named = {**VECTOR, "intent_code": (1007,), "intent_name": (b"NREG_TRANS",), "intent_p1": (1,)}
    label = struct.pack("<2i", 8 + len(LABELS) + 7 - (len(LABELS) + 7) % 16, 30) + LABELS
    label += bytes(-len(label) % 16)
    label = struct.pack("<i", len(label)) + label[4:]
    offset = {"skip": label, "vox_offset": (352 + len(label),)}
    found = {
        "dim": by({}, dim=[(3, *SHAPE, 1, 1, 1, 1), (4, 3, 4, 2, 3, 1, 1, 1)]),
        "datatype": by({}, datatype=[(512,), (2,)]), "bitpix": by({}, bitpix=[(8,)]),
        "pixdim": [*by(qform, pixdim=[(-1, 1, 1, 1, 2, 0, 0, 0), (1, 5, 1, 1, 2, 0, 0, 0),
                                      (1, 1, 1, 0, 2, 0, 0, 0), (1, 1, 1, 1, 3, 0, 0, 0),
                                      (1, 1, 1, 1, -2, 0, 0, 0)])],
        "vox_offset": [nifti(skip=16), nifti(skip=16, vox_offset=(368,))],
        "scl_slope": by({}, scl_slope=[(2,)]), "scl_inter": by({}, scl_inter=[(5,)]),
        "xyzt_units": by({}, xyzt_units=[(11,), (18,), (34,), (13,), (138,)]),
        "toffset": by({}, toffset=[(7,)]),
        "descrip": by({}, descrip=[(b"BrainShift, sides of the patient not known",)]),
        "qform_code": by({**qform, "qform_code": (0,), "qoffset_x": (9,)}, qform_code=[(1,)]),
        "sform_code": by({"qoffset_x": (9,), "qform_code": (1,)}, sform_code=[(0,)]),
        "intent_code": [nifti(**{**VECTOR, "intent_code": (1006,)}),
                        nifti(**{**VECTOR, "intent_code": (1007,)})],
        "intent_name": [nifti(**{**VECTOR, "intent_code": (1006,)}),
                        nifti(**{**VECTOR, "intent_code": (1006,), "intent_name": (b"forward",)})],
        "intent_p1": [nifti(**named), nifti(**{**named, "intent_p1": (0,)})],
        "magic": by({}, magic=[(b"n+3",)]),
        "extension": [nifti(**offset), nifti(**offset, extension=(b"\1",))]}
    for name in ("quatern_b", "quatern_c", "quatern_d"):
        found[name] = by(qform, **{name: [(0.5,)]})
    for name in ("qoffset_x", "qoffset_y", "qoffset_z"):
        found[name] = by(qform, **{name: [(12,)]})
    for name in ("srow_x", "srow_y", "srow_z"):
        found[name] = by({}, **{name: [(*FIELDS[name][2:5], 12)]})
    for name in FIELDS:
        if name not in found:
            text = FIELDS[name][1].endswith(("s", "c"))
            found[name] = by({}, **{name: [(b"a",) if text else (3,)]})
    return found


def read(content):
    is_field = struct.unpack_from("<h", content, 68)[0] in (1006, 1007)
    proxy = "DisplacementFieldReader" if is_field else "NIFTIVolumeReader"
    return fields_walk.outcome(proxy, "walk.nii", content)


def test_each_field_does_what_the_list_says():
    fields_walk.walk("NIFTI", "Fields of the header", changes(), read)


run_tests(globals())
