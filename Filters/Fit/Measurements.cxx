// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/Measurements.h"

#include "Common/Numbers.h"

#include <deque>
#include <map>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr double FarthestMm = 1e6;

std::string text(const glm::dvec3& p)
{
  std::ostringstream words;
  words << p.x << " " << p.y << " " << p.z;
  return words.str();
}

void requirePosition(const std::string& what, std::size_t i, const glm::dvec3& p)
{
  // A comparison with NaN is false.
  if (!(std::abs(p.x) <= FarthestMm && std::abs(p.y) <= FarthestMm && std::abs(p.z) <= FarthestMm))
  {
    throw Problem(what + " " + std::to_string(i + 1) + " is at " + text(p) +
      " mm; its coordinates must be numbers from -1000000 to 1000000");
  }
}

void requirePositions(const std::string& what, const std::vector<glm::dvec3>& positions)
{
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    requirePosition(what, i, positions[i]);
  }
}

void requirePairs(const std::string& what, const std::vector<PointPair>& pairs)
{
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    requirePosition("The start of " + what, i, pairs[i].rest);
    requirePosition("The measured end of " + what, i, pairs[i].measured);
    if (!(pairs[i].weight >= 0.0 && std::isfinite(pairs[i].weight)))
    {
      throw Problem("The weight of " + what + " " + std::to_string(i + 1) + " is " +
        numberText(pairs[i].weight) + "; it must be 0 or more, and finite");
    }
  }
}

std::string named(const std::string& label, std::size_t number)
{
  return label.empty() ? std::to_string(number + 1) : label;
}

// Some names of a list, as a sentence shows them.
std::string namesOf(const std::vector<std::string>& labels)
{
  constexpr std::size_t Most = 3;
  std::string text;
  std::size_t count = 0;
  for (const std::string& label : labels)
  {
    const bool isShown = !label.empty() && count < Most;
    text += isShown ? (count > 0 ? ", \"" : "\"") + label + "\"" : "";
    count += label.empty() ? 0 : 1;
  }
  return count == 0 ? "none" : text + (count > Most ? " ..." : "");
}

std::vector<std::string> repeatedIn(const std::vector<std::string>& labels)
{
  std::map<std::string, int> counts;
  std::vector<std::string> repeated;
  for (const std::string& label : labels)
  {
    if (!label.empty() && ++counts[label] == 2)
    {
      repeated.push_back(label);
    }
  }
  return repeated;
}

// Whether names pair two lists; false: their order does.
bool countsByName(const std::vector<std::string>& rest, const std::vector<std::string>& measured)
{
  const auto isNamed = [](const std::string& label) { return !label.empty(); };
  const bool hasNames = std::any_of(rest.begin(), rest.end(), isNamed) ||
    std::any_of(measured.begin(), measured.end(), isNamed);
  if (!hasNames || rest.empty() || measured.empty())
  {
    return hasNames;
  }
  const bool isShared = std::any_of(rest.begin(), rest.end(), [&](const std::string& label) {
    return isNamed(label) && std::count(measured.begin(), measured.end(), label) > 0;
  });
  if (!isShared)
  {
    throw Problem("No name is on both lists of landmarks: at rest " + namesOf(rest) +
      "; measured " + namesOf(measured) +
      ". Give partners the same name, or pair by order (Pair By Order)");
  }
  return true;
}
}

void requireGood(const Measurements& measured)
{
  requirePairs("landmark", measured.landmarks);
  requirePairs("pull", measured.pulls);
  requirePositions("Pin", measured.pins);
  requirePositions("Traced point", measured.traces);
}

void requireGood(const FitSettings& settings)
{
  for (const auto& [name, value] : { std::pair("landmark length", settings.landmarkKernel.lengthMm),
         std::pair("landmark field deviation", settings.landmarkKernel.deviationMm),
         std::pair("landmark deviation", settings.landmarkDeviation),
         std::pair("rotation prior", settings.rotationPriorDegrees),
         std::pair("surface length", settings.surfaceKernel.lengthMm),
         std::pair("surface field deviation", settings.surfaceKernel.deviationMm),
         std::pair("surface deviation", settings.surfaceDeviation),
         std::pair("anchor deviation", settings.anchorDeviation),
         std::pair("pin deviation", settings.pinDeviation),
         std::pair("relaxation", settings.relaxation), std::pair("bin", settings.binMm) })
  {
    if (!(value > 0.0 && std::isfinite(value)))
    {
      throw Problem(std::string("The ") + name + " is " + numberText(value) +
        "; it must be above 0, and finite");
    }
  }
}

LandmarkMatch matchLandmarks(
  const std::vector<std::string>& rest, const std::vector<std::string>& measured, bool byOrder)
{
  std::map<std::string, std::deque<std::size_t>> byLabel;
  for (std::size_t i = 0; i < measured.size(); ++i)
  {
    byLabel[measured[i]].push_back(i);
  }
  const bool hasLabels = !byOrder && countsByName(rest, measured);
  LandmarkMatch match;
  for (const std::vector<std::string>& list : { repeatedIn(rest), repeatedIn(measured) })
  {
    for (const std::string& name : hasLabels ? list : std::vector<std::string>())
    {
      const bool isNew =
        std::find(match.repeated.begin(), match.repeated.end(), name) == match.repeated.end();
      match.repeated.insert(match.repeated.end(), isNew ? 1 : 0, name);
    }
  }
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
