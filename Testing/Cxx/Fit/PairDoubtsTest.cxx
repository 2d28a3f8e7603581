// SPDX-License-Identifier: BSD-3-Clause
// Proves that pairs that say nothing about a part of the motion, wrong and exchanged pairs, and
// lists in other axes, units or frames are named, that the deviation covers where the tissue may
// be, and that good measurements raise no doubt.
#include "Filters/Fit/PairDoubts.h"
#include "Filters/Fit/Fit.h"

#include <glm/trigonometric.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace brainshift;

namespace
{
using Points = std::vector<glm::dvec3>;

// A head of 300 mm from corner to corner, its middle at the origin.
const Grid Head{ glm::ivec3(101), glm::dvec3(-50.0 * std::sqrt(3.0)), glm::dvec3(std::sqrt(3.0)) };
const RigidPose Moved{ rotationFrom({ 0.09, 0.0, 0.175 }), { 4.0, -6.0, 3.0 } };
const Points Good{ { -60, -40, 20 }, { -60, 40, 20 }, { 60, 40, 25 }, { 60, -40, 60 }, { 0, 0, 90 },
  { 10, 80, 40 }, { -5, -90, 35 }, { 30, 20, -10 } };
const Points Rectangle{ { -60, -40, 20 }, { -60, 40, 20 }, { 60, 40, 20 }, { 60, -40, 20 } };
const Points Line{ { 0, 0, 0 }, { 10, 10, 10 }, { 20, 20, 20 }, { 35, 35, 35 } };

Measurements pairsOf(const Points& rest, const RigidPose& pose,
  const glm::dmat3& axes = glm::dmat3(1.0), double scale = 1.0)
{
  Measurements measured;
  for (const glm::dvec3& point : rest)
  {
    measured.landmarks.push_back({ point, scale * (axes * pose.apply(point)) });
  }
  return measured;
}

glm::dmat3 signs(double x, double y, double z)
{
  return { { x, 0, 0 }, { 0, y, 0 }, { 0, 0, z } };
}

std::string doubts(const Measurements& measured)
{
  std::string text;
  for (const std::string& sentence : doubtsAbout(measured, {}, Head))
  {
    text += sentence + ". ";
  }
  return text;
}

bool has(const std::string& text, const std::string& words)
{
  return text.find(words) != std::string::npos;
}

// The largest share of the error of a fit in the radius of the ball that holds 95 %.
double largestShare(const Points& rest, const RigidPose& pose)
{
  Fit fit;
  fit.solve(pairsOf(rest, pose), {});
  double share = 0.0;
  for (const glm::dvec3& at : Good)
  {
    const double error = glm::distance(fit.measuredFromRest(at), pose.apply(at));
    share = std::max(share, error / (DeviationsOfBall95 * fit.deviation(at)));
  }
  return share;
}
}

TEST(PairDoubts, OfGoodPairsAreNone)
{
  EXPECT_EQ(doubts(pairsOf(Good, Moved)), "");
  EXPECT_EQ(doubts(pairsOf(Rectangle, Moved)), "");
  EXPECT_EQ(doubts({}), "");
}

TEST(PairDoubts, NameTheRotationThatIsOpen)
{
  const Points almost{ { 0, 0, 0 }, { 10, 10, 10 }, { 20, 20, 20.05 }, { 35, 35, 35 } };
  const Points thick{ { 0, 0, 0 }, { 40, 1.5, 0 }, { 80, -1.5, 0 }, { 120, 0, 1 } };
  const Points two{ { 10, 20, 30 }, { 40, 20, 30 } };
  for (const Points& points : { Line, almost, thick, two })
  {
    EXPECT_TRUE(has(doubts(pairsOf(points, Moved)), "rotation about it is not determined"))
      << doubts(pairsOf(points, Moved));
  }
  EXPECT_TRUE(has(doubts(pairsOf(Line, Moved)), "along 0.577 0.577 0.577") ||
    has(doubts(pairsOf(Line, Moved)), "along -0.577 -0.577 -0.577"));
  const Points heap(4, glm::dvec3(10.0, 20.0, 30.0));
  EXPECT_TRUE(has(doubts(pairsOf(heap, Moved)), "no rotation is determined"));
  EXPECT_TRUE(has(doubts(pairsOf({ heap[0] }, Moved)), "no rotation is determined"));
  Measurements bent = pairsOf(Line, Moved); // the volume is assumed to be aligned
  bent.pins = { { 0.0, 0.0, 0.0 } };
  EXPECT_EQ(doubts(bent), "");
}

