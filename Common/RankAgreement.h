// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What MPI ranks agree on before they exchange anything: a rank that fails between two exchanges
/// would let the others wait for ever. All ranks must call each function together.
#ifndef BrainShift_RankAgreement_h
#define BrainShift_RankAgreement_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <array>
#include <string>

class vtkMultiProcessController;

namespace brainshift
{
/// Least and greatest x, y and z, mm, world axes.
using Box = std::array<double, 6>;

/** Whether something is true on one rank or more. */
VTKBRAINSHIFTCOMMON_EXPORT bool isTrueOnAny(vtkMultiProcessController* ranks, bool here);

/**
 * Why something fails, on all ranks: the sentence of the first rank that has one, with the rank
 * before it. Empty if none has one.
 *
 * @param here   this rank's sentence without a full stop; empty: it does not fail
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string problemOnAny(
  vtkMultiProcessController* ranks, const std::string& here);

/** The smallest box that holds the boxes of all ranks. */
VTKBRAINSHIFTCOMMON_EXPORT Box boxOfAll(vtkMultiProcessController* ranks, const Box& here);
}

#endif
