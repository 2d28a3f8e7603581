// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/SegmentFractions.h"

#include "Common/Parallel.h"

#include <algorithm>

namespace brainshift
{
namespace
{
using Fractions = std::vector<std::uint8_t>;

constexpr int LeastInside = 136; // at the middle of a voxel that belongs to the segment
constexpr int GreatestOutside = WholeFraction - LeastInside;

// Calls visit(row, first) for all rows of a grid along `axis`, `first` being the row's first voxel.
template <typename Visit>
void forRows(const glm::ivec3& side, int axis, const Visit& visit)
{
  const int slow = axis == 2 ? 1 : 2;
  const int fast = axis == 0 ? 1 : 0;
  const std::ptrdiff_t stride[3] = { 1, side.x, static_cast<std::ptrdiff_t>(side.x) * side.y };
  parallelFor(0, side[slow], 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t outer = begin; outer < end; ++outer)
    {
      for (int inner = 0; inner < side[fast]; ++inner)
      {
        visit(outer * stride[slow] + inner * stride[fast]);
      }
    }
  });
}

// One axis of a binomial filter; nothing beyond the ends belongs to the segment.
void smoothAlong(Fractions& fractions, const glm::ivec3& side, int axis)
{
  const int count = side[axis];
  const std::ptrdiff_t stride = axis == 0 ? 1
    : axis == 1                           ? side.x
                                          : static_cast<std::ptrdiff_t>(side.x) * side.y;
  forRows(side, axis, [&](std::ptrdiff_t first) {
    std::uint8_t* const row = &fractions[first];
    int before = 0; // two voxels back, as they were
    int previous = 0;
    for (int i = 0; i < count; ++i)
    {
      const int here = row[i * stride];
      const int next = i + 1 < count ? row[(i + 1) * stride] : 0;
      const int last = i + 2 < count ? row[(i + 2) * stride] : 0;
      row[i * stride] =
        static_cast<std::uint8_t>((before + 4 * previous + 6 * here + 4 * next + last + 8) / 16);
      before = previous;
      previous = here;
    }
  });
}

Fractions smoothed(const Mask& segment)
{
  const std::vector<char>& inside = segment.inside;
  Fractions fractions(inside.size());
  std::transform(inside.begin(), inside.end(), fractions.begin(),
    [](char in) { return static_cast<std::uint8_t>(in ? WholeFraction : 0); });
  for (int axis = 0; axis < 3; ++axis)
  {
    smoothAlong(fractions, segment.grid.dimensions, axis);
  }
  std::transform(
    inside.begin(), inside.end(), fractions.begin(), fractions.begin(), [](char in, int fraction) {
      return static_cast<std::uint8_t>(
        in ? std::max(fraction, LeastInside) : std::min(fraction, GreatestOutside));
    });
  return fractions;
}

// Trilinear, at a position in points of the grid.
float fractionAt(const Fractions& fractions, const Grid& grid, const glm::dvec3& position)
{
  const glm::dvec3 end(grid.dimensions);
  if (glm::any(glm::lessThan(position, glm::dvec3(-0.5))) ||
    glm::any(glm::greaterThan(position, end - 0.5)))
  {
    return 0.0f;
  }
  const glm::dvec3 within = glm::clamp(position, glm::dvec3(0.0), end - 1.0);
  const glm::ivec3 low(within);
  const glm::ivec3 high = glm::min(low + 1, grid.dimensions - 1);
  const glm::vec3 part(within - glm::dvec3(low));
  const auto at = [&](int x, int y, int z) {
    return static_cast<float>(fractions[grid.offset(x, y, z)]);
  };
  const auto alongX = [&](int y, int z) {
    return glm::mix(at(low.x, y, z), at(high.x, y, z), part.x);
  };
  return glm::mix(glm::mix(alongX(low.y, low.z), alongX(high.y, low.z), part.y),
    glm::mix(alongX(low.y, high.z), alongX(high.y, high.z), part.y), part.z);
}
}

std::vector<std::uint8_t> segmentFractions(const Mask& segment, const Grid& points)
{
  const Fractions own = smoothed(segment);
  if (points == segment.grid)
  {
    return own;
  }
  Fractions fractions(points.count());
  const glm::ivec3& side = points.dimensions;
  const auto inSegment = [&](const glm::dvec3& at) {
    return segment.grid.gridFromWorld(points.worldFromGrid(at));
  };
  const glm::dvec3 first = inSegment(glm::dvec3(0.0));
  const glm::dmat3 step(inSegment({ 1.0, 0.0, 0.0 }) - first, inSegment({ 0.0, 1.0, 0.0 }) - first,
    inSegment({ 0.0, 0.0, 1.0 }) - first);
  parallelFor(0, side.z, 1, [&](std::int64_t begin, std::int64_t end) {
    std::size_t at = begin * static_cast<std::size_t>(side.x) * side.y;
    for (std::int64_t z = begin; z < end; ++z)
    {
      for (int y = 0; y < side.y; ++y)
      {
        for (int x = 0; x < side.x; ++x, ++at)
        {
          const glm::dvec3 position = first + step * glm::dvec3(x, y, z);
          fractions[at] = static_cast<std::uint8_t>(fractionAt(own, segment.grid, position) + 0.5f);
        }
      }
    }
  });
  return fractions;
}
}
