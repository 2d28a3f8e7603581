// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/DirectedMap.h"

#include "Filters/Attached/DeformableVolume.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace brainshift
{
namespace
{
bool isFinite(const glm::dvec3& vector)
{
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}
}

glm::dvec3 DirectedMap::position(const glm::dvec3& from) const
{
  if (!isFinite(from))
  {
    return from;
  }
  return this->Towards == Direction::Forward ? this->Map.deformedFromRest(from)
                                             : this->Map.restFromDeformed(from);
}

glm::dmat3 DirectedMap::jacobian(const glm::dvec3& from, const glm::dvec3& to) const
{
  if (!isFinite(from))
  {
    return glm::dmat3(1.0);
  }
  if (this->Towards == Direction::Forward)
  {
    return this->Map.jacobian(from);
  }
  // Negated subtracts the displacement found at `from`, so its derivatives are those of that.
  return this->Backward == Inverse::Negated ? glm::dmat3(2.0) - this->Map.jacobian(from)
                                            : glm::inverse(this->Map.jacobian(to));
}

glm::dvec3 turnedNormal(const glm::dmat3& jacobian, const glm::dvec3& normal)
{
  // Cofactors: what cross products of tangents turn by. Needs no inverse.
  const glm::dmat3 cofactors(glm::cross(jacobian[1], jacobian[2]),
    glm::cross(jacobian[2], jacobian[0]), glm::cross(jacobian[0], jacobian[1]));
  const glm::dvec3 turned = cofactors * normal;
  const double length = glm::length(turned);
  return std::isfinite(length) && length > 0.0 ? turned * (glm::length(normal) / length) : normal;
}

DirectedMap directedMapOf(vtkDataObject* volume, Direction direction)
{
  const Deformation deformation = readDeformation(volume);
  return DirectedMap(
    PointMap(effectiveLattice(deformation), deformation.inverse), deformation.inverse, direction);
}
}
