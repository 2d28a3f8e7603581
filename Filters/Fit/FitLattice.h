// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Puts the bend of a fit on control points, and keeps it from folding tissue.
 */
#ifndef BrainShift_FitLattice_h
#define BrainShift_FitLattice_h

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Fit/Process.h"

namespace brainshift
{
/**
 * Sets the displacements so that the cubic between the control points has the field's values at
 * them. With Catmull-Rom these are the values themselves; a B-spline takes coefficients.
 */
BRAINSHIFT_DEFORMATION_EXPORT void sampleField(Lattice& lattice, const Process& field);

/**
 * The largest share of the displacements, 0 to 1, that keeps the Jacobian determinant at 0.1 or
 * above everywhere (FoldGuard.h). Of a lattice that keeps it, the share is 1.
 *
 * @param samples   nodes between two control points that the lattice is drawn with, 0 to 16
 */
BRAINSHIFT_DEFORMATION_EXPORT double shareWithoutFolds(const Lattice& lattice, int samples);
}

#endif
