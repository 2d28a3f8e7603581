// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps strokes from folding tissue: finds how much of a stroke may be applied.
///
/// Two maps are guarded: deformedFromRest as the cubic gives it, and the refined displacement that
/// pictures are drawn with, which is trilinear between its nodes. With a mask the two are one map:
/// the refined displacement times the mask's weights.
///
/// Afterwards the Jacobian determinant of both is 0.1 or more at every point of every cell that the
/// stroke reaches, and beyond the lattice, where the values of its border hold. This is proved by
/// bounds (CellProof, JacobianBound.h) and not sampled. It is the determinant at full strength.
#ifndef BrainShift_FoldGuard_h
#define BrainShift_FoldGuard_h

#include "Filters/Deformation/JacobianBound.h"
#include "Filters/Deformation/Lattice.h"

namespace brainshift
{
/**
 * Proves cells of all lattices that have the same points, kernel and mask and are drawn with the
 * same samples.
 *
 * Two maps are proved: deformedFromRest as the cubic gives it at the control points' displacements,
 * and the refined displacement that pictures are drawn with. With a mask there is only the second
 * one, times the mask's weights.
 */
class BRAINSHIFT_DEFORMATION_EXPORT CellProof
{
public:
  CellProof() = default;

  /** `samples`: nodes of the refined field between two control points, 0 to 16. */
  CellProof(const Lattice& lattice, int samples);

  /** Whether this object proves cells of that lattice. */
  bool isFor(const Lattice& lattice, int samples) const;

  /**
   * Whether the Jacobian determinants are proved to be at or above `limit` everywhere in a cell.
   * If the cell lies at the lattice's border, the proof includes the space beyond that border.
   *
   * @param taps   displacements (lattice cells) of the control points around the cell
   * @param cell   index of the cell's first control point
   */
  bool holds(const CellTaps& taps, const glm::ivec3& cell, float limit) const;

private:
  bool isReached(int beyond, const glm::ivec3& cell, CellTaps& taps) const;
  bool maskedHolds(const CellTaps& taps, const glm::ivec3& cell, float limit) const;

  Grid Points;
  int Kernel = 0;
  int PerCell = 1; // nodes
  std::shared_ptr<const NodeWeights> Mask;
  std::vector<WeightRange> Ranges; // of the mask, by the cell's first control point
};

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
