// SPDX-License-Identifier: BSD-3-Clause
// Which part of the refined fields a change of control points can reach: the rest is kept.
#ifndef BrainShift_FieldChange_h
#define BrainShift_FieldChange_h

#include "Filters/Deformation/OffsetField.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace brainshift
{
// A box of indices, both ends included; empty where last < first.
struct IndexBox
{
  glm::ivec3 first{ 0 };
  glm::ivec3 last{ -1 };

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

// The least box that holds both.
VTKBRAINSHIFTFILTERS_EXPORT IndexBox enclosing(const IndexBox& a, const IndexBox& b);

// Control points whose displacement differs; both lists hold dimensions.x * y * z of them.
VTKBRAINSHIFTFILTERS_EXPORT IndexBox changedPoints(const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after);

// Nodes of the refined displacement that depend on those control points.
VTKBRAINSHIFTFILTERS_EXPORT IndexBox changedForwardNodes(
  const IndexBox& points, const FieldNodes& forward);

// Nodes of the offset field that can differ: all deformed positions that tissue around those
// control points has before or after the change, and one cell around them for the solver's steps.
VTKBRAINSHIFTFILTERS_EXPORT IndexBox changedBackwardNodes(const IndexBox& points,
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& before,
  const std::vector<glm::vec3>& after, const FieldNodes& backward);

// Positions (lattice coordinates) between which all lies that is up to `margin` (cells) away from
// offsets that can differ: corners of boxes around rows of control points. None where nothing
// changes. Beyond the lattice they are far.
VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::vec3> cornersOfChange(const glm::ivec3& dimensions,
  const std::vector<glm::vec3>& before, const std::vector<glm::vec3>& after, float margin);

// A convex hull by slabs: along each direction the least and the greatest of dot(direction,
// position) (Kay and Kajiya, SIGGRAPH 1986).
constexpr int SlabDirections = 13; // axes, diagonals of faces, diagonals of the cube

struct VTKBRAINSHIFTFILTERS_EXPORT SlabHull
{
  std::array<glm::vec2, SlabDirections> spans; // x: least, y: greatest; least > greatest: empty

  SlabHull();
  bool empty() const { return this->spans[0].x > this->spans[0].y; }
};

// Not normalised; lattice cells.
VTKBRAINSHIFTFILTERS_EXPORT glm::vec3 slabDirection(int index);

// Where displacement can differ from zero, in lattice coordinates; the same in the rest and in the
// deformed frame, because tissue on its surface stays and what is seen outside stays too. Far
// beyond the lattice where its border moves.
VTKBRAINSHIFTFILTERS_EXPORT SlabHull movedHull(
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& inCells);
}

#endif
