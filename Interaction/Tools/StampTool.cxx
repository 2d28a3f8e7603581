// SPDX-License-Identifier: BSD-3-Clause
// The Stamp tool: pulls tissue away from the point of interest or pushes it towards that point.
// Wheel clicks do it in steps, a drag does it without.
#include "Interaction/Commands/Tools.h"
#include "Interaction/Tools/HandTool.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr double SamePlacePixels = 4.0; // a resting hand trembles less
constexpr double CrossShare = 0.15;     // of the major radius

class StampTool final : public HandTool
{
public:
  using HandTool::HandTool;

  void hover(const HandEvent& event) override;
  bool press(const HandEvent& event) override;
  void drag(const HandEvent& event) override;
  bool wheel(const HandEvent& event) override;
  void settle() override;
  void turnAway() override;
  void cancel() override;

private:
  void outline(const Spot& spot, const glm::dvec2& pixel);
  glm::dvec3 interestFrom(const Spot& spot);
  bool isAtLastStroke(const glm::dvec2& pixel) const;
  void show(const Stroke& stroke, double amount);
  void apply(double amount);
  void clickWheel(const HandEvent& event, const std::optional<Spot>& spot);
  void changeRadius(const HandEvent& event);

  Stroke Latest;                   ///< The stroke that is outlined, under the hand or made last.
  std::optional<glm::dvec3> Slice; ///< Normal of its slice.
  glm::dvec3 Interest{ 0.0 };      ///< What it aims at, mm, as long as Latest stays where it is.
  double Amount = 0.0;             ///< Displacement (mm). Pull is positive.
  bool Made = false;               ///< The last stroke of the list is Latest.
  bool Aims = false;               ///< Latest has an axis: the point of interest is not there.
  glm::dvec2 TakenAt{ 0.0 };       ///< Pixel.
  glm::dvec2 PullOnScreen{ 0.0 };  ///< During a drag: mm per pixel of the screen.
};

// The stamp over the tissue at a pixel. `Aims` is false where there is no direction to push it.
void StampTool::outline(const Spot& spot, const glm::dvec2& pixel)
{
  this->Interest = this->interestFrom(spot);
  const glm::dvec3 fromInterest = this->Interest - spot.position;
  constexpr double nearest = 1e-3; // mm; a nearer point gives no direction
  this->Aims = glm::length(fromInterest) >= nearest;
  // Without a direction the ellipsoid keeps its axis, so that it does not vanish under the cursor.
  const bool hadAxis = glm::length(this->Latest.axis) > 0.0;
  const glm::dvec3 axis = hadAxis ? this->Latest.axis : this->Bench.probe.ahead();
  this->Slice = spot.slice;
  this->Latest = this->strokeAt(spot.position, Tool::Stamp);
  this->Latest.axis = this->Aims ? glm::normalize(fromInterest) : axis;
  this->Amount = 0.0;
  this->Made = false;
  this->TakenAt = pixel;
}

// The point of interest; in a slice the nearest point of the slice to it. So what is matched in a
// slice moves within it: tissue pushed through it would leave the picture and bring other in.
glm::dvec3 StampTool::interestFrom(const Spot& spot)
{
  const glm::dvec3 interest = this->Bench.probe.pointOfInterest();
  return spot.slice ? interest - glm::dot(interest - spot.position, *spot.slice) * *spot.slice
                    : interest;
}

bool StampTool::isAtLastStroke(const glm::dvec2& pixel) const
{
  if (glm::distance(pixel, this->TakenAt) > SamePlacePixels * this->Bench.probe.screenScale())
  {
    return false;
  }
  if (this->isDragging())
  {
    return true;
  }
  const StrokeEditor::Strokes strokes = this->Bench.editor.strokes();
  const Stroke now = this->strokeAt(this->Latest.anchor, Tool::Stamp);
  const bool sameShape = now.major == this->Latest.major && now.minor == this->Latest.minor &&
    now.sigma == this->Latest.sigma;
  return this->Made && sameShape && !strokes.empty() && strokes.back() == this->Latest;
}

