# SPDX-License-Identifier: BSD-3-Clause
"""Walks the recipes of CONTRIBUTING.md in a copy of the checkout: a reader, a similarity, a tool.

    python3 walks.py CHECKOUT CMAKE GENERATOR MAKE_PROGRAM

Each walk adds a dummy by its recipe. It counts the files that the recipe touches, and proves that
every check of the house passes then, and that lists and pages which are made have the dummy. What
the dummy is to do is no part of the walk: C++ is not compiled.
"""

import functools
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import check_house
from tree import Tree

CHECKOUT, CMAKE = None, []
#: Folders that no walk needs, with large files.
LEFT = ("Documentation/pictures/", "Testing/Data/")

STUBS = """cmake_minimum_required(VERSION 3.24)
project(Walk NONE)
function (vtk_module_add_module)
endfunction ()
function (vtk_module_include)
endfunction ()
function (vtk_module_link)
endfunction ()
function (paraview_add_server_manager_xmls)
endfunction ()
add_subdirectory("{formats}" Formats)
"""

TOY_README = """# Toy

| | |
|---|---|
| format | Toy |
| read | `.toy` |
| written | – |
| axes | RAS |
| unit | mm |
| library | none |
| limits | one volume |

Opens `.toy` files. Their axes are those of the scanner.
"""

TOY_CMAKE = """brainshift_add_format(Toy
  KINDS Volumes
  EXTENSIONS toy
  SOURCES ToyVolume.cxx)
"""

TOY_VOLUME = """// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/VolumeFile.h"

namespace brainshift
{
extern const VolumeFormat VolumesOfToy{ "Toy", isToyFile, makeVolumeFile<ToyVolume> };
}
"""

TEST = "# SPDX-License-Identifier: BSD-3-Clause\n"


@functools.lru_cache(maxsize=None)
def found_by_all(root):
    """What the checks of the house find in a checkout."""
    tree = Tree(root)
    return {sentence for check in check_house.CHECKS.values() for sentence in check(tree)}


class Walk:
    """A copy of the checkout, and what was changed in it."""

    def __init__(self, folder):
        self.root = pathlib.Path(folder, "copy")
        self.touched = set()
        for path in Tree(CHECKOUT).files:
            if not path.startswith(LEFT):
                place = self.root / path
                place.parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(CHECKOUT / path, place)

    def write(self, path, text):
        place = self.root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text, encoding="utf-8")
        self.touched.add(path)

    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8")

    def after(self, path, line, more):
        """Puts more lines after a line of a file."""
        text = self.text(path)
        assert line in text, f"{path} has no longer {line!r}"
        self.write(path, text.replace(line, line + more, 1))

    def like(self, path, other, words):
        """Writes a file like another one, with other words."""
        text = self.text(other)
        for word, new in words.items():
            text = text.replace(word, new)
        self.write(path, text)

    def complaints(self):
        """What the checks of the house find, but for what they find in the checkout too."""
        return sorted(found_by_all(self.root) - found_by_all(CHECKOUT))

    def says(self, code):
        """What a script prints that stands in the copy's folder of the documentation."""
        done = subprocess.run([sys.executable, "-B", "-c", code], check=True, text=True,
                              capture_output=True, cwd=self.root / "Utilities" / "documentation")
        return done.stdout


