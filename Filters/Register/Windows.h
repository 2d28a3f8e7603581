// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Sums over windows around every second point of a grid, and what windows hand back to their
 *        points.
 *
 * Neighbouring windows share most of their points, so that windows around every point would say
 * little more and take eight times as long to fit.
 */
#ifndef BrainShift_Windows_h
#define BrainShift_Windows_h

#include "Common/Export.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace brainshift
{
constexpr int WindowRadius = 3; ///< points
constexpr int WindowStride = 2; ///< points from one window's middle to that of the next

/** How many windows a line of so many points has. The first lies around the first point. */
constexpr int windowsAlong(int points)
{
  return (points + WindowStride - 1) / WindowStride;
}

/** Numbers beside each other for each point or window, x fastest. */
struct Block
{
  glm::ivec3 dimensions{ 0 };
  int numbers = 0;
  std::vector<float> values;

  Block() = default;
  Block(const glm::ivec3& sides, int each)
    : dimensions(sides)
    , numbers(each)
    , values(static_cast<std::size_t>(sides.x) * sides.y * sides.z * each)
  {
  }

  float* row(int j, int k)
  {
    return this->values.data() +
      (static_cast<std::size_t>(k) * this->dimensions.y + j) * this->dimensions.x * this->numbers;
  }
  const float* row(int j, int k) const { return const_cast<Block*>(this)->row(j, k); }
};

/** Adds up a row of points, `numbers` for each, for each of its windows. */
BRAINSHIFT_DEFORMATION_EXPORT void gatherRow(
  const float* points, int count, int numbers, float* windows);

/** For each point of a row, the sum of the windows that hold it. */
BRAINSHIFT_DEFORMATION_EXPORT void spreadRow(
  const float* windows, int count, int numbers, float* points);

/** The same along y and z of a block whose rows are gathered. */
BRAINSHIFT_DEFORMATION_EXPORT Block gathered(const Block& rows);

/** The same along z and y of a block of windows; its rows are still to be spread. */
BRAINSHIFT_DEFORMATION_EXPORT Block spread(const Block& windows, const glm::ivec3& points);
}

#endif
