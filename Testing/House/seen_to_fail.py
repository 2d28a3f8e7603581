# SPDX-License-Identifier: BSD-3-Clause
"""Proves that each check of the house finds what it looks for.

Each check meets a small checkout that is in order, where it must find nothing. Then it meets the
same checkout with one thing broken, where it must name the broken file.
"""

import pathlib
import subprocess
import tempfile
import unittest

import check_house
import forms
import rooms
import tidy
from functions import functions_of
from tree import Tree

LICENCE = "// SPDX-License-Identifier: BSD-3-Clause\n"


def header(name, body=""):
    guard = f"BrainShift_{name}_h"
    opening = f"{LICENCE}/// @file\n/// What {name} is for.\n"
    return f"{opening}#ifndef {guard}\n#define {guard}\n{body}\n#endif\n"


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
    files["Filters/Register/Similarities/Waves.cxx"] = (
        'Similarity describeWaves()\n{\n  result.name = "waves";\n}\n')
    files["Formats/Waves/README.md"] = "What lives here.\n"
    files["Formats/Waves/CMakeLists.txt"] = (
        "brainshift_add_format(Waves\n  KINDS Volumes Fields\n  SOURCES WavesVolume.cxx)\n")
    files["Formats/Waves/WavesVolume.h"] = header("WavesVolume")
    files["Formats/Waves/WavesVolume.cxx"] = '#include "Formats/Fields/FieldFile.h"\n'
    files["Filters/Bend.xml"] = "<ServerManagerConfiguration/>\n"
    files["Filters/CMakeLists.txt"] = (
        "set(classes vtkBend Deformation/Lattice.cxx Register/Similarities/Waves.cxx Bend.xml)\n")
    files["Representations/vtkDraw.cxx"] = '#include "vtkBend.h"\nvoid draw(int a, int b) {}\n'
    files["Representations/CMakeLists.txt"] = "set(classes vtkDraw)\nset(shaders Rays/rays.frag)\n"
    files["Shaders/Rays/rays.frag.glsl"] = "void main() {}\n"
    files["CMakeLists.txt"] = (
        "project(BrainShift VERSION 1.2.3)\nset(CMAKE_CXX_EXTENSIONS OFF)\n")
    files["CITATION.cff"] = "version: 1.2.3\n"
    files["CHANGELOG.md"] = "# Changelog\n\n## Unreleased\n\n## 1.2.3 - 2026-01-02\n"
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
    ("every_warning_goes_one_way", "Filters/vtkBend.cxx",
     'void vtkBend::Tell()\n{\n  vtkWarningMacro("bent");\n}\n', None),
    ("architecture_says_what_a_folder_uses", "ARCHITECTURE.md",
     "| [Filters](Filters/README.md) | what is attached | all |\n", None),
    ("no_include_runs_upwards", "Filters/Deformation/Lattice.h",
     header("Lattice", '#include "Filters/Attached/Map.h"'), "Filters/Attached/Map.h"),
    ("no_include_runs_upwards", "Widgets/Hand.h",
     header("Hand", '#include "Representations/Gpu/Program.h"'), "Representations/Gpu/Program.h"),
    ("no_include_runs_upwards", "Representations/Gpu/Pass.cxx", '#include "vtkDraw.h"\n',
     "Representations/vtkDraw.h"),
    ("no_include_runs_upwards", "Filters/Cellar/Deep.h", header("Deep"), None),
    ("no_library_where_it_is_kept_out", "Filters/Deformation/Kernels.h",
     header("Kernels", "#include <vtkImageData.h>"), None),
    ("no_library_where_it_is_kept_out", "Filters/vtkShow.cxx", "#include <QWidget>\n", None),
    ("no_library_where_it_is_kept_out", "Filters/vtkShow.cxx",
     '#include "vtkOpenGLState.h"\n', None),
    ("no_library_where_it_is_kept_out", "Representations/Gpu/Ask.cxx",
     "#include <pqApplicationCore.h>\n", None),
    ("no_wrapped_header_leads_to_matrices", "Filters/vtkBend.h",
     header("Bend", '#include "Filters/Deformation/Lattice.h"\n#include <glm/mat3x3.hpp>').replace(
         "BrainShift_Bend_h", "vtkBend_h"), None),
    ("no_circle_between_files", "Filters/Deformation/Lattice.cxx",
     '#include "Filters/Deformation/Stroke.h"\n', "Filters/Deformation/Stroke.h"),
    ("no_circle_between_files", "Testing/Support/helper.py",
     "def f():\n    import Pick\n", None),
    ("no_file_is_long", "Representations/vtkDraw.cxx", "int a;\n" * 701, None),
    ("no_file_is_long", "Shaders/Rays/rays.frag.glsl", "int a;\n" * 151, None),
    ("no_file_is_long", "Filters/Bend.xml", "<a/>\n" * 701, None),
    ("no_file_names_a_tool_of_another", "Interaction/Tools/TwistTool.cxx",
     "int f() { return int(Tool::Twist) + int(Tool::Stamp); }\n", None),
    ("no_file_names_a_tool_of_another", "Panel/Tools/Buttons.cxx",
     "bool f(Tool tool) { return tool == Tool::Twist; }\n", None),
    ("no_file_outside_its_folder_names_a_format", "Filters/vtkShow.cxx",
     '#include "Formats/Waves/WavesVolume.h"\n', None),
    ("no_file_outside_its_folder_names_a_format", "Formats/Volumes/List.cxx",
     "extern const VolumeFormat VolumesOfWaves;\n", None),
    ("no_include_runs_upwards", "Formats/Waves/WavesVolume.cxx",
     '#include "Formats/Surfaces/Surface.h"\n', "Formats/Surfaces/Surface.h"),
    ("every_room_says_what_it_is_for", "Formats/Waves/README.md", None, None),
    ("no_function_is_long", "Filters/Deformation/Lattice.cxx", "void f()\n" + LONG_BODY, None),
    ("no_function_is_long", "Testing/Support/helper.py",
     "def f():\n" + "    pass\n" * 60, None),
    ("no_signature_is_long", "Representations/vtkDraw.cxx", f"int draw{SIX}\n{{\n}}\n", None),
    ("no_signature_is_long", "Filters/Deformation/Lattice.cxx", f"int bend{SIX}\n{{\n}}\n", None),
    ("no_line_is_wide", "Filters/Deformation/Lattice.cxx", "// " + "x" * 98 + "\n", None),
    ("every_source_is_built", "Testing/Cxx/Representations/FrustumTest.cxx", "\n", None),
    ("every_source_is_built", "Filters/CMakeLists.txt", "# Deformation/Lattice.cxx\n", None),
    ("every_shader_is_built", "Shaders/Rays/march.glsl", "\n", None),
    ("every_script_runs", "Testing/Python/Drawing/Rings.py", "\n", None),
    ("every_script_runs", "Testing/XML/Traces.xml", "<a/>\n", None),
    ("every_test_of_a_format_is_found", "Testing/Formats/Waves/WavesErrors.cxx", "\n", None),
    ("every_test_of_a_format_is_found", "Testing/Formats/Wave/WaveTest.cxx", "\n", None),
    ("every_proxy_is_loaded", "Filters/Bake.xml", "<a/>\n", None),
    ("every_header_opens", "Filters/Deformation/Lattice.h",
     header("Lattice").replace("/// What Lattice is for.\n", ""), None),
    ("every_header_opens", "Filters/Deformation/Lattice.h",
     header("Lattice").replace("/// @file\n", ""), None),
    ("every_header_opens", "Filters/Deformation/Lattice.h", header("Matrix"), None),
    ("every_header_opens", "Filters/Deformation/Lattice.h",
     header("Lattice").replace(LICENCE, ""), None),
    ("every_place_names_the_same_version", "CITATION.cff", "version: 1.2.2\n", None),
    ("every_place_names_the_same_version", "CHANGELOG.md", "## Unreleased\n", None),
    ("no_release_is_long", "CHANGELOG.md", "\n## 1.2.3 - 2026-01-02\n" + "- a\n" * 60, None),
    ("no_similarity_is_named_elsewhere", "Representations/vtkDraw.cxx",
     "enum class Similarity\n{\n  Waves\n};\n", None),
    ("no_similarity_is_named_elsewhere", "Python/brainshift/registering.py",
     'def refine(similarity="waves"):\n    pass\n', None),
    ("every_room_says_what_it_is_for", "Filters/Traces/README.md", None, None),
    ("no_system_is_called_elsewhere", "Filters/vtkBend.cxx", "#include <unistd.h>\n", None),
    ("no_system_is_called_elsewhere", "Filters/vtkBend.cxx",
     "void f(std::time_t now, std::tm* parts)\n{\n  localtime_r(&now, parts);\n}\n", None),
    ("no_extension_of_a_compiler_is_used", "Filters/vtkBend.cxx",
     "int f(int a)\n{\n  return __builtin_popcount(a);\n}\n", None),
    ("no_extension_of_a_compiler_is_used", "Filters/CMakeLists.txt", "project(Bend)\n", None),
    ("no_integer_is_long", "Filters/vtkBend.cxx", "long size(const std::string& file);\n", None),
    ("no_integer_is_long", "Filters/vtkBend.cxx", "unsigned long bytes = 0;\n", None),
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

    def test_a_new_tool(self):
        """What CONTRIBUTING.md names for a new tool passes every check, and is at most 9 files."""
        files = house()
        new = {
            "Filters/Deformation/Stroke.h": header("Stroke", "enum class Tool { None, Twist };"),
            "Interaction/Tools/TwistTool.cxx": "int twistTool() { return int(Tool::Twist); }\n",
            "Interaction/Commands/Tools.cxx": "int twistTool();\nint all = twistTool();\n",
            "Interaction/CMakeLists.txt":
                "set(sources Commands/Tools.cxx Tools/TwistTool.cxx)\n",
            "Panel/Icons/twist.svg": "<svg/>\n",
            "Panel/Panel.qrc": "<file>Icons/twist.svg</file>\n",
            "Documentation/tools/twist.md": "# Twist\n",
            "Documentation/tools/index.md": "| [Twist](twist.md) |\n",
            "Testing/Python/Drawing/Pick.py": "TWIST = 4\n",
        }
        self.assertLessEqual(len(new), 9)
        files.update(new)
        for check in check_house.CHECKS:
            with self.subTest(check):
                self.assertEqual(found_in(check, files), [])

    def test_every_check_runs(self):
        listed = pathlib.Path(__file__).with_name("CMakeLists.txt").read_text(encoding="utf-8")
        for check in check_house.CHECKS:
            self.assertIn(f"  {check}\n", listed.replace(")", "\n"))

    def test_every_check_is_broken_once(self):
        self.assertEqual({check for check, *_ in BREAKS}, set(check_house.CHECKS))


