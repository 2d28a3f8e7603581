// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The uncertainty of a fit, from its lattice to the volume that it bends.
#ifndef BrainShift_EvidenceArray_h
#define BrainShift_EvidenceArray_h

#include <vector>

class vtkImageData;

namespace brainshift
{
class FittedLattice;
class LatticeEvidence;
struct Deformation;
struct Lattice;

/**
 * Adds the point array Deviation (FieldImage.h) to an image of the fit's lattice. Throws a Problem
 * if it cannot.
 */
void addEvidence(vtkImageData* lattice, const FittedLattice& fitted, LatticeEvidence& evidence);

/**
 * Standard deviations (mm) at the control points of a deformation that is drawn. A hand is no
 * measurement: where strokes or Strength put tissue elsewhere than the fit has it, that distance
 * counts, as the root of deviation^2 + distance^2 / 3.
 *
 * @param base    the lattice image; null or without the array: there are no deviations. On other
 *                control points there are none either: the error of a trilinear reading is unknown
 * @param start   the lattice before strokes
 */
std::vector<float> drawnDeviations(
  vtkImageData* base, const Lattice& start, const Deformation& drawn);
}

#endif
