// SPDX-License-Identifier: BSD-3-Clause
// Proves that each tool moves the control points it should by what it should, and that a lattice
// displaces every point as documented.
#include "Filters/Deformation/Lattice.h"
#include "Common/Problem.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr Tool AllTools[] = { Tool::Move, Tool::Soft, Tool::Stamp };
constexpr int BothKernels[] = { KernelCatmullRom, KernelBSpline };

// Control points at 0, 10 ... 60 mm.
Lattice tenMillimetreLattice()
{
  return makeLattice(plainGrid(glm::ivec3(7), glm::dvec3(10.0)), KernelCatmullRom);
}

const glm::vec3& at(const Lattice& lattice, int i, int j, int k)
{
  return lattice.displacements[lattice.grid.offset(i, j, k)];
}

int movedPoints(const Lattice& lattice)
{
  int moved = 0;
  for (const glm::vec3& displacement : lattice.displacements)
  {
    moved += displacement != glm::vec3(0.0f);
  }
  return moved;
}

// Every control point has the weight that falloff gives at its distance.
void expectFallsOff(const Stroke& stroke, int reached)
{
  Lattice lattice = tenMillimetreLattice();
  applyStroke(lattice, stroke);
  EXPECT_EQ(movedPoints(lattice), reached);
  for (int point = 0; point < 343; ++point)
  {
    const glm::dvec3 rest(10.0 * glm::dvec3(point % 7, point / 7 % 7, point / 49));
    const double weight = falloff(normalisedDistance(stroke, rest), stroke.sigma);
    const glm::dvec3 error = glm::dvec3(lattice.displacements[point]) - weight * stroke.vector;
    EXPECT_LT(glm::length(error), 1e-6) << "control point " << point;
  }
}
}

TEST(Move, MovesTheNearestControlPointAndNoOther)
{
  Lattice lattice = tenMillimetreLattice();
  applyStroke(lattice, strokeAt(Tool::Move, { 34.9, 25.1, 36.0 }, { 1, 2, 3 }));
  EXPECT_EQ(at(lattice, 3, 3, 4), glm::vec3(1, 2, 3));
  EXPECT_EQ(movedPoints(lattice), 1);
}

TEST(Move, TakesTheBorderFromOutside)
{
  Lattice lattice = tenMillimetreLattice();
  applyStroke(lattice, strokeAt(Tool::Move, { -500.0, 31.0, 500.0 }, { 1, 2, 3 }));
  EXPECT_EQ(at(lattice, 0, 3, 6), glm::vec3(1, 2, 3));
  EXPECT_EQ(movedPoints(lattice), 1);
}

TEST(Move, IsMeasuredInTheRestFrame)
{
  Lattice lattice = tenMillimetreLattice();
  applyStroke(lattice, strokeAt(Tool::Move, { 30, 30, 30 }, { 25, 0, 0 }));
  applyStroke(lattice, strokeAt(Tool::Move, { 30, 30, 30 }, { 0, 1, 0 }));
  EXPECT_EQ(at(lattice, 3, 3, 3), glm::vec3(25, 1, 0));
  EXPECT_EQ(movedPoints(lattice), 1);
}

TEST(Soft, FallsOffWithTheDistance)
{
  Stroke stroke = strokeAt(Tool::Soft, { 30, 30, 30 }, { 3, -2, 1 });
  stroke.major = 10.5; // the point itself and its six neighbours
  expectFallsOff(stroke, 7);
}

namespace
{
// Soft strokes of 3.7 mm all over a lattice of 14 mm, one after the other.
class ManySoft : public ::testing::TestWithParam<int>
{
protected:
  // Visits each stroke with the lattice before and after it.
  template <typename Visit>
  void visit(double radius, const Visit& visitStroke) const
  {
    Random random(61);
    Lattice lattice = makeLattice(plainGrid(glm::ivec3(15), glm::dvec3(14.0)), GetParam());
    for (int i = 0; i < 20; ++i)
    {
      Stroke stroke = strokeAt(Tool::Soft, random.point(lattice.grid, -3.0), { 3, -2, 1 });
      stroke.major = radius;
      const Lattice before = lattice;
      applyStroke(lattice, stroke);
      visitStroke(before, lattice, stroke);
    }
  }
};
}

