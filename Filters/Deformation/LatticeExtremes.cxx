// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/LatticeExtremes.h"

#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/Parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace brainshift
{
namespace
{
bool allTapsZero(const Lattice& lattice, const glm::ivec3& cell)
{
  const glm::ivec3 low = glm::max(cell - 1, glm::ivec3(0));
  const glm::ivec3 high = glm::min(cell + 2, lattice.grid.dimensions - 1);
  for (int k = low.z; k <= high.z; ++k)
  {
    for (int j = low.y; j <= high.y; ++j)
    {
      for (int i = low.x; i <= high.x; ++i)
      {
        if (lattice.displacements[lattice.grid.offset(i, j, k)] != glm::vec3(0.0f))
        {
          return false;
        }
      }
    }
  }
  return true;
}

// Smallest determinant on the corners, edges' middles, faces' middles and middle of a cell. Those
// it shares with the next cell are left to that one: it is as moved as they are.
double minimumJacobianInCell(
  const Lattice& lattice, const std::vector<glm::vec3>& inCells, const glm::ivec3& cell)
{
  const glm::ivec3 samples =
    2 + glm::ivec3(glm::equal(cell, lattice.grid.dimensions - 2)); // a side
  double smallest = std::numeric_limits<double>::max();
  glm::ivec3 sample;
  for (sample.z = 0; sample.z < samples.z; ++sample.z)
  {
    for (sample.y = 0; sample.y < samples.y; ++sample.y)
    {
      for (sample.x = 0; sample.x < samples.x; ++sample.x)
      {
        const glm::mat3 jacobian = glm::mat3(1.0f) +
          cubicGradient(lattice.grid.dimensions, lattice.kernel, inCells.data(),
            glm::dvec3(cell) + 0.5 * glm::dvec3(sample));
        smallest = std::min(smallest, static_cast<double>(glm::determinant(jacobian)));
      }
    }
  }
  return smallest;
}
}

double maximumDisplacement(const Lattice& lattice)
{
  float largest = 0.0f;
  if (lattice.mask)
  {
    for (const glm::vec3& inCells : refine(lattice, lattice.mask->perCell - 1).values)
    {
      const glm::vec3 mm(lattice.grid.spacing * glm::dvec3(inCells)); // axes do not matter
      largest = std::max(largest, glm::dot(mm, mm));
    }
    return std::sqrt(static_cast<double>(largest));
  }
  for (const glm::vec3& displacement : lattice.displacements)
  {
    largest = std::max(largest, glm::dot(displacement, displacement));
  }
  return std::sqrt(static_cast<double>(largest));
}

double minimumJacobian(const Lattice& lattice)
{
  if (lattice.mask)
  {
    return minimumJacobian(refine(lattice, lattice.mask->perCell - 1));
  }
  const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
  const glm::ivec3 cells = lattice.grid.dimensions - 1;
  std::vector<double> smallest(cells.z, std::numeric_limits<double>::max());
  parallelFor(0, cells.z, 1, [&](std::int64_t first, std::int64_t last) {
    glm::ivec3 cell;
    for (cell.z = static_cast<int>(first); cell.z < last; ++cell.z)
    {
      for (cell.y = 0; cell.y < cells.y; ++cell.y)
      {
        for (cell.x = 0; cell.x < cells.x; ++cell.x)
        {
          smallest[cell.z] = std::min(smallest[cell.z],
            allTapsZero(lattice, cell) ? 1.0 : minimumJacobianInCell(lattice, inCells, cell));
        }
      }
    }
  });
  return *std::min_element(smallest.begin(), smallest.end());
}
}
