// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Labels that travel with a deformable volume, so that chosen ones can be drawn alone.
///
/// They lie in the rest frame, on a grid of their own:
///
///     FFDSegmentation        any type x 1, nx*ny*nz tuples, x fastest: labels or scalars
///     FFDSegmentationGrid    see attachGrid in CarriedArray.h
///     FFDSegmentationLabels  int: the labels that are drawn if the user chooses none; absent: all
///                            above 0
///     FFDSegmentationMoving  int: how many labels, and then the labels of the tissue that may
///                            move, 0 labels: all above 0. Only with a mask
///     FFDMask, FFDMaskGrid   as the first two: the labels of the mask. Only where it is another
///                            image
///     FFDSegmentationValues  ... Names, ... Colors: as LabelTable.h says, where the labels have
///                            names
#ifndef BrainShift_Segmentation_h
#define BrainShift_Segmentation_h

#include "Common/LabelTable.h"
#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <optional>

class vtkDataObject;
class vtkImageData;

namespace brainshift
{
/** Name of the field array of the labels. */
constexpr const char* SegmentationName = "FFDSegmentation";

/** Name of the field array of the mask's labels, where they are others. */
constexpr const char* MaskLabelsName = "FFDMask";

/** First word of the arrays that name the labels: see LabelTable.h. */
constexpr const char* SegmentationLabels = SegmentationName;

/** What the arrays hold. */
struct Segmentation
{
  vtkSmartPointer<vtkDataArray> labels; ///< null: none
  Grid grid;                            ///< of the labels
  std::vector<int> chosen;              ///< drawn if the user chooses none; empty: all above 0
  std::optional<std::vector<int>>
    moving;                           ///< those of the mask, if there is one; empty: all above 0
  vtkSmartPointer<vtkDataArray> mask; ///< labels of the mask; null: it has those above
  Grid maskGrid;                      ///< of the mask
  std::vector<Label> names;           ///< of labels that have one; readSegmentation leaves it
};

/**
 * Attaches a segmentation whose labels SegmentationSource made. Without labels it removes a
 * segmentation that was attached before.
 */
VTKBRAINSHIFTFILTERS_EXPORT void attachSegmentation(
  vtkDataObject* volume, const Segmentation& segmentation);

/**
 * Reads what attachSegmentation wrote. Labels that are missing or do not fit their grid are null.
 */
VTKBRAINSHIFTFILTERS_EXPORT Segmentation readSegmentation(vtkDataObject* volume);

/** The voxels that have one of the labels; without labels, those above 0. */
VTKBRAINSHIFTFILTERS_EXPORT Mask segmentOf(
  const Segmentation& segmentation, const std::vector<int>& labels);

/** The voxels of the tissue that may move, as the mask has them; without a mask, none. */
VTKBRAINSHIFTFILTERS_EXPORT Mask movingTissue(const Segmentation& segmentation);

/**
 * Reads a segmentation from an image. It hands out the same array object as long as the numbers
 * stay, so that what draws the segmentation knows it again.
 */
class VTKBRAINSHIFTFILTERS_EXPORT SegmentationSource
{
public:
  /** @param name   of the array that it hands out */
  explicit SegmentationSource(const char* name = SegmentationName)
    : Name(name)
  {
  }

  /**
   * Finds the labels; null without an image. Throws a Problem if the image cannot be a segmentation
   * of the volume.
   */
  Segmentation find(vtkImageData* image, const Grid& volume);

private:
  const char* Name;
  vtkSmartPointer<vtkDataArray> Source; // the last image's
  unsigned long long SourceTime = 0;
  vtkSmartPointer<vtkDataArray> Labels; // the same numbers under the name they are attached by
};
}

#endif
