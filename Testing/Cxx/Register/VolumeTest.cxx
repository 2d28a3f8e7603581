// SPDX-License-Identifier: BSD-3-Clause
// Proves the operations of a pyramid against plain loops and linear functions.
#include "Filters/Register/Volume.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

TEST(RegisterVolume, BoxSumsAreThoseOfAPlainLoop)
{
  Grid grid;
  grid.dimensions = { 7, 5, 6 };
  const Volume before =
    filled(grid, [](const glm::dvec3& at) { return std::sin(at.x + 3 * at.y + 7 * at.z); });
  Volume sums = before;
  boxSum(sums, { 2, 1, 0 });
  for (int k = 0; k < 6; ++k)
  {
    for (int j = 0; j < 5; ++j)
    {
      for (int i = 0; i < 7; ++i)
      {
        float plain = 0.0f;
        for (int c = k; c <= k; ++c)
        {
          for (int b = std::max(0, j - 1); b <= std::min(4, j + 1); ++b)
          {
            for (int a = std::max(0, i - 2); a <= std::min(6, i + 2); ++a)
            {
              plain += before.values[grid.offset(a, b, c)];
            }
          }
        }
        EXPECT_NEAR(sums.values[grid.offset(i, j, k)], plain, 1e-4);
      }
    }
  }
}

TEST(RegisterVolume, SmoothingKeepsWhatIsLinear)
{
  const Grid grid = smallGrid();
  const auto linear = [](const glm::dvec3& at) { return 3.0 * at.x - 2.0 * at.y + at.z; };
  const Volume coarse = resampled(smoothed(filled(grid, linear), 4.0), coarseGrid(grid, 4.0));
  EXPECT_EQ(coarse.grid.spacing, glm::dvec3(4.0));
  EXPECT_EQ(coarse.grid.origin, grid.origin);
  const glm::ivec3 at(9, 8, 7);
  EXPECT_NEAR(coarse.values[coarse.grid.offset(at.x, at.y, at.z)],
    linear(coarse.grid.worldFromGrid(at)), 1e-2);
}

TEST(RegisterVolume, SmoothingTakesAwayWhatACoarseGridCannotHold)
{
  Grid grid;
  grid.dimensions = { 40, 40, 40 };
  const Volume stripes =
    filled(grid, [](const glm::dvec3& at) { return int(at.x) % 2 ? 1.0 : -1.0; });
  const Volume smooth = smoothed(stripes, 4.0);
  EXPECT_NEAR(smooth.values[grid.offset(20, 20, 20)], 0.0, 0.01);
  EXPECT_EQ(smoothed(stripes, 0.5).values, stripes.values) << "a finer grid needs no smoothing";
}

TEST(RegisterVolume, SamplingSmoothsAndReads)
{
  const Volume volume = filled(smallGrid(), tissue);
  Grid other = coarseGrid(volume.grid, 3.0);
  other.origin = volume.grid.worldFromGrid({ -1.3, 0.7, 2.2 }); // some points lie outside
  Grid rotated = other;
  rotated.direction = glm::dmat3(other.direction[1], -other.direction[0], other.direction[2]);
  for (const Grid& to : { coarseGrid(volume.grid, 4.0), other, rotated })
  {
    const Volume expected = resampled(smoothed(volume, 4.0), to);
    const Volume found = sampled(volume, 4.0, to);
    ASSERT_EQ(found.values.size(), expected.values.size());
    EXPECT_EQ(found.grid, to);
    for (std::size_t i = 0; i < found.values.size(); ++i)
    {
      ASSERT_NEAR(found.values[i], expected.values[i], 1e-2);
    }
  }
}

TEST(RegisterVolume, SlopesAreDerivatives)
{
  const Volume volume = filled(smallGrid(), tissue);
  const auto at = [&](const glm::vec3& position) {
    return trilinear(volume.values.data(), neighboursOf(volume.grid.dimensions, position));
  };
  const glm::vec3 place(10.3f, 7.6f, 12.2f);
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::vec3 step(0.0f);
    step[axis] = 0.1f;
    const float difference = (at(place + step).value - at(place - step).value) / 0.2f;
    EXPECT_NEAR(at(place).slope[axis], difference, 1e-2);
  }
  EXPECT_FALSE(neighboursOf(volume.grid.dimensions, { -0.1f, 3.0f, 3.0f }).isInside);
  EXPECT_TRUE(neighboursOf(volume.grid.dimensions, { 39.0f, 3.0f, 3.0f }).isInside);
}

TEST(RegisterVolume, ValuesRiseAlongADirection)
{
  const glm::dvec3 slope(3.0, -1.0, 2.0); // world
  const Volume volume =
    filled(smallGrid(12), [&](const glm::dvec3& at) { return glm::dot(slope, at); });
  const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 1.0, 4.0));
  const float rise = static_cast<float>(glm::dot(slope, direction));
  for (const float found : riseAlong(volume, direction))
  {
    EXPECT_NEAR(found, rise, 1e-3);
  }
  for (const float found : riseAlong(volume, -direction))
  {
    EXPECT_EQ(found, 0.0f) << "it falls";
  }
}

TEST(RegisterVolume, WeightsShrink)
{
  const Grid grid = smallGrid();
  const Mask removed = ball(grid, grid.worldFromGrid({ 20, 20, 20 }), 7.0);
  const Volume weights = weightsOf(grid, { &grid, nullptr, { &removed } }, { 2, 1 });
  const auto at = [&](int i) { return weights.values[grid.offset(i, 20, 20)]; };
  EXPECT_EQ(at(20), 0.0f);
  EXPECT_EQ(at(25), 0.0f) << "2 points beside the last voxel of the ball";
  EXPECT_EQ(at(26), 1.0f);
  const auto diagonal = [&](int i) { return weights.values[grid.offset(i, i, 20)]; };
  EXPECT_EQ(diagonal(23), 0.0f);
  EXPECT_EQ(diagonal(24), 1.0f) << "the ball reaches to 22, and across it is only 1 point";
  EXPECT_EQ(at(0), 1.0f) << "the border of the grid shrinks nothing";
  Grid moved = grid;
  moved.origin = grid.worldFromGrid({ 10, 0, 0 });
  const Volume within = weightsOf(grid, { &moved, &removed, {} }, {});
  EXPECT_EQ(within.values[grid.offset(20, 20, 20)], 1.0f);
  EXPECT_EQ(within.values[grid.offset(30, 20, 20)], 0.0f) << "not in the mask";
  EXPECT_EQ(weightsOf(grid, { &moved, nullptr, {} }, {}).values[grid.offset(9, 5, 5)], 0.0f);
}

TEST(RegisterVolume, RangesLeaveOutFewValues)
{
  std::vector<float> values(10000, 5.0f);
  std::fill(values.begin(), values.begin() + 5000, 1.0f);
  values[3] = 1e9f;
  values[9000] = -1e9f;
  const Range range = rangeOf(values);
  EXPECT_EQ(range.low, 1.0f);
  EXPECT_EQ(range.high, 5.0f);
  EXPECT_EQ(range.fraction(3.0f), 0.5f);
  EXPECT_EQ(range.fraction(1e9f), 1.0f);
}
