# SPDX-License-Identifier: BSD-3-Clause
"""The files that are read where a role has one path: slices, chunks, and data beside a header."""

import hashlib
import os
import re
from xml.sax.saxutils import unescape

#: Files of metadata, by one of which a store of OME-Zarr may be opened.
_ZARR = ("zarr.json", ".zattrs", ".zgroup", ".zarray")

#: Headers that may name files with their voxels, and the endings of pairs of Analyze and NIfTI.
_HEADERS = (".mhd", ".mha", ".nhdr", ".nrrd")
_PAIR = (".hdr", ".hdr.gz", ".img", ".img.gz")

#: VTK's headers in XML that name files of parts, times or blocks, and the attributes that do.
_XML = (".pvti", ".pvts", ".pvtp", ".pvtu", ".pvtr", ".pvd", ".vtm", ".vtmb")
_NAMES_FILE = re.compile(rb"""\b(?:Source|file)\s*=\s*(?:"([^"]*)"|'([^']*)')""")

#: Tables of BIDS whose unit and axes another file says.
_TABLES = ("_electrodes.tsv", "_optodes.tsv")
_ABOUT = "_coordsystem.json"
#: In the root of a data set of BIDS, and how far a table may lie below it.
_ROOT_OF_BIDS, _MOST_ABOVE = "dataset_description.json", 4

#: As in the readers: bytes in which a header ends, and most files that one names.
_LONGEST_HEADER, _MOST_FILES = 1 << 20, 65536


def files_of(path, listed=False):
    """The files that are read when a path is opened: a sorted list of paths.

    - `listed`: whether a reader has a list of paths, of which this is one. Default `False`.

    - a folder: all files below it
    - a file of DICOM that is not listed, or of a store's metadata: the folder around it
    - a header: itself and the files that it names, or that belong to it, with its values
    - a table of electrodes or optodes: itself and the `_coordsystem.json` that is about it, beside
      it or above it in its data set
    - any other, even if it does not exist: itself

    Raises `OSError` if a folder or a header cannot be read.
    """
    folder, name = os.path.dirname(path), os.path.basename(path)
    if os.path.isdir(path):
        return _below(path)
    if name.lower() == "dicomdir" or (name in _ZARR and os.path.isfile(path)):
        return _below(folder or ".")
    if not os.path.isfile(path):
        return [path]
    pair = re.search(r"\.(hdr|img)(\.gz)?$", name)
    if pair:
        beside = [path[:len(path) - len(pair.group())] + end for end in _PAIR]
    elif name.lower().endswith(_HEADERS):
        beside = [os.path.join(folder, each) for each in _named_in(path)]
    elif name.endswith(_TABLES):
        beside = _about(path)
    elif name.lower().endswith(_XML):
        beside = _named_in_xml(path)
    elif not listed and is_dicom(path):
        beside = [os.path.join(folder, each) for each in os.listdir(folder or ".")
                  if not each.startswith(".")]
    else:
        beside = []
    return sorted({path, *filter(os.path.isfile, beside)})


def is_dicom(path):
    """Whether a file begins as DICOM does."""
    with open(path, "rb") as file:
        begin = file.read(132)
    # Old files begin at once with an element of group 8 whose length follows.
    is_old = len(begin) >= 8 and begin[:2] == b"\x08\x00" and begin[3] == 0 and begin[2] in (
        0, 5, 8, 0x16)
    return is_old or begin[128:] == b"DICM"


def is_store(path):
    """Whether a path is that of a store of OME-Zarr."""
    return os.path.basename(path) in _ZARR or any(
        os.path.isfile(os.path.join(path, name)) for name in _ZARR)


def hash_of(path, listed=False):
    """The SHA-256 hash of a file that is read alone; of several that of their list: a line for each
    with its hash, two blanks and its name from the folder, as `sha256sum` writes it."""
    files = files_of(path, listed)
    if files == [path]:
        return _hash_of_file(path)
    folder = path if os.path.isdir(path) else os.path.dirname(path) or "."
    total = hashlib.sha256()
    for name, file in sorted(
            (os.path.relpath(file, folder).replace(os.sep, "/"), file) for file in files):
        total.update(os.fsencode(f"{_hash_of_file(file)}  {name}\n"))
    return total.hexdigest()


