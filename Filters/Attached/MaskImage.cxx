// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/MaskImage.h"

#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Parallel.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkCellData.h"
#include "vtkPointData.h"

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

void requireNodes(const Grid& lattice, int samples)
{
  const glm::ivec3& points = lattice.dimensions;
  const glm::dvec3 nodes((points - 1) * (samples + 1) + 1);
  const double count = nodes.x * nodes.y * nodes.z;
  if (count > MostMaskedNodes)
  {
    std::ostringstream problem;
    problem << "With a mask the refined field may have at most " << MostMaskedNodes
            << " nodes; a lattice of " << points.x << " x " << points.y << " x " << points.z
            << " points and " << samples << " Samples make " << count;
    throw Problem(problem.str());
  }
}

void requireMemoryToGrow(const Mask& mask)
{
  const glm::dvec3 sides(mask.grid.dimensions);
  requireHostMemory("Growing a mask of " + sizeText(sides) + " voxels",
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

void requireLabels(const LabelImage& image, const Grid& volume, const MaskNames& names)
{
  if (!image.labels)
  {
    throw Problem("The " + names.mask + " has no point or cell array of one component");
  }
  requirePosition(image.grid, "The " + names.mask + "'s ");
  const Bounds bounds(image.grid, 0.5);
  const Bounds volumeBounds(volume, 0.0);
  if (!bounds.overlaps(volumeBounds))
  {
    std::ostringstream problem;
    problem << "The " << names.mask << " (" << bounds << ") does not overlap the " << names.volume
            << " (" << volumeBounds << ")";
    throw Problem(problem.str());
  }
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

Mask readMask(
  vtkImageData* image, const std::vector<int>& labels, const Grid& volume, const MaskNames& names)
{
  const LabelImage found = labelsOf(image);
  requireLabels(found, volume, names);
  Mask mask{ found.grid, insideOf(found.labels, labels) };
  if (std::count(mask.inside.begin(), mask.inside.end(), 1) == 0)
  {
    throw Problem(noVoxel(labels, names));
  }
  return mask;
}

bool MaskSource::isKnown(const MaskRequest& request) const
{
  return this->Weights && this->Known.image == request.image &&
    this->KnownTime == request.image->GetMTime() && this->Known.labels == request.labels &&
    this->Known.growMm == request.growMm && this->Known.featherMm == request.featherMm &&
    this->Known.volume == request.volume && this->Known.lattice == request.lattice &&
    this->Known.samples == request.samples;
}

std::shared_ptr<const NodeWeights> MaskSource::find(const MaskRequest& request)
{
  if (!request.image || request.image->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  if (!this->isKnown(request))
  {
    this->Weights = nullptr;
    requireNodes(request.lattice, request.samples);
    Mask mask = readMask(request.image, request.labels, request.volume);
    if (request.growMm > 0.0)
    {
      requireMemoryToGrow(mask);
    }
    growMask(mask, request.growMm);
    this->Weights = maskWeights(request.lattice, request.samples, mask, request.featherMm);
    this->Known = request;
    this->KnownTime = request.image->GetMTime();
  }
  return this->Weights;
}

PlacedVoxels CavitySource::find(
  vtkImageData* image, const std::vector<int>& labels, const Grid& volume, const MaskNames& names)
{
  if (!image || image->GetNumberOfPoints() == 0)
  {
    return {};
  }
  if (!this->Voxels || this->Image != image || this->ImageTime != image->GetMTime() ||
    this->Labels != labels)
  {
    this->Voxels = nullptr;
    const Mask mask = readMask(image, labels, volume, names);
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
