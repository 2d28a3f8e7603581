// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Measured points and masks as data sets hold them.
 */
#ifndef BrainShift_MeasuredPoints_h
#define BrainShift_MeasuredPoints_h

#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Fit/Measurements.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkPointSet;

namespace brainshift
{
/** Positions (mm, world) of all points; none without points. */
std::vector<glm::dvec3> positionsOf(vtkPointSet* points);

/**
 * The pairs of landmarks at rest and measured. They match by the point array Label, else by order;
 * the point array Weight of those at rest gives weights. Both may be null.
 *
 * @param unmatched   set to those without a partner, with commas between them
 */
std::vector<PointPair> landmarkPairs(
  vtkPointSet* rest, vtkPointSet* measured, std::string& unmatched);

/** Whether a mask holds the voxel nearest to a position (mm, world). */
bool holds(const Mask& mask, const glm::dvec3& position);
}

#endif
