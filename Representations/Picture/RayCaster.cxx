// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/RayCaster.h"

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Skipping/FacePass.h"
#include "Representations/Gpu/ImageScope.h"
#include "Representations/Gpu/OpenGL.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <cstdint>

namespace brainshift
{
namespace
{
void setRayUniforms(Program& program, const RayCastScene& scene)
{
  const Frustum frustum = frustumOf(scene.clipFromWorld * scene.worldFromTexture);
  const FrustumPlane& near = frustum.near;
  const FrustumPlane& far = frustum.far;
  program.set("nearOrigin", glm::vec3(near.origin));
  program.set("nearRight", glm::vec3(near.right));
  program.set("nearUp", glm::vec3(near.up));
  program.set("farOrigin", glm::vec3(far.origin));
  program.set("farRight", glm::vec3(far.right));
  program.set("farUp", glm::vec3(far.up));
  program.set("clipW", glm::vec2(near.w, far.w));
  program.set("worldFromTexture", glm::mat3(glm::dmat3(scene.worldFromTexture)));
  program.set("mmFromTexture", glm::vec3(scene.mmFromTexture));
}

void setPixelUniforms(Program& program, const ImageArea& area)
{
  program.set("firstPixel", glm::vec2(area.low));
  program.set("ndcFromPixel", 2.0f / glm::vec2(area.picture));
}

void setSpaceUniforms(Program& program, const RayCastScene& scene)
{
  program.set("spaceLow", glm::vec3(scene.spaceLow));
  program.set("spaceHigh", glm::vec3(scene.spaceHigh));
  program.set("jitter", scene.jitter ? 1.0f : 0.0f);
  program.set("stepMm", static_cast<float>(scene.stepMm));
  program.set("worldOfTextureZero", glm::vec3(scene.worldFromTexture[3]));
  program.set("sceneDepth", scene.sceneDepth);
  program.set("depthFromShare", scene.depthFromShare);
  program.set("depthOfShareZero", scene.depthOfShareZero);
}

void setSkippingUniforms(Program& program, const RayCastScene& scene, vtkTextureObject* spans)
{
  program.set("skipping", scene.skipping ? 1 : 0);
  program.set("spans", spans);
  program.set("spansTexel", 1.0f / glm::vec2(spans->GetWidth(), spans->GetHeight()));
  vtkTextureObject* leaps = scene.presence->leaps();
  program.set("leaps", leaps);
  program.set(
    "leapsTexel", 1.0f / glm::vec3(leaps->GetWidth(), leaps->GetHeight(), leaps->GetDepth()));
  program.set("brickFromTexture", glm::vec3(1.0 / scene.textureFromBrick));
  program.set("brickOfTextureZero",
    glm::vec3(-scene.textureOfBrickZero / scene.textureFromBrick - scene.firstBrick));
}

void setLightUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat3 worldFromTexture(scene.worldFromTexture);
  if (!scene.normals)
  {
    program.set("voxel", glm::vec3(scene.voxel));
  }
  else
  {
    program.set("normals", scene.normals);
  }
  program.set("worldFromGradient", glm::mat3(glm::transpose(glm::inverse(worldFromTexture))));
  const RayCastLights& lights = scene.lights;
  const int count = static_cast<int>(lights.position.size() / 4);
  program.set("lightCount", count);
  program.set("headlight", lights.headlight ? 1 : 0);
  vtkShaderProgram* shader = program.get();
  if (count > 0)
  {
    shader->SetUniform4fv("lightPosition", count, lights.position.data());
    shader->SetUniform3fv("lightColor", count, lights.color.data());
    shader->SetUniform3fv("lightSpecular", count, lights.specular.data());
  }
  const glm::vec4 material(scene.material);
  shader->SetUniform4f("material", &material[0]);
}
}

RayCaster::RayCaster() = default;
RayCaster::~RayCaster() = default;

