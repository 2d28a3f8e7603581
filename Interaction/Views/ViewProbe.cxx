// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/ViewProbe.h"

#include "Common/ScreenScale.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/Reports.h"
#include "Interaction/Workarounds/Updates.h"

#include <pqPipelineSource.h>
#include <pqRenderView.h>

#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRenderViewProxy.h>

#include <cmath>

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
  return this->fetch();
}

std::vector<ControlPoint> LatticeProbe::within(const Cone& cone)
{
  const double numbers[8] = { cone.apex.x, cone.apex.y, cone.apex.z, cone.direction.x,
    cone.direction.y, cone.direction.z, cone.radius, cone.growth };
  const double noBall[4] = { 0, 0, 0, 0 };
  vtkSMPropertyHelper(this->Report, "Ball").Set(noBall, 4);
  vtkSMPropertyHelper(this->Report, "MovedWithin").Set(0.0);
  vtkSMPropertyHelper(this->Report, "Cone").Set(numbers, 8);
  return this->fetch();
}

std::vector<glm::dvec3> LatticeProbe::sameTissue(
  const std::vector<glm::dvec3>& positions, bool toRest)
{
  if (positions.empty())
  {
    return {};
  }
  vtkSMPropertyHelper(this->Report, "Places")
    .Set(&positions.front().x, static_cast<unsigned int>(3 * positions.size()));
  vtkSMPropertyHelper(this->Report, "ToRest").Set(toRest ? 1 : 0);
  const std::vector<double> numbers = answerOf(this->Report, "SameTissue");
  std::vector<glm::dvec3> same;
  for (std::size_t first = 0; first + 2 < numbers.size(); first += 3)
  {
    same.push_back(tripleAt(numbers, first));
  }
  return same;
}

std::vector<ControlPoint> LatticeProbe::fetch()
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

glm::dvec3 pointOfInterestOf(vtkSMProxy* deformation)
{
  const glm::dvec3 set =
    tripleAt(vtkSMPropertyHelper(deformation, "PointOfInterest").GetDoubleArray(), 0);
  const std::optional<Grid> grid =
    set == glm::dvec3(0.0) ? LatticeProbe(deformation).lattice() : std::nullopt;
  if (!grid)
  {
    return set;
  }
  // A filter made before its volume was read did not know the volume's middle.
  const glm::dvec3 end(grid->dimensions - 1);
  const glm::dvec3 inGrid = grid->gridFromWorld(set);
  const bool inside = glm::all(glm::greaterThanEqual(inGrid, glm::dvec3(0.0))) &&
    glm::all(glm::lessThanEqual(inGrid, end));
  return inside ? set : grid->worldFromGrid(end / 2.0);
}

namespace
{
// From the display's pixels and depth (0 near plane, 1 far plane).
glm::dvec3 worldFromDisplay(vtkRenderer* renderer, const glm::dvec2& pixel, double depth)
{
  renderer->SetDisplayPoint(pixel.x, pixel.y, depth);
  renderer->DisplayToWorld();
  const double* world = renderer->GetWorldPoint();
  return glm::dvec3(world[0], world[1], world[2]) / world[3];
}
}

ViewProbe::ViewProbe(pqPipelineSource* deformation, pqRenderView* view, KeptPictures& kept)
  : Deformation(deformation)
  , View(view)
  , Kept(kept)
  , Picture(makeReport(view->getProxy(), "DeformedVolumeReport"))
  , Points(deformation->getProxy())
{
  pointAt(this->Picture, "View", view->getProxy());
}

vtkRenderer* ViewProbe::renderer() const
{
  return this->View->getRenderViewProxy()->GetRenderer();
}

bool ViewProbe::works() const
{
  pqDataRepresentation* display = bentDisplay(this->Deformation, this->View);
  return display && !isMoved(display);
}

std::optional<Spot> ViewProbe::spotAt(const glm::dvec2& pixel)
{
  pqDataRepresentation* display = bentDisplay(this->Deformation, this->View);
  if (!this->works())
  {
    return {};
  }
  this->Kept.keep(display);
  pointAt(this->Picture, "Representation", display->getProxy());
  const int at[2] = { static_cast<int>(pixel.x), static_cast<int>(pixel.y) };
  vtkSMPropertyHelper(this->Picture, "Pixel").Set(at, 2);
  askAnew(this->Picture, "Pixel");
  const std::vector<double> tissue = answerOf(this->Picture, "Tissue");
  if (tissue.size() != 7 || tissue[3] == 0.0)
  {
    return {};
  }
  Spot spot{ tripleAt(tissue, 0), std::nullopt };
  if (showsSlices(display))
  {
    spot.slice = tripleAt(tissue, 4);
  }
  return spot;
}

