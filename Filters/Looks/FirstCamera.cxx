// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/FirstCamera.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>

namespace brainshift
{
namespace
{
const glm::dvec3 Towards = glm::normalize(glm::dvec3(0.62, 0.68, 0.40));
constexpr double Filled = 0.92;   // of the view's height or width
constexpr double BoxShare = 0.25; // of the box's corners in the size of tissue

// Half the size of tissue along a direction of unit length: a little more than that of the
// ellipsoid in its box, for a head has a neck.
double reachOf(const glm::dvec3& half, const glm::dvec3& along)
{
  const glm::dvec3 parts = glm::abs(half * along);
  return glm::mix(glm::length(parts), parts.x + parts.y + parts.z, BoxShare);
}
}

FirstCamera firstCamera(const Box& box, double aspect, double viewAngle)
{
  FirstCamera camera;
  const glm::dvec3 low(box.bounds[0], box.bounds[2], box.bounds[4]);
  const glm::dvec3 high(box.bounds[1], box.bounds[3], box.bounds[5]);
  const glm::dvec3 half = glm::max(0.5 * (high - low), glm::dvec3(1e-9));
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, Towards));
  camera.focalPoint = 0.5 * (low + high);
  camera.parallelScale =
    std::max(reachOf(half, glm::cross(Towards, right)), reachOf(half, right) / aspect) / Filled;
  const double distance = camera.parallelScale / glm::tan(glm::radians(0.5 * viewAngle)) +
    BoxShare * reachOf(half, Towards);
  camera.position = camera.focalPoint + distance * Towards;
  return camera;
}
}
