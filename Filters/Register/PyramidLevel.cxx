// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/PyramidLevel.h"

#include "Filters/Deformation/LatticeExtremes.h"

#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double BlockMm = 1.0;

enum State : char
{
  Inside = 0,
  Empty = 1,   // all of its voxels have the lowest value
  Outside = 2, // the same, and connected to the border
};

// So many voxels of a grid make one block.
glm::ivec3 voxelsPerBlock(const Grid& grid)
{
  return glm::max(glm::ivec3(glm::round(BlockMm / grid.spacing)), glm::ivec3(1));
}

bool isEmpty(const Volume& volume, const glm::ivec3& first, const glm::ivec3& perBlock, float low)
{
  const glm::ivec3 end = glm::min(first + perBlock, volume.grid.dimensions);
  for (int k = first.z; k < end.z; ++k)
  {
    for (int j = first.y; j < end.y; ++j)
    {
      const float* row = &volume.values[volume.grid.offset(0, j, k)];
      if (std::any_of(row + first.x, row + end.x, [low](float value) { return value > low; }))
      {
        return false;
      }
    }
  }
  return true;
}

Mask emptyBlocks(const Volume& volume)
{
  const glm::ivec3 perBlock = voxelsPerBlock(volume.grid);
  Mask blocks;
  blocks.grid = volume.grid.ofBlocks(perBlock);
  blocks.inside.assign(blocks.grid.count(), Inside);
  const float low = *std::min_element(volume.values.begin(), volume.values.end());
  parallelFor(0, blocks.grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j < blocks.grid.dimensions.y; ++j)
      {
        for (int i = 0; i < blocks.grid.dimensions.x; ++i)
        {
          blocks.inside[blocks.grid.offset(i, j, k)] =
            isEmpty(volume, glm::ivec3(i, j, k) * perBlock, perBlock, low) ? Empty : Inside;
        }
      }
    }
  });
  return blocks;
}

// Turns empty blocks at the border, and those connected to them, into outside ones.
void floodFromBorder(Mask& blocks)
{
  const glm::ivec3 sides = blocks.grid.dimensions;
  const auto at = [&](const glm::ivec3& index) -> char& {
    return blocks.inside[blocks.grid.offset(index.x, index.y, index.z)];
  };
  std::vector<glm::ivec3> open;
  const auto take = [&](const glm::ivec3& index) {
    if (at(index) == Empty)
    {
      at(index) = Outside;
      open.push_back(index);
    }
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    glm::ivec3 index;
    for (index[u] = 0; index[u] < sides[u]; ++index[u])
    {
      for (index[v] = 0; index[v] < sides[v]; ++index[v])
      {
        for (const int end : { 0, sides[axis] - 1 })
        {
          index[axis] = end;
          take(index);
        }
      }
    }
  }
  while (!open.empty())
  {
    const glm::ivec3 index = open.back();
    open.pop_back();
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int direction : { -1, 1 })
      {
        glm::ivec3 next = index;
        next[axis] += direction;
        if (next[axis] >= 0 && next[axis] < sides[axis])
        {
          take(next);
        }
      }
    }
  }
}
}

Mask sweptRegion(const Volume& ultrasound)
{
  Mask blocks = emptyBlocks(ultrasound);
  floodFromBorder(blocks);
  Volume outside{ blocks.grid, std::vector<float>(blocks.inside.size()) };
  std::transform(blocks.inside.begin(), blocks.inside.end(), outside.values.begin(),
    [](char state) { return state == Outside ? 1.0f : 0.0f; });
  // The blocks beside them are full in part.
  boxSum(outside, glm::ivec3(1));
  std::transform(outside.values.begin(), outside.values.end(), blocks.inside.begin(),
    [](float neighbours) { return static_cast<char>(neighbours < 0.5f ? 1 : 0); });
  return blocks;
}

namespace
{
using Box = std::array<glm::dvec3, 2>; // its lowest and its highest corner

Box emptyBox()
{
  const glm::dvec3 most(std::numeric_limits<double>::max());
  return { most, -most };
}

void addTo(Box& box, const glm::dvec3& point)
{
  box = { glm::min(box[0], point), glm::max(box[1], point) };
}

// The box of what is inside, in points of a grid.
Box boxOf(const Mask& region, const Grid& grid)
{
  Box box = emptyBox();
  const glm::ivec3 sides = region.grid.dimensions;
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      const char* row = &region.inside[region.grid.offset(0, j, k)];
      const char* first = std::find_if(row, row + sides.x, [](char in) { return in != 0; });
      if (first == row + sides.x)
      {
        continue;
      }
      const char* last = row + sides.x - 1;
      for (; *last == 0; --last)
      {
      }
      for (const char* end : { first, last })
      {
        addTo(box, grid.gridFromWorld(region.grid.worldFromGrid({ end - row, j, k })));
      }
    }
  }
  return box;
}

