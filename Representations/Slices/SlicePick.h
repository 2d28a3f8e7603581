// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where a line of sight meets the planes of Deformed Slices.
 */
#ifndef BrainShift_SlicePick_h
#define BrainShift_SlicePick_h

#include "Representations/Slices/SliceGeometry.h"

#include <vector>

class vtkRenderer;

namespace brainshift
{
/// The planes of a picture.
struct DrawnSlices
{
  SlicePlanes planes;
  glm::dmat4 worldFromTexture{ 1.0 };
};

/// A point of a plane.
struct SliceHit
{
  glm::dvec3 texture{ 0.0 }; ///< Texture coordinates, deformed frame.
  glm::dvec3 world{ 0.0 };   ///< mm.
  glm::dvec3 normal{ 0.0 };  ///< Unit normal of the plane, world.
};

/// Where the line from `from` to `to` (mm, world) meets the planes, nearest first.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceHit> hitsAlong(
  const DrawnSlices& slices, const glm::dvec3& from, const glm::dvec3& to);

/// Where the line of sight through the middle of a pixel meets the planes, nearest first. `x`, `y`:
/// the pixel, counted from the renderer's lower left corner.
std::vector<SliceHit> hitsUnderPixel(
  const DrawnSlices& slices, vtkRenderer* renderer, int x, int y);
}

#endif
