// SPDX-License-Identifier: BSD-3-Clause
// The Pull tool: drags tissue to where it belongs and pins tissue that stays. It writes the pulls
// and pins of the Fit Deformation that is the Lattice, so strokes stay on top.
#include "Filters/Fit/PackedTables.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Tools/HandTool.h"

namespace brainshift
{
namespace
{
constexpr double GripPixels = 12.0; // a pull or a pin is taken from this far
constexpr double LeastPixels = 2.0; // a click is no drag
constexpr double HeadPixels = 12.0; // of an arrow
constexpr double RingPixels = 8.0;  // radius of the ring around a pin
constexpr double SliceMm = 3.0;     // in a slice, marks at most this far from it are drawn
constexpr double SeenMm = 0.5;      // shorter remaining distances are not drawn

class PullTool final : public HandTool
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
  void takeHold(const Spot& spot);
  void show(const std::optional<glm::dvec3>& highlight);
  bool isSeen(const Shown& mark) const;
  double gripRadius(const glm::dvec3& position) const;
  void pin(const glm::dvec3& rest, double radius);
  std::vector<Pull> pulls() const { return rowsFrom<Pull>(this->Bench.fit.numbers("Pulls")); }

  std::vector<Shown> Marks; ///< Those that count.
  std::optional<Spot> Last; ///< Under the cursor.
  glm::dvec3 Rest{ 0.0 };   ///< During a drag: where the tissue under the press was at rest.
  std::optional<Grip> Held; ///< During a drag: in the deformed frame, before it.
  std::vector<Pull> List;   ///< During a drag: all pulls.
  std::size_t Dragged = 0;  ///< During a drag: the index of its pull.
  bool Begun = false;       ///< During a drag: the fit is being edited.
  glm::dvec3 From{ 0.0 };   ///< During a drag: its target before it.
};

double PullTool::gripRadius(const glm::dvec3& position) const
{
  const ViewProbe& probe = this->Bench.probe;
  return GripPixels * probe.screenScale() * probe.millimetresPerPixel(position);
}

void PullTool::find()
{
  this->Marks.clear();
  if (!this->Bench.probe.works())
  {
    return;
  }
  std::vector<glm::dvec3> rest;
  for (const Pull& pull : this->pulls())
  {
    if (pull.weight > 0.0)
    {
      const glm::dvec3 asked = this->Bench.probe.strength() * (pull.measured - pull.rest);
      this->Marks.push_back({ pull.rest, pull.rest, pull.rest + asked, false });
    }
  }
  std::vector<glm::dvec3> pinned;
  for (const Pin& pin : rowsFrom<Pin>(this->Bench.fit.numbers("Pins")))
  {
    if (pin.enabled)
    {
      pinned.push_back(pin.rest);
    }
  }
  const std::vector<glm::dvec3> held = this->Bench.fit.basePositions(pinned);
  for (std::size_t i = 0; i < pinned.size(); ++i)
  {
    const glm::dvec3 asked = this->Bench.probe.strength() * (held[i] - pinned[i]);
    this->Marks.push_back({ pinned[i], pinned[i], pinned[i] + asked, true });
  }
  rest.reserve(this->Marks.size());
  for (const Shown& mark : this->Marks)
  {
    rest.push_back(mark.rest);
  }
  const std::vector<glm::dvec3> drawn = this->Bench.probe.drawnAt(rest);
  for (std::size_t i = 0; i < drawn.size() && i < this->Marks.size(); ++i)
  {
    this->Marks[i].now = drawn[i];
  }
}

// A flat view shows one slice, and a mark elsewhere would seem to lie in it.
bool PullTool::isSeen(const Shown& mark) const
{
  if (this->Bench.settings.ground() != ToolSettings::Ground::FlatSlices)
  {
    return true;
  }
  return this->Last && this->Last->slice &&
    std::abs(glm::dot(mark.now - this->Last->position, *this->Last->slice)) <= SliceMm;
}

void PullTool::show(const std::optional<glm::dvec3>& highlight)
{
  const ViewProbe& probe = this->Bench.probe;
  const glm::dvec3 ahead = probe.ahead();
  std::vector<Polyline> arrows;
  std::vector<Polyline> rings;
  std::vector<Polyline> missing;
  std::vector<glm::dvec3> dots;
  const bool isFitAlone = this->Bench.editor.strokes().empty();
  for (const Shown& mark : this->Marks)
  {
    if (!this->isSeen(mark))
    {
      continue;
    }
    const double pixel = probe.screenScale() * probe.millimetresPerPixel(mark.now);
    dots.push_back(mark.now);
    if (isFitAlone && glm::distance(mark.now, mark.target) > SeenMm)
    {
      missing.push_back({ mark.now, mark.target });
    }
    if (mark.isPin)
    {
      rings.push_back(ring(mark.now, RingPixels * pixel, ahead));
    }
    else if (glm::distance(mark.rest, mark.now) > SeenMm)
    {
      const auto lines = arrow(mark.rest, mark.now, HeadPixels * pixel, ahead);
      arrows.insert(arrows.end(), lines.begin(), lines.end());
    }
  }
  vtkLatticeRepresentation& drawing = this->Bench.drawing;
  drawing.SetLines(vtkLatticeRepresentation::Mark, arrows);
  drawing.SetLines(vtkLatticeRepresentation::Strong, missing);
  drawing.SetLines(vtkLatticeRepresentation::Hold, rings);
  drawing.SetDots(dots);
  drawing.SetHighlights(
    highlight ? std::vector<glm::dvec3>{ *highlight } : std::vector<glm::dvec3>());
}

void PullTool::hover(const HandEvent& event)
{
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  this->Last = spot ? spot : this->Last;
  this->find();
  if (!spot)
  {
    this->show({});
    return;
  }
  glm::dvec3 held = spot->position;
  double least = this->gripRadius(held);
  for (const Shown& mark : this->Marks)
  {
    const double distance = glm::distance(mark.now, spot->position);
    if (distance < least)
    {
      least = distance;
      held = mark.now; // what a press would take
    }
  }
  this->show(held);
}

void PullTool::idle()
{
  this->find();
  this->show({});
}

void PullTool::pin(const glm::dvec3& rest, double radius)
{
  this->Bench.fit.claim();
  std::vector<Pin> pins = rowsFrom<Pin>(this->Bench.fit.numbers("Pins"));
  const std::size_t index = nearest(pins, rest, radius);
  const bool isNear = index < pins.size();
  const bool isThere = isNear && pins[index].enabled;
  if (isThere)
  {
    pins.erase(pins.begin() + static_cast<std::ptrdiff_t>(index));
  }
  else if (isNear) // switched off: it is not drawn
  {
    pins[index] = { rest, true };
  }
  else
  {
    pins.push_back({ rest, true });
  }
  this->Bench.fit.replace("Pins", numbersFrom(pins), isThere ? "Remove pin" : "Pin tissue");
}

bool PullTool::press(const HandEvent& event)
{
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  const std::optional<glm::dvec3> rest =
    spot ? this->Bench.probe.restOf(spot->position) : std::nullopt;
  if (!rest)
  {
    return false;
  }
  this->Last = spot;
  if (commandOf(Tool::Pull, Mouse::Click, event) == Command::Select)
  {
    this->Held.reset();
    this->pin(*rest, this->gripRadius(spot->position));
    return true;
  }
  this->Rest = *rest;
  this->Held = { *spot, pixelOf(event) };
  this->Begun = false;
  this->takeHold(*spot);
  return true;
}

void PullTool::takeHold(const Spot& spot)
{
  this->find();
  this->List = this->pulls();
  const double radius = this->gripRadius(spot.position);
  this->Dragged = nearest(this->List, this->Rest, radius);
  if (this->Dragged == this->List.size())
  {
    const std::vector<glm::dvec3> fitted = this->Bench.fit.fittedPositions({ this->Rest });
    const glm::dvec3& measured = fitted.empty() ? this->Rest : fitted.front();
    this->List.push_back({ this->Rest, measured, 1.0 }); // strokes on top
  }
  Pull& pull = this->List[this->Dragged];
  if (!(pull.weight > 0.0)) // switched off: the other pulls place the tissue
  {
    const std::vector<glm::dvec3> fitted = this->Bench.fit.fittedPositions({ pull.rest });
    pull.measured = fitted.empty() ? pull.rest : fitted.front();
    this->Bench.fit.formerWeights()->setOn(pull, true);
  }
  this->From = pull.measured;
}

void PullTool::drag(const HandEvent& event)
{
  FitEditor& fit = this->Bench.fit;
  if (!this->Held ||
    (!fit.isEditing() &&
      glm::distance(pixelOf(event), this->Held->pixel) <
        LeastPixels * this->Bench.probe.screenScale()))
  {
    return;
  }
  if (this->Begun && !fit.isEditing())
  {
    this->Held.reset(); // undo or a script changed the pulls first: keep their change
    return;
  }
  if (!fit.isEditing() && fit.claim())
  {
    this->takeHold(this->Held->spot); // of what a run left there, which may have pulls of its own
  }
  const glm::dvec3 moved = this->pulled(*this->Held, pixelOf(event));
  Pull& pull = this->List[this->Dragged];
  pull.measured = this->From + this->beforeStrength(moved);
  // The server is not asked where tissue came: that under the hand follows it.
  const auto mark = std::find_if(this->Marks.begin(), this->Marks.end(),
    [&](const Shown& shown) { return !shown.isPin && shown.rest == pull.rest; });
  const glm::dvec3 now = this->Held->spot.position + moved;
  if (mark == this->Marks.end())
  {
    this->Marks.push_back({ pull.rest, now, now, false });
  }
  else
  {
    mark->now = mark->target = now;
  }
  this->show(now);
  const std::vector<double> numbers = numbersFrom(this->List);
  if (fit.isEditing())
  {
    fit.change(numbers);
  }
  else
  {
    fit.begin("Pulls", numbers);
    this->Begun = true;
  }
}

void PullTool::release()
{
  this->settle();
  this->Held.reset();
}

void PullTool::settle()
{
  if (this->Bench.fit.isEditing())
  {
    this->Bench.fit.commit("Pull tissue");
  }
}

void PullTool::cancel()
{
  this->Held.reset();
  this->Bench.fit.cancel();
  this->idle();
}
}

