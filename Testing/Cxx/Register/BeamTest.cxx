// SPDX-License-Identifier: BSD-3-Clause
// Proves that the direction of an ultrasound beam is found where the volume tells it, and that
// what counts then is how edges and echoes rise along it.
#include "Filters/Register/PyramidLevel.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
Grid fineGrid(const glm::ivec3& sides)
{
  Grid grid;
  grid.dimensions = sides;
  grid.direction = smallGrid().direction;
  return grid;
}

constexpr double EdgeMm = 10.0; // z, on the grid's axis
constexpr double InMm = 9.0;    // where a dark sheet begins, and where it ends
constexpr double OutMm = 21.0;

// An edge of the volume, and its echo, which goes on behind it.
LevelVolumes edgeWithEcho()
{
  const Grid grid = fineGrid({ 12, 12, 24 });
  LevelVolumes volumes;
  volumes.rest = filled(
    grid, [](const glm::dvec3& at) { return 100.0 + 40.0 * std::tanh(0.8 * (at.z - EdgeMm)); });
  volumes.reference = filled(grid, [](const glm::dvec3& at) {
    const double behind = at.z - EdgeMm;
    return 100.0 * std::exp(behind < 0.0 ? -behind * behind : -behind / 3.0);
  });
  volumes.restWeights = weightsOf(grid, {}, {});
  volumes.referenceWeights = volumes.restWeights;
  return volumes;
}

// Bright tissue with a dark sheet, as a sulcus: the beam meets an edge into it and one out of it.
LevelVolumes darkSheet(double factor, double offset)
{
  const Grid grid = fineGrid({ 12, 12, 32 });
  LevelVolumes volumes;
  volumes.rest = filled(grid, [&](const glm::dvec3& at) {
    const double into = std::tanh(0.8 * (at.z - InMm));
    const double outOf = std::tanh(0.8 * (at.z - OutMm));
    return offset + factor * (1.0 - 0.5 * (into - outOf));
  });
  volumes.restWeights = weightsOf(grid, {}, {});
  volumes.beam = { 0.0, 0.0, 1.0 };
  return volumes;
}

// The middle of what rises between two depths, mm.
double middleOf(const std::vector<float>& rise, const Grid& grid, double fromMm, double toMm)
{
  double sum = 0.0;
  double moment = 0.0;
  for (int k = static_cast<int>(fromMm); k < static_cast<int>(toMm); ++k)
  {
    sum += rise[grid.offset(5, 6, k)];
    moment += k * rise[grid.offset(5, 6, k)];
  }
  return moment / sum;
}

RefinementPlan byUltrasound()
{
  const auto isUltrasound = [](const Similarity& one) { return one.plan.fan.has_value(); };
  return std::find_if(similarities().begin(), similarities().end(), isUltrasound)->plan;
}

double costWith(const glm::dvec3& beam)
{
  LevelVolumes volumes = edgeWithEcho();
  volumes.beam = beam;
  const Lattice lattice = makeLattice(withDimensions(volumes.rest.grid, { 5, 5, 5 }), 0);
  const auto compared = byUltrasound().levels.back().metric->make(volumes, lattice);
  while (!compared->prepare())
  {
  }
  return compared->compare(Controls(lattice.grid.count(), glm::vec3(0.0f))).cost;
}

// A head of 60 mm, and a fan at a distance above its middle.
glm::dvec3 beamOf(double aboveMm)
{
  Grid head = fineGrid({ 45, 45, 45 });
  head.spacing = glm::dvec3(3.0);
  RegisteredPair pair;
  pair.rest = filled(
    head, [&](const glm::dvec3& at) { return glm::length(at - middle(head)) < 60.0 ? 90.0 : 0.0; });
  Grid around = fineGrid({ 40, 40, 40 });
  around.origin += middle(head) + glm::dvec3(0, 0, aboveMm) - middle(around);
  pair.reference = filled(around,
    [&](const glm::dvec3& at) { return glm::length(at - middle(around)) < 16.0 ? 50.0 : 0.0; });
  ComparedRegion region(pair, byUltrasound());
  region.find(pair, head);
  return region.beam();
}
}

TEST(Beam, LooksInwards)
{
  const glm::dvec3 beam = beamOf(35.0);
  EXPECT_NEAR(glm::length(beam), 1.0, 1e-9);
  EXPECT_LT(beam.z, -0.99);
}

TEST(Beam, IsNotKnownNearTheMiddle)
{
  EXPECT_EQ(beamOf(10.0), glm::dvec3(0.0));
}

TEST(Beam, WhatFallsBehindAnEdgeDoesNotCount)
{
  LevelVolumes volumes = edgeWithEcho();
  volumes.beam = { 0.0, 0.0, 1.0 };
  const std::vector<float> echo = volumes.echoRise();
  const std::vector<float> edge = volumes.edgeRise();
  const auto at = [&](int k) { return volumes.rest.grid.offset(5, 6, k); };
  const int before = static_cast<int>(EdgeMm) - 1;
  EXPECT_GT(echo[at(before)], 10.0f);
  EXPECT_GT(edge[at(before)], 5.0f);
  for (int k = before + 2; k < volumes.rest.grid.dimensions.z; ++k)
  {
    EXPECT_EQ(echo[at(k)], 0.0f) << k;
    EXPECT_EQ(edge[at(k)], 0.0f) << k;
  }
}

TEST(Beam, TellsTheBrightSideOfAnEdgeFromItsDarkOne)
{
  // How much deeper edges are that count by their value: into the dark sheet, and out of it.
  const auto deeper = [](double factor, double offset) {
    const LevelVolumes volumes = darkSheet(factor, offset);
    const Grid& grid = volumes.rest.grid;
    const double middle = (InMm + OutMm) / 2.0;
    const std::vector<float> edge = volumes.edgeRise();
    const std::vector<float> bright = volumes.brightEdgeRise();
    return glm::dvec2(middleOf(bright, grid, 2.0, middle) - middleOf(edge, grid, 2.0, middle),
      middleOf(bright, grid, middle, 30.0) - middleOf(edge, grid, middle, 30.0));
  };
  const glm::dvec2 found = deeper(1.0, 0.0);
  EXPECT_LT(found.x, -0.1);
  EXPECT_GT(found.y, 0.1);
  // The scale of the values does not matter.
  EXPECT_NEAR(glm::distance(deeper(300.0, -150.0), found), 0.0, 0.01);
}

TEST(Beam, ChangesWhatUltrasoundCompares)
{
  const double unknown = costWith(glm::dvec3(0.0));
  EXPECT_GT(std::abs(costWith({ 0.0, 0.0, 1.0 }) - unknown), 0.01);
}
