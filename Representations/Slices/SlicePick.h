// SPDX-License-Identifier: BSD-3-Clause
// Where a line of sight meets the planes of Deformed Slices.
#ifndef BrainShift_SlicePick_h
#define BrainShift_SlicePick_h

#include "Representations/Slices/SliceGeometry.h"

#include <vector>

class vtkRenderer;

namespace brainshift
{
// The planes of a picture.
struct DrawnSlices
{
  SlicePlanes planes;
  glm::dmat4 worldFromTexture{ 1.0 };
};

struct SliceHit
{
  glm::dvec3 texture{ 0.0 }; // texture coordinates, deformed frame
  glm::dvec3 world{ 0.0 };   // mm
  glm::dvec3 normal{ 0.0 };  // of the plane: unit, world
};

// From `from` towards `to` (mm, world), nearest first.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceHit> hitsAlong(
  const DrawnSlices& slices, const glm::dvec3& from, const glm::dvec3& to);

// Along the line of sight through a pixel's middle, counted from the renderer's lower left corner.
std::vector<SliceHit> hitsUnderPixel(
  const DrawnSlices& slices, vtkRenderer* renderer, int x, int y);
}

#endif
