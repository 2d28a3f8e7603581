# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a tool stands in its own file and in the tables of tools, and nowhere else."""

import re

from tree import without_comments

PRODUCT = ("Filters", "Representations", "Widgets", "Interaction", "Panel", "Plugin")

#: The enum of all tools with what strokes need of each, and the list of their rows.
TABLES = {"Filters/Deformation/Stroke.h", "Interaction/Commands/Tools.cxx"}

NAMED = re.compile(r"\bTool::([A-Z]\w*)|\b([a-z]+)Tool\(\)")


def _own_file(tool):
    return f"Interaction/Tools/{tool[0].upper()}{tool[1:]}Tool.cxx"


def no_file_names_a_tool_of_another(tree):
    """Only the tables of tools and a tool's own file name it, so a new one changes no other."""
    own = set(tree.below("Interaction/Tools", suffixes=("Tool.cxx",)))
    for path in tree.below(*PRODUCT, suffixes=(".h", ".cxx")):
        if path in TABLES:
            continue
        for number, line in enumerate(without_comments(tree.text(path)).splitlines(), 1):
            for named in NAMED.finditer(line):
                tool = named.group(1) or named.group(2)
                home = _own_file(tool)
                if tool != "None" and home != path and (named.group(1) or home in own):
                    yield (f"{path}:{number}: names the tool {tool}; only {home} and "
                           f"{', '.join(sorted(TABLES))} may")


CHECKS = [no_file_names_a_tool_of_another]
