// SPDX-License-Identifier: BSD-3-Clause
// Proves that exactly the control points are found that are drawn within a ball or a cone, moved or
// near a plane; also on a turned lattice and on a large one.
#include "Filters/Deformation/ControlPoints.h"
#include "Filters/Deformation/Lattice.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace brainshift;

namespace
{
// A turned lattice, bent about its middle, with its floats beside it.
struct Bent
{
  Lattice lattice;
  DrawnLattice drawn;

  explicit Bent(int side, double strength = 1.0)
  {
    Grid grid;
    grid.dimensions = glm::ivec3(side, side + 1, side + 2);
    grid.origin = { 5.0, -7.0, 11.0 };
    grid.spacing = { 2.0, 3.0, 2.5 };
    grid.direction = glm::dmat3(0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0);
    this->lattice = makeLattice(grid, 0);
    Stroke soft;
    soft.tool = Tool::Soft;
    soft.anchor = this->middle();
    soft.vector = { 4.0, -1.0, 2.0 };
    soft.major = 7.0;
    applyStroke(this->lattice, soft);
    this->drawn = { grid, &this->lattice.displacements[0].x, strength };
    this->drawn.farthest = longest(this->drawn);
  }

  glm::dvec3 middle() const
  {
    return this->lattice.grid.worldFromGrid(glm::dvec3(this->lattice.grid.dimensions - 1) / 2.0);
  }

  // The control points for which `wanted` holds of where they are drawn.
  template <typename Wanted>
  ControlPointSet all(Wanted wanted) const
  {
    ControlPointSet points;
    for (std::size_t offset = 0; offset < this->lattice.grid.count(); ++offset)
    {
      const glm::ivec3 index = indexOf(this->lattice.grid, offset);
      const glm::dvec3 rest = this->lattice.grid.worldFromGrid(glm::dvec3(index));
      if (wanted(
            rest + this->drawn.strength * glm::dvec3(this->lattice.displacements[offset]), rest))
      {
        points.insert(offset);
      }
    }
    return points;
  }
};

TEST(ControlPoints, InABallAreThoseDrawnThere)
{
  for (double strength : { 1.0, 0.5 })
  {
    const Bent bent(9, strength);
    // About where the middle went, so that some come in and others leave.
    const glm::dvec3 centre = bent.middle() + glm::dvec3(4.0, -1.0, 2.0);
    ControlPointSet found;
    addInBall(bent.drawn, centre, 6.0, Slab(), found);
    const ControlPointSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
      return glm::distance(drawn, centre) <= 6;
    });
    EXPECT_EQ(found, expected);
    EXPECT_GT(found.size(), 20u);
  }
}

TEST(ControlPoints, ABallBesideTheLatticeHasNone)
{
  const Bent bent(9);
  ControlPointSet found;
  addInBall(bent.drawn, bent.middle() + glm::dvec3(1000.0, 0.0, 0.0), 6.0, Slab(), found);
  addInBall(bent.drawn, bent.middle() - glm::dvec3(1000.0, 0.0, 0.0), 6.0, Slab(), found);
  EXPECT_TRUE(found.empty());
}

TEST(ControlPoints, InAConeAreThoseInFrontOfTheEye)
{
  const Bent bent(9);
  const glm::dvec3 along = glm::normalize(glm::dvec3(1.0, 2.0, -1.0));
  const glm::dvec3 apex = bent.middle() - 4.0 * along;
  ControlPointSet found;
  addInCone(bent.drawn, { apex, along, 1.0, 0.2 }, found);
  const ControlPointSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    const double depth = glm::dot(drawn - apex, along);
    return depth > 0.0 && glm::length(drawn - apex - depth * along) <= 1.0 + 0.2 * depth;
  });
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 5u);
}

TEST(ControlPoints, MovedAreThoseThatLeftTheirPlace)
{
  const Bent bent(9);
  ControlPointSet found;
  const glm::dvec3 centre = bent.middle() + glm::dvec3(2.0, 1.0, 0.0);
  addMoved(bent.drawn, centre, 6.5, Slab(), found);
  const ControlPointSet expected = bent.all([&](const glm::dvec3& drawn, const glm::dvec3& rest) {
    return glm::distance(drawn, rest) >= 0.02 && glm::distance(drawn, centre) <= 6.5;
  });
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20u);
  ControlPointSet all;
  addMoved(bent.drawn, centre, 1000.0, Slab(), all);
  EXPECT_GT(all.size(), found.size());
}

// A hundredth of the smallest spacing, 2 mm, is enough.
TEST(ControlPoints, AShortMoveIsAMove)
{
  Bent bent(9);
  std::vector<float> displacements(3 * bent.lattice.grid.count(), 0.0f);
  for (const auto& [offset, mm] : { std::pair{ 100, 0.019f }, { 200, 0.021f }, { 300, 0.029f } })
  {
    displacements[3 * offset + 1] = mm;
  }
  bent.drawn.displacements = displacements.data();
  bent.drawn.farthest = longest(bent.drawn);
  ControlPointSet found;
  addMoved(bent.drawn, bent.middle(), 1000.0, Slab(), found);
  EXPECT_EQ(found, (ControlPointSet{ 200, 300 }));
}

TEST(ControlPoints, InASlabAreThoseDrawnNearThePlane)
{
  const Bent bent(9);
  const Slab slab{ bent.middle(), glm::normalize(glm::dvec3(1.0, -2.0, 0.5)), 1.5 };
  const auto inSlab = [&](const glm::dvec3& drawn) {
    return std::abs(glm::dot(drawn - slab.point, slab.normal)) <= slab.halfThickness;
  };
  ControlPointSet near;
  addInBall(bent.drawn, slab.point, 6.0, slab, near);
  EXPECT_EQ(near, bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    return glm::distance(drawn, slab.point) <= 6.0 && inSlab(drawn);
  }));
  EXPECT_GT(near.size(), 8u);
  ControlPointSet moved;
  addMoved(bent.drawn, slab.point, 6.0, slab, moved);
  EXPECT_EQ(moved, bent.all([&](const glm::dvec3& drawn, const glm::dvec3& rest) {
    return glm::distance(drawn, rest) >= 0.02 && glm::distance(drawn, slab.point) <= 6.0 &&
      inSlab(drawn);
  }));
  EXPECT_GT(moved.size(), 8u);
}

TEST(ControlPoints, OfTooManyTheNearestAreTold)
{
  const Bent bent(33);
  const glm::dvec3 centre = bent.middle();
  ControlPointSet found;
  addInBall(bent.drawn, centre, 1000.0, Slab(), found);
  ASSERT_EQ(found.size(), MostControlPoints);
  double farthest = 0.0;
  for (std::size_t offset : found)
  {
    const glm::dvec3 drawn = bent.drawn.deformed(indexOf(bent.lattice.grid, offset));
    farthest = std::max(farthest, glm::distance(drawn, centre));
  }
  const ControlPointSet nearer = bent.all([&](const glm::dvec3& drawn, const glm::dvec3&) {
    return glm::distance(drawn, centre) < farthest;
  });
  EXPECT_LT(nearer.size(), MostControlPoints);
}
}
