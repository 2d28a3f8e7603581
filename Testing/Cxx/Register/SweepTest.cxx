// SPDX-License-Identifier: BSD-3-Clause
// Proves that the surroundings of a fan are found, that dark tissue within it is inside, and that a
// refinement by ultrasound compares nothing else.
#include "Filters/Register/LatticeRows.h"
#include "Filters/Register/PyramidLevel.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const glm::dvec3 Middle(15.0, 14.0, 12.0);

// A ball that a probe saw, with a dark cyst in it, on voxels of 0.5 mm.
Volume ball()
{
  Grid grid;
  grid.dimensions = { 61, 57, 51 };
  grid.spacing = glm::dvec3(0.5);
  return filled(grid, [](const glm::dvec3& at) {
    const bool isSeen = glm::length(at - Middle) < 10.0;
    const bool isCyst = glm::length(at - Middle - glm::dvec3(4, 0, 0)) < 3.0;
    return isSeen && !isCyst ? 50.0 : 0.0;
  });
}

bool isSeen(const Mask& mask, const glm::dvec3& world)
{
  const glm::ivec3 index(glm::round(mask.grid.gridFromWorld(world)));
  return mask.inside[mask.grid.offset(index.x, index.y, index.z)] != 0;
}
}

TEST(Sweep, TheCystIsSeenAndTheSurroundingsAreNot)
{
  const Mask seen = sweptRegion(ball());
  EXPECT_TRUE(isSeen(seen, Middle + glm::dvec3(4, 0, 0)));
  for (const double fraction : { 0.0, 0.5, 0.75 })
  {
    EXPECT_TRUE(isSeen(seen, Middle - glm::dvec3(10.0 * fraction, 0, 0))) << fraction;
    EXPECT_TRUE(isSeen(seen, Middle + glm::dvec3(0, 0, 10.0 * fraction))) << fraction;
  }
  for (const glm::dvec3& away : { glm::dvec3(10, 0, 0), glm::dvec3(0, -10, 0), glm::dvec3(-13) })
  {
    EXPECT_FALSE(isSeen(seen, glm::max(Middle + away, glm::dvec3(0.0))));
  }
}

TEST(Sweep, AVolumeWithoutSurroundingsIsSeenAsAWhole)
{
  Grid grid;
  grid.dimensions = { 9, 8, 7 };
  const Mask seen = sweptRegion(filled(grid,
    [](const glm::dvec3& at) { return glm::length(at - glm::dvec3(4, 4, 3)) < 2.0 ? 0.0 : 1.0; }));
  EXPECT_TRUE(std::all_of(seen.inside.begin(), seen.inside.end(), [](char in) { return in == 1; }));
}

// Beside the surroundings a block may be full in part, also where it touches them at a corner.
TEST(Sweep, WhatTouchesTheSurroundingsDoesNotCount)
{
  Grid grid;
  grid.dimensions = { 9, 9, 9 };
  const auto isOutside = [](const glm::dvec3& at) { return at.x < 4 && at.y < 4 && at.z < 4; };
  const Mask seen =
    sweptRegion(filled(grid, [&](const glm::dvec3& at) { return isOutside(at) ? 0.0 : 1.0; }));
  ASSERT_EQ(seen.grid, grid);
  EXPECT_FALSE(isSeen(seen, { 4, 4, 4 })) << "a corner";
  EXPECT_FALSE(isSeen(seen, { 4, 4, 2 })) << "an edge";
  EXPECT_FALSE(isSeen(seen, { 4, 2, 2 })) << "a face";
  EXPECT_TRUE(isSeen(seen, { 5, 4, 4 }));
  EXPECT_TRUE(isSeen(seen, { 5, 2, 2 }));
}

TEST(Sweep, AGridIsCroppedToARegionWithItsMargin)
{
  Grid grid;
  grid.origin = { -40.0, -30.0, -20.0 };
  grid.dimensions = { 60, 50, 40 };
  grid.spacing = { 2.0, 2.0, 2.0 };
  const Grid cropped = croppedTo(grid, sweptRegion(ball()), 4.0);
  const glm::dvec3 last = cropped.worldFromGrid(cropped.dimensions - 1);
  EXPECT_EQ(cropped.spacing, grid.spacing);
  for (int axis = 0; axis < 3; ++axis)
  {
    // The ball has a radius of 10 mm, of which its border of 1 to 2 mm is left out.
    EXPECT_LE(cropped.origin[axis], Middle[axis] - 10.0 - 4.0 + 2.0);
    EXPECT_GE(cropped.origin[axis], Middle[axis] - 10.0 - 4.0 - 2.0);
    EXPECT_GE(last[axis], Middle[axis] + 10.0 + 4.0 - 2.0);
    EXPECT_LE(last[axis], Middle[axis] + 10.0 + 4.0 + 2.0);
    const double steps = (cropped.origin[axis] - grid.origin[axis]) / 2.0;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(Sweep, AGridFarFromTheRegionIsKept)
{
  Grid grid;
  grid.origin = { 500.0, 0.0, 0.0 };
  grid.dimensions = { 6, 5, 4 };
  EXPECT_EQ(croppedTo(grid, sweptRegion(ball()), 4.0).dimensions, grid.dimensions);
}

TEST(Sweep, SamplesOfACroppedGridReadTheSameLattice)
{
  Lattice lattice;
  lattice.grid.dimensions = { 7, 6, 5 };
  lattice.grid.spacing = { 10.0, 9.0, 8.0 };
  lattice.displacements.resize(lattice.grid.count());
  Grid grid;
  grid.dimensions = { 31, 24, 17 };
  grid.spacing = glm::dvec3(2.0);
  Grid part = grid;
  part.origin = grid.worldFromGrid({ 4, 3, 2 });
  part.dimensions = { 12, 10, 8 };
  const LatticeRows whole(lattice, grid);
  const LatticeRows cropped(lattice, part);
  const glm::vec3 at(3.3f, 2.6f, 1.2f);
  const glm::vec3 same = at + glm::vec3(4.0f, 3.0f, 2.0f);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Taps found = cropped.tapsAt(axis, at[axis]);
    const Taps asked = whole.tapsAt(axis, same[axis]);
    EXPECT_EQ(found.first, asked.first);
    EXPECT_LT(glm::length(found.weights - asked.weights), 1e-5f);
    EXPECT_NEAR(cropped.latticePosition(at)[axis], whole.latticePosition(same)[axis], 1e-5);
  }
}