// The part of a grid within a margin of a box, both in points; the whole grid if they do not meet.
Grid croppedTo(const Grid& grid, const Box& box, const glm::dvec3& margin)
{
  const glm::dvec3 last(grid.dimensions - 1);
  const glm::ivec3 first(glm::clamp(glm::floor(box[0] - margin), glm::dvec3(0.0), last));
  const glm::ivec3 end(glm::clamp(glm::ceil(box[1] + margin), glm::dvec3(0.0), last));
  if (glm::any(glm::lessThanEqual(end, first)))
  {
    return grid;
  }
  Grid result = grid;
  result.origin = grid.worldFromGrid(first);
  result.dimensions = end - first + 1;
  return result;
}
}

Grid croppedTo(const Grid& grid, const Mask& region, double marginMm)
{
  return croppedTo(grid, boxOf(region, grid), marginMm / grid.spacing);
}

namespace
{
// Of a level that is checked: a self-similarity takes 208 bytes for each.
constexpr double MostPoints = 4e6;
constexpr double MostFinerPoints = 1e6; // of one that is finer than the plan's

// Points beyond the box of what counts: the support of a metric, and where a check moves samples.
constexpr double MarginPoints = 12.0;

// Most samples of tissue on a capped level, so that a step stays short and memory small. Air costs
// little.
constexpr double MostSamples = 0.95e6;

// A level that is not finer than the former one by this factor in volume adds nothing.
constexpr double FinerVolume = 0.8;

constexpr double LeastShare = 0.25;   // fraction of a volume that is taken for tissue
constexpr float BrightestAir = 0.05f; // fraction of the range of values

// Between the middles of a fan and of the tissue; less tells no direction. On two heads it is 43 mm
// or more.
constexpr double LeastInwardsMm = 20.0;

constexpr double Coarser = 1.02; // times the spacing

// The spacing of a level, raised until its number of samples is allowed.
double spacingOf(const RefinementLevel& level, const Grid& rest, double tissueFraction)
{
  double spacingMm = level.spacingMm;
  while (level.isCapped &&
    tissueFraction * static_cast<double>(coarseGrid(rest, spacingMm).count()) > MostSamples)
  {
    spacingMm *= Coarser;
  }
  return spacingMm;
}

// The centre of the voxels that are inside (mm, world); that of the grid if there are none.
glm::dvec3 middleOf(const Mask& mask)
{
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t i = 0; i < mask.inside.size(); ++i)
  {
    if (mask.inside[i])
    {
      const int row = static_cast<int>(i) / mask.grid.dimensions.x;
      sum += glm::dvec3(static_cast<int>(i) % mask.grid.dimensions.x, row % mask.grid.dimensions.y,
        row / mask.grid.dimensions.y);
      count += 1.0;
    }
  }
  return mask.grid.worldFromGrid(
    count > 0.0 ? sum / count : 0.5 * glm::dvec3(mask.grid.dimensions - 1));
}

double tissueFractionOf(const std::vector<float>& values)
{
  const Range range = rangeOf(values);
  const auto isTissue = [&](float value) { return range.fraction(value) > BrightestAir; };
  const double count = static_cast<double>(std::count_if(values.begin(), values.end(), isTissue));
  return std::max(LeastShare, count / std::max<std::size_t>(1, values.size()));
}

// The tissue of a volume, on blocks of about 4 mm.
Mask coarseTissue(const Volume& volume)
{
  constexpr double CoarseMm = 4.0;
  const glm::ivec3 every =
    glm::max(glm::ivec3(glm::round(CoarseMm / volume.grid.spacing)), glm::ivec3(1));
  Mask tissue;
  tissue.grid = volume.grid.ofBlocks(every);
  tissue.inside.reserve(tissue.grid.count());
  std::vector<float> some;
  some.reserve(tissue.grid.count());
  const glm::ivec3 sides = tissue.grid.dimensions;
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      for (int i = 0; i < sides.x; ++i)
      {
        some.push_back(volume.values[volume.grid.offset(i * every.x, j * every.y, k * every.z)]);
      }
    }
  }
  const Range range = rangeOf(some);
  for (const float value : some)
  {
    tissue.inside.push_back(range.fraction(value) > BrightestAir ? 1 : 0);
  }
  return tissue;
}

double boxVolume(const Grid& grid)
{
  const glm::dvec3 sides = grid.spacing * glm::dvec3(grid.dimensions - 1);
  return sides.x * sides.y * sides.z;
}

