// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Registered/ComparedVoxels.h"

#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Common/Numbers.h"
#include "Common/Parallel.h"
#include "Common/PiecedArray.h"
#include "Common/Problem.h"
#include "Common/RankAgreement.h"
#include "Common/SharedVolume.h"
#include "Formats/Volumes/FinerLevels.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace brainshift
{
namespace
{
constexpr double FewestVoxels = 4e6; // that are left

// Floats for each voxel while it is read: the image, the registration's copy, one to spare.
constexpr double FloatsOfVoxel = 3.0;

constexpr const char* NoScalars = "The volume has no point scalars of one component";
constexpr Extent NoVoxels{ 0, -1, 0, -1, 0, -1 };

glm::ivec3 firstOf(const Extent& extent)
{
  return { extent[0], extent[2], extent[4] };
}

glm::ivec3 sidesOf(const Extent& extent)
{
  return glm::ivec3(extent[1], extent[3], extent[5]) - firstOf(extent) + 1;
}

Extent extentBetween(const glm::ivec3& first, const glm::ivec3& last)
{
  return { first.x, last.x, first.y, last.y, first.z, last.z };
}

Extent allOf(const Grid& grid)
{
  return extentBetween(glm::ivec3(0), grid.dimensions - 1);
}

// The voxels of one average: numbers along an axis, those beyond the volume as its last one.
struct BlockPlaces
{
  glm::ivec3 joined;
  glm::ivec3 lastVoxel; // of the volume
  glm::ivec3 held;      // first voxel of the numbers
  glm::ivec3 sides;     // of the numbers

  // Steps along an axis to a voxel of a block.
  std::size_t at(int axis, int block, int voxel) const
  {
    return std::min(block * this->joined[axis] + voxel, this->lastVoxel[axis]) - this->held[axis];
  }
};

template <typename Value>
float averageOf(const Value* numbers, const BlockPlaces& places, const glm::ivec3& block)
{
  double sum = 0.0;
  int known = 0;
  for (int z = 0; z < places.joined.z; ++z)
  {
    for (int y = 0; y < places.joined.y; ++y)
    {
      const std::size_t line = places.at(2, block.z, z) * places.sides.y + places.at(1, block.y, y);
      const Value* row = numbers + line * places.sides.x;
      for (int x = 0; x < places.joined.x; ++x)
      {
        const auto value = static_cast<double>(row[places.at(0, block.x, x)]);
        const bool counts = std::abs(value) <= LargestComparedValue; // false for NaN
        sum += counts ? value : 0.0;
        known += counts ? 1 : 0;
      }
    }
  }
  const int all = places.joined.x * places.joined.y * places.joined.z;
  return 2 * known >= all ? static_cast<float>(sum / known)
                          : std::numeric_limits<float>::quiet_NaN();
}

template <typename Value>
void averageAll(
  vtkDataArray* numbers, const BlockPlaces& places, const Extent& wanted, float* averages)
{
  const auto* values = static_cast<const Value*>(numbers->GetVoidPointer(0));
  const glm::ivec3 first = firstOf(wanted);
  const glm::ivec3 sides = sidesOf(wanted);
  parallelFor(0, std::int64_t{ sides.y } * sides.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t row = begin; row < end; ++row)
    {
      const int y = static_cast<int>(row % sides.y);
      const int z = static_cast<int>(row / sides.y);
      for (int x = 0; x < sides.x; ++x)
      {
        averages[row * sides.x + x] = averageOf(values, places, first + glm::ivec3(x, y, z));
      }
    }
  });
}
}

void averageVoxels(
  vtkDataArray* numbers, const VoxelBlocks& blocks, const Extent& wanted, float* averages)
{
  const BlockPlaces places{ blocks.joined, sidesOf(blocks.whole) - 1,
    firstOf(blocks.held) - firstOf(blocks.whole), sidesOf(blocks.held) };
  switch (numbers->GetDataType())
  {
    vtkTemplateMacro(averageAll<VTK_TT>(numbers, places, wanted, averages));
  }
}

