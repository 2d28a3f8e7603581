// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

#include "DeformedPresence.h"
#include "OpenGL.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

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

void setRayUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.clipFromWorld * scene.worldFromTexture;
  const glm::dmat4 textureFromClip = glm::inverse(clipFromTexture);
  const FrustumPlane near = frustumPlane(clipFromTexture, textureFromClip, -1.0);
  const FrustumPlane far = frustumPlane(clipFromTexture, textureFromClip, 1.0);
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

void setSpaceUniforms(Program& program, const RayCastScene& scene)
{
  program.set("spaceLow", glm::vec3(scene.spaceLow));
  program.set("spaceHigh", glm::vec3(scene.spaceHigh));
  program.set("stepMm", static_cast<float>(scene.stepMm));
  program.set("worldOfTextureZero", glm::vec3(scene.worldFromTexture[3]));
  program.set("sceneDepth", scene.sceneDepth);
}

void setSkippingUniforms(Program& program, const RayCastScene& scene, vtkTextureObject* spans)
{
  program.set("skipping", scene.skipping ? 1 : 0);
  program.set("spans", spans);
  program.set("presence", scene.presence->map());
  program.set("brickFromTexture", glm::vec3(1.0 / scene.textureFromBrick));
  program.set("brickOfTextureZero",
    glm::vec3(-scene.textureOfBrickZero / scene.textureFromBrick - scene.firstBrick));
}

void setTissueUniforms(Program& program, const RayCastScene& scene)
{
  if (scene.normals && scene.packedNormals)
  {
    program.set("packedTissue", scene.normals);
  }
  else
  {
    program.set("scalars", scene.scalars);
  }
  program.set("transfer", scene.transfer);
  program.set("transferFromScalar", glm::vec2(scene.transferFromScalar));
  program.set("volumeLow", glm::vec3(scene.volumeLow));
  program.set("volumeHigh", glm::vec3(scene.volumeHigh));
}

void setFieldUniforms(Program& program, const RayCastScene& scene)
{
  program.set("offsets", scene.offsets);
  program.set("fieldFromTexture", glm::vec3(scene.fieldFromTexture));
  program.set("fieldFromTextureShift", glm::vec3(scene.fieldFromTextureShift));
  program.set("movedLow", glm::vec3(scene.movedLow));
  program.set("movedHigh", glm::vec3(scene.movedHigh));
}

void setLightUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat3 worldFromTexture(scene.worldFromTexture);
  if (!scene.normals)
  {
    program.set("voxel", glm::vec3(scene.voxel));
  }
  else if (!scene.packedNormals)
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

RayCastLights lightsOf(vtkRenderer* renderer)
{
  RayCastLights lights;
  int others = 0;
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* collection = renderer->GetLights();
  collection->InitTraversal(iterator);
  while (vtkLight* light = collection->GetNextLight(iterator))
  {
    if (!light->GetSwitch() || static_cast<int>(lights.position.size()) >= 4 * MaxLights)
    {
      continue;
    }
    others += light->LightTypeIsHeadlight() ? 0 : 1;
    double position[3];
    light->GetTransformedPosition(position);
    glm::dvec4 source(position[0], position[1], position[2], 1.0);
    if (!light->GetPositional())
    {
      double focus[3];
      light->GetTransformedFocalPoint(focus);
      const glm::dvec3 towards(
        position[0] - focus[0], position[1] - focus[1], position[2] - focus[2]);
      source = glm::dvec4(glm::normalize(towards), 0.0);
    }
    const double intensity = light->GetIntensity();
    for (int i = 0; i < 4; ++i)
    {
      lights.position.push_back(static_cast<float>(source[i]));
    }
    for (int i = 0; i < 3; ++i)
    {
      lights.color.push_back(static_cast<float>(light->GetDiffuseColor()[i] * intensity));
      lights.specular.push_back(static_cast<float>(light->GetSpecularColor()[i] * intensity));
    }
  }
  lights.headlight = others == 0 && lights.position.size() == 4;
  return lights;
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

// Drawing into images of our own: no blending, no tests, all of the image; restored at the end.
class ImageScope
{
public:
  ImageScope(vtkOpenGLState* state, const glm::ivec2& size)
    : Viewport(state)
    , ColorMask(state)
    , Blending(state)
    , Scissor(state, GL_SCISSOR_TEST)
    , Blend(state, GL_BLEND)
    , DepthTest(state, GL_DEPTH_TEST)
    , Cull(state, GL_CULL_FACE)
    , Framebuffer(state)
  {
    for (const unsigned int capability : { GL_SCISSOR_TEST, GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE })
    {
      state->vtkglDisable(capability);
    }
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    state->vtkglViewport(0, 0, size.x, size.y);
  }

  void attach(unsigned int index, vtkTextureObject* image)
  {
    glFramebufferTexture2D(
      GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + index, GL_TEXTURE_2D, image->GetHandle(), 0);
    this->Framebuffer.drawColors(index + 1);
  }

private:
  vtkOpenGLState::ScopedglViewport Viewport;
  vtkOpenGLState::ScopedglColorMask ColorMask;
  vtkOpenGLState::ScopedglBlendFuncSeparate Blending;
  vtkOpenGLState::ScopedglEnableDisable Scissor;
  vtkOpenGLState::ScopedglEnableDisable Blend;
  vtkOpenGLState::ScopedglEnableDisable DepthTest;
  vtkOpenGLState::ScopedglEnableDisable Cull;
  FramebufferScope Framebuffer;
};
}

