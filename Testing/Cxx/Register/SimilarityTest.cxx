// SPDX-License-Identifier: BSD-3-Clause
// Proves that forces are derivatives of the cost, that contrast does not count where it
// must not, and that a cavity does not count.
#include "Filters/Register/Similarity.h"
#include "Filters/Register/Similarities/LocalFitSimilarity.h"
#include "Filters/Register/Similarities/SelfSimilarity.h"
#include "Testing/Cxx/Register/Synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
const glm::dvec3 ShiftMm(1.1, -0.7, 0.9);

LevelVolumes level(double contrast = 1.0)
{
  const Grid grid = smallGrid(28);
  LevelVolumes result;
  result.rest = filled(grid, tissue);
  result.reference =
    filled(grid, [&](const glm::dvec3& at) { return contrast * tissue(at - ShiftMm) + 10.0; });
  result.restWeights = weightsOf(grid, {}, {});
  result.referenceWeights = result.restWeights;
  return result;
}

// Compares at displacements of the control points (mm along the grid's axes).
std::function<CostAndForces(const std::vector<glm::vec3>&)> comparison(
  const Metric& metric, const LevelVolumes& volumes, const Lattice& lattice)
{
  const std::shared_ptr<Comparison> made = metric.make(volumes, lattice);
  while (!made->prepare())
  {
  }
  return [made](const std::vector<glm::vec3>& at) { return made->compare(at); };
}

std::vector<glm::vec3> alongAxes(const Lattice& lattice)
{
  std::vector<glm::vec3> result;
  result.reserve(lattice.displacements.size());
  for (const glm::vec3& d : lattice.displacements)
  {
    result.push_back(glm::vec3(glm::transpose(lattice.grid.direction) * glm::dvec3(d)));
  }
  return result;
}
}

TEST(LatticeRows, ReadWhatTheCubicIs)
{
  const Grid grid = smallGrid(20);
  const auto everywhere = [](int, int) { return true; };
  for (const int kernel : { KernelCatmullRom, KernelBSpline })
  {
    const Lattice lattice = bulge(grid, 5.0, kernel);
    const LatticeRows rows(lattice, grid);
    const std::vector<glm::vec3> controls = alongAxes(lattice);
    const ControlForces forces = rows.visitRows(controls, everywhere, [&](const SampleRow& row) {
      for (int i = 0; i < grid.dimensions.x; ++i)
      {
        const glm::vec3 at = rows.position(i, row.j, row.k);
        const Taps taps = rows.tapsAt(0, at.x);
        const glm::vec3 cubic = cubicDisplacement(lattice.grid.dimensions, kernel, controls.data(),
          glm::dvec3(at) * grid.spacing / lattice.grid.spacing);
        const bool isEqual = glm::length(LatticeRows::displacement(row, taps) - cubic) < 1e-4f;
        const float ones[ForceNumbers] = { 1.0f, 0.0f, isEqual ? 0.0f : 1.0f };
        LatticeRows::add(row, taps, ones);
      }
      return true;
    });
    double all = 0.0;
    double wrong = 0.0;
    for (std::size_t i = 0; i < forces.size(); i += ForceNumbers)
    {
      all += forces[i];
      wrong += std::abs(forces[i + 2]);
    }
    EXPECT_NEAR(all, static_cast<double>(grid.count()), 1e-3 * grid.count());
    EXPECT_EQ(wrong, 0.0);
  }
}

TEST(SelfSimilarity, DoesNotChangeWithContrast)
{
  const Volume volume = filled(smallGrid(16), tissue);
  const auto numbers = selfSimilarity(volume);
  for (const float factor : { -1.0f, 3.0f })
  {
    Volume other = volume;
    for (float& value : other.values)
    {
      value = 500.0f + factor * value;
    }
    const auto others = selfSimilarity(other);
    float apart = 0.0f;
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      apart = std::max(apart, std::abs(numbers[i] - others[i]));
    }
    EXPECT_LT(apart, 1e-3f);
  }
  EXPECT_GT(*std::max_element(numbers.begin(), numbers.end()) -
      *std::min_element(numbers.begin(), numbers.end()),
    0.5f)
    << "the numbers differ between positions";
}

// Each metric that a similarity uses, once.
std::vector<const Metric*> metrics()
{
  std::vector<const Metric*> all;
  for (const Similarity& similarity : similarities())
  {
    for (const RefinementLevel& level : similarity.plan.levels)
    {
      if (std::find(all.begin(), all.end(), level.metric) == all.end())
      {
        all.push_back(level.metric);
      }
    }
  }
  return all;
}

class EachMetric : public ::testing::TestWithParam<const Metric*>
{
};

