// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Looks/FarPoints.h"

#include "vtkMultiProcessController.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr int Spiral = 120; // directions, about 18 degrees apart: a ball's reach is right to 1 %

// A spiral from pole to pole with even distances (Fibonacci lattice), and both ways of each axis.
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
    const double reach = glm::dot(this->Directions[i], world);
    if (reach > this->Found[i].reach)
    {
      this->Found[i] = { reach, world };
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
      &this->Found[0].reach, &all[0].reach, 4 * static_cast<vtkIdType>(this->Found.size()));
  }
  FarPoints farthest;
  for (const Farthest& found : all)
  {
    if (std::isfinite(found.reach))
    {
      farthest.add(found.point);
    }
  }
  std::vector<glm::dvec3> points;
  for (const Farthest& found : farthest.Found)
  {
    if (std::isfinite(found.reach))
    {
      points.push_back(found.point);
    }
  }
  return points;
}
}
