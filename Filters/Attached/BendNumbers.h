// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether MPI ranks bend a volume in the same way. Each makes its deformation by itself, and one
/// that cannot, for example without memory, keeps the last one.
#ifndef BrainShift_BendNumbers_h
#define BrainShift_BendNumbers_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace brainshift
{
/// A number that deformations differ in. Processors may round the last digits in different ways.
struct BendNumber
{
  double value = 0.0;
  double scale = 0.0; ///< Rounding changes the value by less than 1e-5 of this.
};

/**
 * Numbers that say how a volume is bent: its lattice with Strength applied, its mask, Samples and
 * Inverse. Always as many, all 0 without a deformation. Two deformations that differ anywhere have
 * different numbers. Throws a Problem as readDeformation does.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::vector<BendNumber> bendNumbersOf(vtkDataObject* volume);

/** Whether the numbers of all MPI ranks are the same. All ranks must call it together. */
VTKBRAINSHIFTFILTERS_EXPORT bool areSameOnAll(
  vtkMultiProcessController* ranks, const std::vector<BendNumber>& here);

/** Why MPI ranks do not bend a volume in the same way, on all of them; empty: they do. All ranks
 * must call it together. */
VTKBRAINSHIFTFILTERS_EXPORT std::string bendProblem(
  vtkMultiProcessController* ranks, vtkDataObject* volume);
}

#endif
