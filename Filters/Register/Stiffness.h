// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What a bend costs: linear elastic energy and bending energy of control points.
 *
 * Both are means over the lattice and have no unit. They are quadratic: the energy of a bend d is
 * d . R d. A shift costs nothing; a small turn costs nothing elastic.
 */
#ifndef BrainShift_Stiffness_h
#define BrainShift_Stiffness_h

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Grid.h"

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
class BRAINSHIFT_DEFORMATION_EXPORT Stiffness
{
public:
  Stiffness() = default;

  /**
   * @param lattice   the control points
   * @param factor    on the energy; above 0
   */
  Stiffness(const Grid& lattice, double factor);

  /** R d for displacements d of the control points (mm along the grid's axes). */
  std::vector<glm::vec3> times(const std::vector<glm::vec3>& displacements) const;

  /** About what R has on its diagonal within the lattice. */
  float diagonal() const { return this->Diagonal; }

private:
  Grid Lattice;
  float Factor = 0.0f; // for each control point
  float Diagonal = 0.0f;
};

/** The sum of products of two lists. */
BRAINSHIFT_DEFORMATION_EXPORT double dot(
  const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b);

/**
 * The step of Gauss and Newton: (H + R) step = forces - R bend, where H is the lumped Hessian of
 * the forces (3 x 3 for each control point). By conjugate gradients with the blocks as
 * preconditioner (Nocedal and Wright, Numerical Optimization, 2nd ed., section 10.3 and algorithm
 * 5.3).
 *
 * @param forces   ForceNumbers for each control point (LatticeRows.h)
 * @param bend     displacements that the stiffness pulls back (mm along the grid's axes)
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> newtonStep(
  const Stiffness& stiffness, const std::vector<float>& forces, const std::vector<glm::vec3>& bend);
}

#endif
