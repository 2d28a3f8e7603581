// SPDX-License-Identifier: BSD-3-Clause
#include "RayCaster.h"

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
  program.set("spaceLow", glm::vec3(scene.spaceLow));
  program.set("spaceHigh", glm::vec3(scene.spaceHigh));
  program.set("stepMm", static_cast<float>(scene.stepMm));
  program.set("sceneDepth", scene.sceneDepth);
}

void setTissueUniforms(Program& program, const RayCastScene& scene)
{
  program.set("scalars", scene.scalars);
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
}

void setLightUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat3 worldFromTexture(scene.worldFromTexture);
  program.set("voxel", glm::vec3(scene.voxel));
  program.set(
    "worldFromGradient", glm::mat3(glm::transpose(glm::inverse(worldFromTexture))));
  program.set("worldOfTextureZero", glm::vec3(scene.worldFromTexture[3]));
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
  lights.headlight = others == 0;
  return lights;
}

RayCaster::RayCaster() = default;
RayCaster::~RayCaster() = default;

bool RayCaster::prepareImage(vtkOpenGLRenderWindow* window, const glm::ivec2& size)
{
  if (this->Image && this->Image->GetWidth() == static_cast<unsigned int>(size.x) &&
    this->Image->GetHeight() == static_cast<unsigned int>(size.y))
  {
    return true;
  }
  this->Image = vtkSmartPointer<vtkTextureObject>::New();
  this->Image->SetContext(window);
  this->Image->SetMinificationFilter(vtkTextureObject::Linear);
  this->Image->SetMagnificationFilter(vtkTextureObject::Linear);
  this->Image->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Image->SetWrapT(vtkTextureObject::ClampToEdge);
  return this->Image->Allocate2D(size.x, size.y, 4, VTK_FLOAT);
}

void RayCaster::setUniforms(Program& program, const RayCastScene& scene)
{
  setRayUniforms(program, scene);
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
}

bool RayCaster::cast(
  vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters)
{
  const bool deformed = scene.offsets != nullptr;
  Program& program = this->CastPrograms[deformed][scene.shaded];
  if (!this->prepareImage(window, scene.size) ||
    !program.use(window, rayCastSource({ deformed, scene.shaded }), counters))
  {
    return false;
  }
  this->setUniforms(program, scene);

  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Image->GetHandle(), 0);
  framebuffer.drawColors(1);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglViewport(0, 0, scene.size.x, scene.size.y);
  drawTriangles(1);
  for (vtkTextureObject* texture :
    { scene.scalars, scene.offsets, scene.transfer, scene.sceneDepth })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  counters.frames += 1;
  return true;
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
  if (this->Image)
  {
    this->Image->ReleaseGraphicsResources(window);
  }
  this->Image = nullptr;
  this->CompositeProgram.forget();
  for (auto& programs : this->CastPrograms)
  {
    programs[0].forget();
    programs[1].forget();
  }
}
}
