// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/FitLattice.h"

#include "Common/Grid.h"
#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Kernels.h"

#include <cstddef>
#include <vector>

namespace brainshift
{
namespace
{
// Turns values along one line of control points into coefficients of a B-spline that has these
// values at them. Beyond the ends the value of the end holds, as in the cubic (Lattice.h).
void coefficientsAlong(std::vector<glm::dvec3>& line)
{
  // (c[i-1] + 4 c[i] + c[i+1]) / 6 = value: eliminated from the first to the last, then back.
  const std::size_t count = line.size();
  std::vector<double> above(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double own = (i == 0 || i + 1 == count) ? 5.0 : 4.0;
    const double pivot = own - (i == 0 ? 0.0 : above[i - 1]);
    above[i] = 1.0 / pivot;
    line[i] = (6.0 * line[i] - (i == 0 ? glm::dvec3(0.0) : line[i - 1])) / pivot;
  }
  for (std::size_t i = count - 1; i-- > 0;)
  {
    line[i] -= above[i] * line[i + 1];
  }
}

void toCoefficients(const Grid& grid, std::vector<glm::dvec3>& values)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::ivec3 last = grid.dimensions - 1;
    const int count = last[axis] + 1;
    last[axis] = 0;
    forEachIndex(glm::ivec3(0), last, [&](glm::ivec3 index) {
      std::vector<glm::dvec3> line;
      for (index[axis] = 0; index[axis] < count; ++index[axis])
      {
        line.push_back(values[grid.offset(index.x, index.y, index.z)]);
      }
      coefficientsAlong(line);
      for (index[axis] = 0; index[axis] < count; ++index[axis])
      {
        values[grid.offset(index.x, index.y, index.z)] = line[index[axis]];
      }
    });
  }
}
}

void addField(Lattice& lattice, const Process& field)
{
  const Grid& grid = lattice.grid;
  std::vector<glm::dvec3> places;
  places.reserve(grid.count());
  forEachIndex(glm::ivec3(0), grid.dimensions - 1,
    [&](const glm::ivec3& index) { places.push_back(grid.worldFromGrid(glm::dvec3(index))); });
  std::vector<glm::dvec3> values = field.displacements(places);
  if (lattice.kernel == KernelBSpline)
  {
    toCoefficients(grid, values);
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    lattice.displacements[i] += glm::vec3(values[i]);
  }
}

double shareWithoutFolds(const Lattice& start, const Lattice& end, int samples)
{
  FoldGuard guard;
  guard.setBase(start, samples);
  return guard.share(start, end);
}
}
