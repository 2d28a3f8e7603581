// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rotation and translation: the part of a fit that bends nothing.
#ifndef BrainShift_RigidPose_h
#define BrainShift_RigidPose_h

#include "Common/Export.h"

#include <glm/glm.hpp>

#include <vector>

namespace brainshift
{
/** Rotates about the origin, then shifts. */
struct RigidPose
{
  glm::dmat3 rotation{ 1.0 };
  glm::dvec3 translation{ 0.0 }; ///< mm

  glm::dvec3 apply(const glm::dvec3& point) const
  {
    return this->rotation * point + this->translation;
  }
  glm::dvec3 applyInverse(const glm::dvec3& point) const
  {
    return glm::transpose(this->rotation) * (point - this->translation);
  }
};

/** A motion that rotates about a centre (mm) and then shifts by a vector (mm). */
BRAINSHIFT_DEFORMATION_EXPORT RigidPose turnedAround(
  const glm::dvec3& centre, const glm::dmat3& rotation, const glm::dvec3& shift);

/** The rotation about a vector by its length (rad). */
BRAINSHIFT_DEFORMATION_EXPORT glm::dmat3 rotationFrom(const glm::dvec3& vector);

/** The vector whose direction is a rotation's axis and whose length is its angle (0 to pi rad). */
BRAINSHIFT_DEFORMATION_EXPORT glm::dvec3 vectorFrom(const glm::dmat3& rotation);

/**
 * The rotation that takes points nearest to others, both counted from their weighted means: it has
 * the least weighted sum of squared distances. The identity if the points do not span a plane.
 *
 * Source: Kabsch, Acta Crystallographica A32 (1976) and A34 (1978); by singular values and never a
 * mirror: Umeyama, "Least-squares estimation of transformation parameters between two point
 * patterns", IEEE Transactions on Pattern Analysis and Machine Intelligence 13 (1991).
 */
BRAINSHIFT_DEFORMATION_EXPORT glm::dmat3 nearestRotation(const std::vector<glm::dvec3>& from,
  const std::vector<glm::dvec3>& to, const std::vector<double>& weights);

/** The weighted mean of points (mm); 0 without weight. */
BRAINSHIFT_DEFORMATION_EXPORT glm::dvec3 weightedMean(
  const std::vector<glm::dvec3>& points, const std::vector<double>& weights);

/**
 * Root mean square distance (mm) of points from the line that is nearest to them; 0 if they are on
 * one line or in one point, so that the rotation about it is unknown.
 */
BRAINSHIFT_DEFORMATION_EXPORT double spreadAroundLine(
  const std::vector<glm::dvec3>& points, const std::vector<double>& weights);
}

#endif
