// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeReport.h"

#include "Common/Guard.h"
#include "Representations/Field/TissueFacts.h"
#include "Representations/Gpu/GpuTask.h"
#include "vtkDeformedSlicesMapper.h"
#include "vtkDeformedSlicesRepresentation.h"
#include "vtkDeformedVolumeMapper.h"
#include "vtkDeformedVolumeRepresentation.h"

#include "vtkCamera.h"
#include "vtkCompositeRepresentation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVLODVolume.h"
#include "vtkPVRenderView.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkDeformedVolumeReport);

vtkDeformedVolumeReport::vtkDeformedVolumeReport() = default;
vtkDeformedVolumeReport::~vtkDeformedVolumeReport() = default;

void vtkDeformedVolumeReport::SetRepresentation(vtkPVDataRepresentation* representation)
{
  this->Representation = representation;
}

void vtkDeformedVolumeReport::SetView(vtkPVRenderView* view)
{
  this->View = view;
}

vtkPVDataRepresentation* vtkDeformedVolumeReport::ActiveRepresentation() const
{
  auto composite = vtkCompositeRepresentation::SafeDownCast(this->Representation);
  return composite ? composite->GetActiveRepresentation() : this->Representation.Get();
}

vtkDeformedVolumeMapper* vtkDeformedVolumeReport::Mapper() const
{
  auto deformed = vtkDeformedVolumeRepresentation::SafeDownCast(this->ActiveRepresentation());
  return deformed ? deformed->GetDeformedVolumeMapper() : nullptr;
}

vtkDeformedSlicesMapper* vtkDeformedVolumeReport::Slices() const
{
  auto slices = vtkDeformedSlicesRepresentation::SafeDownCast(this->ActiveRepresentation());
  return slices ? slices->GetDeformedSlicesMapper() : nullptr;
}

double* vtkDeformedVolumeReport::GetSliceNormals()
{
  std::fill_n(this->SliceNormals, 9, 0.0);
  if (vtkDeformedSlicesMapper* slices = this->Slices())
  {
    slices->GetNormals(this->SliceNormals);
  }
  return this->SliceNormals;
}

double* vtkDeformedVolumeReport::GetVoxelSteps()
{
  std::fill_n(this->VoxelSteps, 3, 0.0);
  if (vtkDeformedSlicesMapper* slices = this->Slices())
  {
    slices->GetVoxelSteps(this->VoxelSteps);
  }
  return this->VoxelSteps;
}

void vtkDeformedVolumeReport::SetPixel(int x, int y)
{
  this->Pixel[0] = x;
  this->Pixel[1] = y;
  this->Modified();
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  this->IsKnown = ranks && ranks->GetNumberOfProcesses() > 1;
  if (this->IsKnown)
  {
    this->FindFacts();
    this->TakeNearest();
  }
}

// A client asks the first rank alone for answers, so all ranks share what they found before.
void vtkDeformedVolumeReport::TakeNearest()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  const bool found = this->Tissue[3] != 0.0;
  const double own = found ? this->DistanceAhead() : VTK_DOUBLE_MAX;
  std::vector<double> all(ranks->GetNumberOfProcesses());
  ranks->AllGather(&own, all.data(), 1);
  const int nearest = static_cast<int>(std::min_element(all.begin(), all.end()) - all.begin());
  ranks->Broadcast(this->Tissue, 7, nearest);
  ranks->Broadcast(this->Facts, 19, nearest);
  vtkIdType length = static_cast<vtkIdType>(this->LabelName.size());
  ranks->Broadcast(&length, 1, nearest);
  this->LabelName.resize(length);
  ranks->Broadcast(this->LabelName.data(), length, nearest);
}

// mm, along the direction of view.
double vtkDeformedVolumeReport::DistanceAhead() const
{
  vtkCamera* camera = this->View->GetRenderer()->GetActiveCamera();
  double fromEye[3];
  vtkMath::Subtract(this->Tissue, camera->GetPosition(), fromEye);
  return vtkMath::Dot(fromEye, camera->GetDirectionOfProjection());
}

double* vtkDeformedVolumeReport::GetTissue()
{
  if (!this->IsKnown)
  {
    this->FindTissue();
  }
  return this->Tissue;
}

void vtkDeformedVolumeReport::FindTissue()
{
  std::fill_n(this->Tissue, 7, 0.0);
  if (!this->View)
  {
    return;
  }
  vtkRenderer* renderer = this->View->GetRenderer();
  vtkDeformedVolumeMapper* mapper = this->Mapper();
  vtkDeformedSlicesMapper* slices = this->Slices();
  const int* pixel = this->Pixel;
  const bool found = brainshift::guarded(this, false, [&] {
    return mapper
      ? mapper->Pick(renderer, pixel[0], pixel[1], this->Tissue)
      : slices && slices->Pick(renderer, pixel[0], pixel[1], this->Tissue, this->Tissue + 4);
  });
  this->Tissue[3] = found ? 1.0 : 0.0;
}

double* vtkDeformedVolumeReport::GetFacts()
{
  if (!this->IsKnown)
  {
    this->FindFacts();
  }
  return this->Facts;
}

