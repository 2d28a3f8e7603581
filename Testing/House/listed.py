# SPDX-License-Identifier: BSD-3-Clause
"""Checks that nothing lies in a folder without being built or run."""

import posixpath
import re

from tree import folder_of

BUILT = ("Common", "Formats", "Filters", "Representations", "Widgets", "Interaction", "Panel",
         "Plugin", "Testing/Cxx", "Testing/Portable")


def _named_paths(tree):
    """Every word of every file of CMake, as a path from the root of the checkout."""
    named = set()
    for path in tree.ending("CMakeLists.txt", ".cmake"):
        text = re.sub(r"#.*", "", tree.text(path))
        for word in re.findall(r"[^\s()\"]+", text):
            word = word.replace("${PROJECT_SOURCE_DIR}/", "/")
            beside = word[1:] if word.startswith("/") else f"{folder_of(path)}/{word}"
            named.add(posixpath.normpath(beside).lstrip("/"))
    return named


def _unnamed(tree, paths, endings=("",)):
    """The paths that no CMakeLists.txt names. A list may leave out one of the endings."""
    named = _named_paths(tree)
    for path in paths:
        if not any(path.endswith(ending) and path[:len(path) - len(ending)] in named
                   for ending in endings):
            yield path


def every_source_is_built(tree):
    """Every .cxx of the product and of its tests is named by a CMakeLists.txt."""
    for path in _unnamed(tree, tree.below(*BUILT, suffixes=(".cxx",)), ("", ".cxx")):
        yield f"{path}: no CMakeLists.txt names it, so it is not built"


def every_shader_is_built(tree):
    """Every .glsl is named by the list of shaders in Representations/CMakeLists.txt."""
    listed = "Representations/CMakeLists.txt"
    words = set(re.findall(r"[\w./-]+", tree.text(listed))) if listed in tree.known else set()
    for path in tree.below("Shaders", suffixes=(".glsl",)):
        if path[len("Shaders/"):-len(".glsl")] not in words:
            yield f"{path}: {listed} does not name it, so it is not built"


def every_script_runs(tree):
    """Every script in Testing/Python and Testing/XML is named by a CMakeLists.txt."""
    scripts = tree.below("Testing/Python", "Testing/XML", suffixes=(".py", ".xml"))
    for path in _unnamed(tree, scripts, (".py", ".xml")):
        yield f"{path}: no CMakeLists.txt names it, so it does not run"


def every_test_of_a_format_is_found(tree):
    """A folder in Testing/Formats has the name of one in Formats; each .cxx there ends in Test."""
    for path in tree.below("Testing/Formats", suffixes=(".cxx", ".h", ".py")):
        if f"{folder_of(path).removeprefix('Testing/')}/CMakeLists.txt" not in tree.known:
            yield f"{path}: there is no such folder in Formats"
        if path.endswith(".cxx") and not path.endswith("Test.cxx"):
            yield f"{path}: CMake takes *Test.cxx only, so it is not built"


def every_proxy_is_loaded(tree):
    """Every .xml of proxies is named by the CMakeLists.txt of its module."""
    proxies = tree.below("Formats", "Filters", "Representations", "Plugin", suffixes=(".xml",))
    for path in _unnamed(tree, proxies):
        yield f"{path}: no CMakeLists.txt names it, so ParaView does not load it"


CHECKS = [every_source_is_built, every_shader_is_built, every_script_runs,
          every_test_of_a_format_is_found, every_proxy_is_loaded]
