// SPDX-License-Identifier: BSD-3-Clause
// What many distances amount to.
#ifndef BrainShift_TraceStatistics_h
#define BrainShift_TraceStatistics_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <cstddef>
#include <limits>
#include <vector>

namespace brainshift
{
struct TraceStatistics
{
  std::size_t count = 0; // of the distances that are numbers
  // mm; not a number if there is none.
  double mean = std::numeric_limits<double>::quiet_NaN(); // signed: what is too far out stays +
  double rms = std::numeric_limits<double>::quiet_NaN();
  double percentile95 = std::numeric_limits<double>::quiet_NaN(); // of the absolute distances
};

// `distances`: signed, mm; those that are not finite are left out. The percentile is interpolated
// between the two ranks it falls between.
VTKBRAINSHIFTFILTERS_EXPORT TraceStatistics statisticsOf(const std::vector<double>& distances);
}

#endif
