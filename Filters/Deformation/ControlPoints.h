// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the control points near a position in the view, for tools that move them.
///
/// All positions and lengths are mm along world axes.
#ifndef BrainShift_ControlPoints_h
#define BrainShift_ControlPoints_h

#include "Common/Export.h"
#include "Common/Grid.h"

#include <cmath>
#include <set>

namespace brainshift
{
/** Most control points that one question returns: a view cannot show more of them apart. */
constexpr std::size_t MostControlPoints = 1000;

/** A lattice as it is drawn, read in place and not copied. */
struct BRAINSHIFT_DEFORMATION_EXPORT DrawnLattice
{
  Grid grid;                            ///< control points at rest
  const float* displacements = nullptr; ///< mm, 3 for each point, before strength; not owned
  double strength = 1.0;                ///< factor on all displacements, 0 to 1
  double farthest = 0.0; ///< mm; no displacement is longer, before strength; see longest()

  /** Where a control point lies at rest. */
  glm::dvec3 rest(const glm::ivec3& index) const;

  /** How far it is drawn from there; strength is applied. */
  glm::dvec3 displacement(const glm::ivec3& index) const;

  /** Where it is drawn. */
  glm::dvec3 deformed(const glm::ivec3& index) const;
};

/** The longest displacement (mm) before strength. Reads every control point. */
BRAINSHIFT_DEFORMATION_EXPORT double longest(const DrawnLattice& lattice);

/** The space within a distance of a plane. */
struct Slab
{
  glm::dvec3 point{ 0.0 };    ///< any point of the plane
  glm::dvec3 normal{ 0.0 };   ///< of the plane; unit length
  double halfThickness = 0.0; ///< largest distance from the plane; 0: all of space

  bool contains(const glm::dvec3& position) const
  {
    return this->halfThickness == 0.0 ||
      std::abs(glm::dot(position - this->point, this->normal)) <= this->halfThickness;
  }
};

/** Control points, each by its offset in the lattice (Grid::offset). */
using ControlPointSet = std::set<std::size_t>;

/**
 * Adds the control points that are drawn within a ball and a slab. If there are more than
 * MostControlPoints, it adds those nearest to the centre.
 */
BRAINSHIFT_DEFORMATION_EXPORT void addInBall(const DrawnLattice& lattice, const glm::dvec3& centre,
  double radius, const Slab& slab, ControlPointSet& points);

/** A cone, cut off at its apex. */
struct Cone
{
  glm::dvec3 apex{ 0.0 };
  glm::dvec3 direction{ 0.0 }; ///< of the axis, away from the apex; unit length
  double radius = 0.0;         ///< at the apex
  double growth = 0.0;         ///< of the radius for each mm along the axis
};

/**
 * Adds the control points that are drawn within a cone. If there are more than MostControlPoints,
 * it adds those nearest to the cone's axis.
 */
BRAINSHIFT_DEFORMATION_EXPORT void addInCone(
  const DrawnLattice& lattice, const Cone& cone, ControlPointSet& points);

/**
 * Adds the control points that are drawn within a ball and a slab and that have moved by at least a
 * hundredth of the smallest spacing. If there are more than MostControlPoints, it adds those
 * nearest to the centre.
 */
BRAINSHIFT_DEFORMATION_EXPORT void addMoved(const DrawnLattice& lattice, const glm::dvec3& centre,
  double radius, const Slab& slab, ControlPointSet& points);

/** The index along each axis of the control point with that offset. */
BRAINSHIFT_DEFORMATION_EXPORT glm::ivec3 indexOf(const Grid& grid, std::size_t offset);
}

#endif
