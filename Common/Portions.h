// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Long loops of filters: on all cores, with progress and aborts in between.
 */
#ifndef BrainShift_Portions_h
#define BrainShift_Portions_h

#include "Common/Parallel.h"

#include "vtkAlgorithm.h"

#include <algorithm>

namespace brainshift
{
/**
 * Calls body(begin, end) for pieces that together are the steps 0 to `count`, one portion of the
 * loop after the other, each of them in parallel.
 *
 * @param progressFrom, progressTo   progress of the filter (0 to 1) at the loop's begin and end
 * @param grain                      steps that are too few for a second thread, see parallelFor
 * @return false if the user aborts; the remaining steps are then not done
 */
template <typename Body>
bool forPortions(vtkAlgorithm* filter, double progressFrom, double progressTo, vtkIdType count,
  vtkIdType grain, const Body& body)
{
  // Smaller portions would leave cores idle, larger ones keep a user waiting who wants to stop.
  const vtkIdType portion = std::max<vtkIdType>(count / 50 + 1, 16 * grain);
  for (vtkIdType first = 0; first < count; first += portion)
  {
    if (filter->CheckAbort())
    {
      return false;
    }
    const vtkIdType last = std::min(first + portion, count);
    parallelFor(first, last, grain, body);
    filter->UpdateProgress(progressFrom + (progressTo - progressFrom) * last / count);
  }
  return true;
}
}

#endif
