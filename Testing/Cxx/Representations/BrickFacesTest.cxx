// SPDX-License-Identifier: BSD-3-Clause
// Proves that the rectangles are the occupied bricks' faces, each once and the right way round,
// that faces side by side share one, and that an eye is told which it sees from in front.
#include "Representations/Skipping/BrickFaces.h"

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace brainshift;

namespace
{
struct Bricks
{
  glm::ivec3 count;
  std::vector<std::uint8_t> occupied;

  bool at(const glm::ivec3& brick) const
  {
    if (glm::any(glm::lessThan(brick, glm::ivec3(0))) ||
      glm::any(glm::greaterThanEqual(brick, this->count)))
    {
      return false;
    }
    return this->occupied[(std::size_t(brick.z) * this->count.y + brick.y) * this->count.x +
             brick.x] != 0;
  }
};

Bricks empty(const glm::ivec3& count)
{
  return { count, std::vector<std::uint8_t>(std::size_t(count.x) * count.y * count.z, 0) };
}

using Face = std::tuple<int, int, int, int, int>; // axis, outward, and the brick above it

std::vector<std::pair<BrickRectangle, int>> listed(const std::array<BrickFaces, 6>& found)
{
  std::vector<std::pair<BrickRectangle, int>> rectangles; // and outward
  for (const BrickFaces& faces : found)
  {
    for (const BrickRectangle& rectangle : faces.rectangles)
    {
      EXPECT_EQ(rectangle.axis, faces.axis);
      rectangles.emplace_back(rectangle, faces.outward);
    }
  }
  return rectangles;
}

// How many rectangles hold a face, for each that one holds.
std::map<Face, int> facesOf(const std::array<BrickFaces, 6>& found)
{
  std::map<Face, int> faces;
  for (const auto& [rectangle, outward] : listed(found))
  {
    glm::ivec3 end = rectangle.high;
    EXPECT_EQ(rectangle.low[rectangle.axis], end[rectangle.axis]);
    end[rectangle.axis] += 1;
    for (int z = rectangle.low.z; z < end.z; ++z)
    {
      for (int y = rectangle.low.y; y < end.y; ++y)
      {
        for (int x = rectangle.low.x; x < end.x; ++x)
        {
          faces[Face(rectangle.axis, outward, x, y, z)] += 1;
        }
      }
    }
  }
  return faces;
}

// The answer by definition.
std::map<Face, int> boundaryOf(const Bricks& bricks)
{
  std::map<Face, int> faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::ivec3 before(0);
    before[axis] = 1;
    for (int z = 0; z <= bricks.count.z; ++z)
    {
      for (int y = 0; y <= bricks.count.y; ++y)
      {
        for (int x = 0; x <= bricks.count.x; ++x)
        {
          const int above = bricks.at({ x, y, z });
          const int below = bricks.at(glm::ivec3(x, y, z) - before);
          if (above != below)
          {
            faces[Face(axis, below - above, x, y, z)] = 1;
          }
        }
      }
    }
  }
  return faces;
}
}

// Long rows too.
TEST(BrickFaces, AreTheBoundaryEachOnce)
{
  std::mt19937 random(5);
  for (const glm::ivec3 count :
    { glm::ivec3(1), glm::ivec3(2, 1, 3), glm::ivec3(5, 13, 4), glm::ivec3(11, 7, 9),
      glm::ivec3(30, 3, 3), glm::ivec3(150, 3, 2), glm::ivec3(2, 64, 3), glm::ivec3(3, 128, 2) })
  {
    for (const unsigned int outOfTen : { 0, 1, 5, 9, 10 })
    {
      Bricks bricks = empty(count);
      for (std::uint8_t& brick : bricks.occupied)
      {
        brick = random() % 10 < outOfTen ? 255 : 0;
      }
      EXPECT_EQ(facesOf(brickFaces(bricks.occupied, count)), boundaryOf(bricks))
        << count.x << " " << count.y << " " << count.z << ", " << outOfTen << " of 10";
    }
  }
}

TEST(BrickFaces, ABlockHasSixRectangles)
{
  const glm::ivec3 count(9, 8, 7);
  Bricks bricks = empty(count);
  for (int z = 1; z < 6; ++z)
  {
    for (int y = 2; y < 8; ++y)
    {
      std::fill_n(&bricks.occupied[(std::size_t(z) * count.y + y) * count.x], 4, 1);
    }
  }
  EXPECT_EQ(listed(brickFaces(bricks.occupied, count)).size(), 6u);
}

TEST(BrickFaces, LayersHoldTheOccupiedBricksAndNoMore)
{
  std::mt19937 random(7);
  const glm::ivec3 count(9, 8, 12);
  for (const unsigned int outOf100 : { 0, 1, 5, 50, 100 })
  {
    Bricks bricks = empty(count);
    std::vector<IndexBox> expected(count.z);
    for (int z = 0; z < count.z; ++z)
    {
      for (int y = 0; y < count.y; ++y)
      {
        for (int x = 0; x < count.x; ++x)
        {
          if (random() % 100 < outOf100)
          {
            bricks.occupied[(std::size_t(z) * count.y + y) * count.x + x] = 255;
            expected[z] = enclosing(expected[z], { { x, y, z }, { x, y, z } });
          }
        }
      }
    }
    expected.erase(std::remove_if(expected.begin(), expected.end(),
                     [](const IndexBox& box) { return box.empty(); }),
      expected.end());
    EXPECT_TRUE(occupiedLayers(brickFaces(bricks.occupied, count), count.z) == expected)
      << outOf100;
  }
}

TEST(BrickFaces, AnEyeSeesThoseThatLookTowardsIt)
{
  std::mt19937 random(6);
  const glm::ivec3 count(7, 9, 8);
  Bricks bricks = empty(count);
  for (std::uint8_t& brick : bricks.occupied)
  {
    brick = random() % 2;
  }
  const auto found = brickFaces(bricks.occupied, count);
  std::uniform_real_distribution<double> place(-5.0, 14.0);
  for (int i = 0; i < 200; ++i)
  {
    const glm::dvec3 eye(place(random), place(random), place(random));
    const double w = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.5 : -2.0; // as a matrix may leave it
    for (const BrickFaces& faces : found)
    {
      const auto [first, last] = facing(faces, glm::dvec4(w == 0.0 ? eye : w * eye, w));
      for (int k = 0; k < static_cast<int>(faces.rectangles.size()); ++k)
      {
        const double plane = w == 0.0 ? 0.0 : faces.rectangles[k].low[faces.axis];
        EXPECT_EQ(k >= first && k < last, faces.outward * (eye[faces.axis] - plane) > 0.0);
      }
    }
  }
}
