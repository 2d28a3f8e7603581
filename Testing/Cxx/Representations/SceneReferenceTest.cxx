// SPDX-License-Identifier: BSD-3-Clause
// Proves which value of a volume a reference's scalar stands for where the user says nothing.
#include "Representations/Tissue/SceneReference.h"

#include <vtkTextureObject.h> // for the pointers of what is included

#include <gtest/gtest.h>

using namespace brainshift;

namespace
{
double mapped(const glm::dvec2& reference, const glm::dvec2& volume, double scalar)
{
  const StoredScalar mapping = usualMapping(reference, volume);
  return scalar * mapping.scale + mapping.shift;
}
}

TEST(UsualMapping, KeepsNumbersOfRangesThatAreMuchAlike)
{
  EXPECT_EQ(mapped({ 0.0, 330.0 }, { 0.0, 330.0 }, 17.0), 17.0);
  EXPECT_EQ(mapped({ -3.0, 310.0 }, { 0.0, 330.0 }, 17.0), 17.0); // a bake overshoots, darker
  EXPECT_EQ(mapped({ -1024.0, 2000.0 }, { -1024.0, 3071.0 }, 40.0), 40.0); // CT
  EXPECT_EQ(mapped({ 0.0, 100.0 }, { 0.0, 200.0 }, 40.0), 40.0);           // half in common
}

TEST(UsualMapping, StretchesOthersFromRangeToRange)
{
  EXPECT_DOUBLE_EQ(mapped({ 0.0, 99.0 }, { 0.0, 200.0 }, 99.0), 200.0);
  EXPECT_DOUBLE_EQ(mapped({ 0.0, 1.0 }, { 0.0, 4095.0 }, 0.5), 2047.5);
  EXPECT_DOUBLE_EQ(mapped({ 1000.0, 3000.0 }, { -1.0, 1.0 }, 2500.0), 0.5);
}

TEST(UsualMapping, OfOneValueIsAShift)
{
  EXPECT_DOUBLE_EQ(mapped({ 7.0, 7.0 }, { 0.0, 100.0 }, 7.0), 0.0);
  EXPECT_DOUBLE_EQ(mapped({ 0.0, 100.0 }, { 5.0, 5.0 }, 0.0), 5.0);
  EXPECT_EQ(mapped({ 0.0, 0.0 }, { 0.0, 0.0 }, 0.0), 0.0);
}
