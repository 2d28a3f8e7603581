// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/FieldChange.h"

#include <algorithm>
#include <limits>

namespace brainshift
{
namespace
{
constexpr int KernelRadius = 2; // cells to either side of a control point that depend on it

std::size_t pointOffset(const glm::ivec3& dimensions, const glm::ivec3& index)
{
  return (static_cast<std::size_t>(index.z) * dimensions.y + index.y) * dimensions.x + index.x;
}

// Least and greatest displacement the kernel can make of the control points in a box.
struct DisplacementRange
{
  glm::vec3 least{ 0.0f };
  glm::vec3 greatest{ 0.0f };

  void add(const std::vector<glm::vec3>& inCells, const glm::ivec3& dimensions, const IndexBox& box)
  {
    forEachIndex(box.first, box.last, [&](const glm::ivec3& index) {
      const glm::vec3& displacement = inCells[pointOffset(dimensions, index)];
      this->least = glm::min(this->least, displacement);
      this->greatest = glm::max(this->greatest, displacement);
    });
  }

  void allowOvershoot()
  {
    const glm::vec3 middle = 0.5f * (this->least + this->greatest);
    const glm::vec3 half = 0.5f * KernelOvershoot * (this->greatest - this->least);
    this->least = middle - half;
    this->greatest = middle + half;
  }
};

// A box in lattice coordinates.
struct Support
{
  glm::vec3 low;
  glm::vec3 high;
};

// All that depends on a control point. At the border the kernel repeats the last one, and beyond it
// the border holds.
Support supportOf(const glm::ivec3& point, const glm::ivec3& dimensions)
{
  constexpr float far = 1000.0f; // cells
  const glm::vec3 low(point - KernelRadius);
  const glm::vec3 high(point + KernelRadius);
  return { glm::mix(low, glm::vec3(-far), glm::lessThan(low, glm::vec3(0.0f))),
    glm::mix(high, glm::vec3(far), glm::greaterThan(high, glm::vec3(dimensions - 1))) };
}

void widen(SlabHull& hull, const Support& support)
{
  const glm::vec3 middle = 0.5f * (support.low + support.high);
  const glm::vec3 half = 0.5f * (support.high - support.low);
  for (int i = 0; i < SlabDirections; ++i)
  {
    const glm::vec3 direction = slabDirection(i);
    const float at = glm::dot(direction, middle);
    const float around = glm::dot(glm::abs(direction), half);
    hull.spans[i] =
      glm::vec2(std::min(hull.spans[i].x, at - around), std::max(hull.spans[i].y, at + around));
  }
}

bool contains(const IndexBox& box, const glm::ivec3& index)
{
  return glm::all(glm::greaterThanEqual(index, box.first)) &&
    glm::all(glm::lessThanEqual(index, box.last));
}

// Whether all control points that move are inside(index).
template <typename Inside>
bool staysOutside(
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& inCells, const Inside& inside)
{
  std::size_t point = 0;
  glm::ivec3 index;
  for (index.z = 0; index.z < dimensions.z; ++index.z)
  {
    for (index.y = 0; index.y < dimensions.y; ++index.y)
    {
      for (index.x = 0; index.x < dimensions.x; ++index.x, ++point)
      {
        if (inCells[point] != glm::vec3(0.0f) && !inside(index))
        {
          return false;
        }
      }
    }
  }
  return true;
}
}

IndexBox enclosing(const IndexBox& a, const IndexBox& b)
{
  if (a.empty() || b.empty())
  {
    return a.empty() ? b : a;
  }
  return { glm::min(a.first, b.first), glm::max(a.last, b.last) };
}

IndexBox changedPoints(const glm::ivec3& dimensions, const std::vector<glm::vec3>& before,
  const std::vector<glm::vec3>& after)
{
  IndexBox box{ dimensions, glm::ivec3(-1) };
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), dimensions - 1, [&](const glm::ivec3& index) {
    if (before[point] != after[point])
    {
      box.first = glm::min(box.first, index);
      box.last = glm::max(box.last, index);
    }
    ++point;
  });
  return box;
}

IndexBox changedForwardNodes(const IndexBox& points, const FieldNodes& forward)
{
  if (points.empty())
  {
    return {};
  }
  return { glm::max((points.first - KernelRadius) * forward.perCell, glm::ivec3(0)),
    glm::min((points.last + KernelRadius) * forward.perCell, forward.count - 1) };
}

namespace
{
// How far from where a control point reaches offsets can differ: cells.
struct Spread
{
  glm::vec3 low{ 0.0f };
  glm::vec3 high{ 0.0f };
};

// `points`: those that change. `alone`: no others move; tissue on the surface of what changes then
// stays, and so does all that is seen beyond it.
Spread spreadOf(const IndexBox& points, bool alone, const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after)
{
  if (alone)
  {
    return {};
  }
  const IndexBox taps{ glm::max(points.first - 2 * KernelRadius, glm::ivec3(0)),
    glm::min(points.last + 2 * KernelRadius, dimensions - 1) };
  DisplacementRange range;
  range.add(before, dimensions, taps);
  range.add(after, dimensions, taps);
  range.allowOvershoot();
  return { range.least - 1.0f, range.greatest + 1.0f };
}
}

