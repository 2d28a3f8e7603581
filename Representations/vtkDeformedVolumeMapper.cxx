// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformedVolumeMapper.h"

#include "DeformableVolume.h"
#include "FieldTexture.h"
#include "RayCaster.h"
#include "ScalarTexture.h"
#include "SceneDepth.h"
#include "TransferTexture.h"

#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkColorTransferFunction.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSmartVolumeMapper.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <string>

using namespace brainshift;

// How the values of the drawn array lie: on points, or in cells, in the image's grid coordinates.
struct ValueLayout
{
  glm::ivec3 dimensions{ 0 };
  glm::dvec3 textureFromGrid{ 1.0 }; // texture = grid * textureFromGrid + textureOfFirst
  glm::dvec3 textureOfFirst{ 0.0 };
  glm::dvec3 low{ 0.0 }; // the volume's box, texture coordinates
  glm::dvec3 high{ 1.0 };
};

struct vtkDeformedVolumeMapper::State
{
  ScalarTexture Scalars;
  TransferTexture Transfer;
  FieldTexture Field;
  SceneDepth Depth;
  RayCaster Caster;
  Counters Count;

  // The deformation of the input, as read at DeformationTime.
  bool Deformed = false;
  Deformation Source;
  FieldRequest Request;
  unsigned long long DeformationTime = 0;
  bool FieldCurrent = false; // the GPU's field shows Request

  vtkNew<vtkSmartVolumeMapper> Fallback;
  std::string Reported; // the last trouble told
};

namespace
{
ValueLayout layoutOf(const glm::ivec3& points, bool cells)
{
  ValueLayout layout;
  layout.dimensions = cells ? glm::max(points - 1, glm::ivec3(1)) : points;
  const glm::dvec3 values(layout.dimensions);
  layout.textureFromGrid = 1.0 / values;
  layout.textureOfFirst = cells ? glm::dvec3(0.0) : 0.5 / values;
  layout.low = layout.textureOfFirst;
  layout.high = glm::dvec3(points - 1) * layout.textureFromGrid + layout.textureOfFirst;
  return layout;
}

glm::dmat4 worldFromTexture(const Grid& grid, const ValueLayout& layout, vtkMatrix4x4* actor)
{
  glm::dmat4 worldFromVolume;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      worldFromVolume[column][row] = actor->GetElement(row, column);
    }
  }
  glm::dmat4 volumeFromTexture(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    volumeFromTexture[axis] = glm::dvec4(
      grid.direction[axis] * (grid.spacing[axis] / layout.textureFromGrid[axis]), 0.0);
  }
  const glm::dvec3 gridOfTextureZero = -layout.textureOfFirst / layout.textureFromGrid;
  volumeFromTexture[3] = glm::dvec4(grid.worldFromGrid(gridOfTextureZero), 1.0);
  return worldFromVolume * volumeFromTexture;
}

glm::dmat4 clipFromWorld(vtkRenderer* renderer)
{
  glm::dmat4 matrix(1.0);
  vtkMatrix4x4* worldToView = nullptr;
  vtkMatrix3x3* normals = nullptr;
  vtkMatrix4x4* viewToClip = nullptr;
  vtkMatrix4x4* worldToClip = nullptr;
  auto camera = vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera());
  camera->GetKeyMatrices(renderer, worldToView, normals, viewToClip, worldToClip);
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      matrix[column][row] = worldToClip->GetElement(column, row); // VTK keeps it transposed
    }
  }
  return matrix;
}

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
  state.Deformed =
    carriesDeformation(image) && readDeformation(image, state.Source, problem);
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

bool vtkDeformedVolumeMapper::Draw(
  vtkRenderer* renderer, vtkVolume* volume, std::string& problem)
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
  int cells = 0;
  vtkDataArray* scalars = this->GetScalars(
    image, this->ScalarMode, this->ArrayAccessMode, this->ArrayId, this->ArrayName, cells);
  const Grid grid = gridOf(image);
  const ValueLayout layout = layoutOf(grid.dimensions, cells != 0);
  if (!scalars || static_cast<std::size_t>(scalars->GetNumberOfTuples()) <
      static_cast<std::size_t>(layout.dimensions.x) * layout.dimensions.y * layout.dimensions.z)
  {
    return true; // nothing to draw yet
  }
  vtkVolumeProperty* property = volume->GetProperty();
  if (!state.Scalars.update(window, scalars, layout.dimensions,
        shownComponent(property, scalars), state.Count, problem))
  {
    return false;
  }
  this->UpdateDeformation(image);

  RayCastScene scene;
  if (state.Deformed && !this->PrepareField(window, grid, layout, scene))
  {
    problem = "The deformation's shaders do not compile or its 3D float textures cannot be made "
              "on this GPU";
    return false;
  }
  this->DescribeScene(renderer, volume, grid, layout, scene);
  if (!state.Caster.cast(window, scene, state.Count))
  {
    problem = "The ray caster's shader does not compile on this GPU";
    return false;
  }
  int size[2];
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  return state.Caster.composite(
    window, { origin[0], origin[1] }, { size[0], size[1] }, state.Count);
}