TEST(Similarities, HaveNamesThatTellThemApart)
{
  std::set<std::string> names;
  std::set<std::string> labels;
  for (const Similarity& similarity : similarities())
  {
    names.insert(similarity.name);
    labels.insert(similarity.label);
    EXPECT_EQ(std::string(similarity.tooltip).back(), '.') << similarity.name;
    ASSERT_FALSE(similarity.plan.levels.empty()) << similarity.name;
    for (const RefinementLevel& level : similarity.plan.levels)
    {
      EXPECT_GT(level.metric->bytesPerPoint, 0.0) << similarity.name;
      EXPECT_GE(level.metric->support.along, 1) << similarity.name;
    }
  }
  EXPECT_EQ(names.size(), similarities().size());
  EXPECT_EQ(labels.size(), similarities().size());
  EXPECT_EQ(names.count(""), 0u);
}

// A step of every control point along a smooth way changes the cost by what the forces say.
TEST_P(EachMetric, ForcesAreDerivatives)
{
  const LevelVolumes volumes = level();
  const Lattice lattice = bulge(volumes.rest.grid, 2.0);
  const auto compare = comparison(*GetParam(), volumes, lattice);
  const std::vector<glm::vec3> at = alongAxes(lattice);
  const CostAndForces here = compare(at);
  ASSERT_GT(here.cost, 0.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<glm::vec3> way(at.size(), glm::vec3(0.0f));
    double expected = 0.0;
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      // The border stays, so that no sample leaves the reference.
      way[i][axis] = glm::length(at[i]) > 0.3f ? at[i].x : 0.0f;
      expected -= 2.0 * way[i][axis] * here.forces[i * ForceNumbers + axis];
    }
    const auto moved = [&](float by) {
      std::vector<glm::vec3> result = at;
      for (std::size_t i = 0; i < at.size(); ++i)
      {
        result[i] += by * way[i];
      }
      return compare(result).cost;
    };
    const float by = 0.01f;
    const double found = (moved(by) - moved(-by)) / (2.0 * by);
    EXPECT_GT(std::abs(found), 1e-4);
    EXPECT_NEAR(expected, found, 0.03 * std::abs(found) + 1e-5);
  }
}

TEST_P(EachMetric, HalvesHaveTheSamplesOfTheWhole)
{
  const LevelVolumes volumes = level();
  const Grid& grid = volumes.rest.grid;
  const Lattice lattice = makeLattice(withDimensions(grid, { 6, 6, 6 }), 0);
  const std::unique_ptr<Comparison> made = GetParam()->make(volumes, lattice);
  while (!made->prepare())
  {
  }
  const double whole = made->compare(lattice.displacements).samples;
  HalfSpace half{ grid.direction[1], glm::dot(grid.direction[1], middle(grid)) };
  made->restrictTo(half);
  const double first = made->compare(lattice.displacements).samples;
  half = { -half.normal, -half.offsetMm };
  made->restrictTo(half);
  const double second = made->compare(lattice.displacements).samples;
  EXPECT_GT(std::min(first, second), 0.3 * whole);
  EXPECT_NEAR(first + second, whole, 1e-3 * whole);
  made->restrictTo({});
  EXPECT_EQ(made->compare(lattice.displacements).samples, whole);
}

TEST_P(EachMetric, IsLeastWhereBothAgree)
{
  const LevelVolumes volumes = level();
  const Lattice lattice = makeLattice(withDimensions(volumes.rest.grid, { 6, 6, 6 }), 0);
  const auto compare = comparison(*GetParam(), volumes, lattice);
  const auto at = [&](double share) {
    return compare(std::vector<glm::vec3>(lattice.displacements.size(),
                     glm::vec3(glm::transpose(lattice.grid.direction) * (share * ShiftMm))))
      .cost;
  };
  EXPECT_LT(at(1.0), 0.5 * at(0.0));
  EXPECT_LT(at(1.0), at(0.8));
  EXPECT_LT(at(1.0), at(1.2));
}

// What the cavity holds makes no difference, neither to the cost nor to any force.
// Else a volume would agree best where it meets nothing.
TEST_P(EachMetric, WhatMeetsNothingDoesNotAgree)
{
  const LevelVolumes volumes = level();
  const Lattice lattice = makeLattice(bulge(volumes.rest.grid, 0.0).grid, 0);
  const std::vector<glm::vec3> away(lattice.displacements.size(), glm::vec3(1e4f, 0.0f, 0.0f));
  const CostAndForces found = comparison(*GetParam(), volumes, lattice)(away);
  EXPECT_EQ(found.samples, 0.0);
  EXPECT_EQ(found.cost, 1.0);
}

