// SPDX-License-Identifier: BSD-3-Clause
// Proves that ranges of bricks and sums of visible ones are those found voxel by voxel, brick by
// brick: all that skipping knows of the rest volume.
#include "Representations/Skipping/RestPresence.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace brainshift;

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();

const std::vector<glm::ivec3> Sizes{ { 17, 12, 9 }, { 1, 1, 1 }, { 2, 3, 1 }, { 5, 1, 8 },
  { 1, 40, 2 } };

template <typename T>
std::vector<T> randomValues(const glm::ivec3& size, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0.0, 65535.0);
  std::vector<T> values(static_cast<std::size_t>(size.x) * size.y * size.z);
  for (T& v : values)
  {
    v = static_cast<T>(value(random));
  }
  return values;
}

// Trilinear interpolation, clamped to the volume; NaN if a voxel it needs is no number.
template <typename T>
double valueAt(const std::vector<T>& values, const glm::ivec3& size, const glm::dvec3& position)
{
  const glm::dvec3 inside = glm::clamp(position, glm::dvec3(0.0), glm::dvec3(size - 1));
  const glm::ivec3 low = glm::min(glm::ivec3(inside), glm::max(size - 2, glm::ivec3(0)));
  const glm::dvec3 share = inside - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weights = glm::mix(1.0 - share, share, glm::dvec3(side));
    const double weight = weights.x * weights.y * weights.z;
    const glm::ivec3 at = low + side;
    sum += weight > 0.0 ? weight * values[(at.z * size.y + at.y) * size.x + at.x] : 0.0;
  }
  return sum;
}

// Range of what interpolation finds on a brick and a margin around it: trilinear functions have
// their extremes at corners.
template <typename T>
glm::vec2 rangeOf(const std::vector<T>& values, const glm::ivec3& size, const glm::ivec3& brick)
{
  const double offsets[] = { -BrickMargin, 0.0, 1.0, 2.0, 2.0 + BrickMargin };
  glm::vec2 range(Infinity, -Infinity);
  for (int i = 0; i < 125; ++i)
  {
    const glm::dvec3 offset(offsets[i % 5], offsets[i / 5 % 5], offsets[i / 25]);
    const float value = static_cast<float>(valueAt(values, size, glm::dvec3(2 * brick) + offset));
    range.x = value < range.x ? value : range.x;
    range.y = value > range.y ? value : range.y;
  }
  return range;
}

// Range of all voxels from one before the brick to one beyond the last that it touches.
template <typename T>
glm::vec2 widestRange(const std::vector<T>& values, const glm::ivec3& size, const glm::ivec3& brick)
{
  glm::vec2 range(Infinity, -Infinity);
  const glm::ivec3 low = glm::max(2 * brick - 1, glm::ivec3(0));
  const glm::ivec3 high = glm::min(2 * brick + 3, size - 1);
  glm::ivec3 at;
  for (at.z = low.z; at.z <= high.z; ++at.z)
  {
    for (at.y = low.y; at.y <= high.y; ++at.y)
    {
      for (at.x = low.x; at.x <= high.x; ++at.x)
      {
        const float value = static_cast<float>(values[(at.z * size.y + at.y) * size.x + at.x]);
        range.x = value < range.x ? value : range.x;
        range.y = value > range.y ? value : range.y;
      }
    }
  }
  return range;
}

