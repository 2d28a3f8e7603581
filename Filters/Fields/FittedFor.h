// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Names on a fitted lattice what it was fitted for, so that a deformation that takes it can
 *        say that the figures of the fit do not hold there.
 *
 * The field array FittedFor holds one string, for example "19 x 19 x 19 control points, kernel
 * Catmull-Rom, Samples 4, no mask".
 */
#ifndef BrainShift_FittedFor_h
#define BrainShift_FittedFor_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

class vtkDataObject;

namespace brainshift
{
struct Lattice;

/** Attaches the array to a lattice. `samples`: nodes between two control points. */
VTKBRAINSHIFTFILTERS_EXPORT void nameFittedFor(
  vtkDataObject* image, const Lattice& lattice, int samples);

/**
 * One sentence without a full stop if a base lattice was fitted for another deformation than this
 * one; empty if it was fitted for this one, or was not fitted.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string wordsOnFittedFor(
  vtkDataObject* base, const Lattice& lattice, int samples);
}

#endif
