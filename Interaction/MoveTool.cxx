// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTool.h"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace brainshift;

namespace
{
constexpr double ReachPixels = 16.0; // a control point is taken from this far
constexpr double ShownCells = 2.2;   // those this many cells around the cursor are shown

double widest(const Grid& grid)
{
  return std::max({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
}
}

void MoveTool::find(const glm::dvec2& pixel)
{
  ViewProbe& probe = this->Bench.probe;
  const std::optional<Grid> lattice = probe.lattice();
  this->Near.clear();
  if (!lattice)
  {
    return;
  }
  const std::optional<glm::dvec3> tissue = probe.tissueAt(pixel);
  this->Near = tissue ? probe.handlesNear(*tissue, ShownCells * widest(*lattice))
                      : probe.handlesUnder(pixel, ReachPixels);
  // What was selected may have moved since.
  for (Handle& selected : this->Selected)
  {
    const auto found = std::find_if(this->Near.begin(), this->Near.end(),
      [&](const Handle& handle) { return handle.index == selected.index; });
    selected = found == this->Near.end() ? selected : *found;
  }
}

// Of several under the cursor, the nearest to the eye: it hides the others.
const Handle* MoveTool::handleUnder(const glm::dvec2& pixel) const
{
  const ViewProbe& probe = this->Bench.probe;
  const Handle* nearest = nullptr;
  double least = ReachPixels;
  for (const Handle& handle : this->Near)
  {
    const double distance = glm::distance(probe.pixelOf(handle.drawn), pixel);
    if (distance < least)
    {
      least = distance;
      nearest = &handle;
    }
  }
  return nearest;
}

bool MoveTool::isSelected(const Handle& handle) const
{
  return std::any_of(this->Selected.begin(), this->Selected.end(),
    [&](const Handle& selected) { return selected.index == handle.index; });
}

void MoveTool::highlight(const Handle* under, const glm::dvec3& moved)
{
  std::vector<glm::dvec3> positions;
  for (const Handle& handle : this->Selected)
  {
    positions.push_back(handle.drawn + moved);
  }
  if (under && !this->isSelected(*under))
  {
    positions.push_back(under->drawn);
  }
  std::vector<Handle> handles = this->Near;
  for (Handle& handle : handles)
  {
    handle.drawn += this->isSelected(handle) ? moved : glm::dvec3(0.0);
  }
  this->Bench.shown.SetHandles(handles);
  this->Bench.shown.SetHighlights(positions);
}

void MoveTool::hover(const HandEvent& event)
{
  this->find(pixelOf(event));
  this->highlight(this->handleUnder(pixelOf(event)), glm::dvec3(0.0));
}

void MoveTool::select(const Handle& handle, bool extend)
{
  const bool was = this->isSelected(handle);
  if (!extend && was)
  {
    return; // the whole selection is dragged
  }
  if (!extend)
  {
    this->Selected.clear();
  }
  if (extend && was)
  {
    this->Selected.erase(std::remove_if(this->Selected.begin(), this->Selected.end(),
                           [&](const Handle& other) { return other.index == handle.index; }),
      this->Selected.end());
    return;
  }
  this->Selected.push_back(handle);
}

bool MoveTool::press(const HandEvent& event)
{
  this->find(pixelOf(event));
  const Handle* under = this->handleUnder(pixelOf(event));
  if (!under)
  {
    return false;
  }
  this->Grip = under->drawn;
  this->GrippedAt = pixelOf(event);
  this->select(Handle(*under), event.shift);
  this->highlight(nullptr, glm::dvec3(0.0));
  return true;
}

void MoveTool::drag(const HandEvent& event)
{
  const std::optional<Grid> lattice = this->Bench.probe.lattice();
  if (!lattice || this->Selected.empty())
  {
    return;
  }
  const glm::dvec3 moved = this->pulled(this->Grip, this->GrippedAt, pixelOf(event));
  StrokeEditor::Strokes strokes;
  for (const Handle& handle : this->Selected)
  {
    Stroke stroke;
    stroke.tool = Tool::Move;
    stroke.anchor = handle.rest;
    stroke.vector = this->beforeStrength(moved);
    stroke.axis = lattice->spacing;
    stroke.major = widest(*lattice);
    strokes.push_back(stroke);
  }
  this->highlight(nullptr, moved);
  if (this->isDragging())
  {
    this->Bench.editor.change(strokes);
  }
  else
  {
    this->Bench.editor.begin(strokes);
  }
}

void MoveTool::settle()
{
  if (this->isDragging())
  {
    this->Bench.editor.commit(
      this->Selected.size() > 1 ? QString("Move control points") : QString("Move control point"));
  }
}

void MoveTool::cancel()
{
  ViewTool::cancel();
  this->highlight(nullptr, glm::dvec3(0.0));
}
