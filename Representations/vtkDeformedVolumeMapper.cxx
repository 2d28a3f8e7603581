// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeMapper.h"

#include "Representations/Tissue/DeviceReference.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Picture/Picture.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Field/SceneDeformation.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Picture/SelectionCover.h"
#include "Representations/Window/SoftwareFallback.h"
#include "Representations/Gpu/TextureMemory.h"
#include "Representations/Traces/TracePoints.h"
#include "Representations/Gpu/WindowDevices.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/common.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

using namespace brainshift;

struct vtkDeformedVolumeMapper::Device
{
  PresentTissue Own;
  DeviceReference Reference;
  DeviceDeformation Deformation;
  Picture Shown;
  SelectionCover Cover;
  GpuMemory Memory;

  void Release(vtkWindow* window);
};

struct vtkDeformedVolumeMapper::State
{
  WindowDevices<Device> Devices;
  Counters Count;
  SceneDeformation Deformation; // of the input

  bool TakesInput = false;
  unsigned long long SettingsTime = 0; // of the last change, but for the input

  vtkNew<vtkSmartVolumeMapper> Fallback;
  std::string Reported;       // the last trouble told
  std::set<std::string> Told; // unsupported choices
};

vtkStandardNewMacro(vtkDeformedVolumeMapper);

vtkDeformedVolumeMapper::vtkDeformedVolumeMapper()
  : Internal(std::make_unique<State>())
{
}

vtkDeformedVolumeMapper::~vtkDeformedVolumeMapper() = default;

// ParaView hands over the same input anew with each stroke, which changes no setting.
void vtkDeformedVolumeMapper::SetInputConnection(int port, vtkAlgorithmOutput* input)
{
  this->Internal->TakesInput = true;
  this->Superclass::SetInputConnection(port, input);
  this->Internal->TakesInput = false;
}

void vtkDeformedVolumeMapper::Modified()
{
  this->Superclass::Modified();
  if (this->Internal && !this->Internal->TakesInput)
  {
    this->Internal->SettingsTime = this->GetMTime();
  }
}

// Reads the deformation if it changed.
void vtkDeformedVolumeMapper::UpdateDeformation(vtkImageData* image)
{
  std::string problem;
  if (!this->Internal->Deformation.update(image, problem))
  {
    vtkErrorMacro(<< problem << ". The volume is drawn undeformed.");
  }
}

double* vtkDeformedVolumeMapper::GetBounds()
{
  vtkVolumeMapper::GetBounds();
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!image)
  {
    return this->Bounds;
  }
  this->UpdateDeformation(image);
  this->Internal->Deformation.widen(this->Bounds);
  widenByReference(image, this->Bounds);
  return this->Bounds;
}

void vtkDeformedVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->GetInputAlgorithm()->Update();
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  std::string problem;
  if (renderer->GetSelector())
  {
    if (!selectsPoints(renderer))
    {
      this->CoverSelection(renderer);
    }
  }
  else if (!this->Draw(renderer, volume, problem))
  {
    this->DrawUndeformed(renderer, volume, problem);
  }
  timer->StopTimer();
  this->TimeToDraw = timer->GetElapsedTime();
}

void vtkDeformedVolumeMapper::CoverSelection(vtkRenderer* renderer)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Device* device = this->Internal->Devices.find(window);
  if (!device || !device->Shown.images().hits())
  {
    return;
  }
  if (!device->Cover.draw(window, renderer, *device->Shown.images().hits(), this->Internal->Count))
  {
    vtkErrorMacro("The selection's shader does not compile. Selections reach through the volume.");
  }
}

