// SPDX-License-Identifier: BSD-3-Clause
// Which part of the refined fields a change of control points can reach: the rest is kept.
#ifndef BrainShift_FieldChange_h
#define BrainShift_FieldChange_h

#include "OffsetField.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

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
};

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

// Nodes of the offset field that can differ from zero: elsewhere tissue stays.
VTKBRAINSHIFTFILTERS_EXPORT IndexBox movedBackwardNodes(
  const glm::ivec3& dimensions, const std::vector<glm::vec3>& inCells, const FieldNodes& backward);
}

#endif
