// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/FittedLattice.h"

#include "Common/Numbers.h"
#include "Common/Parallel.h"
#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Kernels.h"

#include <iterator>

namespace brainshift
{
namespace
{
constexpr std::int64_t TracesAtLeast = 32; // for a thread: about 0.1 ms

// World positions (mm) of all points of a grid, x fastest.
std::vector<glm::dvec3> positionsOf(const Grid& grid)
{
  std::vector<glm::dvec3> positions;
  positions.reserve(grid.count());
  forEachIndex(glm::ivec3(0), grid.dimensions - 1,
    [&](const glm::ivec3& index) { positions.push_back(grid.worldFromGrid(glm::dvec3(index))); });
  return positions;
}
}

void addField(Lattice& lattice, const Process& field)
{
  std::vector<glm::dvec3> values = field.displacements(positionsOf(lattice.grid));
  if (lattice.kernel == KernelBSpline)
  {
    toBSplineCoefficients(lattice.grid, values);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    lattice.displacements[i] += glm::vec3(values[i]);
  }
}

double fractionWithoutFolds(const Lattice& start, const Lattice& end, int samples)
{
  FoldGuard guard;
  guard.setBase(start, samples);
  return guard.fraction(start, end);
}

void FittedLattice::solveWith(
  double relaxation, const Measurements& measured, const RestSurface& surface, const Process* start)
{
  FitSettings settings;
  settings.relaxation = relaxation;
  this->Relaxation = relaxation;
  this->Result.solve(measured, settings, surface, start);
  this->Bent = this->Start;
  addField(this->Bent, this->Result.field());
  requireDisplacements(this->Bent, "the fit");
}

void FittedLattice::solve(const Measurements& measured, const RestSurface& surface,
  const Lattice& lattice, const LatticeFitChoices& choices)
{
  this->Map.reset();
  this->Start = measured.base ? measured.base->lattice : makeLattice(lattice.grid, lattice.kernel);
  this->Start.mask = lattice.mask;
  this->Fraction = 1.0;
  const auto findFraction = [&] {
    return fractionWithoutFolds(this->Start, this->Bent, choices.samples);
  };
  this->solveWith(1.0, measured, surface, choices.start);
  if (choices.guards && findFraction() < 1.0)
  {
    this->solveWith(Relaxed, measured, surface, choices.start);
    this->Fraction = findFraction();
    this->Bent = between(this->Start, this->Bent, this->Fraction);
  }
  this->Map.emplace(this->Bent);
}

glm::dvec3 FittedLattice::measuredFromRest(const glm::dvec3& rest) const
{
  return this->Result.rigid().apply(this->Map ? this->Map->deformedFromRest(rest) : rest);
}

std::vector<double> FittedLattice::deviations(const std::vector<glm::dvec3>& rest) const
{
  std::vector<double> result = this->Result.deviations(rest);
  this->countWhatIsAway(rest, result);
  return result;
}

std::vector<double> FittedLattice::deviations(
  const std::vector<glm::dvec3>& rest, const std::vector<double>& variances) const
{
  std::vector<double> result;
  std::transform(variances.begin(), variances.end(), rest.begin(), std::back_inserter(result),
    [this](
      double variance, const glm::dvec3& at) { return this->Result.deviationOf(variance, at); });
  this->countWhatIsAway(rest, result);
  return result;
}

void FittedLattice::countWhatIsAway(
  const std::vector<glm::dvec3>& rest, std::vector<double>& deviations) const
{
  const std::vector<glm::dvec3> bends = this->Result.bends(rest);
  for (std::size_t i = 0; i < rest.size(); ++i)
  {
    const double away = glm::distance(
      this->measuredFromRest(rest[i]), this->Result.rigid().apply(rest[i] + bends[i]));
    deviations[i] = withDistance(deviations[i], away);
  }
}

double withDistance(double deviation, double distance)
{
  return std::hypot(deviation, distance / std::sqrt(3.0));
}

std::vector<double> FittedLattice::residuals(const std::vector<PointPair>& pairs) const
{
  std::vector<double> result;
  for (const PointPair& pair : pairs)
  {
    const double miss = glm::distance(this->measuredFromRest(pair.rest), pair.measured);
    result.push_back(pair.weight > 0.0 ? miss : NaN);
  }
  return result;
}

std::vector<double> FittedLattice::traceResiduals(
  const std::vector<glm::dvec3>& traces, const RestSurface& surface) const
{
  std::vector<double> result(traces.size(), NaN);
  if (!this->Map || !surface)
  {
    return result;
  }
  const PointMap& map = *this->Map;
  const auto count = static_cast<std::int64_t>(traces.size());
  parallelFor(0, count, TracesAtLeast, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      const auto foot = surface(map.restFromDeformed(traces[i]), i);
      if (foot)
      {
        const glm::dmat3 turn = glm::transpose(glm::inverse(map.jacobian(foot->position)));
        result[i] = glm::dot(
          glm::normalize(turn * foot->normal), traces[i] - map.deformedFromRest(foot->position));
      }
    }
  });
  return result;
}

double rootMeanSquare(const std::vector<double>& numbers)
{
  double squares = 0.0;
  double count = 0.0;
  for (const double number : numbers)
  {
    squares += std::isfinite(number) ? number * number : 0.0;
    count += std::isfinite(number) ? 1.0 : 0.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : NaN;
}

std::vector<float> LatticeEvidence::deviations(const FittedLattice& fitted)
{
  const Grid& grid = fitted.lattice().grid;
  if (grid.count() > MostEvidencePoints)
  {
    throw Problem("The uncertainty is not computed: the lattice has " +
      std::to_string(grid.count()) + " control points; it may have at most " +
      std::to_string(MostEvidencePoints));
  }
  const std::vector<glm::dvec3> positions = positionsOf(grid);
  std::vector<double> key = fitted.fit().field().covarianceKey();
  const bool isKnown = !this->Variances.empty() && grid == this->Points;
  if (!isKnown || (!this->Live && key != this->Key))
  {
    this->Variances = fitted.fit().field().variances(positions);
    this->Key = std::move(key);
    this->Points = grid;
    ++this->Solutions;
  }
  const std::vector<double> deviations = fitted.deviations(positions, this->Variances);
  return { deviations.begin(), deviations.end() };
}
}
