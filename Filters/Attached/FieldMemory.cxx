// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/FieldMemory.h"

#include "Common/HostMemory.h"
#include "Filters/Deformation/OffsetField.h"

namespace brainshift
{
namespace
{
double product(const glm::dvec3& sides)
{
  return sides.x * sides.y * sides.z;
}

glm::dvec3 forwardSides(const Grid& lattice, int samples)
{
  return glm::dvec3(lattice.dimensions - 1) * (samples + 1.0) + 1.0;
}

glm::dvec3 backwardSides(const Lattice& lattice, int samples)
{
  return glm::dvec3(backwardNodes(lattice.grid, displacementsInCells(lattice), samples).count);
}
}

double offsetFieldBytes(const Lattice& lattice, int samples)
{
  // The forward field, that before its last axis is refined, and the backward field.
  const glm::dvec3 forward = forwardSides(lattice.grid, samples);
  const double nodes =
    product(forward) * (1.0 + 1.0 / (samples + 1.0)) + product(backwardSides(lattice, samples));
  return nodes * static_cast<double>(sizeof(glm::vec3));
}

std::string offsetFieldProblem(const Lattice& lattice, int samples)
{
  return hostMemoryProblem(
    "The offset field of " + sizeText(backwardSides(lattice, samples)) + " nodes",
    offsetFieldBytes(lattice, samples));
}
}
