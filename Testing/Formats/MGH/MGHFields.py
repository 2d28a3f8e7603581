# SPDX-License-Identifier: BSD-3-Clause
# Proves that each field of a FreeSurfer volume does what the list of fields in README.md says.
import struct

import fields_walk
from brainshift_testing import load_plugin, run_tests

load_plugin()

#: Offset and kind of each field, and its value in the good file.
FIELDS = {"version": (0, "i", 1), "width": (4, "i", 3), "height": (8, "i", 2),
          "depth": (12, "i", 2), "nframes": (16, "i", 2), "type": (20, "i", 4), "dof": (24, "i", 0),
          "goodRASFlag": (28, "h", 1), "spacingX": (30, "f", 1), "spacingY": (34, "f", 1),
          "spacingZ": (38, "f", 1), "xr": (42, "f", 1), "xa": (46, "f", 0), "xs": (50, "f", 0),
          "yr": (54, "f", 0), "ya": (58, "f", 1), "ys": (62, "f", 0), "zr": (66, "f", 0),
          "za": (70, "f", 0), "zs": (74, "f", 1), "cr": (78, "f", 0), "ca": (82, "f", 0),
          "cs": (86, "f", 0)}
FOOTER = {"TR": 2500.0, "FlipAngle": 1.0, "TE": 5.0, "TI": 6.0, "FoV": 256.0}


def mgh(**values):
    header = bytearray(284)
    for name, (offset, kind, value) in FIELDS.items():
        struct.pack_into(">" + kind, header, offset, values.get(name, value))
    footer = b"".join(struct.pack(">f", values.get(name, value)) for name, value in FOOTER.items())
    return bytes(header) + struct.pack(">24h", *range(1, 25)) + footer + values.get("tags", b"")


def changes():
    others = {"version": (0x301, 2), "width": (2,), "height": (1,), "depth": (1,), "nframes": (1,),
              "type": (10,), "goodRASFlag": (0,), "TR": (3000.0, 0.0), "tags": (b"\0\0\0\1text",)}
    for name in ("xa", "xs", "yr", "ys", "zr", "za"):
        others[name] = (0.1,)
    for name in ("cr", "ca", "cs", "spacingX", "spacingY", "spacingZ"):
        others[name] = (5.0,)
    return {name: [mgh(), *(mgh(**{name: value}) for value in others.get(name, (2,)))]
            for name in (*FIELDS, *FOOTER, "tags")}


def read(content):
    return fields_walk.outcome("FreeSurferVolumeReader", "walk.mgh", content)


def test_each_field_does_what_the_list_says():
    fields_walk.walk("MGH", "Fields of the file", changes(), read)


run_tests(globals())
