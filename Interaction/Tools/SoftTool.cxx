// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Tools/SoftTool.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr double GrowthPerClick = 1.1; // of the radius, of the wheel with Shift
}

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
  const bool acts = commandOf(ToolKind::Soft, Mouse::Wheel, event) == Command::ChangeRadius &&
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
