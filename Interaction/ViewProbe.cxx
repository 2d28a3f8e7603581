// SPDX-License-Identifier: BSD-3-Clause
#include "ViewProbe.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <pqUndoStack.h>

#include <vtkCamera.h>
#include <vtkRenderer.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMTrace.h>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>
#include <cstring>

using namespace brainshift;

namespace
{
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

glm::dvec3 tripleAt(const std::vector<double>& numbers, std::size_t first)
{
  return { numbers[first], numbers[first + 1], numbers[first + 2] };
}

// From the display's pixels and depth (0 near plane, 1 far plane).
glm::dvec3 worldFromDisplay(vtkRenderer* renderer, const glm::dvec2& pixel, double depth)
{
  renderer->SetDisplayPoint(pixel.x, pixel.y, depth);
  renderer->DisplayToWorld();
  const double* world = renderer->GetWorldPoint();
  return glm::dvec3(world[0], world[1], world[2]) / world[3];
}
}

ViewProbe::ViewProbe(pqPipelineSource* deformation, pqRenderView* view)
  : Deformation(deformation)
  , View(view)
  , Picture(makeReport(view->getProxy(), "DeformedVolumeReport"))
  , Points(makeReport(deformation->getProxy(), "LatticeReport"))
{
  point(this->Picture, "View", view->getProxy());
  point(this->Points, "Filter", deformation->getProxy());
}

ViewProbe::~ViewProbe()
{
  this->keepPictureOf(nullptr);
}

void ViewProbe::keepPictureOf(pqDataRepresentation* shown)
{
  if (shown == this->Kept)
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  for (pqDataRepresentation* representation : { this->Kept.data(), shown })
  {
    if (representation)
    {
      vtkSMPropertyHelper(representation->getProxy(), "KeepPicture", true)
        .Set(representation == shown);
      representation->getProxy()->UpdateVTKObjects();
    }
  }
  this->Kept = shown;
}

vtkRenderer* ViewProbe::renderer() const
{
  return this->View->getRenderViewProxy()->GetRenderer();
}

pqDataRepresentation* ViewProbe::shownAs() const
{
  pqDataRepresentation* shown = this->Deformation->getRepresentation(this->View);
  if (!shown || !shown->isVisible())
  {
    return nullptr;
  }
  const char* kind = vtkSMPropertyHelper(shown->getProxy(), "Representation", true).GetAsString();
  return kind && std::strcmp(kind, "Deformed Volume") == 0 ? shown : nullptr;
}

std::optional<glm::dvec3> ViewProbe::tissueAt(const glm::dvec2& pixel)
{
  pqDataRepresentation* shown = this->shownAs();
  this->keepPictureOf(shown);
  if (!shown)
  {
    return {};
  }
  point(this->Picture, "Representation", shown->getProxy());
  const int at[2] = { static_cast<int>(pixel.x), static_cast<int>(pixel.y) };
  vtkSMPropertyHelper(this->Picture, "Pixel").Set(at, 2);
  const std::vector<double> tissue = told(this->Picture, "Tissue");
  if (tissue.size() != 4 || tissue[3] == 0.0)
  {
    return {};
  }
  return tripleAt(tissue, 0);
}

std::vector<Handle> ViewProbe::ask()
{
  constexpr std::size_t numbersPerHandle = 9;
  vtkSMPropertyHelper(this->Points, "Moved").Set(1);
  const std::vector<double> numbers = told(this->Points, "Handles");
  std::vector<Handle> handles;
  for (std::size_t first = 0; first + numbersPerHandle <= numbers.size(); first += numbersPerHandle)
  {
    handles.push_back({ glm::ivec3(tripleAt(numbers, first)), tripleAt(numbers, first + 3),
      tripleAt(numbers, first + 6) });
  }
  return handles;
}

std::vector<Handle> ViewProbe::handlesNear(const glm::dvec3& position, double radius)
{
  const double ball[4] = { position.x, position.y, position.z, radius };
  const double noCone[8] = { 0, 0, 0, 0, 0, 1, 0, 0 };
  vtkSMPropertyHelper(this->Points, "Ball").Set(ball, 4);
  vtkSMPropertyHelper(this->Points, "Cone").Set(noCone, 8);
  return this->ask();
}

std::vector<Handle> ViewProbe::handlesUnder(const glm::dvec2& pixel, double pixels)
{
  const Ray ray = this->rayAt(pixel);
  const glm::dvec3 ahead = ray.origin + 100.0 * ray.direction;
  const double radius = pixels * this->millimetresPerPixel(ray.origin);
  const double growth = (pixels * this->millimetresPerPixel(ahead) - radius) / 100.0;
  const double cone[8] = { ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x,
    ray.direction.y, ray.direction.z, radius, growth };
  const double noBall[4] = { 0, 0, 0, 0 };
  vtkSMPropertyHelper(this->Points, "Ball").Set(noBall, 4);
  vtkSMPropertyHelper(this->Points, "Cone").Set(cone, 8);
  return this->ask();
}

std::optional<Grid> ViewProbe::lattice()
{
  const std::vector<double> numbers = told(this->Points, "Geometry");
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

double ViewProbe::strength() const
{
  return vtkSMPropertyHelper(this->Deformation->getProxy(), "Strength").GetAsDouble();
}

glm::dvec3 ViewProbe::pointOfInterest()
{
  vtkSMProxy* filter = this->Deformation->getProxy();
  const glm::dvec3 set =
    tripleAt(vtkSMPropertyHelper(filter, "PointOfInterest").GetDoubleArray(), 0);
  const std::optional<Grid> grid = set == glm::dvec3(0.0) ? this->lattice() : std::nullopt;
  if (!grid)
  {
    return set;
  }
  // A filter made before its volume was read could not tell the volume's middle.
  const glm::dvec3 end(grid->dimensions - 1);
  const glm::dvec3 place = grid->gridFromWorld(set);
  const bool inside = glm::all(glm::greaterThanEqual(place, glm::dvec3(0.0))) &&
    glm::all(glm::lessThanEqual(place, end));
  return inside ? set : grid->worldFromGrid(end / 2.0);
}

void ViewProbe::setPointOfInterest(const glm::dvec3& position)
{
  vtkSMProxy* filter = this->Deformation->getProxy();
  SCOPED_UNDO_SET("Point of interest");
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter);
  vtkSMPropertyHelper(filter, "PointOfInterest").Set(&position[0], 3);
  filter->UpdateVTKObjects();
}

glm::dvec3 ViewProbe::positionAt(const glm::dvec2& pixel, const glm::dvec3& depth) const
{
  const Ray ray = this->rayAt(pixel);
  const double* normal = this->renderer()->GetActiveCamera()->GetDirectionOfProjection();
  const glm::dvec3 forward(normal[0], normal[1], normal[2]);
  const double along = glm::dot(depth - ray.origin, forward) / glm::dot(ray.direction, forward);
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