IndexBox changedBackwardNodes(const IndexBox& points, const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after,
  const FieldNodes& backward)
{
  if (points.empty())
  {
    return {};
  }
  const glm::ivec3 lowCell = points.first - KernelRadius;
  const glm::ivec3 highCell = points.last + KernelRadius;
  const bool alone = staysOutside(
    dimensions, after, [&](const glm::ivec3& index) { return contains(points, index); });
  const Spread spread = spreadOf(points, alone, dimensions, before, after);
  const glm::vec3 low = glm::vec3(lowCell) + spread.low;
  const glm::vec3 high = glm::vec3(highCell) + spread.high;
  const glm::vec3 first(backward.first);
  const float perCell = static_cast<float>(backward.perCell);
  IndexBox box{ glm::max(glm::ivec3(glm::floor((low - first) * perCell)), glm::ivec3(0)),
    glm::min(glm::ivec3(glm::ceil((high - first) * perCell)), backward.count - 1) };
  for (int axis = 0; axis < 3; ++axis)
  {
    // Outside the lattice its border holds, so a change there reaches on to the end.
    box.first[axis] = lowCell[axis] <= 0 ? 0 : box.first[axis];
    box.last[axis] =
      highCell[axis] >= dimensions[axis] - 1 ? backward.count[axis] - 1 : box.last[axis];
  }
  return box;
}

namespace
{
// Rows of control points along x, each from the first to the last that changes.
class ChangedRows
{
public:
  ChangedRows(const IndexBox& points, const glm::ivec3& dimensions,
    const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after)
    : Points(points)
  {
    for (int z = points.first.z; z <= points.last.z; ++z)
    {
      for (int y = points.first.y; y <= points.last.y; ++y)
      {
        glm::ivec2 ends(points.last.x + 1, points.first.x - 1); // first, last
        for (int x = points.first.x; x <= points.last.x; ++x)
        {
          const std::size_t point = pointOffset(dimensions, { x, y, z });
          if (before[point] != after[point])
          {
            ends = { glm::min(ends.x, x), x };
          }
        }
        this->Ends.push_back(ends);
      }
    }
  }

  // First and last of a row in the box; first > last: none changes.
  const glm::ivec2& ends(int y, int z) const
  {
    return this->Ends[static_cast<std::size_t>(z - this->Points.first.z) * this->Points.size().y +
      (y - this->Points.first.y)];
  }

  bool contain(const glm::ivec3& index) const
  {
    if (!contains(this->Points, index))
    {
      return false;
    }
    const glm::ivec2& row = this->ends(index.y, index.z);
    return row.x <= index.x && index.x <= row.y;
  }

private:
  IndexBox Points;
  std::vector<glm::ivec2> Ends;
};
}

std::vector<glm::vec3> cornersOfChange(const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after, float margin)
{
  std::vector<glm::vec3> corners;
  const IndexBox points = changedPoints(dimensions, before, after);
  if (points.empty())
  {
    return corners;
  }
  const ChangedRows rows(points, dimensions, before, after);
  const bool alone =
    staysOutside(dimensions, after, [&](const glm::ivec3& index) { return rows.contain(index); });
  const Spread spread = spreadOf(points, alone, dimensions, before, after);
  for (int z = points.first.z; z <= points.last.z; ++z)
  {
    for (int y = points.first.y; y <= points.last.y; ++y)
    {
      const glm::ivec2& row = rows.ends(y, z);
      if (row.x > row.y)
      {
        continue;
      }
      const glm::vec3 low = supportOf({ row.x, y, z }, dimensions).low + spread.low - margin;
      const glm::vec3 high = supportOf({ row.y, y, z }, dimensions).high + spread.high + margin;
      for (int corner = 0; corner < 8; ++corner)
      {
        corners.push_back(
          glm::mix(low, high, glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1)));
      }
    }
  }
  return corners;
}

SlabHull::SlabHull()
{
  constexpr float all = std::numeric_limits<float>::max();
  this->spans.fill(glm::vec2(all, -all));
}

glm::vec3 slabDirection(int index)
{
  static const std::array<glm::vec3, SlabDirections> directions{ { { 1, 0, 0 }, { 0, 1, 0 },
    { 0, 0, 1 }, { 1, 1, 0 }, { 1, -1, 0 }, { 1, 0, 1 }, { 1, 0, -1 }, { 0, 1, 1 }, { 0, 1, -1 },
    { 1, 1, 1 }, { 1, 1, -1 }, { 1, -1, 1 }, { 1, -1, -1 } } };
  return directions[index];
}

SlabHull movedHull(const glm::ivec3& dimensions, const std::vector<glm::vec3>& inCells)
{
  SlabHull hull;
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), dimensions - 1, [&](const glm::ivec3& index) {
    if (inCells[point++] != glm::vec3(0.0f))
    {
      widen(hull, supportOf(index, dimensions));
    }
  });
  return hull;
}
}
