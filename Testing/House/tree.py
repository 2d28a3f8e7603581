# SPDX-License-Identifier: BSD-3-Clause
"""Reads a checkout: which files it has, and C++ without comments and strings."""

import functools
import pathlib
import re
import subprocess

#: Folders that hold what was built or drawn, not sources, where git does not name the sources.
NOT_SOURCES = {"build", "bench-output", "demo-output", "__pycache__"}

#: What a comment, a string or a character looks like in C++. Strings stay, comments do not.
WORDLESS = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)


class Tree:
    """The tracked files of a checkout; without git, all files of a folder. Paths are strings
    relative to its root, with slashes."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        tracked = self._tracked()
        self.files = sorted(self._walk(self.root) if tracked is None else tracked)
        self.known = set(self.files)

    def _tracked(self):
        """What git knows and is there; None where git knows nothing of the folder."""
        if not (self.root / ".git").exists():  # a folder, or the file of a worktree
            return None
        git = ["git", "-c", "safe.directory=*", "-C", str(self.root), "ls-files", "-z"]
        try:
            listed = subprocess.run(git, capture_output=True, text=True, check=True).stdout
        except (OSError, subprocess.CalledProcessError):
            return None
        present = (path for path in listed.split("\0") if path)
        return [path for path in present if (self.root / path).exists()]

    def _walk(self, folder):
        for entry in folder.iterdir():
            if entry.name in NOT_SOURCES or entry.name == ".git":
                continue
            if entry.is_dir() and not entry.is_symlink():
                yield from self._walk(entry)
            elif not entry.name.endswith(".pyc"):
                yield entry.relative_to(self.root).as_posix()

    @functools.lru_cache(maxsize=None)
    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8")

    def lines(self, path):
        return self.text(path).splitlines()

    def ending(self, *suffixes):
        return [path for path in self.files if path.endswith(suffixes)]

    def below(self, *folders, suffixes):
        starts = tuple(f"{folder}/" for folder in folders)
        return [path for path in self.ending(*suffixes) if path.startswith(starts)]

    def sources(self):
        """Every C++ file."""
        return self.ending(".h", ".cxx")


def folder_of(path):
    return path.rpartition("/")[0]


def without_comments(text):
    """C++ in which each comment is blank and each string is empty; line numbers stay."""
    def blank(match):
        found = match.group(0)
        kept = '""' if found[0] in '"R' else "0" if found[0] == "'" else " "
        return kept + "\n" * found.count("\n")
    return WORDLESS.sub(blank, text)
