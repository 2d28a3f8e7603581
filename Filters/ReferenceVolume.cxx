// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceVolume.h"

#include "GridArray.h"
#include "SharedArray.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace brainshift
{
namespace
{
constexpr const char* VoxelsName = "ReferenceVoxels";
constexpr const char* GridName = "ReferenceGrid";
}

vtkSmartPointer<vtkDataArray> asReferenceVoxels(vtkDataArray* scalars)
{
  return sharedAs(VoxelsName, scalars);
}

void attachReference(vtkDataObject* volume, const ReferenceVolume& reference)
{
  volume->GetFieldData()->AddArray(reference.voxels);
  attachGrid(volume->GetFieldData(), GridName, reference.grid);
}

ReferenceVolume readReference(vtkDataObject* volume)
{
  ReferenceVolume reference;
  vtkDataArray* voxels = volume->GetFieldData()->GetArray(VoxelsName);
  if (!voxels || !readGrid(volume->GetFieldData(), GridName, reference.grid))
  {
    return reference;
  }
  const bool fits = voxels->GetNumberOfTuples() == static_cast<vtkIdType>(reference.grid.count());
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
