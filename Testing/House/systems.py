# SPDX-License-Identifier: BSD-3-Clause
"""Checks that code keeps to the C++ standard: what differs between systems and compilers lies in
few places, and files are read alike where `long` has 32 bits (Windows)."""

import re

from tree import without_comments

#: Files that may call the system, each with a branch for other systems but the last: there is no
#: tracker on Windows yet.
MAY_CALL = ("Common/HostMemory.cxx", "Common/ThreadPriority.cxx",
            "Formats/DICOM/DerivedHeader.cxx",
            "Formats/Files/WholeFile.cxx", "Tracking/Connection.cxx")
#: The one header of marks that compilers spell differently.
MARKS = "Common/Export.h"
ROOMS = ("Common", "Filters", "Formats", "Interaction", "Panel", "Plugin", "Representations",
         "Tracking", "Widgets")
COUNTING_ROOMS = ("Common", "Filters", "Formats", "Tracking")

HEADERS = re.compile(r"#include <((?:sys|arpa|net|netinet)/\w+|dirent|dlfcn|fcntl|io|netdb|poll|"
                     r"pthread|pwd|strings|termios|unistd|windows)\.h>")
CALLS = re.compile(r"\b((?:localtime|gmtime|strtok|strerror)_[rs]|str(?:n?casecmp|dup)|mkstemp|"
                   r"popen|readlink|setenv|usleep|fseeko|ftello|fileno)\s*\(")
GNU = re.compile(r"\b(__attribute__|__builtin_\w+|__typeof__|typeof|__extension__|__int128)\b")
LONG = re.compile(r"(?<!long )\b(?:unsigned )?long\b(?! long| double)")
#: The number of an event, in a function that VTK calls.
EVENT = re.compile(r"vtkObject\*(?: \w+)?, unsigned long\b")
PROJECT = re.compile(r"^\s*project\(", re.MULTILINE)


def _code(tree, *folders):
    for path in tree.below(*folders, suffixes=(".h", ".cxx")):
        yield path, without_comments(tree.text(path))


def no_system_is_called_elsewhere(tree):
    """Only the files of a short list call what the C++ standard has not."""
    for path, text in _code(tree, *ROOMS):
        if path not in MAY_CALL:
            for found in (*HEADERS.finditer(text), *CALLS.finditer(text)):
                yield f"{path}: {found[1]} is not of the C++ standard; see MAY_CALL in systems.py"


def no_extension_of_a_compiler_is_used(tree):
    """No extension of GNU is in the code, and every project of CMake turns them off."""
    for path, text in _code(tree, *ROOMS):
        if path != MARKS:
            for found in GNU.finditer(text):
                yield f"{path}: {found[1]} is an extension of GNU"
    for path in tree.ending("CMakeLists.txt"):
        text = tree.text(path)
        if PROJECT.search(text) and "set(CMAKE_CXX_EXTENSIONS OFF)" not in text:
            yield f"{path}: does not set CMAKE_CXX_EXTENSIONS to OFF"


def no_integer_is_long(tree):
    """Where files are read and voxels counted, no number is a `long`: on Windows it has 32 bits."""
    for path, text in _code(tree, *COUNTING_ROOMS):
        if LONG.search(EVENT.sub("", text)):
            yield f"{path}: a long has 32 bits on Windows; say std::int64_t or std::size_t"


CHECKS = [no_system_is_called_elsewhere, no_extension_of_a_compiler_is_used, no_integer_is_long]