def _hash_of_file(path):
    total = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            total.update(block)
    return total.hexdigest()


def _below(folder):
    """The files below a folder, without notes of the system, whose names begin with a dot."""
    def stop(error):
        raise error
    found, seen = [], set()
    for here, folders, names in os.walk(folder, onerror=stop, followlinks=True):
        if os.path.realpath(here) in seen:  # links may lead back
            folders.clear()
            continue
        seen.add(os.path.realpath(here))
        folders.sort()
        found += [os.path.join(here, name) for name in names
                  if not name.startswith(".") or name in _ZARR]
    return sorted(filter(os.path.isfile, found))


def _named_in(header):
    """Names of files that have the voxels of a MetaImage or NRRD header."""
    is_nrrd = header.lower().endswith((".nhdr", ".nrrd"))
    with open(header, "rb") as file:
        while file.tell() < _LONGEST_HEADER:
            line = file.readline(_LONGEST_HEADER).decode("utf-8", "surrogateescape")
            if not line or (is_nrrd and not line.strip()):  # the numbers follow
                return []
            found = re.match(r"(?i)\s*(?:ElementDataFile\s*=|data ?file\s*:)(?!=)(.*)", line)
            if not found:
                continue
            words = found.group(1).split()
            if words[:1] == ["LIST"]:
                rest = file.read(_LONGEST_HEADER).decode("utf-8", "surrogateescape")
                return [name.strip() for name in rest.splitlines() if name.strip()]
            return _numbered(words) if len(words) > 2 else [found.group(1).strip()]
    return []


def _named_in_xml(header):
    """Files that a header in XML names, and those that headers name that it names."""
    found, waiting = set(), [header]
    while waiting:
        path = waiting.pop()
        with open(path, "rb") as file:
            names = [os.fsdecode(one or other) for one, other in _NAMES_FILE.findall(file.read())]
        new = {os.path.join(os.path.dirname(path), unescape(name)) for name in names} - found
        found |= new
        waiting += [each for each in new if each.lower().endswith(_XML) and os.path.isfile(each)]
    return sorted(found)


def _numbered(words):
    """Names of a pattern, from, to and by a number; else the words as one name."""
    if not re.fullmatch(r"[^%]*%\d{0,2}d[^%]*", words[0]):
        return [" ".join(words)]
    try:
        first, last, step = (int(float(word)) for word in [*words[1:], "1"][:3])
        numbers = range(first, last + (1 if step > 0 else -1), step)
        return [words[0] % number for number in numbers[:_MOST_FILES]]
    except (ValueError, OverflowError):  # no numbers: the reader refuses them
        return []


def _about(table):
    """The coordsystem.json that is about a table: of those whose entities are all the table's, the
    one with the most, beside it or in a folder of its data set above it, as the reader takes it."""
    own = _entities(os.path.basename(table))
    folder = os.path.dirname(table)
    for _ in range(_MOST_ABOVE + 1):
        names = [name for name in os.listdir(folder or ".")
                 if name.endswith(_ABOUT) and _entities(name) <= own]
        most = max((len(_entities(name)) for name in names), default=0)
        found = [os.path.join(folder, name) for name in names if len(_entities(name)) == most > 0]
        if found or not _is_in_data_set(folder):
            return found
        folder = os.path.dirname(os.path.abspath(folder))
    return []


def _entities(name):
    return set(name.split("_")[:-1])


def _is_in_data_set(folder):
    """Whether a folder is below the root of a data set of BIDS."""
    above = os.path.abspath(folder)
    if os.path.exists(os.path.join(above, _ROOT_OF_BIDS)):
        return False
    for _ in range(_MOST_ABOVE):
        above = os.path.dirname(above)
        if os.path.exists(os.path.join(above, _ROOT_OF_BIDS)):
            return True
    return False
