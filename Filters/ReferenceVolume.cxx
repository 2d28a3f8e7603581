// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceVolume.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace brainshift
{
namespace
{
constexpr const char* VoxelsName = "ReferenceVoxels";
constexpr const char* GridName = "ReferenceGrid";
constexpr int GridNumbers = 18;
}

vtkSmartPointer<vtkDataArray> asReferenceVoxels(vtkDataArray* scalars)
{
  auto voxels = vtk::TakeSmartPointer(scalars->NewInstance());
  voxels->ShallowCopy(scalars);
  voxels->SetName(VoxelsName);
  return voxels;
}

void attachReference(vtkDataObject* volume, const ReferenceVolume& reference)
{
  volume->GetFieldData()->AddArray(reference.voxels);
  const Grid& grid = reference.grid;
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName(GridName);
  numbers->SetNumberOfComponents(GridNumbers);
  numbers->SetNumberOfTuples(1);
  for (int i = 0; i < 3; ++i)
  {
    numbers->SetComponent(0, i, grid.dimensions[i]);
    numbers->SetComponent(0, 3 + i, grid.origin[i]);
    numbers->SetComponent(0, 6 + i, grid.spacing[i]);
    for (int column = 0; column < 3; ++column)
    {
      numbers->SetComponent(0, 9 + 3 * i + column, grid.direction[column][i]);
    }
  }
  volume->GetFieldData()->AddArray(numbers);
}

ReferenceVolume readReference(vtkDataObject* volume)
{
  ReferenceVolume reference;
  vtkDataArray* voxels = volume->GetFieldData()->GetArray(VoxelsName);
  vtkDataArray* numbers = volume->GetFieldData()->GetArray(GridName);
  if (!voxels || !numbers || numbers->GetNumberOfComponents() != GridNumbers ||
    numbers->GetNumberOfTuples() != 1)
  {
    return reference;
  }
  Grid& grid = reference.grid;
  for (int i = 0; i < 3; ++i)
  {
    grid.dimensions[i] = static_cast<int>(numbers->GetComponent(0, i));
    grid.origin[i] = numbers->GetComponent(0, 3 + i);
    grid.spacing[i] = numbers->GetComponent(0, 6 + i);
    for (int column = 0; column < 3; ++column)
    {
      grid.direction[column][i] = numbers->GetComponent(0, 9 + 3 * i + column);
    }
  }
  const bool fits = voxels->GetNumberOfTuples() == static_cast<vtkIdType>(grid.count());
  reference.voxels = fits ? voxels : nullptr;
  return reference;
}

Grid movedRigidly(const Grid& grid, const glm::dvec3& rotation, const glm::dvec3& translation)
{
  glm::dmat4 turn(1.0);
  for (int axis = 2; axis >= 0; --axis)
  {
    glm::dvec3 about(0.0);
    about[axis] = 1.0;
    turn = glm::rotate(turn, glm::radians(rotation[axis]), about);
  }
  const glm::dvec3 middle = grid.worldFromGrid(glm::dvec3(grid.dimensions - 1) * 0.5);
  Grid moved = grid;
  moved.direction = glm::dmat3(turn) * grid.direction;
  moved.origin = middle + glm::dmat3(turn) * (grid.origin - middle) + translation;
  return moved;
}
}
