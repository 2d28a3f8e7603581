// SPDX-License-Identifier: BSD-3-Clause
#include "MoveTool.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

using namespace brainshift;

namespace
{
constexpr double ReachPixels = 16.0; // a control point is taken from this far
constexpr double ShownCells = 1.7;   // those this many cells around the cursor are shown
constexpr double SliceCells = 2.6;   // the same in a slice, where fewer lie one behind the other
constexpr double MovedShare = 2.0;   // of that, those that moved are hinted at
constexpr double DepthWeight = 0.25; // a pixel beside the cursor counts as four in depth

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
  this->Faint.clear();
  if (!lattice)
  {
    return;
  }
  this->Tissue = probe.spotAt(pixel);
  if (this->Tissue)
  {
    const double reach = (this->Tissue->slice ? SliceCells : ShownCells) * widest(*lattice);
    for (const Handle& handle : probe.handlesNear(*this->Tissue, reach, MovedShare * reach))
    {
      const bool isNear = glm::distance(handle.drawn, this->Tissue->position) <= reach;
      (isNear ? this->Near : this->Faint).push_back(handle);
    }
  }
  else
  {
    this->Near = probe.handlesUnder(pixel, ReachPixels);
  }
  // What was selected may have moved since.
  for (Handle& selected : this->Selected)
  {
    const auto found = std::find_if(this->Near.begin(), this->Near.end(),
      [&](const Handle& handle) { return handle.index == selected.index; });
    selected = found == this->Near.end() ? selected : *found;
  }
}

// Of several under the cursor, one near the tissue that is seen.
const Handle* MoveTool::handleUnder(const glm::dvec2& pixel) const
{
  const ViewProbe& probe = this->Bench.probe;
  const Handle* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const Handle& handle : this->Near)
  {
    const double distance = glm::distance(probe.pixelOf(handle.drawn), pixel);
    const double depth = this->Tissue ? glm::distance(handle.drawn, this->Tissue->position) : 0.0;
    const double strangeness =
      distance + DepthWeight * depth / probe.millimetresPerPixel(handle.drawn);
    if (distance < ReachPixels && strangeness < least)
    {
      least = strangeness;
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
  std::vector<glm::dvec3> faint;
  for (const Handle& handle : this->Faint)
  {
    faint.push_back(handle.drawn);
  }
  this->Bench.shown.SetHandles(handles);
  this->Bench.shown.SetFaint(faint);
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
  this->Held = { { under->drawn, this->Tissue ? this->Tissue->slice : std::nullopt },
    pixelOf(event) };
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
  const glm::dvec3 moved = this->pulled(this->Held, pixelOf(event));
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
