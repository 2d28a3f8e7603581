# SPDX-License-Identifier: BSD-3-Clause
"""Checks the budgets of CONTRIBUTING.md: lines in a file and in a function,
parameters of a function, characters in a line."""

import ast

from functions import functions_of

LINES_OF_A_FUNCTION = 60
PARAMETERS = 5
CHARACTERS_OF_A_LINE = 100
LINES_OF_A_FILE = {".h": 700, ".cxx": 700, ".py": 700, ".glsl": 150, ".xml": 700}


def no_file_is_long(tree):
    """No file has more lines than its kind may have."""
    for path in tree.files:
        limit = LINES_OF_A_FILE.get("." + path.rpartition(".")[2])
        if limit and len(tree.lines(path)) > limit:
            yield f"{path}: has {len(tree.lines(path))} lines; it may have {limit}"


def no_function_is_long(tree):
    """No function in C++ or Python has more than 60 lines, its head included."""
    for path in tree.sources():
        for function in functions_of(tree.text(path)):
            if function.lines > LINES_OF_A_FUNCTION:
                yield (f"{path}:{function.line}: {function.name} has {function.lines} lines; "
                       f"a function may have {LINES_OF_A_FUNCTION}")
    for path in tree.ending(".py"):
        for node in ast.walk(ast.parse(tree.text(path))):
            lines = getattr(node, "end_lineno", 0) - getattr(node, "lineno", 0) + 1
            if isinstance(node, ast.FunctionDef) and lines > LINES_OF_A_FUNCTION:
                yield (f"{path}:{node.lineno}: {node.name} has {lines} lines; "
                       f"a function may have {LINES_OF_A_FUNCTION}")


def no_signature_is_long(tree):
    """No function of the product has more than 5 parameters; constructors may."""
    for path in tree.sources():
        if path.startswith("Testing/"):
            continue
        for function in functions_of(tree.text(path)):
            if function.parameters > PARAMETERS and not function.constructor:
                yield (f"{path}:{function.line}: {function.name} has {function.parameters} "
                       f"parameters; it may have {PARAMETERS}")


def no_line_is_wide(tree):
    """No line of code has more than 100 characters."""
    code = tree.ending(".h", ".cxx", ".glsl", ".py", ".cmake", "CMakeLists.txt")
    for path in code:
        for number, line in enumerate(tree.lines(path), 1):
            if len(line) > CHARACTERS_OF_A_LINE:
                yield (f"{path}:{number}: has {len(line)} characters; "
                       f"a line may have {CHARACTERS_OF_A_LINE}")


CHECKS = [no_file_is_long, no_function_is_long, no_signature_is_long,
          no_line_is_wide]
