// SPDX-License-Identifier: BSD-3-Clause
// Proves that a line of sight meets the planes between its ends only, nearest first, where they lie
// in the world.
#include "Representations/Slices/SliceGeometry.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <utility>
#include <vector>

using namespace brainshift;

namespace
{
// A box of 100 x 200 x 50 mm from (10, 20, 30) mm on, with its planes through the middle.
DrawnSlices someSlices()
{
  DrawnSlices slices;
  slices.worldFromTexture =
    glm::scale(glm::translate(glm::dmat4(1.0), glm::dvec3(10, 20, 30)), glm::dvec3(100, 200, 50));
  return slices;
}

const glm::dvec3 Middle(60, 120, 55);
}

TEST(SlicePick, MeetsThePlanesBetweenTheEndsOfALine)
{
  const DrawnSlices slices = someSlices();
  const glm::dvec3 aside(9, -7, 0); // of the other two planes
  const glm::dvec3 above = Middle + aside + glm::dvec3(0, 0, 20);
  const glm::dvec3 below = Middle + aside - glm::dvec3(0, 0, 20);
  for (const auto& [from, to] : { std::pair{ above, below }, { below, above } })
  {
    const std::vector<SliceHit> hits = hitsAlong(slices, from, to);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_LT(glm::distance(hits[0].world, Middle + aside), 1e-9);
    EXPECT_LT(glm::distance(hits[0].texture, glm::dvec3(0.59, 0.465, 0.5)), 1e-9);
    EXPECT_NEAR(std::abs(hits[0].normal.z), 1.0, 1e-9);
  }
  EXPECT_TRUE(hitsAlong(slices, above, above - glm::dvec3(0, 0, 19)).empty()) << "ends before it";
  EXPECT_EQ(hitsAlong(slices, above, above - glm::dvec3(0, 0, 21)).size(), 1U);
  EXPECT_TRUE(hitsAlong(slices, above, above + glm::dvec3(0, 0, 20)).empty()) << "leads away";
  const glm::dvec3 beside(51, 0, 0); // of the box
  EXPECT_TRUE(hitsAlong(slices, above + beside, below + beside).empty());
}

TEST(SlicePick, TellsTheNearestFirst)
{
  const DrawnSlices slices = someSlices();
  const glm::dvec3 from = Middle + glm::dvec3(30, 20, 10);
  const glm::dvec3 to = Middle - glm::dvec3(30, 60, 20);
  const std::vector<SliceHit> hits = hitsAlong(slices, from, to);
  ASSERT_EQ(hits.size(), 3U);
  double last = 0.0;
  for (const SliceHit& hit : hits)
  {
    EXPECT_GT(glm::distance(from, hit.world), last);
    last = glm::distance(from, hit.world);
  }
  EXPECT_NEAR(hits[0].world.y, Middle.y, 1e-9); // after a quarter, a third and a half
  EXPECT_NEAR(hits[1].world.z, Middle.z, 1e-9);
  EXPECT_NEAR(hits[2].world.x, Middle.x, 1e-9);
}

TEST(SlicePick, MeetsWhatIsShownOnly)
{
  DrawnSlices slices = someSlices();
  slices.planes.shown.z = false;
  const glm::dvec3 up(1, 2, 30);
  const std::vector<SliceHit> hits = hitsAlong(slices, Middle + up, Middle - 2.0 * up);
  ASSERT_EQ(hits.size(), 2U);
  for (const SliceHit& hit : hits)
  {
    EXPECT_LT(std::abs(hit.normal.z), 0.5);
  }
}
