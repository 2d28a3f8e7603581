// SPDX-License-Identifier: BSD-3-Clause
// Reads a mask from an image: labels or scalars, on points or in cells, on any grid.
#ifndef BrainShift_MaskImage_h
#define BrainShift_MaskImage_h

#include "Filters/Deformation/MaskWeights.h"

#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace brainshift
{
// What messages call a mask, what it is for, and its labels.
struct MaskNames
{
  std::string mask = "mask";
  std::string volume = "volume";
  std::string labels = "MaskLabels";
};

// The numbers of an image that are read as labels: the active scalars of the points, or the first
// array of the points, or else of the cells, that has one component.
struct LabelImage
{
  vtkDataArray* labels = nullptr; // null: the image has none
  Grid grid;                      // of the labels: that of the points, or of the cells' middles
};
LabelImage labelsOf(vtkImageData* image);

// What keeps labels from being those of a volume; empty if nothing does.
std::string problemOf(const LabelImage& image, const Grid& volume, const MaskNames& names = {});

// 1 for what has one of the labels, else 0; with none given, 1 for what is above 0.
std::vector<char> insideOf(vtkDataArray* array, const std::vector<int>& labels);

// Returns what keeps an image from being a mask for a volume; empty if nothing does.
VTKBRAINSHIFTFILTERS_EXPORT std::string readMask(vtkImageData* image,
  const std::vector<int>& labels, const Grid& volume, Mask& mask, const MaskNames& names = {});

// All that a mask's weights depend on.
struct MaskRequest
{
  vtkImageData* image = nullptr; // null or empty: no mask
  std::vector<int> labels;
  double featherMm = 0.0;
  Grid volume;
  Grid lattice;
  int samples = 0;
};

// Keeps the weights of the last request: they are found anew only if anything of it changed.
class VTKBRAINSHIFTFILTERS_EXPORT MaskSource
{
public:
  // Null weights without a mask. Returns what is wrong with it; empty if nothing is.
  std::string find(const MaskRequest& request, std::shared_ptr<const NodeWeights>& weights);

private:
  bool isKnown(const MaskRequest& request) const;

  MaskRequest Known;
  unsigned long long KnownTime = 0;           // of its image
  std::shared_ptr<const NodeWeights> Weights; // null: the last mask was none
};
}

#endif
