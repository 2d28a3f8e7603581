// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeMapper.h"

#include "DeformableVolume.h"
#include "DeformedPresence.h"
#include "FieldTexture.h"
#include "NormalTexture.h"
#include "RayCaster.h"
#include "ScalarTexture.h"
#include "SceneDepth.h"
#include "SceneGeometry.h"
#include "TextureMemory.h"
#include "TransferTexture.h"

#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtkWeakPointer.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace brainshift;

struct vtkDeformedVolumeMapper::State
{
  ScalarTexture Scalars;
  TransferTexture Transfer;
  FieldTexture Field;
  brainshift::NormalTexture Normals;
  DeformedPresence Presence;
  PresenceRequest Bricks; // what Presence shows
  SceneDepth Depth;
  RayCaster Caster;
  Counters Count;
  vtkOpenGLRenderTimer FieldTimer;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window; // whose context holds all of these

  // The deformation of the input, as read at DeformationTime.
  bool Deformed = false;
  Deformation Source;
  FieldRequest Request;
  IndexBox Moved; // nodes of the offset field that can differ from zero
  unsigned long long DeformationTime = 0;
  bool FieldCurrent = false; // the GPU's field shows Request

  vtkNew<vtkSmartVolumeMapper> Fallback;
  std::string Reported; // the last trouble told

  double SecondsPerPixel = 0.0; // of the last image; 0: none yet
};

namespace
{
// A window that wants this many frames a second is being moved; still pictures ask for far fewer.
constexpr double InteractiveRate = 1.0;
// ParaView asks for 5 a second while the camera moves. Below 15 a hand sees steps.
constexpr double SmoothRate = 15.0;
constexpr int LargestImageScale = 4;

// Which number of a tuple the colour map shows; -1: the vector's length.
int shownComponent(vtkVolumeProperty* property, vtkDataArray* scalars)
{
  if (scalars->GetNumberOfComponents() == 1)
  {
    return 0;
  }
  vtkColorTransferFunction* color = property->GetRGBTransferFunction();
  return color->GetVectorMode() == vtkScalarsToColors::COMPONENT ? color->GetVectorComponent() : -1;
}
}

vtkStandardNewMacro(vtkDeformedVolumeMapper);

vtkDeformedVolumeMapper::vtkDeformedVolumeMapper()
  : Internal(std::make_unique<State>())
{
}

vtkDeformedVolumeMapper::~vtkDeformedVolumeMapper() = default;

// Reads the deformation if it changed.
void vtkDeformedVolumeMapper::UpdateDeformation(vtkImageData* image)
{
  State& state = *this->Internal;
  const unsigned long long time = deformationTime(image);
  if (time == state.DeformationTime)
  {
    return;
  }
  state.DeformationTime = time;
  state.FieldCurrent = false;
  std::string problem;
  state.Deformed = carriesDeformation(image) && readDeformation(image, state.Source, problem);
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem << ". The volume is drawn undeformed.");
  }
  if (!state.Deformed)
  {
    return;
  }
  const Lattice lattice = effectiveLattice(state.Source);
  state.Request.dimensions = lattice.grid.dimensions;
  state.Request.kernel = lattice.kernel;
  state.Request.samples = state.Source.samples;
  state.Request.inverse = state.Source.inverse;
  state.Request.inCells = displacementsInCells(lattice);
  state.Request.nodes = backwardNodes(lattice.grid, state.Request.inCells, state.Source.samples);
  state.Moved =
    movedBackwardNodes(lattice.grid.dimensions, state.Request.inCells, state.Request.nodes);
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
  const State& state = *this->Internal;
  if (!state.Deformed)
  {
    return this->Bounds;
  }
  const FieldNodes& nodes = state.Request.nodes;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world = state.Source.lattice.grid.worldFromGrid(
      glm::dvec3(nodes.latticeFromNode(side * glm::vec3(nodes.count - 1))));
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Bounds[2 * axis] = std::min(this->Bounds[2 * axis], world[axis]);
      this->Bounds[2 * axis + 1] = std::max(this->Bounds[2 * axis + 1], world[axis]);
    }
  }
  return this->Bounds;
}

void vtkDeformedVolumeMapper::Render(vtkRenderer* renderer, vtkVolume* volume)
{
  this->GetInputAlgorithm()->Update();
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  std::string problem;
  if (!this->Draw(renderer, volume, problem))
  {
    this->DrawUndeformed(renderer, volume, problem);
  }
  timer->StopTimer();
  this->TimeToDraw = timer->GetElapsedTime();
}

