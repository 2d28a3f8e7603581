// SPDX-License-Identifier: BSD-3-Clause
// Proves that a fit of landmarks finds the rigid motion and the bend that were put in, that it
// equals a reference that turns and solves plainly, and that it ends in a result or a sentence
// whatever was measured.
#include "Filters/Fit/Fit.h"
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Testing/Cxx/Fit/DenseReference.h"

#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Tolerance = 1e-6; // mm

const RigidPose Turned =
  turnedAround({ 10.0, -20.0, 30.0 }, rotationFrom({ 0.15, -0.1, 0.2 }), { 4.0, -6.0, 8.0 });

// Landmarks that were moved rigidly and then missed by up to `missMm` along each axis.
Measurements landmarksOf(int count, double missMm, unsigned seed = 11)
{
  Scatter scatter(seed);
  Measurements measured;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 rest = glm::dvec3(10.0, -20.0, 30.0) + scatter.point(30.0);
    measured.landmarks.push_back({ rest, Turned.apply(rest) + scatter.point(missMm) });
  }
  return measured;
}

double largest(const glm::dmat3& m)
{
  double found = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    found = std::max(found, std::abs(m[i / 3][i % 3]));
  }
  return found;
}

// The fit's own rows, with what is left after its rigid motion.
std::vector<Row> rowsAfter(const RigidPose& rigid, const Measurements& measured)
{
  std::vector<Row> rows;
  for (const PointPair& pair : measured.landmarks)
  {
    const glm::dvec3 left = rigid.applyInverse(pair.measured) - pair.rest;
    int axis = 0;
    for (Row row : probe(pair.rest))
    {
      row.value = left[axis++];
      row.variance = 0.49 / pair.weight;
      rows.push_back(row);
    }
  }
  return rows;
}
}

TEST(Fit, FindsAnExactRigidMotionAndBendsNothing)
{
  const Measurements measured = landmarksOf(12, 0.0);
  Fit fit;
  fit.solve(measured, {});
  EXPECT_LT(largest(fit.rigid().rotation - Turned.rotation), 1e-10);
  EXPECT_LT(glm::length(fit.rigid().translation - Turned.translation), 1e-8);
  EXPECT_LT(glm::length(fit.bend({ 1.0, 2.0, 3.0 })), 1e-9);
  for (const double error : fit.leaveOneOut())
  {
    EXPECT_LT(error, 1e-8);
  }
}

TEST(Fit, EqualsTheReferenceAtItsMotion)
{
  Measurements measured = landmarksOf(16, 2.0);
  measured.landmarks[3].weight = 4.0;
  Fit fit;
  fit.solve(measured, {});
  const std::vector<Row> rows = rowsAfter(fit.rigid(), measured);
  const RigidMean mean{ { 10.0, -20.0, 30.0 }, 0.0 };
  Scatter scatter(12);
  for (int i = 0; i < 4; ++i)
  {
    const glm::dvec3 at = scatter.point(60.0);
    // If motion is left in the rows, the reference with a mean says something else.
    const Answer answer = answerOf({ 40.0, 1.0 }, rows, at, &mean);
    EXPECT_LT(glm::length(fit.bend(at) - answer.displacement), Tolerance);
    const double third =
      (answer.covariance[0][0] + answer.covariance[1][1] + answer.covariance[2][2]) / 3.0;
    EXPECT_NEAR(fit.deviation(at), fit.calibration() * std::sqrt(third), Tolerance);
    EXPECT_EQ(fit.deviations({ at }).front(), fit.deviation(at));
    EXPECT_EQ(fit.measuredFromRest(at), fit.rigid().apply(at + fit.bend(at)));
  }
}

TEST(Fit, LeaveOneOutIsAFitOfTheOthers)
{
  const Measurements measured = landmarksOf(16, 1.0);
  Fit fit;
  fit.solve(measured, {});
  for (std::size_t i = 0; i < measured.landmarks.size(); ++i)
  {
    Measurements others = measured;
    others.landmarks.erase(others.landmarks.begin() + static_cast<std::ptrdiff_t>(i));
    Fit without;
    without.solve(others, {});
    const PointPair& pair = measured.landmarks[i];
    const double error = glm::distance(without.measuredFromRest(pair.rest), pair.measured);
    // The closed form turns the volume by a small angle; the fit of the others by any.
    EXPECT_NEAR(fit.leaveOneOut()[i], error, 0.01);
  }
}

TEST(Fit, DeviationsAreThoseThatLeavingOutShows)
{
  // Errors far beyond what the settings expect: the calibration says so.
  const Measurements wild = landmarksOf(60, 6.0);
  const Measurements tame = landmarksOf(60, 0.1);
  Fit first;
  Fit second;
  first.solve(wild, {});
  second.solve(tame, {});
  EXPECT_GT(first.calibration(), 2.0);
  EXPECT_LT(second.calibration(), 0.5);
  EXPECT_GT(first.deviation({ 200.0, 0.0, 0.0 }), 2.0 * first.deviation({ 10.0, -20.0, 30.0 }));
}

