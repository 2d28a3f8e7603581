// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Takes what a registration compares from the output of Compare Volumes.
 */
#ifndef BrainShift_RegisteredSource_h
#define BrainShift_RegisteredSource_h

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Register/Volume.h"

#include <memory>
#include <string>

class vtkImageData;

namespace brainshift
{
/** A volume at rest, how it is bent, and its reference where it lies. */
struct RegisteredSource
{
  RegisteredPair pair;
  std::unique_ptr<const Deformation> bent; ///< null: the volume carries no deformation
};

/** Grids of what would be read; no voxel is copied. */
struct RegisteredGrids
{
  Grid rest;
  Grid reference;
};

/**
 * Why an image cannot be registered: one sentence without a full stop; empty if it can. It must
 * carry a reference, and both volumes need two points or more along each axis.
 */
std::string findGrids(vtkImageData* image, RegisteredGrids& grids);

/**
 * Reads the voxels, as floats. Numbers that are not finite become 0. Returns the problem with the
 * deformation; empty if there is none.
 */
std::string readSource(vtkImageData* image, RegisteredSource& source);
}

#endif