void vtkDeformedVolumeReport::FindFacts()
{
  std::fill_n(this->Facts, 19, 0.0);
  this->LabelName.clear();
  auto whole = vtkWholeVolumeRepresentation::SafeDownCast(this->ActiveRepresentation());
  vtkDeformedVolumeMapper* mapper = this->Mapper();
  vtkDeformedSlicesMapper* slices = this->Slices();
  this->FindTissue();
  const double* tissue = this->Tissue;
  if (tissue[3] == 0.0 || !whole || !(mapper || slices))
  {
    return;
  }
  brainshift::guarded(this, [&] {
    vtkNew<vtkMatrix4x4> volumeFromWorld;
    vtkMatrix4x4::Invert(whole->GetActor()->GetMatrix(), volumeFromWorld);
    const double world[4] = { tissue[0], tissue[1], tissue[2], 1.0 };
    double place[4];
    volumeFromWorld->MultiplyPoint(world, place);
    brainshift::TissueFacts facts;
    vtkWindow* window = this->View->GetRenderWindow();
    mapper ? mapper->DescribeTissue(window, place, facts)
           : slices->DescribeTissue(window, place, facts);
    this->TakeFacts(facts);
    this->Facts[16] = this->DistanceAhead();
  });
}

void vtkDeformedVolumeReport::TakeFacts(const brainshift::TissueFacts& facts)
{
  double* next = this->Facts;
  *next++ = 1.0;
  next = std::copy_n(&facts.deformed[0], 3, next);
  next = std::copy_n(&facts.rest[0], 3, next);
  *next++ = facts.bent ? 1.0 : 0.0;
  *next++ = facts.volumeRatio;
  for (const auto& known : { facts.value, facts.reference, facts.label })
  {
    *next++ = known ? 1.0 : 0.0;
    *next++ = known.value_or(0.0);
  }
  *next = static_cast<double>(facts.axes);
  this->Facts[17] = facts.deviation ? 1.0 : 0.0;
  this->Facts[18] = facts.deviation.value_or(0.0);
  this->LabelName = facts.labelName;
}

double* vtkDeformedVolumeReport::GetSameTissue()
{
  std::copy_n(this->Place, 3, this->SameTissue);
  vtkDeformedVolumeMapper* mapper = this->Mapper();
  vtkDeformedSlicesMapper* slices = this->Slices();
  brainshift::guarded(this, [&] {
    if (mapper)
    {
      mapper->FindSameTissue(this->Place, this->ToRest, this->SameTissue);
    }
    else if (slices)
    {
      slices->FindSameTissue(this->Place, this->ToRest, this->SameTissue);
    }
  });
  return this->SameTissue;
}

int* vtkDeformedVolumeReport::GetDetail()
{
  vtkDeformedVolumeMapper* mapper = this->Mapper();
  vtkDeformedSlicesMapper* slices = this->Slices();
  const brainshift::Counters count = mapper ? mapper->CountDetail()
    : slices                                ? slices->CountDetail()
                                            : brainshift::Counters();
  this->Detail[0] = static_cast<int>(count.gpuLevel);
  this->Detail[1] = static_cast<int>(count.gpuBricks);
  this->Detail[2] = static_cast<int>(count.gpuBricksWanted);
  this->Detail[3] = count.gpuBricksLackRoom > 0 ? 1 : 0;
  this->Detail[4] = count.gpuBricksComing > 0 ? 1 : 0;
  this->Detail[5] = count.gpuBricksRead > 0 ? 1 : 0;
  this->Detail[6] = count.gpuNeedsPyramid > 0 ? 1 : 0;
  return this->Detail;
}

const char* vtkDeformedVolumeReport::GetCounters()
{
  vtkDeformedVolumeMapper* mapper = this->Mapper();
  vtkDeformedSlicesMapper* slices = this->Slices();
  auto whole = vtkWholeVolumeRepresentation::SafeDownCast(this->ActiveRepresentation());
  if (!whole || (!mapper && !slices))
  {
    return "";
  }
  const brainshift::Counters& count = mapper ? mapper->GetCounters() : slices->GetCounters();
  std::ostringstream text;
  text << "frames " << count.frames << "\npixelsCast " << count.pixelsCast << "\nvolumeUploads "
       << count.volumeUploads << "\nlatticeUploads " << count.latticeUploads << "\ntransferUploads "
       << count.transferUploads << "\nsegmentUploads " << count.segmentUploads
       << "\nevidenceUploads " << count.evidenceUploads << "\nbytesUploaded " << count.bytesUploaded
       << "\ntexelsRefined " << count.texelsRefined << "\npresenceUpdates " << count.presenceUpdates
       << "\nskippingBytes " << count.skippingBytes << "\ncorrectionBytes " << count.correctionBytes
       << "\nsamplesTaken " << count.samplesTaken << "\nsamplesSkipped " << count.samplesSkipped
       << "\nimageScale " << count.imageScale << "\nprogramsCompiled " << count.programsCompiled
       << "\ngpuScalarBytes " << count.gpuScalarBytes << "\ngpuOtherBytes " << count.gpuOtherBytes
       << "\ngpuVoxelsPerTexel " << count.gpuVoxelsPerTexel << "\ngpuNeedsPyramid "
       << count.gpuNeedsPyramid << "\ngpuLevel " << count.gpuLevel << "\ngpuBricks "
       << count.gpuBricks << "\ngpuBricksWanted " << count.gpuBricksWanted << "\ngpuBricksComing "
       << count.gpuBricksComing << "\ngpuBricksRead " << count.gpuBricksRead
       << "\ngpuBricksLackRoom " << count.gpuBricksLackRoom << "\ngpuFieldMicroseconds "
       << count.gpuFieldMicroseconds << "\nvoxelBytes " << whole->GetVoxelBytes();
  this->Counters = text.str();
  return this->Counters.c_str();
}

void vtkDeformedVolumeReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Pixel: " << this->Pixel[0] << " " << this->Pixel[1] << "\n"
     << indent << "Place: " << this->Place[0] << " " << this->Place[1] << " " << this->Place[2]
     << "\n"
     << indent << "ToRest: " << this->ToRest << "\n";
}
