// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/RayCaster.h"

#include "Representations/Picture/ImageScope.h"
#include "Representations/Skipping/DeformedPresence.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <array>
#include <cmath>

class vtkTextureObject;

namespace brainshift
{
// Draws the faces of the occupied bricks, which bound the part of each ray that is sampled.

class Program;
struct RayCastScene;

/// Draws the faces with the program of Shaders/Skipping/proxy, which is in use. Only the faces that
/// look towards the eye are drawn if rays end inside the tissue and the eye is outside of it:
/// nothing is gained by knowing where such rays would leave the tissue, and a software driver takes
/// more time for more faces.
void drawFaces(Program& program, const RayCastScene& scene);

// Sets the uniforms of the ray caster's programs (Shaders/Rays), all of them.

/// Sets every uniform of the scene's variant. `area`: what the images hold of the picture. `spans`:
/// the fraction of each ray before and behind the occupied bricks.
void setRayCastUniforms(
  Program& program, const RayCastScene& scene, const ImageArea& area, vtkTextureObject* spans);

/// Lets go of the texture units that setRayCastUniforms took.
void deactivateTextures(const RayCastScene& scene);

namespace
{
// All rays meet a plane parallel to the near plane at the same fraction of the distance to the far
// plane. So the distance along a ray is that fraction of the ray's length.
void setFaceUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  const Frustum frustum = frustumOf(clipFromTexture);
  const glm::dvec3 across = glm::cross(frustum.near.right, frustum.near.up);
  const glm::dvec3 fraction = across / glm::dot(across, frustum.far.origin - frustum.near.origin);
  program.set("fractionFromTexture", glm::vec3(fraction));
  program.set(
    "fractionOfTextureZero", static_cast<float>(-glm::dot(fraction, frustum.near.origin)));
  program.set("clipFromTexture", glm::mat4(clipFromTexture));
  program.set("textureFromBrick", glm::vec3(scene.skipping.textureFromBrick));
  program.set("textureOfBrickZero", glm::vec3(scene.skipping.textureOfBrickZero));
}

// The eye in bricks, homogeneous, as DeformedPresence takes it.
glm::dvec4 eyeInBricks(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  // The eye, or the direction to it, projects to a depth but to no position in the window.
  const glm::dvec4 eye = glm::inverse(clipFromTexture) * glm::dvec4(0.0, 0.0, -1.0, 0.0);
  const double w = std::abs(eye.w) < 1e-9 * glm::length(glm::dvec3(eye)) ? 0.0 : eye.w;
  return glm::dvec4(
    (glm::dvec3(eye) - w * scene.skipping.textureOfBrickZero) / scene.skipping.textureFromBrick, w);
}
}

void drawFaces(Program& program, const RayCastScene& scene)
{
  const glm::dvec4 eye = eyeInBricks(scene);
  const bool frontAlone = scene.tissue.raysEndSoon() && scene.skipping.presence->isOutside(eye);
  setFaceUniforms(program, scene);
  program.set("backDrawn", frontAlone ? 0.0f : 1.0f);
  if (frontAlone)
  {
    scene.skipping.presence->drawFaces(program.get()->GetHandle(), eye);
  }
  else
  {
    scene.skipping.presence->drawFaces(program.get()->GetHandle());
  }
}

