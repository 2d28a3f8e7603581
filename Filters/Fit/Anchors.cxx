// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/Anchors.h"

#include <map>
#include <tuple>

namespace brainshift
{
namespace
{
constexpr int MostTries = 24;  // halvings of the range of cell sizes
constexpr double Enough = 0.1; // fraction of the wanted number by which the choice may miss it

using Cell = std::tuple<double, double, double>;

// The number of the point of each cell that is nearest to its middle.
std::vector<std::size_t> nearestToMiddles(const std::vector<SurfacePoint>& points, double cellMm)
{
  std::map<Cell, std::pair<double, std::size_t>> best;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 cell = glm::floor(points[i].position / cellMm);
    const double away = glm::distance(points[i].position, (cell + 0.5) * cellMm);
    const auto [at, isNew] = best.try_emplace({ cell.x, cell.y, cell.z }, away, i);
    if (!isNew && away < at->second.first)
    {
      at->second = { away, i };
    }
  }
  std::vector<std::size_t> result;
  result.reserve(best.size());
  for (const auto& [cell, found] : best)
  {
    result.push_back(found.second);
  }
  return result;
}

std::vector<SurfacePoint> picked(
  const std::vector<SurfacePoint>& points, const std::vector<std::size_t>& numbers)
{
  std::vector<SurfacePoint> result;
  result.reserve(numbers.size());
  for (const std::size_t number : numbers)
  {
    result.push_back(points[number]);
  }
  return result;
}
}

OpeningBall ballAround(const std::vector<glm::dvec3>& positions)
{
  OpeningBall ball;
  for (const glm::dvec3& position : positions)
  {
    ball.centre += position / static_cast<double>(positions.size());
  }
  for (const glm::dvec3& position : positions)
  {
    ball.radiusMm = std::max(ball.radiusMm, glm::distance(position, ball.centre));
  }
  return ball;
}

OpeningBall openingOf(const Measurements& measured)
{
  std::vector<glm::dvec3> open;
  open.reserve(measured.traces.size() + measured.pulls.size());
  for (const glm::dvec3& trace : measured.traces)
  {
    open.push_back(measured.base ? measured.base->map.restFromDeformed(trace) : trace);
  }
  for (const PointPair& pull : measured.pulls)
  {
    if (isOn(pull))
    {
      open.push_back(pull.rest);
    }
  }
  return ballAround(open);
}

std::vector<SurfacePoint> thinnedPoints(const std::vector<SurfacePoint>& surface, double cellMm)
{
  return picked(surface, nearestToMiddles(surface, cellMm));
}

std::vector<SurfacePoint> chooseAnchors(const std::vector<SurfacePoint>& surface,
  const std::function<bool(const glm::dvec3&)>& isOpen, std::size_t wanted)
{
  std::vector<SurfacePoint> closed;
  std::copy_if(surface.begin(), surface.end(), std::back_inserter(closed),
    [&](const SurfacePoint& point) { return !isOpen(point.position); });
  if (closed.size() <= wanted)
  {
    return closed;
  }
  glm::dvec3 low = closed.front().position;
  glm::dvec3 high = low;
  for (const SurfacePoint& point : closed)
  {
    low = glm::min(low, point.position);
    high = glm::max(high, point.position);
  }
  double small = 0.0;
  double large = glm::distance(low, high);
  const auto target = static_cast<double>(wanted);
  std::vector<std::size_t> numbers;
  for (int i = 0; i < MostTries; ++i)
  {
    const double middle = 0.5 * (small + large);
    numbers = nearestToMiddles(closed, middle);
    const auto found = static_cast<double>(numbers.size());
    if (std::abs(found - target) <= Enough * target)
    {
      break;
    }
    (found > target ? small : large) = middle;
  }
  return picked(closed, numbers);
}
}
