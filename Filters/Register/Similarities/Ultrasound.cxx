// SPDX-License-Identifier: BSD-3-Clause
// LC2 in small windows: the reference is ultrasound inside a fan. Speckle pulls each position in a
// random direction; the six parameters of a rigid motion average it out, so the volume moves as
// a whole before it bends.
#include "Filters/Register/Similarities/LocalFitSimilarity.h"
#include "Filters/Register/Similarities/SelfSimilarity.h"

namespace brainshift
{
namespace
{
// Softer, the volume would fit the speckle by deformations that do not exist.
constexpr double SpeckleStiffness = 5.0;

// Right results of simulated sweeps were moved by up to 1.8 mm, wrong ones by 2 mm or more.
constexpr double FarthestByOtherMm = 1.9;

const Metric UltrasoundMetric = linearFitWithGradients();
const Metric SelfSimilarityMetric = selfSimilarityMetric();
}

Similarity describeUltrasound()
{
  Similarity result;
  result.name = "ultrasound";
  result.label = "Ultrasound";
  result.tooltip =
    "For a reference that is ultrasound. LC2 explains it by the volume and its edges. "
    "The volume moves as a whole before it bends. Tested on simulated ultrasound only.";
  result.overlapOf = "the ultrasound fan";
  result.plan.levels = { { &UltrasoundMetric, 2.0, 1.0, true },
    { &UltrasoundMetric, 1.0, 1.0, true }, { &UltrasoundMetric, 1.0 } };
  result.plan.stiffness = SpeckleStiffness;
  result.plan.fan = FanLimits{};
  result.plan.check.halves = { &UltrasoundMetric, 1.0, 1.0, true };
  result.plan.check.other = { &SelfSimilarityMetric, 1.0, 1.0, true };
  result.plan.check.otherMm = FarthestByOtherMm;
  return result;
}
}
