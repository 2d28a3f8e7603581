// SPDX-License-Identifier: BSD-3-Clause
// Pulls tissue away from the point of interest and pushes it towards it: by wheel clicks, or
// continuously by a drag.
#ifndef BrainShift_StampTool_h
#define BrainShift_StampTool_h

#include "ViewTool.h"

class StampTool : public ViewTool
{
public:
  using ViewTool::ViewTool;

  void hover(const brainshift::HandEvent& event) override;
  bool press(const brainshift::HandEvent& event) override;
  void drag(const brainshift::HandEvent& event) override;
  bool wheel(const brainshift::HandEvent& event) override;
  void settle() override;
  void turnAway() override;
  void cancel() override;

private:
  bool take(const glm::dvec2& pixel);
  glm::dvec3 interestFrom(const Spot& spot);
  bool isAtLastStroke(const glm::dvec2& pixel) const;
  void show(const brainshift::Stroke& stroke, double amount);
  void apply(double amount);
  void clickWheel(const brainshift::HandEvent& event);
  void changeRadius(const brainshift::HandEvent& event);

  brainshift::Stroke Stroke;       // the one under the hand, or made last
  std::optional<glm::dvec3> Slice; // normal of the slice it was taken in
  double Amount = 0.0;             // mm of it: pull is positive
  bool Made = false;               // the last stroke of the list is Stroke
  glm::dvec2 TakenAt{ 0.0 };       // pixel
  glm::dvec2 PullOnScreen{ 0.0 };  // drag: mm a pixel, along the screen's axes
};

#endif
