// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/RestExtent.h"

#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// Voxels beyond those of the tissue: one for interpolation, one for gradients, one for the sample
// before a part, which ends at a whole number of samples.
constexpr double Neighbours = 3.0;

using Range = PositionRange;

// The largest sum of absolute weights of the 64 control points of a position: by so much their
// displacements can add up.
double mostWeight(int kernel)
{
  constexpr double ofCatmullRom = 1.25; // along an axis, in the middle between two points
  return kernel == KernelBSpline ? 1.0 : ofCatmullRom * ofCatmullRom * ofCatmullRom;
}

// The displacements that tissue in a part of the lattice can have (lattice cells), and none: a mask
// may hold it.
Range displacementsIn(
  const Lattice& lattice, const std::vector<glm::vec3>& inCells, const Range& part)
{
  const glm::dvec3 last(lattice.grid.dimensions - 1);
  const auto nearest = [&](const glm::dvec3& position) {
    return glm::ivec3(glm::clamp(position, glm::dvec3(0.0), last));
  };
  const glm::ivec3 from = nearest(glm::floor(part.low) - 1.0);
  const glm::ivec3 to = nearest(glm::floor(part.high) + 2.0);
  Range found;
  for (int k = from.z; k <= to.z; ++k)
  {
    for (int j = from.y; j <= to.y; ++j)
    {
      for (int i = from.x; i <= to.x; ++i)
      {
        const glm::dvec3 cells(inCells[lattice.grid.offset(i, j, k)]);
        found.low = glm::min(found.low, cells);
        found.high = glm::max(found.high, cells);
      }
    }
  }
  const glm::dvec3 middle = 0.5 * (found.low + found.high);
  const glm::dvec3 half = 0.5 * mostWeight(lattice.kernel) * (found.high - found.low);
  return { glm::min(middle - half, glm::dvec3(0.0)), glm::max(middle + half, glm::dvec3(0.0)) };
}

// A part, and where its tissue rests. Displacements: those that the tissue can have.
Range withRest(const Range& part, const Range& displacements)
{
  return { part.low - displacements.high, part.high - displacements.low };
}

// Where the tissue of a part rests, lattice coordinates. All displacements say where its control
// points can be; their displacements bound it better.
Range restOf(const Lattice& lattice, const Range& part)
{
  const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
  const Range all{ glm::dvec3(0.0), glm::dvec3(lattice.grid.dimensions - 1) };
  const Range wide = withRest(part, displacementsIn(lattice, inCells, all));
  return withRest(part, displacementsIn(lattice, inCells, wide));
}
}

Extent restExtent(
  const WholeVolume& volume, const Lattice* lattice, const PositionRange& part, double haloMm)
{
  Range rest = part;
  if (lattice)
  {
    // Lattice and volume share their axes.
    const glm::dvec3 voxelsPerCell = lattice->grid.spacing / volume.grid.spacing;
    const glm::dvec3 first = volume.grid.gridFromWorld(lattice->grid.origin);
    const Range inLattice{ (rest.low - first) / voxelsPerCell,
      (rest.high - first) / voxelsPerCell };
    const Range wide = restOf(*lattice, inLattice);
    rest = { wide.low * voxelsPerCell + first, wide.high * voxelsPerCell + first };
  }
  Extent extent = volume.extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int last = volume.extent[2 * axis + 1] - volume.extent[2 * axis];
    const double margin = Neighbours + haloMm / volume.grid.spacing[axis];
    const auto within = [&](double position, int least, int most) {
      return static_cast<int>(std::clamp(position, double(least), double(std::max(least, most))));
    };
    const int low = within(std::floor(rest.low[axis] - margin), 0, last - 1);
    const int high = within(std::ceil(rest.high[axis] + margin), std::min(low + 1, last), last);
    extent[2 * axis] += low;
    extent[2 * axis + 1] = volume.extent[2 * axis] + high;
  }
  return extent;
}
}
