// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/BlockCheck.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr double SpacingMm = 2.0;
constexpr int BlockPoints = 6;    // along each axis
constexpr int BlockSteps = 4;     // points from a block to the next: they overlap
constexpr int FarthestPoints = 6; // of a shift, along each axis

// Enough tissue: of the points of a block, and of those a partner in the reference.
constexpr double LeastTissue = 0.7;
constexpr double LeastPartners = 0.75;

// A block matches much better elsewhere if it costs more here than so much of what it costs at
// positions far off, and elsewhere less than so much of that.
constexpr float LeastHere = 0.3f;
constexpr float MostThere = 0.75f;
constexpr double MostSearched = 0.0625; // of the blocks, those that match worst
constexpr double FewSearched = 100.0;   // blocks: never fewer
constexpr int LeastFar = 3;             // positions far off

constexpr double Agreeing = 2.25;      // points: shifts of blocks side by side differ by less
constexpr std::size_t LeastBlocks = 8; // side by side, that agree

constexpr double BorderMm = SpacingMm; // of a volume, where smoothing reads what is beyond

constexpr int PartsBefore = 4; // of the work, before blocks are compared

// Points side by side say nearly the same, so a block takes every second one, a checkerboard.
bool isTaken(const glm::ivec3& at)
{
  return (at.x + at.y + at.z) % 2 == 0;
}

template <typename Visit>
void forEachIndex(const glm::ivec3& first, const glm::ivec3& last, const Visit& visit)
{
  glm::ivec3 at;
  for (at.z = first.z; at.z <= last.z; ++at.z)
  {
    for (at.y = first.y; at.y <= last.y; ++at.y)
    {
      for (at.x = first.x; at.x <= last.x; ++at.x)
      {
        visit(static_cast<const glm::ivec3&>(at));
      }
    }
  }
}

bool isWithin(const glm::ivec3& at, const glm::ivec3& sides)
{
  return glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) && glm::all(glm::lessThan(at, sides));
}

// The number of a point, x fastest; of a shift, by how much it changes numbers.
std::ptrdiff_t stepsTo(const glm::ivec3& at, const glm::ivec3& sides)
{
  return (static_cast<std::ptrdiff_t>(at.z) * sides.y + at.y) * sides.x + at.x;
}

glm::ivec3 indexOf(std::size_t number, const glm::ivec3& sides)
{
  const int row = static_cast<int>(number) / sides.x;
  return { static_cast<int>(number) % sides.x, row % sides.y, row / sides.y };
}

// The grid without its points near the border, but for two along each axis.
Grid without(Grid grid, double borderMm)
{
  const glm::ivec3 points =
    glm::min(glm::ivec3(glm::ceil(borderMm / grid.spacing)), (grid.dimensions - 2) / 2);
  grid.origin = grid.worldFromGrid(points);
  grid.dimensions -= 2 * points;
  return grid;
}

// Four sums side by side, which the compiler makes vector instructions of.
float differenceOf(const float* a, const float* b, int numbers)
{
  constexpr int Lanes = 4;
  float sums[Lanes] = {};
  for (int i = 0; i < numbers; i += Lanes)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const float difference = a[i + lane] - b[i + lane];
      sums[lane] += difference * difference;
    }
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}
}

BlockCheck::BlockCheck(const RegisteredPair& pair, const Lattice& result, const Descriptor& by)
  : Pair(pair)
  , Result(result)
  , By(by)
{
}

void BlockCheck::read()
{
  const Grid grid = coarseGrid(this->Pair.rest.grid, SpacingMm);
  this->Rest = sampled(this->Pair.rest, SpacingMm, grid);
  this->Reference = sampled(this->Pair.reference, SpacingMm, grid);
  // The end of a volume is no edge of tissue.
  const Grid restPart = without(this->Pair.rest.grid, BorderMm);
  const Grid referencePart = without(this->Pair.reference.grid, BorderMm);
  this->RestWeights =
    weightsOf(grid, { &restPart, nullptr, { orNull(this->Pair.restUnknown) } }, this->By.support);
  const Volume asked = weightsOf(grid, { nullptr, orNull(this->Pair.inside), {} }, {});
  for (std::size_t i = 0; i < asked.values.size(); ++i)
  {
    this->RestWeights.values[i] *= asked.values[i];
  }
  this->ReferenceWeights = weightsOf(grid,
    { &referencePart, nullptr, { orNull(this->Pair.cavity), orNull(this->Pair.referenceUnknown) } },
    this->By.support);
}

