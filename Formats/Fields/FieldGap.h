// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points of a displacement field that have no finite number.
#ifndef BrainShift_FieldGap_h
#define BrainShift_FieldGap_h

#include "Common/Grid.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>
#include <vector>

namespace brainshift
{
/**
 * The points of a field without a finite number, for a sentence: "no finite number at 12 of 729
 * points, from 0 0 0 to 24 64 64 mm". Empty if all have one.
 */
VTKBRAINSHIFTFORMATS_EXPORT std::string gapIn(
  const Grid& grid, const std::vector<glm::vec3>& displacements);

/** Makes displacements without a finite number 0. */
VTKBRAINSHIFTFORMATS_EXPORT void closeGap(std::vector<glm::vec3>& displacements);
}

#endif
