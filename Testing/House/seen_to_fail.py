# SPDX-License-Identifier: BSD-3-Clause
"""Proves that each check of the house finds what it looks for.

Each check meets a small checkout that is in order, where it must find nothing. Then it meets the
same checkout with one thing broken, where it must name the broken file.
"""

import pathlib
import tempfile
import unittest

import check_house
import forms
import rooms
from functions import functions_of
from tree import Tree

LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n"


def header(name, body=""):
    guard = f"BrainShift_{name}_h"
    return f"{LICENCE}/// What {name} is for.\n#ifndef {guard}\n#define {guard}\n{body}\n#endif\n"


def house():
    """A checkout that is in order: what each file holds, by its path."""
    files = {f"{room}/README.md": "What lives here.\n"
             for room in [*rooms.STANDS_ON, *forms.MORE_ROOMS]}
    files["Filters/Deformation/Lattice.h"] = header("Lattice")
    files["Filters/Deformation/Lattice.cxx"] = '#include "Filters/Deformation/Lattice.h"\n'
    files["Filters/vtkBend.h"] = header("Bend", '#include "Filters/Deformation/Lattice.h"').replace(
        "BrainShift_Bend_h", "vtkBend_h")
    files["Filters/vtkBend.cxx"] = (
        "brainshiftGuardRequestsMacro(vtkBend);\nint vtkBend::RequestData(int) { return 1; }\n")
    files["Filters/Bend.xml"] = "<ServerManagerConfiguration/>\n"
    files["Filters/CMakeLists.txt"] = "set(classes vtkBend Deformation/Lattice.cxx Bend.xml)\n"
    files["Representations/vtkDraw.cxx"] = '#include "vtkBend.h"\nvoid draw(int a, int b) {}\n'
    files["Representations/CMakeLists.txt"] = "set(classes vtkDraw)\nset(shaders Rays/rays.frag)\n"
    files["Shaders/Rays/rays.frag.glsl"] = "void main() {}\n"
    files["Testing/Python/CMakeLists.txt"] = "set(python_tests Drawing/Pick)\n"
    files["Testing/Python/Drawing/Pick.py"] = "import helper\n"
    files["Testing/Support/helper.py"] = "VALUE = 1\n"
    return files


def found_in(check, files):
    with tempfile.TemporaryDirectory() as folder:
        for path, text in files.items():
            if text is not None:
                place = pathlib.Path(folder, path)
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_text(text, encoding="utf-8")
        return list(check_house.CHECKS[check](Tree(folder)))


LONG_BODY = "{\n" + "  f();\n" * 60 + "}\n"
SIX = "(int a, std::map<int, int> b, int (*c)(int, int), int d, int e, int f)"

#: For each check: what is put into the checkout, and the file that must be named.
BREAKS = [
    ("every_boundary_is_guarded", "Filters/vtkBend.cxx",
     "int vtkBend::RequestData(int) { return 1; }\n", None),
    ("every_boundary_is_guarded", "Filters/vtkBend.cxx",
     "brainshiftGuardRequestsMacro(vtkBow);\nint vtkBend::RequestInformation(int) { return 1; }\n",
     None),
    ("every_boundary_is_guarded", "Filters/vtkBend.cxx",
     "void vtkBend::WriteData()\n{\n  write();\n}\n", None),
    ("every_boundary_is_guarded", "Representations/vtkDraw.cxx",
     "void vtkDraw::Render(int)\n{\n  draw();\n}\nvoid f() { guarded(0); }\n", None),
    ("no_include_runs_upwards", "Filters/Deformation/Lattice.h",
     header("Lattice", '#include "Filters/Attached/Map.h"'), "Filters/Attached/Map.h"),
    ("no_include_runs_upwards", "Widgets/Hand.h",
     header("Hand", '#include "Representations/Gpu/Program.h"'), "Representations/Gpu/Program.h"),
    ("no_include_runs_upwards", "Representations/Gpu/Pass.cxx", '#include "vtkDraw.h"\n',
     "Representations/vtkDraw.h"),
    ("no_include_runs_upwards", "Filters/Cellar/Deep.h", header("Deep"), None),
    ("no_library_where_it_is_kept_out", "Filters/Deformation/Grid.h",
     header("Grid", "#include <vtkImageData.h>"), None),
    ("no_library_where_it_is_kept_out", "Filters/vtkShow.cxx", "#include <QWidget>\n", None),
    ("no_library_where_it_is_kept_out", "Filters/vtkShow.cxx",
     '#include "vtkOpenGLState.h"\n', None),
    ("no_library_where_it_is_kept_out", "Representations/Gpu/Ask.cxx",
     "#include <pqApplicationCore.h>\n", None),
    ("no_circle_between_files", "Filters/Deformation/Lattice.cxx",
     '#include "Filters/Deformation/Stroke.h"\n', "Filters/Deformation/Stroke.h"),
    ("no_circle_between_files", "Testing/Support/helper.py",
     "def f():\n    import Pick\n", None),
    ("no_file_is_long", "Representations/vtkDraw.cxx", "int a;\n" * 701, None),
    ("no_file_is_long", "Shaders/Rays/rays.frag.glsl", "int a;\n" * 151, None),
    ("no_file_is_long", "Filters/Bend.xml", "<a/>\n" * 501, None),
    ("no_function_is_long", "Filters/Deformation/Lattice.cxx", "void f()\n" + LONG_BODY, None),
    ("no_function_is_long", "Testing/Support/helper.py",
     "def f():\n" + "    pass\n" * 60, None),
    ("no_signature_is_long", "Representations/vtkDraw.cxx", f"int draw{SIX}\n{{\n}}\n", None),
    ("no_line_is_wide", "Filters/Deformation/Lattice.cxx", "// " + "x" * 98 + "\n", None),
    ("every_source_is_built", "Testing/Cxx/Representations/FrustumTest.cxx", "\n", None),
    ("every_source_is_built", "Filters/CMakeLists.txt", "# Deformation/Lattice.cxx\n", None),
    ("every_shader_is_built", "Shaders/Rays/march.glsl", "\n", None),
    ("every_script_runs", "Testing/Python/Drawing/Rings.py", "\n", None),
    ("every_script_runs", "Testing/XML/Traces.xml", "<a/>\n", None),
    ("every_proxy_is_loaded", "Filters/Bake.xml", "<a/>\n", None),
    ("every_header_opens", "Filters/Deformation/Lattice.h",
     header("Lattice").replace("/// What Lattice is for.\n", ""), None),
    ("every_header_opens", "Filters/Deformation/Lattice.h", header("Matrix"), None),
    ("every_header_opens", "Filters/Deformation/Lattice.h",
     header("Lattice").replace(LICENCE, ""), None),
    ("every_room_says_what_it_is_for", "Filters/Traces/README.md", None, None),
]


