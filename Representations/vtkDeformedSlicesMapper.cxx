// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedSlicesMapper.h"

#include "Representations/Gpu/GpuMemory.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Field/SceneDeformation.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Tissue/SceneReference.h"
#include "Representations/Slices/SliceComparison.h"
#include "Representations/Slices/SliceDrawer.h"
#include "Representations/Slices/SlicePick.h"
#include "Representations/Gpu/TextureMemory.h"
#include "Representations/Tissue/Tissue.h"
#include "Representations/Gpu/WindowDevices.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWeakPointer.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace brainshift;

struct vtkDeformedSlicesMapper::Device
{
  brainshift::Tissue Tissue;
  ReferenceTextures Reference;
  DeviceDeformation Deformation;
  SliceDrawer Drawer;
  GpuMemory Memory;
  DrawnSlices Drawn;

  void Release(vtkWindow* window)
  {
    this->Tissue.releaseGraphicsResources(window);
    this->Reference.releaseGraphicsResources(window);
    this->Deformation.releaseGraphicsResources(window);
    this->Drawer.releaseGraphicsResources();
  }
};

struct vtkDeformedSlicesMapper::State
{
  WindowDevices<Device> Devices;
  Counters Count;
  SceneDeformation Deformation;  // of the input
  std::string Reported;          // the last trouble told
  std::unique_ptr<PointMap> Map; // of the deformation at MapTime, once asked for
  unsigned long long MapTime = 0;
  vtkWeakPointer<vtkVolumeProperty> Property; // drawn with last
};

namespace
{
// A plane on the very face of the box must not come and go with rounding; texture coordinates.
glm::dvec3 roundingOf(const ValueLayout& layout)
{
  constexpr double roundingVoxels = 1e-3;
  return roundingVoxels / glm::dvec3(layout.dimensions);
}
}

vtkStandardNewMacro(vtkDeformedSlicesMapper);

vtkDeformedSlicesMapper::vtkDeformedSlicesMapper()
  : Internal(std::make_unique<State>())
{
}

vtkDeformedSlicesMapper::~vtkDeformedSlicesMapper() = default;

// Reads the deformation if it changed.
void vtkDeformedSlicesMapper::UpdateDeformation(vtkImageData* image)
{
  std::string problem;
  if (!this->Internal->Deformation.update(image, problem))
  {
    vtkErrorMacro(<< problem << ". The slices are drawn undeformed.");
  }
}

double* vtkDeformedSlicesMapper::GetBounds()
{
  vtkVolumeMapper::GetBounds();
  if (auto image = vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    this->UpdateDeformation(image);
    this->Internal->Deformation.widen(this->Bounds);
  }
  return this->Bounds;
}

void vtkDeformedSlicesMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->GetInputAlgorithm()->Update();
  std::string problem;
  if (!this->Draw(renderer, volume, problem) && this->Internal->Reported != problem)
  {
    vtkErrorMacro(<< problem << ". The slices are not drawn.");
    this->Internal->Reported = problem;
  }
}

bool vtkDeformedSlicesMapper::Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!window || !image)
  {
    problem = "Deformed Slices draws image data in an OpenGL window only";
    return false;
  }
  window->MakeCurrent();
  const ShownValues shown = shownValuesOf(this, image);
  if (!shown.scalars)
  {
    return true; // nothing to draw yet
  }
  this->UpdateDeformation(image);
  TissueRequest tissue;
  tissue.property = volume->GetProperty();
  tissue.scalars = shown.scalars;
  tissue.layout = shown.layout;
  tissue.blend = Blend::Maximum; // one sample is seen: opacity as given, no light
  tissue.nearest = this->Interpolation == Nearest;
  Device& device = this->Internal->Devices.of(window);
  takeOutOfMemory(); // what others left behind
  const bool drawn = this->AskForMemory(window, device, tissue, problem) &&
    this->DrawPlanes(renderer, device, volume, tissue, shown.grid, problem);
  if (takeOutOfMemory())
  {
    device.Memory.refuse();
    return this->AskForMemory(window, device, tissue, problem);
  }
  return drawn;
}

bool vtkDeformedSlicesMapper::AskForMemory(
  vtkOpenGLRenderWindow* window, Device& device, const TissueRequest& tissue, std::string& problem)
{
  DrawnSizes sizes;
  addTissueSizes(tissue, sizes);
  this->Internal->Deformation.addSizes(sizes);
  constexpr double noLimit = 0.0;
  problem = device.Memory.ask(window, memoryNeed(sizes), noLimit);
  return problem.empty();
}