TEST(Fit, AWeightCountsPairs)
{
  Measurements once = landmarksOf(10, 1.0);
  Measurements twice = once;
  once.landmarks[4].weight = 2.0;
  twice.landmarks.push_back(twice.landmarks[4]);
  Fit one;
  Fit other;
  one.solve(once, {});
  other.solve(twice, {});
  const glm::dvec3 at(3.0, 4.0, 5.0);
  EXPECT_LT(glm::length(one.measuredFromRest(at) - other.measuredFromRest(at)), Tolerance);
}

TEST(Fit, APairThatIsSwitchedOffIsNotThere)
{
  Measurements measured = landmarksOf(10, 1.0);
  measured.landmarks[9].weight = 0.0;
  Measurements fewer = measured;
  fewer.landmarks.pop_back();
  Fit one;
  Fit other;
  one.solve(measured, {});
  other.solve(fewer, {});
  EXPECT_EQ(one.measuredFromRest({ 3.0, 4.0, 5.0 }), other.measuredFromRest({ 3.0, 4.0, 5.0 }));
  EXPECT_TRUE(std::isnan(one.leaveOneOut()[9]));
}

TEST(Fit, APullThatIsSwitchedOffLeavesTheMotion)
{
  Measurements measured = landmarksOf(10, 0.0);
  measured.pulls = { { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 10.0 }, 0.0 } };
  Fit fit;
  fit.solve(measured, {});
  EXPECT_LT(largest(fit.rigid().rotation - Turned.rotation), 1e-9);
}

// All but the last lie on a line, so that the others do not say how far it turned around the line.
TEST(Fit, APairThatTheOthersSayNothingAboutIsNotJudged)
{
  Measurements measured;
  for (int i = 0; i < 9; ++i)
  {
    const glm::dvec3 rest(10.0 * i, i == 8 ? 60.0 : 0.0, 0.0);
    measured.landmarks.push_back({ rest, Turned.apply(rest) + glm::dvec3(i % 3) });
  }
  Fit fit;
  fit.solve(measured, {});
  EXPECT_TRUE(std::isnan(fit.leaveOneOut()[8]));
  EXPECT_LT(fit.leaveOneOut()[4], 5.0);
  EXPECT_TRUE(std::isfinite(fit.calibration()));
}

// Three pairs that turned by half a turn, from where no small steps lead there.
TEST(Fit, FewPairsThatTurnedFarAreFound)
{
  for (const double angle : { 0.5, 1.5, 2.5, 3.1 })
  {
    const RigidPose far = turnedAround({ 10.0, 0.0, 0.0 }, rotationFrom({ 0.0, 0.0, angle }), {});
    Measurements measured;
    for (const glm::dvec3& rest :
      { glm::dvec3(0, 0, 0), glm::dvec3(80, 0, 0), glm::dvec3(0, 90, 0), glm::dvec3(10, 20, 70) })
    {
      measured.landmarks.push_back({ rest, far.apply(rest) });
    }
    Fit fit;
    fit.solve(measured, {});
    EXPECT_TRUE(fit.isRotationExpectedSmall());
    EXPECT_LT(glm::distance(fit.measuredFromRest({ 80, 0, 0 }), far.apply({ 80, 0, 0 })), 10.0)
      << angle;
  }
}

TEST(Fit, OrderDoesNotMatter)
{
  Measurements measured = landmarksOf(12, 1.0);
  Fit one;
  one.solve(measured, {});
  std::reverse(measured.landmarks.begin(), measured.landmarks.end());
  Fit other;
  other.solve(measured, {});
  const glm::dvec3 at(3.0, 4.0, 5.0);
  EXPECT_LT(glm::length(one.measuredFromRest(at) - other.measuredFromRest(at)), 1e-9);
}

TEST(Fit, ThePriorHoldsBackATurnOfFewPairs)
{
  // Six pairs that turned by 15 degrees, which the prior of 3 degrees does not believe.
  Fit six;
  Fit seven;
  six.solve(landmarksOf(6, 0.0), {});
  seven.solve(landmarksOf(7, 0.0), {});
  const double turn = glm::length(vectorFrom(Turned.rotation));
  EXPECT_LT(glm::length(vectorFrom(six.rigid().rotation)), 0.95 * turn);
  EXPECT_NEAR(glm::length(vectorFrom(seven.rigid().rotation)), turn, 1e-9);
}

TEST(Fit, PullsMoveTissueAndPinsHoldIt)
{
  Measurements measured;
  measured.pulls = { { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 10.0 } } };
  measured.pins = { { 50.0, 0.0, 0.0 } };
  Fit fit;
  fit.solve(measured, {});
  EXPECT_EQ(fit.rigid().translation, glm::dvec3(0.0));
  EXPECT_NEAR(fit.bend({ 0.0, 0.0, 0.0 }).z, 10.0, 0.2);
  EXPECT_LT(glm::length(fit.bend({ 50.0, 0.0, 0.0 })), 0.05);
  EXPECT_GT(fit.bend({ 25.0, 0.0, 0.0 }).z, 2.0);
  EXPECT_LT(fit.deviation({ 50.0, 0.0, 0.0 }), 0.2);
  EXPECT_GT(fit.deviation({ 0.0, 300.0, 0.0 }), 6.0);
}