def broken(path, text, beside):
    files = house()
    files[path] = text
    if beside is not None:  # the file that is included; a circle needs the way back
        files[beside] = header("Beside", f'#include "{path.replace(".cxx", ".h")}"')
    return files


class SeenToFail(unittest.TestCase):
    """Each check finds nothing in a house in order, and what is broken in a broken one."""

    def test_house_in_order(self):
        for check in check_house.CHECKS:
            with self.subTest(check):
                self.assertEqual(found_in(check, house()), [])

    def test_each_break_is_found(self):
        for check, path, text, beside in BREAKS:
            with self.subTest(f"{check}: {path}"):
                found = found_in(check, broken(path, text, beside))
                self.assertTrue(found, "nothing was found")
                name = path.removesuffix("/README.md").rpartition("/")[2].partition(".")[0]
                if path != "Filters/CMakeLists.txt":
                    self.assertTrue(any(name in sentence for sentence in found), found)

    def test_crowded_folder(self):
        files = house()
        files.update({f"Panel/{number}.svg": "" for number in range(34)})
        self.assertEqual(found_in("no_folder_is_crowded", files), [])
        files["Panel/one-more.svg"] = ""
        self.assertTrue(found_in("no_folder_is_crowded", files)[0].startswith("Panel: has 36"))

    def test_every_check_runs(self):
        listed = pathlib.Path(__file__).with_name("CMakeLists.txt").read_text(encoding="utf-8")
        for check in check_house.CHECKS:
            self.assertIn(f"  {check}\n", listed.replace(")", "\n"))

    def test_every_check_is_broken_once(self):
        self.assertEqual({check for check, *_ in BREAKS} | {"no_folder_is_crowded"},
                         set(check_house.CHECKS))


class Functions(unittest.TestCase):
    """The reader of C++ finds each function with its lines and its parameters."""

    CODE = """
namespace brainshift
{
class Lattice : public Base<int, int>
{
public:
  Lattice(int a, int b) : A{ a }, B(b) {}
  explicit Lattice(const Lattice&);
  int at(glm::ivec3 node) const { return this->Data[node.x]; }
  bool operator()(int a) const
  {
    const auto less = [](int x, int y) { return x < y; };
    return less(a, 1);
  }
};
template <class Value, int Size>
Value sum(const std::array<Value, Size>& values, int (*of)(int, int)) // {
{
  const char* brace = "{";
  for (Value value : values)
  {
    of(value, '{');
  }
  return {};
}
const int table[] = { 1, 2 };
}
"""

    def test_finds_all(self):
        found = [(f.name, f.lines, f.parameters, f.constructor) for f in functions_of(self.CODE)]
        self.assertEqual(found, [("Lattice", 1, 2, True), ("at", 1, 1, False),
                                 ("operator()", 5, 1, False), ("sum", 10, 2, False)])


if __name__ == "__main__":
    unittest.main()
