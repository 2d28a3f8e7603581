// SPDX-License-Identifier: BSD-3-Clause
// A reference volume and its cavity on the GPU of one window.
#ifndef BrainShift_DeviceReference_h
#define BrainShift_DeviceReference_h

#include "Representations/Tissue/PlacedReference.h"
#include "Representations/Tissue/PresentTissue.h"
#include "Representations/Tissue/SceneReference.h"

#include <cstdint>
#include <string>

class vtkRenderer;
class vtkVolume;

namespace brainshift
{
class DeviceReference
{
public:
  PresentTissue Present;

  // Makes the reference current and describes the scene in which it is drawn alone, all but its
  // camera. On failure returns false and says why in `problem`.
  bool update(vtkOpenGLRenderWindow* window, const SceneReference& reference, RayCastScene& scene,
    Counters& counters, std::string& problem);

  // Likewise the scene, whose camera is placed, as compared with the reference. `alone`: kept by
  // the caller as long as the scene.
  bool compare(vtkRenderer* renderer, vtkVolume* volume, const SceneReference& reference,
    RayCastScene& scene, RayCastScene& alone, Counters& counters, std::string& problem);

  // Bytes on the GPU.
  std::int64_t bytes() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  CavityTexture Cavity;
};
}

#endif
