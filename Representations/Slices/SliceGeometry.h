// SPDX-License-Identifier: BSD-3-Clause
// Where the three planes of Deformed Slices lie, and in which order they are drawn.
#ifndef BrainShift_SliceGeometry_h
#define BrainShift_SliceGeometry_h

#include "Filters/Deformation/Grid.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
// The planes are numbered by the world axis they lie across: sagittal (x), coronal (y), axial (z).

// The volume's axis nearest to each world axis, each taken once.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 axesAcrossPlanes(const glm::dmat3& direction);

// A rectangle: the axis it lies across, one corner, and the sides that leave it. Texture
// coordinates.
struct SliceQuad
{
  int axis = 0;
  glm::dvec3 corner{ 0.0 };
  glm::dvec3 right{ 0.0 };
  glm::dvec3 up{ 0.0 };
};

// Planes across the texture's axes, cut out of a box.
struct SlicePlanes
{
  glm::bvec3 shown{ true };   // across each axis of the texture
  glm::dvec3 position{ 0.5 }; // that all planes go through, texture coordinates
  glm::dvec3 low{ 0.0 };      // the box
  glm::dvec3 high{ 1.0 };
};

// Whole planes, in any order. None where a plane lies outside the box.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceQuad> wholeQuads(const SlicePlanes& planes);

// The same, cut where they cross, from back to front, for blending.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceQuad> quadsBackToFront(
  const SlicePlanes& planes, const glm::dmat4& clipFromTexture);
}

#endif
