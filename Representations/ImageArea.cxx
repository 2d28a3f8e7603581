// SPDX-License-Identifier: BSD-3-Clause
#include "ImageArea.h"

#include <glm/common.hpp>

#include <cstdint>

namespace brainshift
{
namespace
{
constexpr int Step = 64;     // pixels by which an area grows
constexpr int MostSpare = 2; // times the pixels needed

std::int64_t pixels(const ImageArea& area)
{
  return static_cast<std::int64_t>(area.size.x) * area.size.y;
}

ImageArea between(const glm::ivec2& picture, const glm::ivec2& low, const glm::ivec2& high)
{
  return { picture, low, high - low };
}
}

ImageArea areaAround(
  const ImageArea& held, const glm::ivec2& picture, const glm::ivec2& low, const glm::ivec2& high)
{
  // At least a pixel, in the picture.
  const glm::ivec2 first = glm::min(low, picture - 1) / Step * Step;
  const glm::ivec2 last = glm::max(high - 1, first);
  const ImageArea needed = between(picture, first, glm::min((last / Step + 1) * Step, picture));
  if (held.picture != picture)
  {
    return needed;
  }
  const ImageArea both =
    between(picture, glm::min(held.low, needed.low), glm::max(held.high(), needed.high()));
  return pixels(both) <= MostSpare * pixels(needed) ? both : needed;
}
}
