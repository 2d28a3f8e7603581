// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Transforms/TransformLattice.h"

#include "Filters/Deformation/Kernels.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>

namespace brainshift
{
namespace
{
constexpr int MiddlesOfAxis = 20;

// Solves for the coefficients of one row in place: (1 4 1) / 6, and (5 1) / 6 at the ends, where
// the outermost point stands for those outside.
void solveRow(glm::vec3* first, std::size_t stride, int count)
{
  std::vector<double> factors(count);
  std::vector<glm::dvec3> values(count);
  for (int i = 0; i < count; ++i)
  {
    const double middle = (i == 0 || i == count - 1 ? 5.0 : 4.0) / 6.0;
    const double before = i == 0 ? 0.0 : 1.0 / 6.0;
    const double pivot = middle - (i == 0 ? 0.0 : before * factors[i - 1]);
    factors[i] = 1.0 / 6.0 / pivot;
    const glm::dvec3 earlier = i == 0 ? glm::dvec3(0.0) : values[i - 1];
    values[i] = (glm::dvec3(first[i * stride]) - before * earlier) / pivot;
  }
  for (int i = count - 1; i >= 0; --i)
  {
    if (i < count - 1)
    {
      values[i] -= factors[i] * values[i + 1];
    }
    first[i * stride] = glm::vec3(values[i]);
  }
}

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
  const Grid& grid = lattice.grid;
  const std::size_t strides[3] = { 1, static_cast<std::size_t>(grid.dimensions.x),
    static_cast<std::size_t>(grid.dimensions.x) * grid.dimensions.y };
  for (int axis = 0; axis < 3; ++axis)
  {
    const int across = (axis + 1) % 3;
    const int along = (axis + 2) % 3;
    for (int j = 0; j < grid.dimensions[across]; ++j)
    {
      for (int k = 0; k < grid.dimensions[along]; ++k)
      {
        solveRow(lattice.displacements.data() + j * strides[across] + k * strides[along],
          strides[axis], grid.dimensions[axis]);
      }
    }
  }
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
