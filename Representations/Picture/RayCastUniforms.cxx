// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/RayCastUniforms.h"

#include "Representations/Scene/Frustum.h"
#include "Representations/Scene/SceneUniforms.h"
#include "Representations/Skipping/DeformedPresence.h"

#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace brainshift
{
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
  program.set("hitFromShare", glm::vec2(image.hitFromShare));
  program.set("jitter", image.jitter ? 1.0f : 0.0f);
  program.set("skipping", image.skips ? 1 : 0);
}

void setBehindUniforms(Program& program, const SceneBehind& behind)
{
  program.set("sceneDepth", behind.depth);
  program.set("depthFromShare", behind.depthFromShare);
  program.set("depthOfShareZero", behind.depthOfShareZero);
}

glm::vec3 texelOf(vtkTextureObject* texture)
{
  return 1.0f / glm::vec3(texture->GetWidth(), texture->GetHeight(), texture->GetDepth());
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
    program.set("shareFromScalar", glm::vec2(blending.shareFromScalar));
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
  if (segment.shares)
  {
    program.set("segment", segment.shares);
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
  else
  {
    program.set("referenceVoxel", glm::vec3(reference.tissue.voxel));
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
  setColoringUniforms(program, scene.tissue.coloring);
  setEvidenceUniforms(program, scene.evidence);
  if (scene.comparison.reference)
  {
    setComparisonUniforms(program, scene);
  }
}

void deactivateTextures(const RayCastScene& scene)
{
  const SceneTissue& tissue = scene.tissue;
  for (vtkTextureObject* texture : { tissue.scalars, tissue.normals, tissue.transfer,
         scene.behind.depth, tissue.coloring.colors, tissue.coloring.scalars, tissue.segment.shares,
         scene.skipping.presence->leaps(), scene.comparison.cavity.voxels, tissue.transferSums,
         tissue.steepness.entries, scene.evidence.deviations })
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
}
