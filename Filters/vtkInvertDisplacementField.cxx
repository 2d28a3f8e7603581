// SPDX-License-Identifier: BSD-3-Clause
#include "vtkInvertDisplacementField.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Common/Portions.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/Inversion.h"
#include "Filters/Fields/BaseLattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <sstream>

using namespace brainshift;

namespace
{
constexpr double LargestGoodErrorMm = 0.05;
constexpr float LargestCells = 1e6f; // beyond it the solver's squares leave single precision

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

// Throws a Problem on what keeps a field on this grid from being inverted.
void requireField(const Grid& grid, vtkDataArray* array)
{
  constexpr double BytesPerPoint = 4.0 * sizeof(glm::vec3); // read, in cells, inverse, handed out
  if (!array)
  {
    throw Problem("The input has no point array of 3 components (mm)");
  }
  const auto points = static_cast<double>(grid.count());
  if (points == 0 || array->GetNumberOfTuples() != static_cast<vtkIdType>(grid.count()))
  {
    throw Problem("The input has " + sizeText(glm::dvec3(grid.dimensions)) + " points and " +
      std::to_string(array->GetNumberOfTuples()) +
      " displacements; it must have one for each, at least 1");
  }
  requirePosition(grid, "The input's ");
  requireHostMemory(
    "The inverse of a field of " + sizeText(glm::dvec3(grid.dimensions)) + " points",
    BytesPerPoint * points);
}

// Throws a Problem on displacements (lattice cells) that cannot be inverted.
void requireDisplacements(const std::vector<glm::vec3>& inCells)
{
  for (const glm::vec3& v : inCells)
  {
    const float longest = std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) });
    if (!std::isfinite(v.x + v.y + v.z))
    {
      throw Problem("The input's array of displacements holds a number that is not finite");
    }
    if (longest > LargestCells)
    {
      std::ostringstream problem;
      problem << "The input's array of displacements holds one of " << longest
              << " spacings of its grid; the limit is " << LargestCells;
      throw Problem(problem.str());
    }
  }
}

// The field of an image with its own points as nodes.
NodeField fieldToInvert(vtkImageData* image)
{
  const Grid grid = gridOf(image);
  vtkDataArray* array = fieldOf(image);
  requireField(grid, array);
  NodeField field = nodesOf(grid, displacementsOfTissue(image, array));
  requireDisplacements(field.values);
  return field;
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
  // If something upstream fails, RequestData is never called.
  this->LargestError = std::numeric_limits<double>::quiet_NaN();
  // The inverse at a point may lie anywhere.
  updateWholeExtent(inputs[0]->GetInformationObject(0));
  return 1;
}

int vtkInvertDisplacementField::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  requireWhole(input, inputs[0]->GetInformationObject(0));
  const NodeField field = fieldToInvert(input);
  const Grid grid = gridOf(input);
  std::vector<glm::vec3> inverse(grid.count());
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
  if (!forPortions({ this }, grid.dimensions.z, 1, invertSlices))
  {
    output->Initialize();
    return 1;
  }
  this->LargestError = *std::max_element(errors.begin(), errors.end());
  if (this->LargestError > LargestGoodErrorMm)
  {
    warn(this,
      "The displacement field folds: the error of its inverse is up to " +
        roundedText(this->LargestError) + " mm; the limit is " + numberText(LargestGoodErrorMm) +
        " mm");
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
