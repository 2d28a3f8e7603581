# SPDX-License-Identifier: BSD-3-Clause
"""Checks what a reader finds at the top of each header and of each room, and in a release."""

import re

import rooms

#: Rooms beside those of C++ that a reader walks into.
MORE_ROOMS = ["Benchmark", "Examples", "Python", "Shaders", "Testing", "Testing/House", "Utilities"]


#: One comment at the top: lines that begin with @file, or the block of a VTK class with its name.
OPENING = re.compile(r"(/// @file\n(?:///[^\n]*\n)+|/\*\*\n \* @class .*?\*/\n)", re.DOTALL)


def every_header_opens(tree):
    """Each header has the licence, an opening in the house's style and a guard named for it."""
    for path in tree.ending(".h"):
        first, _, rest = tree.text(path).partition("\n")
        if not first.startswith("// SPDX-License-Identifier:"):
            yield f"{path}: its first line must name the licence"
        opening = OPENING.match(rest)
        if opening is None or not re.search(r"\w{3}", opening.group(1)):
            yield (f"{path}: does not open with /// @file, or with @class for a VTK class, "
                   "under the licence")
        if not _is_guarded(path, rest[opening.end() if opening else 0:]):
            yield f"{path}: has no include guard named for it under its opening comment"


def _is_guarded(path, text):
    name = re.escape(path.rpartition("/")[2][:-2])
    return re.match(rf"\s*#ifndef (\w*{name}_h)\n#define \1\n.*\n#endif[^\n]*\s*$", text, re.DOTALL)


def every_room_says_what_it_is_for(tree):
    """Every room has a README.md of a few lines."""
    for room in [*rooms.stands_on(tree), *MORE_ROOMS]:
        if f"{room}/README.md" not in tree.known:
            yield f"{room}: has no README.md"


#: Where a release names its version, and the pattern of the line.
VERSIONS = {"CMakeLists.txt": r"^project\(BrainShift VERSION ([\d.]+)",
            "CITATION.cff": r"^version: ([\d.]+)$",
            "CHANGELOG.md": r"^## ([\d.]+) - \d{4}-\d\d-\d\d$"}

LINES_OF_A_RELEASE = 60


def every_place_names_the_same_version(tree):
    """CMake, CITATION.cff and the newest release of CHANGELOG.md name one version."""
    found = {path: re.search(pattern, tree.text(path), re.MULTILINE)
             for path, pattern in VERSIONS.items() if path in tree.known}
    names = {path: match and match[1] for path, match in found.items()}
    for path, name in names.items():
        if name is None or name != names.get("CMakeLists.txt", name):
            yield f"{path}: names version {name}; CMakeLists.txt {names.get('CMakeLists.txt')}"


def no_release_is_long(tree):
    """A release takes at most 60 lines of CHANGELOG.md, so that users read it."""
    if "CHANGELOG.md" in tree.known:
        for section in tree.text("CHANGELOG.md").split("\n## ")[1:]:
            lines = section.rstrip().count("\n") + 1
            if lines > LINES_OF_A_RELEASE:
                yield (f"CHANGELOG.md: {section.splitlines()[0]} has {lines} lines; it may have "
                       f"{LINES_OF_A_RELEASE}")


CHECKS = [every_header_opens, every_place_names_the_same_version, every_room_says_what_it_is_for,
          no_release_is_long]
