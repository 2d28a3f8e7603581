// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A ball of labels on grids, for tests of segments.
#ifndef BrainShift_TestBall_h
#define BrainShift_TestBall_h

#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/gtc/matrix_transform.hpp>

namespace brainshift::testing::ball
{
inline const Grid VolumeGrid = plainGrid({ 25, 21, 23 }, glm::dvec3(2.0));
inline const glm::dvec3 Middle(24.0, 20.0, 22.0);

// Labels: 3 in a ball of 12 mm, 5 around it up to 17 mm.
inline int labelAt(const glm::dvec3& world)
{
  const double away = glm::distance(world, Middle);
  return away < 12.0 ? 3 : away < 17.0 ? 5 : 0;
}

// A finer grid that shares no axis with the volume and covers it.
inline Grid obliqueLabels()
{
  Grid grid = plainGrid(glm::ivec3(70), glm::dvec3(1.1));
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.6, glm::dvec3(1.0, -2.0, 0.5)));
  grid.origin = Middle - grid.worldVectorFromGrid(glm::dvec3(34.5));
  return grid;
}
}

#endif
