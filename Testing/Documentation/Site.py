# SPDX-License-Identifier: BSD-3-Clause
# Proves that mkdocs builds the site without a warning, and that its pages need no network.
import os
import pathlib
import re
import subprocess
import tempfile

from documents import CHECKOUT, run_tests

# An address in these places makes a browser load something, unlike one in a link.
LOADED = re.compile(r'<(?:script|img|iframe)[^>]*\bsrc="?https?:|<link[^>]*rel="?stylesheet"?[^>]*'
                    r'href="?https?:|@import|url\(["\']?https?:')


def build(folder):
    # Not --quiet: it hides warnings from --strict, too.
    return subprocess.run(
        ["mkdocs", "build", "--strict", "--config-file", CHECKOUT / "mkdocs.yml",
         "--site-dir", folder], capture_output=True, text=True, check=False)


def test_the_site_builds_without_a_warning_and_loads_nothing():
    with tempfile.TemporaryDirectory(dir=os.environ.get("BRAINSHIFT_TEST_TEMP")) as folder:
        result = build(folder)
        assert result.returncode == 0, result.stdout + result.stderr
        pages = list(pathlib.Path(folder).rglob("*.html"))
        assert len(pages) > 25, len(pages)
        for page in pages:
            text = page.read_text(encoding="utf-8")
            found = LOADED.search(text)
            assert not found, f"{page} loads {text[found.start():found.end() + 60]}"
        index = pathlib.Path(folder, "filters", "free-form-deformation.html").read_text()
        assert "LatticeDimensions" in index and "properties:" not in index
        registration = pathlib.Path(folder, "filters", "registration.html").read_text()
        assert "same contrast" in registration and "similarities --" not in registration


run_tests(globals())
