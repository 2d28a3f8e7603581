// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompareVolumes.h"

#include "DeformableVolume.h"
#include "ReferenceVolume.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/vec3.hpp>

using namespace brainshift;

vtkStandardNewMacro(vtkCompareVolumes);

vtkCompareVolumes::vtkCompareVolumes()
{
  this->SetNumberOfInputPorts(2);
}

void vtkCompareVolumes::SetReferenceConnection(vtkAlgorithmOutput* reference)
{
  this->SetInputConnection(1, reference);
}

int vtkCompareVolumes::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkCompareVolumes::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    int whole[6];
    info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole, 6);
  }
  return 1;
}

int vtkCompareVolumes::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(vtkImageData::GetData(inputs[0]));
  vtkImageData* image = vtkImageData::GetData(inputs[1]);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars = scalars ? scalars : image->GetPointData()->GetArray(0);
  if (!scalars || scalars->GetNumberOfComponents() != 1)
  {
    vtkErrorMacro("The reference's point scalars have "
      << (scalars ? scalars->GetNumberOfComponents() : 0) << " components; they must have 1.");
    return 0;
  }
  if (this->Scalars != scalars || this->ScalarsTime != scalars->GetMTime())
  {
    this->Voxels = asReferenceVoxels(scalars);
    this->Scalars = scalars;
    this->ScalarsTime = scalars->GetMTime();
  }
  const double* r = this->ReferenceRotation;
  const double* t = this->ReferenceTranslation;
  attachReference(output,
    { this->Voxels, movedRigidly(gridOf(image), { r[0], r[1], r[2] }, { t[0], t[1], t[2] }) });
  return 1;
}

void vtkCompareVolumes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* r = this->ReferenceRotation;
  const double* t = this->ReferenceTranslation;
  os << indent << "ReferenceRotation: " << r[0] << " " << r[1] << " " << r[2] << "\n"
     << indent << "ReferenceTranslation: " << t[0] << " " << t[1] << " " << t[2] << "\n";
}
