// SPDX-License-Identifier: BSD-3-Clause
// Proves that traced points bring the cortex to themselves along its normal, let it slide, and are
// averaged where they are many; that anchors hold the cortex elsewhere; and that the steps end
// where the equations hold. The brain is a ball of 70 mm.
#include "Filters/Fit/Anchors.h"
#include "Filters/Fit/Fit.h"
#include "Filters/Fit/TraceRows.h"
#include "Testing/Cxx/Fit/DenseReference.h"

#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr double Radius = 70.0;

std::optional<SurfacePoint> onBall(const glm::dvec3& rest, std::size_t)
{
  const glm::dvec3 normal = glm::normalize(rest);
  return SurfacePoint{ Radius * normal, normal };
}

// Points all over the ball.
std::vector<SurfacePoint> ballPoints(int count)
{
  std::vector<SurfacePoint> points;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double turn = 2.399963229728653 * i; // the golden angle
    const double flat = std::sqrt(1.0 - z * z);
    const glm::dvec3 normal(flat * std::cos(turn), flat * std::sin(turn), z);
    points.push_back({ Radius * normal, normal });
  }
  return points;
}

const OpeningBall Opening{ { 0.0, 0.0, Radius }, 35.0 };

bool isNearOpening(const glm::dvec3& rest)
{
  return glm::distance(rest, Opening.centre) < Opening.radiusMm + AnchorMarginMm;
}

// How the ball sags: 8 mm at the top, nothing beyond the opening.
glm::dvec3 sag(const glm::dvec3& rest)
{
  const double away = std::min(1.0, glm::distance(rest, Opening.centre) / 48.0);
  return { 0.0, 0.0, -8.0 * std::pow(1.0 - away * away, 2) };
}

// Points of the sagged cortex under the opening.
std::vector<glm::dvec3> tracesOf(std::size_t count)
{
  std::vector<glm::dvec3> traces;
  for (const SurfacePoint& point : ballPoints(static_cast<int>(16 * count)))
  {
    if (glm::distance(point.position, Opening.centre) < Opening.radiusMm && traces.size() < count)
    {
      traces.push_back(point.position + sag(point.position));
    }
  }
  return traces;
}

Measurements sagged(std::size_t count)
{
  Measurements measured;
  measured.traces = tracesOf(count);
  measured.anchors = chooseAnchors(ballPoints(5000), isNearOpening);
  return measured;
}

// Distance (mm) along the normal between the fitted cortex and the true one.
double missAt(const Fit& fit, const SurfacePoint& at)
{
  return std::abs(glm::dot(at.normal, fit.bend(at.position) - sag(at.position)));
}
}

TEST(TraceFit, BringsTheCortexToTheTraces)
{
  const Measurements measured = sagged(300);
  ASSERT_EQ(measured.traces.size(), 300u);
  Fit fit;
  fit.solve(measured, {}, onBall);
  EXPECT_GE(fit.steps(), 2);
  TraceProjection projection(measured.traces, onBall);
  for (int i = 0; i < 20; ++i) // each one is a Newton step
  {
    projection.project(fit.field());
  }
  double squares = 0.0;
  for (const TraceFoot& foot : projection.feet())
  {
    ASSERT_TRUE(foot.counts);
    const double left = foot.value - glm::dot(foot.normal, fit.field().displacement(foot.foot));
    squares += left * left / 300.0;
  }
  EXPECT_LT(std::sqrt(squares), 0.3);
  for (const SurfacePoint& point : ballPoints(500))
  {
    const double away = glm::distance(point.position, Opening.centre);
    if (away < 30.0)
    {
      EXPECT_LT(missAt(fit, point), 0.6) << away;
    }
    else if (away > 60.0)
    {
      EXPECT_LT(missAt(fit, point), 0.5) << away;
    }
  }
}

