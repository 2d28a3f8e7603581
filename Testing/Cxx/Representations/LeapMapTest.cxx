// SPDX-License-Identifier: BSD-3-Clause
// Proves that leaps are as long as the empty space around a brick allows, and never longer.
#include "Representations/Skipping/DeformedPresence.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <random>

using namespace brainshift;

namespace
{
struct Bricks
{
  glm::ivec3 count;
  std::vector<std::uint8_t> occupied;

  std::size_t at(const glm::ivec3& brick) const
  {
    return (static_cast<std::size_t>(brick.z) * this->count.y + brick.y) * this->count.x + brick.x;
  }

  template <typename Visit>
  void each(const Visit& visit) const
  {
    for (int z = 0; z < this->count.z; ++z)
    {
      for (int y = 0; y < this->count.y; ++y)
      {
        for (int x = 0; x < this->count.x; ++x)
        {
          visit(glm::ivec3(x, y, z));
        }
      }
    }
  }

  // The answer by definition: every brick looked at.
  int distance(const glm::ivec3& from) const
  {
    int least = LongestLeap;
    this->each([&](const glm::ivec3& to) {
      const glm::ivec3 away = glm::abs(to - from);
      if (this->occupied[this->at(to)])
      {
        least = std::min(least, std::max({ away.x, away.y, away.z }));
      }
    });
    return least;
  }
};

Bricks scattered(const glm::ivec3& count, int occupied, unsigned int seed)
{
  Bricks bricks{ count, std::vector<std::uint8_t>(std::size_t(count.x) * count.y * count.z, 0) };
  std::mt19937 random(seed);
  for (int i = 0; i < occupied; ++i)
  {
    bricks.occupied[random() % bricks.occupied.size()] = 255;
  }
  return bricks;
}
}

TEST(LeapMap, IsTheDistanceToTheNearestOccupiedBrick)
{
  unsigned int seed = 1;
  for (const glm::ivec3 count : { glm::ivec3(1), glm::ivec3(2, 1, 3), glm::ivec3(5, 23, 4),
         glm::ivec3(21, 17, 19), glm::ivec3(40, 3, 3) })
  {
    for (const int occupied : { 0, 1, 2, 30 })
    {
      const Bricks bricks = scattered(count, occupied, seed++);
      const auto distances = bricksToOccupied(bricks.occupied, count);
      bricks.each([&](const glm::ivec3& brick) {
        ASSERT_EQ(distances[bricks.at(brick)], bricks.distance(brick))
          << brick.x << " " << brick.y << " " << brick.z << " of " << count.x << " " << count.y
          << " " << count.z << ", " << occupied << " occupied";
      });
    }
  }
}
