# SPDX-License-Identifier: BSD-3-Clause
"""Checks that no C++ exception can leave our code for VTK, which would end ParaView or its server.

Common/Guard.h is the guard. Requests of the pipeline pass it in ProcessRequest, one line
for a class; what draws calls it itself. Warnings have one way, too.
"""

import re

from functions import functions_of

#: What the pipeline calls through ProcessRequest.
REQUESTS = {"RequestData", "RequestInformation", "RequestUpdateExtent", "RequestDataObject",
            "WriteData"}

#: What a view calls.
DRAWS = {"Render", "RenderOpaqueGeometry", "RenderTranslucentPolygonalGeometry",
         "RenderVolumetricGeometry", "RenderOverlay", "ProcessViewRequest"}

#: How VTK warns.
WARNS = re.compile(r"vtk(Generic)?Warning(WithObject)?Macro")

ROOMS = ("Common", "Formats", "Filters", "Representations", "Widgets", "Interaction", "Panel",
         "Plugin")


def every_boundary_is_guarded(tree):
    """Requests of the pipeline and drawing go through the guard, which lets no exception pass."""
    for path in tree.below(*ROOMS, suffixes=(".cxx",)):
        text = tree.text(path)
        lines = text.splitlines()
        unguarded = set()
        for function in functions_of(text):
            owner, _, name = function.name.rpartition("::")
            body = "\n".join(lines[function.line - 1:function.line - 1 + function.lines])
            if owner and name in DRAWS and "guarded(" not in body:
                yield f"{path}:{function.line}: {function.name} does not call guarded()"
            macro = f"brainshiftGuardRequestsMacro({owner})"
            if owner and name in REQUESTS and macro not in text and owner not in unguarded:
                unguarded.add(owner)
                yield f"{path}:{function.line}: {owner} answers requests without {macro}"


def every_warning_goes_one_way(tree):
    """Warnings go through warn() of Common/Guard.h, by which the window knows them."""
    for path in tree.below(*ROOMS, suffixes=(".cxx", ".h")):
        for number, line in enumerate(tree.text(path).splitlines(), 1):
            if WARNS.search(line) and path != "Common/Guard.cxx":
                yield f"{path}:{number}: a warning that does not go through warn()"


CHECKS = [every_boundary_is_guarded, every_warning_goes_one_way]
