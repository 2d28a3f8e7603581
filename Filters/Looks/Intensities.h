// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the values of a volume are like, read once. From it looks are made.
#ifndef BrainShift_Intensities_h
#define BrainShift_Intensities_h

#include "Filters/Looks/Histogram.h"

#include <glm/glm.hpp>

#include <string>

class vtkImageData;

namespace brainshift
{
/** Of a larger volume, about this many voxels are read, at even distances. */
constexpr double MostVoxelsRead = 4e6;

/** The values of one array. */
struct Intensities
{
  double lowest = 0.0;    ///< smallest finite value
  double highest = 0.0;   ///< largest finite value
  Histogram all;          ///< of all voxels but the rarest values at both ends
  Histogram segment;      ///< of those within the attached segmentation; no bins without one
  bool areLabels = false; ///< few different values, all of them whole numbers

  bool empty() const { return this->all.counts.empty(); }
};

/** Which array of a volume. */
struct ArrayChoice
{
  int association = 0; ///< vtkDataObject::POINT or CELL
  std::string name;
};

/**
 * Reads a volume, or the parts of it that the processes of a server hold: all of them must call it,
 * and all get the same answer. Not finite values do not count.
 *
 * @param volume   this process's part; null if it has none
 * @return empty if there is no such array with one component, or if it has no two different values
 */
VTKBRAINSHIFTFILTERS_EXPORT Intensities readIntensities(
  vtkImageData* volume, const ArrayChoice& array);

/**
 * Counts all values of an array in bins between the smallest and the largest one. Else like
 * readIntensities. It has no bins if the array has no two different values.
 */
VTKBRAINSHIFTFILTERS_EXPORT Histogram readHistogram(
  vtkImageData* volume, const ArrayChoice& array, int bins);

/**
 * The farthest of the voxels above a value, mm, world. Rows of voxels with hardly any of them, and
 * lone voxels, are noise and do not count. All processes must call it and get the same.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::dvec3> farPointsAbove(
  vtkImageData* volume, const ArrayChoice& array, double value);

/** The farthest voxels of the attached segmentation's chosen labels, in the same way. */
VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::dvec3> farPointsOfSegment(vtkImageData* volume);
}

#endif
