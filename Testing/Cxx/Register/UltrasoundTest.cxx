// SPDX-License-Identifier: BSD-3-Clause
// Proves that a refinement by ultrasound finds the position through speckle, stays there, and
// moves as a whole without energy. And a check that goes on with its last level finds the same.
#include "Filters/Deformation/PointMap.h"
#include "Filters/Register/Refinement.h"
#include "Filters/Register/RefinementSteps.h"
#include "Filters/Register/ResultCheck.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const glm::ivec3 GrainRadii(1, 1, 0); // voxels
constexpr double Grains = 9.0;        // voxels that make one grain

Grid headGrid()
{
  Grid grid = smallGrid(64);
  grid.spacing = glm::dvec3(1.5);
  return grid;
}

glm::dvec3 sweepMiddle()
{
  return middle(headGrid()) + glm::dvec3(6.0, -5.0, 8.0);
}

// Folds of a brain's size, so that there is something to see within a sweep.
double folds(const glm::dvec3& at)
{
  return tissue(1.8 * at);
}

// Dark tissue echoes most, what is brightest does not, and borders across the beam do.
double echo(const glm::dvec3& at)
{
  const double value = folds(at);
  const glm::dvec3 deeper(0.0, 0.0, 0.7);
  const double border = std::abs(folds(at + deeper) - folds(at - deeper));
  return (value > 140.0 ? 0.05 : 0.3) + 1.2 / (1.0 + std::exp((value - 80.0) / 5.0)) +
    0.01 * border;
}

// The power of fully developed speckle: the mean is 1, and grains are longer across the beam.
std::vector<float> speckle(const Grid& grid, unsigned seed)
{
  std::mt19937 random(seed);
  const auto fraction = [&] { return (random() + 1.0) / 4294967297.0; };
  Volume parts[2] = { { grid, std::vector<float>(grid.count()) },
    { grid, std::vector<float>(grid.count()) } };
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    const double length = std::sqrt(-std::log(fraction()) / Grains);
    const double angle = 2.0 * glm::pi<double>() * fraction();
    parts[0].values[i] = static_cast<float>(length * std::cos(angle));
    parts[1].values[i] = static_cast<float>(length * std::sin(angle));
  }
  for (Volume& part : parts)
  {
    boxSum(part, GrainRadii);
  }
  std::vector<float> power(grid.count());
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    power[i] = parts[0].values[i] * parts[0].values[i] + parts[1].values[i] * parts[1].values[i];
  }
  return power;
}

// A ball of 22 mm that a probe saw: speckle, a logarithm, darker in the depth.
Volume ultrasound(unsigned seed)
{
  Grid grid;
  grid.dimensions = { 60, 56, 62 };
  grid.spacing = { 0.8, 0.85, 0.8 };
  grid.origin = sweepMiddle() - 0.5 * grid.spacing * glm::dvec3(grid.dimensions - 1);
  const std::vector<float> power = speckle(grid, seed);
  Volume result = filled(grid, [](const glm::dvec3& at) {
    const double depth = at.z - sweepMiddle().z;
    return glm::length(at - sweepMiddle()) < 22.0 ? echo(at) * std::exp(-depth / 60.0) : 0.0;
  });
  for (std::size_t i = 0; i < result.values.size(); ++i)
  {
    const float value = power[i] * result.values[i] * result.values[i];
    result.values[i] = value > 0.0f ? std::max(1.0f, 200.0f + 20.0f * std::log10(value)) : 0.0f;
  }
  return result;
}

RegisteredPair speckledPair(unsigned seed)
{
  RegisteredPair pair;
  pair.rest = filled(headGrid(), folds);
  pair.reference = ultrasound(seed);
  return pair;
}

// All control points `offsetMm` away from their position, and rotated about the middle of the fan.
Lattice displacedBy(const glm::dvec3& offsetMm, double rotationAboutZ = 0.0)
{
  Lattice lattice = makeLattice(withDimensions(headGrid(), { 10, 10, 10 }), KernelCatmullRom);
  const glm::dvec3 rotation(0.0, 0.0, rotationAboutZ);
  std::size_t number = 0;
  for (int k = 0; k < 10; ++k)
  {
    for (int j = 0; j < 10; ++j)
    {
      for (int i = 0; i < 10; ++i)
      {
        const glm::dvec3 arm = lattice.grid.worldFromGrid({ i, j, k }) - sweepMiddle();
        lattice.displacements[number++] = glm::vec3(offsetMm + glm::cross(rotation, arm));
      }
    }
  }
  return lattice;
}

