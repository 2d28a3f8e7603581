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

/** forces - R d: what moves control points with displacements d. It is 0 at the least energy. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> pullOf(const Stiffness& stiffness,
  const std::vector<float>& forces, const std::vector<glm::vec3>& displacements);

/** What the last step did. */
struct StepTaken
{
  std::vector<glm::vec3> way;  ///< of the control points, mm along the grid's axes
  std::vector<glm::vec3> drop; ///< the pull before it minus the pull after it
};

/**
 * A quasi-Newton step: what solves (s H + R) step = pull, corrected by the last step. H is the
 * lumped Hessian of the forces (3 x 3 for each control point), which is larger than the true one;
 * s is how much of it the last step found. The correction is the memoryless BFGS method (Nocedal
 * and Wright, Numerical Optimization, 2nd ed., section 7.2), and the solver the preconditioned
 * conjugate gradient method (algorithm 5.3 there); the blocks of s H plus the diagonal of R are
 * its preconditioner.
 *
 * @param forces   ForceNumbers for each control point (LatticeRows.h)
 * @param pull     see pullOf
 * @param last     null: nothing is known of it
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<glm::vec3> newtonStep(const Stiffness& stiffness,
  const std::vector<float>& forces, std::vector<glm::vec3> pull, const StepTaken* last = nullptr);
}

#endif
