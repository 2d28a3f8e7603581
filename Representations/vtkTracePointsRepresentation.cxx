// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTracePointsRepresentation.h"

#include "Common/Guard.h"
#include "Representations/Traces/TracePoints.h"
#include "Representations/Workarounds/ParaViewFaults.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPVDataDeliveryManager.h"
#include "vtkPVView.h"
#include "vtkPointGaussianMapper.h"

#include <algorithm>

vtkStandardNewMacro(vtkTracePointsRepresentation);
brainshiftGuardRequestsMacro(vtkTracePointsRepresentation);

vtkTracePointsRepresentation::vtkTracePointsRepresentation()
{
  this->Actor = vtkSmartPointer<brainshift::TracePoints>::New();
  this->Actor->SetMapper(this->Mapper);
  this->Mapper->SetScaleFactor(0.0);
  this->TellProp();
}

vtkTracePointsRepresentation::~vtkTracePointsRepresentation() = default;

void vtkTracePointsRepresentation::TellProp()
{
  static_cast<brainshift::TracePoints*>(this->Actor.Get())->HiddenOpacity =
    this->HiddenPoints == Hide   ? 0.0
    : this->HiddenPoints == Show ? 1.0
                                 : this->HiddenOpacity;
}

void vtkTracePointsRepresentation::SetHiddenPoints(int hidden)
{
  this->HiddenPoints = std::clamp<int>(hidden, Fade, Show);
  this->TellProp();
}

void vtkTracePointsRepresentation::SetHiddenOpacity(double opacity)
{
  this->HiddenOpacity = std::clamp(opacity, 0.0, 1.0);
  this->TellProp();
}

double vtkTracePointsRepresentation::GetSplatSize()
{
  return this->Mapper->GetScaleFactor();
}

int vtkTracePointsRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  return brainshift::guarded(this, 0, [&] {
    brainshift::FailedUpdate failed(this, request);
    const int result = this->Superclass::ProcessViewRequest(request, input, output);
    failed.end();
    auto* view = vtkPVView::SafeDownCast(input->Get(vtkPVView::VIEW()));
    if (result && view && request == vtkPVView::REQUEST_UPDATE_LOD())
    {
      // Points have no stand-ins for interactive pictures, and would be missing after a stroke.
      unsigned int idAndPort[] = { this->GetUniqueIdentifier(), 0 };
      view->GetDeliveryManager()->Deliver(/*use_low_res*/ 0, 2, idAndPort);
    }
    return result;
  });
}

void vtkTracePointsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HiddenPoints: " << this->HiddenPoints << "\n"
     << indent << "HiddenOpacity: " << this->HiddenOpacity << "\n";
}
