// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A traced point as the GPU takes it.
 */
#ifndef BrainShift_TraceVertex_h
#define BrainShift_TraceVertex_h

#include <array>
#include <cstdint>

namespace brainshift
{
/// Position and colour of a ball.
struct TraceVertex
{
  std::array<float, 3> position;     ///< mm, the points' own coordinates.
  std::array<std::uint8_t, 4> color; ///< Red, green, blue, opacity.
};
}

#endif
