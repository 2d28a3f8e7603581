// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The contract between Resection and what draws volumes: a volume carries, as field data, the
/// tumour at rest and the cavity in the deformed frame. Each has a grid of its own.
///
///    TumourVoxels   unsigned char x 1, nx*ny*nz tuples, x fastest: 1 in the tumour, else 0
///    TumourGrid     see attachGrid in CarriedArray.h; rest frame
///    RemovedVoxels  unsigned char x 1: 1 where tissue was removed, else 0
///    RemovedGrid    see attachGrid in CarriedArray.h; deformed frame
///
/// A tumour is left where its tissue lies outside the cavity, and removed where it lies inside.
/// Pictures draw the edges of both where a smoothed fraction is one half (SegmentFractions.h).
#ifndef BrainShift_Resection_h
#define BrainShift_Resection_h

#include "Filters/Attached/ReferenceVolume.h"

namespace brainshift
{
/** Names of the arrays of voxels. */
constexpr const char* TumourVoxelsName = "TumourVoxels";
constexpr const char* RemovedVoxelsName = "RemovedVoxels";

/** What the arrays hold. */
struct Resection
{
  PlacedVoxels tumour; ///< no voxels: no tumour is marked
  PlacedVoxels cavity; ///< no voxels: nothing was removed
};

/** Attaches a tumour and a cavity, whose voxels have these names, in place of those before. */
VTKBRAINSHIFTFILTERS_EXPORT void attachResection(vtkDataObject* volume, const Resection& resection);

/** Reads what attachResection wrote. Voxels that are missing or do not fit their grid are null. */
VTKBRAINSHIFTFILTERS_EXPORT Resection readResection(vtkDataObject* volume);
}

#endif
