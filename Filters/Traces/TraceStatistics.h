// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Mean, root mean square and 95th percentile of distances.
 */
#ifndef BrainShift_TraceStatistics_h
#define BrainShift_TraceStatistics_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <cstddef>
#include <limits>
#include <vector>

namespace brainshift
{
/** Figures in mm. They are NaN if no distance counts. */
struct TraceStatistics
{
  std::size_t count = 0; ///< distances that are finite

  /** Of the signed distances: positive if points lie outside on average. */
  double mean = std::numeric_limits<double>::quiet_NaN();
  double rms = std::numeric_limits<double>::quiet_NaN(); ///< root mean square

  /** Of the absolute distances, interpolated between the two nearest ranks. */
  double percentile95 = std::numeric_limits<double>::quiet_NaN();
};

/** Figures of signed distances (mm). Distances that are not finite do not count. */
VTKBRAINSHIFTFILTERS_EXPORT TraceStatistics statisticsOf(const std::vector<double>& distances);
}

#endif
