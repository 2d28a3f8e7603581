# SPDX-License-Identifier: BSD-3-Clause
"""Makes the page of the Python reference from the docstrings of Python/brainshift. Nothing is
imported, so neither ParaView nor a build is needed."""

import ast
import inspect
import pathlib

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "Python" / "brainshift"
FIRST = ("strokes", "maps")  # what most readers look for


def _parse(module):
    return ast.parse((PACKAGE / f"{module}.py").read_text(encoding="utf-8"))


def _functions_of(module, names):
    """The public functions among the names, in the order of the source."""
    return [node for node in _parse(module).body
            if isinstance(node, ast.FunctionDef) and node.name in names]


def functions():
    """The functions that the package exports, module by module."""
    exported = {node.module: {alias.name for alias in node.names}
                for node in _parse("__init__").body
                if isinstance(node, ast.ImportFrom) and node.level == 1}
    modules = [module for module in FIRST if module in exported]
    modules += [module for module in exported if module not in FIRST]
    return [function for module in modules
            for function in _functions_of(module, exported[module])]


def _section(function):
    text = inspect.cleandoc(ast.get_docstring(function) or "")
    return [f"## {function.name}", "", "```python",
            f"brainshift.{function.name}({ast.unparse(function.args)})", "```", "", text, ""]


def page():
    """The whole page as Markdown."""
    lines = ["# Python reference", "", inspect.cleandoc(ast.get_docstring(_parse("__init__"))), ""]
    for function in functions():
        lines += _section(function)
    return "\n".join(lines)
