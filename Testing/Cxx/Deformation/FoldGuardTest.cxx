// SPDX-License-Identifier: BSD-3-Clause
// Proves that no stroke folds tissue while the guard is on, in the map of the control points and in
// the field that is drawn, within the lattice and beyond it; that it shortens no more than it has
// to; and that it leaves alone what folds without any stroke.
#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/OffsetField.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Deformation/Replay.h"
#include "Testing/Cxx/Deformation/TestLattices.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Limit = 0.1;
constexpr double Rounding = 5e-5; // of determinants in single precision
constexpr int Samples = 4;

// Smallest determinant of deformedFromRest, on `perCell` samples a cell and a cell beyond the box.
double smallestOfCubic(const Lattice& lattice, int perCell)
{
  const std::vector<glm::vec3> inCells = displacementsInCells(lattice);
  const glm::ivec3& dimensions = lattice.grid.dimensions;
  const glm::ivec3 count = (dimensions + 1) * perCell;
  double smallest = 1.0;
  for (int k = 0; k <= count.z; ++k)
  {
    for (int j = 0; j <= count.y; ++j)
    {
      for (int i = 0; i <= count.x; ++i)
      {
        const glm::dvec3 position = glm::dvec3(i, j, k) / double(perCell) - 1.0;
        const glm::mat3 jacobian =
          glm::mat3(1.0f) + cubicGradient(dimensions, lattice.kernel, inCells.data(), position);
        smallest = std::min(smallest, double(glm::determinant(jacobian)));
      }
    }
  }
  return smallest;
}

// The same for the field that is drawn, at the middle and the ends of its own cells, where its
// slopes jump.
double smallestOfDrawn(const Lattice& lattice)
{
  const NodeField field =
    refine(lattice.grid, lattice.kernel, displacementsInCells(lattice), Samples);
  const glm::ivec3 cells = (lattice.grid.dimensions + 1) * (Samples + 1);
  const float within[3] = { 1e-4f, 0.5f, 1.0f - 1e-4f };
  double smallest = 1.0;
  for (int k = 0; k < 3 * cells.z; ++k)
  {
    for (int j = 0; j < 3 * cells.y; ++j)
    {
      for (int i = 0; i < 3 * cells.x; ++i)
      {
        const glm::vec3 node = glm::vec3(glm::ivec3(i, j, k) / 3) +
          glm::vec3(within[i % 3], within[j % 3], within[k % 3]);
        glm::vec3 displacement;
        glm::mat3 jacobian;
        field.map(node / float(Samples + 1) - 1.0f, displacement, jacobian);
        smallest = std::min(smallest, double(glm::determinant(jacobian)));
      }
    }
  }
  return smallest;
}

// A stroke of any tool anywhere, up to half the box long: most would fold tissue.
Stroke anyStroke(Random& random, const Grid& grid)
{
  const auto tool = static_cast<Tool>(int(random.between(0.0, 3.0)));
  const double longest = 0.5 * grid.spacing.x * grid.dimensions.x;
  const glm::dvec3 vector =
    random.between(0.0, 1.0) * random.between(glm::dvec3(-longest), glm::dvec3(longest));
  Stroke stroke = strokeAt(tool, random.point(grid, 0.5), vector);
  stroke.major = tool == Tool::Move ? 0.0 : random.between(1.0, 5.0) * grid.spacing.x;
  stroke.minor = random.between(1.0, 4.0) * grid.spacing.x;
  stroke.sigma = random.between(0.3, 1.0);
  return stroke;
}

std::vector<Stroke> anyStrokes(unsigned int seed, const Grid& grid, int count)
{
  Random random(seed);
  std::vector<Stroke> strokes;
  strokes.reserve(count);
  for (int i = 0; i < count; ++i)
  {
    strokes.push_back(anyStroke(random, grid));
  }
  return strokes;
}

Lattice base(int kernel)
{
  return makeLattice(obliqueGrid({ 7, 8, 6 }), kernel);
}

