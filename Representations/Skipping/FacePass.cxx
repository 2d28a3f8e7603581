// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/FacePass.h"

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Scene/Frustum.h"
#include "Representations/Picture/RayCaster.h"

#include "vtkShaderProgram.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace brainshift
{
namespace
{
// Faces of the occupied bricks. All of a plane parallel to the near plane lies at the same share of
// the way to the far plane, so that a ray's t is that share of its length.
void setFaceUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.clipFromWorld * scene.worldFromTexture;
  const Frustum frustum = frustumOf(clipFromTexture);
  const glm::dvec3 across = glm::cross(frustum.near.right, frustum.near.up);
  const glm::dvec3 share = across / glm::dot(across, frustum.far.origin - frustum.near.origin);
  program.set("shareFromTexture", glm::vec3(share));
  program.set("shareOfTextureZero", static_cast<float>(-glm::dot(share, frustum.near.origin)));
  program.set("clipFromTexture", glm::mat4(clipFromTexture));
  program.set("textureFromBrick", glm::vec3(scene.textureFromBrick));
  program.set("textureOfBrickZero", glm::vec3(scene.textureOfBrickZero));
}

// The eye in bricks, as DeformedPresence takes it.
glm::dvec4 eyeInBricks(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.clipFromWorld * scene.worldFromTexture;
  // What projects to no place in the window but to depth alone: the eye, or the way towards it.
  const glm::dvec4 eye = glm::inverse(clipFromTexture) * glm::dvec4(0.0, 0.0, -1.0, 0.0);
  const double w = std::abs(eye.w) < 1e-9 * glm::length(glm::dvec3(eye)) ? 0.0 : eye.w;
  return glm::dvec4((glm::dvec3(eye) - w * scene.textureOfBrickZero) / scene.textureFromBrick, w);
}

}

void drawFaces(Program& program, const RayCastScene& scene)
{
  const glm::dvec4 eye = eyeInBricks(scene);
  const bool frontAlone = scene.raysEndSoon() && scene.presence->isOutside(eye);
  setFaceUniforms(program, scene);
  program.set("backDrawn", frontAlone ? 0.0f : 1.0f);
  if (frontAlone)
  {
    scene.presence->drawFaces(program.get()->GetHandle(), eye);
  }
  else
  {
    scene.presence->drawFaces(program.get()->GetHandle());
  }
}
}
