// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWholeVolumeRepresentation.h"

#include "Common/Guard.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Window/EvidenceLegend.h"
#include "Representations/Window/SharedVolume.h"
#include "Representations/Workarounds/ParaViewFaults.h"

#include "vtkCommunicator.h"
#include "vtkCompositeRepresentation.h"
#include "vtkCoordinate.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkOutlineSource.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPVView.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"
#include "vtkTracePointsRepresentation.h"
#include "vtkVolumeMapper.h"

#include <algorithm>
#include <cmath>

brainshiftGuardRequestsMacro(vtkWholeVolumeRepresentation);

namespace
{
constexpr int LegendFontSize = 14;
// From the left edge and from the lower one, fractions of the view. A slice's name and the letter
// of the upper edge are above.
constexpr double LegendInset = 0.015;
constexpr double LegendTop = 0.89;

constexpr brainshift::Extent NoExtent{ 0, -1, 0, -1, 0, -1 };

bool isTrueOnAny(bool here)
{
  const int own = here;
  int any = 0;
  vtkMultiProcessController::GetGlobalController()->AllReduce(
    &own, &any, 1, vtkCommunicator::MAX_OP);
  return any != 0;
}
}

vtkWholeVolumeRepresentation::vtkWholeVolumeRepresentation()
  : Shared(std::make_unique<brainshift::SharedVolume>())
  , Wanted(NoExtent)
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
    if (request == vtkPVView::REQUEST_UPDATE())
    {
      this->ChooseWhoDraws(vtkPVRenderView::SafeDownCast(input->Get(vtkPVView::VIEW())));
    }
    if (request == vtkPVView::REQUEST_UPDATE() &&
      // NOLINTNEXTLINE(bugprone-parent-virtual-call): without the delivery of the class between
      this->vtkVolumeRepresentation::ProcessViewRequest(request, input, output))
    {
      this->ShareOut();
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

void vtkWholeVolumeRepresentation::SetRankHalo(double halo)
{
  halo = std::isfinite(halo) ? std::max(halo, 0.0) : 0.0;
  if (halo != this->RankHalo)
  {
    this->RankHalo = halo;
    this->Wanted = NoExtent;
    this->MarkModified();
  }
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

// ParaView knows one box for each rank and view, so the boxes of two volumes would get mixed up.
// The actor's transform turns boxes.
bool vtkWholeVolumeRepresentation::IsAloneIn(vtkPVRenderView* view) const
{
  for (int i = 0; view && i < view->GetNumberOfRepresentations(); ++i)
  {
    vtkDataRepresentation* other = view->GetRepresentation(i);
    if (auto composite = vtkCompositeRepresentation::SafeDownCast(other))
    {
      other = composite->GetActiveRepresentation();
    }
    auto volume = vtkVolumeRepresentation::SafeDownCast(other);
    auto traces = vtkTracePointsRepresentation::SafeDownCast(other); // which tissue hides
    if ((volume && volume != this && volume->GetVisibility()) ||
      (traces && traces->GetVisibility()))
    {
      return false;
    }
  }
  return view && this->Actor->GetMatrix()->IsIdentity();
}

// A client comes here, too: it and the server agree on what changed, or the view keeps what it has.
void vtkWholeVolumeRepresentation::ChooseWhoDraws(vtkPVRenderView* view)
{
  const bool mayDrawPart = this->CanDrawParts() && this->IsAloneIn(view);
  if (mayDrawPart != this->MayDrawPart)
  {
    this->MayDrawPart = mayDrawPart;
    this->MarkModified();
  }
}

// Every rank comes here for every update, even if its pipeline has failed: the others wait for it.
void vtkWholeVolumeRepresentation::ShareOut()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (!ranks || ranks->GetNumberOfProcesses() == 1)
  {
    return;
  }
  if (!isTrueOnAny(this->IsNew))
  {
    return;
  }
  const bool drawsPart =
    !isTrueOnAny(!this->Part || !this->MayDrawPart || this->ComparesInColors());
  this->IsNew = false;
  if (!this->DrawsPart) // else the first rank would keep the whole volume
  {
    this->Wanted = NoExtent;
  }
  this->DrawsPart = drawsPart;
  brainshift::Extent all{};
  std::copy_n(this->WholeExtent, 6, all.begin());
  const brainshift::WholeVolume whole = this->Shared->wholeOf(ranks, this->Part, all);
  const bool isFirst = ranks->GetLocalProcessId() == 0;
  const brainshift::DrawnPart part = drawsPart ? this->OwnPart(whole) : brainshift::DrawnPart();
  if (!drawsPart)
  {
    this->Wanted = isFirst ? whole.extent : NoExtent;
  }
  const vtkSmartPointer<vtkImageData> volume =
    this->Shared->share(ranks, this->Part, whole, this->Wanted);
  this->IsDrawnElsewhere = !drawsPart && !isFirst;
  this->Cache = volume;
  this->VolumeMapper->SetInputData(volume);
  this->SetDrawnPart(drawsPart ? &part : nullptr);
  if (this->IsDrawnElsewhere)
  {
    vtkMath::UninitializeBounds(this->DataBounds);
    return;
  }
  this->DataSize = volume->GetActualMemorySize();
  this->OutlineSource->SetBounds(volume->GetBounds());
  this->OutlineSource->Update();
  this->WidenBounds(); // ParaView orders ranks by these
}

// This rank's part of the deformed frame. A rank that lacks voxels of it wants them, and those of
// the halo around it.
brainshift::DrawnPart vtkWholeVolumeRepresentation::OwnPart(const brainshift::WholeVolume& whole)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  const brainshift::Box bounds = this->WholeBounds(whole);
  const brainshift::Box part =
    brainshift::rankParts(bounds, ranks->GetNumberOfProcesses())[ranks->GetLocalProcessId()];
  const brainshift::Extent needed = this->RestExtent(whole, this->Part, part, 0.0);
  // What a large stroke asked for is given back after it was undone.
  const brainshift::Extent most = this->RestExtent(whole, this->Part, part, 2.0 * this->RankHalo);
  if (!brainshift::holds(this->Wanted, needed) || !brainshift::holds(most, this->Wanted))
  {
    this->Wanted = this->RestExtent(whole, this->Part, part, this->RankHalo);
  }
  return { part, brainshift::withoutOuterSides(part, bounds), whole.extent };
}

