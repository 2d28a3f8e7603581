// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Two figures that a user reads of a lattice: its largest displacement and its smallest Jacobian
/// determinant.
#ifndef BrainShift_LatticeExtremes_h
#define BrainShift_LatticeExtremes_h

#include "Filters/Deformation/Lattice.h"

namespace brainshift
{
/** Largest error of minimumJacobian, downwards: a fraction of it, or of 1 if it is smaller. */
constexpr double DeterminantTolerance = 1e-3;

/** Largest displacement (mm) of a control point; with a mask, of a node of the refined field. */
BRAINSHIFT_DEFORMATION_EXPORT double maximumDisplacement(const Lattice& lattice);

/**
 * Smallest Jacobian determinant of deformedFromRest within the lattice.
 *
 * The determinant is the factor by which the map changes a small volume: 1 keeps it, above 1 grows
 * it, 0 or less folds tissue. Where nothing moves it is 1.
 *
 * The result is proved by bounds (JacobianBound.h) and not sampled: the determinant is nowhere
 * smaller. Somewhere it is larger by no more than DeterminantTolerance, unless that would take more
 * than 20000 halvings of cells; the result is then lower, and still nowhere undercut.
 */
BRAINSHIFT_DEFORMATION_EXPORT double minimumJacobian(const Lattice& lattice);
}

#endif