// Every second point along each axis is asked how it moves, and those between are means: over 4 mm
// a bend is nearly a line.
void BlockCheck::findPlaces()
{
  const Grid& grid = this->Rest.grid;
  const glm::ivec3 last = grid.dimensions - 1;
  const glm::ivec3 asked = grid.dimensions / 2 + 1;
  std::vector<glm::vec3> motions(static_cast<std::size_t>(asked.x) * asked.y * asked.z);
  parallelFor(0, asked.z, 1, [&](std::int64_t begin, std::int64_t end) {
    forEachIndex({ 0, 0, begin }, { asked.x - 1, asked.y - 1, end - 1 }, [&](const auto& at) {
      const glm::dvec3 rest = grid.worldFromGrid(2 * at);
      motions[stepsTo(at, asked)] = displacementOfTissue(this->Result, rest);
    });
  });
  this->Places.resize(grid.count());
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    forEachIndex({ 0, 0, begin }, { last.x, last.y, end - 1 }, [&](const glm::ivec3& at) {
      const std::size_t number = grid.offset(at.x, at.y, at.z);
      if (isTaken(at) && this->RestWeights.values[number] > 0.0f)
      {
        glm::vec3 motion(0.0f);
        forEachIndex(at / 2, (at + 1) / 2,
          [&](const glm::ivec3& near) { motion += motions[stepsTo(near, asked)]; });
        const glm::ivec3 odd = at % 2;
        motion /= (1 + odd.x) * (1 + odd.y) * (1 + odd.z);
        const glm::dvec3 now = grid.worldFromGrid(at) + glm::dvec3(motion);
        this->Places[number] = glm::ivec3(glm::round(grid.gridFromWorld(now)));
      }
    });
  });
}

void BlockCheck::layBlocks()
{
  this->Sides = glm::max((this->Rest.grid.dimensions - BlockPoints + BlockSteps) / BlockSteps, 0);
  forEachIndex(glm::ivec3(0), this->Sides - 1, [&](const glm::ivec3& at) {
    Block block;
    block.first = BlockSteps * at;
    this->Blocks.push_back(block);
  });
}

BlockCheck::Tissue BlockCheck::tissueOf(const Block& block) const
{
  const Grid& grid = this->Rest.grid;
  Tissue tissue{ {}, glm::ivec3(std::numeric_limits<int>::max()),
    glm::ivec3(std::numeric_limits<int>::lowest()) };
  tissue.points.reserve(BlockPoints * BlockPoints * BlockPoints);
  int points = 0;
  forEachIndex(block.first, block.first + BlockPoints - 1, [&](const glm::ivec3& at) {
    if (isTaken(at))
    {
      ++points;
      const std::size_t number = grid.offset(at.x, at.y, at.z);
      if (this->RestWeights.values[number] > 0.0f)
      {
        const glm::ivec3& place = this->Places[number];
        tissue.points.push_back({ &this->RestNumbers[number * this->By.numbers], place,
          stepsTo(place, grid.dimensions) });
        tissue.low = glm::min(tissue.low, place);
        tissue.high = glm::max(tissue.high, place);
      }
    }
  });
  if (static_cast<double>(tissue.points.size()) < LeastTissue * points)
  {
    tissue.points.clear();
  }
  return tissue;
}

// The mean over the tissue; absent if too little of it has a partner, or if it is above `most`.
std::optional<float> BlockCheck::costAt(
  const Tissue& tissue, const glm::ivec3& shift, float most) const
{
  const glm::ivec3& sides = this->Rest.grid.dimensions;
  const bool areWithin =
    isWithin(tissue.low + shift, sides) && isWithin(tissue.high + shift, sides);
  const std::ptrdiff_t steps = stepsTo(shift, sides);
  const float points = static_cast<float>(tissue.points.size());
  const float limit = most * points;
  float sum = 0.0f;
  std::size_t compared = 0;
  for (const TissuePoint& point : tissue.points)
  {
    if (!areWithin && !isWithin(point.place + shift, sides))
    {
      continue;
    }
    const std::size_t partner = static_cast<std::size_t>(point.at + steps);
    if (this->ReferenceWeights.values[partner] > 0.0f)
    {
      ++compared;
      sum += differenceOf(
        point.numbers, &this->ReferenceNumbers[partner * this->By.numbers], this->By.numbers);
      if (sum > limit)
      {
        return {};
      }
    }
  }
  const float partners = static_cast<float>(compared);
  if (partners < LeastPartners * points || sum > most * partners)
  {
    return {};
  }
  return sum / partners;
}