bool vtkDeformedVolumeMapper::PrepareField(vtkOpenGLRenderWindow* window, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene)
{
  State& state = *this->Internal;
  const Grid& lattice = state.Source.lattice.grid;
  // Lattice, volume and texture share their axes: every mapping is a scale and a shift.
  const glm::dvec3 gridFromLattice = lattice.spacing / grid.spacing;
  const glm::dvec3 textureFromLattice = gridFromLattice * layout.textureFromGrid;
  const glm::vec3 offsetScale(textureFromLattice);
  if (!state.FieldCurrent || offsetScale != state.Request.offsetScale)
  {
    state.Request.offsetScale = offsetScale;
    if (!state.Field.update(window, state.Request, state.Count))
    {
      return false;
    }
    state.FieldCurrent = true;
  }
  const FieldNodes& nodes = state.Request.nodes;
  const glm::dvec3 count(nodes.count);
  const glm::dvec3 textureOfLatticeZero =
    grid.gridFromWorld(lattice.origin) * layout.textureFromGrid + layout.textureOfFirst;
  const glm::dvec3 first(nodes.first);
  scene.fieldFromTexture = static_cast<double>(nodes.perCell) / textureFromLattice / count;
  scene.fieldFromTextureShift =
    (0.5 - first * static_cast<double>(nodes.perCell)) / count -
    textureOfLatticeZero * scene.fieldFromTexture;
  scene.fieldTexel = 1.0 / count;
  scene.spaceLow = textureOfLatticeZero + first * textureFromLattice;
  scene.spaceHigh =
    scene.spaceLow + (count - 1.0) / static_cast<double>(nodes.perCell) * textureFromLattice;
  scene.offsets = state.Field.offsets();
  return true;
}

void vtkDeformedVolumeMapper::DescribeScene(vtkRenderer* renderer, vtkVolume* volume,
  const Grid& grid, const ValueLayout& layout, RayCastScene& scene)
{
  State& state = *this->Internal;
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  vtkVolumeProperty* property = volume->GetProperty();
  const double smallestSide = std::min({ grid.spacing.x, grid.spacing.y, grid.spacing.z });
  scene.stepMm = this->SampleDistance > 0.0 ? this->SampleDistance : 0.5 * smallestSide;
  state.Transfer.update(window, property, scene.stepMm, state.Count);

  glm::ivec2 origin;
  renderer->GetTiledSizeAndOrigin(&scene.size.x, &scene.size.y, &origin.x, &origin.y);
  state.Depth.capture(window, origin, scene.size);
  scene.sceneDepth = state.Depth.texture();
  scene.scalars = state.Scalars.texture();
  scene.transfer = state.Transfer.texture();
  scene.transferFromScalar = glm::dvec2(state.Scalars.scale() * state.Transfer.scale(),
    state.Scalars.shift() * state.Transfer.scale() + state.Transfer.shift());
  scene.clipFromWorld = clipFromWorld(renderer);
  scene.worldFromTexture = worldFromTexture(grid, layout, volume->GetMatrix());
  scene.volumeLow = layout.low;
  scene.volumeHigh = layout.high;
  if (!scene.offsets)
  {
    scene.spaceLow = layout.low;
    scene.spaceHigh = layout.high;
  }
  scene.voxel = layout.textureFromGrid;
  scene.shaded = property->GetShade() != 0;
  scene.material = glm::dvec4(property->GetAmbient(), property->GetDiffuse(),
    property->GetSpecular(), property->GetSpecularPower());
  scene.lights = lightsOf(renderer);
}

void vtkDeformedVolumeMapper::DrawUndeformed(
  vtkRenderer* renderer, vtkVolume* volume, const std::string& problem)
{
  State& state = *this->Internal;
  if (state.Reported != problem)
  {
    vtkErrorMacro(<< problem << ". VTK's own mapper draws the volume undeformed.");
    state.Reported = problem;
  }
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
  state.Field.releaseGraphicsResources(window);
  state.Depth.releaseGraphicsResources(window);
  state.Caster.releaseGraphicsResources(window);
  state.FieldCurrent = false;
  state.Fallback->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

const Counters& vtkDeformedVolumeMapper::GetCounters() const
{
  return this->Internal->Count;
}

void vtkDeformedVolumeMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SampleDistance: " << this->SampleDistance << "\n";
}
