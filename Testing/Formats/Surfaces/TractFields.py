# SPDX-License-Identifier: BSD-3-Clause
# Proves that each field of TrackVis, MRtrix and FreeSurfer's surfaces does what the lists of fields
# in README.md say.
import struct

import fields_walk
from brainshift_testing import load_plugin, run_tests

load_plugin()

#: Offset, kind and good value of each field of TrackVis. The first axis is turned around.
TRACKVIS = {"TRACK": (0, "6s", b"TRACK"), "dim": (6, "3h", (10, 12, 14)),
            "voxel_size": (12, "3f", (1, 1, 2)), "origin": (24, "3f", (0, 0, 0)),
            "n_scalars": (36, "h", 1), "scalar_name": (38, "20s", b"fa"),
            "n_properties": (238, "h", 1), "property_name": (240, "20s", b"length"),
            "vox_to_ras": (440, "16f", (1, 0, 0, 3, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1)),
            "reserved": (504, "444s", b""), "voxel_order": (948, "4s", b"LAS"),
            "pad2": (952, "4s", b""), "image_orientation_patient": (956, "6f", (0,) * 6),
            "pad1": (980, "2s", b""), "n_count": (988, "i", 2), "version": (992, "i", 2),
            "header size": (996, "i", 1000)}
TURNS = ("invert_x", "invert_y", "invert_z", "swap_xy", "swap_yz", "swap_zx")
TRACKVIS.update({name: (982 + i, "B", 0) for i, name in enumerate(TURNS)})


def trackvis(**values):
    header = bytearray(1000)
    for name, (offset, kind, good) in TRACKVIS.items():
        value = values.get(name, good)
        numbers = value if isinstance(value, tuple) else (value,)
        struct.pack_into("<" + kind, header, offset, *numbers)
    return bytes(header) + (struct.pack("<i4f4ff", 2, 1, 2, 3, 0.5, 2, 3, 4, 0.6, 9.0)
                            + struct.pack("<i4ff", 1, 4, 5, 6, 0.7, 8.0))


def trackvis_changes():
    others = {"TRACK": (b"TRICK",), "dim": ((11, 12, 14),), "voxel_size": ((1, 2, 2),),
              "origin": ((1, 2, 3),), "scalar_name": (b"md",), "property_name": (b"size",),
              "vox_to_ras": ((1, 0, 0, 4, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1),),
              "reserved": (b"text",), "voxel_order": (b"RAS", b""), "pad2": (b"LPS",),
              "pad1": (b"xy",), "image_orientation_patient": ((0, 1, 0, 1, 0, 0),),
              "n_count": (1,), "version": (1,), "header size": (999, 348)}
    changes = {name: [trackvis(), *(trackvis(**{name: value}) for value in others.get(name, (1,)))]
               for name in TRACKVIS}
    # Fewer numbers of a point or streamline: as many points, other bytes.
    for name in ("n_scalars", "n_properties"):
        changes[name][1] = trackvis(**{name: 0})[:1000] + without(name)
    return changes


def without(name):
    if name == "n_scalars":
        return (struct.pack("<i6ff", 2, 1, 2, 3, 2, 3, 4, 9.0)
                + struct.pack("<i3ff", 1, 4, 5, 6, 8.0))
    return struct.pack("<i8f", 2, 1, 2, 3, 0.5, 2, 3, 4, 0.6) + struct.pack("<i4f", 1, 4, 5, 6, 0.7)


def mrtrix(magic="mrtrix tracks", end="END", last=("inf",) * 3, split="nan", **values):
    keys = {"timestamp": "1", "count": "2", "datatype": "Float32LE", "file": ". 200", **values}
    head = "\n".join([magic, *(f"{key}: {value}" for key, value in keys.items()), end]) + "\n"
    rows = [(1, 2, 3), (2, 3, 4), (float(split),) * 3, (4, 5, 6), (float("nan"),) * 3,
            tuple(map(float, last))]
    numbers = [number for row in rows for number in row]
    return head.encode().ljust(200, b"\0") + struct.pack(f"<{len(numbers)}f", *numbers)


