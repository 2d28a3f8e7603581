// SPDX-License-Identifier: BSD-3-Clause
// A volume on the GPU of one window: what rays look up, and the bricks in which anything is seen.
#ifndef BrainShift_PresentTissue_h
#define BrainShift_PresentTissue_h

#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Tissue/Tissue.h"

#include <string>
#include <vector>

namespace brainshift
{
class PresentTissue
{
public:
  brainshift::Tissue Tissue;
  DeformedPresence Presence;

  // Finds the bricks of the space that the scene's tissue can reach, after Tissue was updated.
  // `changed`: nodes of the scene's offset field computed anew. On failure returns false and says
  // why in `problem`.
  bool updatePresence(vtkOpenGLRenderWindow* window, const ValueLayout& layout, RayCastScene& scene,
    const IndexBox& changed, Counters& counters, std::string& problem);

  // Bytes of all but the scalars on the GPU.
  std::int64_t otherBytes() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  PresenceRequest Bricks; // what Presence shows
};
}

#endif
