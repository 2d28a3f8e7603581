// SPDX-License-Identifier: BSD-3-Clause
// Proves that the process gives the numbers of the same equations written down plainly, to 1e-6 mm,
// and closed forms where there are any; that other values need no new factor; and that leaving rows
// out in closed form is leaving them out.
#include "Filters/Fit/Process.h"
#include "Common/Problem.h"
#include "Testing/Cxx/Fit/DenseReference.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>
#include <optional>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Tolerance = 1e-6; // mm

double difference(const glm::dvec3& a, const glm::dvec3& b)
{
  return glm::length(a - b);
}

double difference(const glm::dmat3& a, const glm::dmat3& b)
{
  return difference(a[0], b[0]) + difference(a[1], b[1]) + difference(a[2], b[2]);
}
}

// Many rows, for the loops take several threads, and few.
class ProcessOfRows : public ::testing::TestWithParam<std::pair<int, int>>
{
};

TEST_P(ProcessOfRows, EqualsTheDenseReference)
{
  Scatter scatter(1);
  const std::vector<Row> rows = someRows(scatter, GetParam().first, GetParam().second);
  const Matern kernel{ 60.0, 8.0 };
  Process process(kernel);
  process.setRows(rows);
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 at = scatter.point(80.0);
    const Answer answer = answerOf(kernel, rows, at);
    EXPECT_LT(difference(process.displacement(at), answer.displacement), Tolerance);
    EXPECT_LT(difference(process.covariance(at), answer.covariance), Tolerance);
    EXPECT_EQ(process.displacements({ at }).front(), process.displacement(at));
  }
}

