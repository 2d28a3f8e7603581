// SPDX-License-Identifier: BSD-3-Clause
// Proofs that the maps a lattice stands for do not fold in one of its cells.
#ifndef BrainShift_CellProof_h
#define BrainShift_CellProof_h

#include "Filters/Deformation/JacobianBound.h"
#include "Filters/Deformation/Lattice.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace brainshift
{
// For all lattices with the same points, kernel and mask, drawn with the same samples. The maps are
// deformedFromRest, straight from the control points, and the refined displacement that pictures
// are drawn with; with a mask only the latter, times the weights.
class VTKBRAINSHIFTFILTERS_EXPORT CellProof
{
public:
  CellProof() = default;
  CellProof(const Lattice& lattice, int samples);

  bool isFor(const Lattice& lattice, int samples) const;

  // The determinants are at or above the limit everywhere in a cell, and beyond the lattice's faces
  // and edges that it lies at. `taps`: the displacements around it.
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
