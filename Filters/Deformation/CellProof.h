// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Proofs that the maps of a lattice do not fold in one of its cells.
 */
#ifndef BrainShift_CellProof_h
#define BrainShift_CellProof_h

#include "Common/Export.h"
#include "Filters/Deformation/JacobianBound.h"
#include "Filters/Deformation/Lattice.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

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
}

#endif
