// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceDrawer.h"

#include "Common/ScreenScale.h"
#include "Representations/Gpu/SceneScope.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

namespace brainshift
{
namespace
{
constexpr int FirstComponent = 0;

glm::dvec3 mmFromTexture(const Grid& grid, const ValueLayout& layout)
{
  return grid.spacing / layout.textureFromGrid;
}

// Fraction of the range of greys from what a texture stores: scale, shift.
glm::dvec2 fractionFromStored(const glm::dvec2& greys, const StoredScalar& value)
{
  const double length = greys.y > greys.x ? greys.y - greys.x : 1.0;
  return { value.scale / length, (value.shift - greys.x) / length };
}
}

std::array<WipePlane, 3> wipePlanes(
  const Grid& grid, const ValueLayout& layout, const glm::dvec3& positionMm)
{
  const glm::ivec3 axes = axesAcrossPlanes(grid.direction);
  const glm::dvec3 mm = mmFromTexture(grid, layout);
  const glm::dvec3 position =
    grid.gridFromWorld(positionMm) * layout.textureFromGrid + layout.textureOfGridZero;
  // Across the axis nearest to a world axis.
  const auto across = [&](int world) {
    const int axis = axes[world];
    WipePlane plane;
    plane.normal[axis] = grid.direction[axis][world] < 0.0 ? mm[axis] : -mm[axis];
    plane.shift = -plane.normal[axis] * position[axis];
    return plane;
  };
  enum World
  {
    X,
    Y,
    Z
  };
  std::array<WipePlane, 3> planes;
  planes[axes[X]] = across(Y);
  planes[axes[Y]] = planes[axes[Z]] = across(X);
  return planes;
}

bool ReferenceTextures::update(GpuTask& gpu, const ReferenceVolume& reference,
  const ComparisonChoice& choice, const ComparedVolume& volume, ReferenceScene& scene)
{
  const ValueLayout layout = layoutOf(reference.grid.dimensions, false);
  if (!this->Voxels.update(gpu, reference.voxels, layout, FirstComponent, reference.isLabels))
  {
    return false;
  }
  const int filter = volume.referenceNearest ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Voxels.texture()->SetMinificationFilter(filter);
  this->Voxels.texture()->SetMagnificationFilter(filter);
  vtkNew<vtkMatrix4x4> unmoved; // all of them are, alike
  const VolumePlace place{ worldFromTexture(volume.grid, volume.layout, unmoved), unmoved };
  scene.place = { this->Voxels.texture(), place.otherFromTexture(reference.grid, layout),
    layout.low, layout.high };
  scene.voxels = layout.dimensions;
  scene.cubic = volume.referenceCubic;
  scene.fractionFromReference = fractionFromStored(volume.greyRange,
    mappedFurther({ this->Voxels.scale(), this->Voxels.shift() }, volume.valueFromReference));
  scene.fractionFromScalar = fractionFromStored(volume.greyRange, volume.valueFromStored);
  const double scale = volume.transferFromStored.x / scene.fractionFromScalar.x;
  scene.transferFromFraction = { scale,
    volume.transferFromStored.y - scene.fractionFromScalar.y * scale };
  scene.comparison = reference.show == ReferenceShow::Reference ? 0 : choice.comparison;
  scene.colors = choice.colors;
  scene.checkersFromTexture = mmFromTexture(volume.grid, volume.layout) / choice.checkerSizeMm;
  scene.fullFromGradient =
    scene.fractionFromReference.x / mmFromTexture(reference.grid, layout) / choice.fullGradient;
  scene.windowRadius = 0.5 * choice.windowMm / mmFromTexture(volume.grid, volume.layout);
  scene.wipes = wipePlanes(volume.grid, volume.layout, choice.wipePosition);
  return this->Cavity.update(gpu, reference.cavity, place, scene.cavity);
}

std::vector<vtkTextureObject*> ReferenceTextures::textures() const
{
  return { this->Voxels.texture(), this->Cavity.texture() };
}

void ReferenceTextures::releaseGraphicsResources(vtkWindow* window)
{
  this->Voxels.releaseGraphicsResources(window);
  this->Cavity.releaseGraphicsResources(window);
}

void setReferenceUniforms(Program& program, const ReferenceScene& scene)
{
  setReferencePlace(program, scene.place);
  setCavityUniforms(program, scene.cavity);
  program.set("referenceVoxels", glm::vec3(scene.voxels));
  program.set("referenceCubic", scene.cubic ? 1 : 0);
  program.set("fractionFromReference", glm::vec2(scene.fractionFromReference));
  program.set("fractionFromScalar", glm::vec2(scene.fractionFromScalar));
  program.set("transferFromFraction", glm::vec2(scene.transferFromFraction));
  setComparisonColors(program, scene.colors);
  program.set("comparison", scene.comparison);
  program.set("checkersFromTexture", glm::vec3(scene.checkersFromTexture));
  program.set("fullFromGradient", glm::vec3(scene.fullFromGradient));
  program.set("windowRadius", glm::vec3(scene.windowRadius));
}

void setWipeUniforms(Program& program, const ReferenceScene& scene, int axis)
{
  program.set("wipeNormal", glm::vec3(scene.wipes[axis].normal));
  program.set("wipeShift", static_cast<float>(scene.wipes[axis].shift));
}

glm::dmat4 clipFromTexture(const SceneFrame& frame)
{
  return frame.clipFromWorld * frame.worldFromTexture;
}

void drawQuad(Program& program, const SliceQuad& quad)
{
  program.set("quadCorner", glm::vec3(quad.corner));
  program.set("quadRight", glm::vec3(quad.right));
  program.set("quadUp", glm::vec3(quad.up));
  constexpr int trianglesOfQuad = 2;
  drawTriangles(trianglesOfQuad);
}

namespace
{
void setSliceUniforms(Program& program, const SliceScene& scene, double scale)
{
  constexpr int noDoublings = 0;
  setTissueUniforms(program, scene.tissue, noDoublings);
  setBrickUniforms(program, scene.bricks);
  if (scene.field.offsets)
  {
    setFieldUniforms(program, scene.field);
  }
  setColoringUniforms(program, scene.tissue.coloring);
  setEvidenceUniforms(program, scene.evidence);
  setResectionUniforms(program, scene.resection);
  setPartUniforms(program, scene.part, scene.nearest);
  program.set("clipFromTexture", glm::mat4(clipFromTexture(scene.frame)));
  program.set("voxels", glm::vec3(scene.voxels));
  program.set("cubic", scene.cubic ? 1 : 0);
  program.set("opacity", static_cast<float>(scene.opacity));
  program.set("mapsOpacity", scene.mapsOpacity ? 1 : 0);
  program.set("selecting", scene.selecting ? 1 : 0);
  program.set("crosshair", scene.crosshair && !scene.selecting ? 1 : 0);
  program.set("crossing", glm::vec3(scene.planes.position));
  program.set("crosshairColors", scene.crosshairColors);
  program.set("screenScale", static_cast<float>(scale));
}

// Other pixels than those of the part are left out here, as far as they form a rectangle. The
// rectangle that is drawn stays the same, or its places would be rounded differently.
class PartScissor
{
public:
  PartScissor(vtkOpenGLState* state, const SliceScene& scene)
    : State(state)
    , Scene(scene)
    , Test(state, GL_SCISSOR_TEST)
  {
    state->vtkglGetIntegerv(GL_VIEWPORT, this->Viewport.data());
    state->vtkglGetIntegerv(GL_SCISSOR_BOX, this->Scissor.data());
    this->Scissor = state->GetEnumState(GL_SCISSOR_TEST) ? this->Scissor : this->Viewport;
  }

