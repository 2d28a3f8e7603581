// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/ToolKeys.h"

#include "Interaction/ToolCarrier.h"
#include "Interaction/Tools/HandTool.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkRenderWindow.h>
#include <vtkSMRenderViewProxy.h>

#include <QApplication>
#include <QCursor>
#include <QKeyEvent>
#include <QWidget>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr int StepPixels = 8; // more than a resting hand trembles: each step is a new position
constexpr std::array<glm::ivec2, 4> Steps{ { { -1, 0 }, { 1, 0 }, { 0, 1 }, { 0, -1 } } };

glm::ivec2 sizeOf(pqRenderView* view)
{
  const int* size = view->getRenderViewProxy()->GetRenderWindow()->GetSize();
  return { size[0], size[1] };
}

// One step from a pixel, or else the middle of the view. `direction`: 0 left, 1 right, 2 up,
// 3 down.
glm::ivec2 stepped(pqRenderView* view, const std::optional<glm::ivec2>& from, int direction)
{
  const glm::ivec2 size = sizeOf(view);
  const int step = static_cast<int>(std::lround(StepPixels * view->widget()->devicePixelRatioF()));
  const glm::ivec2 at = from ? *from + step * Steps[direction] : size / 2;
  return { std::clamp(at.x, 0, size.x - 1), std::clamp(at.y, 0, size.y - 1) };
}

// As far as the system lets a program move the mouse.
void takeMouseAlong(pqRenderView* view, const glm::ivec2& to)
{
  QWidget* widget = view->widget();
  const QPointF inView = QPointF(to.x, sizeOf(view).y - 1 - to.y) / widget->devicePixelRatioF();
  QCursor::setPos(widget->mapToGlobal(inView.toPoint()));
}

bool isModifier(int key)
{
  return key == Qt::Key_Shift || key == Qt::Key_Control || key == Qt::Key_Alt ||
    key == Qt::Key_AltGr || key == Qt::Key_Meta;
}

bool hasKeyboard(pqRenderView* view)
{
  QWidget* focus = QApplication::focusWidget(); // null: a window inside the view has it
  QWidget* widget = view->widget();
  return !focus || focus == widget || widget->isAncestorOf(focus);
}
}

ToolKeys::ToolKeys(ToolCarrier* carrier)
  : QObject(carrier)
  , Carrier(*carrier)
{
  qApp->installEventFilter(this);
}

bool ToolKeys::viewHasKeys() const
{
  return !isTyping() && hasKeyboard(this->Carrier.view());
}

HandEvent ToolKeys::eventAtCursor() const
{
  HandEvent event;
  event.x = this->Carrier.pixel().x;
  event.y = this->Carrier.pixel().y;
  return event;
}

void ToolKeys::holdAxis(ToolSettings::AxisHold axis)
{
  ToolSettings* settings = ToolSettings::instance();
  settings->setAxisHold(settings->axisHold() == axis ? ToolSettings::AxisHold::None : axis);
  this->Carrier.handle(this->eventAtCursor());
}

void ToolKeys::setInterest()
{
  if (const auto spot = this->Carrier.probe()->spotAt(glm::dvec2(this->Carrier.pixel())))
  {
    this->Carrier.tool()->turnAway(); // the next stroke aims elsewhere
    setPointOfInterest(this->Carrier.deformation()->getProxy(), spot->position);
    this->Carrier.hoverAgain();
  }
}

void ToolKeys::moveCursor(int direction)
{
  std::optional<glm::ivec2> from;
  if (this->Carrier.hand() != Hand::Away)
  {
    from = this->Carrier.pixel();
  }
  const glm::ivec2 to = stepped(this->Carrier.view(), from, direction);
  this->Carrier.moveTo(to);
  takeMouseAlong(this->Carrier.view(), to); // the tool does not need it
}

void ToolKeys::step(int clicks)
{
  HandEvent event = this->eventAtCursor();
  event.kind = HandEvent::Kind::Wheel;
  event.clicks = clicks;
  this->Carrier.handle(event);
}

void ToolKeys::hold(bool shift)
{
  HandEvent event = this->eventAtCursor();
  event.shift = shift;
  event.kind = this->Carrier.isHolding() ? HandEvent::Kind::Release : HandEvent::Kind::Press;
  this->Carrier.handleByKey(event);
  if (this->Carrier.isHolding() && shift) // it selects, and takes no hold
  {
    this->hold(false);
  }
}

StrokeEditor* ToolKeys::editorUnderCursor() const
{
  pqPipelineSource* deformation = activeDeformation(this->Carrier.viewUnderCursor());
  const bool applied = deformation && deformation->modifiedState() != pqProxy::UNINITIALIZED;
  return applied ? StrokeEditor::of(deformation) : nullptr;
}

