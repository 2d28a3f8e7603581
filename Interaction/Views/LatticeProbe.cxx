// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/LatticeProbe.h"

#include "Interaction/Views/Reports.h"

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

namespace brainshift
{
namespace
{
glm::dvec3 tripleAt(const std::vector<double>& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}
}

LatticeProbe::LatticeProbe(vtkSMProxy* deformation)
  : Report(makeReport(deformation, "LatticeReport"))
{
  pointAt(this->Report, "Filter", deformation);
}

std::optional<Grid> LatticeProbe::lattice() const
{
  const std::vector<double> numbers = answerOf(this->Report, "Geometry");
  if (numbers.size() != 18)
  {
    return {};
  }
  Grid grid;
  grid.dimensions = glm::ivec3(tripleAt(numbers, 0));
  grid.origin = tripleAt(numbers, 3);
  grid.spacing = tripleAt(numbers, 6);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      grid.direction[column][row] = numbers[9 + 3 * row + column];
    }
  }
  return grid;
}

std::vector<ControlPoint> LatticeProbe::around(
  const glm::dvec3& position, double radius, double movedRadius, const Plane& plane)
{
  const double ball[4] = { position.x, position.y, position.z, radius };
  const double slab[7] = { plane.point.x, plane.point.y, plane.point.z, plane.normal.x,
    plane.normal.y, plane.normal.z, plane.halfThickness };
  const double noCone[8] = { 0, 0, 0, 0, 0, 1, 0, 0 };
  vtkSMPropertyHelper(this->Report, "Ball").Set(ball, 4);
  vtkSMPropertyHelper(this->Report, "MovedWithin").Set(movedRadius);
  vtkSMPropertyHelper(this->Report, "Slab").Set(slab, 7);
  vtkSMPropertyHelper(this->Report, "Cone").Set(noCone, 8);
  return this->ask();
}

std::vector<ControlPoint> LatticeProbe::within(const Cone& cone)
{
  const double numbers[8] = { cone.apex.x, cone.apex.y, cone.apex.z, cone.direction.x,
    cone.direction.y, cone.direction.z, cone.radius, cone.growth };
  const double noBall[4] = { 0, 0, 0, 0 };
  vtkSMPropertyHelper(this->Report, "Ball").Set(noBall, 4);
  vtkSMPropertyHelper(this->Report, "MovedWithin").Set(0.0);
  vtkSMPropertyHelper(this->Report, "Cone").Set(numbers, 8);
  return this->ask();
}

std::vector<glm::dvec3> LatticeProbe::sameTissue(const std::vector<glm::dvec3>& places, bool toRest)
{
  if (places.empty())
  {
    return {};
  }
  vtkSMPropertyHelper(this->Report, "Places")
    .Set(&places.front().x, static_cast<unsigned int>(3 * places.size()));
  vtkSMPropertyHelper(this->Report, "ToRest").Set(toRest ? 1 : 0);
  const std::vector<double> numbers = answerOf(this->Report, "SameTissue");
  std::vector<glm::dvec3> same;
  for (std::size_t first = 0; first + 2 < numbers.size(); first += 3)
  {
    same.push_back(tripleAt(numbers, first));
  }
  return same;
}

std::vector<ControlPoint> LatticeProbe::ask()
{
  constexpr std::size_t numbersPerPoint = 9;
  const std::vector<double> numbers = answerOf(this->Report, "ControlPoints");
  std::vector<ControlPoint> points;
  for (std::size_t first = 0; first + numbersPerPoint <= numbers.size(); first += numbersPerPoint)
  {
    points.push_back({ glm::ivec3(tripleAt(numbers, first)), tripleAt(numbers, first + 3),
      tripleAt(numbers, first + 6) });
  }
  return points;
}
}
