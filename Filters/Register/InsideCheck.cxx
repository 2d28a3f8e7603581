// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/InsideCheck.h"

#include "Filters/Register/RefinementSteps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int PointsBeside = 4;        // so far from the result its cost is compared with
constexpr std::size_t Comparisons = 7; // as it is, and along both directions of each axis
constexpr double LeastSamples = 300.0;
constexpr double Finer = 0.5;  // times the spacing, if there are too few samples
constexpr float Tissue = 0.1f; // differs from the air by this fraction of the range

Volume coarseVolume(const Volume& volume, double spacingMm)
{
  return sampled(volume, spacingMm, coarseGrid(volume.grid, spacingMm));
}

bool isAtBorder(const glm::ivec3& at, const glm::ivec3& sides)
{
  return glm::any(glm::equal(at, glm::ivec3(0))) || glm::any(glm::equal(at, sides - 1));
}

template <typename Visit>
void forEachPoint(const Grid& grid, const Visit& visit)
{
  glm::ivec3 at;
  for (at.z = 0; at.z < grid.dimensions.z; ++at.z)
  {
    for (at.y = 0; at.y < grid.dimensions.y; ++at.y)
    {
      for (at.x = 0; at.x < grid.dimensions.x; ++at.x)
      {
        visit(static_cast<const glm::ivec3&>(at), grid.offset(at.x, at.y, at.z));
      }
    }
  }
}

// 0 for what has the value of the border of the box and is connected to it, else 1.
Mask tissueOf(const Volume& volume)
{
  const Range range = rangeOf(volume.values);
  std::vector<float> border;
  forEachPoint(volume.grid, [&](const glm::ivec3& at, std::size_t number) {
    if (isAtBorder(at, volume.grid.dimensions))
    {
      border.push_back(range.fraction(volume.values[number]));
    }
  });
  const auto middle = border.begin() + static_cast<std::ptrdiff_t>(border.size() / 2);
  std::nth_element(border.begin(), middle, border.end());
  Volume differs = volume;
  for (float& value : differs.values)
  {
    value = std::abs(range.fraction(value) - *middle) > Tissue ? 1.0f : 0.0f;
  }
  return sweptRegion(differs);
}

// Points of a volume that lie so far (mm) or more within its tissue.
Mask farWithin(const Volume& volume, double mm)
{
  const Mask tissue = tissueOf(volume);
  const Volume weights = weightsOf(volume.grid, { nullptr, &tissue, {} }, {});
  Mask result{ volume.grid, std::vector<char>(volume.values.size()) };
  const auto invert = [](float value) { return static_cast<char>(value > 0.0f ? 0 : 1); };
  std::transform(weights.values.begin(), weights.values.end(), result.inside.begin(), invert);
  growMask(result, mm);
  std::transform(result.inside.begin(), result.inside.end(), result.inside.begin(), invert);
  return result;
}
}

InsideCheck::InsideCheck(
  const RegisteredPair& pair, const Lattice& result, const RefinementLevel& level)
  : Whole(pair)
  , Result(result)
  , Now(withinMemory(level, pair.rest.grid))
{
}

void InsideCheck::read()
{
  this->Pair.rest = coarseVolume(this->Whole.rest, this->Now.spacingMm);
  this->Pair.reference = coarseVolume(this->Whole.reference, this->Now.spacingMm);
  this->Pair.cavity = this->Whole.cavity;
  this->Pair.referenceUnknown = this->Whole.referenceUnknown;
  Mask inside = farWithin(this->Pair.rest, this->besideMm());
  const Region asked{ nullptr, orNull(this->Whole.inside), { orNull(this->Whole.restUnknown) } };
  const Volume weights = weightsOf(inside.grid, asked, {});
  for (std::size_t i = 0; i < inside.inside.size(); ++i)
  {
    inside.inside[i] = inside.inside[i] && weights.values[i] > 0.0f ? 1 : 0;
  }
  this->Pair.inside = std::move(inside);
  ComparedRegion region(this->Pair, RefinementPlan{});
  if (this->IsFiner)
  {
    region.crop(this->Pair, this->Result);
    this->IsFinished = !region.allowsFiner(this->Now);
  }
  this->Level = std::make_unique<PyramidLevel>(this->Pair, region, this->Now, this->Result);
}

// Where there are too few samples, it begins again with a finer spacing. False: there is none.
bool InsideCheck::compare()
{
  const std::size_t number = this->Costs.size();
  Controls at = RefinementState(this->Result, {}).controls;
  if (number > 0)
  {
    glm::vec3 beside(0.0f);
    const int axis = static_cast<int>(number - 1) / 2;
    beside[axis] = static_cast<float>(number % 2 ? this->besideMm() : -this->besideMm());
    for (glm::vec3& control : at)
    {
      control += beside;
    }
  }
  const CostAndForces found = this->Level->compare(at);
  if (found.samples >= LeastSamples)
  {
    this->Costs.push_back(found.cost);
    return this->Costs.size() < Comparisons;
  }
  RefinementLevel finer = this->Now;
  finer.spacingMm *= Finer;
  const Grid& whole = this->Whole.rest.grid;
  const bool isFiner =
    coarseGrid(whole, finer.spacingMm).spacing != coarseGrid(whole, this->Now.spacingMm).spacing;
  // The outline is found in all of the volume.
  const bool isSmall = withinMemory(finer, whole).spacingMm == finer.spacingMm;
  this->Now = finer;
  this->IsFiner = true;
  this->Level = nullptr;
  this->Costs.clear();
  return isFiner && isSmall;
}

bool InsideCheck::step()
{
  if (this->IsFinished)
  {
    return false;
  }
  if (!this->Level)
  {
    this->read();
  }
  else if (!this->Level->isPrepared())
  {
    this->Level->prepare();
  }
  else
  {
    this->IsFinished = !this->compare();
  }
  return !this->IsFinished;
}

double InsideCheck::besideMm() const
{
  return PointsBeside * this->Now.spacingMm;
}

std::optional<double> InsideCheck::gain() const
{
  if (this->Costs.size() < Comparisons)
  {
    return {};
  }
  const double beside = std::accumulate(this->Costs.begin() + 1, this->Costs.end(), 0.0) /
    static_cast<double>(Comparisons - 1);
  const double gain = beside > 0.0 ? 1.0 - this->Costs.front() / beside : 0.0;
  return std::isfinite(beside) && std::isfinite(gain) ? std::optional<double>(gain) : std::nullopt;
}
}