// achievedDisplacement follows the tissue through the map; it knows nothing of weights.
TEST_P(ManySoft, TakeTheTissueAtTheirAnchorsAllTheWay)
{
  for (const double radius : { 25.0, 40.0 })
  {
    this->visit(radius, [&](const Lattice& before, const Lattice& after, const Stroke& stroke) {
      EXPECT_NEAR(achievedDisplacement(before, after, stroke), glm::length(stroke.vector), 1e-3)
        << radius;
    });
  }
  // A B-spline averages more control points than a sphere of 1.4 spacings holds.
  this->visit(20.0, [&](const Lattice& before, const Lattice& after, const Stroke& stroke) {
    EXPECT_GT(achievedDisplacement(before, after, stroke), 0.7 * glm::length(stroke.vector));
  });
}

TEST_P(ManySoft, ThrowNoTissueFurtherThanTheHand)
{
  Random random(62);
  double furthest = 0.0;
  for (const double radius : { 3.0, 9.0, 15.0, 25.0, 40.0 })
  {
    this->visit(radius, [&](const Lattice& before, const Lattice& after, const Stroke& stroke) {
      for (int i = 0; i < 2000; ++i)
      {
        const glm::dvec3 rest = random.point(before.grid, -2.0);
        furthest = std::max(furthest,
          glm::distance(displacementOfTissue(after, rest), displacementOfTissue(before, rest)) /
            glm::length(stroke.vector));
      }
    });
  }
  EXPECT_GT(furthest, 0.9);
  EXPECT_LT(furthest, 1.25);
}

INSTANTIATE_TEST_SUITE_P(Kernels, ManySoft, ::testing::Values(KernelCatmullRom, KernelBSpline));

TEST(Stamp, FallsOffWithinItsEllipsoid)
{
  Stroke stroke = strokeAt(Tool::Stamp, { 30, 30, 30 }, { 0, 4, 0 });
  stroke.major = 25.0;
  stroke.minor = 5.0; // along y five points, across none
  expectFallsOff(stroke, 5);
}

TEST(Stamp, KeepsItsShapeOnAnObliqueLattice)
{
  const Grid grid = obliqueGrid({ 9, 10, 8 });
  Lattice lattice = makeLattice(grid, KernelCatmullRom);
  const glm::dvec3 anchor = grid.worldFromGrid({ 4.2, 5.1, 3.3 });
  const Stroke stroke = strokeAt(Tool::Stamp, anchor, { 2, 3, -1 });
  applyStroke(lattice, stroke);
  std::size_t point = 0;
  for (int k = 0; k < 8; ++k)
  {
    for (int j = 0; j < 10; ++j)
    {
      for (int i = 0; i < 9; ++i, ++point)
      {
        const double distance = normalisedDistance(stroke, grid.worldFromGrid({ i, j, k }));
        const glm::dvec3 expected = falloff(distance, stroke.sigma) * stroke.vector;
        EXPECT_LT(glm::distance(glm::dvec3(lattice.displacements[point]), expected), 1e-6);
      }
    }
  }
  EXPECT_GT(movedPoints(lattice), 50);
}