bool vtkDeformedSlicesMapper::DrawPlanes(vtkRenderer* renderer, Device& device, vtkVolume* volume,
  const TissueRequest& tissue, const Grid& grid, std::string& problem)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  SliceScene scene;
  DeviceDeformation::Change change;
  if (!device.Tissue.update(window, tissue, scene.volume, state.Count, problem) ||
    !device.Deformation.update(
      window, state.Deformation, grid, tissue.layout, scene.volume, change, state.Count, problem) ||
    !this->DescribeReference(window, device, tissue, grid, scene, problem))
  {
    return false;
  }
  describeView(renderer, volume, grid, tissue.layout, scene.volume);
  this->DescribePlanes(tissue, grid, scene);
  device.Drawn = { scene.planes, scene.volume.worldFromTexture };
  state.Property = volume->GetProperty();
  scene.selecting = renderer->GetSelector() != nullptr;
  scene.blended = this->IsTranslucent() && !scene.selecting;
  if (!device.Drawer.draw(window, scene, state.Count))
  {
    problem = "The slices' shader does not compile on this GPU";
    return false;
  }
  return true;
}

bool vtkDeformedSlicesMapper::DescribeReference(vtkOpenGLRenderWindow* window, Device& device,
  const TissueRequest& tissue, const Grid& grid, SliceScene& scene, std::string& problem)
{
  const ReferenceVolume reference = readReference(this->GetDataSetInput());
  const bool alone = reference.show == ReferenceShow::Reference;
  const bool together = reference.show == ReferenceShow::Both && this->Comparison != NoComparison;
  if (!reference.voxels || !(alone || together))
  {
    return true;
  }
  ComparisonChoice choice;
  choice.comparison = this->Comparison;
  choice.checkerSizeMm = this->CheckerSize;
  choice.fullGradient = this->FullGradient;
  choice.wipePosition = { this->WipePosition[0], this->WipePosition[1], this->WipePosition[2] };
  const double* range = tissue.property->GetRGBTransferFunction()->GetRange();
  const ComparedVolume volume{ grid, tissue.layout, { range[0], range[1] }, device.Tissue.stored(),
    valueFromReference(
      reference.voxels, tissue, { this->ReferenceRange[0], this->ReferenceRange[1] }),
    scene.volume.transferFromScalar, tissue.nearest };
  return device.Reference.update(
    window, reference, choice, volume, scene.reference, this->Internal->Count, problem);
}

void vtkDeformedSlicesMapper::DescribePlanes(
  const TissueRequest& tissue, const Grid& grid, SliceScene& scene)
{
  const ValueLayout& layout = tissue.layout;
  const glm::ivec3 axes = axesAcrossPlanes(grid.direction);
  const bool shown[3] = { this->ShowSagittal, this->ShowCoronal, this->ShowAxial };
  for (int plane = 0; plane < 3; ++plane)
  {
    scene.planes.shown[axes[plane]] = shown[plane];
  }
  const glm::dvec3 position(this->SlicePosition[0], this->SlicePosition[1], this->SlicePosition[2]);
  scene.planes.position =
    grid.gridFromWorld(position) * layout.textureFromGrid + layout.textureOfGridZero;
  const glm::dvec3 rounding = roundingOf(layout);
  scene.volume.volumeLow -= rounding;
  scene.volume.volumeHigh += rounding;
  scene.planes.low = glm::min(scene.volume.spaceLow, scene.volume.volumeLow);
  scene.planes.high = glm::max(scene.volume.spaceHigh, scene.volume.volumeHigh);
  scene.voxels = layout.dimensions;
  scene.cubic = this->Interpolation == Cubic;
  scene.opacity = this->Opacity;
  scene.mapsOpacity = this->MapOpacity;
}

