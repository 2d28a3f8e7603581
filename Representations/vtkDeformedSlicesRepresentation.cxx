// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Guard.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Slices/OrientationMarks.h"
#include "Representations/Window/RankParts.h"
#include "Representations/Window/SavedPicture.h"

#include "vtkCommand.h"
#include "vtkDeformedSlicesMapper.h"
#include "vtkDeformedSlicesRepresentation.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <functional>

class vtkVolumeMapper;

namespace brainshift
{
class SlicesProp : public vtkPVLODVolume
{
public:
  static SlicesProp* New();
  vtkTypeMacro(SlicesProp, vtkPVLODVolume);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;

  vtkVolumeMapper* Slices = nullptr;   ///< Draws them; the representation owns both.
  std::function<bool()> IsTranslucent; ///< Whether what lies behind may be seen through them.

private:
  bool Draws(bool translucent);
  int Draw(vtkViewport* viewport);
};

vtkStandardNewMacro(SlicesProp);

// What the letters need of the volume, as points, which ParaView delivers: the world axes, then the
// directions of the grid's axes.
constexpr int AxesPoints = 4;

vtkSmartPointer<vtkPoints> axesAsPoints(vtkImageData* image)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->InsertNextPoint(image ? static_cast<double>(worldAxesOf(image)) : 0.0, 0.0, 0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    double direction[3] = { axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0 };
    for (int row = 0; image && row < 3; ++row)
    {
      direction[row] = image->GetDirectionMatrix()->GetElement(row, axis);
    }
    points->InsertNextPoint(direction);
  }
  return points;
}

bool areEqual(vtkPoints* points, vtkPoints* others)
{
  for (vtkIdType i = 0; i < AxesPoints; ++i)
  {
    std::array<double, 3> one{};
    std::array<double, 3> other{};
    points->GetPoint(i, one.data());
    others->GetPoint(i, other.data());
    if (one != other)
    {
      return false;
    }
  }
  return true;
}

// Where the data is elsewhere, ParaView's outline stands for it.
bool SlicesProp::Draws(bool translucent)
{
  return !this->EnableLOD && this->Slices && this->Slices->GetNumberOfInputConnections(0) > 0 &&
    this->IsTranslucent() == translucent;
}

int SlicesProp::Draw(vtkViewport* viewport)
{
  this->Slices->Render(vtkRenderer::SafeDownCast(viewport), this);
  return 1;
}

int SlicesProp::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    return this->Draws(false) ? this->Draw(viewport)
                              : this->Superclass::RenderOpaqueGeometry(viewport);
  });
}

int SlicesProp::RenderVolumetricGeometry(vtkViewport* viewport)
{
  // The superclass would draw the mapper it has, which is the slices'.
  return guarded(this, 0, [&] {
    return this->EnableLOD ? this->Superclass::RenderVolumetricGeometry(viewport)
      : this->Draws(true)  ? this->Draw(viewport)
                           : 0;
  });
}
}

namespace
{
constexpr int AxesPort = 2; // of what is delivered; 0 is the volume, 1 its outline
}

vtkStandardNewMacro(vtkDeformedSlicesRepresentation);

vtkDeformedSlicesRepresentation::vtkDeformedSlicesRepresentation()
{
  vtkNew<vtkDeformedSlicesMapper> slices;
  this->VolumeMapper = slices;
  vtkNew<brainshift::SlicesProp> prop;
  prop->Slices = slices;
  prop->IsTranslucent = [mapper = slices.Get()] { return mapper->IsTranslucent(); };
  prop->SetProperty(this->Property);
  prop->SetLODMapper(this->OutlineMapper);
  this->Actor = prop;
  this->Marks = vtk::TakeSmartPointer(brainshift::OrientationMarks::New());
  this->Marks->SetVisibility(false);
  this->Marks->Volume = prop;
  this->AxesPiece->SetPoints(brainshift::axesAsPoints(nullptr));
}

// Whoever still holds the prop must not draw.
vtkDeformedSlicesRepresentation::~vtkDeformedSlicesRepresentation()
{
  static_cast<brainshift::SlicesProp*>(this->Actor.Get())->Slices = nullptr;
}

