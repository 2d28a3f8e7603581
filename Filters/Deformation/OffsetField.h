// SPDX-License-Identifier: BSD-3-Clause
// The fields a picture is drawn with, on the CPU: what the shaders refine.frag.glsl and
// invert.frag.glsl compute on the GPU, with the same mathematics, for bake, export and tests.
#ifndef BrainShift_OffsetField_h
#define BrainShift_OffsetField_h

#include "Filters/Deformation/Lattice.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
constexpr int SmallestSamples = 0;
constexpr int LargestSamples = 16;

// How a picture finds tissue.
enum class Inverse
{
  Exact = 0,   // solves the forward map: tissue arrives where the handle is put
  Negated = 1, // the paper's form: subtracts the displacement found at the deformed point
};

// Catmull-Rom weights are partly negative: their absolute values sum to at most 1.25 along an
// axis, 1.25^3 in space. A field value lies within the range of its 64 control points, widened by
// that factor about the middle. B-spline weights are positive, so the bound holds for them too.
constexpr float KernelOvershoot = 1.25f * 1.25f * 1.25f;

// Where the nodes of a refined field lie, in lattice coordinates: node i of an axis lies at
// first[axis] + i / perCell cells from the first control point.
struct FieldNodes
{
  glm::ivec3 count{ 0 }; // nodes a side
  glm::ivec3 first{ 0 }; // cells; below 0 where the field reaches beyond the lattice
  int perCell = 1;       // nodes for each lattice cell: samples + 1

  glm::vec3 latticeFromNode(const glm::vec3& node) const
  {
    return glm::vec3(this->first) + node / static_cast<float>(this->perCell);
  }
  bool operator==(const FieldNodes& other) const
  {
    return this->count == other.count && this->first == other.first &&
      this->perCell == other.perCell;
  }
};

// A vector field, trilinear between nodes; outside the nodes the value of the nearest holds.
struct VTKBRAINSHIFTFILTERS_EXPORT NodeField
{
  FieldNodes nodes;
  std::vector<glm::vec3> values; // lattice cells, x fastest

  glm::vec3 displacement(const glm::vec3& lattice) const; // at a lattice coordinate
  // The same with the derivatives of position + displacement.
  void map(const glm::vec3& lattice, glm::vec3& displacement, glm::mat3& jacobian) const;
};

// Nodes over the lattice itself: (points - 1) * (samples + 1) + 1 a side; 91 by default.
VTKBRAINSHIFTFILTERS_EXPORT FieldNodes forwardNodes(const Grid& lattice, int samples);

// Nodes over the lattice and all places where its tissue may go, by whole cells.
VTKBRAINSHIFTFILTERS_EXPORT FieldNodes backwardNodes(
  const Grid& lattice, const std::vector<glm::vec3>& inCells, int samples);

// The displacement (forward map minus identity) on the nodes, separably: x, then y, then z.
VTKBRAINSHIFTFILTERS_EXPORT NodeField refine(
  const Grid& grid, int kernel, const std::vector<glm::vec3>& inCells, int samples);

// The same of a lattice, times its mask's weights if it has one, which must be for these samples.
VTKBRAINSHIFTFILTERS_EXPORT NodeField refine(const Lattice& lattice, int samples);

// Smallest Jacobian determinant of position + field at the corners of all its cells.
VTKBRAINSHIFTFILTERS_EXPORT double minimumJacobian(const NodeField& field);

// The offset field (backward map minus identity) on `nodes`, from the refined displacement.
VTKBRAINSHIFTFILTERS_EXPORT NodeField invert(
  const NodeField& forward, const FieldNodes& nodes, Inverse inverse);

// All of it: the offset field of a lattice.
VTKBRAINSHIFTFILTERS_EXPORT NodeField offsetField(
  const Lattice& lattice, int samples, Inverse inverse);
}

#endif
