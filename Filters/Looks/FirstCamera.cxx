// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/FirstCamera.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <limits>

namespace brainshift
{
namespace
{
const glm::dvec3 Towards = glm::normalize(glm::dvec3(0.62, 0.68, 0.40));
constexpr double Filled = 0.92; // of the view's height or width
constexpr double Least = 1.0;   // mm: the camera of a single point keeps this distance

// The farthest points in two opposite directions.
struct Reach
{
  double there = -std::numeric_limits<double>::infinity();
  double back = -std::numeric_limits<double>::infinity();

  double half() const { return 0.5 * (this->there + this->back); }
  double middle() const { return 0.5 * (this->there - this->back); }
};

// How far tissue reaches across a view. Each mm towards the camera counts `slope` mm more, for near
// tissue looks larger. So half the reach over the slope is the camera's distance.
Reach reachOf(const std::vector<glm::dvec3>& tissue, const glm::dvec3& across, double slope)
{
  Reach reach;
  for (const glm::dvec3& point : tissue)
  {
    const double place = glm::dot(point, across);
    const double near = slope * glm::dot(point, Towards);
    reach.there = std::max(reach.there, place + near);
    reach.back = std::max(reach.back, near - place);
  }
  return reach;
}
}

FirstCamera firstCamera(const std::vector<glm::dvec3>& tissue, double aspect, double viewAngle)
{
  FirstCamera camera;
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, Towards));
  const glm::dvec3 upwards = glm::cross(Towards, right);
  const double slope = Filled * glm::tan(glm::radians(0.5 * viewAngle));
  const Reach across = reachOf(tissue, right, slope * aspect);
  const Reach along = reachOf(tissue, upwards, slope);
  const Reach depth = reachOf(tissue, Towards, 0.0);
  const double distance =
    std::max({ across.half() / (slope * aspect), along.half() / slope, depth.there + Least });
  const glm::dvec3 axis = across.middle() * right + along.middle() * upwards;
  camera.position = axis + distance * Towards;
  camera.focalPoint = axis + depth.middle() * Towards;

  const auto farthest = [&](const glm::dvec3& direction, double middle) {
    const Reach reach = reachOf(tissue, direction, 0.0);
    return std::max({ reach.there - middle, reach.back + middle, Least });
  };
  camera.parallelScale =
    std::max(farthest(right, across.middle()) / aspect, farthest(upwards, along.middle())) / Filled;
  return camera;
}
}
