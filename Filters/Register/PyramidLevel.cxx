// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/PyramidLevel.h"

#include "Filters/Register/LatticeRows.h"
#include "Filters/Register/Sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
// So that a step stays short and memory small: of samples of tissue on a level that may be left
// out. Air costs little.
constexpr double MostSamples = 0.95e6;
constexpr double LeastTissue = 0.25; // fraction of a volume that is taken for tissue
constexpr float Air = 0.05f;         // fraction of the range of values

// As fine as a level asks for and the number of its samples allows.
double spacingOf(const RefinementLevel& level, const Grid& rest, double tissueFraction)
{
  constexpr double Coarser = 1.02;
  double spacingMm = level.spacingMm;
  while (level.mostCost < 1.0 &&
    tissueFraction * static_cast<double>(coarseGrid(rest, spacingMm).count()) > MostSamples)
  {
    spacingMm *= Coarser;
  }
  return spacingMm;
}

double tissueFractionOf(const std::vector<float>& values)
{
  const Range range = rangeOf(values);
  const auto isTissue = [&](float value) { return range.fraction(value) > Air; };
  const double count = static_cast<double>(std::count_if(values.begin(), values.end(), isTissue));
  return std::max(LeastTissue, count / std::max<std::size_t>(1, values.size()));
}

double boxVolume(const Grid& grid)
{
  const glm::dvec3 sides = grid.spacing * glm::dvec3(grid.dimensions - 1);
  return sides.x * sides.y * sides.z;
}

const Mask* orNull(const Mask& mask)
{
  return mask.inside.empty() ? nullptr : &mask;
}
}

ComparedRegion::ComparedRegion(const RegisteredPair& pair, const RefinementPlan& plan)
  : Rest(pair.rest.grid)
  , TissueFraction(tissueFractionOf(pair.rest.values))
  , Stiffness(plan.stiffness)
  , Limits(plan.fan)
{
}

void ComparedRegion::find(const Volume& reference, const Grid& lattice)
{
  this->Fan = sweptRegion(reference);
  const double voxels = static_cast<double>(
    std::count(this->Fan.inside.begin(), this->Fan.inside.end(), static_cast<char>(1)));
  this->BoxMm3 = boxVolume(lattice);
  this->FanMm3 = std::min(pointVolume(this->Fan.grid) * voxels, this->BoxMm3);
}

double ComparedRegion::spacingMm(const RefinementLevel& level) const
{
  return this->Limits
    ? std::max(level.spacingMm, std::cbrt(this->FanMm3 / this->Limits->mostSamples))
    : spacingOf(level, this->Rest, this->TissueFraction);
}

double ComparedRegion::finestSpacingMm(const RefinementLevel& level, const Grid& rest)
{
  return spacingOf(level, rest, LeastTissue);
}

Grid ComparedRegion::grid(const RefinementLevel& level) const
{
  const Grid grid = coarseGrid(this->Rest, this->spacingMm(level));
  return this->Limits ? croppedTo(grid, this->Fan, this->Limits->marginMm) : grid;
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
  , Compares(level.metric)
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
  this->Volumes.rest = resampled(smoothed(this->Pair.rest, this->SpacingMm), this->Samples);
}

void PyramidLevel::readReference()
{
  this->Volumes.reference =
    resampled(smoothed(this->Pair.reference, this->SpacingMm), this->Samples);
}

void PyramidLevel::weighRest()
{
  this->Volumes.restWeights = weightsOf(
    this->Samples, { nullptr, orNull(this->Pair.inside), nullptr }, this->Compares->support);
}

void PyramidLevel::weighReference()
{
  this->Volumes.referenceWeights = weightsOf(this->Samples,
    { &this->Pair.reference.grid, this->Fan, orNull(this->Pair.cavity) }, this->Compares->support);
}

void PyramidLevel::makeComparison()
{
  this->Compared = this->Compares->make(std::move(this->Volumes), this->Over);
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
