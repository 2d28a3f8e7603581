// SPDX-License-Identifier: BSD-3-Clause
// Drags control points: the one under the cursor, or all that were selected with Shift.
#ifndef BrainShift_MoveTool_h
#define BrainShift_MoveTool_h

#include "ViewTool.h"

class MoveTool : public ViewTool
{
public:
  using ViewTool::ViewTool;

  void hover(const brainshift::HandEvent& event) override;
  bool press(const brainshift::HandEvent& event) override;
  void drag(const brainshift::HandEvent& event) override;
  void settle() override;
  void cancel() override;

private:
  const brainshift::Handle* handleUnder(const glm::dvec2& pixel) const;
  bool isSelected(const brainshift::Handle& handle) const;
  void select(const brainshift::Handle& handle, bool extend);
  void highlight(const brainshift::Handle* under, const glm::dvec3& moved);
  void find(const glm::dvec2& pixel);

  std::vector<brainshift::Handle> Near;     // what can be taken
  std::vector<brainshift::Handle> Faint;    // what moved a little farther away
  std::optional<Spot> Tissue;               // under the cursor
  std::vector<brainshift::Handle> Selected; // what a drag takes along
  Grip Held;
};

#endif
