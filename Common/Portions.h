// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Long loops of filters: on all cores, with progress and aborts in between.
#ifndef BrainShift_Portions_h
#define BrainShift_Portions_h

#include "Common/Parallel.h"

#include "vtkAlgorithm.h"

#include <algorithm>

namespace brainshift
{
/** The part of a filter's progress, 0 to 1, that a loop makes. */
struct ProgressOf
{
  vtkAlgorithm* filter;
  double from = 0.0;
  double to = 1.0;
};

/**
 * Calls body(begin, end) for pieces that together are the steps 0 to `count`, one portion of the
 * loop after the other, each of them in parallel.
 *
 * @param grain   steps that are too few for a second thread, see parallelFor
 * @return false if the user aborts; the remaining steps are then not done
 */
template <typename Body>
bool forPortions(const ProgressOf& progress, vtkIdType count, vtkIdType grain, const Body& body)
{
  // Smaller portions would leave cores idle, larger ones keep a user waiting who wants to stop.
  const vtkIdType portion = std::max<vtkIdType>(count / 50 + 1, 16 * grain);
  for (vtkIdType first = 0; first < count; first += portion)
  {
    if (progress.filter->CheckAbort())
    {
      return false;
    }
    const vtkIdType last = std::min(first + portion, count);
    parallelFor(first, last, grain, body);
    progress.filter->UpdateProgress(progress.from + (progress.to - progress.from) * last / count);
  }
  return true;
}
}

#endif
