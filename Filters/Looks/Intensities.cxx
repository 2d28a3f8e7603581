// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/Intensities.h"

#include "Common/ImageGrid.h"
#include "Common/RankAgreement.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/Segmentation.h"
#include "Filters/Looks/FirstCamera.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace brainshift
{
namespace
{
constexpr int FineBins = 4096;       // to find the ends of the values
constexpr int Bins = 512;            // between them
constexpr double RareShare = 0.0005; // of the voxels at each end
constexpr std::size_t MostLabels = 64;
constexpr double RowShare = 0.002; // of the fullest row, below which a row counts as noise

void reduce(std::vector<double>& values, int operation)
{
  if (vtkMultiProcessController* processes = severalRanks())
  {
    const std::vector<double> own = values;
    processes->AllReduce(own.data(), values.data(), static_cast<vtkIdType>(own.size()), operation);
  }
}

// An array on this process's part of a volume, read at even distances. Where two parts share a
// layer of points, the lower part leaves it to the other.
class Part
{
public:
  Part(vtkImageData* volume, const ArrayChoice& choice)
  {
    this->find(volume, choice);
    this->findWhole();
    this->Step =
      static_cast<int>(std::ceil(std::cbrt(std::max(this->wholeCount() / MostVoxelsRead, 1.0))));
  }

  // On any process.
  bool exists() const { return this->Anywhere; }

  // Calls visit(index, value) for finite values; the index is in the whole volume.
  template <typename Visit>
  void forEach(const Visit& visit) const
  {
    if (!this->Array)
    {
      return;
    }
    const glm::ivec3 size = this->Last - this->First + 1;
    for (int k = this->start(2); k <= this->end(2); k += this->Step)
    {
      for (int j = this->start(1); j <= this->end(1); j += this->Step)
      {
        const vtkIdType row =
          (vtkIdType(k - this->First.z) * size.y + (j - this->First.y)) * size.x;
        for (int i = this->start(0); i <= this->end(0); i += this->Step)
        {
          const double value = this->Array->GetComponent(row + (i - this->First.x), 0);
          if (std::isfinite(value))
          {
            visit(glm::ivec3(i, j, k) - this->WholeFirst, value);
          }
        }
      }
    }
  }

  glm::ivec3 wholeSize() const { return this->WholeLast - this->WholeFirst + 1; }

  // World position (mm) of an index in the whole volume.
  glm::dvec3 world(const glm::dvec3& index) const
  {
    return this->Place.worldFromGrid(index + glm::dvec3(this->WholeFirst - this->First));
  }

  const Grid& place() const { return this->Place; }
  double value(const glm::ivec3& index) const // in this part
  {
    return this->Array->GetComponent(
      static_cast<vtkIdType>(this->Place.offset(index.x, index.y, index.z)), 0);
  }
  bool isHere() const { return this->Array; }

  // Whether an index in this part is of it, and not left to another.
  bool counts(const glm::ivec3& index) const
  {
    const glm::ivec3 last = glm::ivec3(this->end(0), this->end(1), this->end(2)) - this->First;
    return glm::all(glm::greaterThanEqual(index, glm::ivec3(0))) &&
      glm::all(glm::lessThanEqual(index, last));
  }
  int step() const { return this->Step; }

private:
  void find(vtkImageData* volume, const ArrayChoice& choice)
  {
    const bool cells = choice.association == vtkDataObject::CELL;
    vtkDataSetAttributes* data = !volume ? nullptr
      : cells                            ? static_cast<vtkDataSetAttributes*>(volume->GetCellData())
                                         : volume->GetPointData();
    vtkDataArray* array = data ? data->GetArray(choice.name.c_str()) : nullptr;
    if (!array || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() == 0)
    {
      return;
    }
    this->Array = array;
    this->Place = gridOf(volume);
    int extent[6];
    volume->GetExtent(extent);
    this->First = { extent[0], extent[2], extent[4] };
    this->Last = { extent[1], extent[3], extent[5] };
    if (cells)
    {
      this->Last = glm::max(this->Last - 1, this->First);
      this->Place.origin = this->Place.worldFromGrid(glm::dvec3(0.5));
    }
    this->Place.dimensions = this->Last - this->First + 1;
  }

  // The whole volume's first and last index, over all processes.
  void findWhole()
  {
    constexpr double none = std::numeric_limits<int>::max();
    std::vector<double> ends(7, -none); // three negated first ones, three last ones, and: any array
    for (int axis = 0; axis < 3 && this->Array; ++axis)
    {
      ends[axis] = -this->First[axis];
      ends[3 + axis] = this->Last[axis];
      ends[6] = 1.0;
    }
    reduce(ends, vtkCommunicator::MAX_OP);
    this->Anywhere = ends[6] == 1.0;
    for (int axis = 0; axis < 3 && this->Anywhere; ++axis)
    {
      this->WholeFirst[axis] = -static_cast<int>(ends[axis]);
      this->WholeLast[axis] = static_cast<int>(ends[3 + axis]);
    }
  }

  double wholeCount() const
  {
    const glm::dvec3 size(this->wholeSize());
    return size.x * size.y * size.z;
  }

  int start(int axis) const
  {
    const int beyond = (this->First[axis] - this->WholeFirst[axis]) % this->Step;
    return this->First[axis] + (beyond ? this->Step - beyond : 0);
  }
  int end(int axis) const
  {
    return this->Last[axis] < this->WholeLast[axis] ? this->Last[axis] - 1 : this->Last[axis];
  }

  vtkDataArray* Array = nullptr; // null: none on this process
  Grid Place;                    // of this part
  glm::ivec3 First{ 0 };
  glm::ivec3 Last{ 0 };
  glm::ivec3 WholeFirst{ 0 };
  glm::ivec3 WholeLast{ 0 };
  int Step = 1;
  bool Anywhere = false;
};

Histogram countAll(const Part& part, double low, double high, int bins)
{
  Histogram histogram = makeHistogram(low, high, bins);
  part.forEach([&](const glm::ivec3&, double value) { histogram.add(value); });
  reduce(histogram.counts, vtkCommunicator::SUM_OP);
  return histogram;
}

// Finds the smallest and the largest value, and whether all of them are labels.
void findRange(const Part& part, Intensities& found)
{
  std::set<double> different;
  std::vector<double> ends(3, -std::numeric_limits<double>::max()); // -lowest, highest, not labels
  part.forEach([&](const glm::ivec3&, double value) {
    ends[0] = std::max(ends[0], -value);
    ends[1] = std::max(ends[1], value);
    if (different.size() <= MostLabels)
    {
      different.insert(value);
    }
  });
  const bool whole = std::all_of(
    different.begin(), different.end(), [](double value) { return value == std::floor(value); });
  ends[2] = different.size() > MostLabels || !whole ? 1.0 : 0.0;
  reduce(ends, vtkCommunicator::MAX_OP);
  found.lowest = -ends[0];
  found.highest = ends[1];
  found.areLabels = ends[2] == 0.0;
}

glm::dvec3 indexOf(const Grid& grid, std::size_t voxel)
{
  const auto x = static_cast<std::size_t>(grid.dimensions.x);
  const auto y = static_cast<std::size_t>(grid.dimensions.y);
  return { voxel % x, voxel / x % y, voxel / x / y };
}

// Adds the values of a part at the middles of the segmentation's voxels.
void addSegment(const Part& part, vtkImageData* volume, Histogram& histogram)
{
  const Segmentation segmentation = volume ? readSegmentation(volume) : Segmentation();
  if (part.isHere() && segmentation.labels)
  {
    const Mask mask = segmentOf(segmentation, segmentation.chosen);
    const double voxels = static_cast<double>(mask.inside.size());
    const auto step = static_cast<std::size_t>(std::max(voxels / MostVoxelsRead, 1.0));
    for (std::size_t voxel = 0; voxel < mask.inside.size(); voxel += step)
    {
      if (!mask.inside[voxel])
      {
        continue;
      }
      const glm::dvec3 world = mask.grid.worldFromGrid(indexOf(mask.grid, voxel));
      const glm::ivec3 index(glm::round(part.place().gridFromWorld(world)));
      if (part.counts(index) && std::isfinite(part.value(index)))
      {
        histogram.add(part.value(index));
      }
    }
  }
}

Histogram countSegment(const Part& part, vtkImageData* volume, const Histogram& all)
{
  Histogram histogram = makeHistogram(all.low, all.high, Bins);
  runOnAllRanks("The histogram of the segment", [&] { addSegment(part, volume, histogram); });
  reduce(histogram.counts, vtkCommunicator::SUM_OP);
  return histogram.total() > 0.0 ? histogram : Histogram();
}

// The first and the last of the numbered rows that hold more than noise.
std::array<int, 2> filled(const std::vector<double>& counts, int first, int size)
{
  const auto begin = counts.begin() + first;
  const double most = *std::max_element(begin, begin + size);
  const auto isFull = [&](double count) { return count > RowShare * most; };
  const auto low = std::find_if(begin, begin + size, isFull);
  auto high = begin + size;
  while (high != low && !isFull(*(high - 1)))
  {
    --high;
  }
  return { static_cast<int>(low - begin), static_cast<int>(high - begin) - 1 };
}

// The first and the last voxel of rows along i, where only these can lie farthest out. Only runs of
// a few neighbours count: lone voxels are noise.
class RunEnds
{
public:
  explicit RunEnds(int step)
    : Step(step)
  {
  }

  // Indices with k slowest and i fastest, each one rising.
  void add(const glm::ivec3& index)
  {
    const bool sameRow = index.y == this->Last.y && index.z == this->Last.z;
    const bool follows = sameRow && index.x == this->Last.x + this->Step;
    this->Run = follows ? this->Run + 1 : 1;
    this->Last = index;
    if (!sameRow)
    {
      this->Found = false;
    }
    if (this->Run < ShortestRun)
    {
      return;
    }
    if (!this->Found)
    {
      this->Ends.push_back(index - glm::ivec3((ShortestRun - 1) * this->Step, 0, 0));
      this->Ends.push_back(index);
      this->Found = true;
    }
    this->Ends.back() = index;
  }

  const std::vector<glm::ivec3>& all() const { return this->Ends; }

private:
  static constexpr int ShortestRun = 3;
  int Step;
  int Run = 0;
  bool Found = false; // in this row
  glm::ivec3 Last{ -1 };
  std::vector<glm::ivec3> Ends;
};

// The first and the last voxel inside, from `begin` to before `end`; none: nothing.
std::vector<std::size_t> endsOf(const std::vector<char>& inside, std::size_t begin, std::size_t end)
{
  const auto from = inside.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto to = inside.begin() + static_cast<std::ptrdiff_t>(end);
  const auto isInside = [](char value) { return value != 0; };
  const auto first = std::find_if(from, to, isInside);
  if (first == to)
  {
    return {};
  }
  auto last = to - 1;
  while (!*last)
  {
    --last;
  }
  return { static_cast<std::size_t>(first - inside.begin()),
    static_cast<std::size_t>(last - inside.begin()) };
}

void addSegment(vtkImageData* volume, FarPoints& points)
{
  const Segmentation segmentation = volume ? readSegmentation(volume) : Segmentation();
  if (segmentation.labels)
  {
    const Mask mask = segmentOf(segmentation, segmentation.chosen);
    const auto row = static_cast<std::size_t>(mask.grid.dimensions.x);
    for (std::size_t begin = 0; begin < mask.inside.size(); begin += row)
    {
      for (const std::size_t voxel : endsOf(mask.inside, begin, begin + row))
      {
        points.add(mask.grid.worldFromGrid(indexOf(mask.grid, voxel)));
      }
    }
  }
}
}

Intensities readIntensities(vtkImageData* volume, const ArrayChoice& array)
{
  Intensities found;
  const Part part(volume, array);
  if (!part.exists())
  {
    return found;
  }
  findRange(part, found);
  if (found.lowest >= found.highest) // no finite value, or one constant
  {
    return found;
  }
  const Histogram fine = countAll(part, found.lowest, found.highest, FineBins);
  const double low = percentile(fine, RareShare) - fine.width();
  const double high = percentile(fine, 1.0 - RareShare) + fine.width();
  found.all = countAll(part, std::max(low, found.lowest), std::max(high, low + fine.width()), Bins);
  found.segment = countSegment(part, volume, found.all);
  return found;
}

Histogram readHistogram(vtkImageData* volume, const ArrayChoice& array, int bins)
{
  const Part part(volume, array);
  Intensities found;
  if (part.exists())
  {
    findRange(part, found);
  }
  return found.lowest < found.highest ? countAll(part, found.lowest, found.highest, bins)
                                      : Histogram();
}

std::vector<glm::dvec3> farPointsAbove(vtkImageData* volume, const ArrayChoice& array, double value)
{
  const Part part(volume, array);
  if (!part.exists())
  {
    return {};
  }
  const glm::ivec3 size = part.wholeSize();
  const glm::ivec3 first(0, size.x, size.x + size.y);
  std::vector<double> counts(static_cast<std::size_t>(first.z) + size.z, 0.0);
  RunEnds ends(part.step());
  runOnAllRanks("The search for tissue", [&] {
    part.forEach([&](const glm::ivec3& index, double at) {
      if (at > value)
      {
        ends.add(index);
        for (int axis = 0; axis < 3; ++axis)
        {
          counts[static_cast<std::size_t>(first[axis]) + index[axis]] += 1.0;
        }
      }
    });
  });
  reduce(counts, vtkCommunicator::SUM_OP);
  glm::ivec3 low;
  glm::ivec3 high;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::array<int, 2> rows = filled(counts, first[axis], size[axis]);
    low[axis] = rows[0];
    high[axis] = rows[1];
  }
  FarPoints points;
  for (const glm::ivec3& index : ends.all())
  {
    if (glm::all(glm::greaterThanEqual(index, low)) && glm::all(glm::lessThanEqual(index, high)))
    {
      points.add(part.world(glm::dvec3(index)));
    }
  }
  return points.ofAllProcesses();
}

std::vector<glm::dvec3> farPointsOfSegment(vtkImageData* volume)
{
  FarPoints points;
  runOnAllRanks("The search for the segment", [&] { addSegment(volume, points); });
  return points.ofAllProcesses();
}
}
