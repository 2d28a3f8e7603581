// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Base of the tools: what the mouse does in a view while a tool is in hand. A tool makes strokes
/// and outlines where they would act. It keeps no finished stroke.
#ifndef BrainShift_HandTool_h
#define BrainShift_HandTool_h

#include "Interaction/Commands/Commands.h"
#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ViewProbe.h"

#include <vtkLatticeRepresentation.h>
#include <vtkLatticeWidget.h>

#include <memory>

namespace brainshift
{
/// Growth of a radius for each click of the wheel with Shift.
constexpr double GrowthPerClick = 1.1;

/// What a tool works with. All of it outlives the tool.
struct ToolBench
{
  ViewProbe& probe;
  StrokeEditor& editor;
  FitEditor& fit;
  ToolSettings& settings;
  vtkLatticeRepresentation& drawing;
};

/// The point at which a drag began.
struct Grip
{
  Spot spot;               ///< In the deformed frame, before the drag.
  glm::dvec2 pixel{ 0.0 }; ///< Its pixel.
};

class HandTool
{
public:
  explicit HandTool(const ToolBench& bench);
  virtual ~HandTool();

  /// Outlines what the cursor would act on. Changes nothing.
  virtual void hover(const HandEvent& event) = 0;
  /// Shows what is seen while the cursor is away from tissue or elsewhere. By default nothing.
  virtual void idle();
  /// A mouse button goes down. True if the tool takes the event; otherwise the camera gets it.
  virtual bool press(const HandEvent& event) = 0;
  /// The wheel was moved. True if the tool takes the event.
  virtual bool wheel(const HandEvent& event);
  /// The mouse moves between a press that the tool took and its release.
  virtual void drag(const HandEvent& event) = 0;
  /// The mouse button goes up.
  virtual void release();
  /// Drops the stroke under the hand.
  virtual void cancel();
  /// Finishes the stroke under the hand: one undo step.
  virtual void settle();
  /// Finishes the stroke under the hand. The next event begins a new one, for the picture under the
  /// cursor has changed.
  virtual void turnAway();

protected:
  /// A stroke with the settings of the panel that moves nothing yet.
  Stroke strokeAt(const glm::dvec3& anchor, Tool tool) const;
  /// The displacement from a grip to a pixel (mm): in the plane of the slice, or else of the
  /// screen, or along the axis that is held.
  glm::dvec3 pulled(const Grip& grip, const glm::dvec2& pixel);
  /// The displacement of a stroke that is seen as this displacement: the picture multiplies by
  /// Strength.
  glm::dvec3 beforeStrength(const glm::dvec3& displacement) const;
  /// Outlines a stroke; in a slice, its section by the slice.
  void showStroke(const Stroke& stroke, const std::optional<glm::dvec3>& slice);
  /// Whether a drag belongs to the slices: with Shift it brings the other slices to the cursor.
  static bool isForSlices(const HandEvent& event, const Spot& spot)
  {
    return event.shift && spot.slice;
  }
  /// What a gesture means to a tool.
  static Command commandOf(Tool tool, Mouse mouse, const HandEvent& event)
  {
    return commandOfMouse(Scope::Tool, tool, mouse, event.shift, event.control);
  }
  /// Whether an edit is under the hand.
  bool isDragging() const { return this->Bench.editor.isEditing(); }

  ToolBench Bench;

private:
  glm::dvec3 pulledInPlane(const Grip& grip, const glm::dvec2& pixel);
};

/// How the row of a tool makes it.
template <class OneTool>
std::unique_ptr<HandTool> make(const ToolBench& bench)
{
  return std::make_unique<OneTool>(bench);
}

inline glm::dvec2 pixelOf(const HandEvent& event)
{
  return { event.x, event.y };
}
}

#endif
