// SPDX-License-Identifier: BSD-3-Clause
// What bounds the occupied bricks, as few rectangles: a software driver's time goes by their
// number.
#ifndef BrainShift_BrickFaces_h
#define BrainShift_BrickFaces_h

#include "Filters/Deformation/FieldChange.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <utility>
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

// Those that look the same way.
struct BrickFaces
{
  int axis = 0;
  int outward = 1;                        // 1: towards greater coordinates, the brick below; or -1
  std::vector<BrickRectangle> rectangles; // planes in ascending order
};

// Every face between an occupied brick and an empty one, or none, in exactly one rectangle.
// `occupied`: count.x * y * z numbers, x fastest, 0 for empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::array<BrickFaces, 6> brickFaces(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);

// The box of the occupied bricks in each layer across z that has any, in ascending order: together
// they bound what can be seen closer than one box does. `faces`: those of brickFaces.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<IndexBox> occupiedLayers(
  const std::array<BrickFaces, 6>& faces, int layers);

// Which of the rectangles are seen from in front: the first, and one past the last. `eye`: bricks,
// homogeneous; where w is 0, the direction towards an eye infinitely far away.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::pair<int, int> facing(
  const BrickFaces& faces, const glm::dvec4& eye);
}

#endif