// Mean distance (mm) of tissue inside the fan from its true position.
double error(const Lattice& lattice)
{
  const PointMap map(lattice);
  double sum = 0.0;
  for (int corner = 0; corner < 27; ++corner)
  {
    const glm::dvec3 from =
      sweepMiddle() + 10.0 * (glm::dvec3(corner % 3, corner / 3 % 3, corner / 9) - 1.0);
    sum += glm::distance(map.deformedFromRest(from), from);
  }
  return sum / 27.0;
}

Lattice refined(const Lattice& start, const RefinementSettings& settings, unsigned seed = 7)
{
  Refinement refinement(speckledPair(seed), start, settings);
  while (!refinement.progress().isFinished)
  {
    refinement.step();
  }
  return refinement.lattice();
}

RefinementSettings byUltrasound()
{
  RefinementSettings settings;
  const auto isUltrasound = [](const Similarity& one) { return one.plan.fan.has_value(); };
  settings.plan = std::find_if(similarities().begin(), similarities().end(), isUltrasound)->plan;
  return settings;
}
}

class UltrasoundFrom : public ::testing::TestWithParam<glm::dvec4>
{
};

TEST_P(UltrasoundFrom, TheVolumeFindsItsPlaceThroughSpeckle)
{
  const Lattice start = displacedBy(glm::dvec3(GetParam()), GetParam().w);
  ASSERT_GT(error(start), 2.5);
  EXPECT_LT(error(refined(start, byUltrasound())), 0.3);
}

// Shifts in mm, and a rotation in radians.
INSTANTIATE_TEST_SUITE_P(Starts, UltrasoundFrom,
  ::testing::Values(glm::dvec4(4.0, 0.0, 0.0, 0.0), glm::dvec4(0.0, -4.0, 0.0, 0.0),
    glm::dvec4(0.0, 0.0, 4.0, 0.0), glm::dvec4(-2.0, 2.0, -2.0, 0.0),
    glm::dvec4(1.5, 1.5, 1.5, 0.05)));

TEST(Ultrasound, SeveralStartsFindWhatOneMisses)
{
  const Lattice start = displacedBy({ 6.0, -6.0, 3.0 }, -0.08);
  RefinementSettings settings = byUltrasound();
  const double one = error(refined(start, settings));
  settings.starts = 8;
  const double several = error(refined(start, settings));
  EXPECT_GT(one, 2.0) << "else the test proves nothing";
  EXPECT_LT(several, 0.3);
}

TEST(Ultrasound, ARefinementGoesOnFromABetterPlaceNearby)
{
  const Lattice start = displacedBy({ 5.0, 5.0, 0.0 });
  const RefinementSettings settings = byUltrasound();
  Refinement refinement(speckledPair(7), start, settings);
  while (!refinement.progress().isFinished)
  {
    refinement.step();
  }
  const double missed = error(refinement.lattice());
  ASSERT_GT(missed, 2.0) << "else the test proves nothing";
  ResultCheck check(refinement.takePair(), refinement.lattice(), settings.plan);
  while (check.step())
  {
  }
  ASSERT_LT(check.figures().rivalGain.value_or(1.0), 0.0);
  Refinement second(check.takePair(), start, settings);
  second.beginAt(refinement.lattice(), check.figures().rivalMotion);
  EXPECT_LT(error(second.lattice()), 1.0) << "the place itself, before a step";
  while (!second.progress().isFinished)
  {
    second.step();
  }
  EXPECT_LT(error(second.lattice()), 0.3);
}

// A caller may stop at any step: what it gets is never worse than the start, and its cost is its
// own.
TEST(Ultrasound, SeveralStartsKeepTheBestAtEachStep)
{
  RefinementSettings settings = byUltrasound();
  settings.plan.levels.resize(1);
  settings.mostSteps = 2;
  settings.starts = 3;
  const RegisteredPair pair = speckledPair(7);
  const Lattice start = displacedBy({ 3.0, 0.0, 0.0 });
  ComparedRegion region(pair, settings.plan);
  region.find(pair, start.grid);
  PyramidLevel level(pair, region, settings.plan.levels.front(), start);
  while (!level.isPrepared())
  {
    level.prepare();
  }
  const auto costOf = [&](const Lattice& lattice) {
    return level.compare(RefinementState(lattice, settings).controls).cost;
  };
  Refinement refinement(pair, start, settings);
  double last = costOf(start);
  int others = 0; // positions that were searched after the first one
  while (!refinement.progress().isFinished)
  {
    const int taken = refinement.progress().steps;
    refinement.step();
    if (refinement.progress().steps > 0)
    {
      const double reported = refinement.progress().cost;
      EXPECT_NEAR(costOf(refinement.lattice()), reported, 1e-5) << refinement.progress().steps;
      EXPECT_LE(reported, last + 1e-9) << refinement.progress().steps;
      last = reported;
    }
    others += taken > 6 && refinement.progress().steps > taken ? 1 : 0;
  }
  EXPECT_GT(others, 0) << "else the test proves nothing";
}

