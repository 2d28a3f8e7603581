// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedSlicesMapper.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Representations/Field/EvidenceTexture.h"
#include "Representations/Field/SceneDeformation.h"
#include "Representations/Field/TissueFacts.h"
#include "Representations/Gpu/WindowDevices.h"
#include "Representations/Picture/MovingQuality.h"
#include "Representations/Picture/PictureCapture.h"
#include "Representations/Scene/Remarks.h"
#include "Representations/Scene/SceneFrame.h"
#include "Representations/Slices/SliceBricks.h"
#include "Representations/Tissue/FinestLevel.h"
#include "Representations/Tissue/ResectionTextures.h"
#include "Representations/Tissue/SceneReference.h"
#include "Representations/Window/RankParts.h"

#include "vtkColorTransferFunction.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

using namespace brainshift;

struct vtkDeformedSlicesMapper::Device
{
  TissueTextures Tissue;
  ReferenceTextures Reference;
  DeviceDeformation Deformation;
  EvidenceTexture Evidence;
  ResectionTextures Resected;
  SliceDrawer Drawer;
  GpuMemory Memory;
  FinestLevel Level;
  SliceBricks Bricks;
  DrawnSlices Drawn;
  ValueLayout DrawnLayout; // that its texture coordinates are of

  void Release(vtkWindow* window)
  {
    this->Bricks.releaseGraphicsResources(window);
    this->Tissue.releaseGraphicsResources(window);
    this->Reference.releaseGraphicsResources(window);
    this->Deformation.releaseGraphicsResources(window);
    this->Evidence.releaseGraphicsResources(window);
    this->Resected.releaseGraphicsResources(window);
    this->Drawer.releaseGraphicsResources();
  }
};

struct vtkDeformedSlicesMapper::State
{
  WindowDevices<Device> Devices;
  Counters Count;
  SceneDeformation Deformation;               // of the input
  std::optional<DrawnPart> Part;              // none: all of it
  std::string Reported;                       // the last problem
  std::set<std::string> Told;                 // remarks
  vtkWeakPointer<vtkVolumeProperty> Property; // drawn with last
};

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
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const std::optional<DrawnPart>& part = this->Internal->Part;
  if (image && part)
  {
    std::copy_n(part->bounds.data(), 6, this->Bounds);
  }
  else if (image)
  {
    this->UpdateDeformation(image);
    this->Internal->Deformation.widen(this->Bounds);
  }
  return this->Bounds;
}

void vtkDeformedSlicesMapper::WidenByTissue(vtkImageData* image, double bounds[6])
{
  this->Internal->Deformation.require(image);
  this->Internal->Deformation.widen(bounds);
}

const Lattice* vtkDeformedSlicesMapper::GetLattice(vtkImageData* image)
{
  if (!image)
  {
    return nullptr;
  }
  this->Internal->Deformation.require(image);
  const SceneDeformation& deformation = this->Internal->Deformation;
  return deformation.deformed ? &deformation.lattice : nullptr;
}

void vtkDeformedSlicesMapper::SetDrawnPart(const DrawnPart* part)
{
  std::optional<DrawnPart>& known = this->Internal->Part;
  const bool isSame = part ? known && *known == *part : !known;
  if (!isSame)
  {
    known = part ? std::optional(*part) : std::nullopt;
    this->Modified();
  }
}

const double* vtkDeformedSlicesMapper::GetTissueOfAllRanks() const
{
  const std::optional<DrawnPart>& part = this->Internal->Part;
  return part ? part->tissue.data() : nullptr;
}

void vtkDeformedSlicesMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->GetInputAlgorithm()->Update();
  guarded(this, [&] {
    std::string problem;
    bool drawn = false;
    const std::string thrown = thrownBy([&] { drawn = this->Draw(renderer, volume, problem); });
    problem = thrown.empty() ? problem : "Deformed Slices " + thrown;
    reportOnce(
      this, drawn ? std::string() : problem, "The slices are not drawn", this->Internal->Reported);
  });
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
  const DrawnValues values = drawnValuesOf(this, image);
  problem = problemOf([&] { requirePosition(values.grid, "The volume's "); });
  if (!problem.empty())
  {
    return false;
  }
  if (!values.scalars)
  {
    return true; // nothing to draw yet
  }
  this->UpdateDeformation(image);
  TissueRequest tissue = this->TissueOf(image, volume->GetProperty(), values);
  Device& device = this->Internal->Devices.of(window);
  GpuTask gpu(window, this->Internal->Count);
  gpu.moving = isMoving(window->GetDesiredUpdateRate());
  takeOutOfMemory(); // errors of others
  const auto draw = [&] {
    return device.Deformation.askForMemory(
             gpu, device.Memory, this->NeedOf(tissue), this->MemoryLimit) &&
      this->DrawPlanes(gpu, { renderer, volume }, device, tissue);
  };
  const bool drawn = device.Level.draw(gpu, tissue, this->NeedOf(tissue), this->MemoryLimit, [&] {
    const bool done = draw();
    if (takeOutOfMemory())
    {
      device.Memory.refuse();
      return draw(); // less of it, if anything
    }
    return done;
  });
  if (!drawn)
  {
    device.Bricks.rest();
  }
  this->Tell(gpu);
  problem = gpu.problem;
  return drawn;
}