TEST_P(EachMetric, ACavityDoesNotCount)
{
  LevelVolumes volumes = level();
  const Grid& grid = volumes.rest.grid;
  const Mask removed = ball(grid, middle(grid), 9.0);
  volumes.referenceWeights =
    weightsOf(grid, { nullptr, nullptr, { &removed } }, GetParam()->support);
  LevelVolumes changed = volumes;
  for (std::size_t i = 0; i < removed.inside.size(); ++i)
  {
    // Of the same size, so that the range and the noise of the reference stay.
    changed.reference.values[i] = removed.inside[i] ? 110.0f : changed.reference.values[i];
  }
  const Lattice lattice = bulge(grid, 3.0);
  const CostAndForces a = comparison(*GetParam(), volumes, lattice)(alongAxes(lattice));
  const CostAndForces b = comparison(*GetParam(), changed, lattice)(alongAxes(lattice));
  EXPECT_EQ(a.samples, b.samples);
  EXPECT_NEAR(a.cost, b.cost, 0.002 * a.cost);
  changed.referenceWeights = weightsOf(grid, {}, {});
  volumes.referenceWeights = changed.referenceWeights;
  const CostAndForces c = comparison(*GetParam(), volumes, lattice)(alongAxes(lattice));
  const CostAndForces d = comparison(*GetParam(), changed, lattice)(alongAxes(lattice));
  EXPECT_GT(std::abs(c.cost - d.cost), 0.02 * c.cost) << "without the mask it does";
}

INSTANTIATE_TEST_SUITE_P(Metrics, EachMetric, ::testing::ValuesIn(metrics()));

TEST(Similarity, InvertedContrastAgrees)
{
  const Lattice lattice = bulge(smallGrid(28), 2.0);
  for (const RefinementLevel& each : similarities().front().plan.levels)
  {
    const Metric& metric = *each.metric;
    const double plain = comparison(metric, level(), lattice)(alongAxes(lattice)).cost;
    const double inverted = comparison(metric, level(-1.0), lattice)(alongAxes(lattice)).cost;
    EXPECT_NEAR(plain, inverted, 0.01 * plain);
  }
}

// Ultrasound shows edges. The slope of the volume explains them; its values do not.
TEST(Similarity, TheSlopeExplainsEdges)
{
  LevelVolumes volumes = level();
  const Grid& grid = volumes.rest.grid;
  volumes.reference = filled(grid, [](const glm::dvec3& at) {
    glm::dvec3 slope;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 step(0.0);
      step[axis] = 2.0;
      slope[axis] = tissue(at + step) - tissue(at - step);
    }
    return glm::length(slope);
  });
  const Lattice lattice = makeLattice(withDimensions(grid, { 6, 6, 6 }), 0);
  const std::vector<glm::vec3> still(lattice.displacements.size(), glm::vec3(0.0f));
  const double alone = comparison(localCorrelationMetric(), volumes, lattice)(still).cost;
  const double both = comparison(linearFitWithGradients(), volumes, lattice)(still).cost;
  EXPECT_LT(both, 0.5 * alone);
}

// One scan shows grey matter brightest, another one darkest: no line explains it.
TEST(Similarity, AParabolaExplainsAnotherContrast)
{
  LevelVolumes volumes = level();
  const Grid& grid = volumes.rest.grid;
  volumes.reference = filled(grid, [](const glm::dvec3& at) {
    const double fromGrey = tissue(at) - 100.0;
    return 300.0 - 0.1 * fromGrey * fromGrey;
  });
  const Lattice lattice = makeLattice(withDimensions(grid, { 6, 6, 6 }), 0);
  const std::vector<glm::vec3> still(lattice.displacements.size(), glm::vec3(0.0f));
  const double line = comparison(localCorrelationMetric(), volumes, lattice)(still).cost;
  const double parabola = comparison(quadraticFitMetric(), volumes, lattice)(still).cost;
  EXPECT_GT(line, 0.5);
  EXPECT_LT(parabola, 0.5 * line) << "interpolation between points leaves a part";
}

TEST(Similarity, AMaskOfTheLatticeHoldsSamples)
{
  const LevelVolumes volumes = level();
  Lattice lattice = bulge(volumes.rest.grid, 2.0);
  const Mask half = ball(volumes.rest.grid, middle(volumes.rest.grid), 15.0);
  lattice.mask = maskWeights(lattice.grid, 4, half, 5.0);
  const CostAndForces masked =
    comparison(localCorrelationMetric(), volumes, lattice)(alongAxes(lattice));
  lattice.mask = nullptr;
  const CostAndForces whole =
    comparison(localCorrelationMetric(), volumes, lattice)(alongAxes(lattice));
  EXPECT_LT(masked.samples, 0.5 * whole.samples);
  EXPECT_EQ(masked.forces[3], 0.0f) << "nothing moves in the corner";
}
