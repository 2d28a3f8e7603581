// SPDX-License-Identifier: BSD-3-Clause
// Proves that the starts of a search are within their limits and always the same, and that the
// first one is where it is.
#include "Filters/Register/Starts.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

using namespace brainshift;

TEST(Starts, TheFirstOneIsWhereItIs)
{
  const StartMotion motion = startMotion(0, 6.0, 6.0);
  EXPECT_EQ(motion.shift, glm::dvec3(0.0));
  EXPECT_EQ(motion.rotation, glm::dvec3(0.0));
}

TEST(Starts, OthersAreWithinTheirLimitsAndAlwaysTheSame)
{
  glm::dvec3 sum(0.0);
  for (int number = 1; number < MostStarts; ++number)
  {
    const StartMotion motion = startMotion(number, 6.0, 10.0);
    EXPECT_LE(glm::length(motion.shift), 6.0);
    EXPECT_LE(glm::length(motion.rotation), glm::radians(10.0));
    EXPECT_EQ(motion.shift, startMotion(number, 6.0, 10.0).shift);
    EXPECT_NE(motion.shift, startMotion(number - 1, 6.0, 10.0).shift);
    sum += motion.shift;
  }
  EXPECT_LT(glm::length(sum) / (MostStarts - 1), 1.5) << "they are all on one side";
}
