// SPDX-License-Identifier: BSD-3-Clause
// Proves that the tree finds the nearest point of any triangle, as asking them all does, before and
// after the points move; and that a surface follows a lattice point for point, redoing only what a
// stroke reaches.
#include "Filters/Traces/TriangleTree.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Traces/DeformedSurface.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// Triangles that share nothing but points, some of them slivers, two of them without area.
TriangleMesh randomMesh(unsigned int seed, int points, int triangles)
{
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < points; ++i)
  {
    mesh.points.push_back(random.between(glm::dvec3(-20.0), glm::dvec3(20.0)));
  }
  const auto any = [&] { return static_cast<int>(random.between(0.0, points - 1e-9)); };
  for (int i = 0; i < triangles; ++i)
  {
    mesh.triangles.emplace_back(any(), any(), any());
  }
  mesh.triangles[0] = { 1, 1, 2 };
  mesh.triangles[1] = { 3, 3, 3 };
  return mesh;
}

// A triangle sampled: never nearer than the triangle, further by at most `steps`' size.
double sampledDistance(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  constexpr int steps = 200;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= steps; ++i)
  {
    for (int j = 0; i + j <= steps; ++j)
    {
      const glm::dvec3 point = a + (b - a) * (double(i) / steps) + (c - a) * (double(j) / steps);
      nearest = std::min(nearest, glm::length(position - point));
    }
  }
  return nearest;
}

double askAll(const TriangleMesh& mesh, const std::vector<glm::dvec3>& points,
  const glm::dvec3& position, const std::vector<char>& kept)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::ivec3& t : mesh.triangles)
  {
    if (kept.empty() || (kept[t.x] && kept[t.y] && kept[t.z]))
    {
      nearest = std::min(
        nearest, squaredDistanceToTriangle(position, points[t.x], points[t.y], points[t.z]));
    }
  }
  return std::sqrt(nearest);
}
}

TEST(TriangleTree, DistanceToOneTriangle)
{
  const glm::dvec3 a(0, 0, 0);
  const glm::dvec3 b(4, 0, 0);
  const glm::dvec3 c(0, 3, 0);
  const auto distance = [&](const glm::dvec3& p) {
    return std::sqrt(squaredDistanceToTriangle(p, a, b, c));
  };
  EXPECT_NEAR(distance({ 1, 1, 2 }), 2.0, 1e-12) << "above its face";
  EXPECT_NEAR(distance({ 2, -3, 4 }), 5.0, 1e-12) << "beside an edge";
  EXPECT_NEAR(distance({ -3, -4, 0 }), 5.0, 1e-12) << "beyond a corner";
  EXPECT_NEAR(distance({ 1, 1, 0 }), 0.0, 1e-12) << "in it";
  Random random(3);
  for (int i = 0; i < 200; ++i)
  {
    const glm::dvec3 corner[3] = { random.between(glm::dvec3(-5), glm::dvec3(5)),
      random.between(glm::dvec3(-5), glm::dvec3(5)),
      random.between(glm::dvec3(-5), glm::dvec3(5)) };
    const glm::dvec3 p = random.between(glm::dvec3(-9), glm::dvec3(9));
    const double found = std::sqrt(squaredDistanceToTriangle(p, corner[0], corner[1], corner[2]));
    const double sampled = sampledDistance(p, corner[0], corner[1], corner[2]);
    EXPECT_LE(found, sampled + 1e-9);
    EXPECT_GT(found, sampled - 0.1);
  }
}

