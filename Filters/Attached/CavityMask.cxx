// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/CavityMask.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace brainshift
{
PlacedVoxels CavitySource::find(vtkImageData* image, const std::vector<int>& labels,
  const Grid& volume, const std::string& volumeName, std::string& problem)
{
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return {};
  }
  if (!this->Voxels || this->Image != image || this->ImageTime != image->GetMTime() ||
    this->Labels != labels)
  {
    this->Voxels = nullptr;
    Mask mask;
    problem = readMask(image, labels, volume, mask, { "cavity", volumeName, "CavityLabels" });
    if (!problem.empty())
    {
      return {};
    }
    this->Voxels = asCavityVoxels(mask);
    this->VoxelsGrid = mask.grid;
    this->Image = image;
    this->ImageTime = image->GetMTime();
    this->Labels = labels;
  }
  return { this->Voxels, this->VoxelsGrid };
}

bool isRemoved(const PlacedVoxels& cavity, const glm::dvec3& position)
{
  if (!cavity.voxels)
  {
    return false;
  }
  const glm::dvec3 nearest = glm::round(cavity.grid.gridFromWorld(position));
  if (!glm::all(glm::greaterThanEqual(nearest, glm::dvec3(0.0))) ||
    !glm::all(glm::lessThan(nearest, glm::dvec3(cavity.grid.dimensions))))
  {
    return false;
  }
  const glm::ivec3 at(nearest);
  const auto index = static_cast<vtkIdType>(cavity.grid.offset(at.x, at.y, at.z));
  return cavity.voxels->GetComponent(index, 0) != 0.0;
}
}
