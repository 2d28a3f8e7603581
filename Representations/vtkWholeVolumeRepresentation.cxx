// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeVolumeRepresentation.h"

#include "Common/Guard.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Window/EvidenceLegend.h"
#include "Representations/Window/GatheredVolume.h"
#include "Representations/Workarounds/ParaViewFaults.h"

#include "vtkCommunicator.h"
#include "vtkCoordinate.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkOutlineSource.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPVView.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"
#include "vtkVolumeMapper.h"

brainshiftGuardRequestsMacro(vtkWholeVolumeRepresentation);

namespace
{
constexpr int LegendFontSize = 14;
// From the left edge and from the lower one, fractions of the view. A slice's name and the letter
// of the upper edge are above.
constexpr double LegendInset = 0.015;
constexpr double LegendTop = 0.89;
}

vtkWholeVolumeRepresentation::vtkWholeVolumeRepresentation()
  : Gathered(std::make_unique<brainshift::GatheredVolume>())
{
  this->Legend->PickableOff();
  this->Legend->UseBoundsOff();
  this->Legend->VisibilityOff();
  this->Legend->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Legend->SetPosition(LegendInset, LegendTop);
  vtkTextProperty* text = this->Legend->GetTextProperty();
  text->SetFontSize(LegendFontSize);
  text->SetBold(true);
  text->SetShadow(true); // the background may be bright
  text->SetVerticalJustification(VTK_TEXT_TOP);
  this->Evidence = vtk::TakeSmartPointer(brainshift::EvidenceLegend::New());
  this->Evidence->VisibilityOff();
  this->Evidence->Ask = [this] {
    using Shown = brainshift::EvidenceLegend::Shown;
    vtkDataSet* drawn = this->VolumeMapper->GetDataSetInput(); // null where a server draws
    return drawn && !brainshift::carriesDeviations(drawn) ? Shown::Nothing
      : this->ComparesInColors()                          ? Shown::Stripes
                                                          : Shown::Tints;
  };
}

// Another owner of the legend must not call this object.
vtkWholeVolumeRepresentation::~vtkWholeVolumeRepresentation()
{
  this->Evidence->Ask = nullptr;
}

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

// Tissue may be outside the volume's own box: the camera must not cut it.
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

void vtkWholeVolumeRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  const char* text = this->Legend->GetInput();
  this->Legend->SetVisibility(visible && text && *text);
  this->Evidence->SetVisibility(visible && this->ShowEvidence);
}

void vtkWholeVolumeRepresentation::SetShowEvidence(bool show)
{
  this->ShowEvidence = show;
  this->Evidence->SetVisibility(this->GetVisibility() && show);
}

void vtkWholeVolumeRepresentation::SetLegend(const char* text)
{
  this->Legend->SetInput(text ? text : "");
  this->Legend->SetVisibility(this->GetVisibility() && text && *text);
}

bool vtkWholeVolumeRepresentation::CarriesComparison() const
{
  vtkDataSet* drawn = this->VolumeMapper->GetDataSetInput();
  const brainshift::ReferenceVolume reference =
    drawn ? brainshift::readReference(drawn) : brainshift::ReferenceVolume();
  return reference.voxels && reference.show == brainshift::ReferenceShow::Both;
}

bool vtkWholeVolumeRepresentation::AddToView(vtkView* view)
{
  brainshift::watchServer();
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->AddViewProp(this->Legend);
    renderView->GetNonCompositedRenderer()->AddViewProp(this->Evidence);
  }
  return this->Superclass::AddToView(view);
}

bool vtkWholeVolumeRepresentation::RemoveFromView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->RemoveViewProp(this->Legend);
    renderView->GetNonCompositedRenderer()->RemoveViewProp(this->Evidence);
  }
  return this->Superclass::RemoveFromView(view);
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
  const char* legend = this->Legend->GetInput();
  os << indent << "Legend: " << (legend ? legend : "") << "\n";
  os << indent << "ShowEvidence: " << this->ShowEvidence << "\n";
  os << indent << "IsDrawnElsewhere: " << this->IsDrawnElsewhere << "\n";
}