  // Whether anything of a rectangle is left.
  bool leave(const SliceQuad& quad)
  {
    if (this->Scene.part.planes.empty())
    {
      return true;
    }
    const PixelBox drawn = overlap(
      pixelsOf(quad, this->Scene.part, clipFromTexture(this->Scene.frame), boxOf(this->Viewport)),
      boxOf(this->Scissor));
    if (!drawn.empty())
    {
      this->State->vtkglEnable(GL_SCISSOR_TEST);
      this->State->vtkglScissor(drawn.low.x, drawn.low.y, drawn.size().x, drawn.size().y);
    }
    return !drawn.empty();
  }

private:
  using Rectangle = std::array<int, 4>; // first pixel, size

  static PixelBox boxOf(const Rectangle& rectangle)
  {
    const glm::ivec2 low(rectangle[0], rectangle[1]);
    return { low, low + glm::ivec2(rectangle[2], rectangle[3]) };
  }

  vtkOpenGLState* State;
  const SliceScene& Scene;
  vtkOpenGLState::ScopedglEnableDisable Test;
  Rectangle Viewport{};
  Rectangle Scissor{};
};
}

bool SliceDrawer::draw(vtkOpenGLRenderWindow* window, const SliceScene& scene, Counters& counters)
{
  const SceneTissue& tissue = scene.tissue;
  const SlicesVariant variant{ scene.field.offsets != nullptr, tissue.coloring.source,
    scene.reference.place.scalars != nullptr, scene.reference.cavity.voxels != nullptr,
    scene.evidence.deviations != nullptr, scene.resection.removed.fractions != nullptr,
    scene.resection.tumour.fractions != nullptr, scene.bricks.pages != nullptr };
  Program& program = this->Programs[variant];
  if (!program.use(window, slicesSource(variant), counters))
  {
    return false;
  }
  setSliceUniforms(program, scene, screenScale(window));
  if (variant.compared)
  {
    setReferenceUniforms(program, scene.reference);
  }
  {
    vtkOpenGLState* state = window->GetState();
    const SceneScope scope(state, scene.blended);
    PartScissor part(state, scene);
    state->vtkglDepthMask(scene.blended ? GL_FALSE : GL_TRUE);
    const std::vector<SliceQuad> quads = scene.blended
      ? quadsBackToFront(scene.planes, clipFromTexture(scene.frame))
      : wholeQuads(scene.planes);
    for (const SliceQuad& quad : quads)
    {
      if (!part.leave(quad))
      {
        continue;
      }
      program.set("quadAxis", quad.axis);
      if (variant.compared)
      {
        setWipeUniforms(program, scene.reference, quad.axis);
      }
      drawQuad(program, quad);
    }
  }
  for (vtkTextureObject* texture : { tissue.scalars, tissue.transfer, tissue.coloring.colors,
         tissue.coloring.scalars, scene.reference.place.scalars, scene.reference.cavity.voxels,
         scene.evidence.deviations, scene.resection.removed.fractions,
         scene.resection.tumour.fractions, scene.bricks.pages, scene.bricks.atlas })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  deactivateField(scene.field);
  counters.frames += 1;
  return true;
}
}
