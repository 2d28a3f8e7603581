// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/RayCastComparison.h"

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkTextureObject.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <vector>

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
  setReferencePlace(program,
    { reference.scalars, glm::inverse(reference.worldFromTexture) * scene.worldFromTexture,
      reference.volumeLow, reference.volumeHigh });
  program.set("cropLow", glm::vec3(comparison.cropLow));
  program.set("cropHigh", glm::vec3(comparison.cropHigh));
  program.set("referenceTransfer", reference.transfer);
  program.set("transferFromReference", glm::vec2(reference.transferFromScalar));
  program.set("visibleReference", glm::vec2(reference.visibleScalars));
  program.set("agreementSamples", static_cast<float>(comparison.agreementMm / scene.stepMm));
  setBrickUniforms(program, reference);
  if (scene.shaded)
  {
    setLightUniforms(program, reference);
  }
  setCavityUniforms(program, comparison.cavity);
}

bool cropByPlanes(vtkVolumeMapper* mapper, vtkVolume* volume, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene)
{
  if (!mapper->GetCropping())
  {
    return true;
  }
  if (mapper->GetCroppingRegionFlags() != VTK_CROP_SUBVOLUME)
  {
    return false;
  }
  glm::dvec3 low;
  glm::dvec3 high;
  cropBox(grid, layout, mapper->GetCroppingRegionPlanes(), low, high);
  const glm::dmat4 world = worldFromTexture(grid, layout, volume->GetMatrix());
  const glm::dmat4 covectors =
    glm::transpose(glm::inverse(world) * scene.worldFromTexture); // of planes, from that volume's
  std::vector<float>& planes = scene.options.clipPlanes;
  constexpr int numbersOfPlane = 4;
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    glm::dvec4 plane(0.0);
    plane[axis] = side % 2 ? -1.0 : 1.0;
    plane.w = side % 2 ? high[axis] : -low[axis];
    const glm::vec4 kept(covectors * plane);
    if (planes.size() < MaxClipPlanes * numbersOfPlane)
    {
      planes.insert(planes.end(), &kept[0], &kept[0] + numbersOfPlane);
    }
  }
  return true;
}

void placeComparedPixels(RayCastScene& scene)
{
  const std::vector<IndexBox>& bricks = scene.presence->occupiedLayers();
  if (!scene.comparison.reference)
  {
    placeShownPixels(bricks, scene);
    return;
  }
  RayCastScene& reference = *scene.comparison.reference;
  reference.size = scene.size;
  reference.skipping = scene.skipping;
  const std::vector<IndexBox>& referenceBricks = reference.presence->occupiedLayers();
  placeShownPixels(referenceBricks, reference);
  if (bricks.empty())
  {
    scene.skipping = reference.skipping;
    scene.shown.low = reference.shown.low;
    scene.shown.high = reference.shown.high;
    return;
  }
  placeShownPixels(bricks, scene);
  if (!referenceBricks.empty())
  {
    scene.skipping = scene.skipping && reference.skipping;
    scene.shown.low = glm::min(scene.shown.low, reference.shown.low);
    scene.shown.high = glm::max(scene.shown.high, reference.shown.high);
  }
}
}
