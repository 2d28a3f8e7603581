// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A transform of a file as control points, and how well they follow it.
#ifndef BrainShift_TransformLattice_h
#define BrainShift_TransformLattice_h

#include "Filters/Deformation/Lattice.h"
#include "Formats/Transforms/PointTransform.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

namespace brainshift
{
/**
 * Turns the displacements at the points of a lattice with the kernel B-spline into control points
 * whose cubic passes through them. If a cubic B-spline on this grid made them, these are its own
 * coefficients. A lattice of the other kernel stays, for that cubic does so anyway.
 */
VTKBRAINSHIFTFILTERS_EXPORT void interpolateAtPoints(Lattice& lattice);

/**
 * The largest distance (mm) between where the lattice takes tissue and where the transform does, at
 * the middles of up to 20 x 20 x 20 cells. For a transform that leads backward, it is measured in
 * the rest frame.
 */
VTKBRAINSHIFTFILTERS_EXPORT double largestErrorOf(
  const Lattice& lattice, const DirectedTransform& transform);
}

#endif
