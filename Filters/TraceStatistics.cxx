// SPDX-License-Identifier: BSD-3-Clause
#include "TraceStatistics.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
TraceStatistics statisticsOf(const std::vector<double>& distances)
{
  std::vector<double> sizes;
  double sum = 0.0;
  double squares = 0.0;
  for (const double distance : distances)
  {
    if (std::isfinite(distance))
    {
      sizes.push_back(std::abs(distance));
      sum += distance;
      squares += distance * distance;
    }
  }
  TraceStatistics statistics;
  statistics.count = sizes.size();
  if (sizes.empty())
  {
    return statistics;
  }
  const auto count = static_cast<double>(sizes.size());
  statistics.mean = sum / count;
  statistics.rms = std::sqrt(squares / count);
  std::sort(sizes.begin(), sizes.end());
  const double rank = 0.95 * (count - 1.0);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sizes.size() - 1);
  statistics.percentile95 =
    sizes[below] + (rank - static_cast<double>(below)) * (sizes[above] - sizes[below]);
  return statistics;
}
}
