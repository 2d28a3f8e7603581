// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A volume on the GPU of one window: its textures, and the bricks in which something is
 * seen.
 */
#ifndef BrainShift_DeviceTissue_h
#define BrainShift_DeviceTissue_h

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Tissue/TissueTextures.h"

#include <cstdint>

namespace brainshift
{
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
}

#endif