// Kernel and seed: 500 strokes a kernel, in runs of 25 that overlap each other.
class AnyStrokes : public ::testing::TestWithParam<std::tuple<int, int>>
{
protected:
  Lattice Base = base(std::get<0>(GetParam()));
  std::vector<Stroke> Strokes = anyStrokes(std::get<1>(GetParam()), Base.grid, 25);
};
}

TEST_P(AnyStrokes, NeverFoldWithTheGuard)
{
  Replay replay;
  for (std::size_t count = 1; count <= this->Strokes.size(); ++count)
  {
    const Lattice& bent = replay.run(
      this->Base, { this->Strokes.begin(), this->Strokes.begin() + count }, { true, Samples });
    if (count % 5 == 0)
    {
      EXPECT_GT(smallestOfCubic(bent, 4), Limit - Rounding) << count << " strokes";
    }
  }
  const Lattice& bent = replay.run(this->Base, this->Strokes, { true, Samples });
  EXPECT_GT(smallestOfDrawn(bent), Limit - Rounding);
  EXPECT_GT(maximumDisplacement(bent), 1.0);
}

TEST_P(AnyStrokes, FoldWithoutTheGuard)
{
  Replay replay;
  EXPECT_LT(smallestOfCubic(replay.run(this->Base, this->Strokes), 2), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Runs, AnyStrokes,
  ::testing::Combine(
    ::testing::Values(KernelCatmullRom, KernelBSpline), ::testing::Range(100, 120)));

TEST(FoldGuard, ShortensToTheLimitAndNoFurther)
{
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    for (const Tool tool : { Tool::Move, Tool::Soft, Tool::Stamp })
    {
      const Lattice start = base(kernel);
      const glm::dvec3 middle = start.grid.worldFromGrid({ 3.2, 3.6, 2.7 });
      Lattice whole = start;
      applyStroke(whole, strokeAt(tool, middle, { 50.0, -35.0, 40.0 }));
      FoldGuard guard;
      guard.setBase(start, Samples);
      const double share = guard.fraction(start, whole);
      EXPECT_GT(share, 0.05);
      EXPECT_LT(share, 0.95);
      const auto smallest = [&](double part) {
        const Lattice bent = between(start, whole, part);
        return std::min(smallestOfCubic(bent, 10), smallestOfDrawn(bent));
      };
      EXPECT_GT(smallest(share), Limit - Rounding);
      EXPECT_LT(smallest(1.01 * share), Limit + 1e-3) << "tool " << int(tool);
    }
  }
}

TEST(FoldGuard, LetsBeWhatDoesNotFold)
{
  Replay replay;
  const Lattice start = base(KernelCatmullRom);
  const glm::dvec3 middle = start.grid.worldFromGrid({ 3, 4, 3 });
  std::vector<Stroke> strokes{ strokeAt(Tool::Soft, middle, { 6, -4, 3 }),
    strokeAt(Tool::Stamp, middle, { 2, 4, -3 }), strokeAt(Tool::Move, middle, { 1, 1, 2 }) };
  strokes[1].enabled = false;
  const std::vector<glm::vec3> guarded =
    replay.run(start, strokes, { true, Samples }).displacements;
  EXPECT_EQ(replay.fractions(), std::vector<double>(3, 1.0));
  EXPECT_EQ(guarded, Replay().run(start, strokes).displacements);
}

TEST(FoldGuard, ShortensOneStrokeAtATime)
{
  const Lattice start = base(KernelCatmullRom);
  std::vector<Stroke> strokes = anyStrokes(7, start.grid, 6);
  Replay running;
  running.run(start, strokes, { true, Samples });
  for (const double part : { 0.3, 1.7 })
  {
    strokes.back().vector *= part;
    const std::vector<glm::vec3> bent =
      running.run(start, strokes, { true, Samples }).displacements;
    EXPECT_EQ(running.applied(), 1);
    Replay fresh;
    EXPECT_EQ(bent, fresh.run(start, strokes, { true, Samples }).displacements);
    EXPECT_EQ(running.fractions(), fresh.fractions());
    EXPECT_EQ(running.fractions().size(), strokes.size());
  }
  EXPECT_LT(*std::min_element(running.fractions().begin(), running.fractions().end()), 1.0);
  running.run(start, strokes);
  EXPECT_EQ(running.fractions(), std::vector<double>(6, 1.0)) << "the guard is off";
}

