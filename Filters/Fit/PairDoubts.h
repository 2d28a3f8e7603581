// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is suspicious about the measurements of a fit, whatever their residuals are.
#ifndef BrainShift_PairDoubts_h
#define BrainShift_PairDoubts_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/**
 * Sentences, without full stops, about measurements that are switched on: what a rigid motion
 * leaves open, places that repeat, pairs that look wrong or exchanged, axes that look exchanged or
 * mirrored, a scale between the lists, and units and frames that look wrong (PlaceDoubts.h).
 *
 * @param names    what the landmarks are called, as many as these
 * @param volume   of the volume; without points it is unknown
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<std::string> doubtsAbout(
  const Measurements& measured, const std::vector<std::string>& names, const Grid& volume);

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
