// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Tools/ToolFactory.h"

#include "Interaction/Tools/MoveTool.h"
#include "Interaction/Tools/PullTool.h"
#include "Interaction/Tools/SoftTool.h"
#include "Interaction/Tools/StampTool.h"

namespace brainshift
{
std::unique_ptr<HandTool> makeTool(ToolKind kind, const ToolBench& bench)
{
  switch (kind)
  {
    case ToolKind::Move:
      return std::make_unique<MoveTool>(bench);
    case ToolKind::Soft:
      return std::make_unique<SoftTool>(bench);
    case ToolKind::Stamp:
      return std::make_unique<StampTool>(bench);
    case ToolKind::Pull:
      return std::make_unique<PullTool>(bench);
    case ToolKind::None:
      break;
  }
  return {};
}
}