glm::ivec3 joinedVoxels(const Grid& grid, double longestMm)
{
  constexpr double Rounding = 1e-6;
  const glm::dvec3 most = glm::max(glm::dvec3(grid.dimensions / 2), glm::dvec3(1.0));
  const glm::ivec3 joined(
    glm::clamp(glm::floor(longestMm / grid.spacing + Rounding), glm::dvec3(1.0), most));
  const double all = static_cast<double>(joined.x) * joined.y * joined.z;
  return static_cast<double>(grid.count()) < all * FewestVoxels ? glm::ivec3(1) : joined;
}

vtkDataArray* comparedScalars(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars = scalars ? scalars : image->GetPointData()->GetArray(0);
  return scalars && scalars->GetNumberOfComponents() == 1 ? scalars : nullptr;
}

namespace
{
// An image of floats, with an extent of a grid.
vtkSmartPointer<vtkImageData> floatsOn(const Grid& grid, const Extent& extent)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const glm::dmat3 rows = glm::transpose(grid.direction);
  image->SetExtent(const_cast<int*>(extent.data()));
  image->SetOrigin(&grid.origin.x);
  image->SetSpacing(&grid.spacing.x);
  image->SetDirectionMatrix(&rows[0][0]);
  vtkNew<vtkFloatArray> numbers;
  numbers->SetName("Compared");
  numbers->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->SetScalars(numbers);
  return image;
}

float* floatsOf(vtkImageData* image)
{
  return vtkFloatArray::SafeDownCast(image->GetPointData()->GetScalars())->GetPointer(0);
}

// Its averages, where they are wanted.
vtkSmartPointer<vtkImageData> averagesOf(
  vtkImageData* image, const WholeVolume& whole, const glm::ivec3& joined, const Extent& wanted)
{
  if (!comparedScalars(image))
  {
    throw Problem(NoScalars);
  }
  const Grid grid = whole.grid.ofBlocks(joined);
  requireHostMemory("The average of " + sizeText(joined) + " voxels",
    sizeof(float) * static_cast<double>(sidesOf(wanted).x) * sidesOf(wanted).y * sidesOf(wanted).z);
  auto averages = floatsOn(grid, wanted);
  averageVoxels(
    comparedScalars(image), { extentOf(image), whole.extent, joined }, wanted, floatsOf(averages));
  averages->GetFieldData()->ShallowCopy(image->GetFieldData());
  return averages;
}

// A finer level of the file that a volume is from.
struct FinerLevel
{
  std::unique_ptr<FinerLevels> file;
  std::size_t number = 0;
};

bool suits(const glm::dvec3& spacing, const glm::dvec3& finest, double longestMm)
{
  constexpr double Rounding = 1.01;
  return glm::all(glm::lessThanEqual(spacing, Rounding * glm::max(glm::dvec3(longestMm), finest)));
}

// What reading a level takes; FloatsOfVoxel count what is left of it.
double bytesToRead(const Grid& grid, int block, int bytesOfNumber, double longestMm)
{
  const Grid joined = grid.ofBlocks(joinedVoxels(grid, longestMm));
  const double slab = static_cast<double>(grid.dimensions.x) * grid.dimensions.y * block;
  return slab * bytesOfNumber + FloatsOfVoxel * sizeof(float) * static_cast<double>(joined.count());
}

