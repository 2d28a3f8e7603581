// SPDX-License-Identifier: BSD-3-Clause
#include "SoftTool.h"

#include <cmath>

using namespace brainshift;

namespace
{
constexpr double GrowthPerClick = 1.1; // of the radius, of the wheel with Shift
}

void SoftTool::hover(const HandEvent& event)
{
  const std::optional<glm::dvec3> tissue = this->Bench.probe.tissueAt(pixelOf(event));
  if (!tissue)
  {
    this->Bench.shown.Clear();
    return;
  }
  this->showStroke(this->strokeAt(*tissue, Tool::Soft));
  this->Bench.shown.SetHighlights({ *tissue });
}

bool SoftTool::press(const HandEvent& event)
{
  const std::optional<glm::dvec3> tissue = this->Bench.probe.tissueAt(pixelOf(event));
  if (!tissue)
  {
    return false;
  }
  this->Anchor = *tissue;
  this->GrippedAt = pixelOf(event);
  return true;
}

void SoftTool::pullTo(const glm::dvec2& pixel)
{
  const glm::dvec3 moved = this->pulled(this->Anchor, this->GrippedAt, pixel);
  Stroke stroke = this->strokeAt(this->Anchor, Tool::Soft);
  stroke.vector = this->beforeStrength(moved);
  this->showStroke(stroke);
  this->Bench.shown.SetLines(
    vtkLatticeRepresentation::Mark, { { this->Anchor, this->Anchor + moved } });
  this->Bench.shown.SetHighlights({ this->Anchor + moved });
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
  const bool acts = event.shift && !event.control &&
    (this->isDragging() || this->Bench.probe.tissueAt(pixelOf(event)));
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
    this->Bench.shown.SetLines(vtkLatticeRepresentation::Mark, {});
  }
}
