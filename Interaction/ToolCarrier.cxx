// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/ToolCarrier.h"

#include "Interaction/Edits/FitEditor.h"
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
#include <vtkRenderWindowInteractor.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <QApplication>
#include <QWidget>

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
    this->Zooming = false;
    if (this->Tool && this->isAlive() && !this->Holding)
    {
      this->Tool->settle();
    }
  });
  QObject::connect(&this->Cursor, &CursorWatch::moved, this, &ToolCarrier::followCursor);
  QObject::connect(&this->Resting, &RestingCursor::sees, this, &ToolCarrier::hoverAgain);
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
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
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

bool ToolCarrier::isEditing() const
{
  return this->Editor->isEditing() || this->Fit->isEditing();
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
  this->HeldByKey = false;
  this->Dropped = false;
  this->Zooming = false;
  this->ByKeys = false;
  this->HasCursor = false;
  this->Settle.stop();
  this->Tool.reset();
  this->Probe.reset();
  this->Widget.reset();
  this->Editor = nullptr;
  this->Fit = nullptr;
  this->Deformation = nullptr;
  this->View = nullptr;
  this->Other.follow(nullptr, nullptr);
  this->Resting.follow(nullptr, nullptr);
  this->ToolInHand = ToolKind::None;
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
      this->Fit = FitEditor::of(deformation);
      this->ToolInHand = tool;
      this->Widget = std::make_unique<WidgetInView>(
        view, [this](const HandEvent& event) { return this->hearMouse(event); });
      this->Probe = std::make_unique<ViewProbe>(deformation, view, this->Kept);
      this->Tool = makeTool(tool,
        { *this->Probe, *this->Editor, *this->Fit, *settings, *this->Widget->representation() });
      this->Tool->idle();
      this->drawSoon();
      this->Other.follow(deformation, view);
      this->Resting.follow(deformation, view);
    }
  }
  this->suggestRanges();
  this->Other.tell();
}

void ToolCarrier::hoverAgain()
{
  const bool rests = this->Tool && this->isAlive() && this->Cursor.view() == this->View &&
    !this->Holding && !this->isEditing() && !this->ShowingBefore && !this->Other.shown();
  if (rests)
  {
    const int* at = this->View->getRenderViewProxy()->GetInteractor()->GetEventPosition();
    HandEvent event;
    event.x = at[0];
    event.y = at[1];
    const vtkMTimeType before = this->Widget->representation()->GetMTime();
    this->Tool->hover(event);
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
  this->Other.tell();
}

// Keys take the mouse along, as far as the system lets them; that must not end their work.
bool ToolCarrier::hearMouse(const HandEvent& event)
{
  constexpr int rounding = 2; // pixels
  const bool goneAlong =
    (event.kind == HandEvent::Kind::Move && std::abs(event.x - this->CursorX) <= rounding &&
      std::abs(event.y - this->CursorY) <= rounding) ||
    event.kind == HandEvent::Kind::Leave;
  if (this->ByKeys && goneAlong)
  {
    return false;
  }
  this->ByKeys = false;
  this->HasCursor = event.kind != HandEvent::Kind::Leave || this->HeldByKey;
  this->HeldByKey = this->HeldByKey && event.kind != HandEvent::Kind::Press;
  return this->handle(event);
}

bool ToolCarrier::handle(const HandEvent& event)
{
  this->CursorX = event.x;
  this->CursorY = event.y;
  if (!this->Tool || !this->isAlive() || this->ShowingBefore)
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
      this->Settle.stop();
      this->Tool->settle();
      // Move would take control points of a volume that is not seen.
      this->Holding = !this->Other.shown() && this->Tool->press(event);
      if (!this->Holding && !event.shift && !event.control)
      {
        this->Other.press({ event.x, event.y });
      }
      return this->Holding;
    case HandEvent::Kind::Move:
      if (this->Holding)
      {
        this->Tool->drag(event);
        return true;
      }
      this->Zooming = false;
      if (this->Other.shown())
      {
        this->outlineNothing();
      }
      else if (this->Dropped || QApplication::mouseButtons() == Qt::NoButton) // else the camera's
      {
        this->Tool->hover(event);
      }
      return false;
    case HandEvent::Kind::Release:
      if (!this->Holding)
      {
        this->Dropped = false;
        this->Other.release({ event.x, event.y });
        this->Resting.look();
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
        this->Tool->idle();
      }
      return false;
  }
  return false;
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

void ToolCarrier::cancel()
{
  if (this->Tool && this->isAlive())
  {
    this->Dropped = this->Holding && !this->HeldByKey;
    this->Holding = false;
    this->HeldByKey = false;
    this->Tool->cancel();
    this->Widget->widget()->LetGo();
    ToolSettings::instance()->setAxisHold(ToolSettings::AxisHold::None);
    this->Resting.lookAtNext();
    this->drawSoon();
  }
}
}