TissueRequest vtkDeformedSlicesMapper::TissueOf(
  vtkImageData* image, vtkVolumeProperty* property, const DrawnValues& values)
{
  TissueRequest tissue;
  tissue.property = property;
  tissue.values = values;
  tissue.blend = Blend::Maximum; // one sample is seen: opacity as given, no light
  tissue.labels = isLabelMap(image);
  tissue.nearest = tissue.labels || this->Interpolation == Nearest;
  tissue.range =
    rangeOf(this->Internal->Part, image, values, drawnComponents(property, values.scalars).scalar);
  const ReferenceVolume reference = readReference(image);
  tissue.compared = reference.voxels &&
    (reference.show == ReferenceShow::Reference ||
      (reference.show == ReferenceShow::Both && this->Comparison != NoComparison));
  if (!this->Internal->Part) // ranks stream nothing
  {
    tissue.finerBy = finerVoxelsBy(image, tissue, /*ofSlices*/ true);
  }
  return tissue;
}

void vtkDeformedSlicesMapper::Tell(const GpuTask& gpu)
{
  for (const std::string& remark : gpu.remarks)
  {
    tellOnce(this, remark, this->Internal->Told);
  }
  for (const std::string& warning : gpu.warnings)
  {
    warn(this, warning);
  }
}

MemoryNeed vtkDeformedSlicesMapper::NeedOf(const TissueRequest& tissue)
{
  DrawnSizes sizes;
  addTissueSizes(tissue, sizes);
  this->Internal->Deformation.addSizes(sizes);
  return memoryNeed(sizes);
}

bool vtkDeformedSlicesMapper::DrawPlanes(
  GpuTask& gpu, const DrawnVolume& seen, Device& device, const TissueRequest& tissue)
{
  State& state = *this->Internal;
  const DrawnValues whole = state.Part ? wholeValues(*state.Part, tissue.values) : tissue.values;
  SliceScene scene;
  DeviceDeformation::Change change;
  if (!device.Tissue.update(gpu, tissue, scene.tissue) ||
    !device.Deformation.update(gpu, state.Deformation, whole, scene.field, change))
  {
    return false;
  }
  if (!this->UploadReference(gpu, device, tissue, whole, scene))
  {
    gpu.goOnWithout("The reference is not drawn");
    scene.reference = ReferenceScene();
  }
  if (this->ShowEvidence && !device.Evidence.update(gpu, state.Deformation, whole, scene.evidence))
  {
    return false;
  }
  scene.frame = frameOf(seen, whole);
  const VolumePlace place{ scene.frame.worldFromTexture, seen.volume->GetMatrix() };
  if (!device.Resected.update(gpu, readResection(this->GetDataSetInput()), place, scene.resection))
  {
    return false;
  }
  this->PlacePlanes(whole, scene);
  scene.voxels = tissue.values.layout.dimensions;
  scene.cubic = this->IsCubic(tissue) && !tissue.nearest;
  scene.nearest = tissue.nearest || CategoryScalars::areWanted(tissue.property);
  device.Drawn = { scene.planes, scene.frame.worldFromTexture };
  device.DrawnLayout = whole.layout;
  state.Property = tissue.property;
  scene.selecting = seen.renderer->GetSelector() != nullptr;
  scene.blended = this->IsTranslucent() && !scene.selecting;
  if (state.Part) // ranks stream nothing
  {
    scene.part = slicePartOf(state.Part->cut, whole, tissue.values, !scene.blended);
  }
  else
  {
    this->AddBricks(gpu, seen, device, tissue, scene);
  }
  return device.Drawer.draw(gpu.window, scene, gpu.counters) ||
    gpu.fail("The slices' shader does not compile on this GPU");
}

bool vtkDeformedSlicesMapper::IsCubic(const TissueRequest& tissue) const
{
  return this->Interpolation == Cubic && !CategoryScalars::areWanted(tissue.property);
}

