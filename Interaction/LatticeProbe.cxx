// SPDX-License-Identifier: BSD-3-Clause
#include "LatticeProbe.h"

#include <pqUndoStack.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>

using namespace brainshift;

namespace
{
glm::dvec3 tripleAt(const std::vector<double>& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}
}

vtkSmartPointer<vtkSMProxy> makeReport(vtkSMProxy* beside, const char* name)
{
  SCOPED_UNDO_EXCLUDE();
  auto report = vtk::TakeSmartPointer(
    beside->GetSession() ? beside->GetSessionProxyManager()->NewProxy("misc", name) : nullptr);
  report->PrototypeOn(); // questions are no steps to undo
  return report;
}

void point(vtkSMProxy* report, const char* property, vtkSMProxy* at)
{
  vtkSMPropertyHelper helper(report, property);
  if (helper.GetNumberOfElements() != 1 || helper.GetAsProxy() != at)
  {
    helper.Set(at);
  }
}

std::vector<double> told(vtkSMProxy* report, const char* name)
{
  report->UpdateVTKObjects();
  report->UpdatePropertyInformation(report->GetProperty(name));
  return vtkSMPropertyHelper(report, name).GetDoubleArray();
}

LatticeProbe::LatticeProbe(vtkSMProxy* deformation)
  : Report(makeReport(deformation, "LatticeReport"))
{
  point(this->Report, "Filter", deformation);
}

std::optional<Grid> LatticeProbe::lattice() const
{
  const std::vector<double> numbers = told(this->Report, "Geometry");
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

std::vector<Handle> LatticeProbe::around(
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

std::vector<Handle> LatticeProbe::within(const Cone& cone)
{
  const double numbers[8] = { cone.apex.x, cone.apex.y, cone.apex.z, cone.direction.x,
    cone.direction.y, cone.direction.z, cone.radius, cone.growth };
  const double noBall[4] = { 0, 0, 0, 0 };
  vtkSMPropertyHelper(this->Report, "Ball").Set(noBall, 4);
  vtkSMPropertyHelper(this->Report, "MovedWithin").Set(0.0);
  vtkSMPropertyHelper(this->Report, "Cone").Set(numbers, 8);
  return this->ask();
}

std::vector<Handle> LatticeProbe::ask()
{
  constexpr std::size_t numbersPerHandle = 9;
  const std::vector<double> numbers = told(this->Report, "Handles");
  std::vector<Handle> handles;
  for (std::size_t first = 0; first + numbersPerHandle <= numbers.size(); first += numbersPerHandle)
  {
    handles.push_back({ glm::ivec3(tripleAt(numbers, first)), tripleAt(numbers, first + 3),
      tripleAt(numbers, first + 6) });
  }
  return handles;
}
