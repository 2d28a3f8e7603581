// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/ImageArea.h"

#include <cstddef>
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
  const glm::ivec2 low = glm::max(a.low, b.low);
  return { low, glm::max(glm::min(a.high, b.high), low) }; // OpenGL takes no negative sides
}

double pixelsIn(const PixelPart& part)
{
  const auto area = [](const PixelBox& box) {
    return static_cast<double>(box.size().x) * box.size().y;
  };
  // In turned coordinates, a box of as many pixels is twice as large.
  return part.empty() ? 0.0 : glm::min(area(part.box), 0.5 * area(part.turned));
}

namespace
{
// The part of a convex polygon where dot(normal, position) <= end (Sutherland and Hodgman, 1974).
std::vector<glm::dvec2> clipped(
  const std::vector<glm::dvec2>& polygon, const glm::dvec2& normal, double end)
{
  std::vector<glm::dvec2> result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const glm::dvec2& from = polygon[i];
    const glm::dvec2& to = polygon[(i + 1) % polygon.size()];
    const double before = end - glm::dot(normal, from);
    const double after = end - glm::dot(normal, to);
    if (before >= 0.0)
    {
      result.push_back(from);
    }
    if ((before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0))
    {
      result.push_back(glm::mix(from, to, before / (before - after)));
    }
  }
  return result;
}
}

std::vector<glm::dvec2> stripOf(const PixelPart& part)
{
  const glm::dvec2 low(part.box.low);
  const glm::dvec2 high(part.box.high);
  std::vector<glm::dvec2> corners{ low, { high.x, low.y }, high, { low.x, high.y } };
  const glm::dvec2 turnedLow(part.turned.low);
  const glm::dvec2 turnedHigh(part.turned.high);
  corners = clipped(corners, { 1.0, 1.0 }, turnedHigh.x);
  corners = clipped(corners, { -1.0, -1.0 }, -turnedLow.x);
  corners = clipped(corners, { 1.0, -1.0 }, turnedHigh.y);
  corners = clipped(corners, { -1.0, 1.0 }, -turnedLow.y);
  // From one end to the other, alternating between both sides.
  std::vector<glm::dvec2> strip;
  std::size_t first = 0;
  for (std::size_t last = corners.size(); first < last;)
  {
    strip.push_back(corners[first++]);
    if (first < last)
    {
      strip.push_back(corners[--last]);
    }
  }
  return strip;
}

bool isDrawnAsBox(const PixelPart& part)
{
  constexpr std::size_t boxCorners = 4;
  return stripOf(part).size() <= boxCorners;
}

PixelPart partOf(const PixelBox& box)
{
  return { box,
    { { box.low.x + box.low.y, box.low.x - box.high.y },
      { box.high.x + box.high.y, box.high.x - box.low.y } } };
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

ImageArea areaAround(const ImageArea& held, const glm::ivec2& picture, const PixelBox& seen)
{
  // At least a pixel, in the picture.
  const glm::ivec2 first = glm::min(seen.low, picture - 1) / Step * Step;
  const glm::ivec2 last = glm::max(seen.high - 1, first);
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
