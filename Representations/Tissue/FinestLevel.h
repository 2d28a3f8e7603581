// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How finely a volume is drawn that is too large for the GPU: as finely as fits.
#ifndef BrainShift_FinestLevel_h
#define BrainShift_FinestLevel_h

#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Scene/SceneGeometry.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <functional>
#include <string>

namespace brainshift
{
struct GpuTask;
struct TissueRequest;

/// Voxels a side that become one texel. Level 0: each has its own, unless a side has more than
/// `longest`. Further levels join more of them, so that texels are as nearly cubes as whole numbers
/// allow: thick slices are joined last.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 voxelsPerTexel(
  const glm::ivec3& voxels, const glm::dvec3& spacing, int level, int longest);

/// Finds the level for one window, and keeps it while nothing that it depends on changes: what does
/// not fit is not asked for again in each picture.
class FinestLevel
{
public:
  /// Calls `attempt`, which draws `tissue`, with coarser and coarser texels, until it succeeds or
  /// fails for another reason than memory. A remark says what is drawn in place of all voxels, and
  /// what would bring them. If nothing fits, the problem is that of level 0. `need`: of level 0.
  /// `limitMiB`: see memoryProblem.
  bool draw(GpuTask& gpu, TissueRequest& tissue, const MemoryNeed& need, double limitMiB,
    const std::function<bool()>& attempt);

private:
  bool attempt(GpuTask& gpu, const ValueLayout& layout, const std::function<bool()>& attempt);

  struct Circumstances // in which the level was found
  {
    glm::ivec3 voxels{ 0 };
    std::int64_t tissueBytes = 0;
    double limitMiB = 0.0;
    int givenBack = 0; // textures

    bool operator==(const Circumstances& other) const
    {
      return this->voxels == other.voxels && this->tissueBytes == other.tissueBytes &&
        this->limitMiB == other.limitMiB && this->givenBack == other.givenBack;
    }
  };

  Circumstances Found;
  int Level = 0;
  std::string Problem;   // of level 0; empty if that is drawn
  long long Refused = 0; // texels with which the GPU ran out of memory; 0: never
};
}

#endif
