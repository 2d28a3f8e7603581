// SPDX-License-Identifier: BSD-3-Clause
// Proves that skipping keeps each brick in which a segment may be seen, margin included, and no
// brick that lies farther away; and which labels are drawn.
#include "Representations/Tissue/SegmentTexture.h"
#include "Filters/Deformation/SegmentFractions.h"
#include "Representations/Scene/SceneGeometry.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <random>

using namespace brainshift;

namespace
{
constexpr int Seen =
  static_cast<int>(LeastFraction * WholeFraction) + 1; // the least fraction that is

// Whether interpolation may find a visible share on a brick and the margin around it.
bool mayShow(
  const std::vector<std::uint8_t>& shares, const glm::ivec3& size, const glm::ivec3& brick)
{
  const glm::dvec3 reach(BrickMargin);
  const glm::dvec3 first = glm::dvec3(RestBrickSide * brick) - reach;
  const glm::dvec3 last = glm::dvec3(RestBrickSide * (brick + 1)) + reach;
  const glm::ivec3 low(glm::clamp(glm::floor(first), glm::dvec3(0.0), glm::dvec3(size - 1)));
  const glm::ivec3 high(glm::clamp(glm::ceil(last), glm::dvec3(0.0), glm::dvec3(size - 1)));
  glm::ivec3 at;
  for (at.z = low.z; at.z <= high.z; ++at.z)
  {
    for (at.y = low.y; at.y <= high.y; ++at.y)
    {
      for (at.x = low.x; at.x <= high.x; ++at.x)
      {
        if (shares[(at.z * size.y + at.y) * size.x + at.x] >= Seen)
        {
          return true;
        }
      }
    }
  }
  return false;
}
}

TEST(SegmentTexture, KnowsTheBricksItReaches)
{
  std::mt19937 random(3);
  for (const glm::ivec3& size :
    { glm::ivec3(17, 12, 9), glm::ivec3(1, 1, 1), glm::ivec3(2, 30, 5) })
  {
    std::vector<std::uint8_t> shares(size.x * size.y * size.z, Seen - 1);
    for (std::size_t i = 0; i < shares.size() / 100 + 1; ++i)
    {
      shares[random() % shares.size()] = Seen;
    }
    const std::vector<char> reaching = bricksReaching(shares, size);
    const glm::ivec3 count = (size + RestBrickSide - 1) / RestBrickSide;
    ASSERT_EQ(reaching.size(), static_cast<std::size_t>(count.x * count.y * count.z));
    for (std::size_t i = 0; i < reaching.size(); ++i)
    {
      const glm::ivec3 brick(i % count.x, i / count.x % count.y, i / count.x / count.y);
      EXPECT_EQ(reaching[i] != 0, mayShow(shares, size, brick)) << i;
    }
  }
}

TEST(SegmentTexture, LeavesOtherBricksWithoutANumber)
{
  BrickRanges bricks;
  bricks.count = { 2, 1, 1 };
  bricks.ranges = { { 1.0f, 5.0f }, { 2.0f, 6.0f } };
  const BrickRanges within = rangesWithin(bricks, { 0, 1 });
  EXPECT_GT(within.ranges[0].x, within.ranges[0].y);
  EXPECT_EQ(within.ranges[1], bricks.ranges[1]);
}

TEST(SegmentTexture, DrawsLabelsAskedForOrElseThoseThatAreMeant)
{
  vtkNew<vtkImageData> volume;
  const Grid grid{ { 3, 3, 3 }, glm::dvec3(0.0), glm::dvec3(2.0), glm::dmat3(1.0) };
  std::string remark;
  EXPECT_FALSE(requestSegment(volume, {}, remark).segmentation.labels);
  EXPECT_NE(remark.find("carries no segmentation"), std::string::npos);

  auto labels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  labels->SetName(SegmentationName);
  labels->SetNumberOfTuples(27);
  Segmentation attached;
  attached.labels = labels;
  attached.grid = grid;
  attached.chosen = { 4 };
  attachSegmentation(volume, attached);
  remark.clear();
  SegmentRequest request = requestSegment(volume, {}, remark);
  EXPECT_EQ(request.chosen, std::vector<int>{ 4 });
  request = requestSegment(volume, { 7, 8 }, remark);
  EXPECT_EQ(request.chosen, (std::vector<int>{ 7, 8 }));
  EXPECT_EQ(remark, "");
}

TEST(SegmentTexture, HasATexelForEachValue)
{
  const Grid grid{ { 3, 3, 3 }, glm::dvec3(0.0), glm::dvec3(2.0), glm::dmat3(1.0) };
  EXPECT_EQ(gridOfTexels(grid, layoutOf(grid.dimensions, false)), grid);
  const Grid cells = gridOfTexels(grid, layoutOf(grid.dimensions, true));
  EXPECT_EQ(cells.dimensions, glm::ivec3(2));
  EXPECT_EQ(cells.origin, glm::dvec3(1.0)) << "in the cells' middles";
  const Grid joined = gridOfTexels(grid, coarser(layoutOf(grid.dimensions, false), { 2, 1, 3 }));
  EXPECT_EQ(joined.dimensions, glm::ivec3(2, 3, 1));
  EXPECT_LT(glm::distance(joined.origin, glm::dvec3(1.0, 0.0, 2.0)), 1e-12);
  EXPECT_LT(glm::distance(joined.spacing, glm::dvec3(4.0, 2.0, 6.0)), 1e-12);
}
