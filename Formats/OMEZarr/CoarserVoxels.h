// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Replaces voxels that cannot be read by those of a coarser level.
#ifndef BrainShift_CoarserVoxels_h
#define BrainShift_CoarserVoxels_h

#include "Formats/OMEZarr/OMEImage.h"
#include "Formats/OMEZarr/ZarrBox.h"

namespace brainshift
{
/**
 * Fills a part of a level from the next coarser one that can be read there: interpolated between
 * voxels, labels by the nearest. Returns the number of that level. Throws the end of a sentence
 * with the reason of the damage if none can.
 */
std::size_t fillFromCoarser(
  const ZarrStore& store, const OMEImage& image, std::size_t level, const ZarrDamage& damage);
}

#endif
