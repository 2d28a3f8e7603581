// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeRepresentation.h"

#include "Common/Guard.h"
#include "Representations/Picture/SelectionCover.h"
#include "Representations/Window/EdgeSmoothing.h"
#include "Representations/Window/MovingWindow.h"
#include "Representations/Window/SavedPicture.h"
#include "Representations/Window/VisibleTissue.h"
#include "vtkDeformedVolumeMapper.h"
#include "vtkVolumeOrder.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <cmath>

vtkStandardNewMacro(vtkDeformedVolumeRepresentation);

vtkDeformedVolumeRepresentation::vtkDeformedVolumeRepresentation()
  : Smoothing(std::make_unique<brainshift::EdgeSmoothing>())
  , Moving(std::make_unique<brainshift::MovingWindow>())
{
  this->VolumeMapper.TakeReference(vtkDeformedVolumeMapper::New());
}

vtkDeformedVolumeRepresentation::~vtkDeformedVolumeRepresentation() = default;

vtkDeformedVolumeMapper* vtkDeformedVolumeRepresentation::GetDeformedVolumeMapper() const
{
  return vtkDeformedVolumeMapper::SafeDownCast(this->VolumeMapper);
}

void vtkDeformedVolumeRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->Order->SetEnabled(visible);
  this->Smoothing->setEnabled(visible);
  this->Moving->setEnabled(visible);
}

void vtkDeformedVolumeRepresentation::SetSampleDistance(double distance)
{
  this->GetDeformedVolumeMapper()->SetSampleDistance(distance);
}

void vtkDeformedVolumeRepresentation::SetEmptySpaceSkipping(bool skipping)
{
  this->GetDeformedVolumeMapper()->SetEmptySpaceSkipping(skipping);
}

void vtkDeformedVolumeRepresentation::SetNormalTexture(int normals)
{
  this->GetDeformedVolumeMapper()->SetNormalTexture(normals);
}

void vtkDeformedVolumeRepresentation::SetCountSamples(bool count)
{
  this->GetDeformedVolumeMapper()->SetCountSamples(count);
}

void vtkDeformedVolumeRepresentation::SetKeepPicture(bool keep)
{
  this->GetDeformedVolumeMapper()->SetKeepPicture(keep);
}

void vtkDeformedVolumeRepresentation::SetDrawSegment(bool segment)
{
  this->GetDeformedVolumeMapper()->SetDrawSegment(segment);
}

void vtkDeformedVolumeRepresentation::SetShowEvidence(bool show)
{
  this->Superclass::SetShowEvidence(show);
  this->GetDeformedVolumeMapper()->SetShowEvidence(show);
}

bool vtkDeformedVolumeRepresentation::ComparesInColors() const
{
  vtkDeformedVolumeMapper* mapper = this->GetDeformedVolumeMapper();
  return mapper->GetComparison() == vtkDeformedVolumeMapper::TwoColors && this->CarriesComparison();
}

void vtkDeformedVolumeRepresentation::AddDrawnLabel(int label)
{
  this->GetDeformedVolumeMapper()->AddDrawnLabel(label);
}

void vtkDeformedVolumeRepresentation::ClearDrawnLabels()
{
  this->GetDeformedVolumeMapper()->ClearDrawnLabels();
}

void vtkDeformedVolumeRepresentation::SetAdaptiveQuality(bool adaptive)
{
  this->GetDeformedVolumeMapper()->SetAdaptiveQuality(adaptive);
}

void vtkDeformedVolumeRepresentation::SetMemoryLimit(double limit)
{
  this->GetDeformedVolumeMapper()->SetMemoryLimit(limit);
}

void vtkDeformedVolumeRepresentation::SetComparison(int comparison)
{
  if (comparison != this->GetDeformedVolumeMapper()->GetComparison())
  {
    this->MarkModified(); // MPI ranks may draw it in another way
  }
  this->GetDeformedVolumeMapper()->SetComparison(comparison);
}

void vtkDeformedVolumeRepresentation::SetComparisonColors(int colors)
{
  this->GetDeformedVolumeMapper()->SetComparisonColors(colors);
}

void vtkDeformedVolumeRepresentation::SetReferenceRange(double low, double high)
{
  this->GetDeformedVolumeMapper()->SetReferenceRange(low, high);
}

void vtkDeformedVolumeRepresentation::SetAgreementDistance(double distance)
{
  this->GetDeformedVolumeMapper()->SetAgreementDistance(distance);
}

void vtkDeformedVolumeRepresentation::SetAmbientOcclusion(double darkness)
{
  this->GetDeformedVolumeMapper()->SetAmbientOcclusion(darkness);
}

void vtkDeformedVolumeRepresentation::SetOcclusionRadius(double radius)
{
  this->GetDeformedVolumeMapper()->SetOcclusionRadius(radius);
}

void vtkDeformedVolumeRepresentation::AddGradientOpacity(double gradient, double factor)
{
  if (!std::isfinite(gradient) || !(factor >= 0.0 && factor <= 1.0))
  {
    vtkErrorMacro("Gradient Opacity: the pair "
      << gradient << " " << factor << " is left out; it needs a number and a factor of 0 to 1.");
    return;
  }
  this->GradientFactors->AddPoint(gradient, factor);
  this->Property->SetGradientOpacity(this->GradientFactors);
}

