// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A displacement field as it is read from a file or written to one.
 */
#ifndef BrainShift_DirectedField_h
#define BrainShift_DirectedField_h

#include "Common/FieldDirection.h"
#include "Common/Grid.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace brainshift
{
/** Displacements on a grid, and the direction they lead in. World is RAS, mm. */
struct DirectedField
{
  Grid grid;                            ///< mm, RAS
  std::vector<glm::vec3> displacements; ///< mm, RAS axes; one for each point, x fastest
  std::optional<Direction> direction;   ///< none if the file does not name it
};

/** Reverses x and y of a field: this leads from RAS to LPS and back. */
VTKBRAINSHIFTFORMATS_EXPORT void reverseXY(DirectedField& field);
}

#endif
