// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The outlines of tools as lines. Positions: mm, world axes, deformed frame.
#ifndef BrainShift_LatticeShapes_h
#define BrainShift_LatticeShapes_h

#include "Filters/Deformation/Stroke.h"
#include "vtkBrainShiftWidgetsModule.h" // for the export macro

namespace brainshift
{
/// Points joined by lines, in this order.
using Polyline = std::vector<glm::dvec3>;

/// A control point as a tool sees it.
struct ControlPoint
{
  glm::ivec3 index{ 0 };   ///< Along the lattice axes.
  glm::dvec3 rest{ 0.0 };  ///< mm, rest frame.
  glm::dvec3 drawn{ 0.0 }; ///< mm, deformed frame.
};

/// Edges between control points that are neighbours in the lattice, as pairs of indices into the
/// list.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<std::pair<int, int>> edgesBetween(
  const std::vector<ControlPoint>& points);

/// The surface at a fraction of the radius: a sphere for a Soft stroke, an ellipsoid of revolution
/// for a Stamp. The lines are the circle across the axis and two ellipses along it.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<Polyline> outlineOf(const Stroke& stroke, double fraction);

/// The section of that surface by the plane through the anchor with this unit normal.
VTKBRAINSHIFTWIDGETS_EXPORT Polyline sectionOf(
  const Stroke& stroke, double fraction, const glm::dvec3& normal);

/// Fraction of the radius at which a stroke of this sigma moves tissue half as far as at its
/// centre.
VTKBRAINSHIFTWIDGETS_EXPORT double radiusOfHalfWeight(double sigma);

/// Three lines along the world axes through a centre, `size` mm each way.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<Polyline> cross(const glm::dvec3& centre, double size);

/// An arrow whose head faces a view along the unit vector `ahead`. Its head is `size` mm long, and
/// at most half as long as the arrow. No lines if both ends are one point.
VTKBRAINSHIFTWIDGETS_EXPORT std::vector<Polyline> arrow(
  const glm::dvec3& from, const glm::dvec3& to, double size, const glm::dvec3& ahead);

/// A circle around a centre that faces a view along the unit vector `ahead`.
VTKBRAINSHIFTWIDGETS_EXPORT Polyline ring(
  const glm::dvec3& centre, double radius, const glm::dvec3& ahead);
}

#endif
