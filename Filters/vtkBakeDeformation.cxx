// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBakeDeformation.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/LabelTable.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/Resample.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkBakeDeformation);
brainshiftGuardRequestsMacro(vtkBakeDeformation);

namespace
{
// Lattice coordinates of the values of an array: on the volume's points, or in its cells' middles.
ResampleGeometry geometryOf(const Grid& volume, const Grid& lattice, const int extent[6],
  const int inputExtent[6], bool cells)
{
  ResampleGeometry geometry;
  geometry.dimensions = cells ? volume.dimensions - 1 : volume.dimensions;
  const glm::dvec3 middle(cells ? 0.5 : 0.0);
  geometry.latticeFromIndex = volume.spacing / lattice.spacing;
  geometry.latticeOfFirst = lattice.gridFromWorld(volume.worldFromGrid(middle));
  for (int axis = 0; axis < 3; ++axis)
  {
    geometry.first[axis] = extent[2 * axis] - inputExtent[2 * axis];
    geometry.last[axis] = extent[2 * axis + 1] - inputExtent[2 * axis] - (cells ? 1 : 0);
  }
  return geometry;
}

// Bytes of the arrays that a bake of a volume makes, if it makes all of it.
double bytesOf(vtkDataSetAttributes* arrays)
{
  double bytes = 0.0;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = arrays->GetArray(i);
    bytes += array ? static_cast<double>(array->GetNumberOfValues()) * array->GetDataTypeSize() : 0;
  }
  return bytes;
}

// For the field, and for what is made with it.
void requireMemory(vtkImageData* input, const Lattice& lattice, int samples)
{
  requireOffsetFieldMemory(lattice, samples);
  const double arrays = bytesOf(input->GetPointData()) + bytesOf(input->GetCellData());
  const double bytes = arrays + offsetFieldBytes(lattice, samples);
  const glm::dvec3 sides(gridOf(input).dimensions);
  requireHostMemory("A bake of " + sizeText(sides) + " points", bytes);
}

// Resamples every numeric array of `from` into `to`.
void bakeArrays(vtkDataSetAttributes* from, vtkDataSetAttributes* to, const Resampling& how)
{
  to->Initialize();
  const glm::ivec3 size = glm::max(how.geometry.last - how.geometry.first + 1, glm::ivec3(0));
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* source = from->GetArray(i);
    if (!source)
    {
      continue; // names of something: nothing to interpolate
    }
    auto target = vtkSmartPointer<vtkDataArray>::Take(source->NewInstance());
    target->SetName(source->GetName());
    target->SetNumberOfComponents(source->GetNumberOfComponents());
    target->SetNumberOfTuples(static_cast<vtkIdType>(size.x) * size.y * size.z);
    resample(source, target, how);
    to->AddArray(target);
  }
  if (from->GetScalars())
  {
    to->SetActiveScalars(from->GetScalars()->GetName());
  }
}
}

int vtkBakeDeformation::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // Each process bakes its own part.
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkBakeDeformation::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Tissue may come from anywhere.
  updateWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkBakeDeformation::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  requireWhole(input, inputs[0]->GetInformationObject(0));
  const Deformation deformation = readDeformation(input);
  const Lattice lattice = effectiveLattice(deformation);
  requireMemory(input, lattice, deformation.samples);
  const BackwardMap backward(lattice, deformation.samples, deformation.inverse);

  int extent[6];
  outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  int inputExtent[6];
  input->GetExtent(inputExtent);
  output->CopyStructure(input);
  nameWorldAxes(output, worldAxesOf(input));
  attachLabels(output, attachedLabels(input));
  for (const char* name : { "Unit", "SmallIsBright" }) // of the values, for writers
  {
    output->GetFieldData()->AddArray(input->GetFieldData()->GetAbstractArray(name));
  }
  output->SetExtent(extent);
  const auto proceed = [this](double fraction) {
    this->UpdateProgress(fraction);
    return !this->CheckAbort();
  };
  const bool isOfLabels = isLabelMap(input);
  markLabelMap(output, isOfLabels);
  const auto reading = isOfLabels ? Reading::Nearest : static_cast<Reading>(this->Interpolation);
  const Grid volume = gridOf(input);
  bakeArrays(input->GetPointData(), output->GetPointData(),
    { geometryOf(volume, lattice.grid, extent, inputExtent, false), backward, reading, proceed });
  bakeArrays(input->GetCellData(), output->GetCellData(),
    { geometryOf(volume, lattice.grid, extent, inputExtent, true), backward, reading, proceed });
  SharedArrays().share(output->GetPointData());
  return 1;
}

void vtkBakeDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interpolation: " << this->Interpolation << "\n";
}
