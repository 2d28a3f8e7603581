// SPDX-License-Identifier: BSD-3-Clause
#include "vtkInvertDisplacementField.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/Guard.h"
#include "Filters/Attached/Portions.h"
#include "Filters/Attached/WholeExtent.h"
#include "Filters/Deformation/Inversion.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Files/FieldImage.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace brainshift;

namespace
{
constexpr double LargestGoodErrorMm = 0.05;

// The field with its own points as nodes, counted in its cells.
NodeField nodesOf(const Grid& grid, const std::vector<glm::vec3>& displacements)
{
  NodeField field;
  field.nodes.count = grid.dimensions;
  field.values.resize(displacements.size());
  std::transform(displacements.begin(), displacements.end(), field.values.begin(),
    [&](const glm::vec3& mm) { return glm::vec3(grid.gridVectorFromWorld(glm::dvec3(mm))); });
  return field;
}

bool allFinite(const std::vector<glm::vec3>& vectors)
{
  return std::all_of(vectors.begin(), vectors.end(),
    [](const glm::vec3& v) { return std::isfinite(v.x + v.y + v.z); });
}

// Of all points; if they are no field, `problem` says why.
std::vector<glm::vec3> displacementsOf(vtkImageData* image, std::string& problem)
{
  vtkDataArray* array = fieldOf(image);
  if (!array)
  {
    problem = "The input has no point array of 3 components (mm)";
    return {};
  }
  std::vector<glm::vec3> displacements = vectorsOf(array);
  if (!allFinite(displacements))
  {
    problem = "The input's array of displacements holds a number that is not finite";
  }
  return displacements;
}
}

vtkStandardNewMacro(vtkInvertDisplacementField);
brainshiftGuardRequestsMacro(vtkInvertDisplacementField);

int vtkInvertDisplacementField::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // Each process passes on its own part.
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkInvertDisplacementField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // The inverse at a point may lie anywhere.
  updateWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkInvertDisplacementField::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  std::string problem = problemOfPart(input, inputs[0]->GetInformationObject(0));
  const std::vector<glm::vec3> displacements = displacementsOf(input, problem);
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem << ".");
    return 0;
  }
  const Grid grid = gridOf(input);
  const NodeField field = nodesOf(grid, displacements);
  std::vector<glm::vec3> inverse(displacements.size());
  std::vector<double> errors(grid.dimensions.z, 0.0); // of each slice, mm
  const auto invertSlices = [&](vtkIdType first, vtkIdType end) {
    Inversion<NodeField> inversion{ field };
    for (int k = static_cast<int>(first); k < end; ++k)
    {
      for (int j = 0; j < grid.dimensions.y; ++j)
      {
        for (int i = 0; i < grid.dimensions.x; ++i)
        {
          const glm::vec3 at(i, j, k);
          const glm::vec3 offset = inversion.inverseOffset(at, -field.displacement(at));
          const glm::dvec3 miss(offset + field.displacement(at + offset));
          errors[k] = std::max(errors[k], glm::length(grid.worldVectorFromGrid(miss)));
          inverse[grid.offset(i, j, k)] = glm::vec3(grid.worldVectorFromGrid(glm::dvec3(offset)));
        }
      }
    }
  };
  if (!forPortions(this, 0.0, 1.0, grid.dimensions.z, 1, invertSlices))
  {
    output->Initialize();
    return 1;
  }
  this->LargestError = *std::max_element(errors.begin(), errors.end());
  if (this->LargestError > LargestGoodErrorMm)
  {
    vtkWarningMacro(<< "The displacement field folds: the error of its inverse is up to "
                    << this->LargestError << " mm; the limit is " << LargestGoodErrorMm << " mm.");
  }
  // A field that does not say leads backward, as registration programs' do.
  const Direction was = directionOf(input).value_or(Direction::Backward);
  setField(
    output, grid, inverse, was == Direction::Backward ? Direction::Forward : Direction::Backward);
  output->SetExtent(input->GetExtent()); // its first point may have another index than 0 0 0
  output->SetOrigin(input->GetOrigin());
  output->Crop(
    outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  return 1;
}

void vtkInvertDisplacementField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LargestError: " << this->LargestError << "\n";
}