bool vtkDeformedVolumeMapper::Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!window || !image)
  {
    problem = "Deformed Volume draws image data in an OpenGL window only";
    return false;
  }
  window->MakeCurrent();
  const ShownValues shown = shownValuesOf(this, image);
  const Grid& grid = shown.grid;
  if (!shown.scalars)
  {
    return true; // nothing to draw yet
  }
  this->UpdateDeformation(image);
  vtkVolumeProperty* property = volume->GetProperty();
  this->TellUnsupported(property, shown.scalars);
  const double smallestSide = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  const TissueRequest tissue{ property, shown.scalars, shown.layout,
    this->SampleDistance > 0.0 ? this->SampleDistance : 0.5 * smallestSide, blendOf(this, property),
    static_cast<GradientSource>(this->NormalTexture),
    property->GetInterpolationType() == VTK_NEAREST_INTERPOLATION,
    this->SegmentOf(image, grid, shown.layout), {} };
  SceneReference reference = this->FindReference(image, tissue);
  Device& device = this->Internal->Devices.of(window);
  takeOutOfMemory(); // what others left behind
  const auto draw = [&] {
    return this->AskForMemory(renderer, device, tissue, reference, problem) &&
      this->DrawTissue(renderer, device, volume, tissue, grid, reference, problem);
  };
  const bool drawn = draw();
  if (takeOutOfMemory())
  {
    device.Memory.refuse();
    device.Shown.forget();
    return draw(); // less of it, if anything
  }
  return drawn;
}

SceneReference vtkDeformedVolumeMapper::FindReference(
  vtkImageData* image, const TissueRequest& tissue)
{
  const SceneReference reference =
    referenceOf(image, tissue, { this->ReferenceRange[0], this->ReferenceRange[1] });
  if (!reference.exists() || reference.show == ReferenceShow::Reference)
  {
    return reference;
  }
  const bool compared = reference.show == ReferenceShow::Both && this->Comparison != NoComparison;
  if (compared && tissue.blend != Blend::Composite)
  {
    this->TellOnce("Red and green need blend mode Composite: the volume is drawn alone");
  }
  return compared && tissue.blend == Blend::Composite ? reference : SceneReference();
}

bool vtkDeformedVolumeMapper::DrawTissue(vtkRenderer* renderer, Device& device, vtkVolume* volume,
  const TissueRequest& tissue, const Grid& grid, const SceneReference& reference,
  std::string& problem)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  RayCastScene scene;
  RayCastScene referenceScene;
  device.Shown.begin();
  const bool described = reference.isAlone()
    ? this->DescribeReference(renderer, device, volume, tissue, grid, reference, scene, problem)
    : this->DescribeTissue(renderer, device, volume, tissue, grid, scene, problem);
  if (!described)
  {
    return false;
  }
  this->TellOnce(device.Own.Tissue.remark());
  if (reference.exists() && !reference.isAlone())
  {
    this->Compare(renderer, device, volume, grid, reference, scene, referenceScene);
  }
  PictureWish wish;
  glm::ivec2& size = scene.size;
  renderer->GetTiledSizeAndOrigin(&size.x, &size.y, &wish.origin.x, &wish.origin.y);
  const glm::ivec2 whole = size;
  wish.adaptive = this->AdaptiveQuality;
  wish.keep = this->KeepPicture || TracePoints::areShownIn(renderer);
  wish.rate = window->GetDesiredUpdateRate();
  wish.settingsTime = this->Internal->SettingsTime;
  scene.countSamples = this->CountSamples;
  if (!device.Shown.cast(renderer, volume, wish, scene, state.Count))
  {
    problem = "The ray caster's shader does not compile or its images cannot be made on this GPU";
    return false;
  }
  const bool drawn = device.Shown.images().composite(window, wish.origin, whole, state.Count);
  device.Shown.end();
  return drawn;
}

// The tissue, the offset field and the bricks of the deformed frame, and how they are seen.
bool vtkDeformedVolumeMapper::DescribeTissue(vtkRenderer* renderer, Device& device,
  vtkVolume* volume, const TissueRequest& tissue, const Grid& grid, RayCastScene& scene,
  std::string& problem)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  DeviceDeformation::Change change;
  if (!device.Own.Tissue.update(window, tissue, scene, state.Count, problem) ||
    !device.Deformation.update(
      window, state.Deformation, grid, tissue.layout, scene, change, state.Count, problem))
  {
    return false;
  }
  device.Shown.bend(change.bent); // known to the next picture if this one fails
  if (!device.Own.updatePresence(
        window, tissue.layout, scene, change.computed, state.Count, problem))
  {
    return false;
  }
  this->DescribeCropping(grid, tissue.layout, scene);
  this->DescribeOptions(renderer, volume, device.Own.Tissue, tissue, grid, scene);
  return true;
}

