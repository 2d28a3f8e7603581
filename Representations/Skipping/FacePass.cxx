// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/FacePass.h"

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/Frustum.h"
#include "Representations/Scene/RayCastScene.h"
#include "Representations/Skipping/DeformedPresence.h"

#include "vtkShaderProgram.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace brainshift
{
namespace
{
// A plane parallel to the near plane lies at one share of the way to the far plane. So the distance
// along a ray is that share of the ray's length.
void setFaceUniforms(Program& program, const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  const Frustum frustum = frustumOf(clipFromTexture);
  const glm::dvec3 across = glm::cross(frustum.near.right, frustum.near.up);
  const glm::dvec3 share = across / glm::dot(across, frustum.far.origin - frustum.near.origin);
  program.set("shareFromTexture", glm::vec3(share));
  program.set("shareOfTextureZero", static_cast<float>(-glm::dot(share, frustum.near.origin)));
  program.set("clipFromTexture", glm::mat4(clipFromTexture));
  program.set("textureFromBrick", glm::vec3(scene.skipping.textureFromBrick));
  program.set("textureOfBrickZero", glm::vec3(scene.skipping.textureOfBrickZero));
}

// The eye in bricks, homogeneous, as DeformedPresence takes it.
glm::dvec4 eyeInBricks(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  // What projects to no place in the window but only to a depth: the eye, or the direction to it.
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
}
