// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Weights of a mask: the fraction of the displacement that holds at each node of the refined
/// field.
///
/// Nodes are fine enough for a thin rim; control points are not. A node has weight 0 if any of the
/// eight cells of nodes around it holds a point outside the mask. The field is trilinear between
/// the nodes, so it is exactly 0 outside the mask and beyond the lattice. From the outermost of
/// these nodes the weight rises smoothly to 1 over the feather.
///
/// If nothing folds, the tissue inside the mask is mapped onto itself, so no tissue from outside is
/// seen inside. This holds for the exact inverse and not for the negated one.
#ifndef BrainShift_MaskWeights_h
#define BrainShift_MaskWeights_h

#include "Common/Export.h"
#include "Common/Grid.h"

#include <memory>
#include <vector>

namespace brainshift
{
struct NodeWeights;

/** Which voxels of an image are inside. A voxel is the box around its value. */
struct Mask
{
  Grid grid;                ///< positions of the voxels' middles
  std::vector<char> inside; ///< 1 or 0 for each voxel, x fastest
};

/**
 * Adds every voxel whose middle lies within a distance (mm, 0 or more) of the middle of a voxel
 * that is inside. The mask's own image limits it. It takes MaskGrowthBytes for each voxel.
 */
BRAINSHIFT_DEFORMATION_EXPORT void growMask(Mask& mask, double byMm);

/** Memory that growMask takes while it works, for each voxel. */
constexpr double MaskGrowthBytes = 8.0;

/** Most nodes of a refined field with a mask: 400 MB of weights and 1.2 GB of displacements. */
constexpr double MostMaskedNodes = 1e8;

/**
 * The weights that a mask gives the nodes of a refined field. The mask may lie anywhere and in any
 * direction relative to the lattice.
 *
 * @param lattice     the control points
 * @param samples     nodes between two control points; the field has at most MostMaskedNodes nodes
 * @param featherMm   distance (mm) over which weights rise from 0 to 1; 0 or more
 */
BRAINSHIFT_DEFORMATION_EXPORT std::shared_ptr<const NodeWeights> maskWeights(
  const Grid& lattice, int samples, const Mask& mask, double featherMm);
}

#endif
