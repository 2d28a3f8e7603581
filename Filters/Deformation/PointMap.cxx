// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/PointMap.h"

#include "Filters/Deformation/Inversion.h"

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
  const glm::vec4* inCells;
  glm::dvec3 reference; // lattice coordinates

  void map(const glm::vec3& rest, glm::vec3& displacement, glm::mat3& jacobian) const
  {
    const glm::dvec3 position = this->reference + glm::dvec3(rest);
    const CubicValue value =
      cubicValue(this->grid.dimensions, this->kernel, this->inCells, position);
    displacement = value.displacement;
    jacobian = glm::mat3(1.0f) + value.gradient;
  }
};
}

PointMap::PointMap(const Lattice& lattice, Inverse inverse)
  : LatticeGrid(lattice.grid)
  , Kernel(lattice.kernel)
  , Backward(inverse)
{
  for (const glm::vec3& displacement : displacementsInCells(lattice))
  {
    this->InCells.emplace_back(displacement, 0.0f);
  }
  if (lattice.mask)
  {
    this->Masked = refine(lattice, lattice.mask->perCell - 1);
  }
}

// Lattice cells, at a position in lattice coordinates.
glm::vec3 PointMap::displacement(const glm::dvec3& position) const
{
  return this->Masked.values.empty()
    ? cubicValue(this->LatticeGrid.dimensions, this->Kernel, this->InCells.data(), position)
        .displacement
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

glm::vec3 PointMap::offsetNear(const glm::dvec3& deformed, const glm::vec3& guess) const
{
  // A step leaves about the square of its length, times half of the map's curvature over its slope.
  constexpr float shortStep = 0.004f;
  constexpr float farFromFolding = 0.05f; // Jacobian determinant
  if (this->Backward == Inverse::Negated || this->isTrilinear())
  {
    return this->offsetInCells(deformed, guess);
  }
  const CubicForward forward{ this->LatticeGrid, this->Kernel, this->InCells.data(), deformed };
  Inversion<CubicForward> inversion{ forward };
  const glm::vec3 miss = guess + inversion.displacementAt(guess);
  const glm::mat3 slopes = inversion.jacobianThere();
  const glm::vec3 step = inversion.inversionStep(slopes, miss);
  return glm::dot(step, step) < shortStep * shortStep && glm::determinant(slopes) > farFromFolding
    ? guess - step
    : inversion.inverseOffset(glm::vec3(0.0f), guess);
}

glm::dmat3 PointMap::jacobian(const glm::dvec3& rest) const
{
  const glm::dvec3 position = this->LatticeGrid.gridFromWorld(rest);
  glm::mat3 inLattice(1.0f);
  if (this->Masked.values.empty())
  {
    inLattice +=
      cubicValue(this->LatticeGrid.dimensions, this->Kernel, this->InCells.data(), position)
        .gradient;
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
