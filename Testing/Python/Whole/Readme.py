# SPDX-License-Identifier: BSD-3-Clause
# Proves that the Python in README.md runs as it stands there and draws a bent volume.
import os
import re
import tempfile

from brainshift_testing import load_plugin, run_tests

load_plugin()
from paraview import simple  # noqa: E402 after the plugin

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", ".."))


def python_of_readme():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as readme:
        blocks = re.findall(r"```python\n(.*?)```", readme.read(), re.DOTALL)
    assert len(blocks) == 1, blocks
    return blocks[0]


def test_python_of_readme_runs():
    code = python_of_readme()
    names = {}
    with tempfile.TemporaryDirectory() as folder:
        os.symlink(os.path.join(ROOT, "Testing"), os.path.join(folder, "Testing"))
        previous = os.getcwd()
        os.chdir(folder)
        try:
            exec(compile(code, "README.md", "exec"), names)
            assert os.path.getsize("bent.png") > 10000, os.path.getsize("bent.png")
        finally:
            os.chdir(previous)
    names["bent"].UpdatePropertyInformation()
    assert 9.6 < names["bent"].MaximumDisplacement <= 12.0, names["bent"].MaximumDisplacement
    shown = simple.GetDisplayProperties(names["bent"], names["view"])
    assert shown.Representation == "Deformed Volume", shown.Representation
    assert shown.DrawSegment == 1, "the brain alone"


run_tests(globals())