namespace
{
void setFrameUniforms(Program& program, const SceneFrame& frame)
{
  const Frustum frustum = frustumOf(frame.clipFromWorld * frame.worldFromTexture);
  const FrustumPlane& near = frustum.near;
  const FrustumPlane& far = frustum.far;
  program.set("nearOrigin", glm::vec3(near.origin));
  program.set("nearRight", glm::vec3(near.right));
  program.set("nearUp", glm::vec3(near.up));
  program.set("farOrigin", glm::vec3(far.origin));
  program.set("farRight", glm::vec3(far.right));
  program.set("farUp", glm::vec3(far.up));
  program.set("clipW", glm::vec2(near.w, far.w));
  program.set("worldFromTexture", glm::mat3(glm::dmat3(frame.worldFromTexture)));
  program.set("mmFromTexture", glm::vec3(frame.mmFromTexture));
  program.set("worldOfTextureZero", glm::vec3(frame.worldFromTexture[3]));
}

void setImageUniforms(Program& program, const SceneImage& image, const ImageArea& area)
{
  program.set("firstPixel", glm::vec2(area.low));
  program.set("ndcFromPixel", 2.0f / glm::vec2(area.picture));
  program.set("hitFromFraction", glm::vec2(image.hitFromFraction));
  program.set("jitter", image.jitter ? 1.0f : 0.0f);
  program.set("skipping", image.skips ? 1 : 0);
}

void setBehindUniforms(Program& program, const SceneBehind& behind)
{
  program.set("sceneDepth", behind.depth);
  program.set("depthFromFraction", behind.depthFromFraction);
  program.set("depthOfFractionZero", behind.depthOfFractionZero);
}

glm::vec3 brickFromTexture(const SceneSkipping& skipping)
{
  return glm::vec3(1.0 / skipping.textureFromBrick);
}

glm::vec3 brickOfTextureZero(const SceneSkipping& skipping)
{
  return glm::vec3(-skipping.textureOfBrickZero / skipping.textureFromBrick - skipping.firstBrick);
}

void setSkippingUniforms(Program& program, const SceneSkipping& skipping, vtkTextureObject* spans)
{
  program.set("spans", spans);
  program.set("spansTexel", 1.0f / glm::vec2(spans->GetWidth(), spans->GetHeight()));
  vtkTextureObject* leaps = skipping.presence->leaps();
  program.set("leaps", leaps);
  program.set("leapsTexel", texelOf(leaps));
  program.set("brickFromTexture", brickFromTexture(skipping));
  program.set("brickOfTextureZero", brickOfTextureZero(skipping));
}

void setCutUniforms(Program& program, const SceneCuts& cuts)
{
  program.set("spaceLow", glm::vec3(cuts.spaceLow));
  program.set("spaceHigh", glm::vec3(cuts.spaceHigh));
  const int planes = static_cast<int>(cuts.clipPlanes.size() / 4);
  program.set("clipCount", planes);
  if (planes > 0)
  {
    program.get()->SetUniform4fv("clipPlanes", planes, cuts.clipPlanes.data());
  }
  setPartPlanes(program, cuts.partPlanes);
  if (cuts.regions)
  {
    program.set("regionLow", glm::vec3(cuts.regionLow));
    program.set("regionHigh", glm::vec3(cuts.regionHigh));
    program.set("regionFlags", cuts.regionFlags);
  }
}

void setBlendingUniforms(Program& program, Blend blend, const SceneBlending& blending)
{
  vtkShaderProgram* shader = program.get();
  if (blend == Blend::Isosurface)
  {
    const int isovalues = static_cast<int>(blending.isovalues.size());
    program.set("isovalueCount", isovalues);
    if (isovalues > 0)
    {
      shader->SetUniform1fv("isovalues", isovalues, blending.isovalues.data());
    }
  }
  if (blend == Blend::Average || blend == Blend::Additive)
  {
    program.set("fractionFromScalar", glm::vec2(blending.fractionFromScalar));
    program.set("averagedScalars", glm::vec2(blending.averagedScalars));
  }
  if (blend == Blend::Slice)
  {
    const glm::vec4 plane(blending.slicePlane);
    shader->SetUniform4f("slicePlane", &plane[0]);
  }
}

void setSegmentUniforms(Program& program, const SceneSegment& segment)
{
  if (segment.fractions)
  {
    program.set("segment", segment.fractions);
    program.set("segmentVoxel", glm::vec3(segment.voxel));
    program.set("cutGradient", glm::vec2(segment.cutGradient));
  }
}

void setSteepnessUniforms(Program& program, const SceneSteepness& steepness, double stepMm)
{
  if (steepness.opacity == Opacity::Scalar)
  {
    return;
  }
  program.set("steepness", steepness.entries);
  program.set("steepStep", glm::vec3(steepness.step));
  program.set("steepFromGradient", glm::vec3(steepness.fromGradient));
  program.set("entryFromSteepness", glm::vec2(steepness.entryFromSteepness));
  program.set("opacitySteps", static_cast<float>(stepMm / steepness.stepMm));
  if (steepness.opacity == Opacity::Table)
  {
    program.set("entryFromScalar", glm::vec2(steepness.entryFromScalar));
  }
}

void setWishUniforms(Program& program, const RayCastScene& scene)
{
  const SceneBricks& bricks = scene.bricks;
  if (bricks.pages && !scene.image.countSamples)
  {
    program.get()->SetUniform2i("wishSeed", &bricks.seed[0]);
    program.set("wishReach", glm::vec3(scene.tissue.voxel * bricks.voxelFromTexture));
  }
}

glm::mat3 worldFromGradient(const SceneFrame& frame)
{
  const glm::dmat3 worldFromTexture(frame.worldFromTexture);
  return glm::mat3(glm::transpose(glm::inverse(worldFromTexture)));
}

void setLightUniforms(Program& program, const SceneFrame& frame, const SceneTissue& tissue)
{
  if (!tissue.normals)
  {
    program.set("voxel", glm::vec3(tissue.voxel));
  }
  else
  {
    program.set("normals", tissue.normals);
  }
  program.set("worldFromGradient", worldFromGradient(frame));
  const SceneLights& lights = frame.lights;
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
  const glm::vec4 material(tissue.material);
  shader->SetUniform4f("material", &material[0]);
}

void setReferenceLightUniforms(Program& program, const RayCastScene& reference)
{
  program.set("worldFromReferenceGradient", worldFromGradient(reference.frame));
  if (reference.tissue.normals)
  {
    program.set("referenceNormals", reference.tissue.normals);
  }
}

// What reference.glsl, layers.glsl and skipping.glsl need.
void setComparisonUniforms(Program& program, const RayCastScene& scene)
{
  const SceneComparison& comparison = scene.comparison;
  const RayCastScene& reference = *comparison.reference;
  const SceneTissue& tissue = reference.tissue;
  setReferencePlace(program,
    { tissue.scalars, glm::inverse(reference.frame.worldFromTexture) * scene.frame.worldFromTexture,
      tissue.volumeLow, tissue.volumeHigh });
  program.set("cropLow", glm::vec3(scene.cuts.cropLow));
  program.set("cropHigh", glm::vec3(scene.cuts.cropHigh));
  program.set("referenceVoxel", glm::vec3(tissue.voxel)); // a driver may keep it without light
  program.set("referenceTransfer", tissue.transfer);
  program.set("transferFromReference", glm::vec2(tissue.transferFromScalar));
  program.set("visibleReference", glm::vec2(tissue.visibleScalars));
  program.set("agreementSamples", static_cast<float>(comparison.agreementMm / scene.stepMm()));
  vtkTextureObject* leaps = reference.skipping.presence->leaps();
  program.set("referenceLeaps", leaps);
  program.set("referenceLeapsTexel", texelOf(leaps));
  program.set("brickFromReference", brickFromTexture(reference.skipping));
  program.set("brickOfReferenceZero", brickOfTextureZero(reference.skipping));
  if (scene.tissue.shaded)
  {
    setReferenceLightUniforms(program, reference);
  }
  setComparisonColors(program, comparison.colors);
  setCavityUniforms(program, comparison.cavity);
}
}

