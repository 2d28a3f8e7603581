// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/StrokeCurve.h"

#include <limits>

namespace brainshift
{
void StrokeCurve::note(const StrokeMarks& marks, std::uint64_t how, double figure)
{
  this->Values.clear();
  if (marks.empty())
  {
    return;
  }
  this->Known[mixed(marks.back(), how)] = figure;
  for (const std::uint64_t mark : marks)
  {
    const auto found = this->Known.find(mixed(mark, how));
    this->Values.push_back(
      found == this->Known.end() ? std::numeric_limits<double>::quiet_NaN() : found->second);
  }
}
}
