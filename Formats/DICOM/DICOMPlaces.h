// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Images by the place and the time at which they were taken.
 */
#ifndef BrainShift_DICOMPlaces_h
#define BrainShift_DICOMPlaces_h

#include "Formats/DICOM/DICOMFile.h"

#include <cstddef>
#include <vector>

namespace brainshift
{
/** Images of one orientation. */
struct DICOMPlaces
{
  std::vector<std::vector<DICOMFrame>> volumes; ///< of each time; images from below to above
  std::vector<double> times;                    ///< s; at least one
  std::size_t copies = 0;                       ///< images left out: the same image in another file
  std::size_t leftOver = 0; ///< images left out: their place has more than others
};

/** Distances of the places along the normal of the images, mm, from below to above. */
std::vector<double> placesOf(const std::vector<DICOMFrame>& images);

/**
 * Sorts images by place and time. Times come from the heart's trigger or from the acquisition; if
 * they do not grow, volumes count 0, 1, 2, ...
 */
DICOMPlaces sortedByPlace(
  const std::vector<DICOMFile>& files, const std::vector<DICOMFrame>& images);
}

#endif
