// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How finely a volume is drawn that is too large for the GPU: as finely as fits, never not at all.
#ifndef BrainShift_FinestLevel_h
#define BrainShift_FinestLevel_h

#include "Representations/Scene/SceneGeometry.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <functional>

namespace brainshift
{
struct GpuTask;
struct TissueRequest;

/// Voxels a side that become one texel. Level 0: each has its own. Further levels join more of
/// them, so that texels are as nearly cubes as whole numbers allow: thick slices are joined last.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 voxelsPerTexel(
  const glm::ivec3& voxels, const glm::dvec3& spacing, int level);

/// Remembers for one window what it refused.
class FinestLevel
{
public:
  /// Calls `attempt`, which draws `tissue`, with coarser and coarser texels, until it succeeds or
  /// fails for another reason than memory. A remark says what is drawn in place of all voxels. If
  /// nothing fits, the problem is that of level 0.
  bool draw(GpuTask& gpu, TissueRequest& tissue, const std::function<bool()>& attempt);

private:
  bool attempt(GpuTask& gpu, const ValueLayout& layout, const std::function<bool()>& attempt);

  long long Refused = 0; // texels with which the GPU ran out of memory; 0: never
  int RefusedAt = 0;     // textures that were given back before
};
}

#endif
