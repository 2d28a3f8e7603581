# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy over every tracked C++ file: python3 tidy.py CHECKOUT BUILD CLANG_TIDY.

Reading VTK's and Qt's headers takes most of the time. So files that are compiled alike are looked
at together, as if they were one file; files that use one name for different things stay apart. A
file that still cannot be compiled beside the others is looked at without them.

A file that was found clean is remembered in the build folder. It is not looked at again until it,
a file of the checkout that it includes, its compile command or the checks change. Each version has
other checks, so any but that of Debian 13 is skipped.
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

import includes
from tree import Tree, without_comments
from written import skip_other_versions

FILES_TOGETHER = 24
TESTS_TOGETHER = 8  # tests say `using namespace`, so that more names meet

#: What a file may define for itself alone, at the start of a line.
OWN_NAME = re.compile(
    r"^(?:(?:struct|class|enum|enum class|#define) (\w+)(?! *;)\b(?!::)|using (\w+) ="
    r"|[A-Za-z][\w:<>,&* ]*[ &*](\w+)(?: =|\{| \{|\[|\())", re.MULTILINE)

#: What clang says of code that it cannot compile.
NOT_COMPILED = "clang-diagnostic-error"


def arguments_of(command):
    """The compile command without the compiler, the source and what is written."""
    words = iter(shlex.split(command))
    kept = []
    for word in words:
        if word in ("-o", "-MF", "-MT", "-c"):
            next(words)
        elif word not in ("-MD", "ccache") and not word.endswith(("/c++", "/g++")):
            kept.append(word)
    return kept


def compiled_by(entry):
    """The files of an entry of compile_commands.json: itself, or what a unity build puts in."""
    path = pathlib.Path(entry["directory"], entry["file"]).resolve()
    if path.parent.name != "Unity":
        return [path]
    text = path.read_text(encoding="utf-8")
    return [pathlib.Path(file).resolve()
            for file in re.findall(r'^#include "(.+)"', text, re.MULTILINE)]


def compile_arguments(tree, build):
    """The arguments that each C++ file of the checkout is compiled with, by its path."""
    root = tree.root.resolve()
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        for path in compiled_by(entry):
            if path.is_relative_to(root) and path.relative_to(root).as_posix() in tree.known:
                found[path.relative_to(root).as_posix()] = arguments_of(entry["command"])
    return found


def included_by(tree):
    """For each file all files of the checkout that it includes, also through others."""
    direct = {}
    for path, target in includes.edges(tree):
        direct.setdefault(path, set()).add(target)
    everything = {}
    for path in tree.sources():
        reached, waiting = set(), [path]
        while waiting:
            for target in direct.get(waiting.pop(), ()):
                if target not in reached:
                    reached.add(target)
                    waiting.append(target)
        everything[path] = sorted(reached)
    return everything


def own_names(text):
    """Names that a file may not share with another one beside which it is compiled."""
    return {name for found in OWN_NAME.findall(without_comments(text)) for name in found if name}


def packed(paths, names_of):
    """Groups of files that share no name, filled in the order of the files."""
    most = TESTS_TOGETHER if paths[0].startswith("Testing/") else FILES_TOGETHER
    groups = []
    for path in paths:
        names = names_of(path)
        for group, taken in groups:
            if len(group) < most and taken.isdisjoint(names):
                group.append(path)
                taken |= names
                break
        else:
            groups.append(([path], set(names)))
    return [group for group, _ in groups]


class Tidy:
    """clang-tidy, and what it found clean before."""

    def __init__(self, tree, build, program):
        self.tree, self.program = tree, program
        self.arguments = compile_arguments(tree, build)
        self.folder = build / "tidy"
        self.folder.mkdir(exist_ok=True)
        version = subprocess.run([program, "--version"], capture_output=True, check=True).stdout
        common = version + tree.text(".clang-tidy").encode()
        included = included_by(tree)
        self.stamps = {path: self.folder / self._key(common, path, included[path])
                       for path in self.arguments}

    def _key(self, common, path, included):
        """Changes with everything that clang-tidy's answer for a file depends on."""
        digest = hashlib.sha256(common + repr(self.arguments[path]).encode())
        for file in [path, *included]:
            digest.update(self.tree.text(file).encode())
        return digest.hexdigest()

    def groups(self):
        """Files to look at, in groups that are compiled alike, the largest first."""
        alike = {}
        for path in sorted(self.arguments):
            if not self.stamps[path].exists():
                alike.setdefault(tuple(self.arguments[path]), []).append(path)
        groups = [group for paths in alike.values()
                  for group in packed(paths, lambda path: own_names(self.tree.text(path)))]
        return sorted(groups, key=len, reverse=True)

    def _run(self, source, path):
        result = subprocess.run(
            [self.program, "--quiet", str(source), "--", *self.arguments[path],
             "-Wno-unknown-warning-option"], capture_output=True, text=True, check=False,
            cwd=self.tree.root)
        if result.returncode != 0 and not result.stdout.strip():
            return result.stderr or f"{path}: {self.program} ended with an error"
        return result.stdout.strip()

    def _together(self, paths):
        """What clang-tidy says of files as if they were one."""
        if len(paths) == 1:
            return self._run(self.tree.root / paths[0], paths[0])
        name = re.sub(r"\W", "_", paths[0])
        source = self.folder / f"together_{name}.cxx"
        source.write_text("".join(f'#include "{self.tree.root.resolve() / path}" // NOLINT\n'
                                  for path in paths), encoding="utf-8")
        return self._run(source, paths[0])

    def look(self, paths):
        """What clang-tidy says of a group. Remembers the files if it says nothing."""
        said = self._together(paths)
        if NOT_COMPILED in said and len(paths) > 1:
            apart = [path for path in paths if f"/{path}:" in said]
            if not 0 < len(apart) < len(paths):
                apart = paths[:len(paths) // 2]
            rest = [path for path in paths if path not in apart]
            return self.look(rest) + self.look(apart)
        if not said:
            for path in paths:
                self.stamps[path].touch()
        return said


def main():
    checkout, build, program = sys.argv[1:4]
    skip_other_versions(program)
    tidy = Tidy(Tree(checkout), pathlib.Path(build), program)
    start = time.monotonic()
    groups = tidy.groups()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        said = [findings for findings in pool.map(tidy.look, groups) if findings]
    print("\n".join(said))
    print(f"{sum(map(len, groups))} of {len(tidy.arguments)} files looked at in "
          f"{time.monotonic() - start:.0f} s")
    sys.exit(bool(said))


if __name__ == "__main__":
    main()
