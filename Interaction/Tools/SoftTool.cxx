// SPDX-License-Identifier: BSD-3-Clause
// The Soft tool: drags the tissue under the cursor. Tissue within the radius follows, less and
// less towards the edge.
#include "Interaction/Commands/Tools.h"
#include "Interaction/Tools/HandTool.h"

#include <cmath>

namespace brainshift
{
namespace
{
class SoftTool final : public HandTool
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

void SoftTool::hover(const HandEvent& event)
{
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  if (!spot)
  {
    this->Bench.drawing.Clear();
    return;
  }
  this->showStroke(this->strokeAt(spot->position, Tool::Soft), spot->slice);
  this->Bench.drawing.SetLines(vtkLatticeRepresentation::Mark, {}); // of a drag that was cancelled
  this->Bench.drawing.SetHighlights({ spot->position });
}

bool SoftTool::press(const HandEvent& event)
{
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  if (!spot || isForSlices(event, *spot))
  {
    return false;
  }
  this->Held = { *spot, pixelOf(event) };
  return true;
}

void SoftTool::pullTo(const glm::dvec2& pixel)
{
  const glm::dvec3 moved = this->pulled(this->Held, pixel);
  const glm::dvec3& anchor = this->Held.spot.position;
  Stroke stroke = this->strokeAt(anchor, Tool::Soft);
  stroke.vector = this->beforeStrength(moved);
  this->showStroke(stroke, this->Held.spot.slice);
  this->Bench.drawing.SetLines(vtkLatticeRepresentation::Mark, { { anchor, anchor + moved } });
  this->Bench.drawing.SetHighlights({ anchor + moved });
  if (this->isDragging())
  {
    this->Bench.editor.change(stroke);
  }
  else
  {
    this->Bench.editor.begin(stroke);
  }
}

void SoftTool::drag(const HandEvent& event)
{
  this->pullTo(pixelOf(event));
}

bool SoftTool::wheel(const HandEvent& event)
{
  const bool acts = commandOf(Tool::Soft, Mouse::Wheel, event) == Command::ChangeRadius &&
    (this->isDragging() || this->Bench.probe.spotAt(pixelOf(event)));
  if (acts)
  {
    ToolSettings& settings = this->Bench.settings;
    settings.setRadius(settings.radius() * std::pow(GrowthPerClick, event.clicks));
    if (this->isDragging())
    {
      this->pullTo(pixelOf(event));
    }
    else
    {
      this->hover(event);
    }
  }
  return acts;
}

void SoftTool::settle()
{
  if (this->isDragging())
  {
    this->Bench.editor.commit("Soft stroke");
    this->Bench.drawing.SetLines(vtkLatticeRepresentation::Mark, {});
  }
}
}

ToolRow softTool()
{
  ToolRow row;
  row.tool = Tool::Soft;
  row.key = Qt::ALT | Qt::Key_2;
  row.what = QT_TRANSLATE_NOOP("BrainShift", "Drag all tissue within a radius.");
  row.page = "tools/soft.md";
  row.gestures = {
    byMouse(Command::DragTissue, Mouse::Drag, {},
      QT_TRANSLATE_NOOP("BrainShift",
        "Move the tissue under the cursor. Tissue within the radius follows, less towards the "
        "edge."),
      QT_TRANSLATE_NOOP("BrainShift", "move the tissue within %1")),
    byMouse(Command::ChangeRadius, Mouse::Wheel, Qt::ShiftModifier,
      QT_TRANSLATE_NOOP("BrainShift", "Change the radius."),
      QT_TRANSLATE_NOOP("BrainShift", "change the radius")),
  };
  row.gestures.front().number = &ToolSettings::radius;
  row.numbers = { &ToolSettings::radius, &ToolSettings::sigma };
  row.lesson = Lesson{ "Drag softly",
    "Press <b>Take Soft</b>. Press on the cortex and drag. Tissue near the mouse follows, less "
    "with distance.",
    "Take Soft" };
  row.make = make<SoftTool>;
  return row;
}
}
