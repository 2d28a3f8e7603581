// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeRepresentation.h"

#include "Counters.h"
#include "vtkDeformedVolumeMapper.h"

#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <sstream>

vtkStandardNewMacro(vtkDeformedVolumeRepresentation);

vtkDeformedVolumeRepresentation::vtkDeformedVolumeRepresentation()
{
  this->VolumeMapper.TakeReference(vtkDeformedVolumeMapper::New());
}

vtkDeformedVolumeMapper* vtkDeformedVolumeRepresentation::Mapper() const
{
  return vtkDeformedVolumeMapper::SafeDownCast(this->VolumeMapper);
}

void vtkDeformedVolumeRepresentation::SetSampleDistance(double distance)
{
  this->Mapper()->SetSampleDistance(distance);
}

void vtkDeformedVolumeRepresentation::SetEmptySpaceSkipping(bool skipping)
{
  this->Mapper()->SetEmptySpaceSkipping(skipping);
}

void vtkDeformedVolumeRepresentation::SetNormalTexture(int normals)
{
  this->Mapper()->SetNormalTexture(normals);
}

void vtkDeformedVolumeRepresentation::SetAdaptiveQuality(bool adaptive)
{
  this->Mapper()->SetAdaptiveQuality(adaptive);
}

bool vtkDeformedVolumeRepresentation::AddToView(vtkView* view)
{
  if (auto renderView = vtkPVRenderView::SafeDownCast(view))
  {
    this->Renderer = renderView->GetRenderer();
  }
  return this->Superclass::AddToView(view);
}

void vtkDeformedVolumeRepresentation::SetPickedPixel(int x, int y)
{
  std::fill_n(this->PickedTissue, 4, 0.0);
  if (this->Renderer && this->Mapper()->Pick(this->Renderer, x, y, this->PickedTissue))
  {
    this->PickedTissue[3] = 1.0;
  }
}

const char* vtkDeformedVolumeRepresentation::GetCounters()
{
  const brainshift::Counters& count = this->Mapper()->GetCounters();
  std::ostringstream text;
  text << "frames " << count.frames << "\nvolumeUploads " << count.volumeUploads
       << "\nlatticeUploads " << count.latticeUploads << "\ntransferUploads "
       << count.transferUploads << "\nbytesUploaded " << count.bytesUploaded << "\ntexelsRefined "
       << count.texelsRefined << "\npresenceUpdates " << count.presenceUpdates << "\nimageScale "
       << count.imageScale << "\nprogramsCompiled " << count.programsCompiled << "\ngpuScalarBytes "
       << count.gpuScalarBytes << "\ngpuOtherBytes " << count.gpuOtherBytes
       << "\ngpuFieldMicroseconds " << count.gpuFieldMicroseconds;
  this->CountersText = text.str();
  return this->CountersText.c_str();
}

int vtkDeformedVolumeRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const int result = this->Superclass::RequestData(request, inputs, outputs);
  // Tissue may lie outside the volume's own box: the camera must not cut it.
  if (this->VolumeMapper->GetNumberOfInputConnections(0) > 0)
  {
    this->VolumeMapper->GetBounds(this->DataBounds);
  }
  return result;
}

void vtkDeformedVolumeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->VolumeMapper->PrintSelf(os, indent.GetNextIndent());
}
