// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Attaches to a fitted lattice what it was fitted for, so that a deformation that takes it
 *        can say that the figures of the fit do not hold there.
 *
 * The field array FittedFor holds 14 numbers: LatticeDimensions (3), Kernel, Samples, the first and
 * the last corner of the box (6, mm, world axes), and three sums of the mask's weights at the nodes
 * of the refined field (3): plain, and with two pseudo-random factors for each node. Without a mask
 * the sums are NaN. Older files have one string there, which is still read.
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
