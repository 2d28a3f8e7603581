// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The arrow keys as a mouse: where they bring the cursor over a view.
#ifndef BrainShift_ArrowKeys_h
#define BrainShift_ArrowKeys_h

#include "vtkLatticeWidget.h"

#include <glm/vec2.hpp>

#include <optional>

class pqRenderView;

namespace brainshift
{
/// One step from a place (pixels from the view's lower left corner); without a place, to the middle
/// of the view. `way`: 0 left, 1 right, 2 up, 3 down. The step is longer than a hand trembles.
HandEvent steppedByKey(pqRenderView* view, const std::optional<glm::ivec2>& from, int way);

/// Takes the mouse along, where the system lets a program move it.
void takeMouseAlong(pqRenderView* view, const HandEvent& to);

/// Whether keys that are typed now go to a view.
bool hasKeyboard(pqRenderView* view);
}

#endif