class Walks(unittest.TestCase):
    """Each recipe touches as few files as it says."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.walk = Walk(folder.name)

    def is_done_with(self, most):
        self.assertEqual(self.walk.complaints(), [])
        self.assertLessEqual(len(self.walk.touched), most, sorted(self.walk.touched))

    def configured(self):
        """The build folder of the formats, whose lists CMake has written."""
        (self.folder / "CMakeLists.txt").write_text(
            STUBS.format(formats=self.walk.root / "Formats"), encoding="utf-8")
        build = self.folder / "build"
        done = subprocess.run([*CMAKE, "-S", self.folder, "-B", build], check=False, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return build / "Formats"

    def test_a_reader_of_volumes(self):
        self.walk.write("Formats/Toy/ToyVolume.cxx", TOY_VOLUME)
        self.walk.write("Formats/Toy/CMakeLists.txt", TOY_CMAKE)
        self.walk.write("Formats/Toy/README.md", TOY_README)
        self.walk.write("Testing/Formats/Toy/Toy.py", TEST)
        self.walk.after("CHANGELOG.md", "\n## ", "")
        built = self.configured()
        self.assertIn("&VolumesOfToy", (built / "ListOfFormats.cxx").read_text(encoding="utf-8"))
        proxy = (built / "Toy" / "ToyVolumeReader.xml").read_text(encoding="utf-8")
        self.assertIn('<ReaderFactory extensions="toy"', proxy)
        self.assertIn("Read a Toy volume in RAS millimetres.", proxy)
        self.assertNotIn("@", proxy)
        made = self.walk.says("import format_reference, property_reference;"
                              "print(format_reference.table('Volumes'));"
                              "print(format_reference.readers(set()));"
                              "print(property_reference.page())")
        self.assertIn("| Toy | `.toy` |", made)
        self.assertIn("## Toy Volume Reader\n\nOpens `.toy` files.", made)
        self.assertIn("### Toy Volume Reader", made)
        self.is_done_with(5)

    def test_a_similarity(self):
        room = "Filters/Register/Similarities"
        self.walk.like(f"{room}/Toy.cxx", f"{room}/LocalCorrelation.cxx",
                       {"LocalCorrelation": "Toy", "localCorrelation": "toy",
                        "same contrast": "toy", "Same contrast": "Toy"})
        self.walk.after("Filters/Register/CMakeLists.txt", "  Similarities/Ultrasound.cxx",
                        "\n  Similarities/Toy.cxx")
        self.walk.after("Testing/Cxx/Register/SimilarityTest.cxx", "\n", "")
        self.walk.after("CHANGELOG.md", "\n## ", "")
        made = self.walk.says("import similarity_reference; print(similarity_reference.table())")
        self.assertIn('| `"toy"` |', made)
        self.is_done_with(4)

    def test_a_tool(self):
        self.walk.after("Filters/Deformation/Stroke.h", "  Pull = 3,\n", "  Twirl = 4,\n")
        self.walk.after("Filters/Deformation/Stroke.h", "StrokeShape::None },\n",
                        '  ToolTraits{ Tool::Twirl, "Twirl", StrokeShape::Sphere },\n')
        self.walk.like("Interaction/Tools/TwirlTool.cxx", "Interaction/Tools/SoftTool.cxx",
                       {"Soft": "Twirl", "soft": "twirl"})
        self.walk.after("Interaction/CMakeLists.txt", "  Tools/SoftTool.cxx\n",
                        "  Tools/TwirlTool.cxx\n")
        table = "Interaction/Commands/Tools.cxx"
        self.walk.after(table, "ToolRow pullTool();\n", "ToolRow twirlTool();\n")
        self.walk.after(table, "    pullTool(),\n", "    twirlTool(),\n")
        self.walk.like("Panel/Icons/twirl.svg", "Panel/Icons/soft.svg", {})
        self.walk.after("Panel/Panel.qrc", '<file alias="soft.svg">Icons/soft.svg</file>\n',
                        '    <file alias="twirl.svg">Icons/twirl.svg</file>\n')
        self.walk.like("Documentation/tools/twirl.md", "Documentation/tools/soft.md", {})
        self.walk.after("Documentation/tools/index.md",
                        "| [Soft](soft.md) | Alt+2 | everything within a sphere |\n",
                        "| [Twirl](twirl.md) | Alt+5 | everything within a sphere |\n")
        self.walk.after("Documentation/keys.md", "| Alt+4 |", "")  # PanelTest writes the row
        self.is_done_with(9)


if __name__ == "__main__":
    CHECKOUT = pathlib.Path(sys.argv[1]).resolve()
    CMAKE = [sys.argv[2], "-G", sys.argv[3], f"-DCMAKE_MAKE_PROGRAM={sys.argv[4]}"]
    unittest.main(argv=sys.argv[:1])
