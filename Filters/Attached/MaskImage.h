// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads a mask from an image of labels or scalars, on points or in cells, on any grid.
 *
 * Functions that return a problem return one sentence, without a full stop; empty if there is none.
 */
#ifndef BrainShift_MaskImage_h
#define BrainShift_MaskImage_h

#include "Filters/Deformation/MaskWeights.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace brainshift
{
/** What messages call things. */
struct MaskNames
{
  std::string mask = "mask";         ///< the image
  std::string volume = "volume";     ///< the volume that it is for
  std::string labels = "MaskLabels"; ///< the property that chooses labels
};

/** The numbers of an image that are read as labels, and where they lie. */
struct LabelImage
{
  vtkDataArray* labels = nullptr; ///< null: the image has none; not owned
  Grid grid;                      ///< of the points, or of the middles of the cells
};

/**
 * The labels of an image: the active point scalars if they have one component, else the first point
 * array of one component, else the same of the cells.
 */
LabelImage labelsOf(vtkImageData* image);

/** Why an image cannot be the labels of a volume: it has none, or does not overlap the volume. */
std::string problemOf(const LabelImage& image, const Grid& volume, const MaskNames& names = {});

/** 1 for each number that is one of the labels, else 0. Without labels, 1 for each above 0. */
std::vector<char> insideOf(vtkDataArray* array, const std::vector<int>& labels);

/** Reads a mask. Returns the problem if the image cannot be a mask for the volume. */
VTKBRAINSHIFTFILTERS_EXPORT std::string readMask(vtkImageData* image,
  const std::vector<int>& labels, const Grid& volume, Mask& mask, const MaskNames& names = {});

/** All that the weights of a mask depend on. */
struct MaskRequest
{
  vtkImageData* image = nullptr; ///< null or empty: no mask
  std::vector<int> labels;       ///< labels that are inside; none: all above 0
  double growMm = 0.0;           ///< mm by which the mask grows first; 0 or more
  double featherMm = 0.0;        ///< mm over which weights rise from 0 to 1; 0 or more
  Grid volume;                   ///< which the mask must overlap
  Grid lattice;                  ///< control points
  int samples = 0;               ///< nodes between two control points, 0 to 16
};

/** Finds weights, and keeps those of the last request until something in it changes. */
class VTKBRAINSHIFTFILTERS_EXPORT MaskSource
{
public:
  /**
   * Finds the weights; null without a mask. Returns the problem if the image is no mask, or if the
   * machine has too little memory to grow it.
   */
  std::string find(const MaskRequest& request, std::shared_ptr<const NodeWeights>& weights);

private:
  bool isKnown(const MaskRequest& request) const;

  MaskRequest Known;
  unsigned long long KnownTime = 0;           // of its image
  std::shared_ptr<const NodeWeights> Weights; // null: the last mask was none
};
}

#endif