// A hand that moves a pull beside traces: one set of equations, and nearly the same answer.
TEST(TraceFit, AStartNearbyNeedsOneStep)
{
  Measurements measured = sagged(300);
  measured.pulls = { { { 0.0, 0.0, 40.0 }, { 0.0, 0.0, 38.0 } } };
  Fit before;
  before.solve(measured, {}, onBall);
  measured.pulls[0].measured += glm::dvec3(2.0, 0.0, -1.0);
  Fit whole;
  whole.solve(measured, {}, onBall);
  const auto apart = [](const Fit& one, const Fit& other) {
    double most = 0.0;
    for (const SurfacePoint& point : ballPoints(500))
    {
      most = std::max(most, glm::distance(one.bend(point.position), other.bend(point.position)));
    }
    return most;
  };
  const double change = apart(whole, before);
  EXPECT_GT(change, 0.8);
  Fit live;
  live.solve(measured, {}, onBall, &before.field());
  EXPECT_EQ(live.steps(), 1);
  EXPECT_GT(whole.steps(), 2);
  EXPECT_LT(apart(whole, live), 0.5 * change);
  Fit next; // the hand goes on
  next.solve(measured, {}, onBall, &live.field());
  EXPECT_LT(apart(whole, next), 0.5 * apart(whole, live));
}

TEST(TraceFit, AnchorsHoldTheCortexElsewhere)
{
  Measurements measured = sagged(300);
  const auto farMiss = [&] {
    Fit fit;
    fit.solve(measured, {}, onBall);
    double most = 0.0;
    for (const SurfacePoint& point : ballPoints(500))
    {
      const bool isFar = glm::distance(point.position, Opening.centre) > 60.0;
      most = isFar ? std::max(most, missAt(fit, point)) : most;
    }
    return most;
  };
  EXPECT_LT(farMiss(), 0.5);
  measured.anchors.clear();
  EXPECT_GT(farMiss(), 1.5);
}

TEST(TraceFit, EndsWhereTheEquationsHold)
{
  const Measurements measured = sagged(60);
  FitSettings settings;
  settings.steps = 60;
  settings.stepToleranceMm = 1e-12;
  Fit fit;
  fit.solve(measured, settings, onBall);
  // Rows that are made from the result give the result again.
  TraceProjection projection(measured.traces, onBall);
  for (int i = 0; i < 40; ++i)
  {
    projection.project(fit.field());
  }
  std::vector<Row> rows(fit.field().rows().begin(),
    fit.field().rows().begin() + static_cast<std::ptrdiff_t>(measured.anchors.size()));
  for (const TraceFoot& foot : projection.feet())
  {
    rows.push_back({ foot.foot, foot.normal, foot.value, 0.49 });
  }
  for (const glm::dvec3 at : { glm::dvec3(0, 0, 70), glm::dvec3(20, 5, 60), glm::dvec3(0, 40, 0) })
  {
    const glm::dvec3 wanted = answerOf(settings.surfaceKernel, rows, at).displacement;
    EXPECT_LT(glm::distance(fit.bend(at), wanted), 1e-6);
  }
}

TEST(TraceFit, NormalsAreThoseOfTheBentCortex)
{
  Measurements measured;
  measured.pulls = { { { 0, 0, 70 }, { 0, 5, 55 } }, { { 30, 0, 60 }, { 30, 0, 62 } } };
  Fit fit;
  fit.solve(measured, {});
  const glm::dvec3 foot = Radius * glm::normalize(glm::dvec3(0.3, 0.1, 1.0));
  const auto bent = [&](const glm::dvec3& rest) { return rest + fit.bend(rest); };
  TraceProjection projection({ bent(foot) }, onBall);
  for (int i = 0; i < 30; ++i)
  {
    projection.project(fit.field());
  }
  const TraceFoot& found = projection.feet().front();
  ASSERT_LT(glm::distance(found.foot, foot), 1e-9);
  EXPECT_LT(glm::dot(found.normal, glm::normalize(foot)), 0.99); // it did turn
  for (const glm::dvec3 aside : { glm::dvec3(1, 0, -0.3), glm::dvec3(0, 1, -0.1) })
  {
    const double step = 1e-4; // along the ball
    const glm::dvec3 slope = glm::normalize(bent(foot + step * aside) - bent(foot - step * aside));
    EXPECT_NEAR(glm::dot(found.normal, slope), 0.0, 1e-6);
  }
}

