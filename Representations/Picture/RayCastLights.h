// SPDX-License-Identifier: BSD-3-Clause
// A renderer's lights as the shaders want them.
#ifndef BrainShift_RayCastLights_h
#define BrainShift_RayCastLights_h

#include <vector>

class vtkRenderer;

namespace brainshift
{
struct RayCastLights
{
  bool headlight = false;      // the only light is at the eye
  std::vector<float> position; // 4 each: world; w 0: direction towards the light
  std::vector<float> color;    // 3 each, times intensity
  std::vector<float> specular; // 3 each
};

RayCastLights lightsOf(vtkRenderer* renderer);
}

#endif
