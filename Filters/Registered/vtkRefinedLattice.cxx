// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRefinedLattice.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Fields/BaseLattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkRefinedLattice);
brainshiftGuardRequestsMacro(vtkRefinedLattice);

vtkRefinedLattice::vtkRefinedLattice()
{
  this->SetNumberOfInputPorts(1);
}

void vtkRefinedLattice::AddControlPoint(double x, double y, double z)
{
  this->ControlPoints.insert(this->ControlPoints.end(), { x, y, z });
  this->Modified();
}

void vtkRefinedLattice::ClearControlPoints()
{
  this->Clear(this->ControlPoints);
}

int vtkRefinedLattice::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return this->AnnounceLattice(inputs, outputs);
}

int vtkRefinedLattice::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  updateWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkRefinedLattice::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Lattice lattice = this->MakeLattice(gridOf(vtkImageData::GetData(inputs[0])), nullptr);
  const glm::ivec3& sides = lattice.grid.dimensions;
  const std::size_t expected = 3 * lattice.displacements.size();
  if (!this->ControlPoints.empty() && this->ControlPoints.size() != expected)
  {
    throw Problem("ControlPoints has " + std::to_string(this->ControlPoints.size()) + " numbers; " +
      sizeText(sides) + " control points need " + std::to_string(expected));
  }
  for (std::size_t i = 0; i < this->ControlPoints.size(); i += 3)
  {
    lattice.displacements[i / 3] = { this->ControlPoints[i], this->ControlPoints[i + 1],
      this->ControlPoints[i + 2] };
  }
  requireDisplacements(lattice, "ControlPoints");
  vtkImageData* output = vtkImageData::GetData(outputs);
  lattice.kernel = AnyKernel;
  setLattice(output, lattice);
  output->Crop(
    outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  return 1;
}

void vtkRefinedLattice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ControlPoints: " << this->ControlPoints.size() / 3 << "\n";
}
