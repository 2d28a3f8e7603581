// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/ResectionTextures.h"

#include "Filters/Deformation/SegmentFractions.h"
#include "Representations/Gpu/GpuTask.h"
#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Tissue/SegmentTexture.h"

#include "vtkOpenGLRenderWindow.h"

#include <algorithm>

namespace brainshift
{
Mask croppedMask(const PlacedVoxels& placed)
{
  constexpr int around = 3; // two of the filter of fractions, one of interpolation
  const Grid& grid = placed.grid;
  const auto isInside = [&](int x, int y, int z) {
    return placed.voxels->GetComponent(static_cast<vtkIdType>(grid.offset(x, y, z)), 0) > 0.0;
  };
  glm::ivec3 low = grid.dimensions;
  glm::ivec3 high(-1);
  const auto forAll = [](const glm::ivec3& first, const glm::ivec3& last, const auto& visit) {
    for (int z = first.z; z <= last.z; ++z)
    {
      for (int y = first.y; y <= last.y; ++y)
      {
        for (int x = first.x; x <= last.x; ++x)
        {
          visit(x, y, z);
        }
      }
    }
  };
  forAll(glm::ivec3(0), grid.dimensions - 1, [&](int x, int y, int z) {
    if (isInside(x, y, z))
    {
      low = glm::min(low, glm::ivec3(x, y, z));
      high = glm::max(high, glm::ivec3(x, y, z));
    }
  });
  Mask mask;
  mask.grid = grid;
  mask.grid.dimensions = glm::max(high - low + 1, glm::ivec3(0)) + 2 * around;
  mask.grid.origin = grid.worldFromGrid(glm::dvec3(low - around));
  mask.inside.assign(mask.grid.count(), 0);
  forAll(low, high, [&](int x, int y, int z) {
    const glm::ivec3 at = glm::ivec3(x, y, z) - low + around;
    mask.inside[mask.grid.offset(at.x, at.y, at.z)] = isInside(x, y, z) ? 1 : 0;
  });
  return mask;
}

bool MaskTexture::update(
  GpuTask& gpu, const PlacedVoxels& mask, const VolumePlace& volume, PlacedFractions& placed)
{
  if (!mask.voxels)
  {
    this->releaseGraphicsResources(gpu.window);
    return true;
  }
  const bool holds = this->Texture && this->Uploaded == mask.voxels &&
    this->UploadedTime == mask.voxels->GetMTime() && this->UploadedGrid == mask.grid;
  if (!holds)
  {
    const Mask cropped = croppedMask(mask);
    this->Texture = fractionTexture(
      gpu.window, segmentFractions(cropped, cropped.grid), cropped.grid.dimensions, gpu.counters);
    this->Place = cropped.grid;
    this->Uploaded = mask.voxels;
    this->UploadedTime = mask.voxels->GetMTime();
    this->UploadedGrid = mask.grid;
  }
  if (!this->Texture)
  {
    return gpu.fail("The GPU refused a 3D texture for a resection");
  }
  placed.fractions = this->Texture;
  placed.ownFromTexture =
    volume.otherFromTexture(this->Place, layoutOf(this->Place.dimensions, false));
  return true;
}

void MaskTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded = nullptr;
}

bool ResectionTextures::update(
  GpuTask& gpu, const Resection& resection, const VolumePlace& volume, SceneResection& scene)
{
  return this->Removed.update(gpu, resection.cavity, volume, scene.removed) &&
    this->Tumour.update(gpu, resection.tumour, volume, scene.tumour);
}

std::vector<vtkTextureObject*> ResectionTextures::textures() const
{
  return { this->Removed.texture(), this->Tumour.texture() };
}

void ResectionTextures::releaseGraphicsResources(vtkWindow* window)
{
  this->Removed.releaseGraphicsResources(window);
  this->Tumour.releaseGraphicsResources(window);
}
}
