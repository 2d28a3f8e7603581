// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A source that delivers the part of an image that it is asked for and no more, and keeps record.
#ifndef BrainShift_PartSource_h
#define BrainShift_PartSource_h

#include "Common/ImageParts.h"

#include <vtkFieldData.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMatrix3x3.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <vector>

namespace brainshift::testing
{
class PartSource : public vtkImageAlgorithm
{
public:
  static PartSource* New();
  vtkTypeMacro(PartSource, vtkImageAlgorithm);

  vtkSmartPointer<vtkImageData> Whole;
  std::vector<Extent> Delivered;
  int FailsAt = -1; // the number of a request that gets nothing

  // The largest fraction of the points that was delivered at once.
  double largestFraction() const
  {
    double most = 0.0;
    for (const Extent& extent : this->Delivered)
    {
      most = std::max(most, pointsIn(extent));
    }
    return most / pointsIn(extentOf(this->Whole));
  }

protected:
  PartSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extentOf(this->Whole).data(), 6);
    info->Set(vtkDataObject::ORIGIN(), this->Whole->GetOrigin(), 3);
    info->Set(vtkDataObject::SPACING(), this->Whole->GetSpacing(), 3);
    info->Set(vtkDataObject::DIRECTION(), this->Whole->GetDirectionMatrix()->GetData(), 9);
    info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const Extent asked = updateExtentOf(outputs->GetInformationObject(0));
    this->Delivered.push_back(asked);
    if (static_cast<int>(this->Delivered.size()) - 1 == this->FailsAt)
    {
      return 0;
    }
    vtkImageData* output = vtkImageData::GetData(outputs);
    output->ShallowCopy(this->Whole);
    output->Crop(asked.data());
    return 1;
  }
};

inline vtkStandardNewMacro(PartSource);
}

#endif
