// SPDX-License-Identifier: BSD-3-Clause
// Tissue that was removed, told by a mask: colours and numbers ignore it.
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
// Keeps the voxels of the last image: the same array object for as long as nothing of it changed.
class VTKBRAINSHIFTFILTERS_EXPORT CavitySource
{
public:
  // Nothing without an image. `labels` and `volume` as in readMask, `volumeName` for messages; sets
  // `problem` to what is wrong with the image, if anything is.
  PlacedVoxels find(vtkImageData* image, const std::vector<int>& labels, const Grid& volume,
    const std::string& volumeName, std::string& problem);

private:
  vtkSmartPointer<vtkDataArray> Voxels; // null: the last image was no mask
  Grid VoxelsGrid;
  vtkSmartPointer<vtkImageData> Image; // that Voxels shows, as of ImageTime
  unsigned long long ImageTime = 0;
  std::vector<int> Labels;
};

// Whether the voxel nearest to a position (mm, world) is cavity; false beyond all voxels, and where
// there is no cavity.
VTKBRAINSHIFTFILTERS_EXPORT bool isRemoved(const PlacedVoxels& cavity, const glm::dvec3& position);
}

#endif
