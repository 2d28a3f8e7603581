// SPDX-License-Identifier: BSD-3-Clause
// Proves that a fit begins with its base: without measurements it is the base, what was measured
// changes it and nothing else, measurements that agree with it change nothing, and the fold guard
// leaves it alone.
#include "Filters/Fit/FittedLattice.h"
#include "Testing/Cxx/Fit/DenseReference.h"

#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Radius = 70.0; // mm, of the brain

Grid boxGrid()
{
  Grid grid;
  grid.origin = glm::dvec3(-90.0);
  grid.spacing = glm::dvec3(10.0);
  grid.dimensions = glm::ivec3(19);
  return grid;
}

// A sag of 8 mm under the top of the brain, with a turn.
glm::dvec3 bendAt(const glm::dvec3& rest)
{
  const double away = glm::distance(rest, glm::dvec3(0.0, 0.0, Radius)) / 50.0;
  const double share = std::exp(-0.5 * away * away);
  return glm::dvec3(2.0, -1.0, -8.0) * share + 0.02 * glm::dvec3(-rest.y, rest.x, 0.0);
}

Lattice bentLattice(int kernel)
{
  Lattice lattice = makeLattice(boxGrid(), kernel);
  for (int k = 0; k < 19; ++k)
  {
    for (int j = 0; j < 19; ++j)
    {
      for (int i = 0; i < 19; ++i)
      {
        lattice.displacements[lattice.grid.offset(i, j, k)] =
          glm::vec3(bendAt(lattice.grid.worldFromGrid(glm::dvec3(i, j, k))));
      }
    }
  }
  return lattice;
}

std::optional<SurfacePoint> onBall(const glm::dvec3& rest, std::size_t)
{
  const glm::dvec3 normal = glm::normalize(rest);
  return SurfacePoint{ Radius * normal, normal };
}

class FitBaseOfKernel : public ::testing::TestWithParam<int>
{
protected:
  const Lattice Bent = bentLattice(this->GetParam());
  const Lattice Still = makeLattice(boxGrid(), this->GetParam());
  Measurements Measured;
  FittedLattice Fitted;

  void SetUp() override { this->Measured.base = std::make_shared<const FitBase>(this->Bent); }

  void solve(const RestSurface& surface = {})
  {
    this->Fitted.solve(this->Measured, surface, this->Still, {});
  }

  // Largest distance (mm) of a control point's displacement from that of the base.
  double change() const
  {
    double largest = 0.0;
    for (std::size_t i = 0; i < this->Bent.displacements.size(); ++i)
    {
      largest = std::max<double>(largest,
        glm::distance(this->Fitted.lattice().displacements[i], this->Bent.displacements[i]));
    }
    return largest;
  }
};
}

// Whoever gives a base says that the volume lies right, also where the base moves nothing.
TEST(FitBase, ABaseAtRestLeavesNoRigidPart)
{
  const Lattice still = makeLattice(boxGrid(), KernelCatmullRom);
  Measurements measured;
  measured.base = std::make_shared<const FitBase>(still);
  Scatter scatter(7);
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 at = scatter.point(50.0);
    measured.landmarks.push_back({ at, at + glm::dvec3(0.0, 5.0, 0.0) });
  }
  FittedLattice fitted;
  fitted.solve(measured, {}, still, {});
  EXPECT_EQ(fitted.fit().rigid().translation, glm::dvec3(0.0));
  EXPECT_LT(rootMeanSquare(fitted.residuals(measured.landmarks)), 0.1);
}

TEST_P(FitBaseOfKernel, KnowsItsLattice)
{
  EXPECT_TRUE(this->Measured.base->isOf(this->Bent));
  EXPECT_FALSE(this->Measured.base->isOf(this->Still));
  Lattice masked = this->Bent;
  masked.mask = std::make_shared<const NodeWeights>();
  EXPECT_FALSE(this->Measured.base->isOf(masked));
}

TEST_P(FitBaseOfKernel, WithoutMeasurementsTheFitIsTheBase)
{
  this->solve();
  EXPECT_EQ(this->change(), 0.0);
  EXPECT_EQ(this->Fitted.fraction(), 1.0);
}

TEST_P(FitBaseOfKernel, WhatAgreesWithItChangesNothing)
{
  const PointMap& map = this->Measured.base->map;
  for (const glm::dvec3 at : { glm::dvec3(0, 0, 60), glm::dvec3(20, -10, 50), glm::dvec3(-30) })
  {
    this->Measured.landmarks.push_back({ at, map.deformedFromRest(at) });
    this->Measured.pulls.push_back({ at + 5.0, map.deformedFromRest(at + 5.0) });
    this->Measured.pins.push_back(at - 5.0);
  }
  for (const glm::dvec3 at : { glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 3), glm::dvec3(-1, 2, 4) })
  {
    this->Measured.traces.push_back(map.deformedFromRest(Radius * glm::normalize(at)));
    const glm::dvec3 opposite = -glm::normalize(at);
    this->Measured.anchors.push_back({ Radius * opposite, opposite });
  }
  this->solve(onBall);
  EXPECT_LT(this->change(), 1e-3);
  EXPECT_LT(glm::length(this->Fitted.fit().rigid().translation), 1e-9);
  for (const double residual : this->Fitted.traceResiduals(this->Measured.traces, onBall))
  {
    EXPECT_NEAR(residual, 0.0, 1e-3);
  }
}

