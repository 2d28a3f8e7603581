// SPDX-License-Identifier: BSD-3-Clause
// The Move tool: drags the control point under the cursor, or all selected control points.
#include "Interaction/Commands/Tools.h"
#include "Interaction/Tools/HandTool.h"

#include <algorithm>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double PickPixels = 16.0;  // a control point within this distance is picked
constexpr double ShownCells = 1.7;   // control points this many cells around the cursor are drawn
constexpr double SliceCells = 2.6;   // in a slice, where fewer lie one behind the other
constexpr double MovedFactor = 2.0;  // times that distance, moved ones are drawn as faint dots
constexpr double DepthWeight = 0.25; // a pixel beside the cursor counts as four in depth

double widest(const Grid& grid)
{
  return std::max({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
}

class MoveTool final : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  void settle() override;
  void cancel() override;

private:
  const ControlPoint* controlPointUnder(const glm::dvec2& pixel) const;
  bool isSelected(const ControlPoint& point) const;
  void select(const ControlPoint& point, bool extend);
  void highlight(const ControlPoint* under, const glm::dvec3& moved);
  void find(const glm::dvec2& pixel);

  std::vector<ControlPoint> Near;     ///< Near enough to be picked.
  std::vector<ControlPoint> Faint;    ///< Moved ones a little farther away.
  std::optional<Spot> Tissue;         ///< Under the cursor.
  std::vector<ControlPoint> Selected; ///< A drag moves all of them.
  Grid SelectedOf;                    ///< The lattice that they belong to.
  Grip Held;
};

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
    const double radius = (this->Tissue->slice ? SliceCells : ShownCells) * widest(*lattice);
    for (const ControlPoint& point :
      probe.controlPointsNear(*this->Tissue, radius, MovedFactor * radius))
    {
      const bool isNear = glm::distance(point.drawn, this->Tissue->position) <= radius;
      (isNear ? this->Near : this->Faint).push_back(point);
    }
  }
  else
  {
    this->Near = probe.controlPointsUnder(pixel, PickPixels * probe.screenScale());
  }
  if (*lattice != this->SelectedOf)
  {
    this->Selected.clear(); // an index means another control point
    this->SelectedOf = *lattice;
  }
  // What was selected may have moved since.
  for (ControlPoint& selected : this->Selected)
  {
    const auto found = std::find_if(this->Near.begin(), this->Near.end(),
      [&](const ControlPoint& point) { return point.index == selected.index; });
    selected = found == this->Near.end() ? selected : *found;
  }
}

// Of several under the cursor, one near the tissue that is seen.
const ControlPoint* MoveTool::controlPointUnder(const glm::dvec2& pixel) const
{
  const ViewProbe& probe = this->Bench.probe;
  const ControlPoint* nearest = nullptr;
  double least = std::numeric_limits<double>::max();
  for (const ControlPoint& point : this->Near)
  {
    const double distance = glm::distance(probe.pixelOf(point.drawn), pixel);
    const double depth = this->Tissue ? glm::distance(point.drawn, this->Tissue->position) : 0.0;
    const double strangeness =
      distance + DepthWeight * depth / probe.millimetresPerPixel(point.drawn);
    if (distance < PickPixels * probe.screenScale() && strangeness < least)
    {
      least = strangeness;
      nearest = &point;
    }
  }
  return nearest;
}

bool MoveTool::isSelected(const ControlPoint& point) const
{
  return std::any_of(this->Selected.begin(), this->Selected.end(),
    [&](const ControlPoint& selected) { return selected.index == point.index; });
}

void MoveTool::highlight(const ControlPoint* under, const glm::dvec3& moved)
{
  std::vector<glm::dvec3> positions;
  positions.reserve(this->Selected.size() + 1);
  for (const ControlPoint& point : this->Selected)
  {
    positions.push_back(point.drawn + moved);
  }
  if (under && !this->isSelected(*under))
  {
    positions.push_back(under->drawn);
  }
  std::vector<ControlPoint> points = this->Near;
  for (ControlPoint& point : points)
  {
    point.drawn += this->isSelected(point) ? moved : glm::dvec3(0.0);
  }
  std::vector<glm::dvec3> faint;
  faint.reserve(this->Faint.size());
  for (const ControlPoint& point : this->Faint)
  {
    faint.push_back(point.drawn);
  }
  this->Bench.drawing.SetControlPoints(points);
  this->Bench.drawing.SetFaint(faint);
  this->Bench.drawing.SetHighlights(positions);
}

void MoveTool::hover(const HandEvent& event)
{
  this->find(pixelOf(event));
  this->highlight(this->controlPointUnder(pixelOf(event)), glm::dvec3(0.0));
}

void MoveTool::select(const ControlPoint& point, bool extend)
{
  const bool was = this->isSelected(point);
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
                           [&](const ControlPoint& other) { return other.index == point.index; }),
      this->Selected.end());
    return;
  }
  this->Selected.push_back(point);
}

bool MoveTool::press(const HandEvent& event)
{
  this->find(pixelOf(event));
  const ControlPoint* under = this->controlPointUnder(pixelOf(event));
  if (!under)
  {
    return false;
  }
  this->Held = { { under->drawn, this->Tissue ? this->Tissue->slice : std::nullopt },
    pixelOf(event) };
  this->select(ControlPoint(*under),
    commandOfMouse(Scope::Tool, Tool::Move, Mouse::Click, event.shift, false) == Command::Select);
  this->highlight(nullptr, glm::dvec3(0.0));
  return true;
}

void MoveTool::drag(const HandEvent& event)
{
  if (this->Selected.empty())
  {
    return;
  }
  const Grid& lattice = this->SelectedOf; // as the press found it: a far server answers late
  const glm::dvec3 moved = this->pulled(this->Held, pixelOf(event));
  StrokeEditor::Strokes strokes;
  for (const ControlPoint& point : this->Selected)
  {
    Stroke stroke;
    stroke.tool = Tool::Move;
    stroke.anchor = point.rest;
    stroke.vector = this->beforeStrength(moved);
    stroke.axis = lattice.spacing;
    stroke.major = widest(lattice);
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
  HandTool::cancel();
  this->highlight(nullptr, glm::dvec3(0.0));
}
}

ToolRow moveTool()
{
  ToolRow row;
  row.tool = Tool::Move;
  row.key = Qt::ALT | Qt::Key_1;
  row.what = QT_TRANSLATE_NOOP("BrainShift", "Move single control points.");
  row.page = "tools/move.md";
  row.gestures = {
    byMouse(Command::DragTissue, Mouse::Drag, {},
      QT_TRANSLATE_NOOP("BrainShift",
        "Move the control point under the cursor. All selected control points move with it."),
      QT_TRANSLATE_NOOP("BrainShift", "move a control point")),
    byMouse(Command::Select, Mouse::Click, Qt::ShiftModifier,
      QT_TRANSLATE_NOOP(
        "BrainShift", "Select one more control point, or deselect a selected control point."),
      QT_TRANSLATE_NOOP("BrainShift", "select several")),
    byKey(Command::SelectByKey, { Qt::SHIFT | Qt::Key_Space },
      QT_TRANSLATE_NOOP(
        "BrainShift", "Select one more control point, or deselect a selected control point.")),
  };
  row.lesson = Lesson{ "Pull one control point",
    "Press <b>Take Move</b>. Move the mouse over the cortex. Press on a control point (a small "
    "ball) and drag it. Only the tissue around this point follows.",
    "Take Move" };
  row.make = make<MoveTool>;
  return row;
}
}
