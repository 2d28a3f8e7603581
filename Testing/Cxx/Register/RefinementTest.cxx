// SPDX-License-Identifier: BSD-3-Clause
// Proves that a refinement finds a known deformation, starts from the present one, never ends with
// more energy, and does not fold tissue.
#include "Filters/Register/Refinement.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// A volume, and a reference on another grid that shows it bent, with another contrast.
RegisteredPair pairBentBy(const Lattice& truth, double contrast)
{
  const Grid grid = smallGrid();
  Grid other = grid;
  other.dimensions += 4;
  other.origin = grid.worldFromGrid({ -1.7, -2.2, -1.6 });
  const PointMap map(truth);
  RegisteredPair pair;
  pair.rest = filled(grid, tissue);
  pair.reference = filled(other,
    [&](const glm::dvec3& at) { return 50.0 + contrast * tissue(map.restFromDeformed(at)); });
  return pair;
}

// Mean distance (mm) of two bends over the middle of the volume.
double apart(const Lattice& a, const Lattice& b)
{
  const Grid grid = smallGrid();
  const PointMap mapA(a);
  const PointMap mapB(b);
  double sum = 0.0;
  int count = 0;
  for (int k = 8; k < 30; k += 3)
  {
    for (int j = 8; j < 34; j += 3)
    {
      for (int i = 8; i < 32; i += 3, ++count)
      {
        const glm::dvec3 rest = grid.worldFromGrid({ i, j, k });
        sum += glm::distance(mapA.deformedFromRest(rest), mapB.deformedFromRest(rest));
      }
    }
  }
  return sum / count;
}

RefinementPlan planOf(const std::string& name)
{
  for (const Similarity& similarity : similarities())
  {
    if (name == similarity.name)
    {
      return similarity.plan;
    }
  }
  throw std::invalid_argument(name);
}

Lattice still()
{
  return makeLattice(withDimensions(smallGrid(), { 9, 9, 9 }), KernelCatmullRom);
}

// One step, and before it what prepares its level.
double takeStep(Refinement& refinement)
{
  const int taken = refinement.progress().steps;
  while (refinement.progress().steps == taken && !refinement.progress().isFinished)
  {
    refinement.step();
  }
  return refinement.progress().movedMm;
}

void run(Refinement& refinement)
{
  while (!refinement.progress().isFinished)
  {
    refinement.step();
  }
}
}

struct Case
{
  const char* similarity;
  double contrast;
  int kernel;
  int lastLevel; // that is worthwhile for voxels of 2 mm
};

class RefinementOf : public ::testing::TestWithParam<Case>
{
};

TEST_P(RefinementOf, FindsAKnownBend)
{
  const Lattice truth = bulge(smallGrid(), 5.0);
  Lattice start = still();
  start.kernel = GetParam().kernel;
  ASSERT_GT(apart(start, truth), 1.5);
  RefinementSettings settings;
  settings.plan = planOf(GetParam().similarity);
  Refinement refinement(pairBentBy(truth, GetParam().contrast), start, settings);
  run(refinement);
  EXPECT_LT(apart(refinement.lattice(), truth), 0.35);
  EXPECT_LT(refinement.progress().cost, 0.5 * refinement.progress().costAtStart);
  EXPECT_EQ(refinement.progress().level, GetParam().lastLevel);
  EXPECT_EQ(refinement.progress().stepFraction, 1.0);
  EXPECT_GT(refinement.progress().overlap, 0.85) << "samples at the border may lie beyond it";
}

// The local fit follows self-similarity, also where one contrast is no line of the other.
TEST(Refinement, TheLocalFitIsMoreExact)
{
  Grid fine = smallGrid(70);
  fine.spacing = glm::dvec3(1.2);
  const auto texture = [](const glm::dvec3& at) { return tissue(2.0 * at); };
  const Lattice truth = bulge(fine, 3.0);
  const PointMap map(truth);
  RegisteredPair pair;
  pair.rest = filled(fine, texture);
  pair.reference = filled(fine, [&](const glm::dvec3& at) {
    const double fromGrey = texture(map.restFromDeformed(at)) - 130.0;
    return 300.0 - 0.02 * fromGrey * fromGrey;
  });
  const Lattice start = makeLattice(withDimensions(fine, { 9, 9, 9 }), KernelCatmullRom);
  RefinementSettings settings;
  Refinement whole(pair, start, settings);
  settings.plan.levels.pop_back();
  Refinement without(pair, start, settings);
  run(whole);
  run(without);
  EXPECT_EQ(whole.progress().level, 2);
  EXPECT_LT(apart(whole.lattice(), truth), 0.8 * apart(without.lattice(), truth));
  EXPECT_EQ(whole.progress().overlap, without.progress().overlap)
    << "another similarity has a larger support";
}

