// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/PlacedVolume.h"

#include "Common/HostMemory.h"
#include "Common/Parallel.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <array>
#include <sstream>
#include <utility>

namespace brainshift
{
namespace
{
// Fills `shown`, whose extent may be a part of the whole, from the voxels as the file orders them.
template <typename StoredType, typename ShownType, typename Convert>
void moveVoxels(vtkImageData* stored, vtkImageData* shown, const RasGrid& geometry,
  int firstComponent, const Convert& convert)
{
  const std::array<int, 3> dimensions{ geometry.grid.dimensions.x, geometry.grid.dimensions.y,
    geometry.grid.dimensions.z };
  vtkIdType increments[3];
  stored->GetIncrements(increments);
  std::array<vtkIdType, 3> step;
  const StoredType* first = static_cast<StoredType*>(stored->GetScalarPointer()) + firstComponent;
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType forward = increments[geometry.voxelAxis[axis]];
    step[axis] = geometry.reversed[axis] ? -forward : forward;
    first += geometry.reversed[axis] ? forward * (dimensions[axis] - 1) : 0;
  }
  int extent[6];
  shown->GetExtent(extent);
  const int components = shown->GetNumberOfScalarComponents();
  parallelFor(extent[4], extent[5] + 1, 1, [&](vtkIdType zBegin, vtkIdType zEnd) {
    for (int z = static_cast<int>(zBegin); z < zEnd; ++z)
    {
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        auto* to = static_cast<ShownType*>(shown->GetScalarPointer(extent[0], y, z));
        const StoredType* from = first + extent[0] * step[0] + y * step[1] + z * step[2];
        for (int x = extent[0]; x <= extent[1]; ++x, from += step[0])
        {
          for (int component = 0; component < components; ++component)
          {
            *to++ = convert(from[component]);
          }
        }
      }
    }
  });
}

template <typename T>
void moveVoxelsOf(vtkImageData* stored, vtkImageData* shown, const RasGrid& geometry,
  int firstComponent, const Rescaling& rescaling)
{
  if (!rescaling.isNeeded())
  {
    moveVoxels<T, T>(stored, shown, geometry, firstComponent, [](T value) { return value; });
    return;
  }
  moveVoxels<T, float>(stored, shown, geometry, firstComponent, [&rescaling](T value) {
    return static_cast<float>(rescaling.slope * static_cast<double>(value) + rescaling.intercept);
  });
}

}

PlacedVolume::PlacedVolume(std::unique_ptr<VolumeFile> file)
  : File(std::move(file))
{
}

std::string PlacedVolume::sentence(const std::string& end) const
{
  return this->File->noun() + " " + this->FileName + " " + end;
}

std::string PlacedVolume::readHeader(const std::string& fileName)
{
  this->Placed = false;
  this->FileName = fileName;
  if (fileName.empty())
  {
    return "FileName is empty; it must name a " + this->File->noun();
  }
  this->Header = VolumeHeader();
  std::string problem = this->File->readHeader(fileName, this->Header);
  if (!problem.empty())
  {
    return this->sentence(problem);
  }
  problem = affineProblem(this->Header.worldFromVoxel);
  if (!problem.empty())
  {
    return this->sentence("cannot be placed: " + problem);
  }
  this->Geometry = nearestRasGrid(this->Header.worldFromVoxel, this->Header.dimensions);
  this->Placed = true;
  return {};
}

std::vector<std::string> PlacedVolume::warnings() const
{
  std::vector<std::string> sentences;
  sentences.reserve(this->Header.warnings.size() + 1);
  for (const std::string& warning : this->Header.warnings)
  {
    sentences.push_back(this->sentence(warning));
  }
  const std::string shear = this->shearWarning();
  if (!shear.empty())
  {
    sentences.push_back(shear);
  }
  return sentences;
}

std::string PlacedVolume::shearWarning() const
{
  if (!(this->Geometry.shear > LargestUnreportedShear))
  {
    return {};
  }
  std::ostringstream warning;
  warning << "is sheared: the cosine between two of its axes is " << this->Geometry.shear
          << "; the limit is " << LargestUnreportedShear << ". Its corners are shown up to "
          << this->Geometry.largestErrorMm << " mm from where it places them";
  return this->sentence(warning.str());
}

int PlacedVolume::scalarType() const
{
  return this->Header.rescaling.isNeeded() ? VTK_FLOAT : this->Header.storedType;
}

std::string PlacedVolume::memoryProblem(const int extent[6]) const
{
  const glm::ivec3& size = this->Geometry.grid.dimensions;
  double shown = static_cast<double>(this->Header.components) *
    vtkDataArray::GetDataTypeSize(this->scalarType());
  for (int axis = 0; axis < 3; ++axis)
  {
    shown *= extent[2 * axis + 1] - extent[2 * axis] + 1.0;
  }
  return hostMemoryProblem(std::to_string(this->Header.times.size()) + " volumes of " +
      sizeText(glm::dvec3(size)) + " voxels",
    this->File->storedBytes(this->Header) + shown);
}

std::string PlacedVolume::read(
  std::size_t volume, const int extent[6], const Progress& progress, vtkImageData* image)
{
  std::string problem = this->memoryProblem(extent);
  StoredVoxels stored;
  problem = problem.empty() ? this->File->load(volume, progress, stored) : problem;
  if (!problem.empty())
  {
    return this->sentence("cannot be read: " + problem);
  }
  if (!stored.image)
  {
    return {};
  }
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  image->AllocateScalars(this->scalarType(), this->Header.components);
  switch (stored.image->GetScalarType())
  {
    vtkTemplateMacro(moveVoxelsOf<VTK_TT>(
      stored.image, image, this->Geometry, stored.firstComponent, this->Header.rescaling));
  }
  return {};
}
}