// The level to be read in place of the voxels that are there; none: those suit, or there is none.
std::optional<FinerLevel> levelFor(vtkImageData* image, double longestMm, std::string& remark)
{
  vtkDataArray* numbers = image ? comparedScalars(image) : nullptr;
  const std::optional<LevelSource> source = numbers ? finerLevelsOf(numbers) : std::nullopt;
  if (!source || !(source->grid == gridOf(image)) || // placed anew by a filter
    suits(source->grid.spacing, glm::dvec3(0.0), longestMm))
  {
    return std::nullopt;
  }
  FinerLevel found;
  remark = problemOf([&] { found.file = std::make_unique<FinerLevels>(*source); });
  const std::vector<Grid>& grids = found.file ? found.file->grids() : std::vector<Grid>();
  if (grids.empty() || suits(source->grid.spacing, grids.front().spacing, longestMm))
  {
    return std::nullopt;
  }
  found.number = grids.size() - 1;
  while (found.number > 0 && !suits(grids[found.number].spacing, grids.front().spacing, longestMm))
  {
    --found.number;
  }
  for (; found.number < grids.size(); ++found.number)
  {
    const Grid& grid = grids[found.number];
    const std::string problem = hostMemoryProblem("Level " + std::to_string(found.number) +
        " of the volume, " + sizeText(grid.dimensions) + " voxels,",
      bytesToRead(
        grid, found.file->blockSide(found.number), numbers->GetDataTypeSize(), longestMm));
    if (problem.empty())
    {
      return found;
    }
    remark = remark.empty() ? problem : remark;
  }
  return std::nullopt;
}

// Slabs of the file's blocks are read and averaged in turn, so that memory holds one of them.
vtkSmartPointer<vtkImageData> readLevel(
  const FinerLevel& level, double longestMm, std::string& remark)
{
  const Grid& grid = level.file->grids()[level.number];
  const glm::ivec3 joined = joinedVoxels(grid, longestMm);
  const Grid to = grid.ofBlocks(joined);
  auto image = floatsOn(to, allOf(to));
  const int layers = std::max(1, level.file->blockSide(level.number) / joined.z);
  const Progress all = [](double) { return true; };
  for (int first = 0; first < to.dimensions.z; first += layers)
  {
    Extent wanted = allOf(to);
    wanted[4] = first;
    wanted[5] = std::min(first + layers, to.dimensions.z) - 1;
    Extent held = allOf(grid);
    held[4] = wanted[4] * joined.z;
    held[5] = std::min((wanted[5] + 1) * joined.z, grid.dimensions.z) - 1;
    std::string damage;
    const auto numbers = level.file->read(level.number, held.data(), all, damage);
    remark = remark.empty() ? damage : remark;
    averageVoxels(
      numbers, { held, allOf(grid), joined }, wanted, floatsOf(image) + to.offset(0, 0, first));
  }
  return image;
}

// The averages whose first voxels a rank has. Ranks share voxels at their borders, so they share
// averages there.
Extent averagesIn(const Extent& part, const Extent& whole, const glm::ivec3& joined)
{
  const glm::ivec3 first = firstOf(part) - firstOf(whole);
  const glm::ivec3 last = first + sidesOf(part) - 1;
  return extentBetween((first + joined - 1) / joined, last / joined);
}

// The voxels of averages.
Extent voxelsOf(const Extent& averages, const Extent& whole, const glm::ivec3& joined)
{
  const glm::ivec3 first = firstOf(averages) * joined;
  const glm::ivec3 last = (firstOf(averages) + sidesOf(averages)) * joined - 1;
  return extentBetween(first + firstOf(whole), glm::min(last, sidesOf(whole) - 1) + firstOf(whole));
}

vtkSmartPointer<vtkImageData> sharedBy(vtkMultiProcessController* ranks, vtkImageData* part,
  const WholeVolume& whole, const Extent& wanted)
{
  std::string problem;
  auto image = SharedVolume().share(ranks, part, whole, wanted, problem);
  throwIfAny(problem);
  if (vtkDataArray* scalars = image->GetPointData()->GetScalars())
  {
    image->GetPointData()->SetScalars(contiguous(scalars)); // samples are taken here and there
  }
  return image;
}

