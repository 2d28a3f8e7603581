// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformationField.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageParts.h"
#include "Common/Portions.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/gtc/type_ptr.hpp>

#include <cmath>

using namespace brainshift;
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkDeformationField);
brainshiftGuardRequestsMacro(vtkDeformationField);

namespace
{
constexpr int SmallestSide = 2;
constexpr int LargestSide = 4096;

vtkSmartPointer<vtkFloatArray> addArray(vtkImageData* image, const char* name, int components)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(array);
  return array;
}

void place(vtkImageData* image, const Grid& samples, const int extent[6])
{
  const glm::dmat3 rows = glm::transpose(samples.direction);
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->SetOrigin(&samples.origin.x);
  image->SetSpacing(&samples.spacing.x);
  image->SetDirectionMatrix(&rows[0][0]);
}

// A map and its uncertainty.
struct Source
{
  DirectedMap map;
  Grid lattice;
  std::vector<float> deviations; // mm, at the control points; empty: unknown
};

Source sourceOf(vtkImageData* volume, Direction direction)
{
  Deformation deformation = readDeformation(volume);
  return { directedMapOf(volume, direction), deformation.lattice.grid,
    std::move(deformation.deviations) };
}

// The map's arrays, on an image that lies on `samples`. False if the user aborts.
bool fill(vtkAlgorithm* filter, vtkImageData* image, const Grid& samples, const DirectedMap& map)
{
  const auto displacements = addArray(image, DisplacementName, 3);
  const auto determinants = addArray(image, "JacobianDeterminant", 1);
  image->GetPointData()->SetActiveVectors(DisplacementName);
  image->GetPointData()->SetActiveScalars("JacobianDeterminant");
  const int* extent = image->GetExtent();
  const glm::ivec3 first(extent[0], extent[2], extent[4]);
  const glm::ivec3 count = glm::ivec3(extent[1], extent[3], extent[5]) - first + 1;
  const auto fillRows = [&](vtkIdType firstRow, vtkIdType endRow) {
    for (vtkIdType row = firstRow; row < endRow; ++row)
    {
      const glm::ivec3 start = first + glm::ivec3(0, row % count.y, row / count.y);
      for (int i = 0; i < count.x; ++i)
      {
        const glm::dvec3 from = samples.worldFromGrid(glm::dvec3(start + glm::ivec3(i, 0, 0)));
        const glm::dvec3 to = map.position(from);
        const glm::vec3 displacement(to - from);
        const vtkIdType point = row * count.x + i;
        displacements->SetTypedTuple(point, &displacement.x);
        determinants->SetValue(point, float(glm::determinant(map.jacobian(from, to))));
      }
    }
  };
  return forPortions({ filter }, static_cast<vtkIdType>(count.y) * count.z, 1, fillRows);
}

// The standard deviations (mm) of an image with displacements to or from tissue at rest. False if
// the user aborts.
bool fillDeviations(
  vtkAlgorithm* filter, vtkImageData* image, const Source& source, Direction direction)
{
  if (source.deviations.empty())
  {
    return true;
  }
  const auto deviations = addArray(image, DeviationName, 1);
  const auto displacements =
    vtkFloatArray::FastDownCast(image->GetPointData()->GetArray(DisplacementName));
  const auto fillPoints = [&](vtkIdType first, vtkIdType end) {
    for (vtkIdType point = first; point < end; ++point)
    {
      glm::dvec3 rest;
      image->GetPoint(point, &rest.x);
      if (direction == Direction::Backward)
      {
        rest += glm::make_vec3(displacements->GetPointer(3 * point));
      }
      deviations->SetValue(
        point, static_cast<float>(deviationAt(source.lattice, source.deviations, rest)));
    }
  };
  constexpr vtkIdType atLeast = 1024;
  return forPortions({ filter, 1.0, 1.0 }, image->GetNumberOfPoints(), atLeast, fillPoints);
}