TEST(FoldGuard, GoesOnFromTheLimit)
{
  // A stroke to the limit, then others across it: back, and away from it.
  const Lattice start = base(KernelBSpline);
  const glm::dvec3 middle = start.grid.worldFromGrid({ 3, 4, 3 });
  const Stroke there = strokeAt(Tool::Soft, middle, { 90, 0, 0 });
  Stroke back = there;
  back.vector = { -5, 0, 0 };
  Replay replay;
  replay.run(start, { there, back }, { true, Samples });
  EXPECT_LT(replay.fractions()[0], 1.0);
  EXPECT_EQ(replay.fractions()[1], 1.0);
  replay.run(start, { there, there }, { true, Samples });
  EXPECT_LT(replay.fractions()[1], 0.3);
}

TEST(FoldGuard, AppliesNothingOfWhatGoesBeyondAllNumbers)
{
  const Lattice start = base(KernelCatmullRom);
  Stroke stroke = strokeAt(Tool::Soft, start.grid.worldFromGrid({ 3, 4, 3 }), { 1e300, 0, 0 });
  Replay replay;
  EXPECT_EQ(replay.run(start, { stroke }, { true, Samples }).displacements, start.displacements);
  EXPECT_EQ(replay.fractions(), std::vector<double>{ 0.0 });
}

TEST(FoldGuard, LeavesAloneWhatFoldsByItself)
{
  Lattice folded = base(KernelCatmullRom);
  folded.displacements[folded.grid.offset(1, 1, 1)] = { 30.0f, 0.0f, 0.0f };
  FoldGuard guard;
  guard.setBase(folded, Samples);
  EXPECT_GT(guard.foldedCells(), 0);
  EXPECT_LT(guard.foldedCells(), 64);
  const auto shareOf = [&](const glm::dvec3& anchor, const glm::dvec3& vector) {
    Lattice after = folded;
    applyStroke(after, strokeAt(Tool::Move, folded.grid.worldFromGrid(anchor), vector));
    return guard.fraction(folded, after);
  };
  EXPECT_EQ(shareOf({ 1, 1, 1 }, { 2, 0, 0 }), 1.0) << "else nothing could touch it";
  EXPECT_LT(shareOf({ 5, 6, 4 }, { 40, 0, 0 }), 0.9) << "elsewhere the guard is on";
  guard.setBase(base(KernelCatmullRom), Samples);
  EXPECT_EQ(guard.foldedCells(), 0);
}

TEST(FoldGuard, AsksAllCellsAgainAtASmallerShare)
{
  // Displacements -k(r) (p - middle) across z, with k from 3 in the middle to 2.07 at 6 cells and
  // to 0 at 9. Wholly applied, the middle is turned by half a circle and does not fold; at a third
  // it shrinks to nothing. The ring around it folds unless only a third is applied.
  const Grid grid = plainGrid({ 23, 23, 4 }, glm::dvec3(10.0));
  const glm::dvec3 middle(110.0, 110.0, 0.0);
  const Lattice before = makeLattice(grid, KernelBSpline);
  const Lattice after = latticeOf(grid, KernelBSpline, [&](const glm::dvec3& rest) {
    const glm::dvec3 aside(rest.x - middle.x, rest.y - middle.y, 0.0);
    const double r = glm::length(aside) / 60.0;
    const double factor =
      r < 1.0 ? 3.0 - 0.93 * r * r * r * r : 2.07 * std::max(0.0, 3.0 - 2.0 * r);
    return -factor * aside;
  });
  FoldGuard guard;
  guard.setBase(before, Samples);
  const double share = guard.fraction(before, after);
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 0.3);
  EXPECT_GT(smallestOfCubic(between(before, after, share), 4), Limit - Rounding);
}
