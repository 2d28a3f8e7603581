// SPDX-License-Identifier: BSD-3-Clause
// Proves that the grid along the nearest RAS axes loses nothing of an affine without shear.
#include "Formats/Volumes/RasGrid.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

TEST(RasGrid, TiesKeepTheFilesOrder)
{
  const glm::dmat4 diagonal =
    glm::rotate(glm::dmat4(1.0), glm::radians(45.0), glm::dvec3(0.0, 0.0, 1.0));
  const brainshift::RasGrid found = brainshift::nearestRasGrid(diagonal, glm::ivec3(4, 3, 5));
  EXPECT_EQ(found.voxelAxis, (std::array<int, 3>{ 0, 1, 2 }));
  EXPECT_EQ(found.reversed, (std::array<bool, 3>{}));
}

// Every rotation and reflection leaves a rotation after permuting and flipping, and costs nothing.
TEST(RasGrid, AnyOrthogonalAffineIsLossless)
{
  for (int i = 0; i < 500; ++i)
  {
    const glm::dvec3 axis(std::sin(1.0 + i), std::cos(3.0 * i), std::sin(7.0 * i + 2.0));
    glm::dmat4 affine = glm::rotate(glm::dmat4(1.0), 0.1 * i, glm::normalize(axis));
    affine[i % 3] *= i % 2 == 0 ? -2.5 : 0.5;
    const brainshift::RasGrid found = brainshift::nearestRasGrid(affine, glm::ivec3(256, 200, 180));
    EXPECT_LT(found.largestErrorMm, 1e-9);
    EXPECT_NEAR(glm::determinant(found.grid.direction), 1.0, 1e-12);
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_GT(found.grid.direction[a][a], 0.0);
      EXPECT_GT(found.grid.spacing[a], 0.0);
    }
  }
}
