// SPDX-License-Identifier: BSD-3-Clause
// Proves that what is left out is zero, and what is kept is as it was: where tissue may have moved
// (the slabs rays ask), and which nodes a stroke redoes.
#include "Filters/Deformation/FieldChange.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <random>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const glm::ivec3 Points(11, 10, 9);
constexpr int Samples = 3;

// Control points in a box, moved by up to 0.3 cells; it starts from `moved`.
std::vector<glm::vec3> moveBox(std::vector<glm::vec3> moved, const IndexBox& box, unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> shift(-0.3f, 0.3f);
  for (int k = box.first.z; k <= box.last.z; ++k)
  {
    for (int j = box.first.y; j <= box.last.y; ++j)
    {
      for (int i = box.first.x; i <= box.last.x; ++i)
      {
        moved[(k * Points.y + j) * Points.x + i] =
          glm::vec3(shift(random), shift(random), shift(random));
      }
    }
  }
  return moved;
}

std::vector<glm::vec3> still()
{
  return std::vector<glm::vec3>(Points.x * Points.y * Points.z, glm::vec3(0.0f));
}

NodeField backward(int kernel, const std::vector<glm::vec3>& inCells, const FieldNodes& nodes)
{
  return invert(refine(obliqueGrid(Points), kernel, inCells, Samples), nodes, Inverse::Exact);
}

// Calls visit(index, node's number) for each node.
template <typename Visit>
void forNodes(const FieldNodes& nodes, const Visit& visit)
{
  std::size_t at = 0;
  glm::ivec3 index;
  for (index.z = 0; index.z < nodes.count.z; ++index.z)
  {
    for (index.y = 0; index.y < nodes.count.y; ++index.y)
    {
      for (index.x = 0; index.x < nodes.count.x; ++index.x, ++at)
      {
        visit(index, at);
      }
    }
  }
}

void expectWithin(const SlabHull& hull, const glm::vec3& position)
{
  for (int i = 0; i < SlabDirections; ++i)
  {
    const float along = glm::dot(slabDirection(i), position);
    EXPECT_GE(along, hull.spans[i].x) << i;
    EXPECT_LE(along, hull.spans[i].y) << i;
  }
}

const IndexBox Middle{ { 4, 4, 4 }, { 5, 6, 4 } };
const IndexBox Corner{ { 0, 0, 1 }, { 1, 1, 2 } };

class FieldChangeTest : public ::testing::TestWithParam<int> // kernel
{
};
}

TEST_P(FieldChangeTest, NothingMovesOutsideTheHull)
{
  for (const IndexBox& box : { Middle, Corner })
  {
    const std::vector<glm::vec3> inCells = moveBox(still(), box, 5);
    const SlabHull hull = movedHull(Points, inCells);
    const FieldNodes nodes = backwardNodes(obliqueGrid(Points), inCells, Samples);
    const NodeField field = backward(GetParam(), inCells, nodes);
    int moved = 0;
    forNodes(nodes, [&](const glm::ivec3& index, std::size_t at) {
      if (field.values[at] == glm::vec3(0.0f))
      {
        return;
      }
      moved += 1;
      expectWithin(hull, nodes.latticeFromNode(glm::vec3(index)));
    });
    EXPECT_GT(moved, 100);
  }
  EXPECT_TRUE(movedHull(Points, still()).empty());
}

TEST_P(FieldChangeTest, NodesOutsideTheChangeStayAsTheyWere)
{
  for (const bool alone : { true, false })
  {
    const std::vector<glm::vec3> others = alone ? still() : moveBox(still(), Corner, 7);
    const std::vector<glm::vec3> before = moveBox(others, Middle, 8);
    const std::vector<glm::vec3> after = moveBox(others, Middle, 9);
    const FieldNodes nodes = backwardNodes(obliqueGrid(Points), after, Samples);
    const IndexBox box =
      changedBackwardNodes(changedPoints(Points, before, after), Points, before, after, nodes);
    const NodeField was = backward(GetParam(), before, nodes);
    const NodeField is = backward(GetParam(), after, nodes);
    int changed = 0;
    forNodes(nodes, [&](const glm::ivec3& index, std::size_t at) {
      const bool inside = glm::clamp(index, box.first, box.last) == index;
      changed += was.values[at] != is.values[at] ? 1 : 0;
      EXPECT_TRUE(inside || was.values[at] == is.values[at]) << index.x << " " << index.y;
    });
    EXPECT_GT(changed, 100);
  }
}