// How badly a block matches where it is.
void BlockCheck::compare(Block& block) const
{
  const Tissue tissue = this->tissueOf(block);
  std::optional<float> here =
    tissue.points.empty() ? std::nullopt : this->costAt(tissue, glm::ivec3(0));
  if (!here)
  {
    return;
  }
  float far = 0.0f;
  int positions = 0;
  forEachIndex(glm::ivec3(-1), glm::ivec3(1), [&](const glm::ivec3& way) {
    here = this->costAt(tissue, way, *here).value_or(*here);
    const bool isCorner = way.x * way.y * way.z != 0;
    const std::optional<float> there =
      isCorner ? this->costAt(tissue, FarthestPoints * way) : std::nullopt;
    far += there.value_or(0.0f);
    positions += there ? 1 : 0;
  });
  block.isKnown = positions >= LeastFar && far > 0.0f;
  block.here = block.isKnown ? *here : 0.0f;
  block.part = block.isKnown ? *here * static_cast<float>(positions) / far : 0.0f;
}

void BlockCheck::search(Block& block) const
{
  if (!block.isKnown || block.part < this->LeastPart)
  {
    return;
  }
  const Tissue tissue = this->tissueOf(block);
  float least = MostThere * block.here;
  forEachIndex(
    glm::ivec3(-FarthestPoints), glm::ivec3(FarthestPoints), [&](const glm::ivec3& shift) {
      const float cost = this->costAt(tissue, shift, least).value_or(least);
      if (cost < least)
      {
        least = cost;
        block.shift = shift;
      }
    });
  // At the border of the search it may be no minimum at all.
  block.isCandidate = block.shift != glm::ivec3(0) &&
    glm::all(glm::lessThan(glm::abs(block.shift), glm::ivec3(FarthestPoints)));
}

// Where noise makes all blocks match badly, only those that match worse than most are searched.
void BlockCheck::findLeastPart()
{
  std::vector<float> parts;
  for (const Block& block : this->Blocks)
  {
    if (block.isKnown)
    {
      parts.push_back(block.part);
    }
  }
  this->LeastPart = LeastHere;
  const double searched = std::max(FewSearched, MostSearched * static_cast<double>(parts.size()));
  if (searched < static_cast<double>(parts.size()))
  {
    const auto worst = parts.end() - static_cast<std::ptrdiff_t>(searched);
    std::nth_element(parts.begin(), worst, parts.end());
    this->LeastPart = std::max(LeastHere, *worst);
  }
}

glm::dvec3 BlockCheck::shiftMm(const Block& block) const
{
  return this->Rest.grid.spacing * glm::dvec3(block.shift);
}

glm::dvec3 BlockCheck::middleOf(const Block& block) const
{
  return this->Rest.grid.worldFromGrid(glm::dvec3(block.first) + 0.5 * glm::dvec3(BlockPoints - 1));
}

// The blocks that are connected to one through neighbours with nearly the same shift.
std::vector<std::size_t> BlockCheck::connectedTo(std::size_t first, std::vector<char>& isSeen) const
{
  std::vector<std::size_t> found{ first };
  isSeen[first] = 1;
  for (std::size_t next = 0; next < found.size(); ++next)
  {
    const glm::ivec3 at = indexOf(found[next], this->Sides);
    const glm::dvec3 shift(this->Blocks[found[next]].shift);
    for (int side = 0; side < 6; ++side)
    {
      glm::ivec3 beside = at;
      beside[side / 2] += side % 2 ? 1 : -1;
      const auto number = static_cast<std::size_t>(stepsTo(beside, this->Sides));
      if (isWithin(beside, this->Sides) && !isSeen[number] && this->Blocks[number].isCandidate &&
        glm::distance(glm::dvec3(this->Blocks[number].shift), shift) < Agreeing)
      {
        isSeen[number] = 1;
        found.push_back(number);
      }
    }
  }
  return found;
}

void BlockCheck::count()
{
  std::vector<char> isSeen(this->Blocks.size(), 0);
  std::size_t counted = 0;
  for (std::size_t i = 0; i < this->Blocks.size(); ++i)
  {
    if (!this->Blocks[i].isCandidate || isSeen[i])
    {
      continue;
    }
    const std::vector<std::size_t> group = this->connectedTo(i, isSeen);
    for (std::size_t j = 0; j < group.size() && group.size() >= LeastBlocks; ++j)
    {
      Block& block = this->Blocks[group[j]];
      block.isCounted = true;
      this->Found.mm += glm::length(this->shiftMm(block));
      this->Found.middle += this->middleOf(block);
      ++counted;
    }
  }
  if (counted > 0)
  {
    const double blocks = static_cast<double>(counted);
    constexpr double Mm3ForMl = 1000.0;
    this->Found.ml = blocks * std::pow(BlockSteps, 3) * pointVolume(this->Rest.grid) / Mm3ForMl;
    this->Found.mm /= blocks;
    this->Found.middle /= blocks;
  }
}

