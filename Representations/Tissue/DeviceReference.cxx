// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/DeviceReference.h"

#include "Representations/Picture/RayCaster.h"
#include "Representations/Gpu/TextureMemory.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkVolume.h"

namespace brainshift
{
bool DeviceReference::update(vtkOpenGLRenderWindow* window, const SceneReference& reference,
  RayCastScene& scene, Counters& counters, std::string& problem)
{
  const ValueLayout& layout = reference.tissue.layout;
  scene.spaceLow = layout.low;
  scene.spaceHigh = layout.high;
  const IndexBox nothingMoves;
  return this->Present.Tissue.update(window, reference.tissue, scene, counters, problem) &&
    this->Present.updatePresence(window, layout, scene, nothingMoves, counters, problem);
}

bool DeviceReference::compare(vtkRenderer* renderer, vtkVolume* volume,
  const SceneReference& reference, RayCastScene& scene, RayCastScene& alone, Counters& counters,
  std::string& problem)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  if (!this->update(window, reference, alone, counters, problem))
  {
    return false;
  }
  describeView(renderer, volume, reference.grid, reference.tissue.layout, alone);
  scene.comparison.reference = &alone;
  return this->Cavity.update(window, reference.cavity,
    { scene.worldFromTexture, volume->GetMatrix() }, scene.comparison.cavity, counters, problem);
}

std::int64_t DeviceReference::bytes() const
{
  return this->Present.otherBytes() +
    textureBytes({ { this->Present.Tissue.scalars(), this->Cavity.texture() } });
}

void DeviceReference::releaseGraphicsResources(vtkWindow* window)
{
  this->Present.releaseGraphicsResources(window);
  this->Cavity.releaseGraphicsResources(window);
}
}
