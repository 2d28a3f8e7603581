// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/ToolCarrier.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Tools/HandTool.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/SliceMouse.h"
#include "Interaction/Views/WidgetInView.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkRenderWindowInteractor.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <QApplication>

#include <algorithm>
#include <cmath>

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
}

ToolCarrier::ToolCarrier(QObject* parent)
  : QObject(parent)
  , Cursor(this)
  , Resting(this)
{
  this->Refresh.setSingleShot(true);
  this->Refresh.setInterval(0);
  QObject::connect(&this->Refresh, &QTimer::timeout, this, &ToolCarrier::refresh);
  this->Settle.setSingleShot(true);
  this->Settle.setInterval(SettleMs);
  QObject::connect(&this->Settle, &QTimer::timeout, this, [this] {
    this->HandNow = this->HandNow == Hand::Zooming ? Hand::Hovering : this->HandNow;
    this->settle();
  });
  QObject::connect(&this->Cursor, &CursorWatch::moved, this, &ToolCarrier::followCursor);
  QObject::connect(&this->Resting, &RestingCursor::sees, this, &ToolCarrier::hoverAgain);
  this->followApplication();
  // Later, parts of the window that receive changes are gone already.
  QObject::connect(qApp, &QCoreApplication::aboutToQuit, this, [this] {
    this->showBefore(nullptr);
    this->putDown();
    this->Kept.letGo();
  });
}

void ToolCarrier::followApplication()
{
  const auto soon = [this] { this->Refresh.start(); };
  pqActiveObjects* active = &pqActiveObjects::instance();
  QObject::connect(ToolSettings::instance(), &ToolSettings::changed, this, [this, soon] {
    // A press that follows a key at once must find the tool that the key took.
    ToolSettings::instance()->tool() != this->Wanted ? this->refresh() : soon();
  });
  QObject::connect(
    ToolSettings::instance(), &ToolSettings::switchWanted, this, [this] { this->Other.take(); });
  QObject::connect(active, &pqActiveObjects::viewChanged, this, [this](pqView* view) {
    this->Under = qobject_cast<pqRenderView*>(view);
    this->Refresh.start();
  });
  QObject::connect(active, &pqActiveObjects::sourceChanged, this, soon);
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this, soon);
  QObject::connect(model, &pqServerManagerModel::sourceAdded, this,
    [](pqPipelineSource* source) { FitEditor::of(source); }); // a fit follows its settings
  QObject::connect(model, &pqServerManagerModel::dataUpdated, this, soon);
  // Before a source or view is gone, nothing of it may stay in hand.
  QObject::connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (source == this->Deformation)
    {
      this->cancel(); // nothing may be made for what goes
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
  return this->Deformation && this->View && this->Editor && this->Fit;
}

pqPipelineSource* ToolCarrier::deformation() const
{
  return this->Deformation;
}

pqRenderView* ToolCarrier::view() const
{
  return this->View;
}

bool ToolCarrier::isEditing() const
{
  return this->Editor->isEditing() || this->Fit->isEditing();
}

bool ToolCarrier::isHolding() const
{
  return this->HandNow == Hand::HoldingByButton || this->HandNow == Hand::HoldingByKey;
}

void ToolCarrier::showBefore(StrokeEditor* editor)
{
  if (this->ShowingBefore)
  {
    this->ShowingBefore->showBefore(false);
  }
  this->ShowingBefore = editor;
  if (editor)
  {
    editor->showBefore(true);
  }
}

void ToolCarrier::putDown()
{
  if (HandTool* tool = this->tool())
  {
    tool->settle();
  }
  this->HandNow = Hand::Away;
  this->ByKeys = false;
  this->Settle.stop();
  this->Held.reset();
  this->Probe.reset();
  this->Widget.reset();
  this->Editor = nullptr;
  this->Fit = nullptr;
  this->Deformation = nullptr;
  this->View = nullptr;
  this->Other.follow(nullptr, nullptr);
  this->Resting.follow(nullptr, nullptr);
  this->ToolInHand = Tool::None;
}

