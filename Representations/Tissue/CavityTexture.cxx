// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/CavityTexture.h"

#include "Representations/Scene/SceneGeometry.h"

#include "vtkTextureObject.h"

namespace brainshift
{
bool CavityTexture::update(
  GpuTask& gpu, const PlacedVoxels& cavity, const VolumePlace& volume, PlacedCavity& placed)
{
  if (!cavity.voxels)
  {
    return true;
  }
  const ValueLayout layout = layoutOf(cavity.grid.dimensions, false);
  constexpr int firstComponent = 0;
  if (!this->Voxels.update(gpu, cavity.voxels, layout, firstComponent))
  {
    return false;
  }
  placed.voxels = this->Voxels.texture();
  // The nearest voxel's value would show steps.
  placed.voxels->SetMinificationFilter(vtkTextureObject::Linear);
  placed.voxels->SetMagnificationFilter(vtkTextureObject::Linear);
  placed.cavityFromTexture = volume.otherFromTexture(cavity.grid, layout);
  constexpr double half = 0.5; // between 0, outside, and 1, inside
  placed.least = (half - this->Voxels.shift()) / this->Voxels.scale();
  return true;
}

void CavityTexture::releaseGraphicsResources(vtkWindow* window)
{
  this->Voxels.releaseGraphicsResources(window);
}
}
