// SPDX-License-Identifier: BSD-3-Clause
// Proves that images cover all that can be seen, little more, and are not made anew for each move
// of the camera.
#include "Representations/Scene/ImageArea.h"

#include <glm/vector_relational.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

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
    pixel / glm::dvec2(Picture) * area.textureFromFraction() + area.textureOfFractionZero();
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

namespace
{
// Of the triangles of a strip, pixels.
double areaOf(const std::vector<glm::dvec2>& strip)
{
  double area = 0.0;
  for (std::size_t i = 2; i < strip.size(); ++i)
  {
    const glm::dvec2 a = strip[i - 1] - strip[i - 2];
    const glm::dvec2 b = strip[i] - strip[i - 2];
    area += 0.5 * std::abs(a.x * b.y - a.y * b.x);
  }
  return area;
}
}

TEST(PixelBox, SharesNoPixelsWithOneBesideIt)
{
  const PixelBox box{ { 10, 10 }, { 50, 50 } };
  for (const PixelBox& beside :
    { PixelBox{ { 60, 20 }, { 90, 30 } }, PixelBox{ { 0, 0 }, { 9, 9 } } })
  {
    EXPECT_TRUE(overlap(box, beside).empty());
    EXPECT_TRUE(glm::all(glm::greaterThanEqual(overlap(beside, box).size(), glm::ivec2(0))))
      << "OpenGL takes no negative sides";
  }
}

TEST(PixelPart, IsDrawnAsOneStrip)
{
  const PixelPart box = partOf({ { 10, 20 }, { 110, 80 } });
  EXPECT_EQ(stripOf(box).size(), 4u);
  EXPECT_DOUBLE_EQ(areaOf(stripOf(box)), 100.0 * 60.0);

  // All corners cut, by 10, 20, 5 and 15 pixels along each side.
  PixelPart cut = box;
  cut.turned = { { 10 + 20 + 10, 10 - 80 + 20 }, { 110 + 80 - 5, 110 - 20 - 15 } };
  EXPECT_EQ(stripOf(cut).size(), 8u);
  EXPECT_DOUBLE_EQ(areaOf(stripOf(cut)), 6000.0 - 0.5 * (100.0 + 400.0 + 25.0 + 225.0));
  EXPECT_LE(pixelsIn(cut), 6000.0);
  EXPECT_GE(pixelsIn(cut), areaOf(stripOf(cut)));
  for (const glm::dvec2& corner : stripOf(cut))
  {
    EXPECT_GE(corner.x + corner.y, cut.turned.low.x);
    EXPECT_LE(corner.x + corner.y, cut.turned.high.x);
    EXPECT_GE(corner.x - corner.y, cut.turned.low.y);
    EXPECT_LE(corner.x - corner.y, cut.turned.high.y);
  }
  EXPECT_TRUE(stripOf({ { { 0, 0 }, { 10, 10 } }, { { 100, 0 }, { 110, 10 } } }).empty());
}

// A strip across the picture's corners: its box would count many pixels more.
TEST(PixelPart, CountsThePixelsOfADiagonalStrip)
{
  const PixelPart strip{ { { 0, 0 }, { 100, 100 } }, { { 0, -10 }, { 200, 10 } } };
  EXPECT_DOUBLE_EQ(pixelsIn(strip), 0.5 * 200.0 * 20.0);
  EXPECT_DOUBLE_EQ(pixelsIn(partOf({ { 0, 0 }, { 100, 60 } })), 6000.0);
}
