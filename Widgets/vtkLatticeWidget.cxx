// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLatticeWidget.h"

#include "vtkLatticeRepresentation.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEvent.h"
#include "vtkObjectFactory.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkWidgetCallbackMapper.h"
#include "vtkWidgetEvent.h"

#include <utility>

using brainshift::HandEvent;

vtkStandardNewMacro(vtkLatticeWidget);

template <HandEvent::Kind kind, int clicks>
void vtkLatticeWidget::Listen(unsigned long vtkEvent, unsigned long widgetEvent)
{
  this->CallbackMapper->SetCallbackMethod(vtkEvent, widgetEvent, this,
    [](vtkAbstractWidget* widget) { static_cast<vtkLatticeWidget*>(widget)->Pass(kind, clicks); });
}

vtkLatticeWidget::vtkLatticeWidget()
{
  this->Listen<HandEvent::Kind::Move>(vtkCommand::MouseMoveEvent, vtkWidgetEvent::Move);
  this->Listen<HandEvent::Kind::Press>(vtkCommand::LeftButtonPressEvent, vtkWidgetEvent::Select);
  this->Listen<HandEvent::Kind::Release>(
    vtkCommand::LeftButtonReleaseEvent, vtkWidgetEvent::EndSelect);
  this->Listen<HandEvent::Kind::Wheel, 1>(vtkCommand::MouseWheelForwardEvent, vtkWidgetEvent::Up);
  this->Listen<HandEvent::Kind::Wheel, -1>(
    vtkCommand::MouseWheelBackwardEvent, vtkWidgetEvent::Down);
  this->Listen<HandEvent::Kind::Leave>(vtkCommand::LeaveEvent, vtkWidgetEvent::HoverLeave);
}

vtkLatticeWidget::~vtkLatticeWidget() = default;

void vtkLatticeWidget::SetHandler(HandlerType handler)
{
  this->Handler = std::move(handler);
}

void vtkLatticeWidget::LetGo()
{
  if (this->Holding)
  {
    this->Holding = false;
    this->ReleaseFocus();
  }
}

void vtkLatticeWidget::SetRepresentation(vtkLatticeRepresentation* representation)
{
  this->Superclass::SetWidgetRepresentation(representation);
}

void vtkLatticeWidget::SetEnabled(int enabling)
{
  if (!enabling)
  {
    this->LetGo();
  }
  this->Superclass::SetEnabled(enabling);
}

void vtkLatticeWidget::CreateDefaultRepresentation()
{
  if (!this->WidgetRep)
  {
    this->WidgetRep = vtkLatticeRepresentation::New();
  }
}

void vtkLatticeWidget::Pass(HandEvent::Kind kind, int clicks)
{
  HandEvent event;
  event.kind = kind;
  event.x = this->Interactor->GetEventPosition()[0];
  event.y = this->Interactor->GetEventPosition()[1];
  event.clicks = clicks;
  event.shift = this->Interactor->GetShiftKey() != 0;
  event.control = this->Interactor->GetControlKey() != 0;
  event.alt = this->Interactor->GetAltKey() != 0;
  const bool taken = this->Handler && this->Handler(event);
  if (kind == HandEvent::Kind::Press && taken)
  {
    this->Holding = true;
    this->GrabFocus(this->EventCallbackCommand);
  }
  if (taken || this->Holding)
  {
    this->EventCallbackCommand->SetAbortFlag(1);
  }
  if (kind == HandEvent::Kind::Release)
  {
    this->LetGo();
  }
}

void vtkLatticeWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Holding: " << this->Holding << "\n";
}
