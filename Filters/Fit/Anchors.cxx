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
constexpr double RimMm = 8.0;  // width of the rim beside the opening, and distance of its anchors
constexpr std::size_t MostOfRim = 2; // one anchor in so many may be of the rim

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

// Thins points to about so many. Cells have at least this edge (mm), so there may be fewer.
std::vector<SurfacePoint> thinnedTo(
  const std::vector<SurfacePoint>& points, std::size_t wanted, double leastMm = 0.0)
{
  std::vector<std::size_t> numbers;
  if (leastMm > 0.0)
  {
    numbers = nearestToMiddles(points, leastMm);
    if (numbers.size() <= wanted)
    {
      return picked(points, numbers);
    }
  }
  if (points.size() <= wanted)
  {
    return points;
  }
  glm::dvec3 low = points.front().position;
  glm::dvec3 high = low;
  for (const SurfacePoint& point : points)
  {
    low = glm::min(low, point.position);
    high = glm::max(high, point.position);
  }
  double small = leastMm;
  double large = glm::distance(low, high);
  const auto target = static_cast<double>(wanted);
  for (int i = 0; i < MostTries; ++i)
  {
    const double middle = 0.5 * (small + large);
    numbers = nearestToMiddles(points, middle);
    const auto found = static_cast<double>(numbers.size());
    if (std::abs(found - target) <= Enough * target)
    {
      break;
    }
    (found > target ? small : large) = middle;
  }
  return picked(points, numbers);
}

Cell cellOf(const glm::dvec3& position, double cellMm)
{
  const glm::dvec3 cell = glm::floor(position / cellMm);
  return { cell.x, cell.y, cell.z };
}

// Open points of the cortex, to find the closed ones beside them.
class OpenCortex
{
public:
  void add(const SurfacePoint& point)
  {
    this->Cells[cellOf(point.position, RimMm)].push_back(point.position);
  }

  // Whether an open point is within RimMm.
  bool isNear(const glm::dvec3& position) const
  {
    constexpr int Side = 3;
    for (int i = 0; i < Side * Side * Side; ++i)
    {
      const glm::dvec3 step(i % Side - 1, i / Side % Side - 1, i / (Side * Side) - 1);
      const auto found = this->Cells.find(cellOf(position + RimMm * step, RimMm));
      if (found != this->Cells.end() &&
        std::any_of(found->second.begin(), found->second.end(),
          [&](const glm::dvec3& open) { return glm::distance(open, position) < RimMm; }))
      {
        return true;
      }
    }
    return false;
  }

private:
  std::map<Cell, std::vector<glm::dvec3>> Cells;
};
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
  OpenCortex open;
  std::vector<SurfacePoint> closed;
  for (const SurfacePoint& point : surface)
  {
    if (isOpen(point.position))
    {
      open.add(point);
    }
    else
    {
      closed.push_back(point);
    }
  }
  if (closed.size() <= wanted)
  {
    return closed;
  }
  const auto beyond = std::stable_partition(closed.begin(), closed.end(),
    [&](const SurfacePoint& point) { return open.isNear(point.position); });
  std::vector<SurfacePoint> result =
    thinnedTo({ closed.begin(), beyond }, wanted / MostOfRim, RimMm);
  const std::vector<SurfacePoint> far = thinnedTo({ beyond, closed.end() }, wanted - result.size());
  result.insert(result.end(), far.begin(), far.end());
  return result;
}
}
