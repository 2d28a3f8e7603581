// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/RankParts.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// A part may have so many times the mean work.
constexpr double MostWork = 1.5;
// Of another one: so a stroke, which lengthens a box, does not turn cuts around.
constexpr double LongerSide = 1.05;

// The box of a cell. The last cells of an axis end exactly where the box does.
Box cellOf(const Box& box, const glm::ivec3& index)
{
  Box cell{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = box[2 * axis + 1] - box[2 * axis];
    const auto at = [&](int i) { return box[2 * axis] + side * i / TissueCounts::CellsASide; };
    cell[2 * axis] = at(index[axis]);
    cell[2 * axis + 1] = at(index[axis] + 1);
  }
  return cell;
}

// The fraction of a box that is in another one. A box without an extent along an axis counts as one
// with.
double fractionIn(const Box& box, const Box& other)
{
  double fraction = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = box[2 * axis + 1] - box[2 * axis];
    const double common =
      std::min(box[2 * axis + 1], other[2 * axis + 1]) - std::max(box[2 * axis], other[2 * axis]);
    fraction *= side > 0.0 ? std::max(common, 0.0) / side : common >= 0.0;
  }
  return fraction;
}

// Where a cut across an axis leaves a fraction of the work below it. 30 halvings are exact to a
// billionth of the side.
double cutAt(const Box& whole, int axis, double fraction, const TissueCounts* counts)
{
  double low = 0.0;
  double high = 1.0;
  const double side = whole[2 * axis + 1] - whole[2 * axis];
  const double work = counts ? fraction * counts->workIn(whole) : 0.0;
  for (int i = 0; counts && i < 30; ++i)
  {
    Box below = whole;
    below[2 * axis + 1] = whole[2 * axis] + side * 0.5 * (low + high);
    (counts->workIn(below) < work ? low : high) = 0.5 * (low + high);
  }
  return whole[2 * axis] + side * (counts ? 0.5 * (low + high) : fraction);
}

void cut(const Box& whole, int ranks, const TissueCounts* counts, std::vector<Box>& parts)
{
  if (ranks <= 1)
  {
    parts.push_back(whole);
    return;
  }
  int axis = 2;
  for (int other = 1; other >= 0; --other)
  {
    const double side = whole[2 * other + 1] - whole[2 * other];
    axis = side > LongerSide * (whole[2 * axis + 1] - whole[2 * axis]) ? other : axis;
  }
  const int below = ranks / 2;
  const double at = cutAt(whole, axis, below / static_cast<double>(ranks), counts);
  Box low = whole;
  Box high = whole;
  low[2 * axis + 1] = at;
  high[2 * axis] = at;
  cut(low, below, counts, parts);
  cut(high, ranks - below, counts, parts);
}

// Whether no part has much more work than the mean.
bool isBalanced(const std::vector<Box>& parts, const TissueCounts& counts)
{
  const double most = MostWork * counts.workIn(counts.box) / static_cast<double>(parts.size());
  return std::all_of(
    parts.begin(), parts.end(), [&](const Box& part) { return counts.workIn(part) <= most; });
}

// Parts of a former whole as parts of another one: outer sides follow it. Empty if they do not fit.
std::vector<Box> fitted(std::vector<Box> parts, const Box& former, const Box& whole)
{
  for (Box& part : parts)
  {
    for (int side = 0; side < 6; ++side)
    {
      part[side] = part[side] == former[side] ? whole[side] : part[side];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(part[2 * axis] >= whole[2 * axis] && part[2 * axis] <= part[2 * axis + 1] &&
            part[2 * axis + 1] <= whole[2 * axis + 1]))
      {
        return {};
      }
    }
  }
  return parts;
}

// The smallest box along a grid's own axes that holds a box of the world, grid coordinates.
PositionRange inGrid(const Grid& grid, const Box& box)
{
  PositionRange range{ glm::dvec3(1e300), glm::dvec3(-1e300) };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 world(box[corner & 1], box[2 + (corner >> 1 & 1)], box[4 + (corner >> 2 & 1)]);
    const glm::dvec3 position = grid.gridFromWorld(world);
    range.low = glm::min(range.low, position);
    range.high = glm::max(range.high, position);
  }
  return range;
}
}

glm::dvec2 rangeOf(const std::optional<DrawnPart>& part, vtkImageData* image,
  const DrawnValues& values, int component)
{
  const char* name = values.scalars->GetName();
  if (part && name)
  {
    const bool ofCells = image->GetCellData()->GetArray(name) == values.scalars;
    const auto known = part->ranges.find({ ofCells, name });
    if (known != part->ranges.end())
    {
      const int last = static_cast<int>(known->second.size()) - 1; // the magnitude
      const std::array<double, 2>& whole =
        known->second[component < 0 ? last : std::min(component, last)];
      return { whole[0], whole[1] };
    }
  }
  glm::dvec2 range;
  values.scalars->GetFiniteRange(&range[0], component);
  return range;
}

DrawnValues wholeValues(const DrawnPart& part, const DrawnValues& values)
{
  DrawnValues whole;
  whole.grid = part.whole.grid;
  whole.layout = layoutOf(whole.grid.dimensions, values.layout.ofCells);
  return whole;
}

