// SPDX-License-Identifier: BSD-3-Clause
#include "RayCastComparison.h"

#include "DeformedPresence.h"
#include "RayCaster.h"
#include "SceneGeometry.h"

#include "vtkTextureObject.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

namespace brainshift
{
namespace
{
void setBrickUniforms(Program& program, const RayCastScene& reference)
{
  vtkTextureObject* leaps = reference.presence->leaps();
  program.set("referenceLeaps", leaps);
  program.set("referenceLeapsTexel",
    1.0f / glm::vec3(leaps->GetWidth(), leaps->GetHeight(), leaps->GetDepth()));
  program.set("brickFromReference", glm::vec3(1.0 / reference.textureFromBrick));
  program.set("brickOfReferenceZero",
    glm::vec3(-reference.textureOfBrickZero / reference.textureFromBrick - reference.firstBrick));
}

void setLightUniforms(Program& program, const RayCastScene& reference)
{
  const glm::dmat3 worldFromTexture(reference.worldFromTexture);
  program.set(
    "worldFromReferenceGradient", glm::mat3(glm::transpose(glm::inverse(worldFromTexture))));
  if (reference.normals)
  {
    program.set("referenceNormals", reference.normals);
  }
  else
  {
    program.set("referenceVoxel", glm::vec3(reference.voxel));
  }
}
}

void setComparisonUniforms(Program& program, const RayCastScene& scene)
{
  const RayCastComparison& comparison = scene.comparison;
  const RayCastScene& reference = *comparison.reference;
  program.set("reference", reference.scalars);
  program.set("referenceFromTexture",
    glm::mat4(glm::inverse(reference.worldFromTexture) * scene.worldFromTexture));
  program.set("referenceLow", glm::vec3(reference.volumeLow));
  program.set("referenceHigh", glm::vec3(reference.volumeHigh));
  program.set("cropLow", glm::vec3(comparison.cropLow));
  program.set("cropHigh", glm::vec3(comparison.cropHigh));
  program.set("transferFromReference", glm::vec2(reference.transferFromScalar));
  program.set("visibleReference", glm::vec2(reference.visibleScalars));
  program.set("agreementSamples", static_cast<float>(comparison.agreementMm / scene.stepMm));
  setBrickUniforms(program, reference);
  if (scene.shaded)
  {
    setLightUniforms(program, reference);
  }
  if (comparison.cavity)
  {
    program.set("cavity", comparison.cavity);
    program.set("cavityFromTexture", glm::mat4(comparison.cavityFromTexture));
  }
}

void placeComparedPixels(RayCastScene& scene)
{
  const IndexBox& bricks = scene.presence->occupiedBox();
  if (!scene.comparison.reference)
  {
    placeShownPixels(bricks, scene);
    return;
  }
  RayCastScene& reference = *scene.comparison.reference;
  reference.size = scene.size;
  reference.skipping = scene.skipping;
  const IndexBox& referenceBricks = reference.presence->occupiedBox();
  placeShownPixels(referenceBricks, reference);
  if (bricks.empty())
  {
    scene.skipping = reference.skipping;
    scene.shownLow = reference.shownLow;
    scene.shownHigh = reference.shownHigh;
    return;
  }
  placeShownPixels(bricks, scene);
  if (!referenceBricks.empty())
  {
    scene.skipping = scene.skipping && reference.skipping;
    scene.shownLow = glm::min(scene.shownLow, reference.shownLow);
    scene.shownHigh = glm::max(scene.shownHigh, reference.shownHigh);
  }
}
}
