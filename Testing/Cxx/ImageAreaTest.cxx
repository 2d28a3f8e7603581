// SPDX-License-Identifier: BSD-3-Clause
// Proves that images cover all that can be seen, little more, and are not made anew for each move
// of the camera.
#include "ImageArea.h"

#include <glm/vector_relational.hpp>

#include <gtest/gtest.h>

using namespace brainshift;

namespace
{
const glm::ivec2 Picture(1000, 700);

void expectArea(const ImageArea& area, const glm::ivec2& low, const glm::ivec2& high)
{
  EXPECT_EQ(area.picture, Picture);
  EXPECT_EQ(area.low, low);
  EXPECT_EQ(area.high(), high);
}
}

TEST(ImageArea, CoversWhatIsSeenBySteps)
{
  expectArea(areaAround({}, Picture, { { 130, 70 }, { 512, 513 } }), { 128, 64 }, { 512, 576 });
  expectArea(areaAround({}, Picture, { { 0, 0 }, Picture }), { 0, 0 }, Picture);
  expectArea(areaAround({}, Picture, { { 960, 0 }, { 1000, 1 } }), { 960, 0 }, { 1000, 64 });
}

TEST(ImageArea, HoldsAPixelWhereNothingIsSeen)
{
  for (const glm::ivec2& at : { glm::ivec2(0), glm::ivec2(500, 300), Picture })
  {
    const ImageArea area = areaAround({}, Picture, { at, at });
    EXPECT_TRUE(glm::all(glm::greaterThan(area.size, glm::ivec2(0)))) << at.x;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(area.high(), Picture))) << at.x;
    EXPECT_TRUE(glm::all(glm::lessThanEqual(area.size, glm::ivec2(64)))) << at.x;
  }
  const ImageArea one = areaAround({}, { 1, 1 }, {});
  EXPECT_EQ(one.size, glm::ivec2(1));
}

TEST(ImageArea, IsKeptWhileTheCameraMovesALittle)
{
  const ImageArea held = areaAround({}, Picture, { { 130, 130 }, { 500, 500 } });
  EXPECT_EQ(areaAround(held, Picture, { { 150, 140 }, { 480, 512 } }), held);
  EXPECT_EQ(areaAround(held, Picture, { { 200, 200 }, { 500, 500 } }), held);
  // Grown to one side, it still holds the other.
  expectArea(areaAround(held, Picture, { { 200, 130 }, { 520, 500 } }), { 128, 128 }, { 576, 512 });
}

TEST(ImageArea, IsLetGoWhereMuchIsSpare)
{
  const ImageArea held = areaAround({}, Picture, { { 0, 0 }, Picture });
  expectArea(areaAround(held, Picture, { { 130, 130 }, { 500, 500 } }), { 128, 128 }, { 512, 512 });
  const ImageArea other = areaAround({}, { 500, 350 }, { { 0, 0 }, { 500, 350 } });
  expectArea(areaAround(other, Picture, { { 0, 0 }, { 10, 10 } }), { 0, 0 }, { 64, 64 });
}

TEST(ImageArea, FindsItsTexels)
{
  const ImageArea area = areaAround({}, Picture, { { 130, 70 }, { 512, 513 } });
  const glm::dvec2 pixel(200.5, 100.5);
  const glm::dvec2 place =
    pixel / glm::dvec2(Picture) * area.textureFromShare() + area.textureOfShareZero();
  const glm::dvec2 texel = place * glm::dvec2(area.size);
  EXPECT_NEAR(texel.x, 200.5 - 128, 1e-9);
  EXPECT_NEAR(texel.y, 100.5 - 64, 1e-9);
}

TEST(PixelBox, EnclosesOverlapsAndContains)
{
  const PixelBox a{ { 2, 3 }, { 10, 20 } };
  const PixelBox b{ { 5, 1 }, { 12, 9 } };
  const PixelBox none{ { 7, 7 }, { 7, 30 } };
  EXPECT_EQ(enclosing(a, b).low, glm::ivec2(2, 1));
  EXPECT_EQ(enclosing(a, b).high, glm::ivec2(12, 20));
  EXPECT_EQ(overlap(a, b).low, glm::ivec2(5, 3));
  EXPECT_EQ(overlap(a, b).high, glm::ivec2(10, 9));
  EXPECT_EQ(enclosing(a, none).size(), a.size());
  EXPECT_EQ(enclosing(none, b).size(), b.size());
  EXPECT_TRUE(overlap(a, none).empty());
  EXPECT_TRUE(contains(a, overlap(a, b)));
  EXPECT_TRUE(contains(a, none));
  EXPECT_FALSE(contains(a, b));
}
