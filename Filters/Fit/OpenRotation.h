// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rotations that landmarks leave open: about a line on which they are, or about all axes if
/// they are at one place.
#ifndef BrainShift_OpenRotation_h
#define BrainShift_OpenRotation_h

#include "Common/Export.h"

#include <glm/glm.hpp>

#include <vector>

namespace brainshift
{
/** How far a rigid motion may still rotate. Nothing is open by default. */
struct OpenRotation
{
  glm::dvec3 centre{ 0.0 };     ///< mm, of the landmarks
  glm::dmat3 axes{ 1.0 };       ///< columns, unit vectors; the first is along the landmarks
  glm::dvec3 deviations{ 0.0 }; ///< rad, standard deviation about each axis; 0: determined

  bool isAboutLine() const { return this->deviations.x > 0.0; }
  bool isAboutAll() const { return this->deviations.z > 0.0; }

  /** Root mean square distance (mm) by which open rotations move tissue. */
  BRAINSHIFT_DEFORMATION_EXPORT double distance(const glm::dvec3& rest) const;
};

/**
 * The rotations of which landmarks say less than `expected` (rad): their own error decides them. An
 * open rotation has the deviation that this error leaves, at most that of any rotation.
 *
 * @param deviationMm   standard deviation of a landmark of weight 1, along each axis
 */
BRAINSHIFT_DEFORMATION_EXPORT OpenRotation openRotationOf(const std::vector<glm::dvec3>& points,
  const std::vector<double>& weights, double deviationMm, double expected);
}

#endif
