// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformationLattice.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Files/FieldImage.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>

using namespace brainshift;
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkDeformationLattice);

int vtkDeformationLattice::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // How many control points there are comes with the data only.
  this->GetInputAlgorithm()->Update();
  Deformation deformation;
  std::string problem; // told when data is asked for
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  if (carriesDeformation(input) && readDeformation(input, deformation, problem))
  {
    announce(outputs->GetInformationObject(0), deformation.lattice.grid);
  }
  return 1;
}

int vtkDeformationLattice::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  int whole[6];
  info->Get(Pipeline::WHOLE_EXTENT(), whole);
  info->Set(Pipeline::UPDATE_EXTENT(), whole, 6);
  return 1;
}

int vtkDeformationLattice::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  Deformation deformation;
  std::string problem =
    "The volume carries no deformation; it must be the output of Free-Form Deformation";
  if (!carriesDeformation(input) || !readDeformation(input, deformation, problem))
  {
    vtkErrorMacro(<< problem << ".");
    return 0;
  }
  const Lattice lattice = effectiveLattice(deformation);
  setField(output, lattice.grid, lattice.displacements, Direction::Forward);
  for (const char* name : { "FFDKernel", "FFDSamples" })
  {
    output->GetFieldData()->AddArray(input->GetFieldData()->GetAbstractArray(name));
  }
  return 1;
}
