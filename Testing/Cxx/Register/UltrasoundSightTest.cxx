// SPDX-License-Identifier: BSD-3-Clause
// Proves that a volume that moves rigidly by ultrasound keeps tissue in the sweep: the mean
// cost would fall where tissue that does not match leaves. And what a cavity in the sweep holds
// does not count.
#include "Filters/Deformation/PointMap.h"
#include "Filters/Register/Refinement.h"
#include "Filters/Register/Similarity.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double SeenMm = 16.0; // of the volume, from its border
constexpr double LeastInSight = 0.75;

Grid restGrid()
{
  Grid grid;
  grid.dimensions = { 32, 28, 26 };
  grid.spacing = glm::dvec3(2.0);
  return grid;
}

double folds(const glm::dvec3& at)
{
  return tissue(1.8 * at);
}

// The sweep shows the tissue of the border `shiftMm` deeper, so that much of it leaves the sweep
// where it agrees.
RegisteredPair pairShiftedBy(double shiftMm)
{
  RegisteredPair pair;
  pair.rest = filled(restGrid(), folds);
  Grid grid = restGrid();
  grid.dimensions.x = 24;
  grid.spacing.x = 1.0;
  grid.origin.x = SeenMm - grid.spacing.x * (grid.dimensions.x - 1);
  pair.reference =
    filled(grid, [shiftMm](const glm::dvec3& at) { return folds(at - glm::dvec3(shiftMm, 0, 0)); });
  return pair;
}

struct Found
{
  double shiftMm = 0.0; // of the tissue in the sweep
  double inSight = 0.0; // fraction of the samples at the start
};

RefinementSettings rigidSettings()
{
  RefinementSettings settings;
  const auto isUltrasound = [](const Similarity& one) { return one.plan.fan.has_value(); };
  settings.plan = std::find_if(similarities().begin(), similarities().end(), isUltrasound)->plan;
  settings.plan.levels.resize(1); // rigid
  return settings;
}

Found foundFor(const RegisteredPair& pair)
{
  const RefinementSettings settings = rigidSettings();
  const Lattice start = makeLattice(withDimensions(restGrid(), { 8, 8, 8 }), KernelCatmullRom);
  Refinement refinement(pair, start, settings);
  double atStart = 0.0;
  while (!refinement.progress().isFinished)
  {
    refinement.step();
    atStart = atStart == 0.0 ? refinement.progress().overlap : atStart;
  }
  const glm::dvec3 from(0.5 * SeenMm, 28.0, 26.0);
  return { PointMap(refinement.lattice()).deformedFromRest(from).x - from.x,
    refinement.progress().overlap / atStart };
}
}

TEST(UltrasoundSight, AShiftThatKeepsTissueInTheSweepIsFound)
{
  for (const double shiftMm : { 2.0, 4.5 })
  {
    const Found found = foundFor(pairShiftedBy(shiftMm));
    EXPECT_NEAR(found.shiftMm, shiftMm, 0.3);
    EXPECT_LT(found.inSight, 0.95);
    EXPECT_GE(found.inSight, LeastInSight);
  }
}

TEST(UltrasoundSight, TissueStaysInTheSweep)
{
  const Found found = foundFor(pairShiftedBy(6.0)); // a third would leave
  EXPECT_GT(found.shiftMm, 3.0);
  EXPECT_GE(found.inSight, LeastInSight);
}

TEST(UltrasoundSight, WhatACavityHoldsDoesNotCount)
{
  RegisteredPair pair = pairShiftedBy(2.0);
  pair.cavity = ball(pair.reference.grid, middle(pair.reference.grid), 7.0);
  const Found found = foundFor(pair);
  for (std::size_t i = 0; i < pair.cavity.inside.size(); ++i)
  {
    float& value = pair.reference.values[i];
    value = pair.cavity.inside[i] ? 110.0f : value;
  }
  EXPECT_EQ(foundFor(pair).shiftMm, found.shiftMm);
}
