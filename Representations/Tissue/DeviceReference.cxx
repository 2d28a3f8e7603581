// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/DeviceReference.h"

#include "Representations/Gpu/TextureMemory.h"
#include "Representations/Scene/FieldPlace.h"

#include "vtkTextureObject.h"
#include "vtkVolume.h"

namespace brainshift
{
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
