// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The base of a deformation or a fit: reads a displacement field on any grid into a lattice, and
/// attaches to a fitted lattice the settings that it was fitted for.
///
/// The field array FittedFor holds 14 numbers: LatticeDimensions (3), Kernel, Samples, the first
/// and the last corner of the box (6, mm, world axes), and three sums of the mask's weights at the
/// nodes of the refined field (3): plain, and with two pseudo-random factors for each node. Without
/// a mask the sums are NaN. Older files have one string there, which is still read.
#ifndef BrainShift_BaseLattice_h
#define BrainShift_BaseLattice_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

class vtkDataObject;
class vtkImageData;

namespace brainshift
{
struct Lattice;

/**
 * Adds a forward field (mm, world axes) to the displacements of a lattice. It is read trilinearly
 * at the control points; outside it the nearest value holds. Throws a Problem about a field that is
 * wrong.
 *
 * @param base   null or without points: nothing is added
 */
VTKBRAINSHIFTFILTERS_EXPORT void addBase(Lattice& lattice, vtkImageData* base);

/** Attaches the array to a lattice. `samples`: nodes between two control points. */
VTKBRAINSHIFTFILTERS_EXPORT void attachFittedFor(
  vtkDataObject* image, const Lattice& lattice, int samples);

/**
 * One sentence without a full stop if a base lattice was fitted for another deformation than this
 * one; empty if it was fitted for this one, or was not fitted.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string wordsOnFittedFor(
  vtkDataObject* base, const Lattice& lattice, int samples);
}

#endif
