// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/Measurements.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double FarthestMm = 1e6;

bool liesSomewhere(const glm::dvec3& p)
{
  // A comparison with NaN is false.
  return std::abs(p.x) <= FarthestMm && std::abs(p.y) <= FarthestMm && std::abs(p.z) <= FarthestMm;
}

std::string text(const glm::dvec3& p)
{
  std::ostringstream words;
  words << p.x << " " << p.y << " " << p.z;
  return words.str();
}

std::string problemOfPlace(const std::string& what, std::size_t i, const glm::dvec3& p)
{
  return liesSomewhere(p) ? std::string()
                          : what + " " + std::to_string(i + 1) + " lies at " + text(p) +
      " mm; its coordinates must be numbers from -1000000 to 1000000";
}

std::string problemOfPlaces(const std::string& what, const std::vector<glm::dvec3>& places)
{
  std::string problem;
  for (std::size_t i = 0; i < places.size() && problem.empty(); ++i)
  {
    problem = problemOfPlace(what, i, places[i]);
  }
  return problem;
}

std::string problemOfPairs(const std::string& what, const std::vector<PointPair>& pairs)
{
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    std::string problem = problemOfPlace("The start of " + what, i, pairs[i].rest);
    if (problem.empty())
    {
      problem = problemOfPlace("The measured end of " + what, i, pairs[i].measured);
    }
    if (problem.empty() && !(pairs[i].weight >= 0.0 && std::isfinite(pairs[i].weight)))
    {
      problem = "The weight of " + what + " " + std::to_string(i + 1) + " is " +
        std::to_string(pairs[i].weight) + "; it must be 0 or more, and finite";
    }
    if (!problem.empty())
    {
      return problem;
    }
  }
  return {};
}
}

std::string problemOf(const Measurements& measured)
{
  std::string problem = problemOfPairs("landmark", measured.landmarks);
  problem = problem.empty() ? problemOfPairs("pull", measured.pulls) : problem;
  problem = problem.empty() ? problemOfPlaces("Pin", measured.pins) : problem;
  return problem.empty() ? problemOfPlaces("Traced point", measured.traces) : problem;
}

std::string problemOf(const FitSettings& settings)
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
      return std::string("The ") + name + " is " + std::to_string(value) +
        "; it must be above 0, and finite";
    }
  }
  return {};
}
}
