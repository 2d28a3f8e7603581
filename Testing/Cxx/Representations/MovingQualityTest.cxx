// SPDX-License-Identifier: BSD-3-Clause
// Proves that a moving picture leaves out as much as it must, and no more.
#include "Representations/Picture/MovingQuality.h"

#include <gtest/gtest.h>

using namespace brainshift;

namespace
{
double seconds(const MovingQuality& quality, double full)
{
  return full / (quality.imageScale * quality.imageScale) / (1 << quality.stepDoublings);
}
}

TEST(MovingQuality, LeavesNothingOutWhereThereIsTime)
{
  for (const double full : { 0.0, 0.01, 0.05 })
  {
    const MovingQuality quality = movingQuality(full, 0.05);
    EXPECT_EQ(quality.imageScale, 1) << full;
    EXPECT_EQ(quality.stepDoublings, 0) << full;
  }
}

TEST(MovingQuality, HoldsTheTimeWithAsFewChangesAsCan)
{
  for (double full = 0.06; full < 0.05 * 64.0; full *= 1.3)
  {
    MovingQuality quality = movingQuality(full, 0.05);
    EXPECT_LE(seconds(quality, full), 0.05 * 1.000001) << full;
    EXPECT_TRUE(quality.stepDoublings == 0 || quality.imageScale == LargestImageScale) << full;
    // One change less would be too slow.
    (quality.stepDoublings > 0 ? quality.stepDoublings : quality.imageScale) -= 1;
    EXPECT_GT(seconds(quality, full), 0.05) << full;
  }
}

TEST(MovingQuality, StopsWhereNothingCouldBeSeenAnyMore)
{
  const MovingQuality quality = movingQuality(1e9, 0.01);
  EXPECT_EQ(quality.imageScale, LargestImageScale);
  EXPECT_EQ(quality.stepDoublings, MostStepDoublings);
}

TEST(MovingQuality, LeavesTheWindowItsTime)
{
  const double usual = allowedSeconds(5.0, 0.02, 0.0);
  EXPECT_GT(usual, 0.02);
  EXPECT_LT(usual, 1.0 / 15.0 - 0.02);
  EXPECT_NEAR(allowedSeconds(5.0, 0.03, 0.005), usual - 0.015, 1e-12);
  EXPECT_NEAR(allowedSeconds(30.0, 0.01, 0.0), 1.0 / 30.0 - 0.01, 1e-12);
  EXPECT_GT(allowedSeconds(5.0, 1.0, 1.0), 0.0) << "an image has to be cast";
}

TEST(WindowPace, FollowsTheWindowAndNotTheHand)
{
  WindowPace pace;
  for (int i = 0; i < 30; ++i)
  {
    pace.learn(0.012, 0.02); // two processors at work
  }
  EXPECT_NEAR(pace.windowSeconds(), 0.012, 1e-4);
  for (int i = 0; i < 30; ++i)
  {
    pace.learn(0.3, 0.015); // the hand moves seldom
  }
  EXPECT_NEAR(pace.windowSeconds(), 0.015, 1e-4);
  pace.learn(10.0, 0.2);
  EXPECT_NEAR(pace.windowSeconds(), 0.015, 1e-4);
}
