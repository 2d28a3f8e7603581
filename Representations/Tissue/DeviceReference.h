// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A reference volume and its cavity on the GPU of one window.
 */
#ifndef BrainShift_DeviceReference_h
#define BrainShift_DeviceReference_h

#include "Representations/Scene/SceneFrame.h"
#include "Representations/Tissue/CavityTexture.h"
#include "Representations/Tissue/DeviceTissue.h"
#include "Representations/Tissue/SceneReference.h"

#include <cstdint>

namespace brainshift
{
/// The reference of one volume.
class DeviceReference
{
public:
  DeviceTissue Tissue;

  /// Uploads the reference if it changed, and fills frame, field, tissue and skipping of a scene in
  /// which it is drawn alone. False, with a problem, if this GPU cannot.
  bool update(
    GpuTask& gpu, const DrawnVolume& drawn, const SceneReference& reference, RayCastScene& scene);

  /// Uploads the reference and its cavity if they changed, and fills the comparison of a scene,
  /// whose frame is filled already. The caller keeps `alone` as long as the scene: it becomes the
  /// scene in which the reference is drawn alone. False, with a problem, if this GPU cannot.
  bool compare(GpuTask& gpu, const DrawnVolume& drawn, const SceneReference& reference,
    RayCastScene& scene, RayCastScene& alone);

  /// Bytes on the GPU.
  std::int64_t bytes() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  CavityTexture Cavity;
};
}

#endif
