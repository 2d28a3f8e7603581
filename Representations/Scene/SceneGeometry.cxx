// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneGeometry.h"

#include "Common/ImageGrid.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLCamera.h"
#include "vtkRenderer.h"

namespace brainshift
{
ValueLayout layoutOf(const glm::ivec3& points, bool cells)
{
  ValueLayout layout;
  layout.voxels = cells ? glm::max(points - 1, glm::ivec3(1)) : points;
  layout.dimensions = layout.voxels;
  layout.ofCells = cells;
  const glm::dvec3 values(layout.dimensions);
  layout.textureFromGrid = 1.0 / values;
  layout.textureOfGridZero = cells ? glm::dvec3(0.0) : 0.5 / values;
  layout.low = layout.textureOfGridZero;
  layout.high = glm::dvec3(points - 1) * layout.textureFromGrid + layout.textureOfGridZero;
  return layout;
}

ValueLayout coarser(const ValueLayout& layout, const glm::ivec3& perTexel)
{
  ValueLayout coarse = layout;
  coarse.perTexel = perTexel;
  coarse.dimensions = (layout.voxels + perTexel - 1) / perTexel;
  const glm::dvec3 smaller =
    glm::dvec3(layout.dimensions) / glm::dvec3(perTexel * coarse.dimensions);
  coarse.textureFromGrid = layout.textureFromGrid * smaller;
  coarse.textureOfGridZero = layout.textureOfGridZero * smaller;
  coarse.low = layout.low * smaller;
  coarse.high = layout.high * smaller;
  return coarse;
}

glm::dvec3 roundingOf(const ValueLayout& layout)
{
  constexpr double roundingVoxels = 1e-3;
  return roundingVoxels / glm::dvec3(layout.dimensions);
}

std::optional<long long> nearestValue(
  const ValueLayout& layout, const glm::dvec3& texture, const glm::dvec3& margin)
{
  if (glm::any(glm::lessThan(texture, layout.low - margin)) ||
    glm::any(glm::greaterThan(texture, layout.high + margin)))
  {
    return {};
  }
  const glm::ivec3& side = layout.dimensions;
  constexpr double rounding = 1e-6; // of a value
  const glm::dvec3 place = glm::floor(texture * glm::dvec3(side) + rounding);
  const glm::ivec3 value = glm::clamp(glm::ivec3(place), glm::ivec3(0), side - 1);
  return (static_cast<long long>(value.z) * side.y + value.y) * side.x + value.x;
}

DrawnValues drawnValuesOf(vtkAbstractVolumeMapper* mapper, vtkImageData* image)
{
  int cells = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(image, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cells);
  DrawnValues values;
  values.grid = gridOf(image);
  values.layout = layoutOf(values.grid.dimensions, cells != 0);
  const glm::ivec3& side = values.layout.dimensions;
  const vtkIdType count = static_cast<vtkIdType>(side.x) * side.y * side.z;
  values.scalars = scalars && scalars->GetNumberOfTuples() >= count ? scalars : nullptr;
  return values;
}

glm::dmat4 worldFromTexture(const Grid& grid, const ValueLayout& layout, vtkMatrix4x4* actor)
{
  glm::dmat4 worldFromVolume;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      worldFromVolume[column][row] = actor->GetElement(row, column);
    }
  }
  glm::dmat4 volumeFromTexture(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    volumeFromTexture[axis] =
      glm::dvec4(grid.direction[axis] * (grid.spacing[axis] / layout.textureFromGrid[axis]), 0.0);
  }
  const glm::dvec3 gridOfTextureZero = -layout.textureOfGridZero / layout.textureFromGrid;
  volumeFromTexture[3] = glm::dvec4(grid.worldFromGrid(gridOfTextureZero), 1.0);
  return worldFromVolume * volumeFromTexture;
}

glm::dmat4 clipFromWorld(vtkRenderer* renderer)
{
  glm::dmat4 matrix(1.0);
  vtkMatrix4x4* worldToView = nullptr;
  vtkMatrix3x3* normals = nullptr;
  vtkMatrix4x4* viewToClip = nullptr;
  vtkMatrix4x4* worldToClip = nullptr;
  auto camera = vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera());
  camera->GetKeyMatrices(renderer, worldToView, normals, viewToClip, worldToClip);
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      matrix[column][row] = worldToClip->GetElement(column, row); // VTK keeps it transposed
    }
  }
  return matrix;
}

glm::dvec3 textureFromWorld(const DrawnValues& values, const glm::dvec3& world)
{
  return values.grid.gridFromWorld(world) * values.layout.textureFromGrid +
    values.layout.textureOfGridZero;
}
}
