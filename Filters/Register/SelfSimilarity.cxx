// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/SelfSimilarity.h"

#include "Common/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace brainshift
{
namespace
{
// The local noise is not taken smaller or larger than so many times its mean.
constexpr float LeastNoise = 0.01f;
constexpr float LargestNoise = 1000.0f;

// The six neighbours, two along each axis.
glm::ivec3 neighbour(int number)
{
  glm::ivec3 offset(0);
  offset[number / 2] = number % 2 ? -SelfSimilarityDistance : SelfSimilarityDistance;
  return offset;
}

// The squared difference of two neighbours, added up over a box around each point.
void compare(const Volume& volume, const glm::ivec3& a, const glm::ivec3& b, Volume& sums)
{
  const Grid& grid = volume.grid;
  const glm::ivec3 last = grid.dimensions - 1;
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    for (int k = static_cast<int>(begin); k < end; ++k)
    {
      for (int j = 0; j <= last.y; ++j)
      {
        const auto row = [&](const glm::ivec3& offset) {
          return &volume.values[grid.offset(
            0, std::clamp(j + offset.y, 0, last.y), std::clamp(k + offset.z, 0, last.z))];
        };
        const float* fromA = row(a);
        const float* fromB = row(b);
        float* to = &sums.values[grid.offset(0, j, k)];
        for (int i = 0; i <= last.x; ++i)
        {
          const float difference =
            fromA[std::clamp(i + a.x, 0, last.x)] - fromB[std::clamp(i + b.x, 0, last.x)];
          to[i] = difference * difference;
        }
      }
    }
  });
  boxSum(sums, glm::ivec3(SelfSimilarityRadius));
}

// Turns sums of squares into numbers from 0 to 1, where 1 is the most alike pair.
void normalise(float* numbers, float meanNoise)
{
  float sum = 0.0f;
  float least = numbers[0];
  for (int pair = 0; pair < SelfSimilarityNumbers; ++pair)
  {
    sum += numbers[pair];
    least = std::min(least, numbers[pair]);
  }
  const float noise =
    std::clamp(sum / SelfSimilarityNumbers, LeastNoise * meanNoise, LargestNoise * meanNoise);
  for (int pair = 0; pair < SelfSimilarityNumbers; ++pair)
  {
    numbers[pair] = noise > 0.0f ? std::exp((least - numbers[pair]) / noise) : 1.0f;
  }
}
}

std::vector<float> selfSimilarity(const Volume& volume)
{
  const std::int64_t count = static_cast<std::int64_t>(volume.values.size());
  std::vector<float> result(volume.values.size() * SelfSimilarityNumbers);
  Volume sums{ volume.grid, std::vector<float>(volume.values.size()) };
  const std::int64_t slab = static_cast<std::int64_t>(volume.grid.offset(0, 0, 1));
  std::vector<double> slabSums(volume.grid.dimensions.z, 0.0);
  int pair = 0;
  for (int a = 0; a < 6; ++a)
  {
    for (int b = a + 1; b < 6; ++b)
    {
      if (a / 2 == b / 2)
      {
        continue; // across the middle: it would compare with itself where the volume is symmetric
      }
      compare(volume, neighbour(a), neighbour(b), sums);
      parallelFor(0, volume.grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k)
        {
          for (std::int64_t i = k * slab; i < (k + 1) * slab; ++i)
          {
            result[i * SelfSimilarityNumbers + pair] = sums.values[i];
            slabSums[k] += sums.values[i];
          }
        }
      });
      ++pair;
    }
  }
  const double all = std::accumulate(slabSums.begin(), slabSums.end(), 0.0);
  const float meanNoise = static_cast<float>(all / result.size());
  parallelFor(0, count, 1000, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      normalise(&result[i * SelfSimilarityNumbers], meanNoise);
    }
  });
  return result;
}
}
