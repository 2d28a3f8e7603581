// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/ToolCarrier.h"

#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Tools/ToolFactory.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/SliceMouse.h"
#include "Interaction/Views/ViewProbe.h"
#include "Interaction/Views/WidgetInView.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqServerManagerModel.h>

#include <vtkLatticeRepresentation.h>
#include <vtkSMPropertyHelper.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int SettleMs = 600; // between two clicks of one burst of the wheel, at most

constexpr int Flat = 1; // InteractionMode of a 2D view

ToolSettings::Ground groundOf(pqPipelineSource* deformation, pqRenderView* view)
{
  pqDataRepresentation* display = bentDisplay(deformation, view);
  if (!display || !showsSlices(display))
  {
    return ToolSettings::Ground::Volume;
  }
  return vtkSMPropertyHelper(view->getProxy(), "InteractionMode").GetAsInt() == Flat
    ? ToolSettings::Ground::FlatSlices
    : ToolSettings::Ground::Slices;
}

// Where a person types, keys are letters.
bool isTyping()
{
  QWidget* focus = QApplication::focusWidget();
  return focus && focus->testAttribute(Qt::WA_InputMethodEnabled);
}
}

ToolCarrier::ToolCarrier(QObject* parent)
  : QObject(parent)
  , Cursor(this)
{
  this->Refresh.setSingleShot(true);
  this->Refresh.setInterval(0);
  QObject::connect(&this->Refresh, &QTimer::timeout, this, &ToolCarrier::refresh);
  this->Settle.setSingleShot(true);
  this->Settle.setInterval(SettleMs);
  QObject::connect(&this->Settle, &QTimer::timeout, this, [this] {
    this->Zooming = false;
    if (this->Tool && this->isAlive() && !this->Holding)
    {
      this->Tool->settle();
    }
  });
  this->followApplication();
  // Later, parts of the window that hear of changes are gone already.
  QObject::connect(qApp, &QCoreApplication::aboutToQuit, this, [this] {
    this->stopShowingBefore();
    this->putDown();
    this->Kept.letGo();
  });
  qApp->installEventFilter(this);
}

void ToolCarrier::followApplication()
{
  const auto soon = [this] { this->Refresh.start(); };
  pqActiveObjects* active = &pqActiveObjects::instance();
  QObject::connect(ToolSettings::instance(), &ToolSettings::changed, this, soon);
  QObject::connect(active, &pqActiveObjects::viewChanged, this, [this](pqView* view) {
    this->Under = qobject_cast<pqRenderView*>(view);
    this->Refresh.start();
  });
  QObject::connect(&this->Cursor, &CursorWatch::moved, this, &ToolCarrier::followCursor);
  QObject::connect(active, &pqActiveObjects::sourceChanged, this, soon);
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, soon);
  QObject::connect(model, &pqServerManagerModel::dataUpdated, this, soon);
  // Before a source or view is gone, nothing of it may stay in hand.
  QObject::connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (source == this->Deformation)
    {
      this->putDown();
      this->Kept.letGo();
    }
  });
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this, [this](auto* view) {
    if (view == this->View)
    {
      this->cancel();
      this->putDown();
    }
    if (view == this->Under)
    {
      this->Under = nullptr;
      ToolSettings::instance()->setGround(ToolSettings::Ground::Volume);
    }
  });
}

ToolCarrier::~ToolCarrier()
{
  this->putDown();
}

bool ToolCarrier::isAlive() const
{
  return this->Deformation && this->View && this->Editor;
}

void ToolCarrier::stopShowingBefore()
{
  if (this->ShowingBefore)
  {
    this->ShowingBefore->showBefore(false);
    this->ShowingBefore = nullptr;
  }
}

void ToolCarrier::putDown()
{
  if (this->Tool && this->isAlive())
  {
    this->Tool->settle();
  }
  this->Holding = false;
  this->Zooming = false;
  this->Settle.stop();
  this->Tool.reset();
  this->Probe.reset();
  this->Widget.reset();
  this->Editor = nullptr;
  this->Deformation = nullptr;
  this->View = nullptr;
  this->ToolInHand = ToolKind::None;
}

void ToolCarrier::refresh()
{
  ToolSettings* settings = ToolSettings::instance();
  pqRenderView* view = this->Under
    ? this->Under.data()
    : qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  pqPipelineSource* deformation = activeDeformation(view);
  const bool both = deformation && view && deformation->getServer() == view->getServer();
  const ToolKind tool = both ? settings->tool() : ToolKind::None;
  if (!this->isAlive() || tool != this->ToolInHand || deformation != this->Deformation ||
    view != this->View)
  {
    const bool sameVolume = deformation == this->Deformation;
    this->putDown();
    if (tool == ToolKind::None || !sameVolume)
    {
      this->Kept.letGo();
    }
    if (tool != ToolKind::None)
    {
      this->Deformation = deformation;
      this->View = view;
      this->Editor = StrokeEditor::of(deformation);
      this->ToolInHand = tool;
      this->Widget = std::make_unique<WidgetInView>(
        view, [this](const HandEvent& event) { return this->handle(event); });
      this->Probe = std::make_unique<ViewProbe>(deformation, view, this->Kept);
      this->Tool =
        makeTool(tool, { *this->Probe, *this->Editor, *settings, *this->Widget->representation() });
    }
  }
  this->suggestRanges();
  this->tellWhatIsShown();
}