namespace
{
// Expects offsets to differ between the corners alone, seen along every direction of a hull.
void expectChangeBetweenCorners(
  int kernel, const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after)
{
  const FieldNodes nodes = backwardNodes(obliqueGrid(Points), after, Samples);
  SlabHull hull;
  for (const glm::vec3& corner : cornersOfChange(Points, before, after, 0.0f))
  {
    for (int i = 0; i < SlabDirections; ++i)
    {
      const float along = glm::dot(slabDirection(i), corner);
      hull.spans[i] = { glm::min(hull.spans[i].x, along), glm::max(hull.spans[i].y, along) };
    }
  }
  const NodeField was = backward(kernel, before, nodes);
  const NodeField is = backward(kernel, after, nodes);
  int changed = 0;
  forNodes(nodes, [&](const glm::ivec3& index, std::size_t at) {
    if (was.values[at] == is.values[at])
    {
      return;
    }
    changed += 1;
    expectWithin(hull, nodes.latticeFromNode(glm::vec3(index)));
  });
  EXPECT_GT(changed, 100);
}
}

TEST_P(FieldChangeTest, WhatChangesLiesBetweenItsCorners)
{
  // A picture that is cast in part looks at what lies between them, from any side.
  const std::vector<glm::vec3> aside = moveBox(still(), { { 8, 7, 6 }, { 9, 8, 7 } }, 7);
  for (const std::vector<glm::vec3>& others : { still(), aside })
  {
    for (const IndexBox& box : { Middle, Corner })
    {
      expectChangeBetweenCorners(GetParam(), moveBox(others, box, 8), moveBox(others, box, 9));
    }
  }
  EXPECT_TRUE(cornersOfChange(Points, still(), still(), 1.0f).empty());
}

TEST_P(FieldChangeTest, WhatMovesBesideTheChangeSpreadsIt)
{
  // Two rows change; at the corner of their box a third moves as before and carries tissue along.
  std::vector<glm::vec3> others = still();
  others[(4 * Points.y + 3) * Points.x + 7] = glm::vec3(0.9f, -0.9f, 0.0f);
  const auto changed = [&](float amount) {
    std::vector<glm::vec3> moved = others;
    moved[(4 * Points.y + 3) * Points.x + 4] = glm::vec3(amount, 0.0f, 0.0f);
    moved[(4 * Points.y + 6) * Points.x + 7] = glm::vec3(0.0f, amount, 0.0f);
    return moved;
  };
  expectChangeBetweenCorners(GetParam(), changed(0.2f), changed(0.5f));
}

TEST_P(FieldChangeTest, AChangeReachesAsFarAsItsWayBack)
{
  // A stroke and its undo redo the same nodes and pixels: both fields count, not the later one.
  const std::vector<glm::vec3> still = moveBox(::still(), Corner, 7);
  std::vector<glm::vec3> far = still;
  far[(5 * Points.y + 5) * Points.x + 5] = { 2.5f, -3.5f, 3.0f };
  const FieldNodes nodes = backwardNodes(obliqueGrid(Points), far, Samples);
  const IndexBox points = changedPoints(Points, still, far);
  EXPECT_EQ(changedBackwardNodes(points, Points, still, far, nodes),
    changedBackwardNodes(points, Points, far, still, nodes));
  EXPECT_EQ(cornersOfChange(Points, still, far, 1.0f), cornersOfChange(Points, far, still, 1.0f));
}

INSTANTIATE_TEST_SUITE_P(Kernels, FieldChangeTest, ::testing::Values(0, 1));