TEST_P(FitBaseOfKernel, APullChangesItWhereItPulls)
{
  const glm::dvec3 at(10.0, -20.0, 55.0);
  const PointMap& map = this->Measured.base->map;
  const glm::dvec3 target = map.deformedFromRest(at) + glm::dvec3(0.0, 3.0, 4.0);
  this->Measured.pulls = { { at, target } };
  this->Measured.pins = { glm::dvec3(40.0, 0.0, -50.0) };
  this->solve();
  EXPECT_LT(glm::distance(this->Fitted.measuredFromRest(at), target), 0.2);
  const glm::dvec3 held(40.0, 0.0, -50.0);
  EXPECT_LT(glm::distance(this->Fitted.measuredFromRest(held), map.deformedFromRest(held)), 0.1);
  // A fit of the same pull without a base would leave the sag out.
  EXPECT_GT(glm::distance(map.deformedFromRest(held), held), 0.5);
  const glm::dvec3 near(10.0, -20.0, 45.0);
  EXPECT_NEAR(
    glm::distance(this->Fitted.measuredFromRest(near), map.deformedFromRest(near)), 5.0, 1.0);
}

// Landmarks alone say nothing of a rigid motion then: the base says how the volume lies.
TEST_P(FitBaseOfKernel, LandmarksAloneBend)
{
  Scatter scatter(5);
  for (int i = 0; i < 12; ++i)
  {
    const glm::dvec3 at = scatter.point(50.0);
    this->Measured.landmarks.push_back(
      { at, this->Measured.base->map.deformedFromRest(at) + glm::dvec3(4.0, 0.0, 0.0) });
  }
  this->solve();
  EXPECT_EQ(this->Fitted.fit().rigid().translation, glm::dvec3(0.0));
  for (const double residual : this->Fitted.residuals(this->Measured.landmarks))
  {
    EXPECT_LT(residual, 0.1);
  }
}

TEST_P(FitBaseOfKernel, TracesAreProjectedThroughIt)
{
  // The brain sinks by 3 mm more than the base says, all over the top.
  for (double x = -25.0; x <= 25.0; x += 5.0)
  {
    for (double y = -25.0; y <= 25.0; y += 5.0)
    {
      const glm::dvec3 at = Radius * glm::normalize(glm::dvec3(x, y, 60.0));
      this->Measured.traces.push_back(
        this->Measured.base->map.deformedFromRest(at) - glm::dvec3(0.0, 0.0, 3.0));
    }
  }
  this->solve(onBall);
  EXPECT_LT(rootMeanSquare(this->Fitted.traceResiduals(this->Measured.traces, onBall)), 0.2);
  EXPECT_GT(this->change(), 2.0);
  EXPECT_LT(this->change(), 5.0);
}

// The guard shortens what the fit adds, and deviations count what it took.
TEST_P(FitBaseOfKernel, TheGuardLeavesTheBase)
{
  this->Measured.pulls = { { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 40.0 } },
    { { 0.0, 0.0, 8.0 }, { 0.0, 0.0, -40.0 } } };
  this->solve();
  ASSERT_LT(this->Fitted.fraction(), 1.0);
  EXPECT_GT(minimumJacobian(this->Fitted.lattice()), 0.09);
  Lattice whole = this->Bent;
  addField(whole, this->Fitted.fit().field());
  const std::size_t point = whole.grid.offset(9, 9, 9);
  const glm::vec3 added =
    this->Fitted.lattice().displacements[point] - this->Bent.displacements[point];
  const glm::vec3 asked = whole.displacements[point] - this->Bent.displacements[point];
  EXPECT_LT(glm::distance(added, static_cast<float>(this->Fitted.fraction()) * asked), 1e-3f);
  const glm::dvec3 at(0.0);
  const double away =
    glm::distance(this->Fitted.measuredFromRest(at), this->Fitted.fit().measuredFromRest(at));
  EXPECT_NEAR(this->Fitted.deviations({ at }).front(),
    std::sqrt(std::pow(this->Fitted.fit().deviation(at), 2) + away * away / 3.0), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
  Kernels, FitBaseOfKernel, ::testing::Values(KernelCatmullRom, KernelBSpline));
