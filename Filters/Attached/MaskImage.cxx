// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/MaskImage.h"

#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Parallel.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr vtkIdType VoxelsAtLeast = 65536; // for a thread

vtkDataArray* scalarArrayOf(vtkDataSetAttributes* attributes)
{
  vtkDataArray* array = attributes->GetScalars();
  for (int i = 0;
    (!array || array->GetNumberOfComponents() != 1) && i < attributes->GetNumberOfArrays(); ++i)
  {
    array = attributes->GetArray(i);
  }
  return array && array->GetNumberOfComponents() == 1 ? array : nullptr;
}

// World bounds of a grid, `beyond` points more to each side.
struct Bounds
{
  glm::dvec3 low{ 1e300 };
  glm::dvec3 high{ -1e300 };

  Bounds(const Grid& grid, double beyond)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
      const glm::dvec3 world = grid.worldFromGrid(
        glm::mix(glm::dvec3(-beyond), glm::dvec3(grid.dimensions - 1) + beyond, side));
      this->low = glm::min(this->low, world);
      this->high = glm::max(this->high, world);
    }
  }

  bool overlaps(const Bounds& other) const
  {
    return glm::all(glm::lessThanEqual(this->low, other.high)) &&
      glm::all(glm::lessThanEqual(other.low, this->high));
  }
};

std::ostream& operator<<(std::ostream& out, const Bounds& bounds)
{
  const char* const axes[] = { "x ", ", y ", ", z " };
  for (int axis = 0; axis < 3; ++axis)
  {
    out << axes[axis] << bounds.low[axis] << " to " << bounds.high[axis];
  }
  return out << " mm";
}

// What is wrong with a refined field's size; empty if nothing is.
std::string tooManyNodes(const Grid& lattice, int samples)
{
  const glm::ivec3& points = lattice.dimensions;
  const glm::dvec3 nodes((points - 1) * (samples + 1) + 1);
  const double count = nodes.x * nodes.y * nodes.z;
  if (count <= MostMaskedNodes)
  {
    return {};
  }
  std::ostringstream problem;
  problem << "With a mask the refined field may have at most " << MostMaskedNodes
          << " nodes; a lattice of " << points.x << " x " << points.y << " x " << points.z
          << " points and " << samples << " Samples make " << count;
  return problem.str();
}

// Why there is too little memory to grow a mask; empty if there is enough.
std::string growthProblem(const Mask& mask)
{
  const glm::dvec3 sides(mask.grid.dimensions);
  return hostMemoryProblem("Growing a mask of " + sizeText(sides) + " voxels",
    MaskGrowthBytes * sides.x * sides.y * sides.z);
}

std::string noVoxel(const std::vector<int>& labels, const MaskNames& names)
{
  std::ostringstream problem;
  problem << "The " << names.mask << " has no voxel ";
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    problem << (i ? " or " : "of label ") << labels[i];
  }
  problem << (labels.empty() ? "above 0" : " (" + names.labels + ")");
  return problem.str();
}
}

LabelImage labelsOf(vtkImageData* image)
{
  LabelImage found;
  found.grid = gridOf(image);
  found.labels = scalarArrayOf(image->GetPointData());
  if (!found.labels)
  {
    found.labels = scalarArrayOf(image->GetCellData());
    found.grid.origin = found.grid.worldFromGrid(glm::dvec3(0.5));
    found.grid.dimensions = glm::max(found.grid.dimensions - 1, glm::ivec3(1));
  }
  return found;
}

std::string problemOf(const LabelImage& image, const Grid& volume, const MaskNames& names)
{
  if (!image.labels)
  {
    return "The " + names.mask + " has no point or cell array of one component";
  }
  const Bounds bounds(image.grid, 0.5);
  const Bounds volumeBounds(volume, 0.0);
  if (!bounds.overlaps(volumeBounds))
  {
    std::ostringstream problem;
    problem << "The " << names.mask << " (" << bounds << ") does not overlap the " << names.volume
            << " (" << volumeBounds << ")";
    return problem.str();
  }
  return {};
}

std::vector<char> insideOf(vtkDataArray* array, const std::vector<int>& labels)
{
  std::vector<char> inside(array->GetNumberOfTuples());
  parallelFor(0, array->GetNumberOfTuples(), VoxelsAtLeast, [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType voxel = first; voxel < last; ++voxel)
    {
      const double value = array->GetComponent(voxel, 0);
      inside[voxel] = labels.empty()
        ? value > 0.0
        : std::find(labels.begin(), labels.end(), value) != labels.end();
    }
  });
  return inside;
}

std::string readMask(vtkImageData* image, const std::vector<int>& labels, const Grid& volume,
  Mask& mask, const MaskNames& names)
{
  const LabelImage found = labelsOf(image);
  const std::string problem = problemOf(found, volume, names);
  if (!problem.empty())
  {
    return problem;
  }
  mask.grid = found.grid;
  mask.inside = insideOf(found.labels, labels);
  return std::count(mask.inside.begin(), mask.inside.end(), 1) ? std::string()
                                                               : noVoxel(labels, names);
}

bool MaskSource::isKnown(const MaskRequest& request) const
{
  return this->Weights && this->Known.image == request.image &&
    this->KnownTime == request.image->GetMTime() && this->Known.labels == request.labels &&
    this->Known.growMm == request.growMm && this->Known.featherMm == request.featherMm &&
    this->Known.volume == request.volume && this->Known.lattice == request.lattice &&
    this->Known.samples == request.samples;
}

std::string MaskSource::find(
  const MaskRequest& request, std::shared_ptr<const NodeWeights>& weights)
{
  weights = nullptr;
  if (!request.image || request.image->GetNumberOfPoints() == 0)
  {
    return {};
  }
  if (!this->isKnown(request))
  {
    this->Weights = nullptr;
    Mask mask;
    std::string problem = tooManyNodes(request.lattice, request.samples);
    if (problem.empty())
    {
      problem = readMask(request.image, request.labels, request.volume, mask);
    }
    if (problem.empty() && request.growMm > 0.0)
    {
      problem = growthProblem(mask);
    }
    if (!problem.empty())
    {
      return problem;
    }
    growMask(mask, request.growMm);
    this->Weights = maskWeights(request.lattice, request.samples, mask, request.featherMm);
    this->Known = request;
    this->KnownTime = request.image->GetMTime();
  }
  weights = this->Weights;
  return {};
}
}
