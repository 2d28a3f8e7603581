// SPDX-License-Identifier: BSD-3-Clause
// Keeps strokes from folding tissue: tells how much of a stroke may be applied.
//
// Guarded are deformedFromRest, straight from the control points, and the refined displacement that
// pictures are drawn with, trilinear between its nodes; in all cells that the stroke reaches, and
// beyond the lattice where its border holds. Both have a determinant of 0.1 or more afterwards, at
// every point: proved by bounds (CellProof.h), not sampled. It is that of full strength.
// With a mask both are one map, the refined displacement times the mask's weights.
#ifndef BrainShift_FoldGuard_h
#define BrainShift_FoldGuard_h

#include "Filters/Deformation/CellProof.h"
#include "Filters/Deformation/Lattice.h"

#include <vector>

namespace brainshift
{
constexpr float SmallestGuardedJacobian = 0.1f;

class VTKBRAINSHIFTFILTERS_EXPORT FoldGuard
{
public:
  // The lattice before any stroke, and the samples it is drawn with. Cells in which it has
  // determinants below the limit by itself are left alone: else no stroke could touch them.
  void setBase(const Lattice& base, int samples);

  // Lattice cells that are left alone.
  int foldedCells() const { return this->FoldedCount; }

  // The largest part, 0 to 1, of the way from one lattice to the other that keeps the limit, or up
  // to 1 % less. `before` keeps it itself.
  double share(const Lattice& before, const Lattice& after) const;

private:
  CellProof Proof;
  std::vector<char> Folded; // by the cell's first control point; empty if there are none
  int FoldedCount = 0;
};

// The lattice at a share, 0 to 1, of the way from one to the other.
VTKBRAINSHIFTFILTERS_EXPORT Lattice between(
  const Lattice& before, const Lattice& after, double share);
}

#endif
