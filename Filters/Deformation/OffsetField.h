// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The fields that a picture is drawn with, computed on the CPU for bake, export and tests.
///
/// The shaders refine.frag.glsl and invert.frag.glsl compute them on the GPU with the same
/// mathematics. The *refined displacement* is the forward map minus identity at nodes between the
/// control points. The *offset field* is the backward map minus identity at such nodes.
#ifndef BrainShift_OffsetField_h
#define BrainShift_OffsetField_h

#include "Common/Export.h"
#include "Common/Grid.h"

#include <vector>

namespace brainshift
{
struct Lattice;

/** Fewest nodes between two control points. */
constexpr int SmallestSamples = 0;

/** Most nodes between two control points. */
constexpr int LargestSamples = 16;

/** How a picture finds the tissue that it shows at a deformed point. */
enum class Inverse
{
  Exact = 0, ///< solves the forward map: tissue arrives where the control point is put
  /**
   * Subtracts the displacement found at the deformed point, which is right for small displacements
   * only. Source: van der Steen et al., SPIE 7169 (2009), section 2.
   */
  Negated = 1,
};

/**
 * A value of the field lies within the range of its 64 control points, widened by this factor about
 * the middle. Catmull-Rom weights are partly negative: their absolute values sum to at most 1.25
 * along an axis. B-spline weights are positive, so the bound holds for them too.
 */
constexpr float KernelOvershoot = 1.25f * 1.25f * 1.25f;

/**
 * Where the nodes of a refined field lie. Node i of an axis lies first[axis] + i / perCell cells
 * from the first control point.
 */
struct FieldNodes
{
  glm::ivec3 count{ 0 }; ///< nodes along each axis
  glm::ivec3 first{ 0 }; ///< cells; below 0 where the field reaches beyond the lattice
  int perCell = 1;       ///< nodes for each lattice cell along an axis: samples + 1

  /** Lattice coordinates of a position that is counted in nodes from the first node. */
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

/** A vector field, trilinear between nodes. Outside the nodes the nearest node's value holds. */
struct BRAINSHIFT_DEFORMATION_EXPORT NodeField
{
  FieldNodes nodes;
  std::vector<glm::vec3> values; ///< lattice cells, one for each node, x fastest

  /** The value (lattice cells) at a position in lattice coordinates. */
  glm::vec3 displacement(const glm::vec3& lattice) const;

  /** The value, and the derivatives of position + value, at a position in lattice coordinates. */
  void map(const glm::vec3& lattice, glm::vec3& displacement, glm::mat3& jacobian) const;
};

/** Nodes over the lattice itself: (points - 1) * (samples + 1) + 1 along each axis; default 91. */
BRAINSHIFT_DEFORMATION_EXPORT FieldNodes forwardNodes(const Grid& lattice, int samples);

/**
 * Nodes over the lattice and over every place that its tissue may reach, rounded up to whole cells.
 *
 * @param inCells   displacements of the control points (lattice cells), see displacementsInCells;
 *                  they are finite and no longer than LongestDisplacementCells, or the nodes end
 *                  where twice that would reach
 */
BRAINSHIFT_DEFORMATION_EXPORT FieldNodes backwardNodes(
  const Grid& lattice, const std::vector<glm::vec3>& inCells, int samples);

/**
 * The refined displacement of control points, one axis after the other: x, then y, then z.
 *
 * @param inCells   displacements of the control points (lattice cells), see displacementsInCells
 * @param samples   nodes between two control points, 0 to 16
 */
BRAINSHIFT_DEFORMATION_EXPORT NodeField refine(
  const Grid& grid, int kernel, const std::vector<glm::vec3>& inCells, int samples);

/**
 * The refined displacement of a lattice. If the lattice has a mask, it is multiplied by the mask's
 * weights, which must have been made for the given samples.
 */
BRAINSHIFT_DEFORMATION_EXPORT NodeField refine(const Lattice& lattice, int samples);

/** The offset field on `nodes`, from the refined displacement. */
BRAINSHIFT_DEFORMATION_EXPORT NodeField invert(
  const NodeField& forward, const FieldNodes& nodes, Inverse inverse);

/** The offset field of a lattice, over every place that its tissue may reach. */
BRAINSHIFT_DEFORMATION_EXPORT NodeField offsetField(
  const Lattice& lattice, int samples, Inverse inverse);
}

#endif
