# SPDX-License-Identifier: BSD-3-Clause
"""Checks which file includes which: no include runs upwards, and none leads back to itself."""

import ast
import collections
import os
import re

import rooms
from tree import folder_of

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def _included_names(tree, path):
    # The names of included files are strings, so only comments may be taken out here.
    text = re.sub(r"/\*.*?\*/", "", tree.text(path), flags=re.DOTALL)
    return [name for _, name in INCLUDE.findall(text)]


def _target(tree, path, name, known):
    """The file of the checkout that an include names, or None if it is not ours."""
    beside = os.path.normpath(f"{folder_of(path)}/{name}")
    for candidate in (name, beside):
        if candidate in tree.known:
            return candidate
    return known.get(name)  # VTK's classes are included by their bare names


def edges(tree):
    """Pairs of files: who includes, and who is included."""
    known = {path.rpartition("/")[2]: path for path in tree.ending(".h")}
    for path in tree.sources():
        for name in _included_names(tree, path):
            target = _target(tree, path, name, known)
            if target is not None:
                yield path, target


def no_include_runs_upwards(tree):
    """A room includes only what it stands on, by the table in rooms.py."""
    product = rooms.stands_on(tree)
    for path in tree.sources():
        if not path.startswith("Testing/") and folder_of(path) not in product:
            yield f"{path}: its folder has no row in Testing/House/rooms.py"
    for path, target in edges(tree):
        room, other = folder_of(path), folder_of(target)
        if room not in product or room == other or not target.endswith(".h"):
            continue
        if other not in rooms.below(room, product):
            yield f"{path}: includes {target}, but {room} does not stand on {other}"


def no_library_where_it_is_kept_out(tree):
    """Filters/Deformation knows no VTK, Filters no OpenGL and no Qt, drawing and widgets no Qt."""
    for path in tree.sources():
        for room, kept_out in rooms.KEEPS_OUT.items():
            if not path.startswith(f"{room}/"):
                continue
            for library in kept_out:
                for name in _included_names(tree, path):
                    if re.match(rooms.LIBRARIES[library], name):
                        yield f"{path}: includes {name}, but {room} knows no {library}"


def _python_edges(tree):
    """Pairs of Python files: who imports, and who is imported, at any place in the file."""
    known = {}
    for path in tree.ending(".py"):
        name = path.rpartition("/")[2][:-3]
        package = folder_of(path).rpartition("/")[2]
        known[package if name == "__init__" else name] = path
        known[f"{package}.{name}"] = path
    for path in tree.ending(".py"):
        package = folder_of(path).rpartition("/")[2]
        for node in ast.walk(ast.parse(tree.text(path))):
            for name in _imported_names(node, package):
                if name in known and known[name] != path:
                    yield path, known[name]


def _imported_names(node, package):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if not isinstance(node, ast.ImportFrom):
        return []
    if node.level == 0:
        return [node.module]
    if node.module:
        return [f"{package}.{node.module}"]
    return [f"{package}.{alias.name}" for alias in node.names]


def _circles(edges):
    """Groups of files each of which leads to all others of its group (Tarjan's algorithm)."""
    graph = {}
    for source, target in edges:
        graph.setdefault(source, set()).add(target)
        graph.setdefault(target, set())
    number, lowest, stack = {}, {}, []

    def visit(node):
        number[node] = lowest[node] = len(number)
        stack.append(node)
        for target in sorted(graph[node]):
            if target not in number:
                yield from visit(target)
            if target in stack:
                lowest[node] = min(lowest[node], lowest[target])
        if lowest[node] == number[node]:
            group = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(group) > 1:
                yield sorted(group)

    for node in sorted(graph):
        if node not in number:
            yield from visit(node)


def no_circle_between_files(tree):
    """No file leads back to itself through includes; a header and its source file are one unit."""
    units = ((source.rpartition(".")[0], target.rpartition(".")[0])
             for source, target in edges(tree))
    for group in _circles((a, b) for a, b in units if a != b):
        yield f"{group[0]}: is in a circle with {', '.join(group[1:])}"
    for group in _circles(_python_edges(tree)):
        yield f"{group[0]}: is in a circle with {', '.join(group[1:])}"


#: Headers of GLM that VTK's wrapping tools parse at once; on matrices they never end.
WRAPPED_GLM = {"glm/fwd.hpp", "glm/vec2.hpp", "glm/vec3.hpp", "glm/vec4.hpp"}


def no_wrapped_header_leads_to_matrices(tree):
    """VTK's wrapping tools parse all that the header of a VTK class includes: no GLM matrices."""
    graph = collections.defaultdict(set)
    for path, target in edges(tree):
        graph[path].add(target)
    for header in tree.ending(".h"):
        if not header.rpartition("/")[2].startswith("vtk") or header.startswith("Testing/"):
            continue
        reached, waiting = {header}, [header]
        while waiting:
            new = graph[waiting.pop()] - reached
            reached |= new
            waiting += new
        for path in sorted(reached):
            for name in _included_names(tree, path):
                if name.startswith("glm/") and name not in WRAPPED_GLM:
                    yield f"{header}: leads to {name} through {path}"


def architecture_says_what_a_folder_uses(tree):
    """The last column in the table of folders of ARCHITECTURE.md is that of rooms.py."""
    if "ARCHITECTURE.md" in tree.known:
        text = tree.text("ARCHITECTURE.md")
        if rooms.architecture(text, rooms.stands_on(tree)) != text:
            yield "ARCHITECTURE.md: run python3 Testing/House/rooms.py . to write the column"


CHECKS = [architecture_says_what_a_folder_uses, no_wrapped_header_leads_to_matrices,
          no_include_runs_upwards, no_library_where_it_is_kept_out,
          no_circle_between_files]
