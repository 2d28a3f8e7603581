// SPDX-License-Identifier: BSD-3-Clause
// A segment as a smooth field, so that what is cut out along it has no steps: how much of the place
// around a point belongs to it. Half, and the point lies on the segment's surface.
//
// Voxels are smoothed on their own grid by a binomial filter of five, which leaves a slope of about
// two voxels; then each voxel's middle is put back on the side that its label says, so that what is
// thinner than the filter stays and nothing else comes in.
#ifndef BrainShift_SegmentShares_h
#define BrainShift_SegmentShares_h

#include "Filters/Deformation/MaskWeights.h"

#include <cstdint>
#include <vector>

namespace brainshift
{
constexpr int WholeShare = 255; // all of the place belongs to the segment; half of it: the edge

// Tissue with a smaller share in the segment is not drawn; with one as near to the whole all of it
// is. In between opacity rises, over about a voxel.
constexpr float LeastShare = 0.3f;

// Shares, 0 to WholeShare, at the points of a grid, which may lie anyhow to the segment's; x
// fastest. What lies beyond the segment's own voxels does not belong to it.
VTKBRAINSHIFTFILTERS_EXPORT std::vector<std::uint8_t> segmentShares(
  const Mask& segment, const Grid& points);
}

#endif