ToolRow pullTool()
{
  ToolRow row;
  row.tool = Tool::Pull;
  row.key = Qt::ALT | Qt::Key_4;
  row.what = QT_TRANSLATE_NOOP("BrainShift",
    "Drag tissue to its new position, and pin tissue that must not move. All pulls, pins and "
    "measurements are solved together.");
  row.page = "tools/pull.md";
  row.gestures = {
    byMouse(Command::DragTissue, Mouse::Drag, {},
      QT_TRANSLATE_NOOP("BrainShift",
        "Drag the tissue under the cursor to its new position. Neighbouring tissue follows "
        "smoothly. If the tissue already has a pull, dragging moves that pull."),
      QT_TRANSLATE_NOOP("BrainShift", "pull the tissue")),
    byMouse(Command::Select, Mouse::Click, Qt::ShiftModifier,
      QT_TRANSLATE_NOOP("BrainShift",
        "Pin the tissue under the cursor: it keeps its position in the volume as loaded. A "
        "click on a pin removes the pin."),
      QT_TRANSLATE_NOOP("BrainShift", "pin the tissue")),
    byKey(Command::SelectByKey, { Qt::SHIFT | Qt::Key_Space },
      QT_TRANSLATE_NOOP("BrainShift", "Pin the tissue under the cursor, or remove its pin.")),
  };
  row.make = make<PullTool>;
  return row;
}
}
