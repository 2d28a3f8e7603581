// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Makes the tool of a kind. It is the only place that knows all tools.
#ifndef BrainShift_ToolFactory_h
#define BrainShift_ToolFactory_h

#include "Interaction/Tools/HandTool.h"

#include <memory>

namespace brainshift
{
/// Null for ToolKind::None.
std::unique_ptr<HandTool> makeTool(ToolKind kind, const ToolBench& bench);
}

#endif