void StampTool::show(const Stroke& stroke, double amount)
{
  vtkLatticeRepresentation& drawing = this->Bench.drawing;
  const glm::dvec3 away = -glm::normalize(stroke.axis);
  this->showStroke(stroke, this->Slice);
  std::vector<Polyline> marks = cross(this->Interest, CrossShare * stroke.major);
  marks.push_back({ this->Interest, stroke.anchor });
  marks.push_back({ stroke.anchor, stroke.anchor + amount * away });
  drawing.SetLines(vtkLatticeRepresentation::Mark, marks);
  drawing.SetHighlights({ stroke.anchor + amount * away });
}

void StampTool::hover(const HandEvent& event)
{
  if (this->isDragging() && this->isAtLastStroke(pixelOf(event)))
  {
    return;
  }
  this->settle();
  if (this->Made && this->isAtLastStroke(pixelOf(event)))
  {
    return;
  }
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  if (!spot)
  {
    this->Bench.drawing.Clear();
    return;
  }
  this->outline(*spot, pixelOf(event));
  this->show(this->Latest, 0.0);
}

void StampTool::apply(double amount)
{
  const glm::dvec3 away = -glm::normalize(this->Latest.axis);
  this->Amount = amount;
  this->Latest.vector = this->beforeStrength(amount * away);
  this->show(this->Latest, amount);
}

bool StampTool::press(const HandEvent& event)
{
  this->settle();
  const std::optional<Spot> spot = this->Bench.probe.spotAt(pixelOf(event));
  if (!spot || isForSlices(event, *spot))
  {
    return false;
  }
  this->outline(*spot, pixelOf(event));
  if (!this->Aims)
  {
    return false;
  }
  // Along the image of the axis, or, where that points at the eye, up and down.
  ViewProbe& probe = this->Bench.probe;
  const glm::dvec3 away = -this->Latest.axis;
  const double millimetres = probe.millimetresPerPixel(this->Latest.anchor);
  const glm::dvec2 onScreen =
    probe.pixelOf(this->Latest.anchor + millimetres * away) - probe.pixelOf(this->Latest.anchor);
  constexpr double leastShare = 0.5; // of the axis' length that is seen
  const bool isSeen = glm::length(onScreen) >= leastShare;
  this->PullOnScreen =
    isSeen ? millimetres * onScreen / glm::dot(onScreen, onScreen) : glm::dvec2(0.0, millimetres);
  return true;
}

void StampTool::drag(const HandEvent& event)
{
  this->apply(glm::dot(pixelOf(event) - this->TakenAt, this->PullOnScreen));
  if (this->isDragging())
  {
    this->Bench.editor.change(this->Latest);
  }
  else
  {
    this->Bench.editor.begin(this->Latest);
  }
}

// `spot`: where a new stroke begins; none: the last one goes on.
void StampTool::clickWheel(const HandEvent& event, const std::optional<Spot>& spot)
{
  const bool under = !spot && this->isDragging();
  if (spot)
  {
    this->outline(*spot, pixelOf(event));
  }
  if (spot && !this->Aims)
  {
    return;
  }
  this->apply(this->Amount + event.clicks * this->Bench.settings.millimetresPerClick());
  if (under)
  {
    this->Bench.editor.change(this->Latest);
  }
  else if (!spot)
  {
    this->Bench.editor.beginAtLast(this->Latest);
  }
  else
  {
    this->Bench.editor.begin(this->Latest);
  }
}

void StampTool::changeRadius(const HandEvent& event)
{
  ToolSettings& settings = this->Bench.settings;
  settings.setMajorRadius(settings.majorRadius() * std::pow(GrowthPerClick, event.clicks));
  if (this->isDragging())
  {
    this->Latest.major = settings.majorRadius();
    this->show(this->Latest, this->Amount);
    this->Bench.editor.change(this->Latest);
  }
  else
  {
    this->Made = false; // the next click begins a stroke of this size
    this->hover(event);
  }
}

