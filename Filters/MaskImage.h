// SPDX-License-Identifier: BSD-3-Clause
// Reads a mask from an image: labels or scalars, on points or in cells, on any grid.
#ifndef BrainShift_MaskImage_h
#define BrainShift_MaskImage_h

#include "MaskWeights.h"

#include <string>
#include <vector>

class vtkImageData;

namespace brainshift
{
// Inside is what has one of the labels; with none given, what is above 0. The array is the active
// scalars of the points, or the first of the points, or else of the cells, that has one component.
// Returns what keeps it from being a mask for a volume; empty if nothing does.
VTKBRAINSHIFTFILTERS_EXPORT std::string readMask(
  vtkImageData* image, const std::vector<int>& labels, const Grid& volume, Mask& mask);
}

#endif
