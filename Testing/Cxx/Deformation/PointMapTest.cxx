// SPDX-License-Identifier: BSD-3-Clause
// Proves that the backward map undoes the forward map: tissue arrives where the handle is put.
#include "Filters/Deformation/PointMap.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };
constexpr double VoxelMm = 1.0;

// Stretches fourfold along x about the middle.
Lattice stretched(int kernel)
{
  return latticeOf(plainGrid({ 9, 5, 5 }, glm::dvec3(10.0)), kernel,
    [](const glm::dvec3& rest) { return glm::dvec3(3.0 * (rest.x - 40.0), 0.0, 0.0); });
}

// Largest |deformedFromRest(restFromDeformed(p)) - p| over random points.
double largestMiss(const Lattice& lattice, unsigned int seed, int points)
{
  const PointMap map(lattice);
  Random random(seed);
  double largest = 0.0;
  for (int i = 0; i < points; ++i)
  {
    const glm::dvec3 deformed = random.point(lattice.grid, 1.5);
    const glm::dvec3 back = map.deformedFromRest(map.restFromDeformed(deformed));
    largest = std::max(largest, glm::distance(back, deformed));
  }
  return largest;
}
}

TEST(PointMap, OfNoDisplacementIsIdentity)
{
  for (const Inverse inverse : { Inverse::Exact, Inverse::Negated })
  {
    const Grid grid = obliqueGrid({ 5, 6, 7 });
    const PointMap map(makeLattice(grid, KernelCatmullRom), inverse);
    Random random(21);
    for (int i = 0; i < 100; ++i)
    {
      const glm::dvec3 point = random.point(grid, 2.0);
      EXPECT_EQ(map.deformedFromRest(point), point);
      EXPECT_EQ(map.restFromDeformed(point), point);
      EXPECT_EQ(map.jacobian(point), glm::dmat3(1.0));
    }
  }
}

TEST(PointMap, UndoesItselfWhereverNothingFolds)
{
  for (const int kernel : BothKernels)
  {
    for (unsigned int seed = 100; seed < 120; ++seed)
    {
      const glm::ivec3 dimensions(5 + seed % 3, 6, 5 + seed % 4);
      const Grid grid =
        seed % 2 ? obliqueGrid(dimensions) : plainGrid(dimensions, { 14.2, 14.2, 8.3 });
      const Lattice lattice = randomLatticeWithoutFolds(grid, kernel, seed);
      EXPECT_LT(largestMiss(lattice, seed, 1000), largestErrorMm(VoxelMm))
        << "kernel " << kernel << " seed " << seed;
    }
  }
}

TEST(PointMap, UndoesAStretchThatAFixedPointCannot)
{
  for (const int kernel : BothKernels)
  {
    const Lattice lattice = stretched(kernel);
    const PointMap map(lattice);
    const glm::dvec3 deformed(90.0, 20.0, 20.0);
    glm::dvec3 fixedPoint = deformed;
    for (int i = 0; i < 100; ++i)
    {
      fixedPoint = deformed - (map.deformedFromRest(fixedPoint) - fixedPoint);
    }
    EXPECT_GT(glm::distance(map.deformedFromRest(fixedPoint), deformed), 10.0)
      << "this case has become too easy";
    EXPECT_LT(glm::distance(map.restFromDeformed(deformed), glm::dvec3(52.5, 20.0, 20.0)), 0.01);
    EXPECT_LT(largestMiss(lattice, 22, 2000), largestErrorMm(VoxelMm));
  }
}

TEST(PointMap, NegatedSubtractsTheDisplacementAtTheDrawnPoint)
{
  const Lattice lattice = randomLatticeWithoutFolds(obliqueGrid({ 6, 5, 7 }), 0, 23);
  const PointMap exact(lattice, Inverse::Exact);
  const PointMap negated(lattice, Inverse::Negated);
  Random random(24);
  double largestDifference = 0.0;
  for (int i = 0; i < 300; ++i)
  {
    const glm::dvec3 point = random.point(lattice.grid, 1.0);
    const glm::dvec3 displacement = negated.deformedFromRest(point) - point;
    EXPECT_LT(glm::distance(negated.restFromDeformed(point), point - displacement), 1e-4);
    EXPECT_EQ(negated.deformedFromRest(point), exact.deformedFromRest(point));
    largestDifference = std::max(largestDifference,
      glm::distance(exact.restFromDeformed(point), negated.restFromDeformed(point)));
  }
  EXPECT_GT(largestDifference, 1.0) << "mm: the two must be told apart";
}

// One step from a guess nearby, against as many as it takes.
TEST(PointMap, FindsOffsetsNearAGuess)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (unsigned int seed = 70; seed < 76; ++seed)
    {
      const Lattice lattice = randomLatticeWithoutFolds(obliqueGrid({ 6, 5, 7 }), kernel, seed);
      const PointMap map(lattice);
      Random random(seed);
      float largest = 0.0f;
      for (int i = 0; i < 5000; ++i)
      {
        const glm::dvec3 deformed =
          random.between(glm::dvec3(-0.5), glm::dvec3(lattice.grid.dimensions) - 0.5);
        const glm::vec3 known = map.offsetInCells(deformed, glm::vec3(0.0f));
        const glm::vec3 guess =
          known + glm::vec3(random.between(glm::dvec3(-0.02), glm::dvec3(0.02)));
        largest = std::max(largest, glm::distance(map.offsetNear(deformed, guess), known));
      }
      EXPECT_LT(largest, 5e-4f) << "kernel " << kernel << " seed " << seed;
    }
  }
}