TEST(SoftAndStamp, AreMeasuredInTheDeformedFrame)
{
  for (const Tool tool : { Tool::Soft, Tool::Stamp })
  {
    Stroke stroke = strokeAt(tool, { 35, 30, 30 }, { 0, 1, 0 });
    stroke.major = 4.0;
    stroke.minor = 4.0;
    Lattice lattice = tenMillimetreLattice();
    applyStroke(lattice, stroke);
    EXPECT_EQ(movedPoints(lattice), 0) << "at rest no control point is within 4 mm";
    applyStroke(lattice, strokeAt(Tool::Move, { 30, 30, 30 }, { 5, 0, 0 }));
    applyStroke(lattice, stroke);
    const glm::vec3 there = at(lattice, 3, 3, 3);
    EXPECT_LT(glm::distance(there, glm::vec3(5, 1, 0)), 1e-3f) << "the first stroke moved it there";
    stroke.anchor.x = 30.0;
    applyStroke(lattice, stroke);
    EXPECT_EQ(at(lattice, 3, 3, 3), there) << "it is not at its rest position";
  }
}

TEST(EveryTool, MovesHalfAsFarWithHalfTheVector)
{
  for (const Tool tool : AllTools)
  {
    Stroke stroke = strokeAt(tool, { 31, 28, 33 }, { 6, -3, 5 });
    Lattice whole = tenMillimetreLattice();
    applyStroke(whole, stroke);
    stroke.vector *= 0.5;
    Lattice half = tenMillimetreLattice();
    applyStroke(half, stroke);
    for (std::size_t point = 0; point < whole.displacements.size(); ++point)
    {
      EXPECT_EQ(whole.displacements[point], 2.0f * half.displacements[point]);
    }
    EXPECT_GT(movedPoints(whole), 0);
  }
}

TEST(EveryTool, DoesNothingWhenDisabled)
{
  for (const Tool tool : AllTools)
  {
    Lattice lattice = tenMillimetreLattice();
    Stroke stroke = strokeAt(tool, { 30, 30, 30 }, { 6, -3, 5 });
    stroke.enabled = false;
    applyStroke(lattice, stroke);
    EXPECT_EQ(movedPoints(lattice), 0);
  }
}

TEST(Move, KeepsItsShapeOnADenserLattice)
{
  const glm::vec3 vector(4, -8, 16);
  Stroke stroke = strokeAt(Tool::Move, { 40, 40, 60 }, glm::dvec3(vector));
  stroke.axis = glm::dvec3(20.0); // made where control points were 20 mm apart
  stroke.major = 20.0;
  Lattice coarse = makeLattice(plainGrid(glm::ivec3(6), glm::dvec3(20.0)), KernelCatmullRom);
  Lattice dense = makeLattice(plainGrid(glm::ivec3(11), glm::dvec3(10.0)), KernelCatmullRom);
  applyStroke(coarse, stroke);
  applyStroke(dense, stroke);
  EXPECT_EQ(at(coarse, 2, 2, 3), vector);
  EXPECT_EQ(movedPoints(coarse), 1);
  EXPECT_EQ(at(dense, 4, 4, 6), vector);
  EXPECT_EQ(at(dense, 5, 4, 6), 0.5625f * vector) << "Catmull-Rom's 9/16 halfway";
  EXPECT_EQ(at(dense, 4, 7, 6), -0.0625f * vector) << "and -1/16 one and a half away";
  const PointMap coarseMap(coarse);
  const PointMap denseMap(dense);
  for (int point = 0; point < 11 * 11 * 11; ++point)
  {
    const glm::dvec3 rest = 10.0 * glm::dvec3(point % 11, point / 11 % 11, point / 121);
    EXPECT_LT(
      glm::distance(coarseMap.deformedFromRest(rest), denseMap.deformedFromRest(rest)), 1e-5);
  }
}

TEST(Move, MovesTissueTheSameOnADenserBSplineLattice)
{
  Stroke stroke = strokeAt(Tool::Move, { 40, 40, 60 }, { 4, -8, 16 });
  stroke.axis = glm::dvec3(20.0);
  stroke.major = 20.0;
  Lattice coarse = makeLattice(plainGrid(glm::ivec3(6), glm::dvec3(20.0)), KernelBSpline);
  Lattice dense = makeLattice(plainGrid(glm::ivec3(11), glm::dvec3(10.0)), KernelBSpline);
  applyStroke(coarse, stroke);
  applyStroke(dense, stroke);
  const PointMap coarseMap(coarse);
  const PointMap denseMap(dense);
  for (int point = 0; point < 21 * 21 * 21; ++point)
  {
    const glm::dvec3 rest = 5.0 * glm::dvec3(point % 21, point / 21 % 21, point / 441);
    EXPECT_LT(
      glm::distance(coarseMap.deformedFromRest(rest), denseMap.deformedFromRest(rest)), 1e-5);
  }
}

