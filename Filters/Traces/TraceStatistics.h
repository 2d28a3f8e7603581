// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Mean, root mean square, 95th percentile and histogram of distances.
#ifndef BrainShift_TraceStatistics_h
#define BrainShift_TraceStatistics_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <array>
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

  /**
   * Of the absolute distances, interpolated between the two nearest ranks: definition 7 of Hyndman
   * and Fan, "Sample quantiles in statistical packages", The American Statistician 50 (1996).
   */
  double percentile95 = std::numeric_limits<double>::quiet_NaN();
};

/** Figures of signed distances (mm). Distances that are not finite do not count. */
VTKBRAINSHIFTFILTERS_EXPORT TraceStatistics statisticsOf(const std::vector<double>& distances);

/** Counts of distances in bins that are equally wide and symmetric about 0. */
struct TraceHistogram
{
  static constexpr int Bins = 32;
  static constexpr double LeastWidth = 1.0 / 16.0; ///< mm: then the bins go from -1 to 1 mm

  /**
   * mm. A power of two, so that the bins of two histograms fit into each other. It is the smallest
   * one with which the bins hold all distances. 0 if no distance counts.
   */
  double width = 0.0;

  /** From -width * Bins / 2 on. A distance on an edge counts above it. */
  std::array<int, Bins> counts{};
};

/** Histogram of signed distances (mm). Distances that are not finite do not count. */
VTKBRAINSHIFTFILTERS_EXPORT TraceHistogram histogramOf(const std::vector<double>& distances);
}

#endif
