// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief How far a ray may leap through empty bricks.
 *
 * Deakin and Knackstedt (2019) do so with volumes at rest; here it is done in the deformed frame.
 */
#ifndef BrainShift_LeapMap_h
#define BrainShift_LeapMap_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace brainshift
{
constexpr int LongestLeap = 8; ///< Bricks. Longer leaps gain little.

/// For each of count.x * y * z bricks, x fastest: the Chebyshev distance to the nearest occupied
/// brick, in bricks, at most LongestLeap. 0 if the brick is occupied itself. `occupied`: 0 for
/// empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::uint8_t> bricksToOccupied(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);
}

#endif