TEST(Lattice, OfOneTranslationTranslatesEverywhere)
{
  const glm::dvec3 shift(3.0, -5.0, 7.0);
  for (const int kernel : BothKernels)
  {
    const Grid grid = obliqueGrid({ 5, 7, 6 });
    const PointMap map(latticeOf(grid, kernel, [&](const glm::dvec3&) { return shift; }));
    Random random(1);
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 rest = random.point(grid, 4.0); // also far outside
      EXPECT_LT(glm::distance(map.deformedFromRest(rest), rest + shift), 1e-5);
      EXPECT_LT(glm::distance(map.restFromDeformed(rest + shift), rest), 1e-5);
    }
  }
}

TEST(Lattice, ReproducesLinearDisplacements)
{
  const glm::dmat3 gradient(0.02, -0.3, 0.1, 0.2, 0.05, -0.1, 0.3, 0.1, -0.2);
  for (const int kernel : BothKernels)
  {
    const Grid grid = obliqueGrid({ 7, 6, 8 });
    const auto displacement = [&](
                                const glm::dvec3& rest) { return gradient * (rest - grid.origin); };
    const PointMap map(latticeOf(grid, kernel, displacement));
    Random random(2);
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 rest = random.point(grid, -1.0); // all four taps exist
      EXPECT_LT(glm::distance(map.deformedFromRest(rest), rest + displacement(rest)), 1e-4);
    }
  }
}

TEST(Lattice, HoldsItsNearestValueOutside)
{
  const Grid grid = plainGrid({ 5, 4, 6 }, glm::dvec3(1.0));
  for (const int kernel : BothKernels)
  {
    const Lattice lattice = randomLattice(grid, kernel, 3, 1.0);
    const glm::vec3* values = lattice.displacements.data();
    Random random(4);
    for (int i = 0; i < 500; ++i)
    {
      const glm::dvec3 position = random.point(grid, 3.0);
      const glm::dvec3 nearest =
        glm::clamp(position, glm::dvec3(0.0), glm::dvec3(grid.dimensions - 1));
      EXPECT_EQ(cubicDisplacement(grid.dimensions, kernel, values, position),
        cubicDisplacement(grid.dimensions, kernel, values, nearest));
      const glm::mat3 gradient = cubicGradient(grid.dimensions, kernel, values, position);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_EQ(gradient[axis] == glm::vec3(0.0f), position[axis] != nearest[axis]);
      }
    }
  }
}

// Two roads to one cubic, within the lattice and outside.
TEST(Lattice, GivesValueAndGradientAtOnce)
{
  const Grid grid = plainGrid({ 5, 4, 6 }, glm::dvec3(1.0));
  for (const int kernel : BothKernels)
  {
    const Lattice lattice = randomLattice(grid, kernel, 5, 1.0);
    const glm::vec3* values = lattice.displacements.data();
    std::vector<glm::vec4> padded;
    padded.reserve(lattice.displacements.size());
    for (const glm::vec3& value : lattice.displacements)
    {
      padded.emplace_back(value, 1e30f);
    }
    Random random(6);
    for (int i = 0; i < 1000; ++i)
    {
      const glm::dvec3 position =
        i < 50 ? glm::round(random.point(grid, 0.0)) : random.point(grid, 1.5);
      const CubicValue both = cubicValue(grid.dimensions, kernel, padded.data(), position);
      EXPECT_LT(glm::distance(
                  both.displacement, cubicDisplacement(grid.dimensions, kernel, values, position)),
        1e-5f);
      const glm::mat3 gradient = cubicGradient(grid.dimensions, kernel, values, position);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_LT(glm::distance(both.gradient[axis], gradient[axis]), 2e-5f);
      }
    }
  }
}