std::vector<ControlPoint> ViewProbe::controlPointsNear(
  const Spot& spot, double radius, double movedRadius)
{
  LatticeProbe::Plane plane;
  const std::optional<Grid> grid = spot.slice ? this->lattice() : std::nullopt;
  if (grid)
  {
    // One layer of an unbent lattice, or two where the slice is in the middle between them.
    constexpr double cells = 0.55;
    const glm::dvec3 along = glm::abs(glm::transpose(grid->direction) * *spot.slice);
    plane = { spot.position, *spot.slice, cells * glm::dot(along, grid->spacing) };
  }
  return this->Points.around(spot.position, radius, movedRadius, plane);
}

std::vector<ControlPoint> ViewProbe::controlPointsUnder(const glm::dvec2& pixel, double pixels)
{
  pqDataRepresentation* display = bentDisplay(this->Deformation, this->View);
  if (!this->works() || showsSlices(display))
  {
    return {}; // beside a slice are no control points of it
  }
  const Ray ray = this->rayAt(pixel);
  constexpr double ahead = 100.0; // mm
  const double radius = pixels * this->millimetresPerPixel(ray.origin);
  const double farther =
    pixels * this->millimetresPerPixel(ray.origin + ahead * ray.direction) - radius;
  return this->Points.within({ ray.origin, ray.direction, radius, farther / ahead });
}

std::optional<glm::dvec3> ViewProbe::restOf(const glm::dvec3& position)
{
  const std::vector<glm::dvec3> rest = this->Points.sameTissue({ position }, /*toRest*/ true);
  return rest.empty() ? std::nullopt : std::optional(rest.front());
}

std::vector<glm::dvec3> ViewProbe::drawnAt(const std::vector<glm::dvec3>& rest)
{
  return this->Points.sameTissue(rest, /*toRest*/ false);
}

std::optional<Grid> ViewProbe::lattice()
{
  return this->Points.lattice();
}

double ViewProbe::strength() const
{
  return vtkSMPropertyHelper(this->Deformation->getProxy(), "Strength").GetAsDouble();
}

glm::dvec3 ViewProbe::pointOfInterest()
{
  return pointOfInterestOf(this->Deformation->getProxy());
}

glm::dvec3 ViewProbe::ahead() const
{
  const double* direction = this->renderer()->GetActiveCamera()->GetDirectionOfProjection();
  return { direction[0], direction[1], direction[2] };
}

glm::dvec3 ViewProbe::positionAt(
  const glm::dvec2& pixel, const glm::dvec3& depth, const glm::dvec3& normal) const
{
  const Ray ray = this->rayAt(pixel);
  const double along = glm::dot(depth - ray.origin, normal) / glm::dot(ray.direction, normal);
  return ray.origin + along * ray.direction;
}

glm::dvec2 ViewProbe::pixelOf(const glm::dvec3& position) const
{
  vtkRenderer* renderer = this->renderer();
  renderer->SetWorldPoint(position.x, position.y, position.z, 1.0);
  renderer->WorldToDisplay();
  const double* display = renderer->GetDisplayPoint();
  return { display[0], display[1] };
}

double ViewProbe::screenScale() const
{
  return brainshift::screenScale(this->renderer()->GetVTKWindow());
}

double ViewProbe::millimetresPerPixel(const glm::dvec3& position) const
{
  vtkRenderer* renderer = this->renderer();
  vtkCamera* camera = renderer->GetActiveCamera();
  const int height = renderer->GetSize()[1];
  if (camera->GetParallelProjection())
  {
    return 2.0 * camera->GetParallelScale() / height;
  }
  const double* eye = camera->GetPosition();
  const double* forward = camera->GetDirectionOfProjection();
  const double distance = glm::dot(
    position - glm::dvec3(eye[0], eye[1], eye[2]), glm::dvec3(forward[0], forward[1], forward[2]));
  constexpr double radiansPerDegree = 0.017453292519943295;
  return 2.0 * distance * std::tan(0.5 * radiansPerDegree * camera->GetViewAngle()) / height;
}

ViewProbe::Ray ViewProbe::rayAt(const glm::dvec2& pixel) const
{
  // A pixel's middle, since a pick reads the pixel.
  const glm::dvec2 middle = glm::floor(pixel) + 0.5;
  const glm::dvec3 nearest = worldFromDisplay(this->renderer(), middle, 0.0);
  const glm::dvec3 farthest = worldFromDisplay(this->renderer(), middle, 1.0);
  return { nearest, glm::normalize(farthest - nearest) };
}
}
