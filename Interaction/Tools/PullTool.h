// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The Pull tool: drags tissue to where it belongs and pins tissue that stays. It writes the pulls
/// and pins of the Fit Deformation that is the Lattice, so strokes stay on top.
#ifndef BrainShift_PullTool_h
#define BrainShift_PullTool_h

#include "Interaction/Edits/PullList.h"
#include "Interaction/Tools/HandTool.h"

namespace brainshift
{
class PullTool : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  void idle() override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  void release() override;
  void cancel() override;
  void settle() override;

private:
  /// A pull or a pin as it is drawn.
  struct Shown
  {
    glm::dvec3 rest{ 0.0 };
    glm::dvec3 now{ 0.0 };    ///< Where the tissue is drawn.
    glm::dvec3 target{ 0.0 }; ///< Where it should be drawn, without strokes.
    bool isPin = false;
  };

  void find();
  void show(const std::optional<glm::dvec3>& highlight);
  bool isSeen(const Shown& mark) const;
  double gripRadius(const glm::dvec3& position) const;
  void pin(const glm::dvec3& rest, double radius);
  std::vector<Pull> pulls() const { return pullsFrom(this->Bench.fit.numbers("Pulls")); }

  std::vector<Shown> Marks; ///< Those that count.
  std::optional<Spot> Last; ///< Under the cursor.
  std::optional<Grip> Held; ///< During a drag: in the deformed frame, before it.
  std::vector<Pull> List;   ///< During a drag: all pulls.
  std::size_t Place = 0;    ///< During a drag: that under the hand.
  bool Begun = false;       ///< During a drag: the fit is being edited.
  glm::dvec3 From{ 0.0 };   ///< During a drag: its target before it.
};
}

#endif
