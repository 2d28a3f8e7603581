// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which voxels of a volume a part of its deformed frame needs: those where its tissue can rest.
#ifndef BrainShift_RestExtent_h
#define BrainShift_RestExtent_h

#include "Common/SharedVolume.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

namespace brainshift
{
struct Lattice;

/// Positions from the least to the greatest, along the axes of a grid.
struct PositionRange
{
  glm::dvec3 low{ 0.0 };
  glm::dvec3 high{ 0.0 };
};

/**
 * Where the tissue rests that can come into a part of the deformed frame: an extent within that of
 * the volume, of two points a side at least. It holds the neighbours that interpolation and
 * gradients read. A map that folds may take tissue from elsewhere.
 *
 * @param lattice   the deformation; null: nothing moves
 * @param part      in grid coordinates of the volume
 * @param haloMm    is added to every side, mm
 */
VTKBRAINSHIFTFILTERS_EXPORT Extent restExtent(
  const WholeVolume& volume, const Lattice* lattice, const PositionRange& part, double haloMm);
}

#endif
