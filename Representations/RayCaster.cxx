// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

#include "DeformedPresence.h"
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
// A plane of the view frustum: position of ndc (0,0), what one unit of ndc x and y adds, and the
// homogeneous w on it. Positions on it are affine in ndc for every camera VTK has.
struct FrustumPlane
{
  glm::dvec3 origin;
  glm::dvec3 right;
  glm::dvec3 up;
  double w;
};

FrustumPlane frustumPlane(
  const glm::dmat4& clipFromTexture, const glm::dmat4& textureFromClip, double depth)
{
  const auto unproject = [&](double x, double y) {
    const glm::dvec4 position = textureFromClip * glm::dvec4(x, y, depth, 1.0);
    return glm::dvec3(position) / position.w;
  };
  FrustumPlane plane;
  plane.origin = unproject(0.0, 0.0);
  plane.right = unproject(1.0, 0.0) - plane.origin;
  plane.up = unproject(0.0, 1.0) - plane.origin;
  plane.w = (clipFromTexture * glm::dvec4(plane.origin, 1.0)).w;
  return plane;
}

struct Frustum
{
  FrustumPlane near;
  FrustumPlane far;
};

Frustum frustumOf(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.clipFromWorld * scene.worldFromTexture;
  const glm::dmat4 textureFromClip = glm::inverse(clipFromTexture);
  return { frustumPlane(clipFromTexture, textureFromClip, -1.0),
    frustumPlane(clipFromTexture, textureFromClip, 1.0) };
}

