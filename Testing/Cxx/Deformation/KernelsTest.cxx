// SPDX-License-Identifier: BSD-3-Clause
// Proves that the cubic kernels, whose values the GPU is given, are what their names say.
#include "Filters/Deformation/Kernels.h"

#include <gtest/gtest.h>

#include <string>

using namespace brainshift;

namespace
{
constexpr float Rounding = 5e-7f; // a few units in the last place of a weight near 1
constexpr int Steps = 64;

float sum(const glm::vec4& weights)
{
  return weights[0] + weights[1] + weights[2] + weights[3];
}

class Kernels : public ::testing::TestWithParam<int>
{
};
}

TEST_P(Kernels, WeightsSumToOne)
{
  for (int step = 0; step <= Steps; ++step)
  {
    EXPECT_NEAR(sum(kernelWeights(GetParam(), step / float(Steps))), 1.0f, Rounding);
  }
}

TEST_P(Kernels, SlopesSumToZero)
{
  for (int step = 0; step <= Steps; ++step)
  {
    EXPECT_NEAR(sum(kernelSlopes(GetParam(), step / float(Steps))), 0.0f, Rounding);
  }
}

TEST_P(Kernels, ReproduceLinearFunctions)
{
  for (int step = 0; step <= Steps; ++step)
  {
    const float t = step / float(Steps);
    const glm::vec4 weights = kernelWeights(GetParam(), t);
    EXPECT_NEAR(-weights[0] + weights[2] + 2.0f * weights[3], t, Rounding);
  }
}

TEST_P(Kernels, SlopesAreTheDerivativesOfTheWeights)
{
  // Central differences of a cubic are off by its third derivative (at most 9) times h * h / 6.
  constexpr float H = 1.0f / 256.0f;
  constexpr float Tolerance = 9.0f * H * H / 6.0f + Rounding / H;
  for (int step = 1; step < Steps; ++step)
  {
    const float t = step / float(Steps);
    const glm::vec4 differences =
      (kernelWeights(GetParam(), t + H) - kernelWeights(GetParam(), t - H)) / (2.0f * H);
    const glm::vec4 slopes = kernelSlopes(GetParam(), t);
    for (int tap = 0; tap < 4; ++tap)
    {
      EXPECT_NEAR(slopes[tap], differences[tap], Tolerance) << "tap " << tap << " at " << t;
    }
  }
}

TEST_P(Kernels, JoinSmoothlyFromCellToCell)
{
  const glm::vec4 before = kernelWeights(GetParam(), 1.0f);
  const glm::vec4 after = kernelWeights(GetParam(), 0.0f);
  const glm::vec4 slopeBefore = kernelSlopes(GetParam(), 1.0f);
  const glm::vec4 slopeAfter = kernelSlopes(GetParam(), 0.0f);
  EXPECT_EQ(before[0], 0.0f);
  EXPECT_EQ(after[3], 0.0f);
  for (int tap = 0; tap < 3; ++tap)
  {
    EXPECT_NEAR(before[tap + 1], after[tap], Rounding);
    EXPECT_NEAR(slopeBefore[tap + 1], slopeAfter[tap], Rounding);
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Kernels, ::testing::Values(KernelCatmullRom, KernelBSpline),
  [](const auto& kernel) { return std::string(kernel.param ? "BSpline" : "CatmullRom"); });

TEST(CatmullRom, PassesThroughTheControlPoints)
{
  EXPECT_EQ(kernelWeights(KernelCatmullRom, 0.0f), glm::vec4(0.0f, 1.0f, 0.0f, 0.0f));
  EXPECT_EQ(kernelWeights(KernelCatmullRom, 1.0f), glm::vec4(0.0f, 0.0f, 1.0f, 0.0f));
}

TEST(CatmullRom, HalfwayIsKnown)
{
  const glm::vec4 known(-1.0f / 16.0f, 9.0f / 16.0f, 9.0f / 16.0f, -1.0f / 16.0f);
  EXPECT_EQ(kernelWeights(KernelCatmullRom, 0.5f), known);
}

TEST(BSpline, IsNeverNegative)
{
  for (int step = 0; step <= Steps; ++step)
  {
    const glm::vec4 weights = kernelWeights(KernelBSpline, step / float(Steps));
    for (int tap = 0; tap < 4; ++tap)
    {
      EXPECT_GE(weights[tap], 0.0f);
    }
  }
}

TEST(BSpline, AtAControlPointIsKnown)
{
  const glm::vec4 weights = kernelWeights(KernelBSpline, 0.0f);
  EXPECT_NEAR(weights[0], 1.0f / 6.0f, Rounding);
  EXPECT_NEAR(weights[1], 4.0f / 6.0f, Rounding);
  EXPECT_NEAR(weights[2], 1.0f / 6.0f, Rounding);
}