// None, one and two pairs, and pairs on a line or in one place, do not say all of a motion.
TEST(Fit, FewOrFlatPairsGiveAResult)
{
  Measurements none;
  Fit fit;
  fit.solve(none, {});
  EXPECT_EQ(fit.measuredFromRest({ 1.0, 2.0, 3.0 }), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_TRUE(std::isinf(fit.deviation({ 1.0, 2.0, 3.0 })));
  EXPECT_TRUE(std::isinf(fit.field().covariance({ 1.0, 2.0, 3.0 })[0][0]));
  none.traces = { { 1.0, 2.0, 3.0 } }; // it bends, but there is no cortex
  fit.solve(none, {});
  EXPECT_TRUE(std::isinf(fit.deviation({ 1.0, 2.0, 3.0 })));
  Measurements one = landmarksOf(1, 1.0);
  fit.solve(one, {});
  EXPECT_LT(
    glm::distance(fit.measuredFromRest(one.landmarks[0].rest), one.landmarks[0].measured), 1e-9);
  EXPECT_LT(glm::length(fit.bend(glm::dvec3(0.0))), 1e-9);
  EXPECT_TRUE(std::isnan(fit.leaveOneOut()[0]));
  fit.solve(landmarksOf(2, 1.0), {});
  EXPECT_TRUE(std::isfinite(glm::length(fit.measuredFromRest(glm::dvec3(0.0)))));
  EXPECT_GT(fit.leaveOneOut()[1], 0.0);

  Measurements line;
  Measurements heap;
  for (int i = 0; i < 9; ++i)
  {
    const glm::dvec3 rest(10.0 * i, 0.0, 0.0);
    line.landmarks.push_back({ rest, rest + glm::dvec3(0.0, 0.0, 5.0) });
    heap.landmarks.push_back({ { 1.0, 2.0, 3.0 }, { 4.0, 4.0, 4.0 } });
  }
  fit.solve(line, {});
  EXPECT_LT(glm::distance(fit.measuredFromRest({ 0, 20, 0 }), { 0, 20, 5 }), 1e-6);
  EXPECT_GT(fit.deviation({ 0, 200, 0 }), fit.deviation({ 40, 0, 0 }));
  fit.solve(heap, {});
  EXPECT_LT(glm::distance(fit.measuredFromRest({ 1, 2, 3 }), { 4, 4, 4 }), 1e-9);
}

TEST(Fit, WhatIsNoNumberIsOneSentence)
{
  const auto problemOfFit = [](const Measurements& measured, const FitSettings& settings = {}) {
    return problemOf([&] { Fit().solve(measured, settings); });
  };
  Measurements measured = landmarksOf(3, 1.0);
  measured.landmarks[1].measured.y = NaN;
  EXPECT_NE(problemOfFit(measured).find("The measured end of landmark 2 is at"), std::string::npos);
  measured = landmarksOf(3, 1.0);
  measured.landmarks[2].weight = -1.0;
  EXPECT_EQ(
    problemOfFit(measured), "The weight of landmark 3 is -1; it must be 0 or more, and finite");
  measured = {};
  measured.traces = { { 0.0, std::numeric_limits<double>::infinity(), 0.0 } };
  EXPECT_NE(problemOfFit(measured).find("Traced point 1 is at"), std::string::npos);
  measured = {};
  measured.pins = { { 0.0, 2e6, 0.0 } };
  EXPECT_NE(problemOfFit(measured).find("Pin 1 is at"), std::string::npos);
  FitSettings settings;
  settings.surfaceKernel.lengthMm = 0.0;
  EXPECT_EQ(problemOfFit({}, settings), "The surface length is 0; it must be above 0, and finite");
}

// Points that are flat, or mirrored, agree best with a mirror; tissue cannot be mirrored.
TEST(NearestRotation, IsNeverAMirror)
{
  const std::vector<double> weights(4, 1.0);
  for (const double height : { 0.0, 7.0 })
  {
    const std::vector<glm::dvec3> from{ { 30, 0, 0 }, { -10, 25, 0 }, { -20, -25, 0 },
      { 5, 5, height } };
    std::vector<glm::dvec3> mirrored = from;
    std::vector<glm::dvec3> turned = from;
    const glm::dmat3 turn = rotationFrom({ 0.4, -0.9, 1.6 });
    for (std::size_t i = 0; i < from.size(); ++i)
    {
      mirrored[i].z = -from[i].z;
      turned[i] = turn * from[i];
    }
    EXPECT_NEAR(glm::determinant(nearestRotation(from, mirrored, weights)), 1.0, 1e-9) << height;
    const glm::dmat3 found = nearestRotation(from, turned, weights);
    for (int column = 0; column < 3; ++column)
    {
      EXPECT_LT(glm::distance(found[column], turn[column]), 1e-9) << height;
    }
  }
}
