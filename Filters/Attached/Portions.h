// SPDX-License-Identifier: BSD-3-Clause
// Long loops of filters: on all cores, with progress told and aborts heard in between.
#ifndef BrainShift_Portions_h
#define BrainShift_Portions_h

#include "Filters/Deformation/Parallel.h"

#include "vtkAlgorithm.h"

#include <algorithm>

namespace brainshift
{
// Calls body(begin, end) for pieces of 0 to `count`, in parallel, a portion of the loop after the
// other. Tells progress between the two shares given. False if the user aborts: the rest is left.
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
