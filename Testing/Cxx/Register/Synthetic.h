// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes whose value is known everywhere, for tests of registrations.
#ifndef BrainShift_Synthetic_h
#define BrainShift_Synthetic_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/Volume.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <functional>

namespace brainshift::testing
{
/** A grid of points 2 mm apart along axes that are rotated about z. */
inline Grid smallGrid(int side = 40)
{
  Grid grid;
  grid.dimensions = { side, side + 2, side - 4 };
  grid.spacing = { 2.0, 2.0, 2.2 };
  grid.origin = { -30.0, 12.0, 5.0 };
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  grid.direction = glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
  return grid;
}

/** Folds and a ball: something to see everywhere, along all axes. */
inline double tissue(const glm::dvec3& at)
{
  const double folds = std::sin(0.31 * at.x + 0.1 * at.y) + std::sin(0.27 * at.y - 0.12 * at.z) +
    std::sin(0.29 * at.z + 0.08 * at.x) + std::sin(0.11 * (at.x + at.y + at.z));
  return 100.0 + 20.0 * folds + (glm::length(at - glm::dvec3(10, 50, 40)) < 15.0 ? 60.0 : 0.0);
}

/** The values of a function of the world position. */
inline Volume filled(const Grid& grid, const std::function<double(const glm::dvec3&)>& value)
{
  Volume volume{ grid, std::vector<float>(grid.count()) };
  for (int k = 0; k < grid.dimensions.z; ++k)
  {
    for (int j = 0; j < grid.dimensions.y; ++j)
    {
      for (int i = 0; i < grid.dimensions.x; ++i)
      {
        volume.values[grid.offset(i, j, k)] =
          static_cast<float>(value(grid.worldFromGrid({ i, j, k })));
      }
    }
  }
  return volume;
}

/** The middle of a grid's box (mm). */
inline glm::dvec3 middle(const Grid& grid)
{
  return grid.worldFromGrid(0.5 * glm::dvec3(grid.dimensions - 1));
}

/** A lattice over the grid's box whose tissue moves by up to `byMm` around the middle. */
inline Lattice bulge(const Grid& grid, double byMm, int kernel = 0)
{
  Lattice lattice = makeLattice(withDimensions(grid, { 8, 9, 7 }), kernel);
  for (int k = 0; k < 7; ++k)
  {
    for (int j = 0; j < 9; ++j)
    {
      for (int i = 0; i < 8; ++i)
      {
        const double away =
          glm::length(lattice.grid.worldFromGrid({ i, j, k }) - middle(grid)) / 25.0;
        lattice.displacements[lattice.grid.offset(i, j, k)] =
          glm::vec3(glm::dvec3(0.6, -0.5, 0.6) * byMm * std::exp(-away * away));
      }
    }
  }
  return lattice;
}

/** The voxels within a ball. */
inline Mask ball(const Grid& grid, const glm::dvec3& centre, double radiusMm)
{
  Mask mask{ grid, std::vector<char>(grid.count(), 0) };
  const Volume inside = filled(
    grid, [&](const glm::dvec3& at) { return glm::length(at - centre) < radiusMm ? 1.0 : 0.0; });
  for (std::size_t i = 0; i < mask.inside.size(); ++i)
  {
    mask.inside[i] = inside.values[i] > 0.0f ? 1 : 0;
  }
  return mask;
}
}

#endif
