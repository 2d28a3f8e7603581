// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTIGeometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace
{
constexpr double HalfTurnTolerance = 1e-7; // of 1 - |quaternion|^2: float32 rounding of the header

glm::dmat3 rotationFromQuaternion(const glm::dvec3& stored)
{
  const double b = stored.x;
  const double c = stored.y;
  const double d = stored.z;
  const double rest = 1.0 - (b * b + c * c + d * d);
  if (rest < HalfTurnTolerance) // half a turn: the real part is rounding, so leave it out
  {
    const glm::dvec3 n = glm::normalize(stored);
    return 2.0 * glm::outerProduct(n, n) - glm::dmat3(1.0);
  }
  const double a = std::sqrt(rest);
  return glm::dmat3(a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c),
    2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b),
    2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c);
}

glm::dmat4 affine(const glm::dmat3& axes, const glm::dvec3& offset)
{
  return glm::dmat4(glm::dvec4(axes[0], 0.0), glm::dvec4(axes[1], 0.0), glm::dvec4(axes[2], 0.0),
    glm::dvec4(offset, 1.0));
}
}

namespace brainshift
{
double mmPerNIFTIUnit(int xyztUnits)
{
  switch (xyztUnits & 0x07)
  {
    case 1: // metre
      return 1000.0;
    case 3: // micrometre
      return 0.001;
    default:
      return 1.0;
  }
}

double secondsPerNIFTIUnit(int xyztUnits)
{
  switch (xyztUnits & 0x38)
  {
    case 16: // millisecond
      return 1e-3;
    case 24: // microsecond
      return 1e-6;
    default:
      return 1.0;
  }
}

glm::dmat4 worldFromVoxel(const NIFTIPlacement& placement)
{
  if (placement.sformCode > 0)
  {
    glm::dmat4 world(1.0);
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        world[column][row] = placement.mmPerUnit * placement.sformRows[row][column];
      }
    }
    return world;
  }
  glm::dvec3 size = glm::abs(placement.pixelSize);
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = placement.mmPerUnit * (size[axis] == 0.0 ? 1.0 : size[axis]); // as the standard
  }
  glm::dmat3 axes(1.0);
  glm::dvec3 offset(0.0);
  if (placement.qformCode > 0)
  {
    axes = rotationFromQuaternion(placement.quaternion);
    axes[2] *= placement.qfac < 0.0 ? -1.0 : 1.0;
    offset = placement.mmPerUnit * placement.qformOffset;
  }
  return affine(glm::dmat3(size.x * axes[0], size.y * axes[1], size.z * axes[2]), offset);
}
}
