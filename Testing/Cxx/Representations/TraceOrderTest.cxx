// SPDX-License-Identifier: BSD-3-Clause
// Proves that sorting points by space loses none, keeps each one's colour, puts neighbours side by
// side, and takes points that lie in one place, in a line, or nowhere.
#include "Representations/Traces/TraceDrawer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

using namespace brainshift;

namespace
{
// Points in a box, each coloured by its number.
std::vector<TraceVertex> pointsIn(const std::array<float, 3>& sides)
{
  constexpr int count = 5000;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  std::vector<TraceVertex> points;
  points.reserve(count);
  for (int i = 0; i < count; ++i)
  {
    points.push_back(
      { { sides[0] * share(random), sides[1] * share(random), sides[2] * share(random) },
        { static_cast<std::uint8_t>(i % 256), static_cast<std::uint8_t>(i / 256), 0, 255 } });
  }
  return points;
}

bool isBefore(const TraceVertex& left, const TraceVertex& right)
{
  return std::tie(left.color, left.position) < std::tie(right.color, right.position);
}

bool isSame(const TraceVertex& left, const TraceVertex& right)
{
  return left.color == right.color && left.position == right.position;
}

double meanStep(const std::vector<TraceVertex>& points)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const auto& a = points[i - 1].position;
    const auto& b = points[i].position;
    sum += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return sum / (points.size() - 1);
}
}

class TraceOrderIn : public ::testing::TestWithParam<std::array<float, 3>>
{
};

TEST_P(TraceOrderIn, KeepsEveryPoint)
{
  std::vector<TraceVertex> given = pointsIn(this->GetParam());
  std::vector<TraceVertex> sorted = sortedBySpace(given);
  std::sort(given.begin(), given.end(), isBefore);
  std::sort(sorted.begin(), sorted.end(), isBefore);
  EXPECT_TRUE(std::equal(given.begin(), given.end(), sorted.begin(), sorted.end(), isSame));
}

INSTANTIATE_TEST_SUITE_P(Boxes, TraceOrderIn,
  ::testing::Values(std::array<float, 3>{ 100.0f, 80.0f, 60.0f },
    std::array<float, 3>{ 100.0f, 0.0f, 0.0f }, std::array<float, 3>{ 0.0f, 0.0f, 0.0f }));

TEST(TraceOrder, PutsNeighboursSideBySide)
{
  const std::vector<TraceVertex> given = pointsIn({ 100.0f, 80.0f, 60.0f });
  EXPECT_LT(meanStep(sortedBySpace(given)), 0.15 * meanStep(given));
}

TEST(TraceOrder, TakesNoPoints)
{
  EXPECT_TRUE(sortedBySpace({}).empty());
}
