// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Keeps strokes from folding tissue: finds how much of a stroke may be applied.
 *
 * Two maps are guarded: deformedFromRest as the cubic gives it, and the refined displacement that
 * pictures are drawn with, which is trilinear between its nodes. With a mask the two are one map:
 * the refined displacement times the mask's weights.
 *
 * Afterwards the Jacobian determinant of both is 0.1 or more at every point of every cell that the
 * stroke reaches, and beyond the lattice, where the values of its border hold. This is proved by
 * bounds (CellProof.h) and not sampled. It is the determinant at full strength.
 */
#ifndef BrainShift_FoldGuard_h
#define BrainShift_FoldGuard_h

#include "Common/Export.h"
#include "Filters/Deformation/CellProof.h"
#include "Filters/Deformation/Lattice.h"

#include <vector>

namespace brainshift
{
/** The smallest Jacobian determinant that the guard allows. */
constexpr float SmallestGuardedJacobian = 0.1f;

/** Guards the strokes that are applied to one base lattice. */
class BRAINSHIFT_DEFORMATION_EXPORT FoldGuard
{
public:
  /**
   * Sets the lattice before any stroke and the samples (0 to 16) it is drawn with. If a cell of the
   * base has a determinant below the limit, the guard ignores that cell: otherwise no stroke could
   * touch it.
   */
  void setBase(const Lattice& base, int samples);

  /** How many lattice cells the guard ignores because the base folds in them. */
  int foldedCells() const { return this->FoldedCount; }

  /**
   * The largest fraction, 0 to 1, of the path from `before` to `after` that keeps the limit. The
   * answer can be up to 0.01 below the largest one. `before` must keep the limit.
   */
  double fraction(const Lattice& before, const Lattice& after) const;

private:
  CellProof Proof;
  std::vector<char> Folded; // by the cell's first control point; empty if there are none
  int FoldedCount = 0;
};

/** The lattice at a fraction, 0 to 1, of the path from one to the other. */
BRAINSHIFT_DEFORMATION_EXPORT Lattice between(
  const Lattice& before, const Lattice& after, double fraction);
}

#endif