// For the arrays.
void requireMemory(const int extent[6], bool hasDeviations)
{
  const double bytesPerPoint = (hasDeviations ? 5.0 : 4.0) * sizeof(float);
  const glm::dvec3 sides =
    glm::dvec3(extent[1], extent[3], extent[5]) - glm::dvec3(extent[0], extent[2], extent[4]) + 1.0;
  requireHostMemory(
    "A field of " + sizeText(sides) + " points", bytesPerPoint * sides.x * sides.y * sides.z);
}

// Points along an axis, no further apart than requested, within the box.
int pointsEvery(double spacing, double extent)
{
  constexpr double Rounding = 1e-9; // a spacing that divides the extent reaches its end
  return static_cast<int>(std::floor(extent / spacing + Rounding)) + 1;
}
}

Grid vtkDeformationField::SamplesOver(const Grid& volume) const
{
  Grid samples = volume;
  if (this->SampleGrid == GivenDimensions)
  {
    const glm::ivec3 sides(this->Dimensions[0], this->Dimensions[1], this->Dimensions[2]);
    samples = withDimensions(volume, glm::clamp(sides, SmallestSide, LargestSide));
    if (samples.dimensions != sides)
    {
      throw Problem("Dimensions is " + std::to_string(sides.x) + " x " + std::to_string(sides.y) +
        " x " + std::to_string(sides.z) + "; each must be from " + std::to_string(SmallestSide) +
        " to " + std::to_string(LargestSide));
    }
  }
  if (this->SampleGrid == GivenSpacing)
  {
    const glm::dvec3 spacing(this->Spacing[0], this->Spacing[1], this->Spacing[2]);
    const glm::dvec3 extent = volume.spacing * glm::dvec3(volume.dimensions - 1);
    const glm::dvec3 smallest = extent / double(LargestSide - 1);
    constexpr double Rounding = 1e-5; // a limit that is copied from the sentence holds
    if (!glm::all(glm::lessThanEqual(smallest * (1.0 - Rounding), spacing)) ||
      !glm::all(glm::lessThanEqual(spacing, extent * (1.0 + Rounding))))
    {
      throw Problem("Spacing is " + sizeText(spacing) + " mm; for this volume it must be from " +
        sizeText(smallest) + " to " + sizeText(extent) + " mm");
    }
    samples.spacing = glm::clamp(spacing, smallest, extent);
    for (int axis = 0; axis < 3; ++axis)
    {
      samples.dimensions[axis] = pointsEvery(samples.spacing[axis], extent[axis]);
    }
  }
  return samples;
}

int vtkDeformationField::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Grid samples = wholeGridOf(inputs[0]->GetInformationObject(0));
  problemOf([&] { samples = this->SamplesOver(samples); }); // reported once, when data is made
  vtkInformation* info = outputs->GetInformationObject(0);
  announce(info, samples);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1); // each process fills its own part
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 1);
  return 1;
}

int vtkDeformationField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // The lattice and the whole box come with any part. A small volume is mostly there as a whole.
  constexpr double smallMiB = 512.0;
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  if (isBestAskedWhole(input, smallMiB))
  {
    updateWholeExtent(input);
  }
  else
  {
    updateExtent(input, cornerOf(wholeExtentOf(input)));
  }
  return 1;
}

int vtkDeformationField::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  const auto direction = static_cast<brainshift::Direction>(this->Direction);
  const Source source = sourceOf(input, direction);
  const Grid samples = this->SamplesOver(wholeGridOf(input, inputs[0]->GetInformationObject(0)));
  int extent[6];
  outputs->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT(), extent);
  requireMemory(extent, !source.deviations.empty());
  place(output, samples, extent);
  forgetVolume(output);
  nameDirection(output, direction);
  if (!fill(this, output, samples, source.map) || !fillDeviations(this, output, source, direction))
  {
    output->Initialize();
  }
  return 1;
}

void vtkDeformationField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << (this->Direction == Forward ? "Forward" : "Backward") << "\n"
     << indent << "SampleGrid: " << this->SampleGrid << "\n"
     << indent << "Dimensions: " << this->Dimensions[0] << " " << this->Dimensions[1] << " "
     << this->Dimensions[2] << "\n"
     << indent << "Spacing: " << this->Spacing[0] << " " << this->Spacing[1] << " "
     << this->Spacing[2] << "\n";
}
