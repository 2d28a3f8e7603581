# SPDX-License-Identifier: BSD-3-Clause
"""The rooms of the C++ code, and which room stands on which.

This table is the one place that says what may include what. A file may include files of its own
room, of the rooms named in its row, and of every room that those stand on.

Folders of file formats need no row. `stands_on` finds each by its call of brainshift_add_format: it
stands on what the formats of its kinds share, and Formats stands on it.
"""

import re
import sys

from tree import Tree

STANDS_ON = {
    "Common": [],
    "Formats/Files": ["Common"],
    "Formats/PackedFrames": ["Common"],
    "Formats/Volumes": ["Formats/Files"],
    "Formats/Fields": ["Formats/Volumes"],
    "Formats/DICOM": ["Formats/PackedFrames", "Formats/Volumes"],
    "Formats/Surfaces": ["Formats/MGH", "Formats/NIFTI"],
    "Formats/Transforms": ["Formats/NIFTI"],
    "Formats/Landmarks": ["Formats/Files"],
    "Formats/Slicer": ["Common"],
    "Formats/Writers": ["Formats/DICOM", "Formats/Fields"],
    "Formats": [
        "Formats/Landmarks", "Formats/Slicer", "Formats/Transforms", "Formats/Writers"],
    "Filters/Deformation": ["Common"],
    "Filters/Attached": ["Filters/Deformation"],
    "Filters/Fit": ["Filters/Deformation"],
    "Filters/Looks": ["Filters/Attached"],
    "Filters/Traces": ["Filters/Attached"],
    "Filters/Fields": ["Filters/Attached", "Formats"],
    "Filters/Register": ["Filters/Fit"],
    "Filters/Register/Similarities": ["Filters/Register"],
    "Filters/Registered": ["Filters/Fields", "Filters/Register"],
    "Filters/Measured": ["Filters/Fields", "Filters/Fit", "Filters/Traces"],
    "Filters/Electrodes": ["Filters/Measured"],
    "Filters": ["Filters/Electrodes", "Filters/Looks", "Filters/Measured", "Filters/Registered"],
    "Representations/Gpu": ["Filters"],
    "Representations/Scene": ["Representations/Gpu"],
    "Representations/Field": ["Representations/Scene"],
    "Representations/Skipping": ["Representations/Scene"],
    "Representations/Tissue": ["Representations/Skipping"],
    "Representations/Bricks": ["Representations/Tissue"],
    "Representations/Traces": ["Representations/Scene"],
    "Representations/Picture": ["Representations/Bricks", "Representations/Field"],
    "Representations/Slices": ["Representations/Bricks", "Representations/Field"],
    "Representations/Window": [
        "Representations/Picture", "Representations/Slices", "Representations/Traces"],
    "Representations/Workarounds": [],
    "Representations": ["Representations/Window", "Representations/Workarounds"],
    "Tracking": ["Common"],
    "Widgets": ["Filters"],
    "Interaction/Commands": ["Filters/Deformation"],
    "Interaction/Workarounds": ["Filters"],
    "Interaction/Views": ["Interaction/Commands", "Interaction/Workarounds", "Widgets"],
    "Interaction/Edits": ["Interaction/Views"],
    "Interaction/Landmarks": ["Interaction/Edits"],
    "Interaction/Cases": ["Interaction/Edits"],
    "Interaction/Tools": ["Interaction/Edits"],
    "Interaction/Displays": ["Interaction/Cases"],
    "Interaction/Pointer": ["Interaction/Edits", "Tracking"],
    "Interaction": ["Interaction/Cases", "Interaction/Displays", "Interaction/Landmarks",
                    "Interaction/Pointer", "Interaction/Tools"],
    "Panel/Parts": ["Interaction/Commands"],
    "Panel/Landmarks": ["Panel/Parts", "Interaction"],
    "Panel/Measured": ["Panel/Parts", "Interaction"],
    "Panel/Pointer": ["Panel/Parts", "Interaction"],
    "Panel/Registered": ["Panel/Parts", "Interaction"],
    "Panel/Case": ["Panel/Registered"],
    "Panel/Strokes": ["Panel/Parts", "Interaction"],
    "Panel/Tools": ["Panel/Parts", "Interaction"],
    "Panel/Properties": ["Panel/Landmarks", "Panel/Measured", "Panel/Registered", "Panel/Strokes",
                         "Panel/Tools"],
    "Panel/Window": ["Panel/Case", "Panel/Pointer", "Panel/Properties"],
    "Panel": ["Panel/Window"],
    "Plugin": ["Panel", "Representations"],
}

