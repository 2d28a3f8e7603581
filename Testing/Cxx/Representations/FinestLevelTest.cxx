// SPDX-License-Identifier: BSD-3-Clause
// Proves that a texture with one texel for several voxels lies where they lie and holds their mean,
// and that voxels are joined into texels which are as nearly cubes as can be.
#include "Representations/Tissue/FinestLevel.h"
#include "Representations/Tissue/CoarseVoxels.h"

#include <vtkMatrix4x4.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <limits>

using namespace brainshift;

namespace
{
constexpr int Card = 2048; // values a side that it takes

const Grid Oblique{ { 7, 5, 4 }, { 1.0, -2.0, 3.0 }, { 0.5, 0.75, 2.0 },
  glm::dmat3(0.0, 1.0, 0.0, -0.8, 0.0, 0.6, 0.6, 0.0, 0.8) };

std::vector<double> joined(const ValueLayout& layout, const std::vector<double>& values)
{
  const glm::ivec3& side = layout.dimensions;
  std::vector<double> texels(static_cast<std::size_t>(side.x) * side.y * side.z);
  joinVoxels<MeanNumber>(
    layout, [&](vtkIdType voxel) { return values[voxel]; },
    [&](vtkIdType texel, double mean) { texels[texel] = mean; });
  return texels;
}
}

TEST(FinestLevel, JoinsThickSlicesLast)
{
  const glm::ivec3 voxels(512, 512, 40);
  const glm::dvec3 spacing(0.5, 0.5, 2.0);
  EXPECT_EQ(voxelsPerTexel(voxels, spacing, 0, Card), glm::ivec3(1));
  EXPECT_EQ(voxelsPerTexel(voxels, spacing, 1, Card), glm::ivec3(2, 2, 1));
  EXPECT_EQ(voxelsPerTexel(voxels, spacing, 3, Card), glm::ivec3(4, 4, 1));
  EXPECT_EQ(voxelsPerTexel(voxels, spacing, 7, Card), glm::ivec3(8, 8, 2));
  EXPECT_EQ(voxelsPerTexel({ 100, 100, 1 }, glm::dvec3(0.1), 2, Card), glm::ivec3(3, 3, 1));
  EXPECT_EQ(voxelsPerTexel({ 20000, 6, 6 }, glm::dvec3(1.0), 0, Card), glm::ivec3(10, 1, 1));
}

// The middle of each texel lies in the middle of its voxels, on points and in cells, also where the
// last texel has fewer voxels than the others.
TEST(FinestLevel, LiesWhereItsVoxelsLie)
{
  vtkNew<vtkMatrix4x4> unmoved;
  for (const bool cells : { false, true })
  {
    const ValueLayout whole = layoutOf(Oblique.dimensions, cells);
    const ValueLayout coarse = coarser(whole, { 3, 2, 1 });
    EXPECT_EQ(coarse.dimensions, cells ? glm::ivec3(2, 2, 3) : glm::ivec3(3, 3, 4));
    const glm::dmat4 world = worldFromTexture(Oblique, coarse, unmoved);
    const glm::dvec3 firstVoxel(cells ? 0.5 : 0.0);
    const glm::dvec3 middle = firstVoxel + glm::dvec3(1.0, 0.5, 0.0); // of the first texel, grid
    const glm::dvec3 texel = 0.5 / glm::dvec3(coarse.dimensions);
    EXPECT_LT(
      glm::distance(glm::dvec3(world * glm::dvec4(texel, 1.0)), Oblique.worldFromGrid(middle)),
      1e-12);
    const glm::dvec3 next = texel + glm::dvec3(1.0, 0.0, 0.0) / glm::dvec3(coarse.dimensions);
    EXPECT_LT(glm::distance(glm::dvec3(world * glm::dvec4(next, 1.0)),
                Oblique.worldFromGrid(middle + glm::dvec3(3.0, 0.0, 0.0))),
      1e-12);
    const glm::dmat4 wholeWorld = worldFromTexture(Oblique, whole, unmoved);
    for (const auto end : { &ValueLayout::low, &ValueLayout::high }) // the same box
    {
      EXPECT_LT(glm::distance(glm::dvec3(world * glm::dvec4(coarse.*end, 1.0)),
                  glm::dvec3(wholeWorld * glm::dvec4(whole.*end, 1.0))),
        1e-12);
    }
  }
}

TEST(FinestLevel, HoldsTheMeanOfWhatIsKnown)
{
  const ValueLayout layout = coarser(layoutOf({ 3, 2, 1 }, false), { 2, 2, 1 });
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<double> texels = joined(layout, { 1.0, 2.0, 10.0, unknown, 6.0, 20.0 });
  ASSERT_EQ(texels.size(), 2u);
  EXPECT_DOUBLE_EQ(texels[0], 3.0);
  EXPECT_DOUBLE_EQ(texels[1], 15.0) << "of two voxels at the end";
  EXPECT_TRUE(std::isnan(joined(layout, { unknown, infinite, 1.0, unknown, unknown, 1.0 })[0]));
}

// The mean of labels 2 and 9 would be a label that is not there.
TEST(FinestLevel, HoldsTheMostFrequentLabel)
{
  const ValueLayout layout = coarser(layoutOf({ 4, 2, 1 }, false), { 2, 2, 1 });
  const std::vector<double> labels{ 9.0, 2.0, 5.0, 3.0, 9.0, 4.0, 3.0, 5.0 };
  std::vector<double> texels(2);
  joinVoxels<MostFrequentNumber>(
    layout, [&](vtkIdType voxel) { return labels[voxel]; },
    [&](vtkIdType texel, double number) { texels[texel] = number; });
  EXPECT_EQ(texels[0], 9.0);
  EXPECT_EQ(texels[1], 3.0) << "of equals, the least";
}
