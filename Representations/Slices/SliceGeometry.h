// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where the three planes of Deformed Slices lie, and in which order they are drawn.
 *
 * The planes are numbered by the world axis that they lie across: sagittal (x), coronal (y), axial
 * (z).
 */
#ifndef BrainShift_SliceGeometry_h
#define BrainShift_SliceGeometry_h

#include "Common/Grid.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
/// The volume's axis nearest to each world axis. Each axis is taken once.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT glm::ivec3 axesAcrossPlanes(const glm::dmat3& direction);

/// A rectangle, in texture coordinates.
struct SliceQuad
{
  int axis = 0; ///< The rectangle lies across it.
  glm::dvec3 corner{ 0.0 };
  glm::dvec3 right{ 0.0 }; ///< One side that starts at the corner.
  glm::dvec3 up{ 0.0 };    ///< The other side.
};

/// Planes across the texture's axes, cut out of a box.
struct SlicePlanes
{
  glm::bvec3 shown{ true };   ///< Whether the user wants the plane across each axis of the texture.
  glm::dvec3 position{ 0.5 }; ///< All planes go through it, texture coordinates.
  glm::dvec3 low{ 0.0 };      ///< The box, texture coordinates.
  glm::dvec3 high{ 1.0 };
};

/// Whole planes, in any order. A plane that lies outside the box is left out.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceQuad> wholeQuads(const SlicePlanes& planes);

/// The planes, cut where they cross, from back to front, for blending.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<SliceQuad> quadsBackToFront(
  const SlicePlanes& planes, const glm::dmat4& clipFromTexture);
}

#endif
