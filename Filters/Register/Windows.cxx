// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Windows.h"

#include "Common/Parallel.h"

#include <algorithm>
#include <cstdint>

namespace brainshift
{
namespace
{
void add(const float* from, std::size_t count, float* to)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] += from[i];
  }
}

// Sums of a line's points for its window `number`. A point has `inner` numbers.
void gatherOne(const float* points, int count, std::size_t inner, int number, float* to)
{
  std::fill(to, to + inner, 0.0f);
  const int middle = number * WindowStride;
  const int last = std::min(count - 1, middle + WindowRadius);
  for (int i = std::max(0, middle - WindowRadius); i <= last; ++i)
  {
    add(points + i * inner, inner, to);
  }
}

// Sums of the windows that hold point `number` of a line of `count` points.
void spreadOne(const float* windows, int count, std::size_t inner, int number, float* to)
{
  std::fill(to, to + inner, 0.0f);
  const int first = std::max(0, windowsAlong(number - WindowRadius));
  const int last = std::min(windowsAlong(count) - 1, (number + WindowRadius) / WindowStride);
  for (int window = first; window <= last; ++window)
  {
    add(windows + window * inner, inner, to);
  }
}

using One = void (*)(const float*, int, std::size_t, int, float*);

// Along y or z of a block. `points`: how many a line has, where that is not what `from` has.
Block along(const Block& from, int axis, int points, int results, One one)
{
  glm::ivec3 sides = from.dimensions;
  sides[axis] = results;
  Block to(sides, from.numbers);
  std::size_t inner = static_cast<std::size_t>(from.numbers) * sides.x;
  inner *= axis == 2 ? sides.y : 1;
  const std::int64_t outer = axis == 2 ? 1 : sides.z;
  const std::size_t line = inner * from.dimensions[axis];
  parallelFor(0, outer * results, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t n = begin; n < end; ++n)
    {
      one(from.values.data() + n / results * line, points, inner, static_cast<int>(n % results),
        to.values.data() + n * inner);
    }
  });
  return to;
}
}

void gatherRow(const float* points, int count, int numbers, float* windows)
{
  for (int number = 0; number < windowsAlong(count); ++number)
  {
    gatherOne(points, count, numbers, number, windows + number * numbers);
  }
}

void spreadRow(const float* windows, int count, int numbers, float* points)
{
  for (int number = 0; number < count; ++number)
  {
    spreadOne(windows, count, numbers, number, points + number * numbers);
  }
}

Block gathered(const Block& rows)
{
  const glm::ivec3 points = rows.dimensions;
  return along(along(rows, 1, points.y, windowsAlong(points.y), gatherOne), 2, points.z,
    windowsAlong(points.z), gatherOne);
}

Block spread(const Block& windows, const glm::ivec3& points)
{
  return along(along(windows, 2, points.z, points.z, spreadOne), 1, points.y, points.y, spreadOne);
}
}
