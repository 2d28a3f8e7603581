// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lattices and points that the tests share. Every random number comes from a seed that the test
/// names.
#ifndef BrainShift_TestLattices_h
#define BrainShift_TestLattices_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/LatticeExtremes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <functional>
#include <random>

namespace brainshift::testing
{
// Uniform numbers that are the same with every standard library.
class Random
{
public:
  explicit Random(unsigned int seed)
    : Engine(seed)
  {
  }
  double between(double low, double high)
  {
    return low + (high - low) * this->Engine() / 4294967296.0;
  }
  glm::dvec3 between(const glm::dvec3& low, const glm::dvec3& high)
  {
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
      result[axis] = this->between(low[axis], high[axis]);
    }
    return result;
  }
  // World position within a grid's box, or up to `beyond` cells outside it.
  glm::dvec3 point(const Grid& grid, double beyond)
  {
    return grid.worldFromGrid(
      this->between(glm::dvec3(-beyond), glm::dvec3(grid.dimensions - 1) + beyond));
  }

private:
  std::mt19937 Engine;
};

inline Grid plainGrid(const glm::ivec3& dimensions, const glm::dvec3& spacing)
{
  Grid grid;
  grid.dimensions = dimensions;
  grid.spacing = spacing;
  return grid;
}

// Rotated about no axis of its own, anisotropic, far from the origin: hides no mixed-up axis.
inline Grid obliqueGrid(const glm::ivec3& dimensions)
{
  Grid grid = plainGrid(dimensions, { 8.0, 7.0, 9.5 });
  grid.origin = { -310.0, 42.0, 705.0 };
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(1.0, 2.0, 3.0)));
  return grid;
}

// Displacements from a function of the control point's world position (mm).
inline Lattice latticeOf(
  const Grid& grid, int kernel, const std::function<glm::dvec3(const glm::dvec3&)>& displacement)
{
  Lattice lattice = makeLattice(grid, kernel);
  for (int k = 0; k < grid.dimensions.z; ++k)
  {
    for (int j = 0; j < grid.dimensions.y; ++j)
    {
      for (int i = 0; i < grid.dimensions.x; ++i)
      {
        lattice.displacements[grid.offset(i, j, k)] =
          glm::vec3(displacement(grid.worldFromGrid(glm::dvec3(i, j, k))));
      }
    }
  }
  return lattice;
}

// Every control point displaced by up to `cells` lattice cells along each lattice axis.
inline Lattice randomLattice(const Grid& grid, int kernel, unsigned int seed, double cells)
{
  Random random(seed);
  return latticeOf(grid, kernel, [&](const glm::dvec3&) {
    return grid.worldVectorFromGrid(random.between(glm::dvec3(-cells), glm::dvec3(cells)));
  });
}

// Random displacements, as large as they may be with every Jacobian determinant at 0.1 or above:
// the limit of the fold guard.
inline Lattice randomLatticeWithoutFolds(const Grid& grid, int kernel, unsigned int seed)
{
  Lattice lattice = randomLattice(grid, kernel, seed, 1.5);
  while (minimumJacobian(lattice) < 0.1)
  {
    for (glm::vec3& displacement : lattice.displacements)
    {
      displacement *= 0.9f;
    }
  }
  return lattice;
}

// What a picture may be off by: 0.05 mm or 0.05 voxel, whichever is larger.
inline double largestErrorMm(double voxelMm)
{
  return std::max(0.05, 0.05 * voxelMm);
}

// A stroke that takes hold of `anchor`; the tool's other numbers have usual values.
inline Stroke strokeAt(Tool tool, const glm::dvec3& anchor, const glm::dvec3& vector)
{
  Stroke stroke;
  stroke.tool = tool;
  stroke.anchor = anchor;
  stroke.vector = vector;
  stroke.axis = tool == Tool::Stamp ? vector : glm::dvec3(0.0);
  stroke.major = tool == Tool::Move ? 0.0 : 40.0;
  stroke.minor = tool == Tool::Stamp ? 25.0 : 0.0;
  return stroke;
}
}

#endif
