// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The two volumes of a registration and what of them counts.
 */
#ifndef BrainShift_RegisteredPair_h
#define BrainShift_RegisteredPair_h

#include "Filters/Register/Volume.h"

namespace brainshift
{
/** What is compared. */
struct RegisteredPair
{
  Volume rest;      ///< the volume as loaded
  Volume reference; ///< on any grid, where it lies in the world
  Mask inside;      ///< of the rest frame: what is compared; without voxels: all
  Mask cavity;      ///< where the reference lacks tissue; without voxels: nowhere
};
}

#endif