TEST(Lattice, PassesThroughItsControlPointsWithCatmullRom)
{
  const Lattice lattice = randomLattice(obliqueGrid({ 5, 4, 6 }), KernelCatmullRom, 5, 1.0);
  const PointMap map(lattice);
  for (int point = 0; point < 5 * 4 * 6; ++point)
  {
    const glm::dvec3 rest =
      lattice.grid.worldFromGrid(glm::dvec3(point % 5, point / 5 % 4, point / 20));
    const glm::dvec3 expected = rest + glm::dvec3(lattice.displacements[point]);
    EXPECT_LT(glm::distance(map.deformedFromRest(rest), expected), 1e-4);
  }
}

TEST(MaximumDisplacement, IsTheLongestVector)
{
  Lattice lattice = tenMillimetreLattice();
  EXPECT_EQ(maximumDisplacement(lattice), 0.0);
  lattice.displacements[7] = { 2, -3, 6 };
  lattice.displacements[9] = { 0, 6, 0 };
  EXPECT_NEAR(maximumDisplacement(lattice), 7.0, 1e-6);
}

TEST(RequireDisplacements, NamesTheDisplacementAndItsLimit)
{
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(5), { 2.0, 3.0, 4.0 }), KernelCatmullRom);
  lattice.displacements[7] = { 0.0f, 20000.0f, 0.0f };
  requireDisplacements(lattice, "a test"); // throws nothing
  for (const float value : { 20001.0f, 1e12f, std::numeric_limits<float>::infinity(),
         std::numeric_limits<float>::quiet_NaN() })
  {
    lattice.displacements[7].y = -value;
    const std::string problem = problemOf([&] { requireDisplacements(lattice, "a test"); });
    EXPECT_NE(problem.find("displaced by a test by"), std::string::npos) << problem;
    EXPECT_NE(problem.find("at most 20000 mm"), std::string::npos) << problem;
  }
}

TEST(ApplyStroke, FarAwayMovesNoOtherPoint)
{
  // A spacing (mm) of long ago that no integer of cells holds, and an anchor as far.
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(5), glm::dvec3(0.01)), KernelCatmullRom);
  Stroke stroke = strokeAt(Tool::Move, glm::dvec3(1e9), { 1.0, 0.0, 0.0 });
  applyStroke(lattice, stroke);
  EXPECT_EQ(lattice.displacements[lattice.grid.offset(4, 4, 4)], glm::vec3(1.0f, 0.0f, 0.0f));
  EXPECT_EQ(
    std::count(lattice.displacements.begin(), lattice.displacements.end(), glm::vec3(0.0f)), 124);
  stroke.major = 1e9;
  applyStroke(lattice, stroke);
  for (const glm::vec3& displacement : lattice.displacements)
  {
    EXPECT_NEAR(displacement.x, 1.0f, 1.0f);
  }
}

TEST(ApplyStroke, AWideStampReachesItsMinorRadius)
{
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(13), glm::dvec3(10.0)), KernelCatmullRom);
  Stroke stroke = strokeAt(Tool::Stamp, glm::dvec3(60.0), { 0.0, 0.0, 4.0 });
  stroke.major = 15.0;
  stroke.minor = 45.0;
  applyStroke(lattice, stroke);
  for (int point = 0; point < 13 * 13 * 13; ++point)
  {
    const glm::dvec3 at = 10.0 * glm::dvec3(point % 13, point / 13 % 13, point / 169);
    const double weight = falloff(normalisedDistance(stroke, at), stroke.sigma);
    EXPECT_EQ(lattice.displacements[point], glm::vec3(weight * stroke.vector)) << point;
  }
  EXPECT_GT(at(lattice, 10, 6, 6).z, 0.01f) << "40 mm aside";
}
