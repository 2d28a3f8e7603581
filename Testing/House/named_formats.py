# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a file format is known to its own folder only."""

import re

import rooms
from tree import folder_of, without_comments

PRODUCT = ("Common", "Formats", "Filters", "Representations", "Widgets", "Interaction", "Panel",
           "Plugin")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](Formats/\w+)/', re.MULTILINE)

#: Files that need one certain format, and why.
NEEDS = {
    "Formats/Surfaces/SurfaceFile.cxx": {
        "Formats/MGH": "FreeSurfer's surfaces lie in the frame of its volumes",
        "Formats/NIFTI": "a volume that gives a surface its frame may be NIfTI"},
    "Formats/Transforms/FSLWarp.cxx": {
        "Formats/NIFTI": "FSL's maps lie between the voxels of NIfTI files"},
    "Formats/Writers/vtkVolumeFileWriter.cxx": {
        "Formats/DICOM": "a series is a folder, which no other format writes"},
}


def _names(tree):
    """How code calls each format: its constants and its classes, by the folder."""
    names = {}
    for folder, name, kinds in rooms.formats(tree):
        words = names.setdefault(folder, set())
        words.update(f"{kind}Of{name}" for kind in kinds)
        words.update(path.rpartition("/")[2][:-2] for path in tree.below(folder, suffixes=(".h",)))
    return names


def no_file_outside_its_folder_names_a_format(tree):
    """No C++ file outside the folder of a format includes its files or names its classes."""
    names = _names(tree)
    for path in tree.below(*PRODUCT, suffixes=(".h", ".cxx")):
        own, needed = folder_of(path), NEEDS.get(path, {})
        text = tree.text(path)
        code = without_comments(text)
        included = set(INCLUDE.findall(text))
        for folder, words in names.items():
            if folder == own or folder in needed:
                continue
            named = sorted(word for word in words if re.search(rf"\b{word}\b", code))
            if folder in included or named:
                yield f"{path}: names {', '.join(named) or 'a file'} of {folder}"


CHECKS = [no_file_outside_its_folder_names_a_format]
