// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the visible tissue of a bent volume is, coarsely: what MPI ranks balance their work by.
#ifndef BrainShift_VisibleTissue_h
#define BrainShift_VisibleTissue_h

#include "Representations/Scene/SceneGeometry.h"
#include "Representations/Window/RankParts.h"

class vtkVolumeProperty;

namespace brainshift
{
/**
 * Adds the visible voxels of a volume to the cells of a box of the deformed frame. It looks at some
 * ten thousand voxels, evenly spread, and counts each for those around it.
 *
 * @param values     the voxels; this rank's part of them
 * @param property   a voxel counts if its scalar is opaque; with a 2D transfer function all count
 * @param lattice    the deformation; null: nothing moves
 */
void countVisible(const DrawnValues& values, vtkVolumeProperty* property, const Lattice* lattice,
  TissueCounts& counts);
}

#endif
