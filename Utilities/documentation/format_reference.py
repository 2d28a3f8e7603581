# SPDX-License-Identifier: BSD-3-Clause
"""What the documentation says of file formats: it comes from the folder of each format.

`CMakeLists.txt` there calls brainshift_add_format, which names the format, its kinds of data and
the words of its reader. `README.md` there opens with a table: format, read, written, axes, unit,
library, limits, and "fields read" and "fields written" of displacement fields. The text after that
table is the manual page of the format.
"""

import dataclasses
import pathlib
import re
import xml.etree.ElementTree as ElementTree

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
CALL = re.compile(r"^brainshift_add_format\(", re.MULTILINE)
WORD = re.compile(r'#[^\n]*|"([^"]*)"|([^\s()"]+)|(\))')
MANUAL = re.compile(r"^#+ [^\n]+\n\n\| \| \|\n\|---\|---\|\n((?:\|[^\n]*\n)+)((?:(?!#+ ).*\n)*)",
                    re.MULTILINE)
KEYS = ("KINDS", "LAST", "FOLDER", "SOURCES", "CLASSES", "XMLS", "EXTENSIONS", "READER", "LABEL",
        "READS", "SHORT", "ENDINGS", "FILES", "MENU", "DETAILS")
#: The first word of each column of a table, and what stands above it.
COLUMNS = {"format": "format", "read": "read", "written": "written", "axes": "orientation rule",
           "unit": "unit", "library": "library", "limits": "limits"}
IN_FENCE = re.compile(r"^```.*?^```\n", re.MULTILINE | re.DOTALL)


@dataclasses.dataclass
class Format:
    """A format: the words of its call by their key, its table, and its manual page."""

    name: str
    words: dict
    table: dict
    manual: str

    def is_of(self, kinds):
        return any(kind in kinds for kind in self.words["KINDS"])

    def said(self, key, default):
        return " ".join(self.words[key]) if self.words.get(key) else default

    @property
    def reader(self):
        return self.said("READER", f"{self.name}VolumeReader")

    @property
    def label(self):
        return self.said("LABEL", self.name)


def calls(text):
    """(name, words by key) of each call of brainshift_add_format in a CMakeLists.txt."""
    for call in CALL.finditer(text):
        name, words, key = "", {}, None
        for quoted, plain, end in WORD.findall(text, call.end()):
            if end:
                break
            if plain in KEYS:
                key = plain
                words[key] = []
            elif key is None:
                name = name or plain
            elif quoted or plain:
                words[key].append(" ".join((quoted or plain).split()))
        yield name, words


def manuals(text):
    """(table, manual page) of each format that a README.md describes, by the format's name."""
    # A line of code that begins with # is no heading.
    hidden = IN_FENCE.sub(lambda fence: re.sub("^#", "\0", fence[0], flags=re.MULTILINE), text)
    for found in MANUAL.finditer(hidden):
        rows = [row.split(" | ", 1) for row in re.findall(r"^\| (.*) \|$", found[1], re.MULTILINE)]
        yield dict(rows), found[2].replace("\0", "#").strip()


def formats(checkout=CHECKOUT):
    """All formats, in the order in which readers ask them."""
    found = []
    folders = sorted((checkout / "Formats").glob("*/CMakeLists.txt"),
                     key=lambda path: path.parent.name.lower())
    for path in folders:
        called = list(calls(path.read_text(encoding="utf-8")))
        if called:
            described = list(manuals((path.parent / "README.md").read_text(encoding="utf-8")))
            if len(described) != len(called):
                raise ValueError(f"{path.parent}: README.md has {len(described)} tables of formats;"
                                 f" CMakeLists.txt adds {len(called)}")
            found += [Format(name, words, *manual)
                      for (name, words), manual in zip(called, described)]
    return found


def table(kinds):
    """The formats of some kinds as a table of Markdown."""
    chosen = [item for item in formats() if item.is_of(kinds.split())]
    columns = [key for key in COLUMNS if any(key in item.table for item in chosen)]
    rows = [[COLUMNS[key] for key in columns], ["---"] * len(columns)]
    rows += [[item.table[key] for key in columns] for item in chosen]
    return "\n".join(f"| {' | '.join(row)} |" for row in rows)


def transforms():
    """The files of transforms that are read, as a table of Markdown."""
    text = (CHECKOUT / "Formats/Transforms/README.md").read_text(encoding="utf-8")
    return re.search(r"^## Files that are read\n.*?((?:^\|[^\n]*\n)+)", text,
                     re.MULTILINE | re.DOTALL)[1].strip()


def endings(kinds, column="read"):
    """The endings of some kinds, or of Transforms, after the names of their formats."""
    if kinds == "Transforms":
        rows = [row.strip("| ").split(" | ") for row in transforms().split("\n")[2:]]
        named = [(program, file) for file, program, _ in rows if program != "all"]
    else:
        column = f"fields {column}" if kinds == "Fields" else column
        named = [(item.table["format"], item.table[column])
                 for item in formats() if item.is_of(kinds.split())]
    by_format = {}
    for name, text in named:
        found = by_format.setdefault(name, [])
        words = re.findall(r"`\.[^`]+`", text) or ([text] if text != "–" else [])
        found += [word for word in words if word not in found]
    return "; ".join(f"{name} {', '.join(found)}" for name, found in by_format.items() if found)


def readers(elsewhere):
    """A section for each reader of volumes, with a marker for its properties, but for readers that
    have pages elsewhere. Links lead from Documentation/filters."""
    sections = []
    for item in formats():
        if item.is_of(["Volumes"]) and item.reader not in elsewhere:
            manual = item.manual.replace("../../Documentation/", "../")
            sections.append(f"## {item.label} Volume Reader\n\n{manual}\n\n"
                            f"<!-- properties: {item.reader} -->")
    return "\n\n".join(sections)


def filled(markdown, pages):
    """A page with the tables and sections of formats that its markers ask for. `pages` are the
    texts of all pages, which say what reader has a page of its own."""
    marker = re.compile(r"<!-- properties: (\w+) -->")
    markdown = re.sub(r"<!-- formats: ([\w ]+) -->", lambda found: table(found[1]), markdown)
    markdown = markdown.replace("<!-- transforms -->", transforms())
    markdown = re.sub(r"<!-- endings: ([\w ]+) -->", lambda found: endings(found[1]), markdown)
    markdown = re.sub(
        r"<!-- written: ([\w ]+) -->", lambda found: endings(found[1], "written"), markdown)
    if "<!-- volume readers -->" in markdown:
        elsewhere = {name for page in pages for name in marker.findall(page)}
        markdown = markdown.replace("<!-- volume readers -->", readers(elsewhere))
    return markdown


def proxies():
    """The XML of each reader that CMake makes from Formats/Volumes/VolumeReader.xml.in."""
    template = (CHECKOUT / "Formats/Volumes/VolumeReader.xml.in").read_text(encoding="utf-8")
    for item in formats():
        if "EXTENSIONS" in item.words:
            dotted = ", ".join(f".{ending}" for ending in item.words["EXTENSIONS"])
            reads = item.said("READS", f"a {item.label} volume")
            values = {"format": item.name, "reader": item.reader, "label": item.label,
                      "reads": reads, "short": item.said("SHORT", reads),
                      "endings": item.said("ENDINGS", dotted), "files": item.said("FILES", dotted),
                      "menu": item.said("MENU", f"{item.label} volume"),
                      "details": item.said("DETAILS", ""),
                      "extensions": item.said("EXTENSIONS", "")}
            yield ElementTree.fromstring(
                re.sub(r"@(\w+)@", lambda name, values=values: values[name[1]], template))
