// SPDX-License-Identifier: BSD-3-Clause
// What keys do with the tool in hand.
#include "Interaction/ToolCarrier.h"

#include "Interaction/ArrowKeys.h"
#include "Interaction/Edits/PointOfInterest.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Tools/HandTool.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/SliceMouse.h"
#include "Interaction/Views/ViewProbe.h"

#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <glm/vec2.hpp>

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>

#include <optional>

namespace brainshift
{
namespace
{
// Where a person types, keys are letters.
bool isTyping()
{
  QWidget* focus = QApplication::focusWidget();
  return focus && focus->testAttribute(Qt::WA_InputMethodEnabled);
}
}

void ToolCarrier::holdAxis(ToolSettings::AxisHold axis)
{
  ToolSettings* settings = ToolSettings::instance();
  settings->setAxisHold(settings->axisHold() == axis ? ToolSettings::AxisHold::None : axis);
  HandEvent event;
  event.x = this->CursorX;
  event.y = this->CursorY;
  this->handle(event);
}

void ToolCarrier::setInterest()
{
  if (const auto spot = this->Probe->spotAt({ this->CursorX, this->CursorY }))
  {
    this->Tool->turnAway(); // the next stroke aims elsewhere
    setPointOfInterest(this->Deformation->getProxy(), spot->position);
    this->hoverAgain();
  }
}

bool ToolCarrier::viewHasKeys() const
{
  return !isTyping() && hasKeyboard(this->View);
}

void ToolCarrier::moveCursor(int way)
{
  std::optional<glm::ivec2> from;
  if (this->HasCursor)
  {
    from = glm::ivec2(this->CursorX, this->CursorY);
  }
  const HandEvent event = steppedByKey(this->View, from, way);
  this->ByKeys = this->HasCursor = true;
  if (!this->Holding)
  {
    this->Tool->settle();
  }
  this->handle(event);
  takeMouseAlong(this->View, event); // the tool does not need it
}

void ToolCarrier::stampByKey(int clicks)
{
  HandEvent event;
  event.kind = HandEvent::Kind::Wheel;
  event.x = this->CursorX;
  event.y = this->CursorY;
  event.clicks = clicks;
  this->handle(event);
}

void ToolCarrier::holdByKey(bool shift)
{
  HandEvent event;
  event.kind = this->Holding ? HandEvent::Kind::Release : HandEvent::Kind::Press;
  event.x = this->CursorX;
  event.y = this->CursorY;
  event.shift = shift;
  this->handle(event);
  this->HeldByKey = this->Holding;
  if (this->Holding && shift) // it selects, and takes no hold
  {
    this->holdByKey(false);
  }
}

StrokeEditor* ToolCarrier::editorUnderCursor() const
{
  pqPipelineSource* deformation = activeDeformation(this->Cursor.view());
  const bool applied = deformation && deformation->modifiedState() != pqProxy::UNINITIALIZED;
  return applied ? StrokeEditor::of(deformation) : nullptr;
}

bool ToolCarrier::canDo(Command command) const
{
  const bool inHand = this->Tool && this->isAlive();
  const bool overView = this->Cursor.view() && !this->Holding && !isTyping();
  switch (command)
  {
    case Command::HoldAxis:
      return this->Holding;
    case Command::Cancel:
      return inHand && (this->Holding || this->isEditing());
    case Command::SetPointOfInterest:
      return inHand && this->ToolInHand == ToolKind::Stamp &&
        (overView || (this->ByKeys && this->viewHasKeys()));
    case Command::MoveCursor:
      return inHand && (!this->Holding || this->HeldByKey) && this->viewHasKeys();
    case Command::TakeHold:
      return inHand && (!this->Holding || this->HeldByKey) && this->HasCursor &&
        this->viewHasKeys();
    case Command::StampByKey:
      return inHand && !this->Holding && this->ToolInHand == ToolKind::Stamp && this->HasCursor &&
        this->viewHasKeys();
    case Command::ShowAsLoaded:
      return overView && this->editorUnderCursor();
    case Command::StepSlices:
      return overView && ToolSettings::instance()->ground() == ToolSettings::Ground::FlatSlices;
    default:
      return false;
  }
}

void ToolCarrier::stepSlices(int voxels)
{
  if (this->Tool && this->isAlive())
  {
    this->Tool->turnAway();
  }
  if (SliceMouse* slices = SliceMouse::of(this->Cursor.view()))
  {
    this->Resting.lookAtNext();
    slices->step(voxels);
  }
}

void ToolCarrier::act(const KeyCommand& found, bool shift)
{
  constexpr int firstAxis = static_cast<int>(ToolSettings::AxisHold::X);
  switch (found.command)
  {
    case Command::HoldAxis:
      this->holdAxis(static_cast<ToolSettings::AxisHold>(firstAxis + found.place));
      break;
    case Command::Cancel:
      this->cancel();
      break;
    case Command::SetPointOfInterest:
      this->setInterest();
      break;
    case Command::MoveCursor:
      this->moveCursor(found.place);
      break;
    case Command::StampByKey:
      this->stampByKey(found.place == 0 ? 1 : -1);
      break;
    case Command::TakeHold:
      this->holdByKey(shift);
      break;
    case Command::ShowAsLoaded:
      this->ShowingBefore = this->editorUnderCursor();
      this->ShowingBefore->showBefore(true);
      break;
    case Command::StepSlices:
      this->stepSlices(found.place == 0 ? 1 : -1);
      break;
    default:
      break;
  }
}

bool ToolCarrier::eventFilter(QObject* watched, QEvent* event)
{
  const QEvent::Type type = event->type();
  if (type == QEvent::ApplicationDeactivate)
  {
    this->stopShowingBefore(); // another window hears of the key's release
  }
  if (type != QEvent::KeyPress && type != QEvent::KeyRelease && type != QEvent::ShortcutOverride)
  {
    return QObject::eventFilter(watched, event);
  }
  auto key = static_cast<QKeyEvent*>(event);
  const KeyCommand found = commandOfKey({ Scope::Tool, Scope::View, Scope::Slices }, key->key());
  if (type == QEvent::KeyRelease && found.command == Command::ShowAsLoaded &&
    !key->isAutoRepeat() && this->ShowingBefore)
  {
    this->stopShowingBefore();
    return true;
  }
  Qt::KeyboardModifiers free = Qt::KeypadModifier;
  free.setFlag(Qt::ShiftModifier,
    found.command == Command::StampByKey || // many type + with it
      (found.command == Command::TakeHold &&
        (this->ToolInHand == ToolKind::Move || this->ToolInHand == ToolKind::Pull)));
  if ((key->modifiers() & ~free) != Qt::NoModifier || !this->canDo(found.command))
  {
    return QObject::eventFilter(watched, event);
  }
  if (type == QEvent::ShortcutOverride)
  {
    event->accept(); // or a shortcut of the window comes first
    return true;
  }
  // A key that is held goes on through slices, over the view, or with the stamp, and does nothing
  // else again.
  const bool repeats = found.command == Command::StepSlices ||
    found.command == Command::MoveCursor || found.command == Command::StampByKey;
  if (type == QEvent::KeyPress && (repeats || !key->isAutoRepeat()))
  {
    this->act(found, key->modifiers().testFlag(Qt::ShiftModifier));
  }
  return true;
}
}
