// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Positions of samples along an uneven axis of a MINC2 file, which libminc 2.4 does not read.
#ifndef BrainShift_MINCPositions_h
#define BrainShift_MINCPositions_h

#include <cstddef>
#include <string>
#include <vector>

namespace brainshift
{
/**
 * The positions that a file lists along an axis, in its unit. Empty unless there are `count` finite
 * numbers.
 */
std::vector<double> positionsAlong(
  const std::string& fileName, const std::string& axis, std::size_t count);
}

#endif