// Whatever the open rotation was, the ball of 95 % holds the tissue.
TEST(PairDoubts, AnOpenRotationWidensTheDeviation)
{
  const Points two{ { 10, 20, 30 }, { 40, 20, 30 } };
  const Points one{ { 10, 20, 30 } };
  for (const double angle : { 0.2, 0.8, 2.0, 3.1 })
  {
    const RigidPose aboutLine{ rotationFrom(glm::normalize(glm::dvec3(1.0)) * angle),
      { 4.0, -6.0, 3.0 } };
    const RigidPose aboutX{ rotationFrom({ angle, 0.0, 0.0 }), { 4.0, -6.0, 3.0 } };
    EXPECT_LT(largestShare(Line, aboutLine), 1.0) << angle;
    EXPECT_LT(largestShare(two, aboutX), 1.0) << angle;
    EXPECT_LT(largestShare(one, aboutLine), 1.0) << angle;
  }
  Fit fit;
  fit.solve(pairsOf(Rectangle, Moved), {});
  EXPECT_LT(fit.deviation({ 0.0, 0.0, 90.0 }), 4.0) << "it is determined";
  fit.solve(pairsOf(Line, Moved), {});
  EXPECT_LT(fit.deviation({ 15.0, 15.0, 15.0 }), 2.0) << "on the line";
}

TEST(PairDoubts, NameAxesThatWouldFit)
{
  for (const Points& points : { Good, Rectangle })
  {
    const std::string lps = doubts(pairsOf(points, Moved, signs(-1, -1, 1)));
    EXPECT_TRUE(has(lps, "-x -y z in place of x y z")) << lps;
  }
  EXPECT_TRUE(has(doubts(pairsOf(Good, Moved, signs(-1, 1, 1))), "-x y z in place"));
  EXPECT_TRUE(has(doubts(pairsOf(Good, Moved, signs(1, 1, -1))), "x y -z in place"));
  const glm::dmat3 exchanged({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 });
  EXPECT_TRUE(has(doubts(pairsOf(Good, Moved, exchanged)), "y x z in place"));
  // A tracker may lie about any axes, and mirrors nothing.
  const std::vector<double> weights(Good.size(), 1.0);
  const auto axesOf = [&](const glm::dmat3& axes) {
    Points measured;
    for (const PointPair& pair : pairsOf(Good, Moved, axes).landmarks)
    {
      measured.push_back(pair.measured);
    }
    return betterAxes(Good, measured, weights, true);
  };
  EXPECT_EQ(axesOf(signs(-1, -1, 1)), "");
  EXPECT_EQ(axesOf(rotationFrom({ 1.0, 2.0, 0.5 })), "");
  EXPECT_EQ(axesOf(signs(1, -1, 1)), "-x y z") << "any of three mirrors and a rotation fit";
}

TEST(PairDoubts, NamePlacesThatRepeat)
{
  Measurements measured = pairsOf(Good, Moved);
  measured.landmarks[3].rest = measured.landmarks[1].rest;
  EXPECT_TRUE(has(doubts(measured), "Landmarks 2 and 4 are at the same place"));
  measured.landmarks[3].weight = 0.0;
  EXPECT_EQ(doubts(measured), "");
}

TEST(PairDoubts, AskAboutUnits)
{
  Points metres;
  for (const glm::dvec3& point : Good)
  {
    metres.push_back(point / 1000.0);
  }
  EXPECT_TRUE(has(doubts(pairsOf(metres, {})), "within 0.231 mm; check that they are in mm"))
    << doubts(pairsOf(metres, {}));
  Points micrometres;
  for (const glm::dvec3& point : Good)
  {
    micrometres.push_back(point * 1000.0);
  }
  EXPECT_TRUE(
    has(doubts(pairsOf(micrometres, {})), "diagonal has 300 mm; check that they are in mm"));
  EXPECT_TRUE(has(doubts(pairsOf(Good, {}, glm::dmat3(1.0), 0.1)), "check that both are in mm"));
  EXPECT_TRUE(has(doubts(pairsOf(Good, {}, glm::dmat3(1.0), 0.001)), "check that they are in mm"));
}

// Tissue that bends is no scale, no outlier and no exchange.
TEST(PairDoubts, OfTissueThatBendsAreNone)
{
  for (const double shift : { 4.0, 8.0, 12.0 })
  {
    Measurements measured = pairsOf(Good, Moved);
    for (PointPair& pair : measured.landmarks)
    {
      const double away = glm::distance(pair.rest, Good[4]) / 60.0;
      pair.measured.z -= shift * std::exp(-0.5 * away * away);
    }
    EXPECT_EQ(doubts(measured), "") << shift;
  }
}

TEST(PairDoubts, NameMeasuredPlacesThatRepeat)
{
  Measurements measured = pairsOf(Good, Moved);
  measured.landmarks[3].measured = measured.landmarks[1].measured;
  EXPECT_TRUE(has(doubts(measured), "Landmarks 2 and 4 are measured at the same place, at rest 1"))
    << doubts(measured);
}

TEST(PairDoubts, NameTheOnePairThatIsOff)
{
  Measurements measured = pairsOf(Good, Moved);
  measured.landmarks[2].measured.x += 40.0;
  EXPECT_TRUE(has(doubts(measured), "Landmark 3 is measured 40 mm from where")) << doubts(measured);
  EXPECT_TRUE(has(doubts(measured), "off by")) << doubts(measured);
  measured.pins = { { 0.0, 0.0, 0.0 } }; // the volume is assumed to be aligned, and bends
  EXPECT_EQ(doubts(measured), "");
}

