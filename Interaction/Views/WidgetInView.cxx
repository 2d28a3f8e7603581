// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/WidgetInView.h"

#include <pqRenderView.h>
#include <pqUndoStack.h>

#include <vtkLatticeRepresentation.h>
#include <vtkSMNewWidgetRepresentationProxy.h>
#include <vtkSMParaViewPipelineController.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSessionProxyManager.h>

#include <utility>

namespace brainshift
{
WidgetInView::WidgetInView(pqRenderView* view, vtkLatticeWidget::HandlerType handler)
  : View(view)
  , Picture(new ServerPicture(view))
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMSessionProxyManager* manager = view->getProxy()->GetSessionProxyManager();
  this->Proxy =
    vtk::TakeSmartPointer(manager->NewProxy("representations", "LatticeWidgetRepresentation"));
  vtkNew<vtkSMParaViewPipelineController> controller;
  controller->InitializeProxy(this->Proxy);
  this->Proxy->UpdateVTKObjects();
  this->Proxy->PrototypeOn(); // a tool in hand is no step to undo
  this->widget()->SetHandler(std::move(handler));
  vtkSMPropertyHelper(view->getProxy(), "HiddenRepresentations").Add(this->Proxy);
  view->getProxy()->UpdateVTKObjects();
  this->show(true);
}

WidgetInView::~WidgetInView()
{
  SCOPED_UNDO_EXCLUDE();
  delete this->Picture;
  this->widget()->SetHandler({});
  this->show(false);
  if (this->View)
  {
    vtkSMPropertyHelper(this->View->getProxy(), "HiddenRepresentations").Remove(this->Proxy);
    this->View->getProxy()->UpdateVTKObjects();
    this->View->render();
  }
}

void WidgetInView::show(bool on)
{
  vtkSMPropertyHelper(this->Proxy, "Visibility").Set(on);
  vtkSMPropertyHelper(this->Proxy, "Enabled").Set(on);
  this->Proxy->UpdateVTKObjects();
}

vtkLatticeRepresentation* WidgetInView::representation() const
{
  auto proxy = vtkSMNewWidgetRepresentationProxy::SafeDownCast(this->Proxy);
  return vtkLatticeRepresentation::SafeDownCast(
    proxy->GetRepresentationProxy()->GetClientSideObject());
}

vtkLatticeWidget* WidgetInView::widget() const
{
  auto proxy = vtkSMNewWidgetRepresentationProxy::SafeDownCast(this->Proxy);
  return vtkLatticeWidget::SafeDownCast(proxy->GetWidget());
}
}
