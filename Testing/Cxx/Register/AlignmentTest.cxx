// SPDX-License-Identifier: BSD-3-Clause
// Proves that mutual information follows its definition, and that the search finds a known motion
// for any contrast, deformation and cavity.
#include "Filters/Register/Alignment.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Degree = 0.017453292519943295;

// A head: one bright side, so that every rotation looks different.
double head(const glm::dvec3& at)
{
  const glm::dvec3 away = at - middle(smallGrid());
  const bool isInside = glm::length(away / glm::dvec3(30.0, 34.0, 28.0)) < 1.0;
  return isInside ? tissue(at) : 0.0;
}

// The reference shows the head inverted, in another position: `there` is the motion to it.
RegisteredPair pairMovedBy(const RigidPose& there)
{
  Grid grid = smallGrid(44);
  grid.spacing *= 0.93;
  RegisteredPair pair;
  pair.rest = filled(smallGrid(), head);
  pair.reference = filled(grid, [&](const glm::dvec3& at) { return 200.0 - head(at); });
  pair.reference.grid.origin = there.apply(grid.origin);
  pair.reference.grid.direction = there.rotation * grid.direction;
  return pair;
}

RigidPose awayBy(double shiftMm, double rotationDegrees)
{
  return turnedAround(middle(smallGrid()),
    rotationFrom(rotationDegrees * Degree * glm::normalize(glm::dvec3(0.4, -0.8, 0.5))),
    shiftMm * glm::normalize(glm::dvec3(-0.7, 0.3, 0.6)));
}

void run(Alignment& alignment)
{
  while (!alignment.progress().isFinished)
  {
    alignment.step();
  }
}

// How far (mm) two motions put a corner of the head apart.
double apart(const RigidPose& a, const RigidPose& b)
{
  const glm::dvec3 corner = middle(smallGrid()) + glm::dvec3(20.0, 20.0, 15.0);
  return glm::distance(a.apply(b.apply(corner)), corner);
}
}

TEST(JointHistogram, KnowsWhatPairsSayAboutEachOther)
{
  JointHistogram same;
  JointHistogram opposite;
  JointHistogram unrelated;
  EXPECT_EQ(same.information(), 0.0);
  for (int i = 0; i < 32; ++i)
  {
    const float a = static_cast<float>(i) / 31.0f;
    same.add(a, a);
    opposite.add(a, 1.0f - a);
    for (int j = 0; j < 32; ++j)
    {
      unrelated.add(a, static_cast<float>(j) / 31.0f);
    }
  }
  EXPECT_NEAR(same.information(), std::log(32.0), 1e-4);
  EXPECT_NEAR(opposite.information(), std::log(32.0), 1e-4);
  EXPECT_NEAR(unrelated.information(), 0.0, 1e-4);
  EXPECT_EQ(unrelated.count(), 1024.0);
  same.add(opposite);
  EXPECT_LT(same.information(), std::log(32.0) - 0.1);
}

TEST(LineSearch, FindsTheLowestPlace)
{
  for (const double position : { -37.0, -0.3, 0.0, 0.4, 12.0 })
  {
    int calls = 0;
    const auto valley = [&](double at) {
      ++calls;
      return std::abs(at - position) < 50.0 ? std::pow(std::abs(at - position), 1.5) : 1e3;
    };
    const LinePoint found = lowestAlong(valley, valley(0.0), 2.0, 0.01);
    EXPECT_NEAR(found.at, position, 0.011);
    EXPECT_LT(calls, 45);
  }
  const LinePoint stays = lowestAlong([](double at) { return at * at; }, -1.0, 2.0, 0.01);
  EXPECT_EQ(stays.at, 0.0) << "never above the value at 0";
}

TEST(Alignment, FindsAKnownMotion)
{
  const RigidPose there = awayBy(9.0, 11.0);
  Alignment alignment(pairMovedBy(there), nullptr);
  ASSERT_GT(apart(alignment.motion(), there), 5.0);
  run(alignment);
  EXPECT_LT(apart(alignment.motion(), there), 0.3);
  EXPECT_NEAR(alignment.rotationDegrees(), 11.0, 0.5);
  const AlignmentProgress& progress = alignment.progress();
  EXPECT_GT(progress.information, 1.5 * progress.informationAtStart);
  EXPECT_EQ(progress.level, 2);
  EXPECT_GT(progress.overlap, 0.8);
}

TEST(Alignment, OneCallIsOneLine)
{
  Alignment alignment(pairMovedBy(awayBy(6.0, 4.0)), nullptr);
  EXPECT_EQ(alignment.motion().translation, glm::dvec3(0.0));
  const double first = alignment.step().information;
  EXPECT_EQ(alignment.progress().steps, 1);
  EXPECT_GE(first, alignment.progress().informationAtStart);
  EXPECT_GE(alignment.step().information, first - 1e-9);
  EXPECT_FALSE(alignment.progress().isFinished);
}

TEST(Alignment, AFinerLevelBeginsWhereTheCoarserEnded)
{
  const RigidPose there = awayBy(9.0, 11.0);
  Alignment alignment(pairMovedBy(there), nullptr);
  ASSERT_GT(apart({}, there), 5.0);
  while (alignment.progress().level == 0)
  {
    alignment.step();
  }
  EXPECT_LT(apart(alignment.motion(), there), 2.0);
  alignment.step();
  EXPECT_EQ(alignment.progress().level, 1);
  EXPECT_LT(apart(alignment.motion(), there), 2.0);
}

