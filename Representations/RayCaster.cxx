// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

#include "DeformedPresence.h"
#include "FacePass.h"
#include "OpenGL.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>

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

namespace
{
vtkSmartPointer<vtkTextureObject> makeImage(
  vtkOpenGLRenderWindow* window, const glm::ivec2& size, unsigned int format, int filter)
{
  auto image = vtkSmartPointer<vtkTextureObject>::New();
  image->SetContext(window);
  image->SetInternalFormat(format);
  image->SetMinificationFilter(filter);
  image->SetMagnificationFilter(filter);
  image->SetWrapS(vtkTextureObject::ClampToEdge);
  image->SetWrapT(vtkTextureObject::ClampToEdge);
  return image->Allocate2D(size.x, size.y, 4, VTK_FLOAT) ? image : nullptr;
}

// Drawing into images of our own: no blending, no tests, only the part that shows something;
// restored at the end.
class ImageScope
{
public:
  ImageScope(vtkOpenGLState* state, const RayCastScene& scene, const ImageArea& area)
    : Viewport(state)
    , ScissorBox(state)
    , ColorMask(state)
    , Blending(state)
    , Scissor(state, GL_SCISSOR_TEST)
    , Blend(state, GL_BLEND)
    , DepthTest(state, GL_DEPTH_TEST)
    , Cull(state, GL_CULL_FACE)
    , Framebuffer(state)
  {
    for (const unsigned int capability : { GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE })
    {
      state->vtkglDisable(capability);
    }
    const glm::ivec2 shown = scene.shownHigh - scene.shownLow;
    state->vtkglEnable(GL_SCISSOR_TEST);
    const glm::ivec2 first = scene.shownLow - area.low;
    state->vtkglScissor(first.x, first.y, shown.x, shown.y);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglViewport(-area.low.x, -area.low.y, area.picture.x, area.picture.y);
  }

  void attach(unsigned int index, vtkTextureObject* image)
  {
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + index, GL_TEXTURE_2D, image->GetHandle(), 0);
    this->Framebuffer.drawColors(index + 1);
  }

private:
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglScissor ScissorBox;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglBlendFuncSeparate Blending;
  vtkOpenGLState::ScopedglEnableDisable Scissor;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglEnableDisable Cull;
  FramebufferScope Framebuffer;
};
}

namespace
{
bool sameSize(vtkTextureObject* image, const glm::ivec2& size)
{
  return image->GetWidth() == static_cast<unsigned int>(size.x) &&
    image->GetHeight() == static_cast<unsigned int>(size.y);
}
}

bool RayCaster::prepareImages(vtkOpenGLRenderWindow* window, const RayCastScene& scene)
{
  this->Area = areaAround(this->Area, scene.size, scene.shownLow, scene.shownHigh);
  const auto prepare = [&](vtkSmartPointer<vtkTextureObject>& image, int format, int filter) {
    if (!image || !sameSize(image, this->Area.size))
    {
      image = makeImage(window, this->Area.size, format, filter);
    }
    return image != nullptr;
  };
  FirstHits& hits = this->Hits[scene.tile];
  if (!hits.texture || hits.area != this->Area)
  {
    this->HitsPart[scene.tile] = { glm::ivec2(-1), scene.size + 1 }; // whatever memory held
  }
  hits.area = this->Area;
  if (!prepare(this->Image, GL_RGBA8, vtkTextureObject::Linear) ||
    !prepare(hits.texture, GL_R32F, vtkTextureObject::Nearest) ||
    !prepare(this->Spans, GL_RG16, vtkTextureObject::Nearest))
  {
    return false;
  }
  float none[4] = { -1.0f, -1.0f, -1.0f, -1.0f };
  hits.texture->SetWrapS(vtkTextureObject::ClampToBorder);
  hits.texture->SetWrapT(vtkTextureObject::ClampToBorder);
  hits.texture->SetBorderColor(none);
  return true;
}

