// SPDX-License-Identifier: BSD-3-Clause
// Proves that the cubic between the control points has the field's values at them with both kernels
// and comes near to it between them, and that a field that folds is shortened.
#include "Common/Grid.h"
#include "Common/Problem.h"
#include "Filters/Deformation/ControlPoints.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Fit/FittedLattice.h"
#include "Testing/Cxx/Fit/DenseReference.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
Grid boxGrid()
{
  Grid grid;
  grid.dimensions = { 19, 17, 15 };
  grid.origin = { -90.0, -80.0, -70.0 };
  grid.spacing = { 10.0, 9.0, 11.0 };
  return grid;
}

// One pull of so many millimetres.
Process pulled(double byMm, double lengthMm)
{
  Process process({ lengthMm, 8.0 });
  std::vector<Row> rows = probe({ 5.0, 3.0, -2.0 });
  rows[2].value = byMm;
  rows[0].variance = rows[1].variance = rows[2].variance = 0.01;
  process.setRows(rows);
  return process;
}
}

// Landmarks alone have a rigid mean; a pull beside them has none. One pair and the pins share no
// place with others.
class EvidenceOf : public ::testing::TestWithParam<bool>
{
};

TEST_P(EvidenceOf, TheLatticeIsThatOfEachControlPoint)
{
  Scatter scatter(7);
  Measurements measured;
  for (int i = 0; i < 9; ++i)
  {
    const glm::dvec3 rest = scatter.point(60.0);
    measured.landmarks.push_back({ rest, rest + 0.05 * scatter.point(20.0), 1.0 + i % 2 });
  }
  const glm::dvec3 start(10.0, 20.0, -5.0);
  if (GetParam())
  {
    measured.pulls.push_back({ start, start + glm::dvec3(0.0, 2.0, 0.0), 1.0 });
    measured.pins.emplace_back(-30.0, 4.0, 8.0);
  }
  FittedLattice fitted;
  const Lattice lattice = makeLattice(boxGrid(), 0);
  fitted.solve(measured, {}, lattice, {});
  LatticeEvidence evidence;
  const std::vector<float> found = evidence.deviations(fitted);
  ASSERT_EQ(found.size(), boxGrid().count());
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), boxGrid().dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 rest = boxGrid().worldFromGrid(glm::dvec3(index));
    if (point % 97 == 0)
    {
      const double single = fitted.deviations({ rest }).front();
      EXPECT_NEAR(found[point], single, 1e-6 * (1.0 + single)) << point;
    }
    ++point;
  });
  if (GetParam())
  {
    // A pull that goes on says nothing new of where is measured.
    measured.pulls[0].measured.y += 1.0;
    fitted.solve(measured, {}, lattice, {});
    EXPECT_EQ(evidence.deviations(fitted).size(), found.size());
    EXPECT_EQ(evidence.solutions(), 1);
    measured.pulls[0].rest.y += 1.0;
    fitted.solve(measured, {}, lattice, {});
    evidence.deviations(fitted);
    EXPECT_EQ(evidence.solutions(), 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Fits, EvidenceOf, ::testing::Bool());

TEST(Evidence, IsFoundAnewForAnotherLattice)
{
  Measurements measured;
  measured.landmarks = { { { 10.0, 20.0, -5.0 }, { 11.0, 20.0, -5.0 } } };
  Grid shifted = boxGrid();
  shifted.origin += glm::dvec3(40.0, 0.0, 0.0);
  LatticeEvidence evidence;
  for (const Grid& grid :
    { boxGrid(), shifted, withDimensions(shifted, { 7, 6, 5 }) }) // the same measurements each time
  {
    FittedLattice fitted;
    fitted.solve(measured, {}, makeLattice(grid, 0), {});
    const std::vector<float> found = evidence.deviations(fitted);
    ASSERT_EQ(found.size(), grid.count());
    for (const std::size_t point : { std::size_t(0), grid.count() / 2, grid.count() - 1 })
    {
      const glm::dvec3 rest = grid.worldFromGrid(glm::dvec3(indexOf(grid, point)));
      const double single = fitted.deviations({ rest }).front();
      EXPECT_NEAR(found[point], single, 1e-6 * (1.0 + single)) << point;
    }
  }
}

TEST(RootMeanSquare, LeavesOutWhatIsNotKnown)
{
  EXPECT_DOUBLE_EQ(rootMeanSquare({ 3.0, std::nan(""), -4.0 }), std::sqrt(12.5));
  EXPECT_TRUE(std::isnan(rootMeanSquare({ std::nan("") })));
  EXPECT_TRUE(std::isnan(rootMeanSquare({})));
}

TEST(Evidence, IsRefusedForVeryManyControlPoints)
{
  Grid grid = boxGrid();
  grid.dimensions = { 66, 66, 66 };
  FittedLattice fitted;
  fitted.solve({}, {}, makeLattice(grid, 0), {});
  const std::string problem = problemOf([&] { LatticeEvidence().deviations(fitted); });
  EXPECT_NE(problem.find("287496"), std::string::npos) << problem;
}

class FitLatticeOfKernel : public ::testing::TestWithParam<int>
{
};

TEST_P(FitLatticeOfKernel, PassesThroughTheField)
{
  Lattice lattice = makeLattice(boxGrid(), GetParam());
  const Process field = pulled(10.0, 60.0);
  addField(lattice, field);
  const PointMap map(lattice);
  for (const glm::dvec3 index :
    { glm::dvec3(0, 0, 0), glm::dvec3(9, 8, 7), glm::dvec3(18, 3, 14), glm::dvec3(4, 16, 9) })
  {
    const glm::dvec3 at = lattice.grid.worldFromGrid(index);
    EXPECT_LT(glm::distance(map.deformedFromRest(at), at + field.displacement(at)), 1e-4);
  }
  Scatter scatter(21);
  for (int i = 0; i < 100; ++i)
  {
    const glm::dvec3 at = scatter.point(60.0);
    EXPECT_LT(glm::distance(map.deformedFromRest(at), at + field.displacement(at)), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Kernels, FitLatticeOfKernel, ::testing::Values(KernelCatmullRom, KernelBSpline));

TEST(FitLattice, AFoldIsShortened)
{
  const Lattice still = makeLattice(boxGrid(), KernelCatmullRom);
  Lattice lattice = still;
  addField(lattice, pulled(10.0, 60.0));
  EXPECT_EQ(fractionWithoutFolds(still, lattice, 4), 1.0);
  lattice = still;
  addField(lattice, pulled(40.0, 25.0));
  ASSERT_LT(minimumJacobian(lattice), 0.0);
  const double share = fractionWithoutFolds(still, lattice, 4);
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.95);
  for (glm::vec3& displacement : lattice.displacements)
  {
    displacement *= static_cast<float>(share);
  }
  EXPECT_GT(minimumJacobian(lattice), 0.09);
}

// Two pulls against each other, of which the guard leaves a share.
TEST(FitLattice, DeviationsCountWhatTheGuardTook)
{
  Measurements measured;
  measured.pulls = { { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 30.0 } },
    { { 0.0, 0.0, 8.0 }, { 0.0, 0.0, -30.0 } } };
  FittedLattice fitted;
  fitted.solve(measured, {}, makeLattice(boxGrid(), KernelCatmullRom), {});
  ASSERT_LT(fitted.fraction(), 1.0);
  const glm::dvec3 at(0.0);
  const double away = glm::distance(fitted.measuredFromRest(at), fitted.fit().measuredFromRest(at));
  ASSERT_GT(away, 2.0);
  EXPECT_NEAR(fitted.deviations({ at }).front(),
    std::sqrt(std::pow(fitted.fit().deviation(at), 2) + away * away / 3.0), 1e-6);
}
