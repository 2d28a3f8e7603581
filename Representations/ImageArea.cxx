// SPDX-License-Identifier: BSD-3-Clause
#include "ImageArea.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

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

PixelBox enclosing(const PixelBox& a, const PixelBox& b)
{
  if (a.empty() || b.empty())
  {
    return a.empty() ? b : a;
  }
  return { glm::min(a.low, b.low), glm::max(a.high, b.high) };
}

PixelBox overlap(const PixelBox& a, const PixelBox& b)
{
  return { glm::max(a.low, b.low), glm::min(a.high, b.high) };
}

double pixelsIn(const PixelPart& part)
{
  const auto area = [](const PixelBox& box) {
    return static_cast<double>(box.size().x) * box.size().y;
  };
  // Turned, a box of as many pixels is twice as large.
  return part.empty() ? 0.0 : glm::min(area(part.box), 0.5 * area(part.turned));
}

PixelPart partOf(const PixelBox& box)
{
  const glm::ivec2 last = box.high - 1;
  return { box,
    { { box.low.x + box.low.y, box.low.x - last.y },
      { last.x + last.y + 1, last.x - box.low.y + 1 } } };
}

PixelPart enclosing(const PixelPart& a, const PixelPart& b)
{
  if (a.empty() || b.empty())
  {
    return a.empty() ? b : a;
  }
  return { enclosing(a.box, b.box), enclosing(a.turned, b.turned) };
}

bool contains(const PixelBox& a, const PixelBox& b)
{
  return b.empty() ||
    (glm::all(glm::lessThanEqual(a.low, b.low)) && glm::all(glm::greaterThanEqual(a.high, b.high)));
}

ImageArea areaAround(const ImageArea& held, const glm::ivec2& picture, const PixelBox& shown)
{
  // At least a pixel, in the picture.
  const glm::ivec2 first = glm::min(shown.low, picture - 1) / Step * Step;
  const glm::ivec2 last = glm::max(shown.high - 1, first);
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