TEST_P(ProcessOfRows, GradientIsTheSlopeOfTheField)
{
  Scatter scatter(2);
  Process process({ 60.0, 8.0 });
  process.setRows(someRows(scatter, GetParam().first, GetParam().second));
  const glm::dvec3 at = scatter.point(50.0);
  const glm::dmat3 gradient = process.gradient(at);
  const double step = 1e-4;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 aside(0.0);
    aside[axis] = step;
    const glm::dvec3 slope =
      (process.displacement(at + aside) - process.displacement(at - aside)) / (2.0 * step);
    EXPECT_LT(difference(gradient[axis], slope), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(
  Rows, ProcessOfRows, ::testing::Values(std::pair(1, 0), std::pair(4, 9), std::pair(40, 120)));

TEST(Process, OneVectorInClosedForm)
{
  const Matern kernel{ 40.0, 2.0 };
  Process process(kernel);
  std::vector<Row> rows = probe({ 10.0, 20.0, 30.0 });
  for (Row& row : rows)
  {
    row.value = 3.0;
    row.variance = 1.0;
  }
  process.setRows(rows);
  const double distance = 25.0;
  const glm::dvec3 at(10.0 + distance, 20.0, 30.0);
  // One number was measured with a signal of 4 mm^2 and a noise of 1 mm^2.
  const double covariance = kernel.at(distance);
  EXPECT_NEAR(process.displacement(at).x, 3.0 * covariance / 5.0, 1e-12);
  EXPECT_NEAR(process.covariance(at)[1][1], 4.0 - covariance * covariance / 5.0, 1e-12);
  EXPECT_NEAR(process.covariance(at)[1][0], 0.0, 1e-12);
}

TEST(Process, ManyMeasurementsOfOnePointAreTheirMean)
{
  Process process({ 40.0, 100.0 });
  std::vector<Row> rows;
  for (const double value : { 1.0, 2.0, 6.0 })
  {
    for (Row row : probe({ 1.0, 2.0, 3.0 }))
    {
      row.value = value;
      row.variance = 0.3;
      rows.push_back(row);
    }
  }
  process.setRows(rows);
  // The field's own variance of 10000 mm^2 draws the mean to 0 by 0.1 / 10000.
  EXPECT_NEAR(process.displacement({ 1.0, 2.0, 3.0 }).y, 3.0 / (1.0 + 0.1 / 1e4), 1e-9);
  EXPECT_NEAR(process.covariance({ 1.0, 2.0, 3.0 })[0][0], 0.1 / (1.0 + 0.1 / 1e4), 1e-9);
}

TEST(Process, WithoutRowsNothingMovesAndNothingIsKnown)
{
  Process process({ 40.0, 3.0 });
  process.setRows({}, RigidMean());
  EXPECT_EQ(process.displacement({ 1.0, 2.0, 3.0 }), glm::dvec3(0.0));
  EXPECT_EQ(process.gradient({ 1.0, 2.0, 3.0 }), glm::dmat3(0.0));
  EXPECT_TRUE(std::isinf(process.covariance({ 1.0, 2.0, 3.0 })[2][2])); // the shift is free
  process.setRows({});
  EXPECT_EQ(process.covariance({ 1.0, 2.0, 3.0 })[2][2], 9.0);
}

TEST(Process, OtherValuesNeedNoNewFactor)
{
  Scatter scatter(3);
  std::vector<Row> rows = someRows(scatter, 10, 20);
  const Matern kernel{ 60.0, 8.0 };
  Process process(kernel);
  process.setRows(rows);
  std::vector<double> values;
  for (Row& row : rows)
  {
    row.value += scatter.number();
    values.push_back(row.value);
  }
  process.setValues(values);
  EXPECT_EQ(process.factors(), 1);
  const glm::dvec3 at(3.0, 4.0, 5.0);
  EXPECT_LT(
    difference(process.displacement(at), answerOf(kernel, rows, at).displacement), Tolerance);
}

TEST(Process, OrderOfRowsDoesNotMatter)
{
  Scatter scatter(4);
  std::vector<Row> rows = someRows(scatter, 10, 60);
  Process one({ 60.0, 8.0 });
  Process other({ 60.0, 8.0 });
  one.setRows(rows);
  std::reverse(rows.begin(), rows.end());
  other.setRows(rows);
  const glm::dvec3 at(3.0, 4.0, 5.0);
  EXPECT_LT(difference(one.displacement(at), other.displacement(at)), 1e-10);
  EXPECT_LT(difference(one.covariance(at), other.covariance(at)), 1e-10);
}

TEST(Process, RigidMeanEqualsTheDenseReference)
{
  Scatter scatter(5);
  std::vector<Row> rows = someRows(scatter, 8, 5);
  const Matern kernel{ 40.0, 1.0 };
  const RigidMean mean{ { 5.0, 0.0, -5.0 }, 300.0 };
  Process process(kernel);
  process.setRows(rows, mean);
  // Taking the motion out of the values leaves the field that the reference finds with it.
  const SmallMotion motion = process.remainingMotion(glm::dvec3(0.0));
  const std::vector<Row> all = rows;
  std::vector<double> values;
  for (const Row& row : rows)
  {
    const glm::dvec3 moved =
      motion.translation + glm::cross(motion.rotation, row.point - mean.centre);
    values.push_back(row.value - glm::dot(row.axis, moved));
  }
  process.setValues(values);
  const glm::dvec3 at = scatter.point(80.0);
  const glm::dvec3 whole =
    process.displacement(at) + motion.translation + glm::cross(motion.rotation, at - mean.centre);
  const Answer answer = answerOf(kernel, all, at, &mean);
  EXPECT_LT(difference(whole, answer.displacement), Tolerance);
  EXPECT_LT(difference(process.covariance(at), answer.covariance), Tolerance);
  // The precision draws the sum of what was taken and what is left to 0: nothing is left.
  const SmallMotion left = process.remainingMotion(motion.rotation);
  EXPECT_LT(glm::length(left.rotation) + glm::length(left.translation), 1e-9);
}

TEST(Process, LeavingOutInClosedFormIsLeavingOut)
{
  for (const bool moves : { false, true })
  {
    Scatter scatter(6);
    std::vector<Row> rows = someRows(scatter, 9, 4);
    const Matern kernel{ 40.0, 1.0 };
    const RigidMean mean{ glm::dvec3(0.0), 0.0 };
    Process process(kernel);
    process.setRows(rows, moves ? std::optional(mean) : std::nullopt);
    if (moves)
    {
      const SmallMotion motion = process.remainingMotion(glm::dvec3(0.0));
      std::vector<double> values;
      for (Row& row : rows)
      {
        row.value -=
          glm::dot(row.axis, motion.translation + glm::cross(motion.rotation, row.point));
        values.push_back(row.value);
      }
      process.setValues(values);
    }
    for (const std::size_t first : { 0u, 12u, 24u })
    {
      std::vector<Row> others = rows;
      others.erase(others.begin() + first, others.begin() + first + 3);
      const Answer answer = answerOf(kernel, others, rows[first].point, moves ? &mean : nullptr);
      const glm::dvec3 value(rows[first].value, rows[first + 1].value, rows[first + 2].value);
      const LeftOut left = process.leftOut(first);
      EXPECT_LT(difference(left.error, value - answer.displacement), Tolerance);
      EXPECT_LT(difference(left.covariance, answer.covariance + glm::dmat3(rows[first].variance)),
        Tolerance);
    }
  }
}

TEST(Process, TooManyRowsAreOneSentence)
{
  Process process({ 40.0, 1.0 });
  EXPECT_EQ(problemOf([&] { process.setRows(std::vector<Row>(MostRows + 1)); }),
    "The measurements have 6001 rows; at most 6000 can be solved together (a point has 3, a traced "
    "point 1)");
}
