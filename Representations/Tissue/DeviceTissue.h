// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A volume on the GPU of one window: its textures, and the bricks in which something is seen.
#ifndef BrainShift_DeviceTissue_h
#define BrainShift_DeviceTissue_h

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Tissue/CavityTexture.h"
#include "Representations/Tissue/TissueTextures.h"

namespace brainshift
{
struct DrawnVolume;
struct SceneReference;

/// Textures and bricks of one volume.
class DeviceTissue
{
public:
  TissueTextures Textures;

  /// Finds the bricks of the field's space that tissue can be seen in, after Textures was updated,
  /// and fills the scene's skipping. `changed`: nodes of the offset field that were computed anew.
  /// False, with a problem, if this GPU cannot.
  bool updateBricks(GpuTask& gpu, const TissueRequest& request, const SceneField& field,
    const IndexBox& changed, SceneSkipping& skipping);

  /// Bytes on the GPU, except for the scalars.
  std::int64_t otherBytes() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  DeformedPresence Presence;
};

// A reference volume and its cavity on the GPU of one window.

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
