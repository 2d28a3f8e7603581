// SPDX-License-Identifier: BSD-3-Clause
// How far a ray may leap through empty bricks (Deakin and Knackstedt, 2019, on volumes at rest;
// here of the deformed frame).
#ifndef BrainShift_LeapMap_h
#define BrainShift_LeapMap_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace brainshift
{
constexpr int LongestLeap = 8; // bricks; longer ones gain little

// For each of count.x * y * z bricks, x fastest: how many bricks away the nearest occupied one is,
// along the axis on which it is farthest (Chebyshev distance); 0 if it is occupied itself, at most
// LongestLeap. `occupied`: 0 for empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::uint8_t> bricksToOccupied(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);
}

#endif
