# SPDX-License-Identifier: BSD-3-Clause
"""Bundles of 3D Slicer (.mrb): zip files of a scene and its data, unpacked and packed."""

import contextlib
import hashlib
import os
import re
import shutil
import stat
import struct
import tempfile
import zipfile
import zlib

from .mrml import SceneClause, SceneProblem, shown

try:
    from lzma import LZMAError
except ImportError:  # zipfile then refuses what is packed so
    LZMAError = zlib.error

#: What a bundle may have. Deflate packs 1032 bytes into one at most.
MOST_FILES, MOST_RATIO, SMALL, SPARE = 20_000, 1100, 2**20, 2**30

#: Marks folders that were made for a scene, so that they may be filled again. It holds the digest
#: of a bundle, so that files of another one are never taken for its own.
MARK = ".brainshift-scene"

#: What names of a bundle's files must not have: Windows would put the file elsewhere.
_ELSEWHERE = re.compile(r":|[ .]$")

#: What zipfile raises for damaged files.
_FAULTS = (OSError, ValueError, EOFError, RuntimeError, OverflowError, zipfile.BadZipFile,
           zlib.error, struct.error, LZMAError)

_CHUNK = 2**20
_PACKED = (".gz", ".nrrd", ".mgz", ".h5", ".jpg", ".png")


def _digest(path):
    """The digest of a bundle; empty for a scene that is none."""
    if not path.lower().endswith(".mrb"):
        return ""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while chunk := file.read(_CHUNK):
            digest.update(chunk)
    return digest.hexdigest()


def _taken(folder, digest, needed):
    """Whether a folder is empty, new or of the same scene; then it is there and marked. Raises the
    end of a sentence if a folder that is to be filled has no room for `needed` bytes."""
    mark = os.path.join(folder, MARK)
    if os.path.isdir(folder) and os.listdir(folder):
        if not os.path.isfile(mark) or not os.access(folder, os.W_OK):
            return False
        with open(mark, encoding="utf-8", errors="replace") as file:
            return file.read(len(digest) + 1) == digest
    _require_room(folder, needed)
    os.makedirs(folder, exist_ok=True)
    with open(mark, "w", encoding="utf-8") as file:
        file.write(digest)
    return True


def _require_room(folder, needed):
    there = folder
    while not os.path.isdir(there):
        there = os.path.dirname(there)
    free = max(shutil.disk_usage(there).free - SPARE, 0)
    if needed > free and os.access(there, os.W_OK):
        raise SceneProblem(f"unpacks to {needed} bytes, and {free} are free in {folder}; free some "
                           "room or name a folder")


def _named_folder(path, folder, needed):
    """The folder that the caller names. That of a bundle must hold nothing else."""
    folder = os.path.abspath(folder)
    try:
        digest = _digest(path)
        if digest and not _taken(folder, digest, needed):
            raise SceneProblem(f"is not unpacked into {folder}, which holds other files; name a "
                               "new or an empty folder")
        os.makedirs(folder, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as problem:
        raise SceneProblem(f"needs a folder for its files, and {folder} cannot be one "
                           f"({problem.strerror}); name another folder") from problem
    return folder


def folder_for(path, folder, needed=0):
    """A folder for what a scene unpacks to or needs; and a note, or None. `folder`: the one that
    the caller names, or None for one beside the scene. `needed`: bytes that a bundle unpacks to."""
    if folder is not None:
        return _named_folder(path, folder, needed), None
    digest = _digest(path)
    beside = os.path.splitext(os.path.abspath(path))[0] + "-opened"
    for name in (beside, *(f"{beside} {number}" for number in range(2, 100))):
        try:
            if _taken(name, digest, needed):
                return name, None
        except OSError:
            break
    _require_room(tempfile.gettempdir(), needed)
    made = tempfile.mkdtemp(prefix="brainshift-scene-")
    return made, (f"Files of the scene are in {made}, because no folder beside it can be written "
                  "to. Name a folder to keep, or saved states will not find them.")


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
    if name.startswith(("/", "\\")) or ".." in parts or "\0" in name:
        raise SceneProblem("leads out of the bundle")
    if any(_ELSEWHERE.search(part) for part in parts if part != "."):
        raise SceneProblem("has a name with a colon, or a space or a dot at its end; rename it in "
                           "the scene")
    if MARK in (part.lower() for part in parts):
        raise SceneProblem("has the name of a file that BrainShift makes itself")
    if stat.S_ISLNK(entry.external_attr >> 16):
        raise SceneProblem("is a link")
    if entry.flag_bits & 1:
        raise SceneProblem("is encrypted")
    if entry.file_size > MOST_RATIO * entry.compress_size + SMALL:
        raise SceneProblem(f"announces {entry.file_size} bytes from {entry.compress_size}")


def _is_as_packed(entry, path):
    """Whether a file has the bytes that a bundle has of it."""
    if os.path.getsize(path) != entry.file_size:
        return False
    check = 0
    with open(path, "rb") as file:
        while chunk := file.read(_CHUNK):
            check = zlib.crc32(chunk, check)
    return check == entry.CRC


def _unpack(bundle, entry, path):
    """Unpacks a file that is not there. One that was changed since is left as it is."""
    if os.path.isfile(path):
        if not _is_as_packed(entry, path):
            raise SceneClause(f"{path} was changed since, and is taken as it is; delete it to have "
                              "that of the bundle")
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with _whole(path) as part:
        with bundle.open(entry) as packed, open(part, "wb") as file:
            shutil.copyfileobj(packed, file, _CHUNK)


@contextlib.contextmanager
def _whole(path):
    """The name of a file to write, which takes the place of `path` when it is whole."""
    part = path + ".part"
    try:
        yield part
        os.replace(part, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(part)
        raise


def _entries(bundle):
    """The files of a bundle that has a scene."""
    entries = [entry for entry in bundle.infolist() if not entry.is_dir()]
    if len(entries) > MOST_FILES:
        raise SceneProblem(f"has {len(entries)} files; a bundle may have {MOST_FILES}")
    if not any(_name(entry).lower().endswith(".mrml") for entry in entries):
        raise SceneProblem("holds no scene (.mrml)")
    return entries


def unpack(path, make_folder):
    """Unpacks a bundle. `make_folder` returns the folder; it is called with the bytes that the
    bundle needs, once that is known to have a scene. Returns the path of the scene, and sentences
    on what was left out."""
    notes, scenes, taken = [], [], set()
    try:
        opened = zipfile.ZipFile(path)
    except _FAULTS as problem:
        raise SceneProblem(f"cannot be read: {shown(problem)}") from problem
    with opened as bundle:
        entries = _entries(bundle)
        folder = make_folder(sum(entry.file_size for entry in entries))
        for entry in entries:
            name = _name(entry)
            try:
                _require_good(entry, name)
                target = os.path.join(folder, *name.replace("\\", "/").split("/"))
                if target.casefold() in taken:
                    raise SceneProblem("is there twice (capitals do not count); the first counts")
                taken.add(target.casefold())
                _unpack(bundle, entry, target)
            except SceneClause as problem:
                notes.append(f"File {shown(name)} of the bundle is not unpacked: {problem}.")
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
    with _whole(path) as part, zipfile.ZipFile(part, "w", zipfile.ZIP_DEFLATED) as bundle:
        for root, _, names in sorted(os.walk(folder)):
            for name in sorted(names):
                file = os.path.join(root, name)
                inside = os.path.relpath(file, os.path.dirname(folder))
                kind = zipfile.ZIP_STORED if name.endswith(_PACKED) else zipfile.ZIP_DEFLATED
                bundle.write(file, inside, kind)