void setRayUniforms(Program& program, const RayCastScene& scene)
{
  const Frustum frustum = frustumOf(scene);
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

// Faces of the occupied bricks. All of a plane parallel to the near plane lies at the same share of
// the way to the far plane, so that a ray's t is that share of its length.
void setFaceUniforms(Program& program, const RayCastScene& scene)
{
  const Frustum frustum = frustumOf(scene);
  const glm::dvec3 across = glm::cross(frustum.near.right, frustum.near.up);
  const glm::dvec3 share = across / glm::dot(across, frustum.far.origin - frustum.near.origin);
  program.set("shareFromTexture", glm::vec3(share));
  program.set("shareOfTextureZero", static_cast<float>(-glm::dot(share, frustum.near.origin)));
  program.set("clipFromTexture", glm::mat4(scene.clipFromWorld * scene.worldFromTexture));
  program.set("textureFromBrick", glm::vec3(scene.textureFromBrick));
  program.set("textureOfBrickZero", glm::vec3(scene.textureOfBrickZero));
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
  program.set("spansTexel", 1.0f / glm::vec2(scene.size));
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
  ImageScope(vtkOpenGLState* state, const RayCastScene& scene)
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
    state->vtkglScissor(scene.shownLow.x, scene.shownLow.y, shown.x, shown.y);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglViewport(0, 0, scene.size.x, scene.size.y);
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
  const auto prepare = [&](vtkSmartPointer<vtkTextureObject>& image, int format, int filter) {
    if (!image || !sameSize(image, scene.size))
    {
      image = makeImage(window, scene.size, format, filter);
    }
    return image != nullptr;
  };
  if (!this->Hits[scene.tile] || !sameSize(this->Hits[scene.tile], scene.size))
  {
    this->HitsPart[scene.tile] = { glm::ivec2(-1), scene.size + 1 }; // whatever memory held
  }
  return prepare(this->Image, GL_RGBA8, vtkTextureObject::Linear) &&
    prepare(this->Hits[scene.tile], GL_RGBA32F, vtkTextureObject::Nearest) &&
    prepare(this->Spans, GL_RG16, vtkTextureObject::Nearest);
}

// Rasterises the occupied bricks' faces: first and last t of every pixel.
bool RayCaster::findSpans(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  if (!this->SpansProgram.use(window, proxySource(), counters))
  {
    return false;
  }
  setFaceUniforms(this->SpansProgram, scene);
  vtkOpenGLState* state = window->GetState();
  ImageScope images(state, scene);
  images.attach(0, this->Spans);
  const float nothing[4] = { 1.0f, 1.0f, 1.0f, 1.0f };
  glClearBufferfv(GL_COLOR, 0, nothing);
  state->vtkglEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  glEnable(GL_DEPTH_CLAMP); // faces beyond the clipping planes bound the ray too
  scene.presence->drawFaces(this->SpansProgram.get()->GetHandle());
  if (const RayCastScene* reference = scene.comparison.reference)
  {
    setFaceUniforms(this->SpansProgram, *reference);
    reference->presence->drawFaces(this->SpansProgram.get()->GetHandle());
  }
  glDisable(GL_DEPTH_CLAMP);
  glBlendEquation(GL_FUNC_ADD);
  return true;
}

void RayCaster::setUniforms(Program& program, const RayCastScene& scene)
{
  setRayUniforms(program, scene);
  setSpaceUniforms(program, scene);
  setSkippingUniforms(program, scene, this->Spans);
  setTissueUniforms(program, scene);
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
  variant.sharedLight =
    scene.shaded && scene.opaqueTissue && !variant.compared && variant.blend == Blend::Composite;
  return variant;
}

// Lets go of the texture units.
void deactivate(const RayCastScene& scene)
{
  for (vtkTextureObject* texture : { scene.scalars, scene.offsets, scene.normals, scene.transfer,
         scene.sceneDepth, scene.options.colors, scene.options.colorScalars, scene.options.segment,
         scene.presence->leaps(), scene.comparison.cavity.voxels })
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
    (variant.counted && !this->prepareCount(window, scene.size)) ||
    (scene.skipping && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  this->setUniforms(program, scene);
  {
    ImageScope images(window->GetState(), scene);
    images.attach(0, this->Image);
    images.attach(1, this->Hits[scene.tile]);
    this->clearStaleHits(scene);
    if (variant.counted)
    {
      images.attach(2, this->Count);
    }
    drawTriangles(1);
    this->ImagePart = this->HitsPart[scene.tile] = { scene.shownLow, scene.shownHigh };
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
    const float none[4] = { 0.0f, 0.0f, 0.0f, -1.0f };
    glDisable(GL_SCISSOR_TEST);
    glClearBufferfv(GL_COLOR, 1, none);
    glEnable(GL_SCISSOR_TEST);
  }
}

bool RayCaster::hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit)
{
  vtkTextureObject* hits = this->Hits[false];
  if (!hits)
  {
    return false;
  }
  const glm::ivec2 pixel(place * glm::dvec2(hits->GetWidth(), hits->GetHeight()));
  vtkOpenGLState* state = window->GetState();
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, hits->GetHandle(), 0);
  state->vtkglReadBuffer(GL_COLOR_ATTACHMENT0);
  float values[4] = { 0.0f, 0.0f, 0.0f, -1.0f };
  glReadPixels(pixel.x, pixel.y, 1, 1, GL_RGBA, GL_FLOAT, values);
  hit = glm::dvec4(values[0], values[1], values[2], values[3]);
  return values[3] >= 0.0f;
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
  const glm::dvec2 scale =
    glm::dvec2(size) / glm::dvec2(this->Image->GetWidth(), this->Image->GetHeight());
  // Not its empty rim: the filter would blend it with what an earlier picture left beyond.
  const glm::ivec2 end(this->Image->GetWidth(), this->Image->GetHeight());
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
  this->CompositeProgram.set("shareOfPixel", 1.0f / glm::vec2(size));
  drawTriangles(1);
  this->Image->Deactivate();
  return true;
}

void RayCaster::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Image, &this->Hits[0], &this->Hits[1], &this->Count, &this->Spans })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->SpansProgram.forget();
  this->CompositeProgram.forget();
  this->CastPrograms.clear();
}
}
