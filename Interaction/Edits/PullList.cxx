// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/PullList.h"

#include <glm/geometric.hpp>

#include <cstddef>

namespace brainshift
{
namespace
{
constexpr std::size_t NumbersPerPull = 7;
constexpr std::size_t NumbersPerPin = 4;

template <typename Kind>
std::size_t nearestOf(const std::vector<Kind>& list, const glm::dvec3& rest, double radius)
{
  std::size_t found = list.size();
  double least = radius;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    const double distance = glm::distance(list[i].rest, rest);
    if (distance <= least)
    {
      found = i;
      least = distance;
    }
  }
  return found;
}
}

std::vector<Pull> pullsFrom(const std::vector<double>& numbers)
{
  std::vector<Pull> pulls;
  for (std::size_t i = 0; i + NumbersPerPull <= numbers.size(); i += NumbersPerPull)
  {
    const double* n = &numbers[i];
    pulls.push_back({ { n[0], n[1], n[2] }, { n[3], n[4], n[5] }, n[6] });
  }
  return pulls;
}

std::vector<Pin> pinsFrom(const std::vector<double>& numbers)
{
  std::vector<Pin> pins;
  for (std::size_t i = 0; i + NumbersPerPin <= numbers.size(); i += NumbersPerPin)
  {
    const double* n = &numbers[i];
    pins.push_back({ { n[0], n[1], n[2] }, n[3] != 0.0 });
  }
  return pins;
}

std::vector<double> numbersFrom(const std::vector<Pull>& pulls)
{
  std::vector<double> numbers;
  for (const Pull& pull : pulls)
  {
    const glm::dvec3& from = pull.rest;
    const glm::dvec3& to = pull.target;
    numbers.insert(numbers.end(), { from.x, from.y, from.z, to.x, to.y, to.z, pull.weight });
  }
  return numbers;
}

std::vector<double> numbersFrom(const std::vector<Pin>& pins)
{
  std::vector<double> numbers;
  for (const Pin& pin : pins)
  {
    numbers.insert(numbers.end(), { pin.rest.x, pin.rest.y, pin.rest.z, pin.enabled ? 1.0 : 0.0 });
  }
  return numbers;
}

std::size_t nearest(const std::vector<Pull>& pulls, const glm::dvec3& rest, double radius)
{
  return nearestOf(pulls, rest, radius);
}

std::size_t nearest(const std::vector<Pin>& pins, const glm::dvec3& rest, double radius)
{
  return nearestOf(pins, rest, radius);
}
}
