// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/LandmarkMatch.h"

#include <algorithm>
#include <deque>
#include <map>

namespace brainshift
{
namespace
{
std::string named(const std::string& label, std::size_t number)
{
  return label.empty() ? std::to_string(number + 1) : label;
}
}

LandmarkMatch matchLandmarks(
  const std::vector<std::string>& rest, const std::vector<std::string>& measured)
{
  std::map<std::string, std::deque<std::size_t>> byLabel;
  for (std::size_t i = 0; i < measured.size(); ++i)
  {
    byLabel[measured[i]].push_back(i);
  }
  const bool hasLabels = std::any_of(rest.begin(), rest.end(),
    [&](const std::string& label) { return !label.empty() && byLabel.count(label) > 0; });
  LandmarkMatch match;
  std::vector<char> isTaken(measured.size(), 0);
  for (std::size_t i = 0; i < rest.size(); ++i)
  {
    std::size_t partner = hasLabels ? measured.size() : i;
    if (hasLabels && !rest[i].empty() && !byLabel[rest[i]].empty())
    {
      partner = byLabel[rest[i]].front();
      byLabel[rest[i]].pop_front();
    }
    if (partner < measured.size())
    {
      match.pairs.emplace_back(i, partner);
      isTaken[partner] = 1;
    }
    else
    {
      match.unmatched.push_back("landmark " + named(rest[i], i) + " at rest");
    }
  }
  for (std::size_t i = 0; i < measured.size(); ++i)
  {
    if (!isTaken[i])
    {
      match.unmatched.push_back("measured landmark " + named(measured[i], i));
    }
  }
  return match;
}
}