bool RayCaster::prepareImages(vtkOpenGLRenderWindow* window, const RayCastScene& scene)
{
  const auto prepare = [&](vtkSmartPointer<vtkTextureObject>& image, int format, int filter) {
    if (!image || image->GetWidth() != static_cast<unsigned int>(scene.size.x) ||
      image->GetHeight() != static_cast<unsigned int>(scene.size.y))
    {
      image = makeImage(window, scene.size, format, filter);
    }
    return image != nullptr;
  };
  return prepare(this->Image, GL_RGBA16F, vtkTextureObject::Linear) &&
    prepare(this->Hits[scene.tile], GL_RGBA32F, vtkTextureObject::Nearest) &&
    prepare(this->Spans, GL_RG32F, vtkTextureObject::Nearest);
}

// Rasterises the occupied bricks' faces: first and last t of every pixel.
bool RayCaster::findSpans(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  if (!this->SpansProgram.use(window, proxySource(), counters))
  {
    return false;
  }
  setRayUniforms(this->SpansProgram, scene);
  const glm::mat4 clipFromTexture(scene.clipFromWorld * scene.worldFromTexture);
  this->SpansProgram.set("clipFromTexture", clipFromTexture);
  this->SpansProgram.set("textureFromBrick", glm::vec3(scene.textureFromBrick));
  this->SpansProgram.set("textureOfBrickZero", glm::vec3(scene.textureOfBrickZero));
  this->SpansProgram.set("pixelSize", 2.0f / glm::vec2(scene.size));
  vtkOpenGLState* state = window->GetState();
  ImageScope images(state, scene.size);
  images.attach(0, this->Spans);
  const float nothing[4] = { 1e30f, 1e30f, 1e30f, 1e30f };
  glClearBufferfv(GL_COLOR, 0, nothing);
  state->vtkglEnable(GL_BLEND);
  glBlendEquation(GL_MIN);
  glEnable(GL_DEPTH_CLAMP); // faces beyond the clipping planes bound the ray too
  scene.presence->drawFaces(this->SpansProgram.get()->GetHandle());
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
}

bool RayCaster::cast(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  RayCastVariant variant;
  variant.deformed = scene.offsets != nullptr;
  variant.light = !scene.shaded ? RayCastVariant::Unshaded
    : !scene.normals            ? RayCastVariant::GradientsOnTheFly
    : scene.packedNormals       ? RayCastVariant::PackedGradients
                                : RayCastVariant::GradientTexture;
  variant.blend = scene.options.blend;
  variant.coloring = scene.options.coloring;
  variant.regions = scene.options.regions;
  Program& program = this->CastPrograms[variant];
  if (!this->prepareImages(window, scene) ||
    (scene.skipping && !this->findSpans(window, scene, counters)) ||
    !program.use(window, rayCastSource(variant), counters))
  {
    return false;
  }
  this->setUniforms(program, scene);
  {
    ImageScope images(window->GetState(), scene.size);
    images.attach(0, this->Image);
    images.attach(1, this->Hits[scene.tile]);
    drawTriangles(1);
  }
  for (vtkTextureObject* texture :
    { scene.scalars, scene.offsets, scene.normals, scene.transfer, scene.sceneDepth,
      scene.options.colors, scene.options.colorScalars, scene.presence->map(), this->Spans.Get() })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  counters.frames += 1;
  return true;
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
  state->vtkglViewport(origin.x, origin.y, size.x, size.y);
  this->CompositeProgram.set("image", this->Image.Get());
  drawTriangles(1);
  this->Image->Deactivate();
  return true;
}

void RayCaster::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Image, &this->Hits[0], &this->Hits[1], &this->Spans })
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
