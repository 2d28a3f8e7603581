// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Makes the voxels of a coarser level, and finds least and greatest values.
#ifndef BrainShift_HalvedVoxels_h
#define BrainShift_HalvedVoxels_h

#include "Formats/OMEZarr/PyramidPlan.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace brainshift
{
using Size3 = glm::vec<3, std::int64_t>;

/** A box of numbers in memory. It does not own them. */
struct VoxelBox
{
  const char* first = nullptr; ///< the number at 0, 0, 0
  Size3 size{ 0 };             ///< numbers along x, y, z
  Size3 steps{ 0 };            ///< numbers from one to the next along x, y, z
};

/** How several voxels become one. */
enum class Halving
{
  Mean,        ///< rounded, for whole numbers; of those that are no NaN
  MostFrequent ///< of as frequent ones the first
};

/** The voxels to make: a part of all that a finer box makes. */
struct HalvedPart
{
  Size3 begin{ 0 };
  Size3 size{ 0 };
  char* to = nullptr; ///< x fastest, rows and slices of PyramidChunk
};

/** How they are made. */
struct HalvingWay
{
  int type = 0;         ///< VTK's number of the type of all numbers
  glm::ivec3 step{ 2 }; ///< 1 or 2 finer voxels along each axis make one; at their end fewer
  Halving halving = Halving::Mean;
};

void halve(const VoxelBox& finer, const HalvingWay& way, const HalvedPart& part);

/** Least and greatest number of a box; NaN where it has none. */
std::array<double, 2> rangeOf(int type, const VoxelBox& box);
}

#endif
