// SPDX-License-Identifier: BSD-3-Clause
// Proves that derivatives of the forward map are right, and that the smallest determinant that a
// user reads is nowhere undercut and nearly reached.
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };
constexpr double Tolerance = DeterminantTolerance + 1e-6; // the map's numbers are single precision

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
  constexpr double H = 0.02;             // mm
  constexpr double OfDifferences = 5e-4; // single-precision displacements over 2 * H
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
        EXPECT_LT(glm::distance(jacobian[axis], difference), OfDifferences) << "axis " << axis;
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
  EXPECT_NEAR(minimumJacobian(halved(KernelBSpline)), 0.125, Tolerance);
  // In a border cell Catmull-Rom's first tap repeats the border. The slope is 0.5 + 2 t - 1.5 t^2
  // times the linear one, 7/6 at most: lengths shrink to 1 - 0.5 * 7/6.
  const double shrunk = 5.0 / 12.0;
  EXPECT_NEAR(minimumJacobian(halved(KernelCatmullRom)), shrunk * shrunk * shrunk, Tolerance);
}

TEST(MinimumJacobian, IsAboveOneOnlyIfAllOfItGrows)
{
  const Grid grid = plainGrid(glm::ivec3(7), glm::dvec3(10.0));
  const auto grow = [](const glm::dvec3& rest) { return 0.5 * (rest - glm::dvec3(30.0)); };
  // In a border cell the B-spline's slope is half the linear one at the border itself.
  EXPECT_NEAR(
    minimumJacobian(latticeOf(grid, KernelBSpline, grow)), 1.25 * 1.25 * 1.25, 2.0 * Tolerance);
  Lattice middle = makeLattice(grid, KernelBSpline);
  middle.displacements[grid.offset(0, 0, 0)] = { -5.0f, 0.0f, 0.0f };
  EXPECT_NEAR(minimumJacobian(middle), 1.0, Tolerance) << "far from that corner tissue stays";
}

TEST(MinimumJacobian, IsNegativeWhereTissueFolds)
{
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(9), glm::dvec3(5.0)), KernelCatmullRom);
  lattice.displacements[lattice.grid.offset(4, 4, 4)] = { 15.0f, 0.0f, 0.0f }; // three cells
  // Catmull-Rom's weight falls steepest at 5/9 of the way to the next control point.
  EXPECT_NEAR(minimumJacobian(lattice), 1.0 - 3.0 * 25.0 / 18.0, 4.0 * Tolerance);
}

namespace
{
// The least determinant on a grid of points, then by ever smaller steps around the least of them.
template <typename Determinant>
double searched(const glm::dvec3& end, double step, const Determinant& determinantAt)
{
  double smallest = 1.0;
  glm::dvec3 place(0.0);
  const auto ask = [&](const glm::dvec3& anywhere) {
    const glm::dvec3 at = glm::clamp(anywhere, glm::dvec3(1e-6), end - 1e-6); // not beyond
    const double determinant = determinantAt(at);
    place = determinant < smallest ? at : place;
    smallest = std::min(smallest, determinant);
  };
  glm::dvec3 at(0.0);
  for (at.z = 0.0; at.z <= end.z; at.z += step)
  {
    for (at.y = 0.0; at.y <= end.y; at.y += step)
    {
      for (at.x = 0.0; at.x <= end.x; at.x += step)
      {
        ask(at);
      }
    }
  }
  for (double finer = 0.5 * step; finer > 1e-4; finer *= 0.7)
  {
    const glm::dvec3 around = place;
    for (int i = 0; i < 27; ++i)
    {
      ask(around + finer * (glm::dvec3(i % 3, i / 3 % 3, i / 9) - 1.0));
    }
  }
  return smallest;
}

double searched(const Lattice& lattice)
{
  const PointMap map(lattice);
  return searched(glm::dvec3(lattice.grid.dimensions - 1), 0.125, [&](const glm::dvec3& at) {
    return glm::determinant(map.jacobian(lattice.grid.worldFromGrid(at)));
  });
}

// What was reported before: the least at control points and halfway between them.
double halfway(const Lattice& lattice)
{
  const PointMap map(lattice);
  const glm::ivec3 count = 2 * lattice.grid.dimensions - 1;
  double smallest = 1.0;
  for (int i = 0; i < count.x * count.y * count.z; ++i)
  {
    const glm::dvec3 at =
      0.5 * glm::dvec3(i % count.x, i / count.x % count.y, i / count.x / count.y);
    smallest = std::min(smallest, glm::determinant(map.jacobian(lattice.grid.worldFromGrid(at))));
  }
  return smallest;
}
}

TEST(MinimumJacobian, IsNowhereUndercut)
{
  // Bases without a guard, as strong as they may be with 0.05 at control points and halfway between
  // them: there tissue seems not to fold.
  int folded = 0;
  for (unsigned int seed = 0; seed < 40; ++seed)
  {
    Lattice lattice =
      randomLattice(obliqueGrid({ 5, 4, 6 }), static_cast<int>(seed) % 2, seed, 3.0);
    while (halfway(lattice) < 0.05)
    {
      for (glm::vec3& displacement : lattice.displacements)
      {
        displacement *= 0.97f;
      }
    }
    const double reported = minimumJacobian(lattice);
    const double least = searched(lattice);
    EXPECT_LE(reported, least + 1e-5) << seed;
    EXPECT_GE(reported, least - 0.002) << seed;
    folded += least < 0.0;
  }
  EXPECT_GT(folded, 0);
}

TEST(MinimumJacobian, OfOneStrokeIsTheLeastOfAllPlaces)
{
  // Most cells are unmoved. In the middle, and along each of the far faces, where the smallest
  // determinant then lies.
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
      const double least = searched(lattice);
      EXPECT_LT(least, 0.9);
      EXPECT_LE(minimumJacobian(lattice), least + 1e-5) << "anchor " << stroke.anchor.x;
      EXPECT_GE(minimumJacobian(lattice), least - Tolerance - 1e-4);
    }
  }
}

TEST(MinimumJacobian, OfAMaskedLatticeIsNowhereUndercut)
{
  // Between the corners of a cell the determinant can be smaller than at each of them.
  for (unsigned int seed = 0; seed < 20; ++seed)
  {
    Lattice lattice = randomLattice(plainGrid(glm::ivec3(4), glm::dvec3(9.0)), 0, seed, 0.35);
    NodeWeights weights;
    weights.perCell = 2;
    Random random(seed + 100);
    for (int node = 0; node < 7 * 7 * 7; ++node)
    {
      weights.values.push_back(static_cast<float>(random.between(0.5, 1.0)));
    }
    lattice.mask = std::make_shared<NodeWeights>(weights);
    const NodeField field = refine(lattice, 1);
    const double least = searched(glm::dvec3(3.0), 0.0625, [&](const glm::dvec3& at) {
      double smallest = 1e9;
      for (int side = 0; side < 8; ++side) // the slopes jump at nodes
      {
        const glm::vec3 aside =
          2e-5f * glm::vec3(glm::ivec3(side & 1, side >> 1 & 1, side >> 2) * 2 - 1);
        glm::vec3 unused;
        glm::mat3 jacobian;
        field.map(glm::clamp(glm::vec3(at) + aside, 1e-5f, 3.0f - 1e-5f), unused, jacobian);
        smallest = std::min(smallest, double(glm::determinant(jacobian)));
      }
      return smallest;
    });
    EXPECT_LE(minimumJacobian(lattice), least + 1e-3) << seed;
    EXPECT_GE(minimumJacobian(lattice), least - 0.01) << seed;
  }
}
