# SPDX-License-Identifier: BSD-3-Clause
"""Finds the functions of a C++ file, with their lines and parameters.

It follows braces and knows no types. A function is a brace that opens in a namespace or a class,
after a head with round brackets. Lambdas count as lines of the function around them.
"""

import re
from typing import NamedTuple

from tree import without_comments

TYPE = re.compile(r"\b(class|struct|union|enum)\b(?!.*[)])", re.DOTALL)
NAME = re.compile(r"(operator\s*\(\)|[\w:]*operator\W+?|[~\w:]+)\s*\(")
OPEN, CLOSE = "([{<", ")]}>"


class Function(NamedTuple):
    name: str
    line: int  # of its head
    lines: int  # from the head to the closing brace
    parameters: int
    constructor: bool


def _closing(text, start):
    """Where the round bracket that opens at `start` closes."""
    depth = 0
    for place in range(start, len(text)):
        depth += (text[place] == "(") - (text[place] == ")")
        if depth == 0:
            return place
    return len(text)


def _count_parameters(inside):
    inside = inside.strip()
    if inside in ("", "void"):
        return 0
    depth = commas = 0
    for character in inside.replace("->", "  "):
        if character in OPEN:
            depth += 1
        elif character in CLOSE:
            depth -= 1
        elif character == "," and depth == 0:
            commas += 1
    return commas + 1


def _signature(head):
    """Name, number of parameters, and whether it is a constructor; None for no function."""
    head = re.sub(r"^\s*#.*(\\\n.*)*$", "", head, flags=re.MULTILINE)
    match = NAME.search(head)
    if match is None or re.search(r"=\s*$", head):
        return None
    opening = match.end() - 1
    closing = _closing(head, opening)
    name = match.group(1).strip()
    before = head[:match.start()].strip()
    return name, _count_parameters(head[opening + 1:closing]), not before or before == "explicit"


def _kind(head):
    """What the brace after `head` opens: a namespace, a type, a function, or something else."""
    plain = re.sub(r"\btemplate\s*<[^{};]*?>\s*(?=\b(class|struct|inline|static|auto|void|\w))", "",
                   head)
    if re.search(r"\bnamespace\b", plain) or re.search(r'\bextern\s*""\s*$', plain):
        return "namespace"
    if TYPE.search(plain) and "(" not in plain:
        return "type"
    if re.search(r"=\s*$|\breturn\s*$|,\s*$", plain):
        return "value"
    # A member that a constructor's list sets with braces: `: Member{ 1 }`.
    if re.search(r"\)\s*(noexcept\s*)?:[^:]", plain) and re.search(r"[\w>]\s*$", plain):
        return "value"
    return "function" if _signature(plain) else "value"


def functions_of(text):
    """All functions of a C++ file that have a body in it."""
    text = re.sub(r"^[ \t]*#.*(?:\\\n.*)*", lambda m: "\n" * m.group(0).count("\n"),
                  without_comments(text), flags=re.MULTILINE)
    found, scopes, head_start, place = [], [], 0, 0
    while place < len(text):
        character = text[place]
        inside_body = bool(scopes) and scopes[-1][0] in ("function", "value")
        if character == "{":
            head = text[head_start:place]
            scopes.append(("value" if inside_body else _kind(head), head_start, head))
            if scopes[-1][0] != "value":
                head_start = place + 1
        elif character == "}" and scopes:
            kind, start, head = scopes.pop()
            if kind == "function":
                found.append(_function(text, start, place, head))
            if kind != "value":
                head_start = place + 1
        elif not inside_body and (character == ";" or _label(text, head_start, place)):
            head_start = place + 1
        place += 1
    return found


def _label(text, start, place):
    """Whether `public:` and the like end here."""
    return text[place] == ":" and text[start:place].strip() in ("public", "protected", "private")


def _function(text, start, end, head):
    begin = start + len(head) - len(head.lstrip())
    name, parameters, constructor = _signature(head.lstrip())
    first, last = text.count("\n", 0, begin) + 1, text.count("\n", 0, end) + 1
    return Function(name, first, last - first + 1, parameters, constructor)
