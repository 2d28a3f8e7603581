# SPDX-License-Identifier: BSD-3-Clause
"""Checks that a similarity is known to its own file only."""

import re

from tree import without_comments

FOLDER = "Filters/Register/Similarities/"
PRODUCT = ("Filters", "Representations", "Interaction", "Panel", "Plugin", "Python")
DESCRIBED = re.compile(r"^Similarity describe(\w+)\(\)", re.MULTILINE)
CALLED = re.compile(r'result\.(?:name|label) = "([^"]+)";')
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def _names(tree):
    """How code calls the similarities, and how users do."""
    words, texts = set(), set()
    for path in tree.ending(".cxx"):
        if path.startswith(FOLDER):
            words.update(DESCRIBED.findall(tree.text(path)))
            texts.update(CALLED.findall(tree.text(path)))
    return words, texts


def no_similarity_is_named_elsewhere(tree):
    """No file outside Filters/Register/Similarities names a similarity; all read the list."""
    words, texts = _names(tree)
    for path in tree.below(*PRODUCT, suffixes=(".h", ".cxx", ".xml", ".py")):
        text = tree.text(path)
        if path.startswith(FOLDER) or "imilarit" not in text:
            continue
        is_code = path.endswith((".h", ".cxx"))
        code = without_comments(text) if is_code else text
        strings = COMMENT.sub(" ", text) if is_code else text
        for word in sorted(words):
            if re.search(rf"\b{word}\b", code):
                yield f"{path}: names the similarity {word}"
        for called in sorted(texts):
            if f'"{called}"' in strings:
                yield f'{path}: names the similarity "{called}"'


CHECKS = [no_similarity_is_named_elsewhere]