// Rasterises the occupied bricks' faces: first and last t of every pixel.
bool RayCaster::findSpans(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  if (!this->SpansProgram.use(window, proxySource(), counters))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  ImageScope images(state, scene, this->Area);
  images.attach(0, this->Spans);
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
  setPixelUniforms(program, this->Area);
  setSpaceUniforms(program, scene);
  setSkippingUniforms(program, scene, this->Spans);
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
  const RayCastVariant variant = variantOf(scene);
  Program& program = this->CastPrograms[variant];
  if (!this->prepareImages(window, scene) ||
    (variant.counted && !this->prepareCount(window, this->Area.size)) ||
    (scene.skipping && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  this->setUniforms(program, scene);
  {
    ImageScope images(window->GetState(), scene, this->Area);
    images.attach(0, this->Image);
    images.attach(1, this->Hits[scene.tile].texture);
    this->clearStaleHits(scene);
    if (variant.counted)
    {
      images.attach(2, this->Count);
    }
    drawTriangles(1);
    this->ImagePart = this->HitsPart[scene.tile] = { scene.shownLow, scene.shownHigh };
    this->Hits[scene.tile].frustum = frustumOf(scene.clipFromWorld);
    this->DrewTile = scene.tile;
  }
  deactivate(scene);
  this->Spans->Deactivate();
  if (variant.counted)
  {
    this->readCount(counters);
  }
  counters.frames += 1;
  return true;
}

// A new one for each picture, all zero.
bool RayCaster::prepareCount(vtkOpenGLRenderWindow* window, const glm::ivec2& size)
{
  this->Count = vtkSmartPointer<vtkTextureObject>::New();
  this->Count->SetContext(window);
  std::vector<float> zeros(static_cast<std::size_t>(size.x) * size.y * 4, 0.0f);
  return this->Count->Create2DFromRaw(size.x, size.y, 4, VTK_FLOAT, zeros.data());
}

void RayCaster::readCount(Counters& counters)
{
  std::vector<float> counted(
    static_cast<std::size_t>(this->Count->GetWidth()) * this->Count->GetHeight() * 4);
  this->Count->Activate();
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, counted.data());
  this->Count->Deactivate();
  for (std::size_t i = 0; i < counted.size(); i += 4)
  {
    counters.samplesTaken += static_cast<std::int64_t>(counted[i]);
    counters.samplesSkipped += static_cast<std::int64_t>(counted[i + 1]);
  }
}

// Hits of an earlier picture must not be found beyond the part that is cast now.
void RayCaster::clearStaleHits(const RayCastScene& scene)
{
  const Part& before = this->HitsPart[scene.tile];
  if (glm::any(glm::lessThan(before.low, scene.shownLow)) ||
    glm::any(glm::greaterThan(before.high, scene.shownHigh)))
  {
    const float none[4] = { -1.0f, -1.0f, -1.0f, -1.0f };
    glDisable(GL_SCISSOR_TEST);
    glClearBufferfv(GL_COLOR, 1, none);
    glEnable(GL_SCISSOR_TEST);
  }
}

bool RayCaster::hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit)
{
  const FirstHits& hits = this->Hits[false];
  if (!hits.texture)
  {
    return false;
  }
  const glm::dvec2 size(hits.area.picture);
  const glm::ivec2 pixel(place * size);
  if (glm::any(glm::lessThan(pixel, hits.area.low)) ||
    glm::any(glm::greaterThanEqual(pixel, hits.area.high())))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, hits.texture->GetHandle(), 0);
  state->vtkglReadBuffer(GL_COLOR_ATTACHMENT0);
  float share = -1.0f;
  const glm::ivec2 texel = pixel - hits.area.low;
  glReadPixels(texel.x, texel.y, 1, 1, GL_RED, GL_FLOAT, &share);
  const glm::dvec2 ndc = 2.0 * (glm::dvec2(pixel) + 0.5) / size - 1.0; // of the pixel's own ray
  const glm::dvec3 near = hits.frustum.near.at(ndc);
  const glm::dvec3 way = static_cast<double>(share) * (hits.frustum.far.at(ndc) - near);
  hit = glm::dvec4(near + way, glm::length(way));
  return share >= 0.0f;
}

bool RayCaster::composite(vtkOpenGLRenderWindow* window, const glm::ivec2& origin,
  const glm::ivec2& size, Counters& counters)
{
  if (!this->CompositeProgram.use(window, compositeSource(), counters))
  {
    return false;
  }
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  const glm::ivec2& end = this->Area.picture;
  const glm::dvec2 scale = glm::dvec2(size) / glm::dvec2(end);
  // Not its empty rim: the filter would blend it with what an earlier picture left beyond.
  const glm::ivec2 first =
    this->ImagePart.low + glm::ivec2(glm::greaterThan(this->ImagePart.low, glm::ivec2(0)));
  const glm::ivec2 last =
    this->ImagePart.high - glm::ivec2(glm::lessThan(this->ImagePart.high, end));
  const glm::ivec2 low(glm::floor(glm::dvec2(first) * scale));
  const glm::ivec2 shown =
    glm::max(glm::ivec2(glm::ceil(glm::dvec2(last) * scale)) - low, glm::ivec2(0));
  state->vtkglViewport(origin.x + low.x, origin.y + low.y, shown.x, shown.y);
  const int filter =
    scale == glm::dvec2(1.0) ? vtkTextureObject::Nearest : vtkTextureObject::Linear;
  this->Image->SetMinificationFilter(filter);
  this->Image->SetMagnificationFilter(filter);
  this->CompositeProgram.set("image", this->Image.Get());
  this->CompositeProgram.set("origin", glm::vec2(origin));
  this->CompositeProgram.set(
    "textureFromPixel", glm::vec2(this->Area.textureFromShare() / glm::dvec2(size)));
  this->CompositeProgram.set("textureOfOrigin", glm::vec2(this->Area.textureOfShareZero()));
  drawTriangles(1);
  this->Image->Deactivate();
  return true;
}

void RayCaster::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image :
    { &this->Image, &this->Hits[0].texture, &this->Hits[1].texture, &this->Count, &this->Spans })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->Area = ImageArea();
  this->SpansProgram.forget();
  this->CompositeProgram.forget();
  this->CastPrograms.clear();
}
}
