// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How often each value occurs, and which values part background from tissue.
#ifndef BrainShift_Histogram_h
#define BrainShift_Histogram_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <vector>

namespace brainshift
{
/** Counts of values in bins of one width. A value beyond an end counts in the bin at that end. */
struct Histogram
{
  double low = 0.0;           ///< lower end of the first bin
  double high = 1.0;          ///< upper end of the last bin
  std::vector<double> counts; ///< of each bin

  /** Width of a bin. */
  double width() const { return (this->high - this->low) / this->counts.size(); }

  /** Middle of a bin. */
  double middle(std::size_t bin) const { return this->low + (bin + 0.5) * this->width(); }

  /** Number of values. */
  VTKBRAINSHIFTFILTERS_EXPORT double total() const;

  /** Counts a value. */
  VTKBRAINSHIFTFILTERS_EXPORT void add(double value);
};

/** A histogram without values; `high` must be above `low`. */
VTKBRAINSHIFTFILTERS_EXPORT Histogram makeHistogram(double low, double high, int bins);

/**
 * The value below which this fraction (0 to 1) of all values is, linear within a bin. Without
 * values it is `low`.
 */
VTKBRAINSHIFTFILTERS_EXPORT double percentile(const Histogram& histogram, double fraction);

/**
 * The threshold that parts the values into two classes with the largest variance between them:
 * Otsu, "A threshold selection method from gray-level histograms", IEEE Transactions on Systems,
 * Man, and Cybernetics 9 (1979). Values above the `top`
 * percentile count as that, so that a few bright voxels do not raise it.
 */
VTKBRAINSHIFTFILTERS_EXPORT double otsuThreshold(const Histogram& histogram, double top = 0.995);

/**
 * The counts of all but a dark background: the many values about the commonest one, up to half-way
 * to Otsu's threshold, which alone would take the dark fluid of the brain for background.
 */
VTKBRAINSHIFTFILTERS_EXPORT Histogram withoutBackground(const Histogram& histogram);
}

#endif