TEST(PairDoubts, NameExchangedPairs)
{
  Measurements measured = pairsOf(Good, Moved);
  std::swap(measured.landmarks[1].measured, measured.landmarks[5].measured);
  EXPECT_TRUE(has(doubts(measured), "Landmarks 2 and 6 look exchanged")) << doubts(measured);
}

TEST(PairDoubts, NameAScaleThatExplainsTheRest)
{
  for (const double scale : { 1.3, 1.5, 1.9, 0.6, 0.75 })
  {
    const std::string text = doubts(pairsOf(Good, Moved, glm::dmat3(1.0), scale));
    EXPECT_TRUE(has(text, "times as far apart as those at rest")) << scale << text;
  }
  EXPECT_EQ(doubts(pairsOf(Good, Moved, glm::dmat3(1.0), 1.1)), "");
}

namespace
{
// Each list of places in turn, with landmarks that are good where there are any.
struct OneList
{
  const char* name;
  void (*put)(Measurements& measured, const Points& points);
};

const OneList Lists[] = {
  { "The traced points are ", [](Measurements& m, const Points& points) { m.traces = points; } },
  { "The pins are ", [](Measurements& m, const Points& points) { m.pins = points; } },
  { "The pulls are ",
    [](Measurements& m, const Points& points) {
      for (const glm::dvec3& point : points)
      {
        m.pulls.push_back({ point, point * 1.05 });
      }
    } },
  { "The landmarks at rest are ",
    [](Measurements& m, const Points& points) { m.landmarks = pairsOf(points, Moved).landmarks; } },
};

std::string doubtsOf(const OneList& list, const Points& points)
{
  Measurements measured;
  list.put(measured, points);
  return doubts(measured);
}

Points scaled(double factor, const glm::dvec3& shift = glm::dvec3(0.0))
{
  Points points;
  for (const glm::dvec3& point : Good)
  {
    points.push_back(factor * point + shift);
  }
  return points;
}
}

TEST(PlaceDoubts, NameEachListInOtherUnitsOrFrames)
{
  for (const OneList& list : Lists)
  {
    EXPECT_EQ(doubtsOf(list, Good), "");
    const std::string metres = doubtsOf(list, scaled(0.001));
    EXPECT_TRUE(has(metres, list.name + std::string("within 0.231 mm; check"))) << metres;
    const std::string cm = doubtsOf(list, scaled(0.1));
    EXPECT_TRUE(has(cm, list.name + std::string("within 2")) && has(cm, "not in cm")) << cm;
    const std::string far = doubtsOf(list, scaled(1.0, { 0.0, 300.0, 0.0 }));
    EXPECT_TRUE(has(far, list.name + std::string("up to ")) && has(far, "mm outside the volume"))
      << far;
    // A craniotomy, far from the origin or at it, is no wrong unit.
    EXPECT_EQ(doubtsOf(list, scaled(0.1, { 30.0, 20.0, 60.0 })), "");
  }
}

TEST(PlaceDoubts, NameListsOfVoxels)
{
  const Points voxels{ { 15, 27, 61 }, { 15, 73, 61 }, { 84, 73, 64 }, { 84, 27, 84 } };
  for (const OneList& list : Lists)
  {
    EXPECT_TRUE(has(doubtsOf(list, voxels), "as voxels have")) << doubtsOf(list, voxels);
    const Points some{ { 15, 27, 61 }, { 15, -73, 61 }, { 84, 73, 64 } };
    EXPECT_EQ(doubtsOf(list, some), "");
  }
}

TEST(PlaceDoubts, NameListsWithinOneVoxel)
{
  const Grid coarse = withDimensions(Head, glm::ivec3(31));
  for (const OneList& list : Lists)
  {
    Measurements measured;
    list.put(measured, scaled(0.0175, { 20.0, 20.0, 40.0 }));
    const std::vector<std::string> sentences = doubtsAbout(measured, {}, coarse);
    ASSERT_FALSE(sentences.empty()) << list.name;
    EXPECT_TRUE(has(sentences.back(), "within 4.04 mm, which is one voxel")) << sentences.back();
  }
}

TEST(PlaceDoubts, KnowNoPlaceOfAMeasuredFrame)
{
  EXPECT_EQ(doubts(pairsOf(Good, { glm::dmat3(1.0), { 0.0, 500.0, 0.0 } })), "");
  Measurements measured = pairsOf(Good, { glm::dmat3(1.0), { 0.0, 500.0, 0.0 } });
  measured.pins = { { 0.0, 0.0, 0.0 } }; // it is that of the volume
  EXPECT_TRUE(has(doubts(measured), "The measured landmarks are up to")) << doubts(measured);
  measured.pins = { { 900.0, 0.0, 0.0 } };
  EXPECT_TRUE(has(doubts(measured), "The pins are up to 813 mm outside")) << doubts(measured);
}
