// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief How far a fit can be believed, from its lattice to the volume that it bends.
 */
#ifndef BrainShift_EvidenceArray_h
#define BrainShift_EvidenceArray_h

#include <string>
#include <vector>

class vtkImageData;

namespace brainshift
{
class FittedLattice;
class LatticeEvidence;
struct Deformation;
struct Lattice;

/**
 * Adds the point array Deviation (FieldImage.h) to an image of the fit's lattice. Returns one
 * sentence without a full stop if it cannot; empty if it can.
 */
std::string addEvidence(
  vtkImageData* lattice, const FittedLattice& fitted, LatticeEvidence& evidence);

/**
 * Deviations (mm) at the control points of a deformation that is drawn. A hand is no measurement:
 * where strokes or Strength put tissue elsewhere than the fit has it, that distance counts.
 *
 * @param base    the lattice image; null or without the array: there are no deviations. Nor are
 *                there on other control points: nobody knows how far a trilinear reading is off
 * @param start   the lattice before strokes
 */
std::vector<float> drawnDeviations(
  vtkImageData* base, const Lattice& start, const Deformation& drawn);
}

#endif