void setRayCastUniforms(
  Program& program, const RayCastScene& scene, const ImageArea& area, vtkTextureObject* spans)
{
  setFrameUniforms(program, scene.frame);
  setImageUniforms(program, scene.image, area);
  program.set("stepMm", static_cast<float>(scene.stepMm()));
  setBehindUniforms(program, scene.behind);
  setSkippingUniforms(program, scene.skipping, spans);
  setTissueUniforms(program, scene.tissue, scene.image.stepDoublings);
  if (scene.tissue.transferSums)
  {
    program.set("transferSums", scene.tissue.transferSums);
  }
  if (scene.field.offsets)
  {
    setFieldUniforms(program, scene.field);
  }
  if (scene.tissue.shaded)
  {
    setLightUniforms(program, scene.frame, scene.tissue);
  }
  const bool steep = scene.tissue.steepness.opacity != Opacity::Scalar;
  if (scene.tissue.shaded || steep)
  {
    program.set("fieldTexel", glm::vec3(scene.field.texel));
  }
  setSteepnessUniforms(program, scene.tissue.steepness, scene.stepMm());
  setCutUniforms(program, scene.cuts);
  setBlendingUniforms(program, scene.tissue.blend, scene.blending);
  setSegmentUniforms(program, scene.tissue.segment);
  setBrickUniforms(program, scene.bricks);
  setWishUniforms(program, scene);
  setColoringUniforms(program, scene.tissue.coloring);
  setEvidenceUniforms(program, scene.evidence);
  setResectionUniforms(program, scene.resection);
  if (scene.comparison.reference)
  {
    setComparisonUniforms(program, scene);
  }
}

void deactivateTextures(const RayCastScene& scene)
{
  const SceneTissue& tissue = scene.tissue;
  for (vtkTextureObject* texture :
    { tissue.scalars, tissue.normals, tissue.transfer, scene.behind.depth, tissue.coloring.colors,
      tissue.coloring.scalars, tissue.segment.fractions, scene.skipping.presence->leaps(),
      scene.comparison.cavity.voxels, tissue.transferSums, tissue.steepness.entries,
      scene.evidence.deviations, scene.resection.removed.fractions,
      scene.resection.tumour.fractions, scene.bricks.pages, scene.bricks.atlas })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  deactivateField(scene.field);
  if (scene.comparison.reference)
  {
    deactivateTextures(*scene.comparison.reference);
  }
}

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
  variant.segmented = tissue.segment.fractions != nullptr;
  variant.counted = scene.image.countSamples && variant.blend == Blend::Composite;
  variant.averaged = tissue.transferSums && variant.blend == Blend::Composite && !variant.compared;
  variant.opacity = variant.compared ? Opacity::Scalar : tissue.steepness.opacity;
  variant.evidence = scene.evidence.deviations != nullptr;
  variant.removed = scene.resection.removed.fractions != nullptr;
  variant.tumour = scene.resection.tumour.fractions && !variant.compared;
  variant.streamed = scene.bricks.pages != nullptr;
  variant.asks = variant.streamed && scene.bricks.asks && !variant.counted;
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
  part.image.hitFromFraction = this->Images.hitFromFraction(scene);
  return this->draw(window, part, true, counters);
}

bool RayCaster::draw(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, bool part, Counters& counters)
{
  const PixelPart& pixels = scene.image.part;
  const RayCastVariant variant = variantOf(scene);
  Program& program = this->CastPrograms[variant];
  if ((variant.counted && !this->Images.prepareCount(window)) ||
    (variant.asks && !this->Images.prepareWishes(window)) ||
    (scene.image.skips && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  setRayCastUniforms(program, scene, this->Images.area(), this->Images.spans());
  {
    ImageScope scope(window->GetState(), pixels.box, this->Images.area());
    this->Images.attach(scope, scene, part, variant);
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
