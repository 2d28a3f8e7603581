# SPDX-License-Identifier: BSD-3-Clause
# Proves that every relative link, picture and anchor of the documents leads somewhere.
from documents import (CHECKOUT, GENERATED, PAGES, Tree, anchors_of, documents, links_of,
                       run_tests)


def broken(document, link):
    """What is wrong with a link of a document, or None."""
    path, _, anchor = link.partition("#")
    target = (document.parent / path).resolve() if path else document
    if not (target.exists() or target in GENERATED):
        return "leads nowhere"
    if anchor and (target.suffix != ".md" or anchor not in anchors_of(target)):
        return "leads to no heading"
    return None


def test_relative_links_lead_somewhere():
    complaints = []
    for document in [*documents(), *GENERATED]:
        for link in links_of(document):
            problem = None if ":" in link else broken(document, link)
            if problem:
                complaints.append(f"{document}: {link} {problem}")
    assert not complaints, "\n".join(complaints)


def test_the_check_sees_a_broken_link():
    start = PAGES / "index.md"
    assert broken(start, "nothing.md") and broken(start, "#nothing")
    assert broken(start, "index.md#install") is None, anchors_of(start)


def test_every_picture_is_shown():
    shown = {(document.parent / link).resolve()
             for document in documents() for link in links_of(document) if link.endswith(".png")}
    pictures = {CHECKOUT / path for path in
                Tree(CHECKOUT).below("Documentation/pictures", suffixes=(".png",))}
    assert pictures <= shown, f"shown nowhere: {sorted(pictures - shown)}"


run_tests(globals())
