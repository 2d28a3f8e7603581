// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The two directions of a map, and the field array that names that of a displacement field.
///
/// The array DisplacementDirection holds one string: "forward" (where tissue goes; ITK calls it the
/// modelling direction) or "backward" (which tissue is seen; ITK: the resampling direction).
#ifndef BrainShift_FieldDirection_h
#define BrainShift_FieldDirection_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <optional>

class vtkDataObject;

namespace brainshift
{
/** Which way a map leads. */
enum class Direction
{
  Forward = 0,  ///< deformedFromRest: where tissue goes
  Backward = 1, ///< restFromDeformed: which tissue is seen
};

/** Attaches the array. */
VTKBRAINSHIFTCOMMON_EXPORT void nameDirection(vtkDataObject* field, Direction direction);

/** Removes the array, if there is one. */
VTKBRAINSHIFTCOMMON_EXPORT void forgetDirection(vtkDataObject* field);

/** The direction that the array names; none if there is no such array. */
VTKBRAINSHIFTCOMMON_EXPORT std::optional<Direction> directionOf(vtkDataObject* field);
}

#endif
