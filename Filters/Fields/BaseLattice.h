// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads a displacement field on any grid into a lattice: what a deformation or a fit begins
 *        with.
 */
#ifndef BrainShift_BaseLattice_h
#define BrainShift_BaseLattice_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

class vtkImageData;

namespace brainshift
{
struct Lattice;

/**
 * Adds a forward field (mm, world axes) to the displacements of a lattice. It is read trilinearly
 * at the control points; outside it the nearest value holds.
 *
 * @param base   null or without points: nothing is added
 * @return one sentence without a full stop on what is wrong with the field; empty if nothing is
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string addBase(Lattice& lattice, vtkImageData* base);
}

#endif
