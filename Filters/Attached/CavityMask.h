// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Tissue that was removed, as a mask image gives it. Colours and numbers ignore it.
 */
#ifndef BrainShift_CavityMask_h
#define BrainShift_CavityMask_h

#include "Filters/Attached/MaskImage.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkImageData.h" // for its smart pointer

#include <string>
#include <vector>

namespace brainshift
{
/**
 * Reads a cavity from an image. It keeps the voxels of the last image and hands out the same array
 * object as long as nothing of the image changes.
 */
class VTKBRAINSHIFTFILTERS_EXPORT CavitySource
{
public:
  /**
   * Finds the cavity.
   *
   * @param image        null or empty: no cavity
   * @param labels       labels of the cavity; none: all above 0
   * @param volume       the volume that the cavity must overlap
   * @param volumeName   what messages call that volume
   * @param problem      set to one sentence, without a full stop, if the image is no mask; else
   *                     left as it is
   * @return the voxels (1 or 0); no voxels without an image or after a problem
   */
  PlacedVoxels find(vtkImageData* image, const std::vector<int>& labels, const Grid& volume,
    const std::string& volumeName, std::string& problem);

private:
  vtkSmartPointer<vtkDataArray> Voxels; // null: the last image was no mask
  Grid VoxelsGrid;
  vtkSmartPointer<vtkImageData> Image; // that Voxels shows, as of ImageTime
  unsigned long long ImageTime = 0;
  std::vector<int> Labels;
};

/**
 * Whether the voxel nearest to a position (mm, world) is cavity. False beyond the voxels, and if
 * there is no cavity.
 */
VTKBRAINSHIFTFILTERS_EXPORT bool isRemoved(const PlacedVoxels& cavity, const glm::dvec3& position);
}

#endif