#: Libraries that a room and the rooms inside it must not include. Each has a pattern below.
KEEPS_OUT = {
    "Filters/Deformation": ["VTK"],
    "Filters/Fit": ["VTK"],
    "Filters/Register": ["VTK"],
    "Common": ["OpenGL", "Qt"],
    "Formats": ["OpenGL", "Qt"],
    "Filters": ["OpenGL", "Qt"],
    "Representations": ["Qt"],
    "Tracking": ["OpenGL", "Qt", "VTK"],
    "Widgets": ["Qt"],
}

#: How an included header shows which library it belongs to.
LIBRARIES = {
    "VTK": r"vtk(?!BrainShift)",
    "OpenGL": r"(vtk_gl|vtkOpenGL|GL/|Representations/Gpu/OpenGL)",
    "Qt": r"(Q[A-Z]|Qt|pq[A-Z])",
}


#: What the formats of a kind share.
KIND_ROOMS = {"Volumes": "Formats/Volumes", "Fields": "Formats/Fields",
              "Surfaces": "Formats/Surfaces", "Tracts": "Formats/Surfaces",
              "Landmarks": "Formats/Landmarks"}

FORMAT = re.compile(r"^brainshift_add_format\((\w+)\s+KINDS((?:\s+[A-Z][a-z]+)+)", re.MULTILINE)


def formats(tree):
    """(folder, name, kinds) of each format that a folder in Formats adds."""
    for path in tree.ending("/CMakeLists.txt"):
        if path.startswith("Formats/"):
            for name, kinds in FORMAT.findall(tree.text(path)):
                yield path.rpartition("/")[0], name, kinds.split()


def stands_on(tree):
    """The table, with a row for each folder of a format."""
    table = {room: list(lower) for room, lower in STANDS_ON.items()}
    for folder, _, kinds in formats(tree):
        if folder not in STANDS_ON:
            row = table.setdefault(folder, [])
            row += [room for kind in kinds if (room := KIND_ROOMS[kind]) not in row]
        if folder not in table["Formats"]:
            table["Formats"].append(folder)
    return table


def below(room, table):
    """All rooms that a room stands on in a table, directly or through others."""
    found = set()
    waiting = list(table[room])
    while waiting:
        lower = waiting.pop()
        if lower not in found:
            found.add(lower)
            waiting += table.get(lower, [])
    return found


def uses(folder, table):
    """What ARCHITECTURE.md says of a folder: what it stands on, and what it keeps out."""
    inside = [room for room in table if (room + "/").startswith(folder + "/")]
    lower = {room for each in inside for room in table[each]
             if not (room + "/").startswith(folder + "/")}
    module = folder.partition("/")[0]
    names = sorted({room if room.startswith(module + "/") else room.partition("/")[0]
                    for room in lower})
    text = ", ".join(f"`{name}`" for name in names)
    out = KEEPS_OUT.get(folder, KEEPS_OUT.get(module, []))
    return "; ".join(filter(None, [text, ", ".join(f"no {library}" for library in out)])) or "all"


ROW = re.compile(r"^\| \[([\w/]+)\]\([^)]*\) \| (.*) \| (.*) \|$")


def architecture(text, table):
    """ARCHITECTURE.md, with the last column of its table of folders as the rooms are."""
    lines = text.split("\n")
    for number, line in enumerate(lines):
        row = ROW.match(line)
        if row and row[1] in table:
            lines[number] = line[:row.start(3)] + uses(row[1], table) + " |"
    return "\n".join(lines)


def main():
    """Writes that column: python3 rooms.py CHECKOUT."""
    tree = Tree(sys.argv[1])
    text = architecture(tree.text("ARCHITECTURE.md"), stands_on(tree))
    with open(f"{sys.argv[1]}/ARCHITECTURE.md", "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
