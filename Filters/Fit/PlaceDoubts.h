// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is suspicious about where the lists of a fit lie, seen from the volume.
#ifndef BrainShift_PlaceDoubts_h
#define BrainShift_PlaceDoubts_h

#include "Common/Grid.h"
#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/**
 * Sentences, without full stops, about the units and the frames of the lists of a fit: landmarks,
 * traced points, pulls and pins. Each list has one at most. What is switched off does not count.
 *
 * @param volume   of the volume; without points only the lists themselves count
 */
std::vector<std::string> placeDoubts(const Measurements& measured, const Grid& volume);

/** A number with three digits. */
std::string threeDigits(double number);

/** The diagonal (mm) of the box around points; 0 without points. */
double extentOf(const std::vector<glm::dvec3>& points);
}

#endif