def mrtrix_changes():
    good = mrtrix()
    changes = {"mrtrix tracks": mrtrix(magic="mrtrix image "), "file": mrtrix(file=". 212"),
               "datatype": mrtrix(datatype="Int32LE"), "count": mrtrix(count="3"),
               "timestamp": mrtrix(timestamp="2"), "roi": mrtrix(roi="seed a.mif"),
               "step_size": mrtrix(step_size="0.5"), "command_history": mrtrix(command_history="x"),
               "END": mrtrix(end="and"), "NaN": mrtrix(split="5"),
               "three infinite numbers": mrtrix(last=("nan",) * 3)}
    return {name: [good, other] for name, other in changes.items()}


def surface(magic=b"\xff\xff\xfe", text="created by me", counts=(4, 2), real=0, **values):
    geometry = {"valid": "1  # volume info valid", "filename": "orig.mgz", "volume": "256 256 256",
                "voxelsize": "1 1 1", "xras": "-1 0 0", "yras": "0 0 -1", "zras": "0 1 0",
                "cras": "5 6 7", **values}
    points = values.pop("coordinates", (0, 0, 0, 9, 0, 0, 0, 9, 0, 0, 0, 9))
    corners = values.pop("corners", (0, 1, 2, 0, 1, 3))
    lines = "".join(f"{key} = {value}\n" for key, value in geometry.items()
                    if key not in ("coordinates", "corners"))
    return (magic + text.encode() + b"\n\n" + struct.pack(">2i", *counts)
            + struct.pack(">12f", *points) + struct.pack(">6i", *corners)
            + struct.pack(">2i", 2, real) + struct.pack(">i", 20) + lines.encode())


def surface_changes():
    good = surface()
    changes = {"FF FF FE": surface(magic=b"\xff\xff\xf0"), "created by": surface(text="another"),
               "points": surface(counts=(4000, 2)), "triangles": surface(counts=(4, 2000)),
               "coordinates": surface(coordinates=(0, 0, 1, 9, 0, 0, 0, 9, 0, 0, 0, 9)),
               "corners": surface(corners=(0, 1, 2, 1, 2, 3)), "useRealRAS": surface(real=1),
               "valid": surface(valid="0"), "filename": surface(filename="T1.mgz"),
               "volume": surface(volume="128 128 128"), "voxelsize": surface(voxelsize="2 2 2"),
               "xras": surface(xras="1 0 0", yras="0 0 1"),
               "yras": surface(yras="0 0 1", xras="1 0 0"),
               "zras": surface(zras="0 -1 0", xras="1 0 0"), "cras": surface(cras="5 6 8")}
    return {name: [good, other] for name, other in changes.items()}


def test_each_field_of_trackvis_does_what_the_list_says():
    fields_walk.walk("TrackVis", "Fields of the header", trackvis_changes(),
                     lambda content: fields_walk.outcome("TractReader", "walk.trk", content))


def test_each_field_of_mrtrix_does_what_the_list_says():
    fields_walk.walk("MRtrix", "Fields of the file", mrtrix_changes(),
                     lambda content: fields_walk.outcome("TractReader", "walk.tck", content))


def test_a_key_of_mrtrix_that_occurs_twice_is_refused():
    for key, value in (("datatype", "Float32BE"), ("count", "3"), ("file", ". 100")):
        error, _ = fields_walk.outcome(
            "TractReader", "walk.tck", mrtrix(end=f"{key}: {value}\nEND"))
        assert f'has the line "{key}:" twice' in error, error
    for lines in ("roi: a\nroi: b\nEND", "count: 2\nEND"):
        assert not fields_walk.outcome("TractReader", "walk.tck", mrtrix(end=lines))[0]


def test_each_field_of_a_freesurfer_surface_does_what_the_list_says():
    fields_walk.walk("FreeSurfer", "Fields of a surface", surface_changes(),
                     lambda content: fields_walk.outcome("SurfaceReader", "walk.pial", content))


run_tests(globals())
