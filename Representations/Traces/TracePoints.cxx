// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Traces/TracePoints.h"

#include "Common/Guard.h"
#include "Common/ScreenScale.h"
#include "Representations/Gpu/WindowDevices.h"
#include "Representations/Scene/HitSource.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Traces/TraceDrawer.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPointSet.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeCollection.h"

#include <glm/gtc/matrix_access.hpp>

#include <cmath>

namespace brainshift
{
vtkStandardNewMacro(TracePoints);

struct TracePoints::Device
{
  TraceDrawer Drawer;
  vtkMTimeType Uploaded = 0; // LookTime of what Drawer has

  void Release(vtkWindow* window) { this->Drawer.releaseGraphicsResources(window); }
};

struct TracePoints::State
{
  WindowDevices<Device> Devices;
  Counters Count;
  bool Warned = false; // about too many volumes
};

TracePoints::TracePoints()
  : Internal(std::make_unique<State>())
{
}

TracePoints::~TracePoints() = default;

namespace
{
constexpr double LeastRadius = 1.5;       // pixels; smaller balls are lost to the eye
constexpr double SuitableRadius = 4.0;    // pixels, at least, unless the user chose a radius
constexpr double SuitableFraction = 0.01; // of the points' box

std::uint8_t byteOf(double fraction)
{
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(fraction, 0.0, 1.0)));
}

// Appends the points of one set. Positions that are not finite are left out.
void addVertices(vtkPointSet* points, vtkPointGaussianMapper* mapper, vtkProperty* property,
  std::vector<TraceVertex>& vertices)
{
  vtkUnsignedCharArray* colors =
    mapper->GetScalarVisibility() ? mapper->MapScalars(points, property->GetOpacity()) : nullptr;
  const double* plain = property->GetDiffuseColor();
  TraceVertex vertex{ {},
    { byteOf(plain[0]), byteOf(plain[1]), byteOf(plain[2]), byteOf(property->GetOpacity()) } };
  const vtkIdType count = points->GetNumberOfPoints();
  vertices.reserve(vertices.size() + count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double position[3];
    points->GetPoint(i, position);
    if (!std::isfinite(position[0] + position[1] + position[2]))
    {
      continue;
    }
    std::copy_n(position, 3, vertex.position.begin());
    if (colors)
    {
      std::copy_n(colors->GetPointer(4 * i), 4, vertex.color.begin());
    }
    vertices.push_back(vertex);
  }
}

std::vector<TraceVertex> verticesOf(vtkPointGaussianMapper* mapper, vtkProperty* property)
{
  std::vector<TraceVertex> vertices;
  vtkDataObject* input = mapper->GetInputDataObject(0, 0);
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(input))
  {
    const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
    for (block->InitTraversal(); !block->IsDoneWithTraversal(); block->GoToNextItem())
    {
      if (auto* points = vtkPointSet::SafeDownCast(block->GetCurrentDataObject()))
      {
        addVertices(points, mapper, property, vertices);
      }
    }
  }
  else if (auto* points = vtkPointSet::SafeDownCast(input))
  {
    addVertices(points, mapper, property, vertices);
  }
  return vertices;
}

// What hides points: the mappers of the renderer's deformed volumes.
std::vector<HitSource*> deformedVolumesIn(vtkRenderer* renderer)
{
  std::vector<HitSource*> sources;
  vtkVolumeCollection* volumes = renderer->GetVolumes();
  vtkCollectionSimpleIterator at;
  volumes->InitTraversal(at);
  while (vtkVolume* volume = volumes->GetNextVolume(at))
  {
    auto* mapper = dynamic_cast<HitSource*>(volume->GetMapper());
    if (mapper && volume->GetVisibility())
    {
      sources.push_back(mapper);
    }
  }
  return sources;
}

// The default radius: a hundredth of the longest side of their box,
// mm.
double suitableRadius(vtkMapper* mapper)
{
  const vtkBoundingBox box(mapper->GetBounds());
  return box.IsValid() ? SuitableFraction * box.GetMaxLength() : 0.0;
}

TraceScene sceneOf(vtkRenderer* renderer, vtkMatrix4x4* worldFromPoint)
{
  TraceScene scene;
  renderer->GetTiledSizeAndOrigin(&scene.size.x, &scene.size.y, &scene.origin.x, &scene.origin.y);
  scene.clipFromWorld = clipFromWorld(renderer);
  const double* ahead = renderer->GetActiveCamera()->GetDirectionOfProjection();
  scene.ahead = { ahead[0], ahead[1], ahead[2] };
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      scene.worldFromPoint[column][row] = worldFromPoint->GetElement(row, column);
    }
  }
  return scene;
}
}

