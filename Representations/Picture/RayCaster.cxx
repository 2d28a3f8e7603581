// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/RayCaster.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Picture/ImageScope.h"
#include "Representations/Picture/RayCastUniforms.h"
#include "Representations/Skipping/FacePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkTextureObject.h"

#include <cstdint>

namespace brainshift
{
namespace
{
RayCastVariant variantOf(const RayCastScene& scene)
{
  const SceneTissue& tissue = scene.tissue;
  RayCastVariant variant;
  variant.deformed = scene.field.offsets != nullptr;
  variant.light = !tissue.shaded ? RayCastVariant::Unshaded
    : !tissue.normals            ? RayCastVariant::GradientsOnTheFly
                                 : RayCastVariant::GradientTexture;
  variant.blend = tissue.blend;
  variant.compared = scene.comparison.reference != nullptr;
  variant.cavity = variant.compared && scene.comparison.cavity.voxels;
  variant.coloring = variant.compared ? Coloring::Mapped : tissue.coloring.source;
  variant.regions = scene.cuts.regions;
  variant.segmented = tissue.segment.shares != nullptr;
  variant.counted = scene.image.countSamples && variant.blend == Blend::Composite;
  variant.averaged = tissue.transferSums && variant.blend == Blend::Composite && !variant.compared;
  variant.opacity = variant.compared ? Opacity::Scalar : tissue.steepness.opacity;
  variant.evidence = scene.evidence.deviations != nullptr;
  variant.sharedLight =
    tissue.shaded && !variant.averaged && !variant.compared && tissue.raysEndSoon();
  return variant;
}
}

RayCaster::RayCaster() = default;
RayCaster::~RayCaster() = default;

// Rasterises the faces of the occupied bricks: first and last t of every pixel.
bool RayCaster::findSpans(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  if (!this->SpansProgram.use(window, proxySource(), counters))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  ImageScope scope(state, scene.image.part.box, this->Images.area());
  scope.attach(0, this->Images.spans());
  const float nothing[4] = { 1.0f, 1.0f, 1.0f, 1.0f };
  glClearBufferfv(GL_COLOR, 0, nothing);
  state->vtkglEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  glEnable(GL_DEPTH_CLAMP); // faces beyond the clipping planes bound the ray too
  drawFaces(this->SpansProgram, scene);
  if (const RayCastScene* reference = scene.comparison.reference)
  {
    drawFaces(this->SpansProgram, *reference);
  }
  glDisable(GL_DEPTH_CLAMP);
  glBlendEquation(GL_FUNC_ADD);
  return true;
}

bool RayCaster::cast(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  return this->Images.prepare(window, scene) && this->draw(window, scene, false, counters);
}

bool RayCaster::castPart(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  RayCastScene part = scene;
  part.image.hitFromShare = this->Images.hitFromShare(scene);
  return this->draw(window, part, true, counters);
}

bool RayCaster::draw(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, bool part, Counters& counters)
{
  const PixelPart& pixels = scene.image.part;
  const RayCastVariant variant = variantOf(scene);
  Program& program = this->CastPrograms[variant];
  if ((variant.counted && !this->Images.prepareCount(window)) ||
    (scene.image.skips && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  setRayCastUniforms(program, scene, this->Images.area(), this->Images.spans());
  {
    ImageScope scope(window->GetState(), pixels.box, this->Images.area());
    this->Images.attach(scope, scene, part, variant.counted);
    this->Images.drawPart(program, pixels);
  }
  deactivateTextures(scene);
  this->Images.spans()->Deactivate();
  if (variant.counted)
  {
    this->Images.readCount(counters);
  }
  counters.frames += 1;
  counters.pixelsCast += static_cast<std::int64_t>(pixelsIn(pixels));
  return true;
}

void RayCaster::releaseGraphicsResources(vtkWindow* window)
{
  this->Images.releaseGraphicsResources(window);
  this->SpansProgram.forget();
  this->CastPrograms.clear();
}
}