void ToolCarrier::tellWhatIsShown()
{
  pqPipelineSource* shown =
    this->Tool && this->isAlive() ? shownInstead(this->Deformation, this->View) : nullptr;
  ToolSettings::instance()->setShownInstead(shown ? shown->getSMName() : QString());
}

void ToolCarrier::suggestRanges()
{
  if (const auto lattice = this->Probe ? this->Probe->lattice() : std::nullopt)
  {
    const glm::dvec3& spacing = lattice->spacing;
    ToolSettings::instance()->suggestRanges(
      glm::length(spacing * glm::dvec3(lattice->dimensions - 1)),
      std::max({ spacing.x, spacing.y, spacing.z }));
  }
}

void ToolCarrier::followCursor(pqRenderView* view)
{
  if (this->Holding)
  {
    return;
  }
  if (view != this->Under)
  {
    this->Under = view;
    this->refresh();
  }
  ToolSettings::instance()->setGround(groundOf(activeDeformation(view), view));
  this->tellWhatIsShown();
}

bool ToolCarrier::handle(const HandEvent& event)
{
  this->CursorX = event.x;
  this->CursorY = event.y;
  if (!this->Tool || !this->isAlive() || this->ShowingBefore)
  {
    return false;
  }
  const auto before = this->Widget->representation()->GetMTime();
  const bool taken = this->pass(event);
  if (this->Widget && this->Widget->representation()->GetMTime() != before)
  {
    this->drawSoon();
  }
  return taken;
}

bool ToolCarrier::pass(const HandEvent& event)
{
  switch (event.kind)
  {
    case HandEvent::Kind::Press:
      this->Settle.stop();
      this->Tool->settle();
      this->Holding = this->Tool->press(event);
      return this->Holding;
    case HandEvent::Kind::Move:
      if (this->Holding)
      {
        this->Tool->drag(event);
        return true;
      }
      this->Zooming = false;
      if (QApplication::mouseButtons() == Qt::NoButton) // else the camera has the mouse
      {
        this->Tool->hover(event);
      }
      return false;
    case HandEvent::Kind::Release:
      if (!this->Holding)
      {
        return false;
      }
      this->Holding = false;
      this->Tool->release();
      ToolSettings::instance()->setAxisHold(ToolSettings::AxisHold::None);
      return true;
    case HandEvent::Kind::Wheel:
      this->Settle.start();
      this->Zooming = this->Zooming || !this->Tool->wheel(event);
      if (this->Zooming && !this->Holding)
      {
        this->Tool->turnAway();
      }
      return !this->Zooming;
    case HandEvent::Kind::Leave:
      if (!this->Holding)
      {
        this->Tool->settle();
        this->Widget->representation()->Clear();
      }
      return false;
  }
  return false;
}

// While something is under the hand, its editor draws.
void ToolCarrier::drawSoon()
{
  if (this->isAlive() && !this->Editor->isEditing())
  {
    this->View->render();
  }
}

void ToolCarrier::cancel()
{
  if (this->Tool && this->isAlive())
  {
    this->Holding = false;
    this->Tool->cancel();
    this->Widget->widget()->LetGo();
    ToolSettings::instance()->setAxisHold(ToolSettings::AxisHold::None);
    this->drawSoon();
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
    this->Probe->setPointOfInterest(spot->position);
    this->Widget->representation()->Clear();
    this->drawSoon();
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
      return inHand && (this->Holding || this->Editor->isEditing());
    case Command::SetPointOfInterest:
      return inHand && overView && this->ToolInHand == ToolKind::Stamp;
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
    slices->step(voxels);
  }
}

void ToolCarrier::act(const KeyCommand& found)
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
  if (key->modifiers() != Qt::NoModifier || !this->canDo(found.command))
  {
    return QObject::eventFilter(watched, event);
  }
  if (type == QEvent::ShortcutOverride)
  {
    event->accept(); // or a shortcut of the window comes first
    return true;
  }
  // A key that is held goes on through the slices, and does nothing else again.
  const bool repeats = found.command == Command::StepSlices;
  if (type == QEvent::KeyPress && (repeats || !key->isAutoRepeat()))
  {
    this->act(found);
  }
  return true;
}
}
