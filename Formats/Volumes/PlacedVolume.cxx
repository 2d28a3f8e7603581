// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/PlacedVolume.h"

#include "Common/HostMemory.h"
#include "Common/Parallel.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace brainshift
{
namespace
{
constexpr const char* OtherVolume =
  "copy it again, or convert it to .nii.gz or .nrrd in a program that opens it";

// Between two reports of progress: about a tenth of a second.
constexpr vtkIdType NumbersAtOnce = 16000000;

// Fills `shown`, whose extent may be a part of the whole, from the voxels as the file orders them.
// False: `progress` said stop.
template <typename StoredType, typename ShownType, typename Convert>
bool moveVoxels(const StoredVoxels& voxels, vtkImageData* shown, const RasGrid& geometry,
  const Convert& convert, const Progress& progress)
{
  vtkImageData* stored = voxels.image;
  const std::array<int, 3> dimensions{ geometry.grid.dimensions.x, geometry.grid.dimensions.y,
    geometry.grid.dimensions.z };
  vtkIdType increments[3];
  stored->GetIncrements(increments);
  std::array<vtkIdType, 3> step;
  int storedExtent[6];
  stored->GetExtent(storedExtent);
  const auto* const numbers = static_cast<StoredType*>(stored->GetScalarPointer());
  vtkIdType first = voxels.firstComponent; // of the voxel 0, 0, 0 of the grid; it need not be there
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType forward = increments[geometry.voxelAxis[axis]];
    step[axis] = geometry.reversed[axis] ? -forward : forward;
    first += geometry.reversed[axis] ? forward * (dimensions[axis] - 1) : 0;
    first -= increments[axis] * storedExtent[2 * axis];
  }
  int extent[6];
  shown->GetExtent(extent);
  const int components = shown->GetNumberOfScalarComponents();
  const auto moveSlices = [&](vtkIdType zBegin, vtkIdType zEnd) {
    for (int z = static_cast<int>(zBegin); z < zEnd; ++z)
    {
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        auto* to = static_cast<ShownType*>(shown->GetScalarPointer(extent[0], y, z));
        const StoredType* from =
          numbers + (first + extent[0] * step[0] + y * step[1] + z * step[2]);
        for (int x = extent[0]; x <= extent[1]; ++x, from += step[0])
        {
          for (int component = 0; component < components; ++component)
          {
            *to++ = convert(from[component]);
          }
        }
      }
    }
  };
  const vtkIdType ofSlice = std::max<vtkIdType>(
    components * vtkIdType{ extent[1] - extent[0] + 1 } * (extent[3] - extent[2] + 1), 1);
  const vtkIdType atOnce = std::max<vtkIdType>(NumbersAtOnce / ofSlice, 1);
  for (vtkIdType z = extent[4]; z <= extent[5]; z += atOnce)
  {
    if (z > extent[4] && !progress(1.0)) // of what is read, all
    {
      return false;
    }
    parallelFor(z, std::min<vtkIdType>(z + atOnce, extent[5] + 1), 1, moveSlices);
  }
  return true;
}

// Whether float32 would round such numbers: it has 24 bits for digits.
template <typename T>
constexpr bool needsDouble = sizeof(T) >= 4 && !std::is_same_v<T, float>;

template <typename T>
bool moveVoxelsOf(const StoredVoxels& stored, vtkImageData* shown, const RasGrid& geometry,
  const Rescaling& rescaling, const Progress& progress)
{
  if (!rescaling.isNeeded())
  {
    return moveVoxels<T, T>(stored, shown, geometry, [](T value) { return value; }, progress);
  }
  using Shown = std::conditional_t<needsDouble<T>, double, float>;
  const auto rescaled = [&rescaling](T value) {
    return static_cast<Shown>(rescaling.slope * static_cast<double>(value) + rescaling.intercept);
  };
  return moveVoxels<T, Shown>(stored, shown, geometry, rescaled, progress);
}
}

namespace
{
// Whether the voxels are already those that are to be shown.
bool isAsShown(const StoredVoxels& stored, const RasGrid& geometry, const VolumeHeader& header)
{
  const bool isMoved = geometry.voxelAxis != std::array<int, 3>{ 0, 1, 2 } ||
    geometry.reversed != std::array<bool, 3>{};
  int extent[6];
  stored.image->GetExtent(extent);
  return stored.mayBeShown && !isMoved && !header.rescaling.isNeeded() &&
    std::equal(stored.wanted.begin(), stored.wanted.end(), extent) &&
    stored.image->GetNumberOfScalarComponents() == header.components;
}

// The extent in the file's order of one of the grid.
std::array<int, 6> extentInFile(const int extent[6], const RasGrid& geometry)
{
  std::array<int, 6> stored{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = geometry.grid.dimensions[axis] - 1;
    const bool isReversed = geometry.reversed[axis];
    const auto to = 2 * static_cast<std::size_t>(geometry.voxelAxis[axis]);
    stored[to] = isReversed ? last - extent[2 * axis + 1] : extent[2 * axis];
    stored[to + 1] = isReversed ? last - extent[2 * axis] : extent[2 * axis + 1];
  }
  return stored;
}
}

void StoredVoxels::show(const glm::ivec3& dimensions, vtkDataArray* numbers)
{
  this->image = vtkSmartPointer<vtkImageData>::New();
  this->image->SetDimensions(dimensions.x, dimensions.y, dimensions.z);
  this->image->GetPointData()->SetScalars(numbers);
}