vtkDeformedSlicesMapper* vtkDeformedSlicesRepresentation::GetDeformedSlicesMapper() const
{
  return vtkDeformedSlicesMapper::SafeDownCast(this->VolumeMapper);
}

void vtkDeformedSlicesRepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetShowSagittal(bool show)
{
  this->GetDeformedSlicesMapper()->SetShowSagittal(show);
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetShowCoronal(bool show)
{
  this->GetDeformedSlicesMapper()->SetShowCoronal(show);
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetShowAxial(bool show)
{
  this->GetDeformedSlicesMapper()->SetShowAxial(show);
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetSlicePosition(double x, double y, double z)
{
  this->GetDeformedSlicesMapper()->SetSlicePosition(x, y, z);
}

void vtkDeformedSlicesRepresentation::SetCrosshair(bool show)
{
  this->GetDeformedSlicesMapper()->SetCrosshair(show);
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetShowEvidence(bool show)
{
  this->Superclass::SetShowEvidence(show);
  this->GetDeformedSlicesMapper()->SetShowEvidence(show);
}

bool vtkDeformedSlicesRepresentation::ComparesInColors() const
{
  using Mapper = vtkDeformedSlicesMapper;
  Mapper* slices = this->GetDeformedSlicesMapper();
  const int comparison = slices->GetComparison();
  return (comparison == Mapper::TwoColors || comparison == Mapper::Difference ||
           comparison == Mapper::Gradient) &&
    this->CarriesComparison();
}

void vtkDeformedSlicesRepresentation::SetSliceInterpolation(int interpolation)
{
  this->GetDeformedSlicesMapper()->SetInterpolation(interpolation);
}

void vtkDeformedSlicesRepresentation::SetMemoryLimit(double mebibytes)
{
  this->GetDeformedSlicesMapper()->SetMemoryLimit(mebibytes);
}

void vtkDeformedSlicesRepresentation::SetOpacity(double opacity)
{
  this->GetDeformedSlicesMapper()->SetOpacity(opacity);
}

void vtkDeformedSlicesRepresentation::SetMapOpacity(bool map)
{
  this->GetDeformedSlicesMapper()->SetMapOpacity(map);
}

void vtkDeformedSlicesRepresentation::SetComparison(int comparison)
{
  if (comparison != this->GetDeformedSlicesMapper()->GetComparison())
  {
    this->MarkModifiedOnRanks();
  }
  this->GetDeformedSlicesMapper()->SetComparison(comparison);
}

void vtkDeformedSlicesRepresentation::SetComparisonColors(int colors)
{
  this->GetDeformedSlicesMapper()->SetComparisonColors(colors);
}

void vtkDeformedSlicesRepresentation::SetCheckerSize(double size)
{
  this->GetDeformedSlicesMapper()->SetCheckerSize(size);
}

void vtkDeformedSlicesRepresentation::SetReferenceRange(double black, double white)
{
  this->GetDeformedSlicesMapper()->SetReferenceRange(black, white);
}

void vtkDeformedSlicesRepresentation::SetFullGradient(double fraction)
{
  this->GetDeformedSlicesMapper()->SetFullGradient(fraction);
}

void vtkDeformedSlicesRepresentation::SetSimilarityWindow(double mm)
{
  if (mm != this->GetDeformedSlicesMapper()->GetSimilarityWindow())
  {
    this->MarkModifiedOnRanks();
  }
  this->GetDeformedSlicesMapper()->SetSimilarityWindow(mm);
}

void vtkDeformedSlicesRepresentation::SetWipePosition(double x, double y, double z)
{
  this->GetDeformedSlicesMapper()->SetWipePosition(x, y, z);
}

void vtkDeformedSlicesRepresentation::SetOrientationMarks(bool marks)
{
  this->OrientationMarks = marks;
  this->ShowMarks();
}

void vtkDeformedSlicesRepresentation::SetWorldAxes(int axes)
{
  this->WorldAxes = axes;
  this->UpdateMarks();
}

void vtkDeformedSlicesRepresentation::ShowMarks()
{
  vtkDeformedSlicesMapper* slices = this->GetDeformedSlicesMapper();
  const bool named = slices->GetCrosshair();
  this->Marks->ShowLetters = this->OrientationMarks;
  this->Marks->NamedPlanes = { named && slices->GetShowSagittal(),
    named && slices->GetShowCoronal(), named && slices->GetShowAxial() };
  this->Marks->SetVisibility(this->GetVisibility() && (this->OrientationMarks || named));
}

void vtkDeformedSlicesRepresentation::UpdateMarks()
{
  this->Marks->Axes =
    static_cast<brainshift::WorldAxes>(this->WorldAxes ? this->WorldAxes : this->AttachedAxes);
}

void vtkDeformedSlicesRepresentation::DeliverAxes(
  vtkInformationRequestKey* request, vtkInformation* input)
{
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    const auto points = brainshift::axesAsPoints(vtkImageData::SafeDownCast(this->Cache));
    if (!brainshift::areEqual(points, this->AxesPiece->GetPoints())) // else it is not sent again
    {
      this->AxesPiece->SetPoints(points);
    }
    vtkPVRenderView::SetPiece(input, this, this->AxesPiece, 0, AxesPort);
    vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(input, this, true, false, AxesPort);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    auto piece = vtkPolyData::SafeDownCast(vtkPVView::GetDeliveredPiece(input, this, AxesPort));
    if (piece && piece->GetNumberOfPoints() >= brainshift::AxesPoints)
    {
      this->AttachedAxes = static_cast<int>(piece->GetPoint(0)[0]);
      for (int axis = 0; axis < 3; ++axis)
      {
        piece->GetPoint(1 + axis, this->Marks->GridAxes[axis].data());
      }
      this->UpdateMarks();
    }
  }
}

void vtkDeformedSlicesRepresentation::PreparePicture()
{
  this->GetDeformedSlicesMapper()->SetWaitsForDetail(brainshift::isToBeSaved(this->GetView()));
}

bool vtkDeformedSlicesRepresentation::AddToView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->AddViewProp(this->Marks);
    this->RenderStart = renderView->GetRenderer()->AddObserver(
      vtkCommand::StartEvent, this, &vtkDeformedSlicesRepresentation::PreparePicture);
  }
  return this->Superclass::AddToView(view);
}

bool vtkDeformedSlicesRepresentation::RemoveFromView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetNonCompositedRenderer()->RemoveViewProp(this->Marks);
    renderView->GetRenderer()->RemoveObserver(this->RenderStart);
  }
  return this->Superclass::RemoveFromView(view);
}

int vtkDeformedSlicesRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* input, vtkInformation* output)
{
  return brainshift::guarded(this, 0, [&] {
    const int result = this->Superclass::ProcessViewRequest(request, input, output);
    if (result)
    {
      this->DeliverAxes(request, input);
    }
    return result;
  });
}

void vtkDeformedSlicesRepresentation::WidenByTissue(vtkImageData* volume, double bounds[6])
{
  this->GetDeformedSlicesMapper()->WidenByTissue(volume, bounds);
}

const brainshift::Lattice* vtkDeformedSlicesRepresentation::LatticeOf(vtkImageData* volume)
{
  return this->GetDeformedSlicesMapper()->GetLattice(volume);
}

// A window of local similarity that is around a place of the part is in part beside it.
double vtkDeformedSlicesRepresentation::ReadsBesideMm(vtkImageData* volume) const
{
  vtkDeformedSlicesMapper* slices = this->GetDeformedSlicesMapper();
  const bool hasWindow = slices->GetComparison() == vtkDeformedSlicesMapper::LocalSimilarity &&
    brainshift::readReference(volume).voxels;
  return hasWindow ? 0.5 * slices->GetSimilarityWindow() : 0.0;
}

void vtkDeformedSlicesRepresentation::SetDrawnPart(const brainshift::DrawnPart* part)
{
  this->GetDeformedSlicesMapper()->SetDrawnPart(part);
}

void vtkDeformedSlicesRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "OrientationMarks: " << this->OrientationMarks << "\n";
  os << indent << "WorldAxes: " << this->WorldAxes << "\n";
  this->VolumeMapper->PrintSelf(os, indent.GetNextIndent());
}
