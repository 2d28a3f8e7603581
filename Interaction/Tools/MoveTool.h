// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The Move tool: drags the control point under the cursor, or all selected control points.
#ifndef BrainShift_MoveTool_h
#define BrainShift_MoveTool_h

#include "Interaction/Tools/HandTool.h"

namespace brainshift
{
class MoveTool : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  void settle() override;
  void cancel() override;

private:
  const ControlPoint* controlPointUnder(const glm::dvec2& pixel) const;
  bool isSelected(const ControlPoint& point) const;
  void select(const ControlPoint& point, bool extend);
  void highlight(const ControlPoint* under, const glm::dvec3& moved);
  void find(const glm::dvec2& pixel);

  std::vector<ControlPoint> Near;     ///< Within reach.
  std::vector<ControlPoint> Faint;    ///< Moved ones a little farther away.
  std::optional<Spot> Tissue;         ///< Under the cursor.
  std::vector<ControlPoint> Selected; ///< A drag moves all of them.
  Grip Held;
};
}

#endif