bool vtkDeformedVolumeMapper::Draw(vtkRenderer* renderer, vtkVolume* volume, std::string& problem)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  auto image = vtkImageData::SafeDownCast(this->GetDataSetInput());
  if (!window || !image)
  {
    problem = "Deformed Volume draws image data in an OpenGL window only";
    return false;
  }
  window->MakeCurrent();
  state.Window = window;
  int cells = 0;
  vtkDataArray* scalars = this->GetScalars(
    image, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cells);
  const Grid grid = gridOf(image);
  const ValueLayout layout = layoutOf(grid.dimensions, cells != 0);
  if (!scalars ||
    static_cast<std::size_t>(scalars->GetNumberOfTuples()) <
      static_cast<std::size_t>(layout.dimensions.x) * layout.dimensions.y * layout.dimensions.z)
  {
    return true; // nothing to draw yet
  }
  this->UpdateDeformation(image);
  RayCastScene scene;
  if (!this->PrepareTissue(window, volume->GetProperty(), scalars, grid, layout, scene, problem) ||
    !this->PrepareSpace(window, grid, layout, scene, problem))
  {
    return false;
  }
  this->DescribeView(renderer, volume, grid, layout, scene);
  glm::ivec2 origin;
  glm::ivec2 size;
  renderer->GetTiledSizeAndOrigin(&size.x, &size.y, &origin.x, &origin.y);
  state.Count.imageScale = this->ImageScale(window, size);
  scene.size = glm::max(size / static_cast<int>(state.Count.imageScale), glm::ivec2(1));
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  if (!state.Caster.cast(window, scene, state.Count))
  {
    problem = "The ray caster's shader does not compile or its images cannot be made on this GPU";
    return false;
  }
  if (this->AdaptiveQuality)
  {
    window->WaitForCompletion(); // else the time is that of the commands, not of the image
    timer->StopTimer();
    state.SecondsPerPixel =
      timer->GetElapsedTime() / (static_cast<double>(scene.size.x) * scene.size.y);
  }
  return state.Caster.composite(window, origin, size, state.Count);
}

// Screen pixels a side for one pixel of the image to come.
int vtkDeformedVolumeMapper::ImageScale(vtkOpenGLRenderWindow* window, const glm::ivec2& size) const
{
  const double rate = window->GetDesiredUpdateRate();
  if (!this->AdaptiveQuality || rate < InteractiveRate)
  {
    return 1;
  }
  const double fullTime = this->Internal->SecondsPerPixel * size.x * size.y;
  const double allowed = 1.0 / std::max(rate, SmoothRate);
  const int scale = static_cast<int>(std::ceil(std::sqrt(fullTime / allowed)));
  return std::clamp(scale, 1, LargestImageScale);
}

// Scalars, gradients, colour and opacity.
bool vtkDeformedVolumeMapper::PrepareTissue(vtkOpenGLRenderWindow* window,
  vtkVolumeProperty* property, vtkDataArray* scalars, const Grid& grid, const ValueLayout& layout,
  RayCastScene& scene, std::string& problem)
{
  State& state = *this->Internal;
  const auto uploads = state.Count.volumeUploads;
  if (!state.Scalars.update(window, scalars, layout.dimensions, shownComponent(property, scalars),
        state.Count, problem))
  {
    return false;
  }
  const double smallestSide = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  scene.stepMm = this->SampleDistance > 0.0 ? this->SampleDistance : 0.5 * smallestSide;
  const bool newColours = state.Transfer.update(window, property, scene.stepMm, state.Count);
  if (newColours || uploads != state.Count.volumeUploads)
  {
    this->UpdateVisibility(window);
  }
  scene.shaded = property->GetShade() != 0;
  scene.voxel = layout.textureFromGrid;
  if (scene.shaded && this->NormalTexture != OnTheFly)
  {
    using Gradients = brainshift::NormalTexture;
    const Gradients::Form form = this->NormalTexture == HalfResolution ? Gradients::Half
      : state.Scalars.sixteenBits()                                    ? Gradients::Packed
                                                                       : Gradients::Full;
    if (!state.Normals.update(window, state.Scalars.texture(), layout.dimensions, form,
          state.Scalars.range(), state.Count))
    {
      problem =
        "The gradients' shader does not compile or their texture cannot be made on this GPU";
      return false;
    }
    scene.normals = state.Normals.texture();
    scene.packedNormals = state.Normals.packed();
  }
  scene.scalars = state.Scalars.texture();
  scene.transfer = state.Transfer.texture();
  scene.transferFromScalar = glm::dvec2(state.Scalars.scale() * state.Transfer.scale(),
    state.Scalars.shift() * state.Transfer.scale() + state.Transfer.shift());
  scene.material = glm::dvec4(property->GetAmbient(), property->GetDiffuse(),
    property->GetSpecular(), property->GetSpecularPower());
  scene.volumeLow = layout.low;
  scene.volumeHigh = layout.high;
  return true;
}

// The rest volume's visibility, after a change of scalars, colour map or opacity.
void vtkDeformedVolumeMapper::UpdateVisibility(vtkOpenGLRenderWindow* window)
{
  State& state = *this->Internal;
  const BrickRanges& ranges = state.Scalars.ranges();
  std::vector<float> summed = summedVisibility(
    ranges, state.Transfer.visibleValues(state.Scalars.scale(), state.Scalars.shift()));
  state.Presence.setVisibility(window, ranges.count, summed, state.Count);
}