// Rasterises the occupied bricks' faces: first and last t of every pixel.
bool RayCaster::findSpans(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  if (!this->SpansProgram.use(window, proxySource(), counters))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  ImageScope scope(state, scene.shown, this->Images.area());
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

void RayCaster::setUniforms(Program& program, const RayCastScene& scene)
{
  setRayUniforms(program, scene);
  setPixelUniforms(program, this->Images.area());
  program.set("hitFromShare", glm::vec2(scene.hitFromShare));
  setSpaceUniforms(program, scene);
  setSkippingUniforms(program, scene, this->Images.spans());
  setTissueUniforms(program, scene);
  if (scene.transferSums)
  {
    program.set("transferSums", scene.transferSums);
  }
  if (scene.offsets)
  {
    setFieldUniforms(program, scene);
  }
  if (scene.shaded)
  {
    setLightUniforms(program, scene);
    program.set("fieldTexel", glm::vec3(scene.fieldTexel));
  }
  setOptionUniforms(program, scene.options);
  if (scene.comparison.reference)
  {
    setComparisonUniforms(program, scene);
  }
}

namespace
{
RayCastVariant variantOf(const RayCastScene& scene)
{
  RayCastVariant variant;
  variant.deformed = scene.offsets != nullptr;
  variant.light = !scene.shaded ? RayCastVariant::Unshaded
    : !scene.normals            ? RayCastVariant::GradientsOnTheFly
                                : RayCastVariant::GradientTexture;
  variant.blend = scene.options.blend;
  variant.compared = scene.comparison.reference != nullptr;
  variant.cavity = variant.compared && scene.comparison.cavity.voxels;
  variant.coloring = variant.compared ? Coloring::Mapped : scene.options.coloring;
  variant.regions = scene.options.regions;
  variant.segmented = scene.options.segment != nullptr;
  variant.counted = scene.countSamples && variant.blend == Blend::Composite;
  variant.averaged = scene.transferSums && variant.blend == Blend::Composite && !variant.compared;
  variant.sharedLight =
    scene.shaded && !variant.averaged && !variant.compared && scene.raysEndSoon();
  return variant;
}

// Lets go of the texture units.
void deactivate(const RayCastScene& scene)
{
  for (vtkTextureObject* texture : { scene.scalars, scene.offsets, scene.normals, scene.transfer,
         scene.sceneDepth, scene.options.colors, scene.options.colorScalars, scene.options.segment,
         scene.presence->leaps(), scene.comparison.cavity.voxels, scene.transferSums })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  if (scene.comparison.reference)
  {
    deactivate(*scene.comparison.reference);
  }
}
}

bool RayCaster::cast(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  return this->Images.prepare(window, scene) && this->draw(window, scene, false, counters);
}

bool RayCaster::castPart(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  RayCastScene part = scene;
  part.hitFromShare = this->Images.hitFromShare(scene);
  return this->draw(window, part, true, counters);
}

bool RayCaster::draw(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, bool part, Counters& counters)
{
  const RayCastVariant variant = variantOf(scene);
  Program& program = this->CastPrograms[variant];
  if ((variant.counted && !this->Images.prepareCount(window)) ||
    (scene.skipping && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  this->setUniforms(program, scene);
  {
    ImageScope scope(window->GetState(), scene.shown, this->Images.area());
    this->Images.attach(scope, scene, part, variant.counted);
    this->Images.drawPart(program, { scene.shown, scene.turned });
  }
  deactivate(scene);
  this->Images.spans()->Deactivate();
  if (variant.counted)
  {
    this->Images.readCount(counters);
  }
  counters.frames += 1;
  counters.pixelsCast += static_cast<std::int64_t>(pixelsIn({ scene.shown, scene.turned }));
  return true;
}

void RayCaster::releaseGraphicsResources(vtkWindow* window)
{
  this->Images.releaseGraphicsResources(window);
  this->SpansProgram.forget();
  this->CastPrograms.clear();
}
}
