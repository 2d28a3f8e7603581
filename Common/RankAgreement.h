// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What MPI ranks agree on before they exchange anything: a rank that fails between two exchanges
/// would let the others wait for ever. All ranks must call each function together.
#ifndef BrainShift_RankAgreement_h
#define BrainShift_RankAgreement_h

#include "Common/Guard.h"
#include "Common/Problem.h"
#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <array>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace brainshift
{
/// Least and greatest x, y and z, mm, world axes.
using Box = std::array<double, 6>;

/** The MPI ranks of this program; null if it is one process. */
VTKBRAINSHIFTCOMMON_EXPORT vtkMultiProcessController* severalRanks();

/** Whether something is true on one rank or more. */
VTKBRAINSHIFTCOMMON_EXPORT bool isTrueOnAny(vtkMultiProcessController* ranks, bool here);

/** The first rank on which something is true, on all ranks; the number of ranks if on none. */
VTKBRAINSHIFTCOMMON_EXPORT int firstRankWhere(vtkMultiProcessController* ranks, bool here);

/**
 * Why something fails, on all ranks: the sentence of the first rank that has one, with the rank
 * before it. Empty if none has one.
 *
 * @param here   this rank's sentence without a full stop; empty: it does not fail
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string problemOnAny(
  vtkMultiProcessController* ranks, const std::string& here);

/**
 * Runs a step of a filter on each rank. If it throws on one, this throws a Problem on all of them:
 * that of the first rank that failed. So what ranks exchange after the step finds all of them.
 *
 * @param subject   see sentenceThrownBy
 */
template <typename Step>
void runOnAllRanks(const std::string& subject, const Step& step)
{
  if (vtkMultiProcessController* ranks = severalRanks())
  {
    throwIfAny(problemOnAny(ranks, sentenceThrownBy(subject, step)));
    return;
  }
  step();
}

/** A sentence of a rank, with the rank before it. */
VTKBRAINSHIFTCOMMON_EXPORT std::string saidByRank(
  vtkMultiProcessController* ranks, int rank, const std::string& sentence);

/** A text of one rank, on all ranks. `here`: any text on the other ranks. */
VTKBRAINSHIFTCOMMON_EXPORT std::string textOf(
  vtkMultiProcessController* ranks, const std::string& here, int rank);

/** The boxes of all ranks, by rank. */
VTKBRAINSHIFTCOMMON_EXPORT std::vector<Box> boxesOfAll(
  vtkMultiProcessController* ranks, const Box& here);

/** The smallest box that holds the boxes of all ranks. */
VTKBRAINSHIFTCOMMON_EXPORT Box boxOfAll(vtkMultiProcessController* ranks, const Box& here);
}

#endif
