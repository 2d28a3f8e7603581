// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A segment as a smooth field, so that its surface shows no steps of voxels.
///
/// The share at a point is the fraction of the space around it that belongs to the segment. A share
/// of one half means that the point is on the segment's surface.
///
/// Voxels are smoothed on their own grid by a binomial filter of five, whose edge is about two
/// voxels wide. Then the middle of each voxel is put back on the side that its label says. So a
/// part that is thinner than the filter stays, and no voxel outside comes in.
#ifndef BrainShift_SegmentShares_h
#define BrainShift_SegmentShares_h

#include "Filters/Deformation/MaskWeights.h"

#include <cstdint>

namespace brainshift
{
/** The share where all of the space belongs to the segment. Its half is the segment's surface. */
constexpr int WholeShare = 255;

/**
 * Tissue whose share (0 to 1) is below this is not drawn. Tissue whose share is above 1 minus this
 * is drawn with its full opacity. Opacity rises in between, over about one voxel.
 */
constexpr float LeastShare = 0.3f;

/**
 * Shares, 0 to WholeShare, at the points of a grid, x fastest. The grid may lie anywhere and in any
 * direction relative to the segment's. Space beyond the segment's voxels does not belong to it.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<std::uint8_t> segmentShares(
  const Mask& segment, const Grid& points);
}

#endif
