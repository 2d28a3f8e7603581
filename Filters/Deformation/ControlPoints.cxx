// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/ControlPoints.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace brainshift
{
namespace
{
// A control point and how little it is wanted.
using Candidate = std::pair<double, std::size_t>;

void addBest(std::vector<Candidate> candidates, ControlPointSet& points)
{
  if (candidates.size() > MostControlPoints)
  {
    std::nth_element(candidates.begin(), candidates.begin() + MostControlPoints, candidates.end());
    candidates.resize(MostControlPoints);
  }
  for (const Candidate& candidate : candidates)
  {
    points.insert(candidate.second);
  }
}

// Control points that are drawn within a ball and wanted(index).
template <typename Wanted>
std::vector<Candidate> nearestWhere(
  const DrawnLattice& lattice, const glm::dvec3& centre, double radius, Wanted wanted)
{
  // Nothing comes from farther away than the farthest displacement.
  const glm::dvec3 reach = (radius + lattice.strength * lattice.farthest) / lattice.grid.spacing;
  const glm::dvec3 middle = lattice.grid.gridFromWorld(centre);
  const glm::dvec3 last(lattice.grid.dimensions - 1);
  const glm::ivec3 low(glm::ceil(glm::clamp(middle - reach, glm::dvec3(0.0), last + 1.0)));
  const glm::ivec3 high(glm::floor(glm::clamp(middle + reach, glm::dvec3(-1.0), last)));
  std::vector<Candidate> candidates;
  forEachIndex(low, high, [&](const glm::ivec3& index) {
    const double distance = glm::distance(lattice.deformed(index), centre);
    if (distance <= radius && wanted(index))
    {
      candidates.emplace_back(distance, lattice.grid.offset(index.x, index.y, index.z));
    }
  });
  return candidates;
}
}

double longest(const DrawnLattice& lattice)
{
  double squared = 0.0;
  for (std::size_t i = 0; i < 3 * lattice.grid.count(); i += 3)
  {
    const float* d = lattice.displacements + i;
    squared = std::max<double>(squared, d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  }
  return std::sqrt(squared);
}

glm::dvec3 DrawnLattice::rest(const glm::ivec3& index) const
{
  return this->grid.worldFromGrid(glm::dvec3(index));
}

glm::dvec3 DrawnLattice::displacement(const glm::ivec3& index) const
{
  const float* d = this->displacements + 3 * this->grid.offset(index.x, index.y, index.z);
  return this->strength * glm::dvec3(d[0], d[1], d[2]);
}

glm::dvec3 DrawnLattice::deformed(const glm::ivec3& index) const
{
  return this->rest(index) + this->displacement(index);
}

void addInBall(const DrawnLattice& lattice, const glm::dvec3& centre, double radius,
  const Slab& slab, ControlPointSet& points)
{
  addBest(nearestWhere(lattice, centre, radius,
            [&](const glm::ivec3& index) { return slab.contains(lattice.deformed(index)); }),
    points);
}

void addInCone(const DrawnLattice& lattice, const Cone& cone, ControlPointSet& points)
{
  std::vector<Candidate> candidates;
  forEachIndex(glm::ivec3(0), lattice.grid.dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 fromApex = lattice.deformed(index) - cone.apex;
    const double along = glm::dot(fromApex, cone.direction);
    const double across = glm::length(fromApex - along * cone.direction);
    if (along > 0.0 && across <= cone.radius + cone.growth * along)
    {
      candidates.emplace_back(across, lattice.grid.offset(index.x, index.y, index.z));
    }
  });
  addBest(std::move(candidates), points);
}

void addMoved(const DrawnLattice& lattice, const glm::dvec3& centre, double radius,
  const Slab& slab, ControlPointSet& points)
{
  const glm::dvec3& spacing = lattice.grid.spacing;
  const double least = 0.01 * std::min({ spacing.x, spacing.y, spacing.z });
  addBest(nearestWhere(lattice, centre, radius,
            [&](const glm::ivec3& index) {
              return glm::length(lattice.displacement(index)) >= least &&
                slab.contains(lattice.deformed(index));
            }),
    points);
}

glm::ivec3 indexOf(const Grid& grid, std::size_t offset)
{
  const auto x = static_cast<std::size_t>(grid.dimensions.x);
  const auto y = static_cast<std::size_t>(grid.dimensions.y);
  return { static_cast<int>(offset % x), static_cast<int>(offset / x % y),
    static_cast<int>(offset / (x * y)) };
}
}
