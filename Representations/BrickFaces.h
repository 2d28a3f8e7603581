// SPDX-License-Identifier: BSD-3-Clause
// What bounds the occupied bricks, as few rectangles: a software driver's time goes by their number.
#ifndef BrainShift_BrickFaces_h
#define BrainShift_BrickFaces_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace brainshift
{
// Faces that lie side by side in a plane across an axis: from corner `low` to corner `high`, in
// bricks; the two are equal along that axis.
struct BrickRectangle
{
  int axis = 0; // across it
  glm::ivec3 low{ 0 };
  glm::ivec3 high{ 0 };
};

// Every face between an occupied brick and an empty one, or none, in exactly one rectangle.
// `occupied`: count.x * y * z numbers, x fastest, 0 for empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<BrickRectangle> brickRectangles(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);
}

#endif
