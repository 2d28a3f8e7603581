// SPDX-License-Identifier: BSD-3-Clause
// Proves that the distance to a mask is in mm, whatever the spacing and the direction of its voxels
// are, and that it counts beyond the mask's own image.
#include "Filters/Measured/MeasuredPoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace brainshift;

namespace
{
constexpr double NearMm = 6.0;

// Voxels of three sizes along axes that are rotated by a quarter about z.
Grid someGrid()
{
  Grid grid;
  grid.dimensions = { 9, 8, 7 };
  grid.spacing = { 0.5, 2.0, 3.0 };
  grid.origin = { -40.0, 25.0, 10.0 };
  grid.direction = glm::dmat3(0, 1, 0, -1, 0, 0, 0, 0, 1);
  return grid;
}

Mask maskOf(const std::vector<glm::ivec3>& voxels)
{
  Mask mask{ someGrid(), {} };
  mask.inside.assign(mask.grid.count(), 0);
  for (const glm::ivec3& voxel : voxels)
  {
    mask.inside[mask.grid.offset(voxel.x, voxel.y, voxel.z)] = 1;
  }
  return mask;
}
}

TEST(NearMask, MeasuresInMmAlongEachAxis)
{
  const Mask mask = maskOf({ { 4, 3, 2 } });
  const NearMask near(mask, NearMm);
  const glm::dvec3 middle = mask.grid.worldFromGrid({ 4, 3, 2 });
  EXPECT_TRUE(near.holds(middle));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { -1.0, 1.0 })
    {
      glm::dvec3 away(0.0);
      away[axis] = sign;
      EXPECT_TRUE(near.holds(middle + (NearMm - 0.01) * away)) << axis << sign;
      EXPECT_FALSE(near.holds(middle + (NearMm + 0.01) * away)) << axis << sign;
    }
  }
  const glm::dvec3 diagonal(1.0 / std::sqrt(3.0));
  EXPECT_TRUE(near.holds(middle + (NearMm - 0.01) * diagonal));
  EXPECT_FALSE(near.holds(middle + (NearMm + 0.01) * diagonal));
}

// The first and the last voxel that are inside count, at the image's corners too.
TEST(NearMask, AnyVoxelThatIsInsideCounts)
{
  const glm::ivec3 last = someGrid().dimensions - 1;
  const Mask mask = maskOf({ { 0, 0, 0 }, last });
  const NearMask near(mask, NearMm);
  const double outward[] = { -1.0, 1.0 };
  const glm::ivec3 corners[] = { { 0, 0, 0 }, last };
  for (int i = 0; i < 2; ++i)
  {
    const glm::dvec3 corner = mask.grid.worldFromGrid(corners[i]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const glm::dvec3 away = outward[i] * mask.grid.direction[axis];
      EXPECT_TRUE(near.holds(corner + (NearMm - 0.01) * away)) << i << axis;
      EXPECT_FALSE(near.holds(corner + (NearMm + 0.01) * away)) << i << axis;
    }
  }
  EXPECT_FALSE(near.holds(mask.grid.worldFromGrid(0.5 * glm::dvec3(last)))) << "between both";
}

TEST(NearMask, NothingIsNearAnEmptyMask)
{
  const Mask empty = maskOf({});
  EXPECT_FALSE(NearMask(empty, 1000.0).holds(empty.grid.origin));
}
