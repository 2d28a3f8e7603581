# SPDX-License-Identifier: BSD-3-Clause
"""What mkdocs calls while it builds the site: adds the pages of the tools to the menu and the two
generated reference pages, and fills in the table of properties where a page says
<!-- properties: NameOfTheProxy -->, and that of the similarities where it says
<!-- similarities -->. format_reference.py fills in its own markers."""

import pathlib
import re
import sys

from mkdocs.structure.files import File

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import format_reference  # noqa: E402
import property_reference  # noqa: E402
import python_reference  # noqa: E402
import similarity_reference  # noqa: E402

GENERATED = {"reference/python.md": python_reference.page,
             "reference/properties.md": property_reference.page}
PAGES = pathlib.Path(__file__).resolve().parents[2] / "Documentation"
MARKER = re.compile(r"<!-- properties: (\w+) -->")


TOOL = re.compile(r"^\| \[([\w ]+)\]\(([\w-]+\.md)\)", re.MULTILINE)


def on_config(config):
    """Adds the pages of the tools to the menu, in the order of the table of tools/index.md."""
    page = (PAGES / "tools" / "index.md").read_text(encoding="utf-8")
    chapter = next(part["Tools"] for part in config["nav"] if "Tools" in part)
    chapter[1:1] = [{name: f"tools/{file}"} for name, file in TOOL.findall(page)]
    return config


def on_files(files, config):
    for path, make in GENERATED.items():
        files.append(File.generated(config, path, content=make()))
    return files


def on_page_markdown(markdown, **_):
    tables = {proxy.name: property_reference.table(proxy)
              for proxy in property_reference.public_proxies()}
    pages = (path.read_text(encoding="utf-8") for path in PAGES.rglob("*.md"))
    markdown = format_reference.filled(markdown, pages)
    markdown = markdown.replace("<!-- similarities -->", similarity_reference.table())
    return MARKER.sub(lambda marker: tables[marker[1]], markdown)
