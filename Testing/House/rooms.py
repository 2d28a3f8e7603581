# SPDX-License-Identifier: BSD-3-Clause
"""The rooms of the C++ code, and which room stands on which.

This table is the one place that says what may include what. A file may include files of its own
room, of the rooms named in its row, and of every room that those stand on.
"""

STANDS_ON = {
    "Common": [],
    "Formats/Files": ["Common"],
    "Formats/PackedFrames": ["Common"],
    "Formats/Volumes": ["Formats/Files"],
    "Formats/Fields": ["Formats/Volumes"],
    "Formats/NIFTI": ["Formats/Fields"],
    "Formats/TextHeaders": ["Formats/Fields"],
    "Formats/MGH": ["Formats/Volumes"],
    "Formats/MINC": ["Formats/Volumes"],
    "Formats/DICOM": ["Formats/PackedFrames", "Formats/Volumes"],
    "Formats/Surfaces": ["Formats/MGH", "Formats/NIFTI"],
    "Formats/FreeSurfer": ["Formats/Surfaces"],
    "Formats/GIFTI": ["Formats/Surfaces"],
    "Formats/MRtrix": ["Formats/Surfaces"],
    "Formats/TrackVis": ["Formats/Surfaces"],
    "Formats/Transforms": ["Formats/NIFTI"],
    "Formats/Landmarks": ["Formats/Files"],
    "Formats/Writers": ["Formats/DICOM", "Formats/Fields"],
    "Formats": [
        "Formats/FreeSurfer", "Formats/GIFTI", "Formats/Landmarks", "Formats/MINC",
        "Formats/MRtrix", "Formats/TextHeaders", "Formats/TrackVis", "Formats/Transforms",
        "Formats/Writers"],
    "Filters/Deformation": ["Common"],
    "Filters/Attached": ["Filters/Deformation"],
    "Filters/Fit": ["Filters/Deformation"],
    "Filters/Looks": ["Filters/Attached"],
    "Filters/Traces": ["Filters/Attached"],
    "Filters/Fields": ["Filters/Attached", "Formats"],
    "Filters/Register": ["Filters/Fit"],
    "Filters/Register/Similarities": ["Filters/Register"],
    "Filters/Registered": ["Filters/Fields", "Filters/Register"],
    "Filters/Transforms": ["Filters/Attached", "Formats"],
    "Filters/Measured": ["Filters/Fields", "Filters/Fit", "Filters/Traces"],
    "Filters": [
        "Filters/Looks", "Filters/Measured", "Filters/Registered", "Filters/Transforms"],
    "Representations/Gpu": ["Filters"],
    "Representations/Scene": ["Representations/Gpu"],
    "Representations/Field": ["Representations/Scene"],
    "Representations/Skipping": ["Representations/Scene"],
    "Representations/Tissue": ["Representations/Skipping"],
    "Representations/Traces": ["Representations/Scene"],
    "Representations/Picture": ["Representations/Field", "Representations/Tissue"],
    "Representations/Slices": ["Representations/Field", "Representations/Tissue"],
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
    "Interaction/Tools": ["Interaction/Edits"],
    "Interaction/Displays": ["Interaction/Views"],
    "Interaction/Pointer": ["Interaction/Edits", "Tracking"],
    "Interaction": ["Interaction/Displays", "Interaction/Landmarks", "Interaction/Pointer",
                    "Interaction/Tools"],
    "Panel/Parts": ["Interaction/Commands"],
    "Panel/Landmarks": ["Panel/Parts", "Interaction"],
    "Panel/Measured": ["Panel/Parts", "Interaction"],
    "Panel/Pointer": ["Panel/Parts", "Interaction"],
    "Panel/Registered": ["Panel/Parts", "Interaction"],
    "Panel/Strokes": ["Panel/Parts", "Interaction"],
    "Panel/Tools": ["Panel/Parts", "Interaction"],
    "Panel/Properties": ["Panel/Landmarks", "Panel/Measured", "Panel/Registered", "Panel/Strokes",
                         "Panel/Tools"],
    "Panel/Window": ["Panel/Pointer", "Panel/Properties"],
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


def below(room):
    """All rooms that a room stands on, directly or through others."""
    found = set()
    waiting = list(STANDS_ON[room])
    while waiting:
        lower = waiting.pop()
        if lower not in found:
            found.add(lower)
            waiting += STANDS_ON[lower]
    return found