// The reference in place of the volume: not bent, in ordinary colours, cropped as the volume is.
bool vtkDeformedVolumeMapper::DescribeReference(vtkRenderer* renderer, Device& device,
  vtkVolume* volume, const TissueRequest& tissue, const Grid& grid, const SceneReference& reference,
  RayCastScene& scene, std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!device.Reference.update(window, reference, scene, this->Internal->Count, problem))
  {
    return false;
  }
  this->DescribeOptions(
    renderer, volume, device.Reference.Present.Tissue, reference.tissue, reference.grid, scene);
  if (!cropByPlanes(this, volume, grid, tissue.layout, scene))
  {
    this->TellOnce("Of cropping, only the middle region cuts a reference that is shown alone");
  }
  return true;
}

void vtkDeformedVolumeMapper::DescribeOptions(vtkRenderer* renderer, vtkVolume* volume,
  const Tissue& drawn, const TissueRequest& tissue, const Grid& grid, RayCastScene& scene)
{
  scene.skipping = this->EmptySpaceSkipping && drawn.skippingIsExact(tissue.blend);
  describeView(renderer, volume, grid, tissue.layout, scene);
  describeOptions(
    this, tissue.property, tissue.scalars, drawn.stored(), scene.worldFromTexture, scene.options);
}

// Where the reference cannot be had, the volume is drawn alone.
void vtkDeformedVolumeMapper::Compare(vtkRenderer* renderer, Device& device, vtkVolume* volume,
  const Grid& grid, const SceneReference& reference, RayCastScene& scene, RayCastScene& alone)
{
  std::string problem;
  if (!device.Reference.compare(
        renderer, volume, reference, scene, alone, this->Internal->Count, problem))
  {
    device.Reference.releaseGraphicsResources(renderer->GetRenderWindow());
    this->TellOnce(problem + ". The reference is not drawn");
    return;
  }
  constexpr double usualVoxels = 2.0;
  scene.comparison.agreementMm = this->AgreementDistance > 0.0
    ? this->AgreementDistance
    : usualVoxels * std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
}

// The middle region alone narrows the space; others are asked for at each sample.
void vtkDeformedVolumeMapper::DescribeCropping(
  const Grid& grid, const ValueLayout& layout, RayCastScene& scene)
{
  if (!this->Cropping)
  {
    return;
  }
  RayCastOptions& options = scene.options;
  cropBox(grid, layout, this->CroppingRegionPlanes, options.regionLow, options.regionHigh);
  if (this->CroppingRegionFlags == VTK_CROP_SUBVOLUME)
  {
    scene.spaceLow = glm::max(scene.spaceLow, options.regionLow);
    scene.spaceHigh = glm::min(scene.spaceHigh, options.regionHigh);
    scene.comparison.cropLow = options.regionLow;
    scene.comparison.cropHigh = options.regionHigh;
    return;
  }
  options.regions = true;
  options.regionFlags = this->CroppingRegionFlags;
}

// Before memory is taken: some drivers end the program when there is none.
// Where there is too little for the reference, the volume is drawn without it.
bool vtkDeformedVolumeMapper::AskForMemory(vtkRenderer* renderer, Device& device,
  const TissueRequest& tissue, SceneReference& reference, std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  DrawnSizes sizes;
  addTissueSizes(tissue, sizes);
  glm::ivec2 origin;
  renderer->GetTiledSizeAndOrigin(&sizes.pixels.x, &sizes.pixels.y, &origin.x, &origin.y);
  this->Internal->Deformation.addSizes(sizes);
  MemoryNeed need = memoryNeed(sizes);
  if (reference.exists())
  {
    need.reference = referenceBytes(reference);
    problem = device.Memory.ask(window, need, this->MemoryLimit);
    if (problem.empty())
    {
      return true;
    }
    this->TellOnce(problem + ". The reference is not drawn");
    need.reference = 0;
    reference = SceneReference();
    device.Reference.releaseGraphicsResources(window);
  }
  problem = device.Memory.ask(window, need, this->MemoryLimit);
  return problem.empty();
}

