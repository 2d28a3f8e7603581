// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The Soft tool: drags the tissue under the cursor. Tissue within the radius follows, less and
/// less towards the edge.
#ifndef BrainShift_SoftTool_h
#define BrainShift_SoftTool_h

#include "Interaction/Tools/HandTool.h"

namespace brainshift
{
class SoftTool : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  bool wheel(const HandEvent& event) override;
  void settle() override;

private:
  void pullTo(const glm::dvec2& pixel);

  Grip Held; ///< In the deformed frame, before the stroke.
};
}

#endif
