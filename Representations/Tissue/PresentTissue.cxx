// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/PresentTissue.h"

#include "Representations/Picture/RayCaster.h"
#include "Representations/Gpu/TextureMemory.h"

#include "vtkTextureObject.h"

namespace brainshift
{
bool PresentTissue::updatePresence(vtkOpenGLRenderWindow* window, const ValueLayout& layout,
  RayCastScene& scene, const IndexBox& changed, Counters& counters, std::string& problem)
{
  if (this->Tissue.takeVisibilityChange())
  {
    std::vector<float> summed = this->Tissue.summedVisibility();
    this->Presence.setVisibility(window, this->Tissue.restBricks(), summed, counters);
  }
  placeBricks(layout, scene, this->Bricks);
  if (!this->Presence.update(window, this->Bricks, changed, counters))
  {
    problem =
      "The presence map's shader does not compile or its texture cannot be made on this GPU";
    return false;
  }
  scene.presence = &this->Presence;
  return true;
}

std::int64_t PresentTissue::otherBytes() const
{
  return this->Presence.faceBytes() +
    textureBytes({ this->Tissue.otherTextures(), this->Presence.textures() });
}

void PresentTissue::releaseGraphicsResources(vtkWindow* window)
{
  this->Tissue.releaseGraphicsResources(window);
  this->Presence.releaseGraphicsResources(window);
}
}
