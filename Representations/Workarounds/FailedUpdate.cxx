// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Workarounds/FailedUpdate.h"

#include "vtkCommand.h"
#include "vtkInformationRequestKey.h"
#include "vtkPVDataRepresentation.h"
#include "vtkPVView.h"

namespace brainshift
{
FailedUpdate::FailedUpdate(
  vtkPVDataRepresentation* representation, vtkInformationRequestKey* request)
  : Representation(representation)
  , Asked(request == vtkPVView::REQUEST_UPDATE() && representation->GetNeedsUpdate())
  , DataTime(representation->GetPipelineDataTime())
{
  this->Skipped->SetClientData(this);
  this->Skipped->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
    static_cast<FailedUpdate*>(self)->Asked = false; // an animation has kept the data
  });
  representation->AddObserver(vtkPVDataRepresentation::SkippedUpdateDataEvent, this->Skipped);
}

FailedUpdate::~FailedUpdate()
{
  this->Representation->RemoveObserver(this->Skipped);
}

void FailedUpdate::end()
{
  if (this->Asked && this->Representation->GetPipelineDataTime() == this->DataTime)
  {
    this->Representation->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
}
}
