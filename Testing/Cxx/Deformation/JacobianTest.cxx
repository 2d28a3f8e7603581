// SPDX-License-Identifier: BSD-3-Clause
// Proves that derivatives of the forward map, and the smallest determinant told to the user, are
// right.
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };

// Shrinks by half about the middle.
Lattice halved(int kernel)
{
  const Grid grid = plainGrid(glm::ivec3(7), glm::dvec3(10.0));
  return latticeOf(
    grid, kernel, [](const glm::dvec3& rest) { return -0.5 * (rest - glm::dvec3(30.0)); });
}
}

TEST(Jacobian, IsTheDerivativeOfTheForwardMap)
{
  constexpr double H = 0.02;         // mm
  constexpr double Tolerance = 5e-4; // single-precision displacements over 2 * H
  for (const int kernel : BothKernels)
  {
    const Lattice lattice = randomLattice(obliqueGrid({ 6, 5, 7 }), kernel, 11, 0.5);
    const PointMap map(lattice);
    Random random(12);
    for (int i = 0; i < 300; ++i)
    {
      const glm::dvec3 rest = random.point(lattice.grid, -0.01); // no kink of the border within H
      const glm::dmat3 jacobian = map.jacobian(rest);
      for (int axis = 0; axis < 3; ++axis)
      {
        glm::dvec3 step(0.0);
        step[axis] = H;
        const glm::dvec3 difference =
          (map.deformedFromRest(rest + step) - map.deformedFromRest(rest - step)) / (2.0 * H);
        EXPECT_LT(glm::distance(jacobian[axis], difference), Tolerance) << "axis " << axis;
      }
    }
  }
}

TEST(Jacobian, KnowsThatNothingChangesOutsideAlongAnAxis)
{
  const Lattice lattice = randomLattice(plainGrid({ 5, 6, 7 }, glm::dvec3(10.0)), 0, 13, 0.5);
  const PointMap map(lattice);
  const glm::dmat3 jacobian = map.jacobian({ -8.0, 25.0, 31.0 });
  EXPECT_EQ(jacobian[0], glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NE(jacobian[1], glm::dvec3(0.0, 1.0, 0.0));
}

TEST(MinimumJacobian, OfNoDisplacementIsOne)
{
  EXPECT_EQ(minimumJacobian(makeLattice(obliqueGrid({ 4, 5, 6 }), KernelCatmullRom)), 1.0);
}

TEST(MinimumJacobian, OfHalvedLengthsIsAnEighth)
{
  EXPECT_NEAR(minimumJacobian(halved(KernelBSpline)), 0.125, 1e-5);
  // In a border cell Catmull-Rom's first tap repeats the border, which makes the slope there 1.125
  // times the linear one halfway: lengths shrink to 1 - 0.5 * 1.125.
  EXPECT_NEAR(minimumJacobian(halved(KernelCatmullRom)), 0.4375 * 0.4375 * 0.4375, 1e-5);
}

TEST(MinimumJacobian, IsAboveOneOnlyIfAllOfItGrows)
{
  const Grid grid = plainGrid(glm::ivec3(7), glm::dvec3(10.0));
  const auto grow = [](const glm::dvec3& rest) { return 0.5 * (rest - glm::dvec3(30.0)); };
  // In a border cell the B-spline's slope is half the linear one at the border itself.
  EXPECT_NEAR(minimumJacobian(latticeOf(grid, KernelBSpline, grow)), 1.25 * 1.25 * 1.25, 1e-5);
  Lattice middle = makeLattice(grid, KernelBSpline);
  middle.displacements[grid.offset(0, 0, 0)] = { -5.0f, 0.0f, 0.0f };
  EXPECT_EQ(minimumJacobian(middle), 1.0) << "far from that corner tissue stays";
}

TEST(MinimumJacobian, IsNegativeWhereTissueFolds)
{
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(9), glm::dvec3(5.0)), KernelCatmullRom);
  lattice.displacements[lattice.grid.offset(4, 4, 4)] = { 15.0f, 0.0f, 0.0f }; // three cells
  // Catmull-Rom falls by 1.375 a cell halfway to the next control point.
  EXPECT_NEAR(minimumJacobian(lattice), 1.0 - 3.0 * 1.375, 1e-5);
}

TEST(MinimumJacobian, IsTheSmallestOfAllSamples)
{
  // One stroke: most cells are unmoved, which the search may skip. In the middle, and along each of
  // the far faces, where the smallest determinant then lies.
  struct Case
  {
    glm::dvec3 anchor; // lattice coordinates
    glm::dvec3 vector;
  };
  const Case cases[] = { { { 3.3, 6.2, 4.1 }, { 9, -7, 8 } }, { { 8, 6, 4 }, { 0, -8, 8 } },
    { { 3, 9, 4 }, { 9, 0, 8 } }, { { 3, 6, 7 }, { 9, -8, 0 } } };
  for (const int kernel : BothKernels)
  {
    for (const Case& stroke : cases)
    {
      const Grid grid = plainGrid({ 9, 10, 8 }, glm::dvec3(7.0, 8.0, 9.0));
      Lattice lattice = makeLattice(grid, kernel);
      applyStroke(lattice, strokeAt(Tool::Soft, grid.worldFromGrid(stroke.anchor), stroke.vector));
      const PointMap map(lattice);
      double smallest = 1.0;
      for (int sample = 0; sample < 17 * 19 * 15; ++sample)
      {
        const glm::dvec3 position = 0.5 * glm::dvec3(sample % 17, sample / 17 % 19, sample / 323);
        smallest = std::min(smallest, glm::determinant(map.jacobian(grid.worldFromGrid(position))));
      }
      EXPECT_LT(smallest, 0.9);
      EXPECT_NEAR(minimumJacobian(lattice), smallest, 1e-4) << "anchor " << stroke.anchor.x;
    }
  }
}
