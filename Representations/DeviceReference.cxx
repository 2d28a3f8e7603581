// SPDX-License-Identifier: BSD-3-Clause
#include "DeviceReference.h"

#include "OpenGL.h"
#include "RayCaster.h"
#include "TextureMemory.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkVolume.h"

#include <glm/matrix.hpp>

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
  RayCastComparison& comparison = scene.comparison;
  if (vtkDataArray* voxels = reference.cavity.voxels)
  {
    const ValueLayout layout = layoutOf(reference.cavity.grid.dimensions, false);
    constexpr int firstComponent = 0;
    if (!this->Cavity.update(window, voxels, layout.dimensions, firstComponent, counters, problem))
    {
      return false;
    }
    comparison.cavity = this->Cavity.texture();
    comparison.cavity->SetMinificationFilter(vtkTextureObject::Nearest);
    comparison.cavity->SetMagnificationFilter(vtkTextureObject::Nearest);
    comparison.cavityFromTexture =
      glm::inverse(worldFromTexture(reference.cavity.grid, layout, volume->GetMatrix())) *
      scene.worldFromTexture;
  }
  comparison.reference = &alone;
  return true;
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
