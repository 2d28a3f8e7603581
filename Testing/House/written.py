# SPDX-License-Identifier: BSD-3-Clause
"""Runs a program of others over the tracked files of a checkout that it understands:

    python3 written.py CHECKOUT format CLANG_FORMAT
    python3 written.py CHECKOUT spelling CODESPELL

`format` fails if clang-format would write a C++ file in another way. `spelling` fails if codespell
knows a better word. Versions of clang-format differ, so any but that of Debian 13 is skipped.
"""

import re
import shutil
import subprocess
import sys

from tree import Tree

#: Names such as numberIn are no words.
JOINED_WORDS = r"\w*[a-z][A-Z]\w*"

#: GLSL's inout, ParaView's level of detail, the target registration error, Mesa's zink, and a name
#: of ITK's.
OUR_WORDS = "te,inout,lod,nome,tranform,tre,unser,zink"


#: The major version of LLVM whose answers count, and the exit status of a check that is skipped.
LLVM_VERSION = 19
SKIPPED = 77


def require(program):
    if shutil.which(program) is None:
        sys.exit(f"This check needs {program}, which is not installed")


def skip_other_versions(program):
    """Ends the check as skipped if the program is of another version of LLVM."""
    require(program)
    said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    version = int(re.search(r"version (\d+)", said).group(1))
    if version != LLVM_VERSION:
        print(f"{program} has version {version}; this check needs version {LLVM_VERSION}")
        sys.exit(SKIPPED)


def command_of(tree, check, program):
    if check == "format":
        skip_other_versions(program)
        return [program, "--dry-run", "-Werror", *tree.sources()]
    words = tree.ending(".h", ".cxx", ".glsl", ".py", ".xml", ".md", ".txt", ".cmake")
    return [program, "--ignore-regex", JOINED_WORDS, "--ignore-words-list", OUR_WORDS, *words]


def main():
    checkout, check, program = sys.argv[1:4]
    require(program)
    tree = Tree(checkout)
    result = subprocess.run(command_of(tree, check, program), cwd=tree.root, check=False)
    sys.exit(result.returncode)


if __name__ == "__main__":
    main()
