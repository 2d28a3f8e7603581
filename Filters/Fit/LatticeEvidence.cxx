// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/LatticeEvidence.h"

#include "Common/Grid.h"
#include "Filters/Fit/FittedLattice.h"

namespace brainshift
{
std::vector<float> LatticeEvidence::deviations(const FittedLattice& fitted, std::string& problem)
{
  const Grid& grid = fitted.lattice().grid;
  if (grid.count() > MostEvidencePoints)
  {
    problem = "Evidence is not found: the lattice has " + std::to_string(grid.count()) +
      " control points; it may have at most " + std::to_string(MostEvidencePoints);
    return {};
  }
  std::vector<glm::dvec3> places;
  forEachIndex(glm::ivec3(0), grid.dimensions - 1,
    [&](const glm::ivec3& index) { places.push_back(grid.worldFromGrid(glm::dvec3(index))); });
  std::vector<double> key = fitted.fit().field().covarianceKey();
  const bool isKnown = !this->Variances.empty() && grid == this->Points;
  if (!isKnown || (!this->Live && key != this->Key))
  {
    this->Variances = fitted.fit().field().variances(places);
    this->Key = std::move(key);
    this->Points = grid;
    ++this->Solutions;
  }
  const std::vector<double> deviations = fitted.deviations(places, this->Variances);
  return { deviations.begin(), deviations.end() };
}
}
