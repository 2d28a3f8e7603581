// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneFrame.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"

namespace brainshift
{
namespace
{
SceneLights lightsOf(vtkRenderer* renderer)
{
  SceneLights lights;
  int others = 0;
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* collection = renderer->GetLights();
  collection->InitTraversal(iterator);
  while (vtkLight* light = collection->GetNextLight(iterator))
  {
    if (!light->GetSwitch() || static_cast<int>(lights.position.size()) >= 4 * MaxLights)
    {
      continue;
    }
    others += light->LightTypeIsHeadlight() ? 0 : 1;
    double position[3];
    light->GetTransformedPosition(position);
    glm::dvec4 source(position[0], position[1], position[2], 1.0);
    if (!light->GetPositional())
    {
      double focus[3];
      light->GetTransformedFocalPoint(focus);
      const glm::dvec3 towards(
        position[0] - focus[0], position[1] - focus[1], position[2] - focus[2]);
      source = glm::dvec4(glm::normalize(towards), 0.0);
    }
    const double intensity = light->GetIntensity();
    for (int i = 0; i < 4; ++i)
    {
      lights.position.push_back(static_cast<float>(source[i]));
    }
    for (int i = 0; i < 3; ++i)
    {
      lights.color.push_back(static_cast<float>(light->GetDiffuseColor()[i] * intensity));
      lights.specular.push_back(static_cast<float>(light->GetSpecularColor()[i] * intensity));
    }
  }
  lights.headlight = others == 0 && lights.position.size() == 4;
  return lights;
}
}

SceneFrame frameOf(const DrawnVolume& drawn, const DrawnValues& values)
{
  SceneFrame frame;
  frame.clipFromWorld = clipFromWorld(drawn.renderer);
  frame.worldFromTexture = worldFromTexture(values.grid, values.layout, drawn.volume->GetMatrix());
  frame.mmFromTexture = values.grid.spacing / values.layout.textureFromGrid;
  frame.lights = lightsOf(drawn.renderer);
  const int* tiles = drawn.renderer->GetRenderWindow()->GetTileScale();
  frame.tile = tiles[0] * tiles[1] > 1;
  return frame;
}
}
