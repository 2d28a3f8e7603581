// SPDX-License-Identifier: BSD-3-Clause
// Proves that the nearest point of a cortex is found where triangles have no area, which they have
// wherever a voxel has just the threshold: volumes of whole numbers are full of them.
#include "Filters/Measured/RestCortex.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include "vtkNew.h"
#include "vtkUnsignedCharArray.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int Side = 9;
constexpr double Level = 2.0;

// Whole numbers from 0 to 4, by chance: a fifth of the voxels has just the level.
TissueRegion ofWholeNumbers(unsigned int seed)
{
  Random random(seed);
  vtkNew<vtkUnsignedCharArray> scalars;
  for (int i = 0; i < Side * Side * Side; ++i)
  {
    scalars->InsertNextValue(static_cast<unsigned char>(random.between(0.0, 4.999)));
  }
  Grid grid;
  grid.dimensions = glm::ivec3(Side);
  return TissueRegion{ grid, scalars.Get(), Level };
}
}

TEST(RestCortex, FindsTheNearestPointWhereTrianglesHaveNoArea)
{
  for (unsigned int seed = 1; seed < 6; ++seed)
  {
    const RestCortex cortex(ofWholeNumbers(seed));
    ASSERT_FALSE(cortex.isEmpty());
    Random random(seed);
    for (int i = 0; i < 2000; ++i)
    {
      glm::dvec3 at = random.between(glm::dvec3(-1.0), glm::dvec3(Side));
      at = i % 2 ? glm::round(at) : at; // many of them are corners of triangles
      int hint = -1;
      const auto foot = cortex.nearest(at, hint);
      const SurfacePoint found = foot.value_or(SurfacePoint());
      ASSERT_NEAR(glm::length(found.normal), 1.0, 1e-9) << seed << " " << i;
      double nearest = std::numeric_limits<double>::infinity();
      for (const SurfacePoint& point : cortex.points())
      {
        nearest = std::min(nearest, glm::distance(point.position, at));
      }
      // A foot is at least as near as any corner.
      ASSERT_LE(glm::distance(found.position, at), nearest + 1e-9) << seed << " " << i;
    }
  }
}