TEST(TraceFit, FewStepsAreEnough)
{
  const Measurements measured = sagged(300);
  Fit quick;
  quick.solve(measured, {}, onBall);
  FitSettings settings;
  settings.steps = 40;
  settings.stepToleranceMm = 1e-9;
  Fit thorough;
  thorough.solve(measured, settings, onBall);
  for (const SurfacePoint& point : ballPoints(200))
  {
    EXPECT_LT(glm::distance(quick.bend(point.position), thorough.bend(point.position)), 0.05);
  }
}

TEST(TraceFit, ManyTracesAreAveraged)
{
  const Measurements few = sagged(450);
  const Measurements many = sagged(3000);
  Fit one;
  Fit other;
  one.solve(few, {}, onBall);
  other.solve(many, {}, onBall);
  EXPECT_LT(other.field().rows().size(), one.field().rows().size());
  for (const SurfacePoint& point : ballPoints(300))
  {
    EXPECT_LT(glm::distance(one.bend(point.position), other.bend(point.position)), 0.5);
  }
}

TEST(TraceFit, ABinHasTheVarianceOfItsMeanAndAFloor)
{
  FitSettings settings;
  settings.tracesWithoutBins = 1;
  const std::vector<glm::dvec3> traces{ { 1, 1, 70 }, { 2, 1, 72 }, { 1, 2, 71 }, { 8, 1, 70 } };
  const TraceBins bins(traces, settings, 0.7);
  std::vector<TraceFoot> feet(4);
  for (std::size_t i = 0; i < feet.size(); ++i)
  {
    feet[i] = { traces[i], traces[i], { 0, 0, 1 }, 1.0 + static_cast<double>(i), i != 1 };
  }
  const std::vector<Row> rows = bins.rows(feet);
  ASSERT_EQ(rows.size(), 2u); // the second point does not count
  EXPECT_NEAR(rows[0].value, 2.0, 1e-12);
  EXPECT_NEAR(rows[0].variance, 0.49 / 2.0 + 0.25, 1e-12);
  EXPECT_NEAR(rows[1].variance, 0.49 + 0.25, 1e-12);
  EXPECT_NEAR(rows[1].value, 4.0, 1e-12);
}

// The two banks of a groove in one bin: their mean has no direction to move along.
TEST(TraceFit, ABinWithOpposedNormalsGivesNoRow)
{
  FitSettings settings;
  settings.tracesWithoutBins = 1;
  const std::vector<glm::dvec3> traces{ { 1, 1, 70 }, { 2, 1, 71 } };
  const TraceBins bins(traces, settings, 0.7);
  for (const double lean : { 0.0, 0.05, 0.2 }) // of the second bank from the direction opposed
  {
    const glm::dvec3 second = glm::normalize(glm::dvec3(2.0 * lean, 0.0, -1.0));
    const std::vector<Row> rows = bins.rows({ { traces[0], traces[0], { 0, 0, 1 }, 1.0, true },
      { traces[1], traces[1], second, 1.0, true } });
    EXPECT_EQ(rows.size(), lean > 0.1 ? 1u : 0u) << lean;
  }
}

TEST(TraceFit, OrderDoesNotMatter)
{
  Measurements measured = sagged(700); // in bins
  measured.pulls = { { { 0, 0, 60 }, { 1, 0, 55 } }, { { 10, 0, 60 }, { 10, 2, 56 } } };
  Fit one;
  one.solve(measured, {}, onBall);
  std::reverse(measured.traces.begin(), measured.traces.end());
  std::reverse(measured.pulls.begin(), measured.pulls.end());
  std::reverse(measured.anchors.begin(), measured.anchors.end());
  Fit other;
  other.solve(measured, {}, onBall);
  for (const SurfacePoint& point : ballPoints(50))
  {
    EXPECT_LT(glm::distance(one.bend(point.position), other.bend(point.position)), 1e-8);
  }
}

