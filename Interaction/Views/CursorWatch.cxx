// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/CursorWatch.h"

#include "Interaction/Commands/Application.h"

#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSMRenderViewProxy.h>

namespace brainshift
{
RestingCursor::RestingCursor(QObject* parent)
  : QObject(parent)
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(0); // a pick in the middle of a picture would query a busy server
  this->connect(&this->Soon, &QTimer::timeout, this, &RestingCursor::sees);
  this->connect(serverManagerModel(), &pqServerManagerModel::dataUpdated, this,
    [this](pqPipelineSource* source) {
      this->Outdated = this->Outdated || source == this->Deformation;
    });
}

void RestingCursor::follow(pqPipelineSource* deformation, pqRenderView* view)
{
  if (this->View)
  {
    this->View->disconnect(this);
  }
  this->Deformation = deformation;
  this->View = view;
  if (view)
  {
    this->connect(view, &pqView::endRender, this, [this] {
      if (this->Outdated)
      {
        this->Outdated = false;
        this->signalSoon();
      }
    });
    this->signalSoon();
  }
}

namespace
{
constexpr float BeforeWidgets = 1.0f; // before widgets, 0.5
}

CursorWatch::CursorWatch(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, &CursorWatch::watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    this->watch(view);
  }
}

pqRenderView* CursorWatch::view() const
{
  return this->Over;
}

void CursorWatch::watch(pqView* added)
{
  auto view = qobject_cast<pqRenderView*>(added);
  vtkRenderWindowInteractor* interactor =
    view ? view->getRenderViewProxy()->GetInteractor() : nullptr;
  if (!interactor)
  {
    return;
  }
  this->Views[interactor] = view;
  for (unsigned long event : { vtkCommand::EnterEvent, vtkCommand::MouseMoveEvent })
  {
    this->Connector->Connect(
      interactor, event, this, SLOT(enter(vtkObject*)), nullptr, BeforeWidgets);
  }
  this->Connector->Connect(
    interactor, vtkCommand::LeaveEvent, this, SLOT(leave(vtkObject*)), nullptr, BeforeWidgets);
  QObject::connect(view, &QObject::destroyed, this, [this, interactor] {
    this->Views.remove(interactor);
    this->Connector->Disconnect(interactor);
  });
}

void CursorWatch::enter(vtkObject* interactor)
{
  this->Over = this->Views.value(interactor);
  if (this->Over)
  {
    Q_EMIT this->moved(this->Over);
  }
}

void CursorWatch::leave(vtkObject* interactor)
{
  if (this->Over == this->Views.value(interactor))
  {
    this->Over = nullptr;
    Q_EMIT this->left();
  }
}
}
