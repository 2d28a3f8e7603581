// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The Matern covariance with smoothness 5/2: how alike the displacements of two points are.
 *
 * Fields with this covariance have continuous derivatives, so tissue that follows them has no
 * creases.
 */
#ifndef BrainShift_Matern_h
#define BrainShift_Matern_h

#include <cmath>

namespace brainshift
{
/** Covariance (mm^2) of one component of the displacement at two points. */
struct Matern
{
  double lengthMm = 60.0;   ///< mm over which neighbours follow; above 0
  double deviationMm = 8.0; ///< standard deviation (mm) of a displacement before any measurement

  /** Factor that makes a distance (mm) a number without unit. */
  double scale() const { return std::sqrt(5.0) / this->lengthMm; }

  /** Variance (mm^2) before any measurement. */
  double variance() const { return this->deviationMm * this->deviationMm; }

  /** Covariance (mm^2) at a distance (mm). */
  double at(double distanceMm) const
  {
    const double a = this->scale() * distanceMm;
    return this->variance() * (1.0 + a + a * a / 3.0) * std::exp(-a);
  }
};
}

#endif