// A block that is not counted holds its surroundings still as far as it matches where it is.
double BlockCheck::weightOf(const Block& block) const
{
  constexpr double LeastWeight = 0.1;
  const double match = std::max(LeastWeight, 1.0 - static_cast<double>(block.part / LeastHere));
  return block.isCounted ? 1.0 : (block.isKnown ? match : 0.0);
}

// Two boxes after each other: weights fall to 0 over 24 mm, with a deviation of 9 mm.
void BlockCheck::blur(Volume& ofBlocks)
{
  for (int pass = 0; pass < 2; ++pass)
  {
    boxSum(ofBlocks, glm::ivec3(1));
  }
}

Controls BlockCheck::motion() const
{
  const Grid& lattice = this->Result.grid;
  Controls motion(lattice.count(), glm::vec3(0.0f));
  if (glm::any(glm::lessThan(this->Sides, glm::ivec3(2))))
  {
    return motion;
  }
  Volume weights{ this->Rest.grid, {} };
  weights.grid.origin = this->middleOf(this->Blocks.front());
  weights.grid.spacing *= BlockSteps;
  weights.grid.dimensions = this->Sides;
  std::array<Volume, 3> shifts{ weights, weights, weights };
  for (const Block& block : this->Blocks)
  {
    weights.values.push_back(static_cast<float>(this->weightOf(block)));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double mm = block.isCounted ? this->shiftMm(block)[axis] : 0.0;
      shifts[axis].values.push_back(static_cast<float>(mm));
    }
  }
  blur(weights);
  std::for_each(shifts.begin(), shifts.end(), &BlockCheck::blur);
  const glm::vec3 last(this->Sides - 1);
  for (std::size_t i = 0; i < motion.size(); ++i)
  {
    const glm::dvec3 control = lattice.worldFromGrid(indexOf(i, lattice.dimensions));
    const glm::vec3 position(weights.grid.gridFromWorld(control));
    const Neighbours at = neighboursOf(this->Sides, glm::clamp(position, glm::vec3(0.0f), last));
    const float weight = trilinear(weights.values.data(), at).value;
    for (int axis = 0; axis < 3 && weight > 0.0f; ++axis)
    {
      motion[i][axis] = trilinear(shifts[axis].values.data(), at).value / weight;
    }
  }
  return motion;
}

// Calls visit(block) for all blocks of a slab.
template <typename Visit>
void BlockCheck::visitSlab(int slab, const Visit& visit)
{
  const std::int64_t size = static_cast<std::int64_t>(this->Sides.x) * this->Sides.y;
  constexpr std::int64_t Grain = 4;
  parallelFor(slab * size, (slab + 1) * size, Grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      visit(this->Blocks[i]);
    }
  });
}

bool BlockCheck::step()
{
  const int part = this->Part++;
  const int slab = part - PartsBefore;
  if (part == 0)
  {
    this->read();
  }
  else if (part == 1)
  {
    this->RestNumbers = this->By.make(this->Rest);
  }
  else if (part == 2)
  {
    this->ReferenceNumbers = this->By.make(this->Reference);
  }
  else if (part == 3)
  {
    this->findPlaces();
    this->layBlocks();
  }
  else if (slab < this->Sides.z)
  {
    this->visitSlab(slab, [this](Block& block) { this->compare(block); });
  }
  else if (slab == this->Sides.z)
  {
    this->findLeastPart();
  }
  else if (slab <= 2 * this->Sides.z)
  {
    this->visitSlab(slab - this->Sides.z - 1, [this](Block& block) { this->search(block); });
  }
  else
  {
    this->Part = this->parts();
    if (slab == 2 * this->Sides.z + 1)
    {
      this->count();
      // The largest parts, which the refinement that goes on from here does not need.
      this->RestNumbers = {};
      this->ReferenceNumbers = {};
      this->Places = {};
    }
    return false;
  }
  return true;
}

int BlockCheck::parts() const
{
  return PartsBefore + 2 * this->Sides.z + 2;
}

double BlockCheck::done() const
{
  // The number of slabs is known after the first parts.
  return this->Part < PartsBefore ? 0.0 : static_cast<double>(this->Part) / this->parts();
}
}
