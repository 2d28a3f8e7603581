# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the documentation share: the documents, their links, and a runner."""

import pathlib
import re
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
PAGES = CHECKOUT / "Documentation"
sys.path.insert(0, str(CHECKOUT / "Utilities" / "documentation"))
sys.path.append(str(CHECKOUT / "Testing" / "House"))
import format_reference  # noqa: E402
import property_reference  # noqa: E402
import python_reference  # noqa: E402
import similarity_reference  # noqa: E402
from tree import Tree, folder_of  # noqa: E402

#: Pages that the site generates; they are no files.
GENERATED = {PAGES / "reference" / "python.md": python_reference.page,
             PAGES / "reference" / "properties.md": property_reference.page}

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^```.*?^```", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`\n]*`")


def documents():
    """Every document of the checkout that readers follow links in."""
    return [CHECKOUT / path for path in Tree(CHECKOUT).ending(".md")
            if not folder_of(path) or path.startswith("Documentation/")
            or path.endswith("/README.md")]


def text_of(document):
    if document in GENERATED:
        return GENERATED[document]()
    text = document.read_text(encoding="utf-8")
    if document.is_relative_to(PAGES):
        return format_reference.filled(
            text, (page.read_text(encoding="utf-8") for page in PAGES.rglob("*.md")))
    return text


def links_of(document):
    """Where its links and pictures lead; not what stands in code."""
    prose = CODE.sub("", FENCE.sub("", text_of(document)))
    return LINK.findall(prose)


def anchors_of(document):
    """The headings of a document, as sites and GitHub name them in addresses."""
    prose = FENCE.sub("", text_of(document))
    headings = re.findall(r"^#+ (.*)$", prose, re.MULTILINE)
    plain = (re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower() for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading).strip().replace(" ", "-") for heading in plain}


def run_tests(names):
    """Runs all test_… functions; the exit status says whether all of them passed."""
    failed = 0
    for name, test in list(names.items()):
        if name.startswith("test_"):
            try:
                test()
                print(f"passed: {name}")
            except AssertionError as error:
                failed += 1
                print(f"FAILED: {name}\n{error}")
    sys.exit(1 if failed else 0)
