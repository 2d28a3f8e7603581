// SPDX-License-Identifier: BSD-3-Clause
// The order in which points are drawn.
#ifndef BrainShift_TraceOrder_h
#define BrainShift_TraceOrder_h

#include "Representations/Traces/TraceDrawer.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <vector>

namespace brainshift
{
// Neighbours in space follow each other, along a Z-curve. A driver in software sorts balls into
// tiles of the picture and comes back to them from the memory they were set up in: in order that
// takes a third less time. Points of the same cell of the curve, a 32nd of their box, keep theirs.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<TraceVertex> sortedBySpace(
  const std::vector<TraceVertex>& vertices);
}

#endif