TEST(Refinement, ALevelThatMightLeadAstrayIsLeftOut)
{
  RegisteredPair pair = pairBentBy(bulge(smallGrid(), 5.0), 1.0);
  RefinementSettings settings;
  const Metric* coarse = settings.plan.levels.front().metric;
  const Metric* fine = settings.plan.levels.back().metric;
  settings.plan.levels = { { coarse, 4.0 }, { fine, 2.0, 0.0 } };
  Refinement astray(pair, still(), settings);
  settings.plan.levels = { { coarse, 4.0 }, { fine, 4.0, 1.0 - 1e-6 } };
  Refinement notFiner(pair, still(), settings);
  settings.plan.levels.pop_back();
  Refinement one(pair, still(), settings);
  run(astray);
  run(notFiner);
  run(one);
  for (const Refinement* left : { &astray, &notFiner })
  {
    EXPECT_EQ(left->lattice().displacements, one.lattice().displacements);
    EXPECT_EQ(left->progress().steps, one.progress().steps);
    EXPECT_EQ(left->progress().level, 0);
    EXPECT_EQ(left->progress().cost, one.progress().cost);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, RefinementOf,
  ::testing::Values(Case{ "auto", 1.0, KernelCatmullRom, 2 },
    Case{ "auto", -1.0, KernelBSpline, 2 }, Case{ "same contrast", 1.0, KernelCatmullRom, 1 }));

TEST(Refinement, BeginsWithWhatTheHandMade)
{
  const Lattice truth = bulge(smallGrid(), 6.0);
  // On the truth's own lattice, so that the start can be perfect.
  Refinement refinement(pairBentBy(truth, 1.0), truth, {});
  run(refinement);
  EXPECT_LT(apart(refinement.lattice(), truth), 0.15);
}

TEST(Refinement, OneCallIsOneStepOnceItIsPrepared)
{
  const Lattice truth = bulge(smallGrid(), 5.0);
  Refinement refinement(pairBentBy(truth, 1.0), still(), {});
  EXPECT_EQ(refinement.progress().steps, 0);
  EXPECT_EQ(refinement.lattice().displacements, still().displacements);
  const double moved = takeStep(refinement);
  EXPECT_EQ(refinement.progress().steps, 1);
  EXPECT_GT(moved, 0.1);
  EXPECT_LE(moved, 1.5 * 4.0 + 1e-3) << "1.5 points of 4 mm";
  float longest = 0.0f;
  for (const glm::vec3& d : refinement.lattice().displacements)
  {
    longest = std::max(longest, glm::length(d));
  }
  EXPECT_NEAR(longest, moved, 1e-3);
  double before = refinement.progress().cost;
  refinement.step();
  EXPECT_EQ(refinement.progress().steps, 2);
  EXPECT_LT(refinement.progress().cost, before);
}

TEST(Refinement, StaysWithinItsSteps)
{
  RefinementSettings settings;
  settings.mostSteps = 2;
  Refinement refinement(pairBentBy(bulge(smallGrid(), 5.0), 1.0), still(), settings);
  run(refinement);
  EXPECT_EQ(refinement.progress().steps, 6) << "2 on each of three levels";
  const Lattice before = refinement.lattice();
  refinement.step();
  EXPECT_EQ(refinement.progress().steps, 6);
  EXPECT_EQ(refinement.lattice().displacements, before.displacements);
}

TEST(Refinement, AStifferVolumeBendsLess)
{
  const Lattice truth = bulge(smallGrid(), 5.0);
  double last = 1e9;
  for (const double stiffness : { 0.1, 10.0, 1000.0 })
  {
    RefinementSettings settings;
    settings.stiffness = stiffness;
    Refinement refinement(pairBentBy(truth, 1.0), still(), settings);
    run(refinement);
    const double bend = maximumDisplacement(refinement.lattice());
    EXPECT_LT(bend, last);
    last = bend;
  }
  EXPECT_LT(last, 1.0);
}

// The reference shows other tissue, so that a soft volume is torn about.
TEST(Refinement, DoesNotFold)
{
  RegisteredPair pair = pairBentBy(still(), 1.0);
  pair.reference = filled(pair.reference.grid,
    [](const glm::dvec3& at) { return tissue(1.4 * glm::dvec3(at.z, at.x, at.y) - 7.0); });
  RefinementSettings settings;
  settings.stiffness = 0.001;
  Lattice dense = makeLattice(withDimensions(smallGrid(), { 15, 15, 15 }), KernelCatmullRom);
  settings.guards = false;
  Refinement free(pair, dense, settings);
  run(free);
  ASSERT_LT(minimumJacobian(free.lattice()), 0.0);
  settings.guards = true;
  Refinement guarded(pair, dense, settings);
  run(guarded);
  EXPECT_GE(minimumJacobian(guarded.lattice()), 0.099);
  EXPECT_LT(guarded.progress().stepFraction, 1.0);
}

// A cavity that holds nothing pulls tissue that is not there towards it, unless it is masked.
TEST(Refinement, ACavityIsIgnored)
{
  const Lattice truth = bulge(smallGrid(), 4.0);
  RegisteredPair pair = pairBentBy(truth, 1.0);
  const Grid& grid = pair.reference.grid;
  const glm::dvec3 centre = middle(grid) + 8.0;
  const Mask removed = ball(grid, centre, 9.0);
  for (std::size_t i = 0; i < removed.inside.size(); ++i)
  {
    pair.reference.values[i] = removed.inside[i] ? 0.0f : pair.reference.values[i];
  }
  RefinementSettings settings;
  settings.plan = planOf("same contrast");
  Refinement misled(pair, still(), settings);
  pair.cavity = ball(grid, centre, 11.0);
  Refinement masked(pair, still(), settings);
  run(misled);
  run(masked);
  EXPECT_LT(apart(masked.lattice(), truth), 0.45);
  EXPECT_LT(apart(masked.lattice(), truth), 0.8 * apart(misled.lattice(), truth));
  EXPECT_LT(masked.progress().overlap, misled.progress().overlap);
}

TEST(Refinement, AMaskHoldsWhatLiesOutside)
{
  const Lattice truth = bulge(smallGrid(), 3.0);
  Lattice start = still();
  const Mask inside = ball(smallGrid(), middle(smallGrid()), 32.0);
  start.mask = maskWeights(start.grid, 4, inside, 14.0);
  Refinement refinement(pairBentBy(truth, 1.0), start, {});
  run(refinement);
  const PointMap map(refinement.lattice());
  const glm::dvec3 corner = smallGrid().worldFromGrid({ 3, 3, 3 });
  EXPECT_EQ(map.deformedFromRest(corner), corner);
  const glm::dvec3 centre = middle(smallGrid());
  EXPECT_LT(
    glm::distance(map.deformedFromRest(centre), PointMap(truth).deformedFromRest(centre)), 0.7);
}

// The caller refuses it.
TEST(Refinement, AValueThatOverflowsMovesNothingAndIsSeenInTheCost)
{
  RegisteredPair pair = pairBentBy(bulge(smallGrid(), 5.0), 1.0);
  pair.reference.values[pair.reference.values.size() / 2] = 1e37f;
  Refinement refinement(pair, still(), {});
  run(refinement);
  EXPECT_FALSE(std::isfinite(refinement.progress().cost));
  EXPECT_EQ(refinement.lattice().displacements, still().displacements);
}

TEST(Refinement, MemoryGrowsWithTheFinestLevel)
{
  Grid grid = smallGrid(200);
  grid.spacing = glm::dvec3(1.0);
  const Lattice lattice = still();
  RefinementSettings settings;
  const double coarse = Refinement::bytes(grid, grid, lattice.grid, settings);
  settings.plan.levels = { { settings.plan.levels.front().metric, 1.0 } };
  EXPECT_GT(Refinement::bytes(grid, grid, lattice.grid, settings), coarse);
  EXPECT_GT(coarse, 2.0 * sizeof(float) * grid.count());
}