void TissueCounts::add(const glm::dvec3& place, long long voxels)
{
  glm::ivec3 index;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = this->box[2 * axis + 1] - this->box[2 * axis];
    const double at = side > 0.0 ? (place[axis] - this->box[2 * axis]) / side * CellsASide : 0.0;
    index[axis] = static_cast<int>(std::clamp(at, 0.0, CellsASide - 1.0));
  }
  this->cells[(index.z * CellsASide + index.y) * CellsASide + index.x] += voxels;
}

double TissueCounts::workIn(const Box& part) const
{
  double visible = 0.0;
  double all = 0.0;
  std::size_t cell = 0;
  forEachIndex(glm::ivec3(0), glm::ivec3(CellsASide - 1), [&](const glm::ivec3& index) {
    const auto count = static_cast<double>(this->cells[cell++]);
    all += count;
    visible += count > 0.0 ? count * fractionIn(cellOf(this->box, index), part) : 0.0;
  });
  const double space = fractionIn(this->box, part);
  return 0.5 * (all > 0.0 ? visible / all : space) + 0.5 * space;
}

std::vector<Box> rankParts(const Box& whole, int ranks, const TissueCounts* counts)
{
  std::vector<Box> parts;
  cut(whole, ranks, counts, parts);
  return parts;
}

std::vector<Box> balancedParts(const std::vector<Box>& parts, const Box& former, int ranks,
  const TissueCounts& counts, bool keeps)
{
  std::vector<Box> kept = fitted(parts, former, counts.box);
  const bool fits = kept.size() == static_cast<std::size_t>(ranks);
  if (keeps && fits)
  {
    return kept;
  }
  if (!fits || !isBalanced(kept, counts))
  {
    kept = rankParts(counts.box, ranks);
  }
  return isBalanced(kept, counts) ? kept : rankParts(counts.box, ranks, &counts);
}

std::vector<Box> nearestParts(const std::vector<Box>& parts, const std::vector<Box>& held)
{
  struct Pair
  {
    double common; // fraction of what the rank holds that is in the part
    int rank;
    int part;
  };
  const int ranks = static_cast<int>(held.size());
  std::vector<Pair> pairs;
  pairs.reserve(held.size() * parts.size());
  for (int rank = 0; rank < ranks; ++rank)
  {
    for (int part = 0; part < ranks; ++part)
    {
      pairs.push_back({ fractionIn(held[rank], parts[part]), rank, part });
    }
  }
  const auto isBefore = [](const Pair& a, const Pair& b) {
    const bool aStays = a.rank == a.part;
    const bool bStays = b.rank == b.part;
    return a.common != b.common ? a.common > b.common : aStays && !bStays;
  };
  std::stable_sort(pairs.begin(), pairs.end(), isBefore);
  std::vector<Box> nearest(parts.size());
  std::vector<bool> hasPart(parts.size());
  std::vector<bool> isTaken(parts.size());
  for (const Pair& pair : pairs)
  {
    if (!hasPart[pair.rank] && !isTaken[pair.part])
    {
      nearest[pair.rank] = parts[pair.part];
      hasPart[pair.rank] = isTaken[pair.part] = true;
    }
  }
  return nearest;
}

Box withoutOuterSides(const Box& part, const Box& whole)
{
  Box open = part;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double side = whole[2 * axis + 1] - whole[2 * axis];
    open[2 * axis] -= part[2 * axis] <= whole[2 * axis] ? side : 0.0;
    open[2 * axis + 1] += part[2 * axis + 1] >= whole[2 * axis + 1] ? side : 0.0;
  }
  return open;
}

Box around(const Box& a, const Box& b)
{
  Box both = a;
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::min(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::max(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

Box boxAround(const Grid& grid)
{
  Box box{ 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world = grid.worldFromGrid(side * glm::dvec3(grid.dimensions - 1));
    box = around(box, { world.x, world.x, world.y, world.y, world.z, world.z });
  }
  return box;
}

Box commonBox(const Box& a, const Box& b)
{
  Box both{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = a[2 * axis];
    const double high = a[2 * axis + 1];
    both[2 * axis] = std::clamp(b[2 * axis], low, high);
    both[2 * axis + 1] = std::clamp(b[2 * axis + 1], low, high);
  }
  return both;
}

Box widened(const Box& box, double mm)
{
  Box wide = box;
  for (int side = 0; side < 6; ++side)
  {
    wide[side] += side % 2 ? mm : -mm;
  }
  return wide;
}

Extent restExtent(const WholeVolume& volume, const Lattice* lattice, const Box& part, double haloMm)
{
  return restExtent(volume, lattice, inGrid(volume.grid, part), haloMm);
}

void followBox(
  Extent& wanted, const WholeVolume& volume, const Lattice* lattice, const Box& part, double haloMm)
{
  const Extent most = restExtent(volume, lattice, part, 2.0 * haloMm);
  if (!holds(wanted, restExtent(volume, lattice, part, 0.0)) || !holds(most, wanted))
  {
    wanted = restExtent(volume, lattice, part, haloMm);
  }
}
}
