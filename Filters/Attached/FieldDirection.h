// SPDX-License-Identifier: BSD-3-Clause
// How a displacement field tells which way it leads: the field array DisplacementDirection, one
// string, "forward" (where tissue goes; ITK: modelling) or "backward" (which tissue is seen; ITK:
// resampling).
#ifndef BrainShift_FieldDirection_h
#define BrainShift_FieldDirection_h

#include "Filters/Attached/DirectedMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <optional>

class vtkDataObject;

namespace brainshift
{
VTKBRAINSHIFTFILTERS_EXPORT void nameDirection(vtkDataObject* field, Direction direction);

// None if the data does not say.
VTKBRAINSHIFTFILTERS_EXPORT std::optional<Direction> directionOf(vtkDataObject* field);
}

#endif