// All of the volume, or its averages, on the first rank.
vtkSmartPointer<vtkImageData> gathered(vtkMultiProcessController* ranks, vtkImageData* part,
  const WholeVolume& whole, const glm::ivec3& joined)
{
  const bool isFirst = ranks->GetLocalProcessId() == 0;
  if (joined == glm::ivec3(1))
  {
    return sharedBy(ranks, part, whole, isFirst ? whole.extent : NoVoxels);
  }
  const Extent own = extentOf(part);
  const Extent wanted = isEmpty(own) ? NoVoxels : averagesIn(own, whole.extent, joined);
  const bool hasAny = !isEmpty(wanted);
  vtkSmartPointer<vtkImageData> averages =
    sharedBy(ranks, part, whole, hasAny ? voxelsOf(wanted, whole.extent, joined) : NoVoxels);
  runOnAllRanks("The volume", [&] {
    averages =
      hasAny ? averagesOf(averages, whole, joined, wanted) : vtkSmartPointer<vtkImageData>::New();
  });
  const Grid grid = whole.grid.ofBlocks(joined);
  return sharedBy(ranks, averages, { grid, allOf(grid) }, isFirst ? allOf(grid) : NoVoxels);
}

// This rank's part without other arrays, and without points if it has none.
vtkSmartPointer<vtkImageData> sentOf(vtkImageData* part)
{
  auto sent = vtkSmartPointer<vtkImageData>::New();
  if (part)
  {
    sent->CopyStructure(part);
    sent->GetPointData()->SetScalars(comparedScalars(part));
    sent->GetFieldData()->ShallowCopy(part->GetFieldData());
  }
  return sent;
}

ComparedVoxels levelOf(
  vtkImageData* part, const FinerLevel& level, double longestMm, std::string remark)
{
  ComparedVoxels result;
  result.image = readLevel(level, longestMm, remark);
  result.image->GetFieldData()->ShallowCopy(part->GetFieldData());
  result.remark = remark;
  return result;
}

ComparedVoxels ofRanks(vtkMultiProcessController* ranks, vtkImageData* part,
  vtkInformation* information, double longestMm)
{
  Extent extent = NoVoxels;
  if (information)
  {
    information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent.data());
  }
  const auto sent = sentOf(part);
  const WholeVolume whole = SharedVolume::wholeOf(ranks, sent, extent);
  const bool isFirst = ranks->GetLocalProcessId() == 0;
  ComparedVoxels result;
  std::optional<FinerLevel> level;
  runOnAllRanks("The volume", [&] {
    if (isFirst && (!part || part->GetNumberOfPoints() == 0))
    {
      throw Problem("The first MPI rank, which registers, has no voxels of the volume; let its "
                    "reader give it some, or register on one rank");
    }
    level = isFirst ? levelFor(part, longestMm, result.remark) : std::nullopt;
  });
  if (isTrueOnAny(ranks, level.has_value()))
  {
    runOnAllRanks("The volume",
      [&] { result = level ? levelOf(part, *level, longestMm, result.remark) : result; });
  }
  else
  {
    result.image = gathered(ranks, sent, whole, joinedVoxels(whole.grid, longestMm));
  }
  result.image = isFirst ? result.image : nullptr;
  result.whole = whole.grid;
  return result;
}

ComparedVoxels ofOne(vtkImageData* image, vtkInformation* information, double longestMm)
{
  if (!image || !comparedScalars(image))
  {
    throw Problem(NoScalars);
  }
  requireWhole(image, information);
  ComparedVoxels result;
  const std::optional<FinerLevel> level = levelFor(image, longestMm, result.remark);
  const glm::ivec3 joined = joinedVoxels(gridOf(image), longestMm);
  if (level)
  {
    result = levelOf(image, *level, longestMm, result.remark);
  }
  else if (joined == glm::ivec3(1))
  {
    result.image = image;
  }
  else
  {
    const WholeVolume whole{ gridOf(image), extentOf(image) };
    result.image = averagesOf(image, whole, joined, allOf(whole.grid.ofBlocks(joined)));
  }
  result.whole = gridOf(image);
  return result;
}
}

ComparedVoxels comparedVoxels(vtkImageData* part, vtkInformation* information, double finestMm)
{
  vtkMultiProcessController* ranks = severalRanks();
  const double longestMm = ComparedVoxelFraction * finestMm;
  return ranks ? ofRanks(ranks, part, information, longestMm) : ofOne(part, information, longestMm);
}
}
