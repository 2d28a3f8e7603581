// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads what a registration compares from the output of a Compare Volumes, and refuses what leaves
/// nothing to compare.
#ifndef BrainShift_RegisteredSource_h
#define BrainShift_RegisteredSource_h

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Register/Volume.h"

#include "vtkImageData.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <memory>

namespace brainshift
{
/** A volume at rest, its deformation, and its reference in its present position. */
struct RegisteredSource
{
  RegisteredPair pair;
  std::unique_ptr<const Deformation> bent; ///< null: the volume carries no deformation
};

/** The grids of both volumes; no voxel is copied. */
struct RegisteredGrids
{
  Grid rest;
  Grid reference;
};

/** Throws a Problem if the image has no volume or carries no reference. */
RegisteredGrids findGrids(vtkImageData* image);

/** Reads the voxels as floats. Those that are not finite get the lowest value and do not count. */
RegisteredSource readSource(vtkImageData* image);

/**
 * The tissue that a refinement compares: that which may move. Where the volume carries the mask of
 * its deformation (Segmentation.h), it is the mask and 1 mm around it, for its edge has to be seen
 * (0 and 2 mm are alike), and not all that the width of the fade lets move a little: bone beside a
 * brain that sank looks much like its cortex by another contrast, and held the cortex 7 of 8 mm
 * away. Otherwise it is what readSource found.
 */
void compareMovingTissue(vtkImageData* image, RegisteredPair& pair);

/**
 * Throws a Problem if nothing can be compared: no voxel of the volume or of the reference counts,
 * because it is not finite, outside the mask, or in the cavity; or all that count have one value.
 */
void requireContent(const RegisteredPair& pair);

/** Throws a Problem unless the volume has a whole exact deformation, over all of it. */
void requireRefinable(const Deformation* bent, const Grid& rest);
}

#endif