TEST(TriangleTree, FindsWhatAskingAllTrianglesFinds)
{
  const TriangleMesh mesh = randomMesh(11, 300, 900);
  TriangleTree tree(mesh);
  Random random(12);
  std::vector<glm::dvec3> points = mesh.points;
  std::vector<char> kept;
  const auto expectSame = [&](const char* when) {
    for (int i = 0; i < 300; ++i)
    {
      const glm::dvec3 p = random.between(glm::dvec3(-40), glm::dvec3(40));
      const double expected = askAll(mesh, points, p, kept);
      const TriangleTree::Nearest found = tree.nearest(p);
      EXPECT_NEAR(found.distance, expected, 1e-9) << when;
      EXPECT_EQ(tree.nearest(p, found.triangle).distance, found.distance) << when;
      EXPECT_EQ(tree.nearest(p, i).distance, found.distance) << when << ", with a wrong hint";
    }
  };
  const auto moveEvery = [&](std::size_t step) {
    std::vector<char> moved(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); i += step)
    {
      points[i] += random.between(glm::dvec3(-15), glm::dvec3(15));
      moved[i] = 1;
    }
    return moved;
  };
  expectSame("at first");
  moveEvery(1);
  tree.fit(points, {}, kept);
  expectSame("all moved");
  tree.fit(points, moveEvery(40), kept);
  expectSame("a few moved");
  kept.resize(points.size());
  for (std::size_t i = 0; i < kept.size(); ++i)
  {
    kept[i] = i % 3 != 0;
  }
  tree.fit(points, {}, kept);
  expectSame("some gone");
}

TEST(TriangleTree, AfterAMoveTheAnswerIsThatOfAskingAll)
{
  const TriangleMesh mesh = randomMesh(13, 600, 900);
  TriangleTree tree(mesh);
  Random random(14);
  std::vector<glm::dvec3> points = mesh.points;
  std::vector<glm::dvec3> asked;
  std::vector<int> before;
  for (int i = 0; i < 400; ++i)
  {
    asked.push_back(random.between(glm::dvec3(-30), glm::dvec3(30)));
    before.push_back(tree.nearest(asked[i]).triangle);
  }
  int changed = 0;
  for (int move = 0; move < 10; ++move)
  {
    std::vector<char> moved(points.size(), 0);
    const auto first = static_cast<std::size_t>(random.between(0.0, points.size() - 20.0));
    for (std::size_t i = first; i < first + 20; ++i)
    {
      points[i] = random.between(glm::dvec3(-20), glm::dvec3(20));
      moved[i] = 1;
    }
    tree.fit(points, moved, {});
    for (std::size_t i = 0; i < asked.size(); ++i)
    {
      const TriangleTree::Nearest found = tree.nearestAfterMove(asked[i], before[i]);
      EXPECT_EQ(found.distance, tree.nearest(asked[i]).distance) << move << ", " << i;
      EXPECT_NEAR(found.distance, askAll(mesh, points, asked[i], {}), 1e-9);
      changed += found.triangle != before[i];
      before[i] = found.triangle;
    }
  }
  EXPECT_GT(changed, 100) << "of 4000";
}

TEST(TriangleTree, NothingIsInfinitelyFar)
{
  EXPECT_EQ(TriangleTree().nearest({ 1, 2, 3 }).distance, std::numeric_limits<double>::infinity());
  const TriangleMesh mesh = randomMesh(2, 30, 40);
  TriangleTree tree(mesh);
  EXPECT_LT(tree.nearest({ 1, 2, 3 }).distance, 30.0);
  tree.fit(mesh.points, {}, std::vector<char>(mesh.points.size(), 0));
  EXPECT_EQ(tree.nearest({ 1, 2, 3 }).distance, std::numeric_limits<double>::infinity());
}

