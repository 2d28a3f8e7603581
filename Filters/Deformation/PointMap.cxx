// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/PointMap.h"

#include "Filters/Deformation/Inversion.h"

#include <glm/matrix.hpp>

namespace brainshift
{
namespace
{
// The forward map around one reference point, so that the solver's single precision is spent on
// the distance from it and not on the position.
struct CubicForward
{
  const Grid& grid;
  int kernel;
  const glm::vec3* inCells;
  glm::dvec3 reference; // lattice coordinates

  void map(const glm::vec3& rest, glm::vec3& displacement, glm::mat3& jacobian) const
  {
    const glm::dvec3 position = this->reference + glm::dvec3(rest);
    displacement = cubicDisplacement(this->grid.dimensions, this->kernel, this->inCells, position);
    jacobian =
      glm::mat3(1.0f) + cubicGradient(this->grid.dimensions, this->kernel, this->inCells, position);
  }
};
}

PointMap::PointMap(const Lattice& lattice, Inverse inverse)
  : LatticeGrid(lattice.grid)
  , Kernel(lattice.kernel)
  , Backward(inverse)
  , InCells(displacementsInCells(lattice))
{
  if (lattice.mask)
  {
    this->Masked = refine(lattice, lattice.mask->perCell - 1);
  }
}

// Lattice cells, at a position in lattice coordinates.
glm::vec3 PointMap::displacement(const glm::dvec3& position) const
{
  return this->Masked.values.empty()
    ? cubicDisplacement(this->LatticeGrid.dimensions, this->Kernel, this->InCells.data(), position)
    : this->Masked.displacement(glm::vec3(position));
}

glm::dvec3 PointMap::deformedFromRest(const glm::dvec3& rest) const
{
  const glm::dvec3 position = this->LatticeGrid.gridFromWorld(rest);
  return rest + this->LatticeGrid.worldVectorFromGrid(glm::dvec3(this->displacement(position)));
}

glm::dvec3 PointMap::restFromDeformed(const glm::dvec3& deformed) const
{
  const glm::dvec3 position = this->LatticeGrid.gridFromWorld(deformed);
  const glm::vec3 displacement = this->displacement(position);
  if (displacement == glm::vec3(0.0f))
  {
    return deformed;
  }
  const glm::vec3 guess = this->Masked.values.empty() ? glm::vec3(0.0f) : -displacement;
  const glm::vec3 offset = this->offsetInCells(position, guess);
  return deformed + this->LatticeGrid.worldVectorFromGrid(glm::dvec3(offset));
}

glm::vec3 PointMap::offsetInCells(const glm::dvec3& deformed, const glm::vec3& guess) const
{
  if (this->Backward == Inverse::Negated)
  {
    return -this->displacement(deformed);
  }
  if (!this->Masked.values.empty())
  {
    return Inversion<NodeField>{ this->Masked }.inverseOffset(glm::vec3(deformed), guess);
  }
  const CubicForward forward{ this->LatticeGrid, this->Kernel, this->InCells.data(), deformed };
  return Inversion<CubicForward>{ forward }.inverseOffset(glm::vec3(0.0f), guess);
}

glm::dmat3 PointMap::jacobian(const glm::dvec3& rest) const
{
  const glm::dvec3 position = this->LatticeGrid.gridFromWorld(rest);
  glm::mat3 inLattice(1.0f);
  if (this->Masked.values.empty())
  {
    inLattice +=
      cubicGradient(this->LatticeGrid.dimensions, this->Kernel, this->InCells.data(), position);
  }
  else
  {
    glm::vec3 unused;
    this->Masked.map(glm::vec3(position), unused, inLattice);
  }
  const glm::dmat3& direction = this->LatticeGrid.direction;
  const glm::dvec3& spacing = this->LatticeGrid.spacing;
  const glm::dmat3 scale(
    glm::dvec3(spacing.x, 0, 0), glm::dvec3(0, spacing.y, 0), glm::dvec3(0, 0, spacing.z));
  const glm::dmat3 worldFromGrid = direction * scale;
  const glm::dmat3 gradient(inLattice - glm::mat3(1.0f));
  return glm::dmat3(1.0) + worldFromGrid * gradient * glm::inverse(worldFromGrid);
}
}
