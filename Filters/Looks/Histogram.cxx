// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/Histogram.h"

#include <algorithm>
#include <numeric>

namespace brainshift
{
double Histogram::total() const
{
  return std::accumulate(this->counts.begin(), this->counts.end(), 0.0);
}

void Histogram::add(double value)
{
  const double last = static_cast<double>(this->counts.size() - 1);
  const double bin = std::clamp((value - this->low) / this->width(), 0.0, last);
  this->counts[static_cast<std::size_t>(bin)] += 1.0;
}

Histogram makeHistogram(double low, double high, int bins)
{
  return { low, high, std::vector<double>(static_cast<std::size_t>(bins), 0.0) };
}

double percentile(const Histogram& histogram, double fraction)
{
  double left = fraction * histogram.total();
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
  {
    const double count = histogram.counts[bin];
    if (count > 0.0 && left <= count)
    {
      return histogram.low + (bin + left / count) * histogram.width();
    }
    left -= count;
  }
  return histogram.low;
}

double otsuThreshold(const Histogram& histogram, double top)
{
  const double highest = percentile(histogram, top);
  const auto value = [&](std::size_t bin) { return std::min(histogram.middle(bin), highest); };
  double sum = 0.0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin)
  {
    sum += histogram.counts[bin] * value(bin);
  }
  const double total = histogram.total();
  double below = 0.0;
  double sumBelow = 0.0;
  double largest = 0.0;
  double threshold = histogram.low;
  for (std::size_t bin = 0; bin + 1 < histogram.counts.size(); ++bin)
  {
    below += histogram.counts[bin];
    sumBelow += histogram.counts[bin] * value(bin);
    const double above = total - below;
    if (below > 0.0 && above > 0.0)
    {
      const double apart = (sum - sumBelow) / above - sumBelow / below;
      const double variance = below * above * apart * apart;
      if (variance > largest)
      {
        largest = variance;
        threshold = histogram.low + (bin + 1.0) * histogram.width();
      }
    }
  }
  return threshold;
}

Histogram withoutBackground(const Histogram& histogram)
{
  Histogram tissue = histogram;
  const auto most = std::max_element(tissue.counts.begin(), tissue.counts.end());
  const double commonest = tissue.middle(static_cast<std::size_t>(most - tissue.counts.begin()));
  const double threshold = otsuThreshold(histogram);
  const double end = commonest < threshold ? 0.5 * (commonest + threshold) : histogram.low;
  for (std::size_t bin = 0; bin < tissue.counts.size() && tissue.middle(bin) <= end; ++bin)
  {
    tissue.counts[bin] = 0.0;
  }
  return tissue;
}
}
