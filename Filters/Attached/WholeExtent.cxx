// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/WholeExtent.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace brainshift
{
void updateWholeExtent(vtkInformation* image)
{
  if (image)
  {
    int whole[6];
    image->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    image->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole, 6);
  }
}
}