// Where tissue can be, the same on each rank.
brainshift::Box vtkWholeVolumeRepresentation::WholeBounds(const brainshift::WholeVolume& whole)
{
  brainshift::Box own{ 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world = whole.grid.worldFromGrid(side * glm::dvec3(whole.grid.dimensions - 1));
    for (int axis = 0; axis < 3; ++axis)
    {
      own[2 * axis] = std::min(own[2 * axis], world[axis]);
      own[2 * axis + 1] = std::max(own[2 * axis + 1], world[axis]);
    }
  }
  this->WidenByTissue(this->Part, own.data());
  for (int axis = 0; axis < 3; ++axis)
  {
    own[2 * axis] = -own[2 * axis];
  }
  brainshift::Box all = own;
  vtkMultiProcessController::GetGlobalController()->AllReduce(
    own.data(), all.data(), 6, vtkCommunicator::MAX_OP);
  for (int axis = 0; axis < 3; ++axis)
  {
    all[2 * axis] = -all[2 * axis];
  }
  return all;
}

std::array<int, 6> vtkWholeVolumeRepresentation::RestExtent(const brainshift::WholeVolume& whole,
  vtkImageData*, const std::array<double, 6>& part, double haloMm)
{
  return brainshift::restExtent(whole, nullptr, part, haloMm);
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
  os << indent << "DrawsPart: " << this->DrawsPart << "\n";
  os << indent << "RankHalo: " << this->RankHalo << "\n";
}
