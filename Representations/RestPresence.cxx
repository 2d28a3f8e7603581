// SPDX-License-Identifier: BSD-3-Clause
#include "RestPresence.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace brainshift
{
namespace
{
template <typename T>
glm::vec2 rangeOf(const T* values, const glm::ivec3& dimensions, const glm::ivec3& brick)
{
  const glm::ivec3 first = brick * BrickSide;
  const glm::ivec3 last = glm::min(first + BrickSide, dimensions - 1);
  float least = std::numeric_limits<float>::infinity();
  float greatest = -least;
  for (int k = first.z; k <= last.z; ++k)
  {
    for (int j = first.y; j <= last.y; ++j)
    {
      const T* row = values + (static_cast<std::size_t>(k) * dimensions.y + j) * dimensions.x;
      for (int i = first.x; i <= last.x; ++i)
      {
        const float value = static_cast<float>(row[i]);
        least = value < least ? value : least; // false for NaN
        greatest = value > greatest ? value : greatest;
      }
    }
  }
  return { least, greatest };
}

template <typename T>
BrickRanges rangesOf(const T* values, const glm::ivec3& dimensions)
{
  BrickRanges bricks;
  bricks.count = (dimensions + BrickSide - 1) / BrickSide;
  const glm::ivec3 count = bricks.count;
  bricks.ranges.resize(static_cast<std::size_t>(count.x) * count.y * count.z);
  vtkSMPTools::For(0, count.z, [&](vtkIdType begin, vtkIdType end) {
    glm::ivec3 brick;
    for (brick.z = static_cast<int>(begin); brick.z < end; ++brick.z)
    {
      for (brick.y = 0; brick.y < count.y; ++brick.y)
      {
        for (brick.x = 0; brick.x < count.x; ++brick.x)
        {
          const std::size_t index =
            (static_cast<std::size_t>(brick.z) * count.y + brick.y) * count.x + brick.x;
          bricks.ranges[index] = rangeOf(values, dimensions, brick);
        }
      }
    }
  });
  return bricks;
}
}

BrickRanges brickRanges(const float* values, const glm::ivec3& dimensions)
{
  return rangesOf(values, dimensions);
}

BrickRanges brickRanges(const std::uint16_t* values, const glm::ivec3& dimensions)
{
  return rangesOf(values, dimensions);
}

std::vector<float> summedVisibility(
  const BrickRanges& bricks, const std::function<bool(const glm::vec2&)>& visible)
{
  const glm::ivec3 size = bricks.count + 1;
  const std::size_t strideY = size.x;
  const std::size_t strideZ = strideY * size.y;
  std::vector<float> sums(strideZ * size.z, 0.0f);
  std::size_t brick = 0;
  for (int k = 1; k < size.z; ++k)
  {
    for (int j = 1; j < size.y; ++j)
    {
      float row = 0.0f;
      for (int i = 1; i < size.x; ++i, ++brick)
      {
        const glm::vec2& range = bricks.ranges[brick];
        row += range.x <= range.y && visible(range) ? 1.0f : 0.0f;
        const std::size_t at = k * strideZ + j * strideY + i;
        sums[at] = row + sums[at - strideY] + sums[at - strideZ] - sums[at - strideY - strideZ];
      }
    }
  }
  return sums;
}
}
