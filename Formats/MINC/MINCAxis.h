// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Axes of MINC volumes, of both versions, and where they put voxels.
#ifndef BrainShift_MINCAxis_h
#define BrainShift_MINCAxis_h

#include "Formats/Volumes/VolumeFile.h"

#include <cstdint>

namespace brainshift
{
/** What an axis is for. */
enum class AxisUse
{
  Space,
  Time,
  Components,
};

/** What a file has of one axis. */
struct MINCAxis
{
  std::string name;
  AxisUse use = AxisUse::Space;
  std::uint64_t count = 0;
  double start = 0.0;            ///< in `units` along the axis
  double step = 1.0;             ///< in `units`
  std::string units;             ///< empty: mm or s
  std::vector<double> positions; ///< of an uneven axis; empty if the file does not list them
  glm::dvec3 cosines{ 0.0 };     ///< RAS, of an axis of space
  bool isEven = true;
  std::string spaceType; ///< "native____", "talairach_" or "callosal__"; empty: not said
};

/**
 * Puts dimensions, places of voxels, times and components into the header, by the axes in the order
 * of the file, the slowest first. Cosines get the length 1. Throws the end of a sentence if an axis
 * has no such meaning.
 */
void placeMINC(std::vector<MINCAxis>& axes, VolumeHeader& header);
}

#endif