TEST(DeformedSurface, FollowsTheLatticeAndRedoesOnlyWhatAStrokeReaches)
{
  const Grid grid = obliqueGrid({ 12, 13, 14 });
  for (const int kernel : { 0, 1 })
  {
    TriangleMesh mesh = randomMesh(21, 2000, 3000);
    Random random(5);
    for (glm::dvec3& point : mesh.points)
    {
      point = random.point(grid, 0.0);
    }
    DeformedSurface surface(mesh);
    Lattice lattice = makeLattice(grid, kernel);
    surface.follow(lattice, {});
    EXPECT_EQ(surface.mapped(), 0) << "nothing has moved yet";
    const Lattice random0 = randomLattice(grid, kernel, 9, 0.4);
    for (const Lattice& next : { random0, lattice, random0 })
    {
      lattice = next;
      for (int stroke = 0; stroke < 3; ++stroke)
      {
        const auto tool = stroke == 0 ? Tool::Move : stroke == 1 ? Tool::Soft : Tool::Stamp;
        applyStroke(lattice, strokeAt(tool, random.point(grid, -3.0), { 4, 3, -5 }));
        surface.follow(lattice, {});
        const PointMap map(lattice);
        for (std::size_t i = 0; i < mesh.points.size(); ++i)
        {
          ASSERT_EQ(surface.points()[i], map.deformedFromRest(mesh.points[i])) << i;
        }
        if (stroke > 0)
        {
          EXPECT_GT(surface.mapped(), 0);
          EXPECT_LT(surface.mapped(), 1990) << "a stroke does not reach everything";
        }
        const glm::dvec3 p = random.point(grid, 1.0);
        EXPECT_NEAR(surface.nearest(p).distance, askAll(mesh, surface.points(), p, {}), 1e-9);
      }
    }
    surface.follow(lattice, {});
    EXPECT_EQ(surface.mapped(), 0) << "nothing changed";
    const glm::dvec3 p = random.point(grid, -2.0);
    surface.follow(makeLattice(obliqueGrid({ 6, 7, 8 }), kernel), {});
    EXPECT_EQ(surface.points()[77], mesh.points[77]) << "another lattice that moves nothing";
    EXPECT_NEAR(surface.nearest(p).distance, askAll(mesh, mesh.points, p, {}), 1e-9);
  }
}

TEST(DeformedSurface, FollowsAnotherMask)
{
  const Grid grid = obliqueGrid({ 12, 13, 14 });
  TriangleMesh mesh = randomMesh(25, 500, 900);
  Random random(7);
  for (glm::dvec3& point : mesh.points)
  {
    point = random.point(grid, 0.0);
  }
  DeformedSurface surface(mesh);
  Lattice lattice = randomLattice(grid, 0, 9, 0.4);
  for (const float weight : { 1.0f, 0.5f, 0.0f })
  {
    auto mask = std::make_shared<NodeWeights>();
    mask->values.assign(grid.count(), weight);
    lattice.mask = mask;
    surface.follow(lattice, {});
    const PointMap map(lattice);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      ASSERT_EQ(surface.points()[i], map.deformedFromRest(mesh.points[i])) << weight << ", " << i;
    }
  }
}

TEST(DeformedSurface, WhatIsRemovedComesBack)
{
  const Grid grid = obliqueGrid({ 12, 13, 14 });
  TriangleMesh mesh = randomMesh(23, 500, 900);
  Random random(6);
  for (glm::dvec3& point : mesh.points)
  {
    point = random.point(grid, 0.0);
  }
  DeformedSurface surface(mesh);
  const Lattice lattice = randomLattice(grid, 0, 9, 0.4);
  const auto isRemoved = [&](const glm::dvec3& point) { return grid.gridFromWorld(point).x > 5.0; };
  for (int round = 0; round < 2; ++round)
  {
    surface.follow(lattice, isRemoved);
    std::vector<char> kept;
    for (const glm::dvec3& point : surface.points())
    {
      kept.push_back(!isRemoved(point));
    }
    const glm::dvec3 p = grid.worldFromGrid({ 9.0, 6.0, 7.0 });
    const double whole = askAll(mesh, surface.points(), p, {});
    const double left = askAll(mesh, surface.points(), p, kept);
    ASSERT_GT(left, whole + 1.0) << "mm";
    EXPECT_NEAR(surface.nearest(p).distance, left, 1e-9);
    surface.follow(lattice, {});
    EXPECT_NEAR(surface.nearest(p).distance, whole, 1e-9);
  }
}
