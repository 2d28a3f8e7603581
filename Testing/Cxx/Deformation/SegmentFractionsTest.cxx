// SPDX-License-Identifier: BSD-3-Clause
// Proves that the fractions a segment is drawn by put every voxel's middle on the side of its
// label, smoothly, on any grid.
#include "Filters/Deformation/SegmentFractions.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Testing/Cxx/Deformation/TestBall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;
using namespace brainshift::testing::ball;

namespace
{
constexpr double Half = 0.5 * WholeFraction;

// The voxels of a grid that have one of the labels; without labels, those above 0.
Mask segmentOn(const Grid& grid, const std::vector<int>& labels)
{
  Mask segment{ grid, std::vector<char>(grid.count()) };
  for (std::size_t offset = 0; offset < grid.count(); ++offset)
  {
    const int label = labelAt(grid.worldFromGrid(glm::dvec3(indexOf(grid, offset))));
    const bool isChosen = std::find(labels.begin(), labels.end(), label) != labels.end();
    segment.inside[offset] = labels.empty() ? label > 0 : isChosen;
  }
  return segment;
}
}

TEST(SegmentFractions, PutEveryVoxelOnItsSide)
{
  for (const std::vector<int>& labels : { std::vector<int>{ 3 }, { 5 }, { 3, 5 }, {} })
  {
    const Mask segment = segmentOn(VolumeGrid, labels);
    const std::vector<std::uint8_t> fractions = segmentFractions(segment, VolumeGrid);
    ASSERT_EQ(fractions.size(), VolumeGrid.count());
    for (std::size_t i = 0; i < fractions.size(); ++i)
    {
      EXPECT_EQ(fractions[i] > Half, segment.inside[i] != 0) << i;
    }
    EXPECT_GT(std::count(fractions.begin(), fractions.end(), 0), 100);
  }
}

TEST(SegmentFractions, KeepWhatIsThin)
{
  const Grid grid = plainGrid(glm::ivec3(9), glm::dvec3(1.0));
  Mask segment{ grid, std::vector<char>(grid.count(), 0) };
  segment.inside[grid.offset(4, 4, 4)] = 1;
  const std::vector<std::uint8_t> fractions = segmentFractions(segment, grid);
  EXPECT_GT(fractions[grid.offset(4, 4, 4)], Half);
  EXPECT_LT(fractions[grid.offset(5, 4, 4)], Half);
  EXPECT_GT(fractions[grid.offset(6, 4, 4)], 0) << "two voxels are smoothed into";
  EXPECT_EQ(fractions[grid.offset(7, 4, 4)], 0);
}

TEST(SegmentFractions, SlopeAcrossAFlatEdge)
{
  const Grid grid = plainGrid(glm::ivec3(12), glm::dvec3(1.0));
  Mask segment{ grid, std::vector<char>(grid.count(), 0) };
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    segment.inside[i] = i % 12 >= 6;
  }
  const std::vector<std::uint8_t> fractions = segmentFractions(segment, grid);
  const int expected[] = { 0, 0, 0, 0, 16, 80, 175, 239, 255, 255 }; // sixteenths: 0 1 5 11 15 16
  for (int x = 0; x < 10; ++x)
  {
    EXPECT_NEAR(fractions[grid.offset(x, 6, 6)], expected[x], 1.0) << x;
  }
  EXPECT_LT(fractions[grid.offset(11, 6, 6)], WholeFraction) << "nothing beyond belongs to it";
}

TEST(SegmentFractions, LieOnAnyGrid)
{
  // Against what is known: the surface of label 3 is 12 mm from the middle.
  const Grid oblique = obliqueLabels();
  const Mask segment = segmentOn(oblique, { 3 });
  const std::vector<std::uint8_t> fractions = segmentFractions(segment, VolumeGrid);
  int near = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i)
  {
    const glm::ivec3 at = indexOf(VolumeGrid, i);
    const double inside = 12.0 - glm::distance(VolumeGrid.worldFromGrid(glm::dvec3(at)), Middle);
    near += std::abs(inside) < 3.0;
    if (std::abs(inside) > 0.8)
    {
      EXPECT_EQ(fractions[i] > Half, inside > 0.0) << inside;
    }
  }
  EXPECT_GT(near, 500);
  Grid away = VolumeGrid;
  away.origin.x = 300.0;
  const std::vector<std::uint8_t> beyond = segmentFractions(segment, away);
  EXPECT_EQ(*std::max_element(beyond.begin(), beyond.end()), 0);
}
