// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformationLattice.h"

#include "Common/Guard.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Fields/BaseLattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkDeformationLattice);
brainshiftGuardRequestsMacro(vtkDeformationLattice);

int vtkDeformationLattice::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // How many control points there are comes with the data only.
  this->GetInputAlgorithm()->Update();
  vtkInformation* output = outputs->GetInformationObject(0);
  problemOf([&] { // reported when data is requested
    announce(output, readDeformation(vtkImageData::GetData(inputs[0])).lattice.grid);
    output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  });
  return 1;
}

int vtkDeformationLattice::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  updateWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkDeformationLattice::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  const Deformation deformation = readDeformation(input);
  const Lattice lattice = effectiveLattice(deformation);
  setLattice(output, lattice);
  attachDrawnWith(output, lattice, deformation.samples);
  output->Crop( // each process passes on its own part
    outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  output->GetFieldData()->AddArray(input->GetFieldData()->GetAbstractArray("FFDSamples"));
  return 1;
}
