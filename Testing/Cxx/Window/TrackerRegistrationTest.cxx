// SPDX-License-Identifier: BSD-3-Clause
// Paired points give back the motion that made them; too few points, or those of one line, give a
// sentence and no motion.
#include "Interaction/Pointer/TrackerRegistration.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>

using namespace brainshift;

namespace
{
const RigidPose True{ rotationFrom({ 0.3, -0.9, 0.5 }), { 12.0, -70.0, 33.0 } };

void add(TrackerRegistration& registration, const glm::dvec3& tracker, const glm::dvec3& error = {})
{
  registration.touch(tracker);
  registration.mark(static_cast<int>(registration.pairs().size()) - 1, True.apply(tracker) + error);
}
}

TEST(TrackerRegistration, FindsTheMotion)
{
  TrackerRegistration registration;
  EXPECT_FALSE(registration.isRegistered());
  EXPECT_EQ(registration.imageFromTracker().apply({ 1, 2, 3 }), glm::dvec3(1, 2, 3));
  add(registration, { 100, 0, 0 });
  add(registration, { 0, 80, 0 });
  EXPECT_EQ(registration.problem(), "The registration needs 3 pairs; 2 are given.");
  add(registration, { 0, 0, 90 });
  ASSERT_TRUE(registration.isRegistered());
  EXPECT_EQ(registration.problem(), "");
  EXPECT_LT(registration.error(), 1e-9);
  const glm::dvec3 other(5, -6, 7);
  EXPECT_LT(glm::distance(registration.imageFromTracker().apply(other), True.apply(other)), 1e-9);
  registration.remove(1);
  EXPECT_FALSE(registration.isRegistered());
}

TEST(TrackerRegistration, TellsEachResidual)
{
  TrackerRegistration registration;
  add(registration, { 100, 0, 0 });
  add(registration, { -100, 0, 0 });
  add(registration, { 0, 100, 0 });
  add(registration, { 0, -100, 0 }, { 4, 0, 0 });
  double squares = 0.0;
  for (const TrackerRegistration::Pair& pair : registration.pairs())
  {
    EXPECT_NEAR(pair.residual,
      glm::distance(
        registration.imageFromTracker().apply(pair.tracker), pair.image.value_or(glm::dvec3(0.0))),
      1e-12);
    squares += pair.residual * pair.residual;
  }
  EXPECT_GT(registration.error(), 0.5);
  EXPECT_NEAR(registration.error(), std::sqrt(squares / 4.0), 1e-12);
}

TEST(TrackerRegistration, RefusesPointsOfOneLine)
{
  TrackerRegistration registration;
  for (const double at : { 0.0, 30.0, 50.0, 90.0 })
  {
    add(registration, { at, 2.0 * at, -at });
  }
  EXPECT_FALSE(registration.isRegistered());
  EXPECT_NE(registration.problem().indexOf("one line"), -1);
  EXPECT_TRUE(std::isnan(registration.error()));
  add(registration, { 0, 0, 60 });
  EXPECT_TRUE(registration.isRegistered());
}

// Either set of points leaves the rotation around its line open, whatever the other set is.
TEST(TrackerRegistration, RefusesOneSetOfPointsOnALine)
{
  const glm::dvec3 line[] = { { 0, 0, 0 }, { 30, 60, -30 }, { 50, 100, -50 } };
  const glm::dvec3 corner[] = { { 0, 0, 0 }, { 80, 0, 0 }, { 0, 70, 0 } };
  for (const bool isTrackerOnLine : { false, true })
  {
    TrackerRegistration registration;
    for (int i = 0; i < 3; ++i)
    {
      registration.touch(isTrackerOnLine ? line[i] : corner[i]);
      registration.mark(i, isTrackerOnLine ? corner[i] : line[i]);
    }
    EXPECT_FALSE(registration.isRegistered()) << isTrackerOnLine;
    EXPECT_NE(registration.problem().indexOf("one line"), -1) << isTrackerOnLine;
  }
}

TEST(TrackerRegistration, NamesAMirrorAndANearLine)
{
  const glm::dvec3 points[] = { { 100, 0, 0 }, { 0, 80, 0 }, { 0, 0, 90 }, { -20, -60, 10 } };
  TrackerRegistration good;
  TrackerRegistration mirrored;
  for (int i = 0; i < 4; ++i)
  {
    add(good, points[i]);
    mirrored.touch(points[i]);
    mirrored.mark(i, True.apply(points[i] * glm::dvec3(1, -1, 1)));
  }
  EXPECT_EQ(good.doubt(), "");
  EXPECT_TRUE(mirrored.isRegistered());
  EXPECT_NE(mirrored.doubt().indexOf("mirror"), -1);
  TrackerRegistration line;
  for (const double at : { 0.0, 50.0, 100.0, 150.0 })
  {
    add(line, { at, at == 50.0 ? 8.0 : 0.0, 0.0 });
  }
  EXPECT_TRUE(line.isRegistered());
  EXPECT_NE(line.doubt().indexOf("near to one line"), -1);
  line.remove(0);
  line.remove(0);
  EXPECT_EQ(line.doubt(), "");
}

TEST(TrackerRegistration, PointWithoutPartnerDoesNotCount)
{
  TrackerRegistration registration;
  add(registration, { 100, 0, 0 });
  add(registration, { 0, 80, 0 });
  registration.touch({ 0, 0, 90 });
  EXPECT_FALSE(registration.isRegistered());
  registration.mark(2, True.apply({ 0, 0, 90 }));
  EXPECT_TRUE(registration.isRegistered());
}