// Finer voxels where the slices are, as far as they are there. A selection asks for none.
void vtkDeformedSlicesMapper::AddBricks(GpuTask& gpu, const DrawnVolume& seen, Device& device,
  const TissueRequest& tissue, SliceScene& scene)
{
  if (scene.selecting)
  {
    return;
  }
  BrickView view = brickViewOf(seen, tissue.values, this->NeedOf(tissue), this->MemoryLimit);
  glm::ivec2 origin;
  seen.renderer->GetTiledSizeAndOrigin(&view.pixels.x, &view.pixels.y, &origin.x, &origin.y);
  view.leaveRoomFor(SliceBricks::bytesOf(view.pixels));
  PictureCapture& capture = PictureCapture::current();
  std::optional<SliceBricks::Clock::time_point> end;
  if (this->WaitsForDetail && !gpu.moving)
  {
    capture.join(gpu.window, &device, isLeftEye(seen));
    end = capture.deadline();
  }
  else
  {
    capture.end();
  }
  device.Bricks.update(gpu, view, { tissue, device.Tissue }, scene, end);
  if (end)
  {
    capture.reportIfCoarse(gpu, device.Bricks.bricks());
  }
}

bool vtkDeformedSlicesMapper::UploadReference(GpuTask& gpu, Device& device,
  const TissueRequest& tissue, const DrawnValues& whole, SliceScene& scene)
{
  if (!tissue.compared)
  {
    return true;
  }
  const ReferenceVolume reference = readReference(this->GetDataSetInput());
  ComparisonChoice choice;
  choice.comparison = this->Comparison;
  choice.colors = colorPair(static_cast<brainshift::ComparisonColors>(this->ComparisonColors));
  choice.checkerSizeMm = this->CheckerSize;
  choice.fullGradient = this->FullGradient;
  choice.windowMm = this->SimilarityWindow;
  choice.wipePosition = { this->WipePosition[0], this->WipePosition[1], this->WipePosition[2] };
  const double* range = tissue.property->GetRGBTransferFunction()->GetRange();
  const ComparedVolume volume{ whole.grid, whole.layout, { range[0], range[1] },
    device.Tissue.stored(),
    valueFromReference(reference, tissue, { this->ReferenceRange[0], this->ReferenceRange[1] }),
    scene.tissue.transferFromScalar, reference.isLabels || this->Interpolation == Nearest,
    this->IsCubic(tissue) && !reference.isLabels };
  return device.Reference.update(gpu, reference, choice, volume, scene.reference);
}

void vtkDeformedSlicesMapper::PlacePlanes(const DrawnValues& values, SliceScene& scene)
{
  const ValueLayout& layout = values.layout;
  const glm::ivec3 axes = axesAcrossPlanes(values.grid.direction);
  const bool shown[3] = { this->ShowSagittal, this->ShowCoronal, this->ShowAxial };
  for (int plane = 0; plane < 3; ++plane)
  {
    scene.planes.shown[axes[plane]] = shown[plane];
    const std::array<double, 3>& color = PlaneColors[plane];
    scene.crosshairColors[axes[plane]] = glm::vec3(color[0], color[1], color[2]);
  }
  const glm::dvec3 position(this->SlicePosition[0], this->SlicePosition[1], this->SlicePosition[2]);
  scene.planes.position = textureFromWorld(values, position);
  const glm::dvec3 rounding = roundingOf(layout);
  scene.tissue.volumeLow = layout.low - rounding;
  scene.tissue.volumeHigh = layout.high + rounding;
  scene.planes.low = glm::min(scene.field.spaceLow, scene.tissue.volumeLow);
  scene.planes.high = glm::max(scene.field.spaceHigh, scene.tissue.volumeHigh);
  scene.crosshair = this->Crosshair;
  scene.opacity = this->Opacity;
  scene.mapsOpacity = this->MapOpacity;
}

// Tissue is not seen outside the volume, without a value, or where it is transparent. `texture`: in
// the layout that was drawn, which may be coarser than the voxels, or of a volume of which this
// rank has a part.
bool vtkDeformedSlicesMapper::IsSeenAt(const ValueLayout& drawn, const glm::dvec3& texture)
{
  State& state = *this->Internal;
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  const DrawnValues values = drawnValuesOf(this, image);
  const ValueLayout& layout = values.layout;
  if (!values.scalars)
  {
    return false;
  }
  const glm::dvec3 place = (texture - drawn.textureOfGridZero) / drawn.textureFromGrid;
  const Grid& grid = state.Part ? state.Part->whole.grid : values.grid;
  const glm::dvec3 first = glm::round(grid.gridFromWorld(values.grid.origin));
  glm::dvec3 rest = (place - first) * layout.textureFromGrid + layout.textureOfGridZero;
  if (state.Deformation.deformed)
  {
    rest =
      textureFromWorld(values, state.Deformation.map().restFromDeformed(grid.worldFromGrid(place)));
  }
  const std::optional<long long> index = nearestValue(layout, rest, roundingOf(layout));
  if (!index)
  {
    return false;
  }
  const int component = state.Property ? drawnComponents(state.Property, values.scalars).scalar : 0;
  const double value = numberOf(values.scalars, *index, component);
  const bool seenThrough = this->MapOpacity && state.Property &&
    state.Property->GetScalarOpacity()->GetValue(value) <= 0.0;
  return std::isfinite(value) && !seenThrough;
}

