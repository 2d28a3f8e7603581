// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/TraceStatistics.h"

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
  const double rank = 0.95 * (count - 1.0);
  const auto below = sizes.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(sizes.begin(), below, sizes.end());
  const double above =
    below + 1 == sizes.end() ? *below : *std::min_element(below + 1, sizes.end());
  statistics.percentile95 = *below + (rank - std::floor(rank)) * (above - *below);
  return statistics;
}

TraceHistogram histogramOf(const std::vector<double>& distances)
{
  constexpr int half = TraceHistogram::Bins / 2;
  bool any = false;
  double largest = 0.0;
  for (const double distance : distances)
  {
    if (std::isfinite(distance))
    {
      any = true;
      largest = std::max(largest, std::abs(distance));
    }
  }
  TraceHistogram histogram;
  if (!any)
  {
    return histogram;
  }
  histogram.width = TraceHistogram::LeastWidth;
  while (half * histogram.width < largest)
  {
    histogram.width *= 2.0;
  }
  for (const double distance : distances)
  {
    if (std::isfinite(distance))
    {
      const int bin = half + static_cast<int>(std::floor(distance / histogram.width));
      ++histogram.counts[std::min(bin, TraceHistogram::Bins - 1)]; // the largest lies on the edge
    }
  }
  return histogram;
}
}