class Tracked(unittest.TestCase):
    """Where git knows the files, scratch beside them is no part of the tree."""

    def git(self, folder, *arguments):
        subprocess.run(["git", "-C", folder, "-c", "user.name=a", "-c", "user.email=a@b",
                        *arguments], check=True, capture_output=True)

    def checkout(self, folder):
        """A checkout of one tracked file, with scratch beside it."""
        self.git(folder, "init")
        pathlib.Path(folder, "kept.py").write_text("VALUE = 1\n", encoding="utf-8")
        self.git(folder, "add", "kept.py")
        self.git(folder, "commit", "-m", "one")
        pathlib.Path(folder, "scratch.py").write_text("x" * 200, encoding="utf-8")

    def test_scratch_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            self.checkout(folder)
            self.assertEqual(Tree(folder).files, ["kept.py"])
            pathlib.Path(folder, "kept.py").unlink()
            self.assertEqual(Tree(folder).files, [], "what is gone has nothing to check")

    def test_a_worktree_has_tracked_files_too(self):
        with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as beside:
            self.checkout(folder)
            worktree = pathlib.Path(beside, "worktree")
            self.git(folder, "worktree", "add", str(worktree))
            (worktree / "scratch.py").write_text("", encoding="utf-8")
            self.assertTrue((worktree / ".git").is_file())
            self.assertEqual(Tree(worktree).files, ["kept.py"])

    def test_without_git_all_files_count(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "scratch.py").write_text("", encoding="utf-8")
            self.assertEqual(Tree(folder).files, ["scratch.py"])


class Packed(unittest.TestCase):
    """clang-tidy looks at files together only if they share no name of their own."""

    FIRST = "namespace\n{\nconstexpr int Limit = 3;\nQString tr(const char* text)\n{\n}\n}\n"
    SECOND = "using namespace a;\nclass Later;\nstruct Limit\n{\n};\nvoid f::tr2()\n{\n}\n"

    def test_own_names(self):
        self.assertEqual(tidy.own_names(self.FIRST), {"Limit", "tr"})
        self.assertEqual(tidy.own_names(self.SECOND), {"Limit"})

    def test_files_that_share_a_name_stay_apart(self):
        names = {"a": {"x"}, "b": {"x", "y"}, "c": {"z"}, "d": {"y"}}
        self.assertEqual(tidy.packed("abcd", names.get), [["a", "c", "d"], ["b"]])

    def test_a_group_has_an_end(self):
        for folder, expected in (("Filters", [24, 24, 2]), ("Testing/Cxx", [8] * 6 + [2])):
            paths = [f"{folder}/{number}.cxx" for number in range(50)]
            sizes = [len(group) for group in tidy.packed(paths, lambda path: set())]
            self.assertEqual(sizes, expected)


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