// On several ranks, each answers for the part of the planes that it draws.
bool vtkDeformedSlicesMapper::IsOfThisRank(const glm::dvec3& world)
{
  const std::optional<DrawnPart>& part = this->Internal->Part;
  bool inside = true;
  for (int axis = 0; part && axis < 3; ++axis)
  {
    inside = inside && world[axis] >= part->cut[2 * axis] && world[axis] <= part->cut[2 * axis + 1];
  }
  return inside;
}

bool vtkDeformedSlicesMapper::Pick(
  vtkRenderer* renderer, int x, int y, double position[3], double normal[3])
{
  Device* device = this->Internal->Devices.find(renderer->GetRenderWindow());
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!device || !image || image->GetNumberOfPoints() == 0) // another MPI rank draws all of it now
  {
    return false;
  }
  for (const SliceHit& hit : hitsUnderPixel(device->Drawn, renderer, x, y))
  {
    if (this->IsOfThisRank(hit.world) && this->IsSeenAt(device->DrawnLayout, hit.texture))
    {
      std::copy_n(&hit.world[0], 3, position);
      std::copy_n(&hit.normal[0], 3, normal);
      return true;
    }
  }
  return false;
}

void vtkDeformedSlicesMapper::DescribeTissue(
  vtkWindow* window, const double deformedMm[3], TissueFacts& facts)
{
  if (auto image = vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    this->UpdateDeformation(image);
    const Device* device = this->Internal->Devices.find(window);
    facts = factsAt(image, drawnValuesOf(this, image), this->Internal->Deformation,
      { deformedMm[0], deformedMm[1], deformedMm[2] }, [&](const glm::dvec3& place) {
        return device ? device->Bricks.bricks().numberAt(window, place) : std::optional<double>();
      });
  }
}

void vtkDeformedSlicesMapper::FindSameTissue(const double place[3], bool toRest, double found[3])
{
  if (auto image = vtkImageData::SafeDownCast(this->GetDataSetInput()))
  {
    this->UpdateDeformation(image);
  }
  const glm::dvec3 same =
    sameTissue(this->Internal->Deformation, { place[0], place[1], place[2] }, toRest);
  std::copy_n(&same[0], 3, found);
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

const Counters& vtkDeformedSlicesMapper::CountDetail()
{
  Counters& count = this->Internal->Count;
  resetDetail(count);
  this->Internal->Devices.visitAnyhow(
    [&](const Device& device) { device.Bricks.bricks().count(count); });
  return count;
}

const Counters& vtkDeformedSlicesMapper::GetCounters()
{
  Counters& count = this->Internal->Count;
  count.gpuScalarBytes = 0;
  count.gpuOtherBytes = 0;
  this->CountDetail();
  this->Internal->Devices.visit([&](Device& device) {
    count.gpuScalarBytes +=
      textureBytes(device.Tissue.scalars()) + textureBytes({ device.Bricks.bricks().textures() });
    count.gpuOtherBytes += textureBytes({ device.Reference.textures(),
      device.Tissue.otherTextures(), device.Deformation.field().textures(),
      { device.Evidence.texture() }, device.Resected.textures(), device.Bricks.images() });
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
     << indent << "Crosshair: " << this->Crosshair << "\n"
     << indent << "Interpolation: " << this->Interpolation << "\n"
     << indent << "ShowEvidence: " << this->ShowEvidence << "\n"
     << indent << "Opacity: " << this->Opacity << "\n"
     << indent << "MapOpacity: " << this->MapOpacity << "\n"
     << indent << "Comparison: " << this->Comparison << "\n"
     << indent << "ComparisonColors: " << this->ComparisonColors << "\n"
     << indent << "CheckerSize: " << this->CheckerSize << "\n"
     << indent << "ReferenceRange: " << this->ReferenceRange[0] << " " << this->ReferenceRange[1]
     << "\n"
     << indent << "FullGradient: " << this->FullGradient << "\n"
     << indent << "SimilarityWindow: " << this->SimilarityWindow << "\n"
     << indent << "WipePosition: " << this->WipePosition[0] << " " << this->WipePosition[1] << " "
     << this->WipePosition[2] << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n"
     << indent << "WaitsForDetail: " << this->WaitsForDetail << "\n";
}
