// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The volume that a view shows instead of the one that the tool in hand works on, and the click
/// that takes the tool there. A drag over it is the camera's.
#ifndef BrainShift_OtherVolume_h
#define BrainShift_OtherVolume_h

#include <QPointer>

#include <glm/glm.hpp>

#include <optional>

class pqPipelineSource;
class pqRenderView;

namespace brainshift
{
class OtherVolume
{
public:
  /// The Free-Form Deformation that the tool works on, and the view that the tool is in. Null:
  /// there is no tool.
  void follow(pqPipelineSource* deformation, pqRenderView* view);

  /// The other volume. Null: the view shows the one that the tool works on, or none at all.
  pqPipelineSource* shown() const;
  void report() const; ///< Writes its name into the settings (ToolSettings::shownInstead).
  void take() const;   ///< Selects it, so that the tool works on it.

  /// The button went down at a pixel, and the tool did not take it.
  void press(const glm::dvec2& pixel) { this->Pressed = pixel; }
  /// The button went up. Takes the other volume, if that was a click.
  void release(const glm::dvec2& pixel);

private:
  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  std::optional<glm::dvec2> Pressed;
};
}

#endif
