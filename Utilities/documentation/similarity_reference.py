# SPDX-License-Identifier: BSD-3-Clause
"""Makes the table of similarities from the files that define them."""

import pathlib
import re

ROOM = pathlib.Path(__file__).resolve().parents[2] / "Filters" / "Register"
LISTED = re.compile(r"^  (Similarities/\w+\.cxx)\)?$", re.MULTILINE)


def text_of(source, name):
    """The text that a description assigns to one of its members."""
    found = re.search(rf'result\.{name} =((?:\s*"[^"]*")+);', source)
    return "".join(re.findall(r'"([^"]*)"', found[1]))


def table():
    """Name and purpose of each similarity, as a table of Markdown, in the order of the list."""
    listed = (ROOM / "CMakeLists.txt").read_text(encoding="utf-8")
    rows = ["| similarity | when, and how |", "|---|---|"]
    for path in LISTED.findall(listed.partition("set(similarity_")[0]):
        source = (ROOM / path).read_text(encoding="utf-8")
        rows.append(f'| `"{text_of(source, "name")}"` | {text_of(source, "tooltip")} |')
    return "\n".join(rows)
