// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The lowest value of a function along a line.
 */
#ifndef BrainShift_LineSearch_h
#define BrainShift_LineSearch_h

#include "Filters/Deformation/Export.h"

#include <functional>

namespace brainshift
{
/** A place on a line, and the value there. */
struct LinePoint
{
  double at = 0.0;
  double value = 0.0;
};

/**
 * Goes downhill from 0 with growing steps, then narrows the valley that it found by parabolas and
 * golden sections (Brent, Algorithms for Minimization without Derivatives, 1973, chapter 5). The
 * answer is never above the value at 0.
 *
 * @param valueAtZero   the function at 0
 * @param stride        the first step, either way; above 0
 * @param tolerance     how near to the lowest place the answer comes
 */
BRAINSHIFT_DEFORMATION_EXPORT LinePoint lowestAlong(const std::function<double(double)>& function,
  double valueAtZero, double stride, double tolerance);
}

#endif
