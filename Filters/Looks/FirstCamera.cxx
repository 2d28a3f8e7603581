// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/FirstCamera.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr int Spiral = 120; // directions, about 18 degrees apart: a ball's radius is right to 1 %

// A spiral from pole to pole with even distances, and both directions of each axis.
std::vector<glm::dvec3> directions()
{
  std::vector<glm::dvec3> all;
  const double turn = glm::radians(180.0) * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < Spiral; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / Spiral;
    const double radius = std::sqrt(1.0 - z * z);
    all.emplace_back(radius * std::cos(turn * i), radius * std::sin(turn * i), z);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 along(0.0);
    along[axis] = 1.0;
    all.push_back(along);
    all.push_back(-along);
  }
  return all;
}

const glm::dvec3 Towards = glm::normalize(glm::dvec3(0.62, 0.68, 0.40));
constexpr double Filled = 0.92; // of the view's height or width
constexpr double Least = 1.0;   // mm: the camera of a single point keeps this distance

// The farthest points in two opposite directions.
struct Extent
{
  double there = -std::numeric_limits<double>::infinity();
  double back = -std::numeric_limits<double>::infinity();

  double half() const { return 0.5 * (this->there + this->back); }
  double middle() const { return 0.5 * (this->there - this->back); }
};

// The extent of tissue across a view. Each mm towards the camera counts `slope` mm more, for near
// tissue looks larger. So half the extent over the slope is the camera's distance.
Extent extentOf(const std::vector<glm::dvec3>& tissue, const glm::dvec3& across, double slope)
{
  Extent extent;
  for (const glm::dvec3& point : tissue)
  {
    const double position = glm::dot(point, across);
    const double near = slope * glm::dot(point, Towards);
    extent.there = std::max(extent.there, position + near);
    extent.back = std::max(extent.back, near - position);
  }
  return extent;
}
}

FarPoints::FarPoints()
  : Directions(directions())
  , Found(Directions.size(), { -std::numeric_limits<double>::infinity() })
{
}

void FarPoints::add(const glm::dvec3& world)
{
  for (std::size_t i = 0; i < this->Directions.size(); ++i)
  {
    const double extent = glm::dot(this->Directions[i], world);
    if (extent > this->Found[i].extent)
    {
      this->Found[i] = { extent, world };
    }
  }
}

std::vector<glm::dvec3> FarPoints::ofAllProcesses() const
{
  static_assert(sizeof(Farthest) == 4 * sizeof(double), "sent as four numbers");
  std::vector<Farthest> all = this->Found;
  vtkMultiProcessController* processes = vtkMultiProcessController::GetGlobalController();
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    all.resize(this->Found.size() * static_cast<std::size_t>(processes->GetNumberOfProcesses()));
    processes->AllGather(
      &this->Found[0].extent, &all[0].extent, 4 * static_cast<vtkIdType>(this->Found.size()));
  }
  FarPoints farthest;
  for (const Farthest& found : all)
  {
    if (std::isfinite(found.extent))
    {
      farthest.add(found.point);
    }
  }
  std::vector<glm::dvec3> points;
  for (const Farthest& found : farthest.Found)
  {
    if (std::isfinite(found.extent))
    {
      points.push_back(found.point);
    }
  }
  return points;
}

FirstCamera firstCamera(const std::vector<glm::dvec3>& tissue, double aspect, double viewAngle)
{
  FirstCamera camera;
  const glm::dvec3 right = glm::normalize(glm::cross(camera.up, Towards));
  const glm::dvec3 upwards = glm::cross(Towards, right);
  const double slope = Filled * glm::tan(glm::radians(0.5 * viewAngle));
  const Extent across = extentOf(tissue, right, slope * aspect);
  const Extent along = extentOf(tissue, upwards, slope);
  const Extent depth = extentOf(tissue, Towards, 0.0);
  const double distance =
    std::max({ across.half() / (slope * aspect), along.half() / slope, depth.there + Least });
  const glm::dvec3 axis = across.middle() * right + along.middle() * upwards;
  camera.position = axis + distance * Towards;
  camera.focalPoint = axis + depth.middle() * Towards;

  const auto farthest = [&](const glm::dvec3& direction, double middle) {
    const Extent extent = extentOf(tissue, direction, 0.0);
    return std::max({ extent.there - middle, extent.back + middle, Least });
  };
  camera.parallelScale =
    std::max(farthest(right, across.middle()) / aspect, farthest(upwards, along.middle())) / Filled;
  return camera;
}
}
