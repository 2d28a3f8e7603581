// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/DeviceTissue.h"

#include "Representations/Scene/FieldPlace.h"
#include "Representations/Scene/SceneFrame.h"
#include "Representations/Tissue/SceneReference.h"

#include "vtkVolume.h"

namespace brainshift
{
namespace
{
// Bricks count voxels from the middle of the first one.
glm::dvec3 voxelFromTexture(const ValueLayout& layout, const glm::dvec3& texture)
{
  return texture * glm::dvec3(layout.dimensions) - 0.5;
}

PresenceRequest bricksOf(const ValueLayout& layout, const SceneField& field)
{
  const double side = BrickSide;
  const glm::ivec3 first(glm::floor(voxelFromTexture(layout, field.spaceLow) / side));
  const glm::ivec3 end(glm::floor(voxelFromTexture(layout, field.spaceHigh) / side) + 1.0);
  PresenceRequest request;
  request.restBricks = (layout.dimensions + RestBrickSide - 1) / RestBrickSide;
  request.first = first;
  request.count = end - first;
  request.lowestVoxel = glm::vec3(voxelFromTexture(layout, layout.low));
  request.highestVoxel = glm::vec3(voxelFromTexture(layout, layout.high));
  request.offsets = field.offsets;
  if (vtkTextureObject* offsets = field.offsets)
  {
    const glm::dvec3 values(layout.dimensions);
    const glm::dvec3 count(offsets->GetWidth(), offsets->GetHeight(), offsets->GetDepth());
    request.voxelsFromOffset = glm::vec3(values);
    request.voxelsFromLattice = glm::vec3(values / field.latticeFromTexture);
    request.nodesFromVoxel = glm::vec3(field.fieldFromTexture * count / values);
    request.nodesFromVoxelShift =
      glm::vec3((0.5 / values * field.fieldFromTexture + field.fieldOfTextureZero) * count - 0.5);
  }
  return request;
}
}

bool DeviceTissue::updateBricks(GpuTask& gpu, const TissueRequest& request, const SceneField& field,
  const IndexBox& changed, SceneSkipping& skipping)
{
  if (this->Textures.takeVisibilityChange())
  {
    std::vector<float> summed = this->Textures.summedVisibility();
    this->Presence.setVisibility(gpu.window, this->Textures.restBricks(), summed, gpu.counters);
  }
  const PresenceRequest bricks = bricksOf(request.values.layout, field);
  if (!this->Presence.update(gpu.window, bricks, changed, gpu.counters))
  {
    return gpu.fail(
      "The presence map's shader does not compile or its texture cannot be made on this GPU");
  }
  const glm::dvec3 values(request.values.layout.dimensions);
  skipping.allowed = request.skips && this->Textures.skippingIsExact(request.blend);
  skipping.presence = &this->Presence;
  skipping.textureFromBrick = static_cast<double>(BrickSide) / values;
  skipping.textureOfBrickZero = 0.5 / values;
  skipping.firstBrick = glm::dvec3(bricks.first);
  return true;
}

std::int64_t DeviceTissue::otherBytes() const
{
  return this->Presence.faceBytes() +
    textureBytes({ this->Textures.otherTextures(), this->Presence.textures() });
}

void DeviceTissue::releaseGraphicsResources(vtkWindow* window)
{
  this->Textures.releaseGraphicsResources(window);
  this->Presence.releaseGraphicsResources(window);
}

bool DeviceReference::update(
  GpuTask& gpu, const DrawnVolume& drawn, const SceneReference& reference, RayCastScene& scene)
{
  const TissueRequest& request = reference.tissue;
  const IndexBox nothingMoves;
  scene.field = restField(request.values.layout);
  scene.frame = frameOf(drawn, request.values);
  return this->Tissue.Textures.update(gpu, request, scene.tissue) &&
    this->Tissue.updateBricks(gpu, request, scene.field, nothingMoves, scene.skipping);
}

bool DeviceReference::compare(GpuTask& gpu, const DrawnVolume& drawn,
  const SceneReference& reference, RayCastScene& scene, RayCastScene& alone)
{
  if (!this->update(gpu, drawn, reference, alone))
  {
    return false;
  }
  const VolumePlace place{ scene.frame.worldFromTexture, drawn.volume->GetMatrix() };
  if (!this->Cavity.update(gpu, reference.cavity, place, scene.comparison.cavity))
  {
    return false;
  }
  scene.comparison.reference = &alone;
  scene.comparison.agreementMm = reference.agreementMm;
  scene.comparison.colors = reference.colors;
  return true;
}

std::int64_t DeviceReference::bytes() const
{
  return this->Tissue.otherBytes() +
    textureBytes({ { this->Tissue.Textures.scalars(), this->Cavity.texture() } });
}

void DeviceReference::releaseGraphicsResources(vtkWindow* window)
{
  this->Tissue.releaseGraphicsResources(window);
  this->Cavity.releaseGraphicsResources(window);
}
}