TEST(Ultrasound, TheVolumeStaysWhereItIsRight)
{
  for (const unsigned seed : { 1u, 2u })
  {
    EXPECT_LT(error(refined(displacedBy(glm::dvec3(0.0)), byUltrasound(), seed)), 0.2) << seed;
  }
}

TEST(Ultrasound, AVolumeThatCannotBendStillMoves)
{
  RefinementSettings settings = byUltrasound();
  settings.stiffness = 1e6;
  EXPECT_LT(error(refined(displacedBy({ 2.0, -2.0, 2.0 }, -0.04), settings)), 0.4);
}

TEST(Ultrasound, ARigidLevelHasThreeTimesTheSteps)
{
  RefinementSettings settings = byUltrasound();
  settings.plan.levels.resize(1);
  settings.mostSteps = 2;
  Refinement refinement(speckledPair(3), displacedBy({ 3.0, 0.0, 0.0 }), settings);
  double last = 0.0;
  while (!refinement.progress().isFinished)
  {
    refinement.step();
    EXPECT_GE(refinement.progress().done, last);
    last = refinement.progress().done;
  }
  EXPECT_LE(refinement.progress().steps, 6) << "three times 2";
}

TEST(Ultrasound, ACheckThatGoesOnWithTheLastLevelFindsTheSame)
{
  const RefinementSettings settings = byUltrasound();
  Refinement refinement(speckledPair(4), displacedBy({ 2.0, 0.0, 0.0 }), settings);
  while (!refinement.progress().isFinished)
  {
    refinement.step();
  }
  std::unique_ptr<PyramidLevel> level = refinement.takeLevel();
  ASSERT_TRUE(level);
  const RegisteredPair pair = refinement.takePair();
  ResultCheck quick(pair, refinement.lattice(), settings.plan, std::move(level));
  ResultCheck whole(pair, refinement.lattice(), settings.plan);
  int calls = 0; // that are saved
  while (quick.step())
  {
    --calls;
  }
  while (whole.step())
  {
    ++calls;
  }
  ASSERT_TRUE(whole.figures().halvesMm);
  EXPECT_EQ(quick.figures().halvesMm, whole.figures().halvesMm);
  EXPECT_EQ(quick.figures().rivalGain, whole.figures().rivalGain);
  EXPECT_EQ(quick.figures().rivalMm, whole.figures().rivalMm);
  ASSERT_TRUE(whole.figures().spreadMm);
  EXPECT_EQ(quick.figures().spreadMm, whole.figures().spreadMm);
  EXPECT_GT(calls, 4);
}

TEST(RigidStep, IsTheMotionThatAllForcesAskFor)
{
  Grid grid;
  grid.dimensions = { 5, 6, 7 };
  grid.spacing = { 9.0, 8.0, 10.0 };
  const Lattice lattice = makeLattice(grid, KernelCatmullRom);
  const glm::dvec3 shift(0.5, -1.0, 0.25);
  const glm::dvec3 rotation(0.01, 0.02, -0.015);
  ControlForces forces(grid.count() * ForceNumbers, 0.0f);
  std::vector<glm::vec3> motion(grid.count());
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    const glm::ivec3 index(
      static_cast<int>(i % 5), static_cast<int>(i / 5 % 6), static_cast<int>(i / 30));
    motion[i] = glm::vec3(shift + glm::cross(rotation, grid.spacing * glm::dvec3(index)));
    const float weight = index.z < 4 ? 2.0f : 0.0f; // the upper half was not seen
    for (int axis = 0; axis < 3; ++axis)
    {
      forces[i * ForceNumbers + axis] = weight * motion[i][axis];
      forces[i * ForceNumbers + 3 + axis] = weight;
    }
  }
  const RigidStep step = rigidStep(grid, lattice.displacements, forces);
  double longest = 0.0;
  for (std::size_t i = 0; i < grid.count(); ++i)
  {
    EXPECT_LT(glm::distance(step.steps[i], motion[i]), 0.01f) << i;
    longest = std::max<double>(longest, i / 30 < 4 ? glm::length(step.steps[i]) : 0.0f);
  }
  EXPECT_NEAR(step.lengthMm, longest, 1e-6);
}

TEST(RigidStep, IsZeroWithoutForces)
{
  Grid grid;
  grid.dimensions = glm::ivec3(4);
  const RigidStep step = rigidStep(
    grid, std::vector<glm::vec3>(64, glm::vec3(1.0f)), ControlForces(64 * ForceNumbers, 0.0f));
  EXPECT_EQ(step.lengthMm, 0.0);
  EXPECT_EQ(step.steps, std::vector<glm::vec3>(64, glm::vec3(0.0f)));
}