template <typename T>
void expectRanges(const std::vector<T>& values, const glm::ivec3& size, float scale)
{
  const BrickRanges bricks = brickRanges(values.data(), size, scale);
  ASSERT_EQ(bricks.count, (size + 1) / 2);
  glm::vec2 whole(Infinity, -Infinity);
  std::size_t at = 0;
  glm::ivec3 brick;
  for (brick.z = 0; brick.z < bricks.count.z; ++brick.z)
  {
    for (brick.y = 0; brick.y < bricks.count.y; ++brick.y)
    {
      for (brick.x = 0; brick.x < bricks.count.x; ++brick.x, ++at)
      {
        // Nothing is missed; and what is found too much is at most as much as whole voxels differ.
        const glm::vec2 range = bricks.ranges[at];
        const glm::vec2 found = scale * rangeOf(values, size, brick);
        const glm::vec2 widest = scale * widestRange(values, size, brick);
        const float rounding = 1e-6f * std::max(std::abs(widest.x), std::abs(widest.y));
        EXPECT_TRUE(!(range.x > found.x + rounding)) << range.x << " " << found.x;
        EXPECT_TRUE(!(range.y < found.y - rounding)) << range.y << " " << found.y;
        EXPECT_GE(range.x, widest.x);
        EXPECT_LE(range.y, widest.y);
        whole = glm::vec2(std::min(whole.x, range.x), std::max(whole.y, range.y));
      }
    }
  }
  EXPECT_EQ(bricks.whole().x, whole.x);
  EXPECT_EQ(bricks.whole().y, whole.y);
}

// Shows values from 30 to 40 of a map of 101 entries from 0 to 100.
VisibleValues band()
{
  VisibleValues visible;
  visible.entries = 101;
  visible.before.assign(102, 0);
  for (int i = 0; i <= 100; ++i)
  {
    visible.before[i + 1] = visible.before[i] + (i >= 30 && i <= 40 ? 1 : 0);
  }
  return visible;
}
}

TEST(RestPresence, KnowsTheRangeOfEveryBrick)
{
  for (const glm::ivec3& size : Sizes)
  {
    expectRanges(randomValues<std::uint16_t>(size, 1), size, 1.0f / 65535.0f);
    expectRanges(randomValues<float>(size, 2), size, 1.0f);
  }
}

TEST(RestPresence, LeavesOutWhatIsNoNumber)
{
  const glm::ivec3 size(17, 12, 9);
  std::vector<float> values = randomValues<float>(size, 3);
  for (std::size_t i = 0; i < values.size(); i += 3)
  {
    values[i] = NAN;
  }
  expectRanges(values, size, 1.0f);
  std::fill(values.begin(), values.end(), NAN);
  expectRanges(values, size, 1.0f);
  values[100] = Infinity;
  values[101] = -Infinity;
  expectRanges(values, size, 1.0f);
}

TEST(RestPresence, TellsWhatAMapShows)
{
  const VisibleValues visible = band();
  EXPECT_TRUE(visible({ 35.0f, 35.0f }));
  EXPECT_TRUE(visible({ 0.0f, 100.0f })) << "the band lies between";
  EXPECT_TRUE(visible({ -Infinity, Infinity }));
  // An entry to either side, for rounding, and no more.
  EXPECT_TRUE(visible({ 0.0f, 28.5f }));
  EXPECT_FALSE(visible({ 0.0f, 28.0f }));
  EXPECT_TRUE(visible({ 41.5f, 100.0f }));
  EXPECT_FALSE(visible({ 42.0f, 100.0f }));
  EXPECT_FALSE(visible({ 200.0f, 300.0f })) << "beyond the end the last entry holds";
  EXPECT_FALSE(visible({ -300.0f, -200.0f }));
}

TEST(RestPresence, ScalesValuesToEntries)
{
  VisibleValues visible = band();
  visible.entryFromValue = 100.0;
  visible.entryOfValueZero = -10.0;
  EXPECT_TRUE(visible({ 0.45f, 0.45f })) << "entry 35";
  EXPECT_FALSE(visible({ 0.35f, 0.35f })) << "entry 25";
}

