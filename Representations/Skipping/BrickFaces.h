// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What bounds the occupied bricks, as few rectangles: a software driver takes more time for more
/// of them.
#ifndef BrainShift_BrickFaces_h
#define BrainShift_BrickFaces_h

#include "Filters/Deformation/FieldChange.h"
#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <cstdint>
#include <utility>

namespace brainshift
{
/// Faces side by side in a plane across an axis.
struct BrickRectangle
{
  int axis = 0;         ///< The plane is perpendicular to it.
  glm::ivec3 low{ 0 };  ///< Corner, bricks.
  glm::ivec3 high{ 0 }; ///< Opposite corner, bricks; along the axis equal to `low`.
};

/// All rectangles that face in one direction.
struct BrickFaces
{
  int axis = 0;
  int outward = 1;                        ///< 1: they face greater coordinates; -1: smaller.
  std::vector<BrickRectangle> rectangles; ///< By plane, in ascending order.
};

/// Every face between an occupied brick and an empty one, or the outside, in exactly one rectangle.
/// `occupied`: count.x * y * z numbers, x fastest, 0 for empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::array<BrickFaces, 6> brickFaces(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);

/// The box of the occupied bricks in each layer across z that has any, in ascending order. Together
/// they bound what can be seen more closely than one box. `faces`: the result of brickFaces.
/// `layers`: bricks along z.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<IndexBox> occupiedLayers(
  const std::array<BrickFaces, 6>& faces, int layers);

/// The rectangles that face an eye: the first, and one past the last. `eye`: bricks,
/// homogeneous; w = 0: the direction towards an eye infinitely far away.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::pair<int, int> facing(
  const BrickFaces& faces, const glm::dvec4& eye);
}

#endif