bool ToolKeys::canDo(Command command) const
{
  const ToolCarrier& carrier = this->Carrier;
  const bool inHand = carrier.tool();
  const bool isHolding = carrier.isHolding();
  const bool overView = carrier.viewUnderCursor() && !isHolding && !isTyping();
  const bool isByMouse = carrier.hand() == Hand::HoldingByButton;
  const bool knowsPixel = carrier.hand() != Hand::Away;
  switch (command)
  {
    case Command::HoldAxis:
      return isHolding;
    case Command::Cancel:
      return inHand && (isHolding || carrier.isEditing());
    case Command::SetPointOfInterest:
      return inHand && works(command, carrier.kind()) &&
        (overView || (carrier.isMovedByKeys() && this->viewHasKeys()));
    case Command::MoveCursor:
      return inHand && !isByMouse && this->viewHasKeys();
    case Command::TakeHold:
      return inHand && !isByMouse && knowsPixel && this->viewHasKeys();
    case Command::StepByKey:
      return inHand && !isHolding && works(command, carrier.kind()) && knowsPixel &&
        this->viewHasKeys();
    case Command::ShowAsLoaded:
      return overView && this->editorUnderCursor();
    case Command::StepSlices:
      return overView && ToolSettings::instance()->ground() == ToolSettings::Ground::FlatSlices;
    default:
      return false;
  }
}

void ToolKeys::act(const KeyCommand& found, bool shift)
{
  constexpr int firstAxis = static_cast<int>(ToolSettings::AxisHold::X);
  switch (found.command)
  {
    case Command::HoldAxis:
      this->holdAxis(static_cast<ToolSettings::AxisHold>(firstAxis + found.index));
      break;
    case Command::Cancel:
      this->Carrier.cancel();
      break;
    case Command::SetPointOfInterest:
      this->setInterest();
      break;
    case Command::MoveCursor:
      this->moveCursor(found.index);
      break;
    case Command::StepByKey:
      this->step(found.index == 0 ? 1 : -1);
      break;
    case Command::TakeHold:
      this->hold(shift);
      break;
    case Command::ShowAsLoaded:
      this->Carrier.showBefore(this->editorUnderCursor());
      break;
    case Command::StepSlices:
      this->Carrier.stepSlices(found.index == 0 ? 1 : -1);
      break;
    default:
      break;
  }
}

bool ToolKeys::handleKey(QKeyEvent& key, QEvent::Type type)
{
  const KeyCommand found = commandOfKey({ Scope::Tool, Scope::View, Scope::Slices }, key.key());
  if (type == QEvent::KeyRelease && found.command == Command::ShowAsLoaded && !key.isAutoRepeat() &&
    this->Carrier.showsBefore())
  {
    this->Carrier.showBefore(nullptr);
    return true;
  }
  Qt::KeyboardModifiers free = Qt::KeypadModifier;
  free.setFlag(Qt::ShiftModifier,
    found.command == Command::StepByKey || // many type + with it
      (found.command == Command::TakeHold && works(Command::SelectByKey, this->Carrier.kind())));
  if ((key.modifiers() & ~free) != Qt::NoModifier || !this->canDo(found.command))
  {
    return false;
  }
  if (type == QEvent::ShortcutOverride)
  {
    key.accept(); // or a shortcut of the window comes first
    return true;
  }
  // Only these commands repeat while a key is held.
  const bool repeats = found.command == Command::StepSlices ||
    found.command == Command::MoveCursor || found.command == Command::StepByKey;
  if (type == QEvent::KeyPress && (repeats || !key.isAutoRepeat()))
  {
    this->act(found, key.modifiers().testFlag(Qt::ShiftModifier));
  }
  return true;
}

bool ToolKeys::eventFilter(QObject* watched, QEvent* event)
{
  const QEvent::Type type = event->type();
  if (type == QEvent::ApplicationDeactivate)
  {
    this->Carrier.showBefore(nullptr); // another window gets the key's release
  }
  const bool isKey =
    type == QEvent::KeyPress || type == QEvent::KeyRelease || type == QEvent::ShortcutOverride;
  if (isKey && this->handleKey(*static_cast<QKeyEvent*>(event), type))
  {
    return true;
  }
  const bool isShortcut =
    type == QEvent::ShortcutOverride && !isModifier(static_cast<QKeyEvent*>(event)->key());
  if (isShortcut || type == QEvent::MouseButtonPress)
  {
    this->Carrier.settle(); // Undo, by its keys, by a menu or by a button, must find the stroke
  }
  return QObject::eventFilter(watched, event);
}
}
