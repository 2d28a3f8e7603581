// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeVolumeRepresentation.h"

#include "Filters/Attached/Guard.h"
#include "Representations/Window/FailedUpdate.h"
#include "Representations/Window/GatheredVolume.h"
#include "Representations/Window/InteractiveDelivery.h"
#include "Representations/Window/LostServer.h"

#include "vtkCommunicator.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkOutlineSource.h"
#include "vtkPVLODVolume.h"
#include "vtkPVView.h"
#include "vtkVolumeMapper.h"

brainshiftGuardRequestsMacro(vtkWholeVolumeRepresentation);

vtkWholeVolumeRepresentation::vtkWholeVolumeRepresentation()
  : Gathered(std::make_unique<brainshift::GatheredVolume>())
{
}

vtkWholeVolumeRepresentation::~vtkWholeVolumeRepresentation() = default;

int vtkWholeVolumeRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  return brainshift::guarded(this, 0, [&] {
    // First the data of this process, then that of all. The superclass finds both done and only
    // hands the data to the view.
    brainshift::FailedUpdate failed(this, request);
    if (request == vtkPVView::REQUEST_UPDATE() &&
      // NOLINTNEXTLINE(bugprone-parent-virtual-call): without the delivery of the class between
      this->vtkVolumeRepresentation::ProcessViewRequest(request, input, output))
    {
      this->GatherParts();
    }
    failed.end();
    const int result = this->Superclass::ProcessViewRequest(request, input, output);
    if (result)
    {
      brainshift::deliverWithStandIns(this, request, input);
    }
    return result;
  });
}

int vtkWholeVolumeRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  this->Part = vtkImageData::SafeDownCast(this->Cache);
  this->IsNew = true;
  this->WidenBounds();
  return result;
}

// Tissue may lie outside the volume's own box: the camera must not cut it.
void vtkWholeVolumeRepresentation::WidenBounds()
{
  if (this->VolumeMapper->GetNumberOfInputConnections(0) > 0)
  {
    this->VolumeMapper->GetBounds(this->DataBounds);
  }
}

// Every rank comes here for every update, even if its pipeline has failed: the others wait for it.
void vtkWholeVolumeRepresentation::GatherParts()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (!ranks || ranks->GetNumberOfProcesses() == 1)
  {
    return;
  }
  const int isNew = this->IsNew;
  int isNewOnAny = 0;
  ranks->AllReduce(&isNew, &isNewOnAny, 1, vtkCommunicator::MAX_OP);
  if (!isNewOnAny)
  {
    return;
  }
  const vtkSmartPointer<vtkImageData> volume =
    this->Gathered->gather(ranks, this->Part, this->WholeExtent);
  this->IsNew = false;
  this->IsDrawnElsewhere = ranks->GetLocalProcessId() != 0;
  this->Cache = volume;
  this->VolumeMapper->SetInputData(volume);
  if (this->IsDrawnElsewhere)
  {
    vtkMath::UninitializeBounds(this->DataBounds);
    return;
  }
  this->DataSize = volume->GetActualMemorySize();
  this->OutlineSource->SetBounds(volume->GetBounds());
  this->OutlineSource->Update();
  this->WidenBounds();
}

bool vtkWholeVolumeRepresentation::AddToView(vtkView* view)
{
  brainshift::watchServer();
  return this->Superclass::AddToView(view);
}

void vtkWholeVolumeRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  if (this->IsDrawnElsewhere)
  {
    this->Actor->SetVisibility(false);
  }
}

void vtkWholeVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IsDrawnElsewhere: " << this->IsDrawnElsewhere << "\n";
}
