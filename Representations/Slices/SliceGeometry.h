// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Positions of the three planes of Deformed Slices, and the order in which they are drawn.
///
/// The planes are numbered by the world axis that they lie across: sagittal (x), coronal (y), axial
/// (z).
#ifndef BrainShift_SliceGeometry_h
#define BrainShift_SliceGeometry_h

#include "Common/Grid.h"

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <vector>

class vtkRenderer;

namespace brainshift
{
// The colours that name the three planes of Deformed Slices.

/// Red, green and blue of the sagittal, the coronal and the axial plane, 0 to 1: yellowish green,
/// blue, orange. They differ in lightness too, so that the colour-blind can tell them apart.
constexpr std::array<std::array<double, 3>, 3> PlaneColors{ { { 0.88, 1.0, 0.25 },
  { 0.30, 0.58, 1.0 }, { 0.92, 0.36, 0.0 } } };

constexpr std::array<const char*, 3> PlaneNames{ "Sagittal", "Coronal", "Axial" };

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

// Where a line of sight meets the planes of Deformed Slices.

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