void StoredVoxels::showWanted(vtkDataArray* numbers)
{
  this->image = vtkSmartPointer<vtkImageData>::New();
  this->image->SetExtent(this->wanted.data());
  this->image->GetPointData()->SetScalars(numbers);
}

vtkSmartPointer<vtkDataArray> partOf(vtkDataArray* numbers, vtkIdType first, vtkIdType count)
{
  constexpr int OwnedByNumbers = 1;
  auto part =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(numbers->GetDataType()));
  part->SetNumberOfComponents(numbers->GetNumberOfComponents());
  part->SetVoidArray(numbers->GetVoidPointer(first), count, OwnedByNumbers);
  return part;
}

std::vector<double> evenTimes(std::size_t count, double step, double start)
{
  step = std::isfinite(step) && step > 0.0 ? step : 1.0;
  start = std::isfinite(start) ? start : 0.0;
  std::vector<double> times;
  times.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    times.push_back(start + static_cast<double>(i) * step);
  }
  return times;
}

double VolumeFile::storedBytes(const VolumeHeader& header) const
{
  return static_cast<double>(header.dimensions.x) * header.dimensions.y * header.dimensions.z *
    header.components * vtkDataArray::GetDataTypeSize(header.storedType);
}

PlacedVolume::PlacedVolume(std::unique_ptr<VolumeFile> file)
  : File(std::move(file))
{
}

std::string PlacedVolume::sentence(const std::string& end) const
{
  return this->File->noun() + " " + this->FileName + " " + end;
}

void PlacedVolume::readHeader(const std::string& fileName)
{
  this->Placed = false;
  this->FileName = fileName;
  if (fileName.empty())
  {
    throw Problem("FileName is empty; it must name the " + this->File->noun());
  }
  this->Header = VolumeHeader();
  withWayOut(this->sentence(""), OtherVolume, [&] {
    this->File->readHeader(fileName, this->Header);
    if (this->WorldFromFile != glm::dmat4(1.0)) // which may leave -0
    {
      this->Header.worldFromVoxel = this->WorldFromFile * this->Header.worldFromVoxel;
    }
    withBeginning("cannot be placed: ", [&] { requireAffine(this->Header.worldFromVoxel); });
  });
  this->Geometry = nearestRasGrid(this->Header.worldFromVoxel, this->Header.dimensions);
  this->Placed = true;
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
  const RasGrid& placed = this->Geometry;
  return !(placed.shear > LargestUnreportedShear)
    ? std::string()
    : this->sentence(joined("is sheared: the cosine between two of its axes is ", placed.shear,
        "; the limit is ", LargestUnreportedShear, ". Its corners are shown up to ",
        placed.largestErrorMm, " mm from where it places them"));
}

int PlacedVolume::scalarType() const
{
  if (!this->Header.rescaling.isNeeded())
  {
    return this->Header.storedType;
  }
  bool isWide = false;
  switch (this->Header.storedType)
  {
    vtkTemplateMacro(isWide = needsDouble<VTK_TT>);
  }
  return isWide ? VTK_DOUBLE : VTK_FLOAT;
}

void PlacedVolume::requireMemory(const int extent[6]) const
{
  const glm::ivec3& size = this->Geometry.grid.dimensions;
  double shown = static_cast<double>(this->Header.components) *
    vtkDataArray::GetDataTypeSize(this->scalarType());
  const std::array<int, 6> wanted = extentInFile(extent, this->Geometry);
  const Loads loads = this->File->loads();
  double part = 1.0; // of all voxels
  for (int axis = 0; axis < 3; ++axis)
  {
    const double count = wanted[2 * axis + 1] - wanted[2 * axis] + 1.0;
    shown *= count;
    const bool isPart = loads == Loads::Part || (loads == Loads::Slices && axis == 2);
    part *= isPart ? count / this->Header.dimensions[axis] : 1.0;
  }
  requireHostMemory(std::to_string(this->Header.times.size()) + " volumes of " +
      sizeText(glm::dvec3(size)) + " voxels",
    part * this->File->storedBytes(this->Header) + shown);
}

void PlacedVolume::read(
  std::size_t volume, const int extent[6], const Progress& progress, vtkImageData* image)
{
  StoredVoxels stored;
  this->Damage.clear();
  stored.wanted = extentInFile(extent, this->Geometry);
  withWayOut(this->sentence("cannot be read: "), OtherVolume, [&] {
    this->requireMemory(extent);
    this->File->load(volume, progress, stored);
  });
  if (!stored.image)
  {
    return;
  }
  this->Damage = stored.warning.empty() ? std::string() : this->sentence(stored.warning);
  image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
  if (isAsShown(stored, this->Geometry, this->Header))
  {
    image->GetPointData()->SetScalars(stored.image->GetPointData()->GetScalars());
    return;
  }
  image->AllocateScalars(this->scalarType(), this->Header.components);
  bool isWhole = false;
  switch (stored.image->GetScalarType())
  {
    vtkTemplateMacro(isWhole = moveVoxelsOf<VTK_TT>(
                       stored, image, this->Geometry, this->Header.rescaling, progress));
  }
  if (!isWhole)
  {
    image->GetPointData()->SetScalars(nullptr); // stopped
  }
}

PlacedVolume openVolume(const std::string& fileName)
{
  withBeginning("Volume " + fileName + " ", [&] { requirePlainFile(fileName); });
  for (const VolumeFormat* format : volumeFormats())
  {
    if (format->isOne(fileName))
    {
      PlacedVolume volume(format->make());
      volume.readHeader(fileName);
      return volume;
    }
  }
  throw Problem("Volume " + fileName + " is of no format that BrainShift reads; " + OtherVolume);
}
}