TEST(RestPresence, CountsVisibleBricksBelow)
{
  const glm::ivec3 size(19, 14, 11);
  std::vector<float> values = randomValues<float>(size, 4);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = i % 19 < 8 ? 20.0f : values[i] / 655.35f; // one side shows nothing
  }
  values[5] = NAN;
  const BrickRanges bricks = brickRanges(values.data(), size);
  const VisibleValues visible = band();
  const std::vector<float> sums = summedVisibility(bricks, visible);
  const glm::ivec3 corners = bricks.count + 1;
  ASSERT_EQ(sums.size(), static_cast<std::size_t>(corners.x) * corners.y * corners.z);
  glm::ivec3 corner;
  for (corner.z = 0; corner.z < corners.z; ++corner.z)
  {
    for (corner.y = 0; corner.y < corners.y; ++corner.y)
    {
      for (corner.x = 0; corner.x < corners.x; ++corner.x)
      {
        float expected = 0.0f;
        for (int i = 0; i < corner.x * corner.y * corner.z; ++i)
        {
          const glm::ivec3 brick(i % corner.x, i / corner.x % corner.y, i / corner.x / corner.y);
          const glm::vec2& range =
            bricks.ranges[(brick.z * bricks.count.y + brick.y) * bricks.count.x + brick.x];
          expected += range.x <= range.y && visible(range) ? 1.0f : 0.0f;
        }
        ASSERT_EQ(sums[(corner.z * corners.y + corner.y) * corners.x + corner.x], expected);
      }
    }
  }
  EXPECT_GT(sums.back(), 0.0f);
  EXPECT_LT(sums.back(), static_cast<float>(bricks.ranges.size()));
}

TEST(RestPresence, CountsNoBrickWithoutANumber)
{
  const glm::ivec3 size(9, 6, 5);
  std::vector<float> values(9 * 6 * 5, NAN);
  const auto any = [](const glm::vec2&) { return true; };
  EXPECT_EQ(summedVisibility(brickRanges(values.data(), size), any).back(), 0.0f);
  values[0] = 1.0f;
  EXPECT_EQ(summedVisibility(brickRanges(values.data(), size), any).back(), 1.0f);
}

TEST(RestPresence, SumsOfMoreThanSinglePrecisionHoldsAreExact)
{
  // 2^24 + 197 377 visible bricks: a volume of 514 voxels a side. From 2^24 on, every second whole
  // number is no float.
  const glm::ivec3 size(257);
  std::vector<float> sums(std::size_t(257) * 257 * 257, 1.0f);
  sumUp(sums, size);
  const auto sumAt = [&](int x, int y, int z) {
    return sums[(std::size_t(z) * size.y + y) * size.x + x];
  };
  // As presence.frag.glsl asks: `high` and all of the bricks after `low`.
  const auto visible = [&](const glm::ivec3& low, const glm::ivec3& high) {
    const float back = sumAt(high.x, high.y, high.z) - sumAt(low.x, high.y, high.z) -
      sumAt(high.x, low.y, high.z) + sumAt(low.x, low.y, high.z);
    const float front = sumAt(high.x, high.y, low.z) - sumAt(low.x, high.y, low.z) -
      sumAt(high.x, low.y, low.z) + sumAt(low.x, low.y, low.z);
    const float difference = back - front;
    return difference - SumModulus * std::floor(difference / SumModulus);
  };
  for (const int side : { 1, 2, 3, 7, 100 })
  {
    for (const int last : { 128, 255, 256 })
    {
      const glm::ivec3 high(last, 256, last);
      EXPECT_EQ(visible(high - side, high), float(side * side * side)) << side << " " << last;
    }
  }
}

TEST(RestPresence, OutliersDoNotChangeTheUsualDifference)
{
  const glm::ivec3 size(64, 64, 8);
  std::vector<float> values(64 * 64 * 8, 0.0f);
  EXPECT_EQ(usualDifference(brickRanges(values.data(), size)), 0.0f);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = static_cast<float>(i % 64); // differs by 1 from voxel to voxel along x
  }
  const float usual = usualDifference(brickRanges(values.data(), size));
  EXPECT_NEAR(usual, 2.0f + 2.0f * BrickMargin, 1e-5f);
  values[1000] = 30000.0f;
  values[1001] = Infinity;
  EXPECT_EQ(usualDifference(brickRanges(values.data(), size)), usual);
}
