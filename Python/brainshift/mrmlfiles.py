# SPDX-License-Identifier: BSD-3-Clause
"""The files that the files of a scene name themselves: headers with their numbers elsewhere, and
transforms that are made of several files."""

import glob
import os
import re

from .mrml import SceneProblem, is_below, shown

#: Bytes in which a text header ends.
_HEADER_BYTES = 2**20

_PAIRS = {".hdr": (".img", ".img.gz"), ".img": (".hdr", ".hdr.gz")}
_META_FIELD = re.compile(rb"(?im)^[^\S\n]*elementdatafile[^\S\n]*=(.*)$")
_NRRD_FIELD = re.compile(rb"(?im)^[^\S\n]*data ?file[^\S\n]*:(?!=)(.*)$")
_ELASTIX = re.compile(
    rb"\([ \t]*(?:InitialTransformParameters?FileName|DeformationFieldFileName|TransformParameters)"
    rb"[ \t]+\"?([^\"\r\n)]{0,4096})")
_XFM = re.compile(rb"Displacement_Volume\s*=([^;]*)")
_COMMENT = re.compile(rb"%[^\n]*")
_NUMBERED = re.compile(r"%\d*d")


def _words_in(header):
    """Names in a text header of NRRD or MetaImage, and patterns of names."""
    names = []
    for found in (_NRRD_FIELD if header.startswith(b"NRRD") else _META_FIELD).finditer(header):
        words = os.fsdecode(found[1].strip())
        first = (words.split() or [""])[0]
        if first == "LIST":
            lines = [os.fsdecode(line.strip()) for line in header[found.end():].split(b"\n")]
            names.extend(line for line in lines if line and line[0] != "#")
        elif words.lower() not in ("", "local"):
            names.extend([words, first] if _NUMBERED.search(first) else [words])
    return names


def _header_of(begin):
    """The part of a file that is a text header."""
    end = re.search(rb"\n[^\S\n]*\n", begin)
    lists = re.search(rb"(?im)^[^\S\n]*data ?file[^\S\n]*:[^\S\n]*LIST", begin)
    return begin[:end.start()] if begin.startswith(b"NRRD") and end and not lists else begin


def _matching(folder, name):
    """The path of a name; of a pattern, also those of the files that match it."""
    pattern = glob.escape(_NUMBERED.sub("\0", name)).replace("\0", "*")
    found = glob.glob(os.path.join(glob.escape(folder), pattern)) if _NUMBERED.search(name) else []
    return [os.path.join(folder, name), *found]


def _named_in(path, is_transform):
    """The paths of the files that a file names, as its reader finds them."""
    with open(path, "rb") as file:
        text = file.read(_HEADER_BYTES)
        if is_transform and b"\0" not in text:  # numbers alone name no file
            text += file.read()
    folder, (stem, end) = os.path.dirname(path), os.path.splitext(path)
    found = [stem + other for other in _PAIRS.get(end.lower(), ())]
    names = _words_in(_header_of(text[:_HEADER_BYTES]))
    if is_transform and text.startswith(b"MNI"):
        names += [os.fsdecode(name.strip()) for name in _XFM.findall(_COMMENT.sub(b"", text))]
    for name in names:
        found.extend(_matching(folder, name))
    for match in _ELASTIX.findall(text) if is_transform else ():
        name = os.fsdecode(match)
        found.append(name if os.path.exists(name) else
                     os.path.join(folder, os.path.basename(name)))
    return found


def require_below(scene, path, outside, is_transform=False):
    """Raises the end of a sentence if a file, or one that it names, names a file that is not below
    the folder of a scene. `outside`: whether it may."""
    waiting, seen = [path], set()
    while waiting and not outside:
        path = waiting.pop()
        real = os.path.realpath(path)
        if real in seen or not os.path.isfile(path):
            continue
        seen.add(real)
        for named in _named_in(path, is_transform):
            if not is_below(scene, named):
                raise SceneProblem(
                    f"is in {shown(os.path.basename(path))}, which names {shown(named)}, outside "
                    "the folder of the scene; save it in one file, or open the scene with "
                    "outside=True")
            waiting.append(named)