// The offset field and the bricks of the deformed frame.
bool vtkDeformedVolumeMapper::PrepareSpace(vtkOpenGLRenderWindow* window, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene, std::string& problem)
{
  State& state = *this->Internal;
  scene.spaceLow = layout.low;
  scene.spaceHigh = layout.high;
  IndexBox changed; // nodes of the offset field
  if (state.Deformed)
  {
    const Grid& lattice = state.Source.lattice.grid;
    const glm::vec3 offsetScale(textureFromLattice(grid, layout, lattice));
    if (!state.FieldCurrent || offsetScale != state.Request.offsetScale)
    {
      state.Request.offsetScale = offsetScale;
      state.FieldTimer.Start();
      const bool updated = state.Field.update(window, state.Request, state.Count);
      state.FieldTimer.Stop();
      if (!updated)
      {
        problem = "The deformation's shaders do not compile or its 3D float textures cannot be "
                  "made on this GPU";
        return false;
      }
      state.FieldCurrent = true;
      changed = state.Field.changed();
    }
    scene.offsets = state.Field.offsets();
    placeField(grid, layout, lattice, state.Request.nodes, state.Moved, scene);
  }
  placeBricks(layout, scene, state.Bricks);
  if (!state.Presence.update(window, state.Bricks, changed, state.Count))
  {
    problem =
      "The presence map's shader does not compile or its texture cannot be made on this GPU";
    return false;
  }
  if (this->Cropping && this->CroppingRegionFlags == VTK_CROP_SUBVOLUME)
  {
    cropSpace(grid, layout, this->CroppingRegionPlanes, scene);
  }
  scene.presence = &state.Presence;
  scene.skipping = this->EmptySpaceSkipping;
  return true;
}

// Camera, light and what is drawn already.
void vtkDeformedVolumeMapper::DescribeView(vtkRenderer* renderer, vtkVolume* volume,
  const Grid& grid, const ValueLayout& layout, RayCastScene& scene)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  glm::ivec2 origin;
  glm::ivec2 size;
  renderer->GetTiledSizeAndOrigin(&size.x, &size.y, &origin.x, &origin.y);
  state.Depth.capture(window, origin, size);
  scene.sceneDepth = state.Depth.texture();
  scene.clipFromWorld = clipFromWorld(renderer);
  scene.worldFromTexture = worldFromTexture(grid, layout, volume->GetMatrix());
  scene.lights = lightsOf(renderer);
}

bool vtkDeformedVolumeMapper::Pick(vtkRenderer* renderer, int x, int y, double position[3])
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!window)
  {
    return false;
  }
  window->MakeCurrent();
  glm::dvec4 hit;
  const int scale = static_cast<int>(state.Count.imageScale);
  if (x < 0 || y < 0 || !state.Caster.hitAt(window, { x / scale, y / scale }, hit))
  {
    return false;
  }
  std::copy_n(&hit[0], 3, position);
  return true;
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
  // In software: what stopped us would stop VTK's GPU mapper too, some of it by an abort.
  state.Fallback->SetRequestedRenderModeToRayCast();
  state.Fallback->SetInputConnection(this->GetInputConnection(0, 0));
  state.Fallback->SetScalarMode(this->ScalarMode);
  state.Fallback->SelectScalarArray(this->ArrayName);
  state.Fallback->Render(renderer, volume);
}

void vtkDeformedVolumeMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  State& state = *this->Internal;
  state.Scalars.releaseGraphicsResources(window);
  state.Transfer.releaseGraphicsResources(window);
  state.Normals.releaseGraphicsResources(window);
  state.Presence.releaseGraphicsResources(window);
  state.Field.releaseGraphicsResources(window);
  state.Depth.releaseGraphicsResources(window);
  state.Caster.releaseGraphicsResources(window);
  state.FieldTimer.ReleaseGraphicsResources();
  state.FieldCurrent = false;
  state.Window = nullptr;
  state.Fallback->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

// Asked for here and not in every frame: the driver's answers may make it wait for the GPU.
void vtkDeformedVolumeMapper::AskTheGpu()
{
  State& state = *this->Internal;
  if (!state.Window)
  {
    return;
  }
  state.Window->MakeCurrent();
  state.Count.gpuScalarBytes = textureBytes(state.Scalars.texture());
  state.Count.gpuOtherBytes = state.Presence.faceBytes() +
    textureBytes({ { state.Transfer.texture(), state.Normals.texture(), state.Depth.texture() },
      state.Field.textures(), state.Presence.textures(), state.Caster.textures() });
  if (state.FieldTimer.Stopped() && state.FieldTimer.Ready())
  {
    constexpr std::int64_t nanosecondsInMicrosecond = 1000;
    state.Count.gpuFieldMicroseconds =
      static_cast<std::int64_t>(state.FieldTimer.GetElapsedNanoseconds()) /
      nanosecondsInMicrosecond;
  }
}

const Counters& vtkDeformedVolumeMapper::GetCounters()
{
  this->AskTheGpu();
  return this->Internal->Count;
}

void vtkDeformedVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleDistance: " << this->SampleDistance << "\n"
     << indent << "EmptySpaceSkipping: " << this->EmptySpaceSkipping << "\n"
     << indent << "AdaptiveQuality: " << this->AdaptiveQuality << "\n"
     << indent << "NormalTexture: " << this->NormalTexture << "\n";
}
