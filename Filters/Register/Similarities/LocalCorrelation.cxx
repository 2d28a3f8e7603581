// SPDX-License-Identifier: BSD-3-Clause
// Squared local correlation (NCC) in small windows: both volumes have the same contrast, perhaps
// inverted.
#include "Filters/Register/Similarities/LocalFitSimilarity.h"
#include "Filters/Register/Similarities/SelfSimilarity.h"

namespace brainshift
{
namespace
{
// A mean squared correlation below 0.8 at the start comes from the contrast, not from position.
constexpr double MostCost = 0.2;

const Metric LocalCorrelationMetric = localCorrelationMetric();
const Metric CheckMetric = selfSimilarityMetric();
}

Similarity describeLocalCorrelation()
{
  Similarity result;
  result.name = "same contrast";
  result.label = "Same contrast";
  result.tooltip = "For two scans of one kind, perhaps inverted. Compares local correlation (NCC) "
                   "alone, which takes less time.";
  result.plan.levels = { { &LocalCorrelationMetric, 4.0 }, { &LocalCorrelationMetric, 2.0 },
    { &LocalCorrelationMetric, 1.3, MostCost, false, true } };
  result.plan.check.halves = { &LocalCorrelationMetric, 4.0, 1.0, true };
  result.plan.check.other = { &CheckMetric, 4.0, 1.0, true };
  result.plan.check.blocks = selfSimilarityDescriptor();
  return result;
}
}
