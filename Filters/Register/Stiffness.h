// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Stiffness: linear elastic energy (Bajcsy and Kovacic, Computer Vision, Graphics, and Image
/// Processing 46, 1989) and bending energy (Rueckert et al., IEEE Transactions on Medical Imaging
/// 18(8), 1999) of control points.
///
/// Both are means over the lattice and have no unit. They are quadratic: the energy of
/// displacements d is d . R d. A translation has no energy; a small rotation has no elastic energy.
#ifndef BrainShift_Stiffness_h
#define BrainShift_Stiffness_h

#include "Common/Export.h"
#include "Common/Grid.h"

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

  /** About the diagonal of R within the lattice. */
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
 * The Gauss-Newton step (Nocedal and Wright, Numerical Optimization, 2nd ed., section 10.3):
 * (H + R) step = forces - R bend, where H is the lumped Hessian of the forces (3 x 3 for each
 * control point). The solver is the preconditioned conjugate gradient method (algorithm 5.3 there);
 * the blocks of H plus the diagonal of R are its preconditioner.
 *
 * @param forces   ForceNumbers for each control point (LatticeRows.h)
 * @param bend     displacements that the stiffness pulls back (mm along the grid's axes)
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> newtonStep(
  const Stiffness& stiffness, const std::vector<float>& forces, const std::vector<glm::vec3>& bend);
}

#endif
