// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/DirectedField.h"

namespace brainshift
{
void reverseXY(DirectedField& field)
{
  const glm::dvec3 signs(-1.0, -1.0, 1.0);
  field.grid.origin *= signs;
  for (int axis = 0; axis < 3; ++axis)
  {
    field.grid.direction[axis] *= signs;
  }
  for (glm::vec3& displacement : field.displacements)
  {
    displacement *= glm::vec3(signs);
  }
}
}
