// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/FieldImage.h"

#include "Common/WorldAxes.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cstring>

namespace brainshift
{
void forgetVolume(vtkDataObject* field)
{
  const WorldAxes axes = worldAxesOf(field);
  field->GetFieldData()->Initialize();
  nameWorldAxes(field, axes);
}

void setField(vtkImageData* image, const Grid& grid, const std::vector<glm::vec3>& displacements,
  Direction direction)
{
  const glm::dmat3 rows = glm::transpose(grid.direction);
  image->SetDimensions(grid.dimensions.x, grid.dimensions.y, grid.dimensions.z);
  image->SetOrigin(grid.origin.x, grid.origin.y, grid.origin.z);
  image->SetSpacing(grid.spacing.x, grid.spacing.y, grid.spacing.z);
  image->SetDirectionMatrix(&rows[0][0]);
  vtkNew<vtkFloatArray> array;
  array->SetName(DisplacementName);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(displacements.size()));
  std::memcpy(array->GetPointer(0), displacements.data(), displacements.size() * sizeof(glm::vec3));
  image->GetPointData()->SetVectors(array);
  forgetVolume(image);
  nameDirection(image, direction);
}

vtkDataArray* fieldOf(vtkImageData* image)
{
  const auto isField = [](vtkDataArray* array) {
    return array && array->GetNumberOfComponents() == 3;
  };
  vtkPointData* arrays = image->GetPointData();
  for (vtkDataArray* likely : { arrays->GetArray(DisplacementName), arrays->GetVectors() })
  {
    if (isField(likely))
    {
      return likely;
    }
  }
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    if (isField(arrays->GetArray(i)))
    {
      return arrays->GetArray(i);
    }
  }
  return nullptr;
}

bool saysField(vtkImageData* image)
{
  return directionOf(image) || image->GetPointData()->GetArray(DisplacementName);
}

bool isFieldImage(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  const bool areFloats = scalars && scalars->GetNumberOfComponents() == 3 &&
    (scalars->GetDataType() == VTK_FLOAT || scalars->GetDataType() == VTK_DOUBLE);
  const char* name = scalars ? scalars->GetName() : nullptr;
  const bool isOfVolume = name && std::strcmp(name, ScalarsOfVolumes) == 0;
  return saysField(image) || !scalars || (areFloats && !isOfVolume);
}

std::vector<glm::vec3> vectorsOf(vtkDataArray* array)
{
  std::vector<glm::vec3> vectors(array->GetNumberOfTuples());
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    double tuple[3];
    array->GetTuple(static_cast<vtkIdType>(i), tuple);
    vectors[i] = glm::vec3(tuple[0], tuple[1], tuple[2]);
  }
  return vectors;
}
}
