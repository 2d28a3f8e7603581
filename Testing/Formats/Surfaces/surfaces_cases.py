# SPDX-License-Identifier: BSD-3-Clause
"""Cases of spoiled surfaces and streamlines: each is read by BrainShift and by nibabel.

nibabel does not place surfaces: here two lines of numpy do, by what nibabel finds in the file.
"""

import json
import os
import struct
import warnings
import zipfile

import nibabel
import numpy
import surface_files
from mutation import INTEGERS, REALS, WORDS
from oracle import Open, Wrong

#: mm, and share of the distance from the origin: streamlines are float32.
PLACE, ROUNDING = 1e-3, 1e-6
WORDS_OF_GIFTI = [*WORDS, "NIFTI_TYPE_UINT8", "NIFTI_TYPE_FLOAT64", "ASCII", "GZipBase64Binary",
                  "Base64Binary", "BigEndian", "4", "2147483647"]


def _image(random):
    return random.choice(list(surface_files.volumes()))


def freesurfer(random, name):
    image = _image(random)
    valid = random.choice(["1  # volume info valid", "1", "0"])
    surface_files.write_surface(name, surface_files.geometry(image, valid))


def read_freesurfer(name):
    points, triangles, info = nibabel.freesurfer.read_geometry(name, read_metadata=True)
    if "cras" not in info:
        raise Open("no geometry")
    if len(info["head"]) == 3 and info["head"][1] != 0:
        return points, triangles
    x, y, z = (numpy.asarray(info[key], float) for key in ("xras", "yras", "zras"))
    if info["valid"].split("#")[0].strip() != "1":
        raise Open("not valid")
    return points @ numpy.array([-x, z, -y]) + info["cras"], triangles


def gifti(random, name):
    encoding = random.choice(["ASCII", "B64BIN", "B64GZ"])
    start, end = random.choice([("SCANNER_ANAT", "SCANNER_ANAT"), ("UNKNOWN", "SCANNER_ANAT"),
                                ("UNKNOWN", "ALIGNED_ANAT"), ("TALAIRACH", "TALAIRACH")])
    matrix = surface_files.scanner_from_surface(_image(random))
    system = nibabel.gifti.GiftiCoordSystem(f"NIFTI_XFORM_{start}", f"NIFTI_XFORM_{end}", matrix)
    arrays = surface_files.gifti_arrays(system, f"GIFTI_ENCODING_{encoding}")
    if random.random() < 0.5:
        arrays.append(surface_files.data_array(
            numpy.arange(4, dtype=numpy.float32), "NIFTI_INTENT_SHAPE", meta={"Name": "depth"}))
    surface_files.write_gifti(name, arrays)


def read_gifti(name):
    image = nibabel.load(name)
    found = [image.get_arrays_from_intent(f"NIFTI_INTENT_{word}") for word in (
        "POINTSET", "TRIANGLE")]
    if not all(found):
        raise Wrong("no points or no triangles")
    points, triangles = (arrays[0].data for arrays in found)
    system = found[0][0].coordsys
    spaces = nibabel.nifti1.xform_codes
    start, end = (spaces.label[code] for code in (system.dataspace, system.xformspace))
    leads = end == "scanner" or end == "aligned" and start != "aligned"
    if start == "scanner" or not leads:
        return points, triangles
    return surface_files.moved(system.xform, points), triangles


def tracts(random, name):
    numbers = numpy.random.default_rng(random.randrange(1 << 30))
    lines = [numbers.uniform(-90, 90, (random.randrange(1, 6), 3)).astype(numpy.float32)
             for _ in range(random.randrange(1, 5))]
    named = {}
    if name.endswith(".trk") and random.random() < 0.5:
        named["data_per_point"] = {"fa": [line[:, :1] for line in lines]}
        named["data_per_streamline"] = {"length": numpy.ones((len(lines), 2), numpy.float32)}
    surface_files.write_tracts(name, lines, _image(random), **named)


def read_tracts(name):
    with open(name, "rb") as file:
        if name.endswith(".tck") and struct.pack("<3f", *3 * [numpy.inf]) in file.read()[:-12]:
            raise Open("nibabel reads on after the three infinite numbers that end a file")
    lines = list(nibabel.streamlines.load(name).streamlines)
    return numpy.concatenate([numpy.zeros((0, 3)), *lines]), [len(line) for line in lines]


def trx(random, name):
    numbers = numpy.random.default_rng(random.randrange(1 << 30))
    counts = [random.randrange(1, 6) for _ in range(random.randrange(1, 5))]
    points = numbers.uniform(-90, 90, (sum(counts), 3)).astype("<f4")
    header = {"DIMENSIONS": [9, 9, 9], "VOXEL_TO_RASMM": numpy.eye(4).tolist(),
              "NB_VERTICES": len(points), "NB_STREAMLINES": len(counts)}
    method = random.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))
    with zipfile.ZipFile(name, "w", method) as archive:
        archive.writestr("header.json", json.dumps(header))
        archive.writestr("positions.3.float32", points.tobytes())
        archive.writestr("offsets.uint64", numpy.cumsum([0, *counts]).astype("<u8").tobytes())
        archive.writestr("dpv/fa.float16", numpy.ones(len(points), "<f2").tobytes())
        archive.writestr("groups/CST.uint32", numpy.zeros(1, "<u4").tobytes())


