// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is suspicious about pairs of landmarks, whatever their residuals are.
#ifndef BrainShift_PairDoubts_h
#define BrainShift_PairDoubts_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/**
 * Sentences, without full stops, about landmarks that are switched on: what a rigid motion leaves
 * open, places that repeat, axes that look exchanged or mirrored, and units that look wrong.
 *
 * @param names      what the landmarks are called, as many as these
 * @param volumeMm   diagonal of the volume; 0: unknown
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<std::string> doubtsAbout(
  const Measurements& measured, const std::vector<std::string>& names, double volumeMm);

/**
 * The axes of measured points with which they would fit: "-x -y z" if x and y are reversed. Empty
 * if the points fit as they are.
 *
 * @param isAnyRotation   whether the frames may be rotated against each other by any angle, as that
 *                        of a tracker is. Only a mirror is then suspicious.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::string betterAxes(const std::vector<glm::dvec3>& rest,
  const std::vector<glm::dvec3>& measured, const std::vector<double>& weights, bool isAnyRotation);
}

#endif
