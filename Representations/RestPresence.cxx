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
const glm::vec2 NoRange(
  std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity());

glm::vec2 asRange(const glm::vec2& range)
{
  return range;
}

glm::vec2 asRange(float value)
{
  return value == value ? glm::vec2(value) : NoRange; // NaN: none
}

glm::vec2 asRange(std::uint16_t value)
{
  return glm::vec2(static_cast<float>(value));
}

// Widens ranges by what interpolation finds BrickMargin beyond voxels `at`, towards voxels `next`.
template <typename T>
void widen(glm::vec2* ranges, const T* at, const T* next, std::size_t count)
{
  for (std::size_t s = 0; s < count; ++s)
  {
    const glm::vec2 a = asRange(at[s]);
    const glm::vec2 b = asRange(next[s]);
    if (a.x <= a.y && b.x <= b.y)
    {
      ranges[s].x = std::min(ranges[s].x, a.x + BrickMargin * (b.x - a.x));
      ranges[s].y = std::max(ranges[s].y, a.y + BrickMargin * (b.y - a.y));
    }
  }
}

// Ranges of bricks along one axis: `from` has `length` rows of `stride` consecutive values in each
// of `blocks` blocks, the result one row for each brick.
template <typename T>
std::vector<glm::vec2> rangesAlong(
  const T* from, int length, std::size_t stride, std::size_t blocks, int bricks)
{
  std::vector<glm::vec2> to(blocks * bricks * stride);
  vtkSMPTools::For(0, static_cast<vtkIdType>(blocks * bricks), [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType row = begin; row < end; ++row)
    {
      const std::size_t block = row / bricks;
      const int brick = static_cast<int>(row % bricks);
      const int first = brick * RestBrickSide;
      const int last = std::min(first + RestBrickSide, length - 1);
      glm::vec2* out = &to[row * stride];
      std::fill_n(out, stride, NoRange);
      for (int voxel = first; voxel <= last; ++voxel)
      {
        const T* in = from + (block * length + voxel) * stride;
        for (std::size_t s = 0; s < stride; ++s)
        {
          const glm::vec2 range = asRange(in[s]);
          out[s].x = std::min(out[s].x, range.x);
          out[s].y = std::max(out[s].y, range.y);
        }
      }
      widen(out, from + (block * length + first) * stride,
        from + (block * length + std::max(first - 1, 0)) * stride, stride);
      widen(out, from + (block * length + last) * stride,
        from + (block * length + std::min(last + 1, length - 1)) * stride, stride);
    }
  });
  return to;
}

template <typename T>
BrickRanges rangesOf(const T* values, const glm::ivec3& dimensions)
{
  BrickRanges bricks;
  bricks.count = (dimensions + RestBrickSide - 1) / RestBrickSide;
  const glm::ivec3& count = bricks.count;
  const std::size_t width = dimensions.x;
  // z first: its rows are the longest, and it shrinks what follows.
  const auto alongZ = rangesAlong(values, dimensions.z, width * dimensions.y, 1, count.z);
  const auto alongYZ = rangesAlong(alongZ.data(), dimensions.y, width, count.z, count.y);
  bricks.ranges = rangesAlong(
    alongYZ.data(), dimensions.x, 1, static_cast<std::size_t>(count.y) * count.z, count.x);
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
