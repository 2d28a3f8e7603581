// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Puts the bend of a fit on control points, and keeps it from folding tissue.
 */
#ifndef BrainShift_FitLattice_h
#define BrainShift_FitLattice_h

#include "Common/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Fit/Process.h"

namespace brainshift
{
/**
 * Adds to the displacements so that the cubic between the control points gains the field's values
 * at them. With Catmull-Rom these are the values themselves; a B-spline takes coefficients.
 */
BRAINSHIFT_DEFORMATION_EXPORT void addField(Lattice& lattice, const Process& field);

/**
 * The largest share, 0 to 1, of the way from one lattice to another that keeps the Jacobian
 * determinant at 0.1 or above (FoldGuard.h). Cells that fold at the start are left alone.
 *
 * @param samples   nodes between two control points that the lattice is drawn with, 0 to 16
 */
BRAINSHIFT_DEFORMATION_EXPORT double shareWithoutFolds(
  const Lattice& start, const Lattice& end, int samples);
}

#endif