// A caller may stop at any step. What it gets is never worse than the start, and its figures belong
// to it, also while another of several positions is searched.
TEST(Alignment, SeveralStartsKeepTheBestAtEachStep)
{
  const RegisteredPair pair = pairMovedBy(awayBy(4.0, 5.0));
  AlignmentSettings settings;
  settings.levelsMm = { 8.0 };
  settings.mostRounds = 1;
  settings.starts = 4;
  Alignment alignment(pair, nullptr, settings);
  double last = Alignment(pair, nullptr, settings).information();
  while (!alignment.progress().isFinished)
  {
    const double reported = alignment.step().information;
    Alignment again(pair, nullptr, settings);
    const RigidPose motion = alignment.motion();
    again.moveReference(motion.rotation, motion.translation);
    EXPECT_NEAR(again.information(), reported, 1e-6) << alignment.progress().steps;
    EXPECT_GE(reported, last - 1e-9) << alignment.progress().steps;
    last = reported;
  }
  EXPECT_GT(alignment.progress().steps, 20) << "of more than one start";
}

// The volume is compared as it is bent: unbent, the same search ends elsewhere.
TEST(Alignment, ComparesTheVolumeAsItIsBent)
{
  Lattice bent = makeLattice(withDimensions(smallGrid(), { 6, 6, 6 }), KernelCatmullRom);
  for (glm::vec3& displacement : bent.displacements)
  {
    displacement = { 4.0f, 0.0f, -3.0f };
  }
  const RigidPose there = awayBy(4.0, 3.0);
  RegisteredPair pair = pairMovedBy(there);
  Alignment alignment(pair, &bent);
  run(alignment);
  RigidPose expected = there;
  expected.translation -= there.rotation * glm::dvec3(4.0, 0.0, -3.0);
  EXPECT_LT(apart(alignment.motion(), expected), 0.3);
}

// What the cavity holds makes no difference, and without its mask it does.
TEST(Alignment, ACavityDoesNotCount)
{
  const RigidPose there = awayBy(5.0, 6.0);
  const glm::dvec3 centre = there.apply(middle(smallGrid()) + glm::dvec3(12.0, 10.0, 0.0));
  double withCavity[2];
  double withoutCavity[2];
  for (const int content : { 0, 1 })
  {
    RegisteredPair pair = pairMovedBy(there);
    const Grid& grid = pair.reference.grid;
    const Mask removed = ball(grid, centre, 12.0);
    for (std::size_t i = 0; i < removed.inside.size(); ++i)
    {
      pair.reference.values[i] =
        removed.inside[i] ? 50.0f + 100.0f * content : pair.reference.values[i];
    }
    Alignment misled(pair, nullptr);
    withoutCavity[content] = misled.step().informationAtStart;
    pair.cavity = ball(grid, centre, 16.0);
    Alignment alignment(pair, nullptr);
    run(alignment);
    EXPECT_LT(apart(alignment.motion(), there), 0.4);
    withCavity[content] = alignment.progress().information;
  }
  EXPECT_NEAR(withCavity[0], withCavity[1], 0.005);
  EXPECT_GT(std::abs(withoutCavity[0] - withoutCavity[1]), 0.02);
}

TEST(Alignment, AMaskSaysWhatIsCompared)
{
  const RigidPose there = awayBy(5.0, 6.0);
  RegisteredPair pair = pairMovedBy(there);
  pair.inside = ball(smallGrid(), middle(smallGrid()), 26.0);
  // Tissue outside the mask lies elsewhere.
  for (std::size_t i = 0; i < pair.inside.inside.size(); ++i)
  {
    pair.rest.values[i] = pair.inside.inside[i] ? pair.rest.values[i] : static_cast<float>(i % 150);
  }
  Alignment alignment(pair, nullptr);
  run(alignment);
  EXPECT_LT(apart(alignment.motion(), there), 0.5);
}

TEST(Alignment, NothingIsFoundWithoutOverlap)
{
  const RigidPose there = awayBy(500.0, 0.0);
  Alignment alignment(pairMovedBy(there), nullptr);
  run(alignment);
  EXPECT_EQ(alignment.progress().information, 0.0);
  EXPECT_EQ(alignment.progress().overlap, 0.0);
  EXPECT_EQ(alignment.shiftMm(), 0.0) << "there is no information";
}

// A few samples at a border agree by chance: below a quarter of them, nothing is found.
TEST(Alignment, TooFewSamplesSayNothing)
{
  const Grid grid = smallGrid();
  const double widthMm = grid.spacing.x * (grid.dimensions.x - 1);
  AlignmentSettings settings;
  settings.levelsMm = { 4.0 };
  for (const double overlap : { 0.1, 0.2, 0.3, 0.5 })
  {
    RegisteredPair pair;
    pair.rest = filled(grid, tissue);
    pair.reference = pair.rest;
    pair.reference.grid.origin += (1.0 - overlap) * widthMm * grid.direction[0];
    const double information = Alignment(pair, nullptr, settings).step().informationAtStart;
    EXPECT_EQ(information > 0.0, overlap > 0.25) << overlap;
  }
}