void vtkDeformedVolumeMapper::TellUnsupported(vtkVolumeProperty* property, vtkDataArray* scalars)
{
  for (const std::string& sentence : unsupportedChoices(this, property, scalars))
  {
    this->TellOnce(sentence);
  }
}

void vtkDeformedVolumeMapper::TellOnce(const std::string& sentence)
{
  if (!sentence.empty() && this->Internal->Told.insert(sentence).second)
  {
    vtkWarningMacro(<< sentence << ".");
  }
}

// No segmentation where all tissue is drawn.
SegmentRequest vtkDeformedVolumeMapper::SegmentOf(
  vtkImageData* image, const Grid& grid, const ValueLayout& layout)
{
  if (!this->DrawSegment)
  {
    return {};
  }
  std::string remark;
  SegmentRequest request = requestSegment(image, grid, layout, this->DrawnLabels, remark);
  this->TellOnce(remark);
  return request;
}

bool vtkDeformedVolumeMapper::Pick(vtkRenderer* renderer, int x, int y, double position[3])
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  Device* device = this->Internal->Devices.find(window);
  const int* size = renderer->GetSize();
  if (!device || x < 0 || y < 0 || x >= size[0] || y >= size[1])
  {
    return false;
  }
  window->MakeCurrent();
  glm::dvec4 hit;
  const glm::dvec2 place = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size[0], size[1]);
  if (!device->Shown.images().hitAt(window, place, hit))
  {
    return false;
  }
  std::copy_n(&hit[0], 3, position);
  return true;
}

const FirstHits* vtkDeformedVolumeMapper::GetHits(vtkWindow* window)
{
  Device* device = this->Internal->Devices.find(window);
  return device ? device->Shown.images().drawnHits() : nullptr;
}

void vtkDeformedVolumeMapper::DrawUndeformed(
  vtkRenderer* renderer, vtkVolume* volume, const std::string& problem)
{
  State& state = *this->Internal;
  if (state.Reported != problem)
  {
    vtkErrorMacro(<< problem << ". VTK's software mapper draws the volume undeformed.");
    state.Reported = problem;
  }
  drawInSoftware(this, state.Fallback);
  state.Fallback->Render(renderer, volume);
}

void vtkDeformedVolumeMapper::Device::Release(vtkWindow* window)
{
  this->Own.releaseGraphicsResources(window);
  this->Reference.releaseGraphicsResources(window);
  this->Deformation.releaseGraphicsResources(window);
  this->Shown.releaseGraphicsResources(window);
  this->Cover.releaseGraphicsResources();
}

void vtkDeformedVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Devices.release(window);
  this->Internal->Fallback->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

// Asked for here and not in every frame: the driver's answers may make it wait for the GPU.
void vtkDeformedVolumeMapper::AskTheGpu()
{
  Counters& count = this->Internal->Count;
  count.gpuScalarBytes = 0;
  count.gpuOtherBytes = 0;
  this->Internal->Devices.visit([&](Device& device) {
    count.gpuScalarBytes += textureBytes(device.Own.Tissue.scalars());
    count.gpuOtherBytes += device.Own.otherBytes() + device.Reference.bytes() +
      textureBytes({ device.Deformation.field().textures(), device.Shown.textures() });
    device.Deformation.askTime(count.gpuFieldMicroseconds);
  });
}

const Counters& vtkDeformedVolumeMapper::GetCounters()
{
  this->AskTheGpu();
  return this->Internal->Count;
}
