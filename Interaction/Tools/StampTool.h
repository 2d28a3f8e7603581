// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The Stamp tool: pulls tissue away from the point of interest or pushes it towards that point.
/// Wheel clicks do it in steps, a drag does it without.
#ifndef BrainShift_StampTool_h
#define BrainShift_StampTool_h

#include "Interaction/Tools/HandTool.h"

namespace brainshift
{
class StampTool : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  bool wheel(const HandEvent& event) override;
  void settle() override;
  void turnAway() override;
  void cancel() override;

private:
  bool outline(const glm::dvec2& pixel);
  bool take(const glm::dvec2& pixel);
  glm::dvec3 interestFrom(const Spot& spot);
  bool isAtLastStroke(const glm::dvec2& pixel) const;
  void show(const Stroke& stroke, double amount);
  void apply(double amount);
  void clickWheel(const HandEvent& event);
  void changeRadius(const HandEvent& event);

  Stroke Latest;                   ///< The stroke that is outlined, under the hand or made last.
  std::optional<glm::dvec3> Slice; ///< Normal of its slice.
  double Amount = 0.0;             ///< Displacement (mm). Pull is positive.
  bool Made = false;               ///< The last stroke of the list is Latest.
  bool Aims = false;               ///< Latest has an axis: the point of interest is not there.
  glm::dvec2 TakenAt{ 0.0 };       ///< Pixel.
  glm::dvec2 PullOnScreen{ 0.0 };  ///< During a drag: mm per pixel of the screen.
};
}

#endif