void ToolCarrier::refresh()
{
  ToolSettings* settings = ToolSettings::instance();
  this->Wanted = settings->tool();
  pqRenderView* view = this->Under
    ? this->Under.data()
    : qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  pqPipelineSource* deformation = activeDeformation(view);
  const bool both = deformation && view && deformation->getServer() == view->getServer();
  const Tool tool = both ? settings->tool() : Tool::None;
  if (!this->isAlive() || tool != this->ToolInHand || deformation != this->Deformation ||
    view != this->View)
  {
    const bool sameVolume = deformation == this->Deformation;
    this->putDown();
    if (tool == Tool::None || !sameVolume)
    {
      this->Kept.letGo();
    }
    if (tool != Tool::None)
    {
      this->take(deformation, view, tool);
    }
  }
  this->suggestRanges();
  this->Other.report();
  this->reportMoved();
}

void ToolCarrier::reportMoved()
{
  pqDataRepresentation* display =
    this->tool() ? bentDisplay(this->Deformation, this->View) : nullptr;
  const bool moved = display && isMoved(display);
  ToolSettings* settings = ToolSettings::instance();
  if (moved != this->SaysMoved || (moved && settings->request().isEmpty()))
  {
    this->SaysMoved = moved;
    settings->setRequest(moved
        ? QCoreApplication::translate("BrainShift",
            "The display of %1 has a Translation, an Orientation or a Scale, so no tool works "
            "here. Set Translation and Orientation to 0 and Scale to 1.")
            .arg(this->Deformation->getSMName())
        : QString());
  }
}

void ToolCarrier::take(pqPipelineSource* deformation, pqRenderView* view, Tool tool)
{
  this->Deformation = deformation;
  this->View = view;
  this->Editor = StrokeEditor::of(deformation);
  this->Fit = FitEditor::of(deformation);
  this->ToolInHand = tool;
  this->Widget = std::make_unique<WidgetInView>(
    view, [this](const HandEvent& event) { return this->hearMouse(event); });
  this->Probe = std::make_unique<ViewProbe>(deformation, view, this->Kept);
  this->Held = toolRow(tool).make({ *this->Probe, *this->Editor, *this->Fit,
    *ToolSettings::instance(), *this->Widget->representation() });
  this->Held->idle();
  this->drawSoon();
  this->Other.follow(deformation, view);
  this->Resting.follow(deformation, view);
}

void ToolCarrier::hoverAgain()
{
  const bool rests = this->tool() && this->Cursor.view() == this->View && !this->isHolding() &&
    !this->isEditing() && !this->ShowingBefore && !this->Other.shown();
  if (rests)
  {
    const int* at = this->View->getRenderViewProxy()->GetInteractor()->GetEventPosition();
    HandEvent event;
    event.x = at[0];
    event.y = at[1];
    const vtkMTimeType before = this->Widget->representation()->GetMTime();
    this->Held->hover(event);
    this->drawIfChanged(before);
  }
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
  if (this->isHolding())
  {
    return;
  }
  if (view != this->Under)
  {
    this->Under = view;
    this->refresh();
  }
  ToolSettings::instance()->setGround(groundOf(activeDeformation(view), view));
  this->Other.report();
  this->reportMoved();
}

// Keys take the mouse along, as far as the system lets them; that must not end their work.
bool ToolCarrier::hearMouse(const HandEvent& event)
{
  constexpr int rounding = 2; // pixels
  const bool goneAlong =
    (event.kind == HandEvent::Kind::Move && std::abs(event.x - this->Pixel.x) <= rounding &&
      std::abs(event.y - this->Pixel.y) <= rounding) ||
    event.kind == HandEvent::Kind::Leave;
  if (this->ByKeys && goneAlong)
  {
    return false;
  }
  this->ByKeys = false;
  return this->handle(event);
}

void ToolCarrier::moveTo(const glm::ivec2& pixel)
{
  HandEvent event;
  event.x = pixel.x;
  event.y = pixel.y;
  this->ByKeys = true;
  if (!this->isHolding())
  {
    this->Held->settle();
  }
  this->handle(event);
}

void ToolCarrier::handleByKey(const HandEvent& event)
{
  this->handle(event);
  this->HandNow = this->isHolding() ? Hand::HoldingByKey : this->HandNow;
}