// When positions or colours changed last.
vtkMTimeType TracePoints::LookTime()
{
  vtkDataObject* input = this->Mapper->GetInputDataObject(0, 0);
  return std::max({ this->Mapper->GetMTime(), this->GetProperty()->GetMTime(),
    input ? input->GetMTime() : 0, this->Mapper->GetLookupTable()->GetMTime() });
}

// The first hits of each volume. A warning, given once, reports too many volumes.
std::vector<const FirstHits*> TracePoints::HitsOf(
  const std::vector<HitSource*>& volumes, vtkWindow* window)
{
  std::vector<const FirstHits*> hits;
  for (HitSource* volume : volumes)
  {
    if (const FirstHits* drawn = volume->GetHits(window))
    {
      hits.push_back(drawn);
    }
  }
  if (hits.size() > MaxTissues)
  {
    if (!std::exchange(this->Internal->Warned, true))
    {
      warn(this,
        "The view shows " + std::to_string(hits.size()) +
          " deformed volumes; Trace Points are hidden by " + std::to_string(MaxTissues) +
          " of them");
    }
    hits.resize(MaxTissues);
  }
  return hits;
}

bool TracePoints::Draw(vtkRenderer* renderer, const std::vector<HitSource*>& volumes)
{
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto* mapper = vtkPointGaussianMapper::SafeDownCast(this->Mapper);
  if (!window || !mapper)
  {
    return false;
  }
  Device& device = this->Internal->Devices.of(window);
  const vtkMTimeType time = this->LookTime();
  if (device.Uploaded != time)
  {
    device.Drawer.upload(verticesOf(mapper, this->GetProperty()));
    device.Uploaded = time;
  }
  TraceScene scene = sceneOf(renderer, this->GetMatrix());
  const bool automatic = mapper->GetScaleFactor() <= 0.0;
  scene.radius = automatic ? suitableRadius(mapper) : mapper->GetScaleFactor();
  scene.leastRadius = screenScale(window) * (automatic ? SuitableRadius : LeastRadius);
  scene.hiddenOpacity = this->HiddenOpacity;
  if (scene.hiddenOpacity < 1.0)
  {
    scene.hits = this->HitsOf(volumes, window);
  }
  if (!device.Drawer.draw(window, scene, this->Internal->Count))
  {
    vtkErrorMacro("The shader of Trace Points does not compile.");
    return false;
  }
  return true;
}

// mm, as large as the balls are drawn in the middle of the points.
double TracePoints::SuitableRadiusIn(vtkRenderer* renderer)
{
  const glm::dmat4 clip = clipFromWorld(renderer);
  const double* center = this->GetCenter();
  const double depth = (clip * glm::dvec4(center[0], center[1], center[2], 1.0)).w;
  const double rows = 0.5 * renderer->GetSize()[1] * glm::length(glm::dvec3(glm::row(clip, 1)));
  const double least = depth > 0.0 && rows > 0.0
    ? screenScale(renderer->GetVTKWindow()) * SuitableRadius * depth / rows
    : 0.0;
  return std::max(suitableRadius(this->Mapper), least);
}

// A selection of points keeps the depths of the picture, which are those of the balls. Points that
// are drawn nearer by a radius are not hidden by their own balls.
int TracePoints::DrawSelection(vtkRenderer* renderer)
{
  auto* mapper = vtkPointGaussianMapper::SafeDownCast(this->Mapper);
  const double chosen = mapper->GetScaleFactor();
  const double radius = chosen > 0.0 ? chosen : this->SuitableRadiusIn(renderer);
  mapper->SetScaleFactor(radius); // 0 would be points of one pixel
  const double* ahead = renderer->GetActiveCamera()->GetDirectionOfProjection();
  double place[3];
  this->GetPosition(place);
  this->AddPosition(-radius * ahead[0], -radius * ahead[1], -radius * ahead[2]);
  const int drawn = this->Superclass::RenderOpaqueGeometry(renderer);
  this->SetPosition(place);
  mapper->SetScaleFactor(chosen);
  return drawn;
}

int TracePoints::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  return guarded(this, 0, [&] {
    return renderer->GetSelector()
      ? this->DrawSelection(renderer)
      : static_cast<int>(deformedVolumesIn(renderer).empty() && this->Draw(renderer, {}));
  });
}

int TracePoints::RenderOverlay(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  if (renderer->GetSelector())
  {
    return 0;
  }
  return guarded(this, 0, [&] {
    const auto volumes = deformedVolumesIn(renderer);
    return static_cast<int>(!volumes.empty() && this->Draw(renderer, volumes));
  });
}

void TracePoints::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Devices.release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}
}
