# SPDX-License-Identifier: BSD-3-Clause
"""Bundles of 3D Slicer (.mrb): zip files of a scene and its data, unpacked and packed."""

import os
import shutil
import stat
import struct
import tempfile
import zipfile
import zlib

from .mrml import SceneProblem, shown

#: What a bundle may have. Deflate packs 1032 bytes into one at most.
MOST_FILES, MOST_RATIO, SMALL, SPARE = 20_000, 1100, 2**20, 2**30

#: Marks folders that were made for a scene, so that they may be filled again.
MARK = ".brainshift-scene"

#: What zipfile raises for damaged files.
_FAULTS = (OSError, ValueError, EOFError, RuntimeError, OverflowError, zipfile.BadZipFile,
           zlib.error, struct.error)

_CHUNK = 2**20
_PACKED = (".gz", ".nrrd", ".mgz", ".h5", ".jpg", ".png")


def folder_for(path, folder):
    """A folder for what a scene unpacks to or needs; and a note, or None. `folder`: the one that
    the caller names, or None for one beside the scene."""
    if folder is not None:
        os.makedirs(folder, exist_ok=True)
        return os.path.abspath(folder), None
    beside = os.path.splitext(os.path.abspath(path))[0] + "-opened"
    for name in (beside, *(f"{beside} {number}" for number in range(2, 100))):
        try:
            if not os.path.isdir(name) or not os.listdir(name):
                os.makedirs(name, exist_ok=True)
                with open(os.path.join(name, MARK), "w", encoding="utf-8"):
                    pass
                return name, None
        except OSError:
            break
        if os.path.isfile(os.path.join(name, MARK)) and os.access(name, os.W_OK):
            return name, None
    made = tempfile.mkdtemp(prefix="brainshift-scene-")
    return made, (f"Files of the scene are in {made}, because nothing can be written beside it. "
                  "Name a folder to keep, or saved states will not find them.")


def _name(entry):
    """The name of an entry. Zip files of Slicer do not say that they are in UTF-8."""
    if entry.flag_bits & 0x800:
        return entry.filename
    try:
        return entry.filename.encode("cp437").decode("utf-8")
    except UnicodeError:
        return entry.filename


def _require_good(entry, name):
    """Raises the end of a sentence for an entry that must not be unpacked."""
    parts = name.replace("\\", "/").split("/")
    if name.startswith(("/", "\\")) or ".." in parts or ":" in parts[0] or "\0" in name:
        raise SceneProblem("leads out of the bundle")
    if stat.S_ISLNK(entry.external_attr >> 16):
        raise SceneProblem("is a link")
    if entry.flag_bits & 1:
        raise SceneProblem("is encrypted")
    if entry.file_size > MOST_RATIO * entry.compress_size + SMALL:
        raise SceneProblem(f"announces {entry.file_size} bytes from {entry.compress_size}")


def _unpack(bundle, entry, path):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with bundle.open(entry) as packed, open(path + ".part", "wb") as file:
        shutil.copyfileobj(packed, file, _CHUNK)
    os.replace(path + ".part", path)


def unpack(path, folder):
    """Unpacks a bundle. Returns the path of its scene, and sentences on what was left out."""
    notes, scenes, taken = [], [], set()
    try:
        opened = zipfile.ZipFile(path)
    except _FAULTS as problem:
        raise SceneProblem(f"cannot be read: {shown(problem)}") from problem
    with opened as bundle:
        entries = [entry for entry in bundle.infolist() if not entry.is_dir()]
        total = sum(entry.file_size for entry in entries)
        free = shutil.disk_usage(folder).free - SPARE
        if len(entries) > MOST_FILES:
            raise SceneProblem(f"has {len(entries)} files; a bundle may have {MOST_FILES}")
        if total > free:
            raise SceneProblem(f"unpacks to {total} bytes, and {max(free, 0)} are free in {folder}")
        for entry in entries:
            name = _name(entry)
            try:
                _require_good(entry, name)
                target = os.path.join(folder, *name.replace("\\", "/").split("/"))
                if target in taken:
                    raise SceneProblem("is there twice; the first counts")
                taken.add(target)
                _unpack(bundle, entry, target)
            except _FAULTS as problem:
                subject = "it " if isinstance(problem, SceneProblem) else ""
                notes.append(f"File {shown(name)} of the bundle is not unpacked: "
                             f"{subject}{shown(problem)}.")
                continue
            if name.lower().endswith(".mrml"):
                scenes.append(target)
    scenes.sort(key=lambda each: each.count(os.sep))
    if not scenes:
        raise SceneProblem("holds no scene (.mrml)" + "".join(" " + note for note in notes[:1]))
    if len(scenes) > 1:
        notes.append(f"The bundle has {len(scenes)} scenes; {os.path.basename(scenes[0])} is "
                     "opened.")
    return scenes[0], notes


def pack(folder, path):
    """Packs a folder as a bundle, which takes the place of an old one when it is whole."""
    with zipfile.ZipFile(path + ".part", "w", zipfile.ZIP_DEFLATED) as bundle:
        for root, _, names in sorted(os.walk(folder)):
            for name in sorted(names):
                file = os.path.join(root, name)
                inside = os.path.relpath(file, os.path.dirname(folder))
                kind = zipfile.ZIP_STORED if name.endswith(_PACKED) else zipfile.ZIP_DEFLATED
                bundle.write(file, inside, kind)
    os.replace(path + ".part", path)
