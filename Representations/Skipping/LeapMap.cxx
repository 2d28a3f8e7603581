// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/LeapMap.h"

#include <algorithm>
#include <cstddef>

namespace brainshift
{
namespace
{
// Lowers `to` to the greater of `away` and the element of `from` that lies `away` elements further
// on.
void lower(std::uint8_t* to, const std::uint8_t* from, std::uint8_t away, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = std::min(to[i], std::max(from[i], away));
  }
}

// Distances along one axis, whose `length` elements lie `stride` apart in each of `blocks` blocks.
// The maximum norm can be computed axis by axis.
std::vector<std::uint8_t> alongAxis(
  const std::vector<std::uint8_t>& from, int length, std::size_t stride, std::size_t blocks)
{
  std::vector<std::uint8_t> to = from;
  const std::size_t block = stride * length;
  for (std::size_t b = 0; b < blocks; ++b)
  {
    for (int away = 1; away < std::min(LongestLeap, length); ++away)
    {
      const std::size_t shift = stride * away;
      const auto distance = static_cast<std::uint8_t>(away);
      lower(&to[b * block], &from[b * block + shift], distance, block - shift);
      lower(&to[b * block + shift], &from[b * block], distance, block - shift);
    }
  }
  return to;
}
}

std::vector<std::uint8_t> bricksToOccupied(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count)
{
  std::vector<std::uint8_t> distance(occupied.size());
  std::transform(occupied.begin(), occupied.end(), distance.begin(),
    [](std::uint8_t there) { return static_cast<std::uint8_t>(there ? 0 : LongestLeap); });
  const std::size_t width = count.x;
  distance = alongAxis(distance, count.x, 1, static_cast<std::size_t>(count.y) * count.z);
  distance = alongAxis(distance, count.y, width, count.z);
  return alongAxis(distance, count.z, width * count.y, 1);
}
}
