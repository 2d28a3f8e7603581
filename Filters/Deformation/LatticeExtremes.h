// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Two figures that a user reads of a lattice: its largest displacement and its smallest
 *        Jacobian determinant.
 */
#ifndef BrainShift_LatticeExtremes_h
#define BrainShift_LatticeExtremes_h

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Lattice.h"

namespace brainshift
{
/** Largest displacement (mm) of a control point; with a mask, of a node of the refined field. */
BRAINSHIFT_DEFORMATION_EXPORT double maximumDisplacement(const Lattice& lattice);

/**
 * Smallest Jacobian determinant of deformedFromRest within the lattice.
 *
 * The determinant is the factor by which the map changes a small volume: 1 keeps it, above 1 grows
 * it, 0 or less folds tissue. It is sampled on the control points and halfway between them. With a
 * mask it is sampled at the corners of all cells between nodes. Between the samples it can be
 * smaller, so the fold guard does not rely on this figure. Where nothing moves it is 1.
 */
BRAINSHIFT_DEFORMATION_EXPORT double minimumJacobian(const Lattice& lattice);
}

#endif
