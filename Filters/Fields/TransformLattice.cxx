// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/TransformLattice.h"

#include "Filters/Deformation/Kernels.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int MiddlesOfAxis = 20;

double errorAt(
  const Lattice& lattice, const DirectedTransform& transform, const glm::dvec3& position)
{
  const glm::dvec3 rest = lattice.grid.worldFromGrid(position);
  const glm::dvec3 deformed = rest +
    glm::dvec3(cubicDisplacement(
      lattice.grid.dimensions, lattice.kernel, lattice.displacements.data(), position));
  return transform.direction == Direction::Forward
    ? glm::distance(deformed, mapped(transform.chain, rest))
    : glm::distance(rest, mapped(transform.chain, deformed));
}
}

void interpolateAtPoints(Lattice& lattice)
{
  if (lattice.kernel != KernelBSpline)
  {
    return;
  }
  std::vector<glm::dvec3> values(lattice.displacements.begin(), lattice.displacements.end());
  toBSplineCoefficients(lattice.grid, values);
  lattice.displacements.assign(values.begin(), values.end());
}

double largestErrorOf(const Lattice& lattice, const DirectedTransform& transform)
{
  const glm::ivec3 cells = lattice.grid.dimensions - 1;
  const glm::ivec3 middles = glm::min(cells, glm::ivec3(MiddlesOfAxis));
  double largest = 0.0;
  for (int i = 0; i < middles.x * middles.y * middles.z; ++i)
  {
    const glm::ivec3 middle(i % middles.x, i / middles.x % middles.y, i / (middles.x * middles.y));
    const glm::dvec3 position = glm::dvec3(middle * cells / middles) + 0.5;
    largest = std::max(largest, errorAt(lattice, transform, position));
  }
  return largest;
}
}