bool ToolCarrier::handle(const HandEvent& event)
{
  this->Pixel = { event.x, event.y };
  if (event.kind != HandEvent::Kind::Leave)
  {
    this->HandNow = this->HandNow == Hand::Away ? Hand::Hovering : this->HandNow;
  }
  else if (!this->isHolding())
  {
    this->HandNow = Hand::Away;
  }
  if (!this->tool() || this->ShowingBefore)
  {
    return false;
  }
  const vtkMTimeType before = this->Widget->representation()->GetMTime();
  const bool taken = this->pass(event);
  this->drawIfChanged(before);
  return taken;
}

bool ToolCarrier::pass(const HandEvent& event)
{
  switch (event.kind)
  {
    case HandEvent::Kind::Press:
      return this->press(event);
    case HandEvent::Kind::Move:
      return this->move(event);
    case HandEvent::Kind::Release:
      return this->release(event);
    case HandEvent::Kind::Wheel:
      return this->turnWheel(event);
    case HandEvent::Kind::Leave:
      if (!this->isHolding())
      {
        this->Held->settle();
        this->Held->idle();
      }
      return false;
  }
  return false;
}

bool ToolCarrier::press(const HandEvent& event)
{
  this->Settle.stop();
  this->Held->settle();
  // Move would take control points of a volume that is not seen.
  const bool taken = !this->Other.shown() && this->Held->press(event);
  this->HandNow = taken ? Hand::HoldingByButton : Hand::Hovering;
  if (!taken && !event.shift && !event.control)
  {
    this->Other.press({ event.x, event.y });
  }
  return taken;
}

bool ToolCarrier::move(const HandEvent& event)
{
  if (this->isHolding())
  {
    this->Held->drag(event);
    return true;
  }
  const bool isDropped = this->HandNow == Hand::Dropped;
  this->HandNow = isDropped ? Hand::Dropped : Hand::Hovering;
  if (this->Other.shown())
  {
    this->outlineNothing();
  }
  else if (isDropped || QApplication::mouseButtons() == Qt::NoButton) // else the camera's
  {
    this->Held->hover(event);
  }
  return false;
}

bool ToolCarrier::release(const HandEvent& event)
{
  const bool wasHolding = this->isHolding();
  this->HandNow = Hand::Hovering;
  if (!wasHolding)
  {
    this->Other.release({ event.x, event.y });
    this->Resting.signalSoon();
    return false;
  }
  this->Held->release();
  ToolSettings::instance()->setAxisHold(ToolSettings::AxisHold::None);
  return true;
}

bool ToolCarrier::turnWheel(const HandEvent& event)
{
  this->Settle.start();
  const bool taken = this->HandNow != Hand::Zooming && this->Held->wheel(event);
  if (!taken && !this->isHolding())
  {
    this->HandNow = Hand::Zooming;
    this->Held->turnAway();
  }
  return taken;
}

// Clears only once: each change is a picture.
void ToolCarrier::outlineNothing()
{
  if (this->Widget->representation()->GetBounds())
  {
    this->Widget->representation()->Clear();
  }
}

void ToolCarrier::drawIfChanged(vtkMTimeType before)
{
  if (this->Widget && this->Widget->representation()->GetMTime() != before)
  {
    this->drawSoon();
  }
}

// While something is under the hand, its editor draws.
void ToolCarrier::drawSoon()
{
  if (this->isAlive() && !this->isEditing())
  {
    this->View->render();
  }
}

void ToolCarrier::stepSlices(int voxels)
{
  if (HandTool* tool = this->tool())
  {
    tool->turnAway();
  }
  if (SliceMouse* slices = SliceMouse::of(this->Cursor.view()))
  {
    this->Resting.signalAfterPicture();
    slices->step(voxels);
  }
}

void ToolCarrier::settle()
{
  if (this->tool() && !this->isHolding())
  {
    this->Held->settle();
  }
}

void ToolCarrier::cancel()
{
  if (HandTool* tool = this->tool())
  {
    if (this->isHolding() || this->HandNow == Hand::Dropped)
    {
      this->HandNow = this->HandNow == Hand::HoldingByButton ? Hand::Dropped : Hand::Hovering;
    }
    tool->cancel();
    this->Widget->widget()->LetGo();
    ToolSettings::instance()->setAxisHold(ToolSettings::AxisHold::None);
    this->Resting.signalAfterPicture();
    this->drawSoon();
  }
}
}
