# SPDX-License-Identifier: BSD-3-Clause
"""The files that libFuzzer begins with: those of Testing/Data, and those that the cases of
./brainshift fuzz make, spoiled or not. Frames, folders and messages get a form of their own."""

import glob
import hashlib
import os
import struct
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
TESTING = os.path.join(HERE, "..", "..")
DATA = os.path.join(TESTING, "Data")
#: Kinds of ./brainshift fuzz that make files, and how many of each: enough to meet each variety.
KINDS = ("dicom", "files", "frames", "hostile", "like", "points", "segments", "surfaces",
         "transforms", "zarr")
COUNT, SEED = 60, 43
#: Transfer syntaxes, by how they begin.
FRAMES = {"1.2.840.10008.1.2.4.5": "jpeg", "1.2.840.10008.1.2.4.7": "jpeg",
          "1.2.840.10008.1.2.4.8": "jpegls", "1.2.840.10008.1.2.4.9": "jpeg2000",
          "1.2.840.10008.1.2.5": "rle", "1.2.840.10008.1.2.8.1": "deflated"}


def files_below(folder):
    """(path below the folder, bytes) of all files."""
    for place, _, names in os.walk(folder):
        for name in sorted(names):
            path = os.path.join(place, name)
            with open(path, "rb") as file:
                yield os.path.relpath(path, folder), file.read()


def packed(files):
    """The bytes of a folder: folderOf in CaseFile.cxx unpacks them."""
    named = [(name.encode(), data) for name, data in files]
    return b"".join(bytes([len(name)]) + name + struct.pack("<H", len(data)) + data
                    for name, data in named if len(name) < 256 and len(data) < 65536)


def frames_of(name, path):
    """The packed frames of a DICOM file, each after its columns, rows and bytes of a number."""
    import pydicom
    try:
        image = pydicom.dcmread(path)
        kind = next(kind for syntax, kind in FRAMES.items()
                    if image.file_meta.TransferSyntaxUID.startswith(syntax))
        shape = struct.pack("<HHB", image.Columns, image.Rows, image.BitsAllocated // 8)
        for frame in pydicom.encaps.generate_pixel_data_frame(image.PixelData, 1):
            yield f"{name}.{kind}", shape + frame
    except Exception:  # of many kinds: a spoiled file has no frames
        return


def folders_of(path, data):
    """The files of a zip file, as those of a folder."""
    try:
        with zipfile.ZipFile(path) as archive:
            return packed([(name, archive.read(name)) for name in archive.namelist()])
    except Exception:  # of many kinds, as above
        return data


def pointer_files():
    """Messages of a server, and a session: no other case makes them."""
    def header(kind, version, body):
        return struct.pack(">H12s20sQQQ", version, kind, b"pointer", 0, len(body), 0) + body
    pose = struct.pack(">12f", 1, 0, 0, 0, 1, 0, 0, 0, 1, 10, -20, 30)
    yield "transform.message", header(b"TRANSFORM", 1, pose)
    tool = struct.pack(">20sBB12f", b"stylus", 1, 0, *struct.unpack(">12f", pose))
    yield "tools.message", header(b"TDATA", 1, tool + tool)
    meta = struct.pack(">HHHI", 1, 13, 3, 2) + b"StylusStatusOK"
    yield "metadata.message", header(
        b"TRANSFORM", 2, struct.pack(">HHII", 12, 10, 14, 7) + pose + meta)


def sessions():
    """Recorded sessions, as Documentation/tools/pointer.md describes them."""
    lines = ["# BrainShift pointer session 1", "# image from tracker 1 0 0 5 0 1 0 -6 0 0 1 7",
             "0.0 stylus 1 0 0 10 0 1 0 -20 0 0 1 30", "0.5 stylus 1 0 0 11 0 1 0 -20 0 0 1 30"]
    text = "\n".join(lines).replace(" ", "\t")
    for words in (lines[0], "# image from tracker"):
        text = text.replace(words.replace(" ", "\t"), words)
    yield "pointer.session", f"{text}\n".encode()


def digest():
    """Of what the files are made of: the cases, what they import, and Testing/Data."""
    found = hashlib.sha256()
    for place in ("Fuzz", "Formats", "Support", "Data"):
        for name, data in sorted(files_below(os.path.join(TESTING, place))):
            if place == "Data" or name.endswith(".py"):
                found.update(repr((place, name, hashlib.sha256(data).digest())).encode())
    return found.hexdigest()[:12]


def made_by_cases(folder):
    """Keeps the files of the cases; exits if a kind left none. Findings are for ./brainshift fuzz
    to report: its exit status says nothing on the files."""
    made = subprocess.run(
        [sys.executable, "-B", os.path.join(HERE, "..", "fuzz.py"), "--count", str(COUNT),
         "--seed", str(SEED), "--keep", folder, *(f"--kind={kind}" for kind in KINDS)],
        stdout=subprocess.PIPE, text=True, errors="replace", check=False)
    empty = [kind for kind in KINDS if not any(
        os.path.isfile(each) for each in glob.iglob(
            os.path.join(glob.escape(folder), f"{kind}-*", "**"), recursive=True))]
    if empty:
        sys.exit(f"The cases of {', '.join(empty)} left no files to begin with:\n{made.stdout}")


def gathered():
    """(name, bytes) of all files to begin with."""
    yield from pointer_files()
    yield from sessions()
    with tempfile.TemporaryDirectory(prefix="brainshift-seeds-") as folder:
        made_by_cases(folder)
        for place in (DATA, folder):
            for name, data in files_below(place):
                path = os.path.join(place, name)
                yield name, data
                if name.endswith(".dcm"):
                    yield from frames_of(name, path)
                if name.endswith((".trx", ".zip")):
                    ending = ".trx" if name.endswith(".trx") else ".zarr"
                    yield f"{name}{ending}.files", folders_of(path, data)
            for case, _, _ in os.walk(place):
                if case.endswith(".zarr"):
                    yield f"{case}.files", packed(files_below(case))