void vtkDeformedVolumeRepresentation::ClearGradientOpacity()
{
  this->GradientFactors->RemoveAllPoints();
  this->Property->SetGradientOpacity(nullptr);
}

void vtkDeformedVolumeRepresentation::SetGlobalIlluminationReach(float reach)
{
  this->GlobalIlluminationReach = reach;
}

void vtkDeformedVolumeRepresentation::SetVolumetricScatteringBlending(float blending)
{
  this->VolumetricScatteringBlending = blending;
}

void vtkDeformedVolumeRepresentation::SetRequestedRenderMode(int mode)
{
  this->RequestedRenderMode = mode;
}

void vtkDeformedVolumeRepresentation::TellOnce(bool unsupported, const std::string& sentence)
{
  if (unsupported && this->Told.insert(sentence).second)
  {
    brainshift::warn(this, sentence);
  }
}

// This is called for a picture. ParaView sets properties of Volume for Deformed Volume, too, even
// while only Volume is shown; so a warning waits until there is a picture.
void vtkDeformedVolumeRepresentation::UpdateMapperParameters()
{
  this->Superclass::UpdateMapperParameters();
  this->TellOnce(this->GlobalIlluminationReach > 0.0f,
    "GlobalIlluminationReach is above 0; Deformed Volume draws no shadows");
  this->TellOnce(this->VolumetricScatteringBlending > 0.0f,
    "VolumetricScatteringBlending is above 0; Deformed Volume draws no scattered light");
  this->TellOnce(
    this->UseTransfer2D && !this->UseGradientForTransfer2D && !this->ColorArray2Name.empty(),
    "UseGradientForTransfer2D is off; Deformed Volume looks a 2D transfer function up by scalar "
    "and "
    "gradient, not by a second array");
  this->TellOnce(this->RequestedRenderMode == vtkSmartVolumeMapper::RayCastRenderMode ||
      this->RequestedRenderMode == vtkSmartVolumeMapper::OSPRayRenderMode,
    "VolumeRenderingMode asks for software or OSPRay; Deformed Volume draws on the GPU");
}

// A selection of points compares with the depths of the last picture and adds none. ParaView's
// insets, the axes in the corners, clear some of them. So the depths of the tissue are drawn first.
void vtkDeformedVolumeRepresentation::PreparePicture(vtkObject* caller, unsigned long, void*)
{
  auto* renderer = static_cast<vtkRenderer*>(caller);
  this->GetDeformedVolumeMapper()->SetWaitsForDetail(brainshift::isToBeSaved(this->GetView()));
  if (brainshift::selectsPoints(renderer) && this->Actor->GetVisibility())
  {
    this->GetDeformedVolumeMapper()->CoverSelection(renderer);
  }
}

// Ranks blend what they drew from front to back, which is right for these two modes alone.
std::string vtkDeformedVolumeRepresentation::WhyWhole() const
{
  const int blend = this->VolumeMapper->GetBlendMode();
  const bool blends =
    blend == vtkVolumeMapper::COMPOSITE_BLEND || blend == vtkVolumeMapper::ISOSURFACE_BLEND;
  return blends ? "" : "its blend mode is neither Composite nor Isosurface";
}

std::string vtkDeformedVolumeRepresentation::WhyDataIsWhole() const
{
  return this->ComparesInColors() ? "two colours compare it with a reference" : "";
}

void vtkDeformedVolumeRepresentation::WidenByTissue(vtkImageData* volume, double bounds[6])
{
  this->GetDeformedVolumeMapper()->WidenByTissue(volume, bounds);
}

const brainshift::Lattice* vtkDeformedVolumeRepresentation::LatticeOf(vtkImageData* volume)
{
  return this->GetDeformedVolumeMapper()->GetLattice(volume);
}

void vtkDeformedVolumeRepresentation::CountVisible(
  vtkImageData* volume, brainshift::TissueCounts& counts)
{
  const brainshift::DrawnValues values = brainshift::drawnValuesOf(this->VolumeMapper, volume);
  if (values.scalars)
  {
    const brainshift::Lattice* lattice = this->GetDeformedVolumeMapper()->GetLattice(volume);
    brainshift::countVisible(values, this->Property, lattice, counts);
  }
}

void vtkDeformedVolumeRepresentation::SetDrawnPart(const brainshift::DrawnPart* part)
{
  this->GetDeformedVolumeMapper()->SetDrawnPart(part);
}

bool vtkDeformedVolumeRepresentation::AddToView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkRenderer* renderer = renderView->GetRenderer();
    renderer->AddCuller(this->Order);
    this->Smoothing->watch(renderer);
    this->Moving->watch(renderer);
    this->RenderStart = renderer->AddObserver(
      vtkCommand::StartEvent, this, &vtkDeformedVolumeRepresentation::PreparePicture);
  }
  return this->Superclass::AddToView(view);
}

bool vtkDeformedVolumeRepresentation::RemoveFromView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetRenderer()->RemoveCuller(this->Order);
    this->Smoothing->watch(nullptr);
    this->Moving->watch(nullptr);
    renderView->GetRenderer()->RemoveObserver(this->RenderStart);
  }
  return this->Superclass::RemoveFromView(view);
}

void vtkDeformedVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->VolumeMapper->PrintSelf(os, indent.GetNextIndent());
}
