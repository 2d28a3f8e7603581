// SPDX-License-Identifier: BSD-3-Clause
// What a tool shows of itself, as lines. Positions: mm, world axes, deformed frame.
#ifndef BrainShift_LatticeShapes_h
#define BrainShift_LatticeShapes_h

#include "Filters/Deformation/Stroke.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
using Polyline = std::vector<glm::dvec3>;

// A control point as a tool sees it.
struct Handle
{
  glm::ivec3 index{ 0 };   // along the lattice axes
  glm::dvec3 rest{ 0.0 };  // mm
  glm::dvec3 drawn{ 0.0 }; // mm, deformed frame
};

// Edges between handles that are neighbours in the lattice, as pairs of positions in the list.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<std::pair<int, int>> edgesBetween(
  const std::vector<Handle>& handles);

// The surface at a share of the radius of a Soft stroke (a sphere) or a Stamp (an ellipsoid of
// revolution): the circle across the axis and two ellipses along it.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<Polyline> outlineOf(const Stroke& stroke, double share);

// The same surface's section by the plane through the anchor across a unit normal.
VTKBRAINSHIFTWIDGETS_EXPORT Polyline sectionOf(
  const Stroke& stroke, double share, const glm::dvec3& normal);

// Share of the radius at which a stroke of this sigma moves tissue half as far as in its middle.
VTKBRAINSHIFTWIDGETS_EXPORT double shareOfHalfWeight(double sigma);

// Three strokes of a pen along the world's axes, `size` mm each way.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<Polyline> cross(const glm::dvec3& centre, double size);
}

#endif
