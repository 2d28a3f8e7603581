// SPDX-License-Identifier: BSD-3-Clause
// What the mouse does in a view while a tool is in hand. A tool makes strokes and shows where they
// would act; it draws nothing and keeps no stroke.
#ifndef BrainShift_ViewTool_h
#define BrainShift_ViewTool_h

#include "StrokeEditor.h"
#include "ToolSettings.h"
#include "ViewProbe.h"

#include <vtkLatticeRepresentation.h>
#include <vtkLatticeWidget.h>

#include <memory>

// What a tool works with; all of it outlives the tool.
struct ToolBench
{
  ViewProbe& probe;
  StrokeEditor& editor;
  ToolSettings& settings;
  vtkLatticeRepresentation& shown;
};

// What a drag holds.
struct Grip
{
  Spot spot;               // where it began
  glm::dvec2 pixel{ 0.0 }; // there
};

class ViewTool
{
public:
  // Null for None.
  static std::unique_ptr<ViewTool> make(ToolSettings::Tool tool, const ToolBench& bench);

  explicit ViewTool(const ToolBench& bench);
  virtual ~ViewTool();

  // What the cursor would act on is shown; nothing is changed.
  virtual void hover(const brainshift::HandEvent& event) = 0;
  // True if the tool takes the event; the camera gets it otherwise.
  virtual bool press(const brainshift::HandEvent& event) = 0;
  virtual bool wheel(const brainshift::HandEvent& event);
  // Between a press that was taken and its release.
  virtual void drag(const brainshift::HandEvent& event) = 0;
  virtual void release();
  // What is under the hand goes back to how it was.
  virtual void cancel();
  // What is under the hand is done; one undo step.
  virtual void settle();
  // The same; what is under the cursor has changed, so the next stroke is another one.
  virtual void turnAway();

protected:
  brainshift::Stroke strokeAt(const glm::dvec3& anchor, brainshift::Tool tool) const;
  // From a grip to the pixel: in the plane of the slice or else of the screen, or along the axis
  // that is held.
  glm::dvec3 pulled(const Grip& grip, const glm::dvec2& pixel);
  // Displacements are drawn times Strength, so a stroke must be as much longer.
  glm::dvec3 beforeStrength(const glm::dvec3& displacement) const;
  // Its outline, in a slice the section by it.
  void showStroke(const brainshift::Stroke& stroke, const std::optional<glm::dvec3>& slice);
  // A drag with Shift in a slice brings the other slices there.
  static bool isForSlices(const brainshift::HandEvent& event, const Spot& spot)
  {
    return event.shift && spot.slice;
  }
  bool isDragging() const { return this->Bench.editor.isEditing(); }

  ToolBench Bench;

private:
  glm::dvec3 pulledInPlane(const Grip& grip, const glm::dvec2& pixel);
};

inline glm::dvec2 pixelOf(const brainshift::HandEvent& event)
{
  return { event.x, event.y };
}

#endif
