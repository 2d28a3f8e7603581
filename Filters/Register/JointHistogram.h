// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Mutual information of two volumes from their joint histogram.
 *
 * The bins are filled with a linear Parzen window, as Thévenaz and Unser do with a B-spline (IEEE
 * Transactions on Image Processing 9, 2000).
 */
#ifndef BrainShift_JointHistogram_h
#define BrainShift_JointHistogram_h

#include "Filters/Deformation/Export.h"

#include <vector>

namespace brainshift
{
/** Pairs of numbers, counted in bins. A pair counts for the four bins nearest to it. */
class BRAINSHIFT_DEFORMATION_EXPORT JointHistogram
{
public:
  static constexpr int Bins = 32; ///< along each side

  JointHistogram();

  /** Counts a pair. Both numbers: 0 to 1. */
  void add(float a, float b);

  /** Adds what another one counted. */
  void add(const JointHistogram& other);

  /** How many pairs were counted. */
  double count() const { return this->Count; }

  /** Mutual information (nats, 0 or more); 0 without pairs. */
  double information() const;

private:
  std::vector<double> Cells;
  double Count = 0.0;
};
}

#endif
