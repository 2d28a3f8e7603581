// SPDX-License-Identifier: BSD-3-Clause
// What a user sets of the mapper, apart from its drawing.
#include "vtkDeformedVolumeMapper.h"

void vtkDeformedVolumeMapper::AddDrawnLabel(int label)
{
  this->DrawnLabels.push_back(label);
  this->Modified();
}

void vtkDeformedVolumeMapper::ClearDrawnLabels()
{
  this->DrawnLabels.clear();
  this->Modified();
}

void vtkDeformedVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleDistance: " << this->SampleDistance << "\n"
     << indent << "EmptySpaceSkipping: " << this->EmptySpaceSkipping << "\n"
     << indent << "AdaptiveQuality: " << this->AdaptiveQuality << "\n"
     << indent << "KeepPicture: " << this->KeepPicture << "\n"
     << indent << "CountSamples: " << this->CountSamples << "\n"
     << indent << "DrawSegment: " << this->DrawSegment << "\n"
     << indent << "DrawnLabels: " << this->DrawnLabels.size() << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n"
     << indent << "NormalTexture: " << this->NormalTexture << "\n"
     << indent << "Comparison: " << this->Comparison << "\n"
     << indent << "ReferenceRange: " << this->ReferenceRange[0] << " " << this->ReferenceRange[1]
     << "\n"
     << indent << "AgreementDistance: " << this->AgreementDistance << "\n";
}
