// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A segment as a smooth field, so that its surface shows no steps of voxels.
///
/// The fraction at a point is the fraction of the space around it that belongs to the segment. A
/// fraction of one half means that the point is on the segment's surface.
///
/// Voxels are smoothed on their own grid by a binomial filter of five, whose edge is about two
/// voxels wide. Then the middle of each voxel is put back on the side that its label says. So a
/// part that is thinner than the filter stays, and no voxel outside comes in.
#ifndef BrainShift_SegmentFractions_h
#define BrainShift_SegmentFractions_h

#include "Filters/Deformation/MaskWeights.h"

#include <cstdint>

namespace brainshift
{
/** The fraction where all of the space belongs to the segment. Half of it: the segment's edge. */
constexpr int WholeFraction = 255;

/**
 * Tissue whose fraction (0 to 1) is below this is not drawn. Tissue whose fraction is above 1 minus
 * this is drawn with its full opacity. Opacity rises in between, over about one voxel.
 */
constexpr float LeastFraction = 0.3f;

/**
 * Fractions, 0 to WholeFraction, at the points of a grid, x fastest. The grid may be anywhere, in
 * any direction relative to the segment's. Space beyond the segment's voxels does not belong to it.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<std::uint8_t> segmentFractions(
  const Mask& segment, const Grid& points);
}

#endif