// The reference on a grid, smoothly continued beyond what is known of it: a mean of what lies
// inside, by a Gaussian as for any volume, then by boxes as far as descriptors reach.
Volume filledAround(const Volume& reference, const Region& known, double spacingMm, const Grid& to)
{
  Volume inside = weightsOf(reference.grid, known, {});
  Volume values = reference;
  for (std::size_t i = 0; i < values.values.size(); ++i)
  {
    values.values[i] *= inside.values[i];
  }
  values = sampled(values, spacingMm, to);
  inside = sampled(inside, spacingMm, to);
  constexpr float Enough = 0.25f; // of the weight: the mean is of what lies nearby
  Volume result = values;
  std::vector<char> open(result.values.size(), 1);
  for (const int radius : { 0, 1, 2, 4, 8 })
  {
    Volume sums = values;
    Volume weights = inside;
    boxSum(sums, glm::ivec3(radius));
    boxSum(weights, glm::ivec3(radius));
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      if (open[i] && weights.values[i] > Enough)
      {
        result.values[i] = sums.values[i] / weights.values[i];
        open[i] = 0;
      }
    }
  }
  return result;
}
}

ComparedRegion::ComparedRegion(const RegisteredPair& pair, const RefinementPlan& plan)
  : Rest(pair.rest.grid)
  , TissueFraction(tissueFractionOf(pair.rest.values))
  , Stiffness(plan.stiffness)
  , Limits(plan.fan)
  , Middle(Rest.worldFromGrid(0.5 * glm::dvec3(Rest.dimensions - 1)))
{
}

void ComparedRegion::find(const RegisteredPair& pair, const Grid& lattice)
{
  this->Fan = sweptRegion(pair.reference);
  const double voxels = static_cast<double>(
    std::count(this->Fan.inside.begin(), this->Fan.inside.end(), static_cast<char>(1)));
  this->BoxMm3 = boxVolume(lattice);
  this->FanMm3 = std::min(pointVolume(this->Fan.grid) * voxels, this->BoxMm3);
  this->Middle = middleOf(this->Fan);
  const glm::dvec3 inwards = middleOf(coarseTissue(pair.rest)) - this->Middle;
  const double away = glm::length(inwards);
  this->Beam = away > LeastInwardsMm ? inwards / away : glm::dvec3(0.0);
}

double ComparedRegion::spacingMm(const RefinementLevel& level) const
{
  return this->Limits
    ? std::max(level.spacingMm, std::cbrt(this->FanMm3 / this->Limits->mostSamples))
    : spacingOf(level, this->Rest, this->TissueFraction);
}

double ComparedRegion::finestSpacingMm(const RefinementLevel& level, const Grid& rest)
{
  return spacingOf(level, rest, LeastShare);
}

Grid ComparedRegion::grid(const RefinementLevel& level) const
{
  Grid grid = coarseGrid(this->Rest, this->spacingMm(level));
  if (this->Counting)
  {
    if (glm::any(glm::greaterThan(this->Counting->front(), this->Counting->back())))
    {
      grid.dimensions = glm::ivec3(2); // nothing counts
      return grid;
    }
    const auto points = [&](const glm::dvec3& mm) { return mm / grid.spacing; };
    const Box box{ points(this->Counting->front()), points(this->Counting->back()) };
    return croppedTo(grid, box, glm::dvec3(MarginPoints));
  }
  return this->Limits ? croppedTo(grid, this->Fan, this->Limits->marginMm) : grid;
}

void ComparedRegion::crop(const RegisteredPair& pair, const Lattice& bent)
{
  if (this->Limits)
  {
    return;
  }
  Grid mm = this->Rest;
  mm.spacing = glm::dvec3(1.0);
  const glm::dvec3 moved(maximumDisplacement(bent));
  Box box = emptyBox();
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 last(pair.reference.grid.dimensions - 1);
    addTo(box, mm.gridFromWorld(pair.reference.grid.worldFromGrid(upper * last)));
  }
  box = { box[0] - moved, box[1] + moved };
  if (const Mask* inside = orNull(pair.inside))
  {
    const Box counts = boxOf(*inside, mm);
    box = { glm::max(box[0], counts[0]), glm::min(box[1], counts[1]) };
  }
  this->Counting = { box[0] - moved, box[1] + moved };
}

bool ComparedRegion::allowsFiner(const RefinementLevel& level) const
{
  return static_cast<double>(this->grid(level).count()) <= MostFinerPoints;
}