bool StampTool::wheel(const HandEvent& event)
{
  const Command command = commandOf(Tool::Stamp, Mouse::Wheel, event);
  if (command == Command::None || event.alt)
  {
    return false;
  }
  // A far server answers each question a round trip later, so it is asked once: about the picture
  // of the stroke that is done.
  const bool again = this->isAtLastStroke(pixelOf(event));
  if (!again)
  {
    this->settle();
  }
  const std::optional<Spot> spot = again ? std::nullopt : this->Bench.probe.spotAt(pixelOf(event));
  const bool acts = again || spot;
  if (acts && command == Command::ChangeRadius)
  {
    this->changeRadius(event);
  }
  else if (acts)
  {
    this->clickWheel(event, spot);
  }
  return acts;
}

void StampTool::settle()
{
  if (this->isDragging())
  {
    this->Made = true;
    this->Bench.editor.commit(this->Amount < 0.0 ? "Stamp: push" : "Stamp: pull");
  }
}

void StampTool::turnAway()
{
  this->settle();
  this->Made = false;
}

void StampTool::cancel()
{
  HandTool::cancel();
  this->Amount = 0.0;
  this->Made = false;
}
}

ToolRow stampTool()
{
  ToolRow row;
  row.tool = Tool::Stamp;
  row.key = Qt::ALT | Qt::Key_3;
  row.what = QT_TRANSLATE_NOOP("BrainShift", "Pull or push an ellipsoid of tissue with the wheel.");
  row.page = "tools/stamp.md";
  row.gestures = {
    byMouse(Command::StepByWheel, Mouse::Wheel, {},
      QT_TRANSLATE_NOOP("BrainShift",
        "Over tissue: pull the tissue away from the point of interest (forward) or push it towards "
        "the point (backward). Each click moves it by the distance under Per click. Clicks at one "
        "position are one stroke."),
      QT_TRANSLATE_NOOP("BrainShift", "pull or push the tissue by %1 per click")),
    byMouse(Command::DragTissue, Mouse::Drag, {},
      QT_TRANSLATE_NOOP("BrainShift",
        "Pull or push smoothly. Drag along the blue line. Where the line points at you, drag up or "
        "down."),
      QT_TRANSLATE_NOOP("BrainShift", "pull or push smoothly")),
    byMouse(Command::ChangeRadius, Mouse::Wheel, Qt::ShiftModifier,
      QT_TRANSLATE_NOOP("BrainShift", "Change the radius along the push."),
      QT_TRANSLATE_NOOP("BrainShift", "change the radius along the push")),
    byKey(Command::StepByKey, { Qt::Key_Plus, Qt::Key_Minus },
      QT_TRANSLATE_NOOP(
        "BrainShift", "Pull or push the tissue under the cursor, as a click of the wheel does.")),
    byKey(Command::SetPointOfInterest, { Qt::Key_I },
      QT_TRANSLATE_NOOP("BrainShift", "Set the point of interest to the tissue under the cursor."),
      QT_TRANSLATE_NOOP("BrainShift", "set the point of interest")),
  };
  row.gestures.front().number = &ToolSettings::millimetresPerClick;
  row.holdsAxes = false; // its axis leads to the point of interest
  row.numbers = { &ToolSettings::majorRadius, &ToolSettings::minorRadius, &ToolSettings::sigma,
    &ToolSettings::millimetresPerClick };
  row.lesson = Lesson{ "Push with the stamp",
    "Press <b>Take the stamp</b>. Move the mouse over the cortex until you see the ellipse. Turn "
    "the wheel: the tissue moves in or out. Hold Shift and turn the wheel to change the radius.",
    "Take the stamp" };
  row.make = make<StampTool>;
  return row;
}
}