// Tissue outside the volume, without a value, or see-through is not seen.
bool vtkDeformedSlicesMapper::IsSeenAt(const glm::dvec3& texture)
{
  State& state = *this->Internal;
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const auto [scalars, grid, layout] = shownValuesOf(this, image);
  if (!scalars)
  {
    return false;
  }
  glm::dvec3 rest = texture;
  if (state.Deformation.deformed)
  {
    if (!state.Map || state.MapTime != state.Deformation.time)
    {
      state.Map =
        std::make_unique<PointMap>(state.Deformation.lattice, state.Deformation.request.inverse);
      state.MapTime = state.Deformation.time;
    }
    const glm::dvec3 place = (texture - layout.textureOfGridZero) / layout.textureFromGrid;
    const glm::dvec3 world = state.Map->restFromDeformed(grid.worldFromGrid(place));
    rest = grid.gridFromWorld(world) * layout.textureFromGrid + layout.textureOfGridZero;
  }
  const glm::dvec3 rounding = roundingOf(layout);
  if (glm::any(glm::lessThan(rest, layout.low - rounding)) ||
    glm::any(glm::greaterThan(rest, layout.high + rounding)))
  {
    return false;
  }
  const glm::ivec3 voxel = glm::clamp(glm::ivec3(glm::floor(rest * glm::dvec3(layout.dimensions))),
    glm::ivec3(0), layout.dimensions - 1);
  const vtkIdType index =
    (static_cast<vtkIdType>(voxel.z) * layout.dimensions.y + voxel.y) * layout.dimensions.x +
    voxel.x;
  const double value = scalars->GetComponent(index, 0);
  const bool seenThrough = this->MapOpacity && state.Property &&
    state.Property->GetScalarOpacity()->GetValue(value) <= 0.0;
  return !std::isnan(value) && !seenThrough;
}

bool vtkDeformedSlicesMapper::Pick(
  vtkRenderer* renderer, int x, int y, double position[3], double normal[3])
{
  Device* device = this->Internal->Devices.find(renderer->GetRenderWindow());
  if (!device || !vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    return false;
  }
  for (const SliceHit& hit : hitsUnderPixel(device->Drawn, renderer, x, y))
  {
    if (this->IsSeenAt(hit.texture))
    {
      std::copy_n(&hit.world[0], 3, position);
      std::copy_n(&hit.normal[0], 3, normal);
      return true;
    }
  }
  return false;
}

void vtkDeformedSlicesMapper::GetNormals(double normals[9])
{
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const glm::dmat3 direction = image ? gridOf(image).direction : glm::dmat3(1.0);
  const glm::ivec3 axes = axesAcrossPlanes(direction);
  for (int plane = 0; plane < 3; ++plane)
  {
    const glm::dvec3& axis = direction[axes[plane]];
    for (int i = 0; i < 3; ++i)
    {
      normals[3 * plane + i] = axis[plane] < 0.0 ? -axis[i] : axis[i];
    }
  }
}

void vtkDeformedSlicesMapper::GetVoxelSteps(double steps[3])
{
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const Grid grid = image ? gridOf(image) : Grid();
  const glm::ivec3 axes = axesAcrossPlanes(grid.direction);
  for (int plane = 0; plane < 3; ++plane)
  {
    steps[plane] = grid.spacing[axes[plane]];
  }
}

void vtkDeformedSlicesMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Devices.release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

const Counters& vtkDeformedSlicesMapper::GetCounters()
{
  Counters& count = this->Internal->Count;
  count.gpuScalarBytes = 0;
  count.gpuOtherBytes = 0;
  this->Internal->Devices.visit([&](Device& device) {
    count.gpuScalarBytes += textureBytes(device.Tissue.scalars());
    count.gpuOtherBytes += textureBytes({ device.Reference.textures(),
      device.Tissue.otherTextures(), device.Deformation.field().textures() });
    device.Deformation.askTime(count.gpuFieldMicroseconds);
  });
  return count;
}

void vtkDeformedSlicesMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ShowSagittal: " << this->ShowSagittal << "\n"
     << indent << "ShowCoronal: " << this->ShowCoronal << "\n"
     << indent << "ShowAxial: " << this->ShowAxial << "\n"
     << indent << "SlicePosition: " << this->SlicePosition[0] << " " << this->SlicePosition[1]
     << " " << this->SlicePosition[2] << "\n"
     << indent << "Interpolation: " << this->Interpolation << "\n"
     << indent << "Opacity: " << this->Opacity << "\n"
     << indent << "MapOpacity: " << this->MapOpacity << "\n"
     << indent << "Comparison: " << this->Comparison << "\n"
     << indent << "CheckerSize: " << this->CheckerSize << "\n"
     << indent << "ReferenceRange: " << this->ReferenceRange[0] << " " << this->ReferenceRange[1]
     << "\n"
     << indent << "FullGradient: " << this->FullGradient << "\n"
     << indent << "WipePosition: " << this->WipePosition[0] << " " << this->WipePosition[1] << " "
     << this->WipePosition[2] << "\n";
}