RefinementLevel withinMemory(const RefinementLevel& level, const Grid& rest)
{
  RefinementLevel result = level;
  while (static_cast<double>(coarseGrid(rest, result.spacingMm).count()) > MostPoints)
  {
    result.spacingMm *= Coarser;
  }
  return result;
}

bool ComparedRegion::isWorthwhile(
  const RefinementLevel& level, const RefinementLevel& former, double cost) const
{
  return level.mostCost >= 1.0 ||
    (cost <= level.mostCost &&
      pointVolume(this->grid(level)) < FinerVolume * pointVolume(this->grid(former)));
}

double ComparedRegion::stiffness() const
{
  return this->Limits ? this->Stiffness * this->BoxMm3 / std::max(1.0, this->FanMm3)
                      : this->Stiffness;
}

double ComparedRegion::overlap(const CostAndForces& compared, const Grid& samples) const
{
  return this->Limits
    ? std::min(1.0, compared.samples * pointVolume(samples) / std::max(1.0, this->FanMm3))
    : compared.samples / std::max(1.0, compared.possible);
}

PyramidLevel::PyramidLevel(const RegisteredPair& pair, const ComparedRegion& region,
  const RefinementLevel& level, const Lattice& lattice)
  : Pair(pair)
  , Fan(region.fan())
  , Beam(region.beam())
  , Compares(level.metric)
  , Taken(level.part)
  , SpacingMm(region.spacingMm(level))
  , Samples(region.grid(level))
  , Over(lattice)
{
}

void PyramidLevel::prepare()
{
  using Part = void (PyramidLevel::*)();
  constexpr Part Parts[] = { &PyramidLevel::readRest, &PyramidLevel::readReference,
    &PyramidLevel::weighRest, &PyramidLevel::weighReference, &PyramidLevel::makeComparison };
  if (this->PartsDone < std::size(Parts))
  {
    (this->*Parts[this->PartsDone++])();
  }
  else
  {
    this->IsPrepared = this->Compared->prepare();
  }
}

void PyramidLevel::readRest()
{
  this->Volumes.rest = sampled(this->Pair.rest, this->SpacingMm, this->Samples);
}

// With a fan, what a cavity holds has no part in the means over all of the reference, such as the
// noise.
void PyramidLevel::readReference()
{
  const Region known{ nullptr, this->Fan,
    { orNull(this->Pair.cavity), orNull(this->Pair.referenceUnknown) } };
  this->Volumes.reference = this->Fan
    ? filledAround(this->Pair.reference, known, this->SpacingMm, this->Samples)
    : sampled(this->Pair.reference, this->SpacingMm, this->Samples);
}

// Beyond a fan the reference goes on smoothly, and beyond a mask the volume has its tissue. So only
// what is missing counts with all of a descriptor's support if the reference is ultrasound.
Volume PyramidLevel::weights(const Region& seen, const Region& known) const
{
  if (!this->Fan)
  {
    return weightsOf(
      this->Samples, { seen.grid, seen.inside, known.outside }, this->Compares->support);
  }
  Volume result = weightsOf(this->Samples, seen, { 1, 1 });
  const Volume whole = weightsOf(this->Samples, known, this->Compares->support);
  std::transform(result.values.begin(), result.values.end(), whole.values.begin(),
    result.values.begin(), std::multiplies<>());
  return result;
}

void PyramidLevel::weighRest()
{
  this->Volumes.restWeights = this->weights({ nullptr, orNull(this->Pair.inside), {} },
    { nullptr, nullptr, { orNull(this->Pair.restUnknown) } });
}

void PyramidLevel::weighReference()
{
  this->Volumes.referenceWeights = this->weights({ &this->Pair.reference.grid, this->Fan, {} },
    { nullptr, nullptr, { orNull(this->Pair.cavity), orNull(this->Pair.referenceUnknown) } });
}

void PyramidLevel::makeComparison()
{
  this->Volumes.beam = this->Beam;
  this->Compared = this->Compares->make(std::move(this->Volumes), this->Over);
  this->Compared->take(this->Taken);
}

void PyramidLevel::become(const RefinementLevel& level)
{
  this->Compared->take(level.part);
  this->IsPrepared = false;
}

double PyramidLevel::bytes(
  const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementLevel& level)
{
  const Grid samples = coarseGrid(rest, ComparedRegion::finestSpacingMm(level, rest));
  const double points = static_cast<double>(samples.count());
  // One of the two is smoothed at a time, with the lines that are smoothed beside it.
  const double smoothing = sizeof(float) * 2.0 * std::max(rest.count(), reference.count());
  return smoothing + level.metric->bytesPerPoint * points + 4.0 * sizeof(float) * points +
    LatticeRows::bytes(lattice.dimensions, samples.dimensions);
}
}
