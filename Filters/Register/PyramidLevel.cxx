// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/PyramidLevel.h"

#include "Filters/Register/LatticeRows.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
const Mask* orNull(const Mask& mask)
{
  return mask.inside.empty() ? nullptr : &mask;
}
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