def read_trx(name):
    with zipfile.ZipFile(name) as archive:
        header = json.loads(archive.read("header.json"))
        points = numpy.frombuffer(archive.read("positions.3.float32"), "<f4").reshape(-1, 3)
        firsts = numpy.frombuffer(archive.read("offsets.uint64"), "<u8").astype(numpy.int64)
    if (len(points), len(firsts) - 1) != (header["NB_VERTICES"], header["NB_STREAMLINES"]):
        raise Wrong("other sizes than the header announces")
    return points.astype(float), numpy.diff(firsts).tolist()


#: By the name of a file: what makes it, the second reader, and our reader.
FORMATS = {"lh.pial": (freesurfer, read_freesurfer, "SurfaceReader"),
           "case.surf.gii": (gifti, read_gifti, "SurfaceReader"),
           "case.trk": (tracts, read_tracts, "TractReader"),
           "case.tck": (tracts, read_tracts, "TractReader"),
           "case.trx": (trx, read_trx, "TractReader")}


def _spoil(random, name, data):
    """Another byte, number or word, a line twice or gone, or an end too early."""
    change = random.random()
    place = random.randrange(max(1, len(data)))
    if change < 0.2:
        return data[:place] + bytes([random.randrange(256)]) + data[place + 1:]
    if change < 0.3:
        return data[:place] if random.random() < 0.7 else data + bytes(random.randrange(1, 40))
    if change < 0.6 and not name.endswith(".gii"):
        number = random.choice([struct.pack("<f", min(max(random.choice(REALS), -1e38), 1e38)),
                                struct.pack("<i", random.choice(INTEGERS)),
                                struct.pack(">i", random.choice(INTEGERS)),
                                struct.pack("<i", 2**31 - 1)])
        place -= place % 4 if name.endswith(".trk") else 0
        return data[:place] + number + data[place + 4:]
    lines = data.split(b"\n")
    which = random.randrange(len(lines))
    if change < 0.9:
        marks = b'"' if name.endswith(".gii") and b'="' in lines[which] else b" "
        words = lines[which].split(marks)
        words[random.randrange(len(words))] = random.choice(WORDS_OF_GIFTI).encode()
        lines[which] = marks.join(words)
    else:
        lines[which:which + 1] = [lines[which]] * random.choice([0, 2])
    return b"\n".join(lines)


def _answer(name, path):
    try:
        with warnings.catch_warnings(), numpy.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return FORMATS[name][1](path)
    except (Open, Wrong):
        raise
    except Exception as error:  # whatever nibabel stumbles over
        raise Wrong(f"{type(error).__name__}: {str(error).splitlines()[:1]}"[:120]) from error


def _misplaced(data, points, cells):
    """What is wrong with our data beside the second reader's; None if nothing is."""
    if data.GetNumberOfPoints() != len(points):
        return f"{data.GetNumberOfPoints()} points in place of {len(points)}"
    if len(points) == 0:
        return None
    found = surface_files.points_of(data)
    allowed = PLACE + ROUNDING * numpy.abs(points)
    if not (numpy.abs(found - points) <= allowed).all():
        return f"{found.tolist()} in place of {points.tolist()}"
    if data.GetNumberOfLines():
        counts = [len(line) for line in surface_files.lines_of(data)]
        return None if counts == [count for count in cells if count] else f"lines of {counts}"
    triangles = surface_files.triangles_of(data)
    same = triangles.shape == numpy.shape(cells) and (
        numpy.sort(triangles, axis=1) == numpy.sort(cells, axis=1)).all()
    return None if same else f"{triangles.tolist()} in place of {cells.tolist()}"


class Cases:
    """Reads spoiled files, one for each case."""

    def __init__(self, folder):
        self.folder = folder

    def run(self, random):
        """What became of one file: a word, and a sentence if it is a finding."""
        from brainshift_testing import messages, output
        from paraview import simple
        name = random.choice(sorted(FORMATS))
        path = os.path.join(self.folder, name)
        FORMATS[name][0](random, path)
        with open(path, "rb") as file:
            data = file.read()
        for _ in range(random.choice([0, 1, 1, 1, 2, 3])):
            data = _spoil(random, name, data)
        with open(path, "wb") as file:
            file.write(data)
        reader = getattr(simple, FORMATS[name][2])(FileName=path)
        with messages() as said:
            found = output(reader)
        simple.Delete(reader)
        if "ERROR" in said.text:
            return "misplaced: half a surface" if found.GetNumberOfPoints() else "refused"
        if found.GetNumberOfCells() and found.GetNumberOfPoints() == 0:
            return "misplaced: cells without points"
        try:
            wrong = _misplaced(found, *_answer(name, path))
        except Open:
            return "told" if said.text else "open"
        except Wrong as error:
            return "told" if said.text else f"accepted: {name}: {error}"
        if wrong is None:
            return "same"
        return "told" if said.text else f"misplaced: {name}: {wrong}"
