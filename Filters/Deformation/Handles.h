// SPDX-License-Identifier: BSD-3-Clause
// Finds the control points that a hand could reach for. Positions: mm, world axes.
#ifndef BrainShift_Handles_h
#define BrainShift_Handles_h

#include "Filters/Deformation/Lattice.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <set>

namespace brainshift
{
constexpr std::size_t MostHandles = 1000; // for one question: more cannot be told apart in a view

// The lattice as drawn, without a copy of it.
struct VTKBRAINSHIFTFILTERS_EXPORT DrawnLattice
{
  Grid grid;
  const float* displacements = nullptr; // 3 for each point, mm, before strength
  double strength = 1.0;
  double farthest = 0.0; // mm: no displacement is longer, before strength; see longest()

  glm::dvec3 rest(const glm::ivec3& index) const;
  glm::dvec3 displacement(const glm::ivec3& index) const; // as drawn
  glm::dvec3 deformed(const glm::ivec3& index) const;
};

// The longest displacement, mm, before strength: asks every control point.
VTKBRAINSHIFTFILTERS_EXPORT double longest(const DrawnLattice& lattice);

// What lies near a plane.
struct Slab
{
  glm::dvec3 point{ 0.0 };    // of the plane
  glm::dvec3 normal{ 0.0 };   // unit
  double halfThickness = 0.0; // mm; 0: no slab, everything counts

  bool contains(const glm::dvec3& position) const
  {
    return this->halfThickness == 0.0 ||
      std::abs(glm::dot(position - this->point, this->normal)) <= this->halfThickness;
  }
};

// Offsets of control points (Grid::offset).
using HandleSet = std::set<std::size_t>;

// Adds the control points that are drawn within a ball and a slab, the nearest if there are too
// many.
VTKBRAINSHIFTFILTERS_EXPORT void addInBall(const DrawnLattice& lattice, const glm::dvec3& centre,
  double radius, const Slab& slab, HandleSet& handles);

// Adds those drawn within a cone from an apex along a unit direction, whose radius grows from
// `radius` by `growth` a mm; the nearest to its axis if there are too many.
VTKBRAINSHIFTFILTERS_EXPORT void addInCone(const DrawnLattice& lattice, const glm::dvec3& apex,
  const glm::dvec3& direction, double radius, double growth, HandleSet& handles);

// Adds, of those drawn within a ball and a slab, the ones that moved by a hundredth of the spacing
// or more; the nearest if there are too many.
VTKBRAINSHIFTFILTERS_EXPORT void addMoved(const DrawnLattice& lattice, const glm::dvec3& centre,
  double radius, const Slab& slab, HandleSet& handles);

VTKBRAINSHIFTFILTERS_EXPORT glm::ivec3 indexOf(const Grid& grid, std::size_t offset);
}

#endif
