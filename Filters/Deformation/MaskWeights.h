// SPDX-License-Identifier: BSD-3-Clause
// Where tissue may move, and how freely: the share of the displacement that holds at each node of
// the refined field.
//
// Nodes are fine enough for a thin rim where control points are not. A node has weight 0 if any of
// the eight cells of nodes around it holds a point outside the mask, so what is trilinear between
// the nodes is 0 outside the mask, exactly; as is what lies beyond the lattice. From the outermost
// of these nodes the weight rises smoothly to 1 over the feather. Where nothing folds, what stays
// inside the mask's edge is mapped onto itself: nothing from outside is seen inside. (The exact
// inverse; the negated one promises nothing.)
#ifndef BrainShift_MaskWeights_h
#define BrainShift_MaskWeights_h

#include "Filters/Deformation/Lattice.h"

#include <memory>
#include <vector>

namespace brainshift
{
// Which voxels of an image are inside; a voxel is the box around its value.
struct Mask
{
  Grid grid;
  std::vector<char> inside; // 1 or 0, x fastest
};

constexpr double MostMaskedNodes = 1e8; // 400 MB of weights, 1.2 GB of displacements

// `samples`: of the refined field, which has at most MostMaskedNodes. `featherMm`: 0 or more. The
// mask may lie anyhow to the lattice.
VTKBRAINSHIFTFILTERS_EXPORT std::shared_ptr<const NodeWeights> maskWeights(
  const Grid& lattice, int samples, const Mask& mask, double featherMm);
}

#endif
