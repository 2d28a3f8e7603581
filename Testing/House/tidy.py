# SPDX-License-Identifier: BSD-3-Clause
"""Runs clang-tidy over every C++ file: python3 tidy.py CHECKOUT BUILD CLANG_TIDY.

Reading VTK's and Qt's headers takes most of the time. So files of one folder that are compiled
alike are looked at together, as if they were one file. A group that cannot be compiled together,
because two files use one name for different things, is halved until it can.

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
from tree import Tree, folder_of
from written import skip_other_versions

FILES_TOGETHER = 8

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


def compile_arguments(tree, build):
    """The arguments that each C++ file of the checkout is compiled with, by its path."""
    root = tree.root.resolve()
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text(encoding="utf-8")):
        path = pathlib.Path(entry["directory"], entry["file"]).resolve()
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
        """Files to look at, in groups that are compiled alike."""
        alike = {}
        for path in sorted(self.arguments):
            if not self.stamps[path].exists():
                key = (folder_of(path), tuple(self.arguments[path]))
                alike.setdefault(key, []).append(path)
        return [paths[first:first + FILES_TOGETHER] for paths in alike.values()
                for first in range(0, len(paths), FILES_TOGETHER)]

    def _run(self, source, path):
        result = subprocess.run(
            [self.program, "--quiet", str(source), "--", *self.arguments[path],
             "-Wno-unknown-warning-option"], capture_output=True, text=True, check=False,
            cwd=self.tree.root)
        if result.returncode != 0 and not result.stdout.strip():
            return result.stderr or f"{path}: {self.program} ended with an error"
        return result.stdout.strip()

    def _together(self, paths):
        """What clang-tidy says of files as one, or None if they cannot be compiled as one."""
        name = re.sub(r"\W", "_", paths[0])
        source = self.folder / f"together_{name}.cxx"
        source.write_text("".join(f'#include "{self.tree.root.resolve() / path}" // NOLINT\n'
                                  for path in paths), encoding="utf-8")
        said = self._run(source, paths[0])
        return None if NOT_COMPILED in said else said

    def look(self, paths):
        """What clang-tidy says of a group. Remembers the files if it says nothing."""
        if len(paths) == 1:
            said = self._run(self.tree.root / paths[0], paths[0])
        else:
            said = self._together(paths)
        if said is None:
            half = len(paths) // 2
            return self.look(paths[:half]) + self.look(paths[half:])
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
