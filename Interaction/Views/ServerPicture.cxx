// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/ServerPicture.h"

#include <QVTKOpenGLStereoWidget.h>
#include <QVTKOpenGLWindow.h>
#include <pqRenderView.h>

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkPVRenderView.h>
#include <vtkPointData.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>

#include <QCoreApplication>
#include <QEvent>
#include <QWidget>

namespace brainshift
{
namespace
{
// Shows now what is drawn: the window waits for the server before it looks at its events.
void paintNow(QWidget* widget)
{
  if (auto inner = widget->findChild<QVTKOpenGLStereoWidget*>())
  {
    QEvent request(QEvent::UpdateRequest);
    QCoreApplication::sendEvent(inner->embeddedOpenGLWindow(), &request);
  }
  else
  {
    widget->repaint();
  }
}
}

ServerPicture::ServerPicture(pqRenderView* view)
  : QObject(view)
{
  vtkSMProxy* proxy = view->getProxy();
  auto drawn = vtkPVRenderView::SafeDownCast(proxy->GetClientSideObject());
  if (drawn && proxy->GetSession()->IsA("vtkSMSessionClient"))
  {
    this->Renderer = drawn->GetRenderer();
    this->Drawn->SetClientData(this);
    this->Drawn->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
      static_cast<ServerPicture*>(self)->keep();
    });
    constexpr float afterTheServersPixels = -1.0f;
    this->Renderer->AddObserver(vtkCommand::EndEvent, this->Drawn, afterTheServersPixels);
  }
}

ServerPicture::~ServerPicture()
{
  if (this->Renderer)
  {
    this->Renderer->RemoveObserver(this->Drawn);
  }
}

ServerPicture::Seen ServerPicture::seen() const
{
  const int* size = this->Renderer->GetRenderWindow()->GetSize();
  return { { size[0], size[1] }, this->Renderer->GetActiveCamera()->GetMTime() };
}

void ServerPicture::keep()
{
  this->Kept = this->seen();
  const auto [width, height] = this->Kept.size;
  this->Renderer->GetRenderWindow()->GetPixelData(
    0, 0, width - 1, height - 1, /*front*/ 0, this->Pixels);
}

void ServerPicture::drawOver(pqView* view)
{
  if (auto picture = view->findChild<ServerPicture*>(QString(), Qt::FindDirectChildrenOnly))
  {
    picture->draw();
    paintNow(view->widget());
  }
}

void ServerPicture::draw()
{
  if (!this->Renderer || this->Pixels->GetNumberOfTuples() == 0 || !(this->seen() == this->Kept))
  {
    return;
  }
  vtkNew<vtkImageData> image;
  image->SetDimensions(this->Kept.size[0], this->Kept.size[1], 1);
  image->GetPointData()->SetScalars(this->Pixels);
  vtkNew<vtkImageMapper> mapper;
  mapper->SetInputData(image);
  mapper->SetColorWindow(255.0); // values as they are
  mapper->SetColorLevel(127.5);
  vtkNew<vtkActor2D> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetDisplayLocationToBackground(); // else it hides what is drawn over it
  vtkNew<vtkRenderer> last; // in the place of the view's, which would ask the server
  last->AddViewProp(actor);
  vtkRenderWindow* window = this->Renderer->GetRenderWindow();
  window->AddRenderer(last);
  this->Renderer->DrawOff();
  window->Render();
  this->Renderer->DrawOn();
  window->RemoveRenderer(last);
}
}
