// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The field array that names the direction of a displacement field.
 *
 * The array DisplacementDirection holds one string: "forward" (where tissue goes; ITK calls it the
 * modelling direction) or "backward" (which tissue is seen; ITK: the resampling direction).
 */
#ifndef BrainShift_FieldDirection_h
#define BrainShift_FieldDirection_h

#include "Filters/Attached/DirectedMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <optional>

class vtkDataObject;

namespace brainshift
{
/** Attaches the array. */
VTKBRAINSHIFTFILTERS_EXPORT void nameDirection(vtkDataObject* field, Direction direction);

/** The direction that the array names; none if there is no such array. */
VTKBRAINSHIFTFILTERS_EXPORT std::optional<Direction> directionOf(vtkDataObject* field);
}

#endif
