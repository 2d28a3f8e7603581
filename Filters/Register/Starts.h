// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The positions from which a rigid search begins, if it begins from several.
#ifndef BrainShift_Starts_h
#define BrainShift_Starts_h

#include "Common/Export.h" // for the export macro

#include <glm/vec3.hpp>

namespace brainshift
{
constexpr int MostStarts = 64;

/** A rigid motion about a centre of the caller's choice. */
struct StartMotion
{
  glm::dvec3 shift{ 0.0 };    ///< mm
  glm::dvec3 rotation{ 0.0 }; ///< axis times angle (radians)
};

/**
 * A start by its number. Number 0 moves nothing. The others are random, the same for the same
 * number: evenly within balls of `farthestMm` and `farthestDegrees`.
 */
BRAINSHIFT_DEFORMATION_EXPORT StartMotion startMotion(
  int number, double farthestMm, double farthestDegrees);
}

#endif
