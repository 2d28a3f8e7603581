// SPDX-License-Identifier: BSD-3-Clause
// Drags tissue under the cursor, and less and less of it within a radius.
#ifndef BrainShift_SoftTool_h
#define BrainShift_SoftTool_h

#include "ViewTool.h"

class SoftTool : public ViewTool
{
public:
  using ViewTool::ViewTool;

  void hover(const brainshift::HandEvent& event) override;
  bool press(const brainshift::HandEvent& event) override;
  void drag(const brainshift::HandEvent& event) override;
  bool wheel(const brainshift::HandEvent& event) override;
  void settle() override;

private:
  void pullTo(const glm::dvec2& pixel);

  Grip Held; // deformed frame before the stroke
};

#endif
