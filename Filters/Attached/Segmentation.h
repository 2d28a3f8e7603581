// SPDX-License-Identifier: BSD-3-Clause
// Labels that travel with a deformable volume, for what draws chosen ones alone. They lie at rest,
// on a grid of their own:
//
//   FFDSegmentation        any type x 1, nx*ny*nz tuples, x fastest: labels or scalars
//   FFDSegmentationGrid    see GridArray.h
//   FFDSegmentationLabels  int, only if some are meant unless others are asked for (MaskLabels)
#ifndef BrainShift_Segmentation_h
#define BrainShift_Segmentation_h

#include "Filters/Deformation/Grid.h"
#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;

namespace brainshift
{
// Field array of the labels.
constexpr const char* SegmentationName = "FFDSegmentation";

struct Segmentation
{
  vtkSmartPointer<vtkDataArray> labels; // null: none
  Grid grid;                            // of the labels
  std::vector<int> chosen;              // labels that are meant; none: all above 0
};

// Attaches a segmentation whose labels SegmentationSource made; without labels, takes away one that
// was attached before.
VTKBRAINSHIFTFILTERS_EXPORT void attachSegmentation(
  vtkDataObject* volume, const Segmentation& segmentation);

// Reads what attachSegmentation wrote; no labels if there are none or they do not fit their grid.
VTKBRAINSHIFTFILTERS_EXPORT Segmentation readSegmentation(vtkDataObject* volume);

// Voxels that have one of the labels; with none given, those above 0.
VTKBRAINSHIFTFILTERS_EXPORT Mask segmentOf(
  const Segmentation& segmentation, const std::vector<int>& labels);

// Hands out the same array object for the same numbers, so that what draws it knows it again.
class VTKBRAINSHIFTFILTERS_EXPORT SegmentationSource
{
public:
  // No labels without an image. Returns what keeps the image from being a segmentation of the
  // volume; empty if nothing does.
  std::string find(vtkImageData* image, const Grid& volume, Segmentation& segmentation);

private:
  vtkSmartPointer<vtkDataArray> Source; // the last image's
  unsigned long long SourceTime = 0;
  vtkSmartPointer<vtkDataArray> Labels; // the same numbers under the name they are attached by
};
}

#endif
