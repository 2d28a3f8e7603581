// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the part of the refined fields that a change of control points can reach. The rest of the
/// fields is kept.
///
/// Lists of control points hold one displacement (lattice cells) for each point of the lattice, x
/// fastest. `dimensions`: points of the lattice along each axis.
#ifndef BrainShift_FieldChange_h
#define BrainShift_FieldChange_h

#include "Filters/Deformation/OffsetField.h"

namespace brainshift
{
/** A box of indices. It is empty if `last` is below `first` along an axis, which is the default. */
struct IndexBox
{
  glm::ivec3 first{ 0 };
  glm::ivec3 last{ -1 }; ///< inclusive

  bool empty() const
  {
    return this->last.x < this->first.x || this->last.y < this->first.y ||
      this->last.z < this->first.z;
  }
  glm::ivec3 size() const { return glm::max(this->last - this->first + 1, glm::ivec3(0)); }
  bool operator==(const IndexBox& other) const
  {
    return this->first == other.first && this->last == other.last;
  }
};

/** The smallest box that holds both. */
BRAINSHIFT_DEFORMATION_EXPORT IndexBox enclosing(const IndexBox& a, const IndexBox& b);

/** The smallest box around the control points whose displacement differs. */
BRAINSHIFT_DEFORMATION_EXPORT IndexBox changedPoints(const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after);

/** Nodes of the refined displacement that depend on the control points in a box. */
BRAINSHIFT_DEFORMATION_EXPORT IndexBox changedForwardNodes(
  const IndexBox& points, const FieldNodes& forward);

/**
 * Nodes of the offset field that can differ: the deformed positions that tissue around the changed
 * control points has before or after the change, and one cell more for the solver's steps.
 */
BRAINSHIFT_DEFORMATION_EXPORT IndexBox changedBackwardNodes(const IndexBox& points,
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& before,
  const std::vector<glm::vec3>& after, const FieldNodes& backward);

/**
 * Positions (lattice coordinates) whose convex hull holds every place up to `margin` (cells) away
 * from an offset that can differ. They are corners of boxes around rows of control points. The list
 * is empty if nothing changes. Where the lattice's border moves they lie far beyond the lattice.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> cornersOfChange(const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after, float margin);

/** Directions of a SlabHull: 3 axes, 6 diagonals of faces, 4 diagonals of the cube. */
constexpr int SlabDirections = 13;

/**
 * A convex hull as the intersection of slabs: the least and the greatest dot(direction, position)
 * along each direction. Method: Kay and Kajiya, "Ray tracing complex scenes", SIGGRAPH 1986.
 */
struct BRAINSHIFT_DEFORMATION_EXPORT SlabHull
{
  /** x: least, y: greatest; the hull is empty if the least is above the greatest. */
  std::array<glm::vec2, SlabDirections> spans;

  /** An empty hull. */
  SlabHull();
  bool empty() const { return this->spans[0].x > this->spans[0].y; }
};

/** One of the directions, in lattice cells; its length is not 1. `index`: 0 to 12. */
BRAINSHIFT_DEFORMATION_EXPORT glm::vec3 slabDirection(int index);

/**
 * Where displacement can differ from zero, in lattice coordinates. It is far beyond the lattice
 * where the lattice's border moves. The hull is valid in the rest frame and in the deformed frame,
 * because tissue on its surface stays, and so does the tissue outside.
 */
BRAINSHIFT_DEFORMATION_EXPORT SlabHull movedHull(
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& inCells);
}

#endif