TEST(TraceFit, TracesWithoutACortexDoNotCount)
{
  Measurements measured;
  measured.traces = { { 1, 2, 3 }, { 4, 5, 6 } };
  Fit fit;
  fit.solve(measured, {});
  EXPECT_EQ(fit.bend({ 4, 5, 6 }), glm::dvec3(0.0));
  const auto nothing = [](const glm::dvec3&, std::size_t) -> std::optional<SurfacePoint> {
    return {};
  };
  fit.solve(measured, {}, nothing);
  EXPECT_EQ(fit.bend({ 1, 2, 3 }), glm::dvec3(0.0));
}

TEST(Anchors, AreSpreadBeyondTheOpening)
{
  const std::vector<SurfacePoint> anchors = chooseAnchors(ballPoints(20000), isNearOpening);
  EXPECT_NEAR(static_cast<double>(anchors.size()), 250.0, 26.0);
  double nearest = Radius;
  for (const SurfacePoint& one : anchors)
  {
    EXPECT_FALSE(isNearOpening(one.position));
  }
  // From each place beyond the opening the next anchor is near.
  for (const SurfacePoint& place : ballPoints(300))
  {
    nearest = Radius;
    for (const SurfacePoint& one : anchors)
    {
      nearest = std::min(nearest, glm::distance(one.position, place.position));
    }
    if (!isNearOpening(place.position))
    {
      EXPECT_LT(nearest, 20.0);
    }
  }
  EXPECT_TRUE(chooseAnchors({}, isNearOpening).empty());
  EXPECT_EQ(chooseAnchors(ballPoints(20), [](const glm::dvec3&) { return false; }).size(), 20u);
}

// Where they were as far apart as elsewhere, cortex between them and the opening moved by 0.5 mm.
TEST(Anchors, LeaveNoGapBesideTheOpening)
{
  const std::vector<SurfacePoint> places = ballPoints(5000);
  const std::vector<SurfacePoint> anchors = chooseAnchors(places, isNearOpening);
  double largest = 0.0;
  for (const SurfacePoint& place : places)
  {
    const auto isOpenBeside = [&](const SurfacePoint& other) {
      return isNearOpening(other.position) && glm::distance(other.position, place.position) < 4.0;
    };
    if (!isNearOpening(place.position) && std::any_of(places.begin(), places.end(), isOpenBeside))
    {
      double nearest = Radius;
      for (const SurfacePoint& one : anchors)
      {
        nearest = std::min(nearest, glm::distance(one.position, place.position));
      }
      largest = std::max(largest, nearest);
    }
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(largest, 9.0);
}

TEST(Anchors, BallHoldsPositions)
{
  const OpeningBall ball = ballAround({ { 0, 0, 0 }, { 10, 0, 0 } });
  EXPECT_EQ(ball.centre, glm::dvec3(5, 0, 0));
  EXPECT_EQ(ball.radiusMm, 5.0);
  EXPECT_LT(ballAround({}).radiusMm, 0.0);
  Measurements measured;
  measured.traces = { { 0, 0, 0 }, { 10, 0, 0 } };
  measured.pulls = { { { 90, 0, 0 }, { 91, 0, 0 }, 0.0 } }; // off
  EXPECT_EQ(openingOf(measured).centre, ball.centre);
  Grid grid;
  grid.origin = glm::dvec3(-40.0);
  grid.spacing = glm::dvec3(10.0);
  grid.dimensions = glm::ivec3(9);
  Lattice moved = makeLattice(grid, 0);
  std::fill(moved.displacements.begin(), moved.displacements.end(), glm::vec3(0.0f, 0.0f, 7.0f));
  measured.base = std::make_shared<const FitBase>(moved);
  EXPECT_LT(glm::distance(openingOf(measured).centre, glm::dvec3(5, 0, -7)), 1e-3);
}
